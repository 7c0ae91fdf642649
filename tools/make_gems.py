"""Writes the gems that the refractive index database lacks: a two-point Cauchy curve from n_D and the dispersion.

    python tools/make_gems.py

n = A + B / lambda^2 through n_D at 589.3 nm with the handbook's n_G - n_B (430.8 and 686.7 nm), from gem_constants.csv;
and gadolinium gallium garnet from a published Sellmeier equation.
"""

import csv
from decimal import Decimal
from pathlib import Path

from speclib import array, dataset, write

D, G, B = 0.5893, 0.4308, 0.6867

HANDBOOK = {
    "title": "Gems: Their Sources, Descriptions and Identification (indices); Gemstones of the World (dispersion)",
    "authors": "R. Webster; W. Schumann",
    "licence": "facts (handbook constants)",
    "origin": "n_D and n_G - n_B of gemmological handbooks",
}
REMARKS = ("two-point Cauchy curve from n_D = {n} and n_G - n_B = {d}: the curvature is assumed, handbook dispersions are "
           "rounded and single stones differ by 0.01 in n; constants as commonly quoted, not checked against one edition")


def rounded(x, digits):
    return Decimal(f"{x:.{digits}f}")


def main():
    with open(Path(__file__).parent / "gem_constants.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    for row in rows:
        n, dispersion = float(row["n_d"]), float(row["dispersion"])
        b = dispersion / (G**-2 - B**-2)
        a = n - b * D**-2
        sample = {"description": row["description"], "confidence": "low",
                  "remarks": REMARKS.format(n=row["n_d"], d=row["dispersion"])}
        lines = ['type = "cauchy"', array("coefficients", [rounded(a, 6), rounded(b, 7), Decimal(-2)]),
                 array("range_nm", [Decimal("430.8"), Decimal("686.7")])]
        write(f"ior/{row['key']}", dataset("ior", HANDBOOK, sample, [("formula", lines)]))

    source = {"title": "Optical properties of gadolinium gallium garnet", "authors": "D. L. Wood, K. Nassau",
              "journal": "Appl. Opt. 29, 3704-3707", "year": 1990, "licence": "facts (published equation)",
              "origin": "Sellmeier equation as quoted in handbooks of optics"}
    sample = {"description": "gadolinium gallium garnet (GGG), single crystal", "confidence": "low",
              "remarks": "coefficients not checked against the paper; they give n_D = 1.970, as handbooks print"}
    values = [Decimal(x) for x in ("0", "1.7727", "0.1567", "0.9767", "0.01375", "4.9668", "22.715")]
    lines = ['type = "sellmeier"', array("coefficients", values), array("range_nm", [Decimal(360), Decimal(6000)])]
    write("ior/Gd3Ga5O12/wood-nassau-1990", dataset("ior", source, sample, [("formula", lines)]))


if __name__ == "__main__":
    main()
