"""Writes the CIE observers and illuminants and the ColorChecker reflectances into spectra/.

    pip install colour-science numpy
    python tools/import_cie.py

The tables are copied at their published step. Two are ours beyond the package's table: illuminant A is continued from
785 to 830 nm by its defining formula, and E is 1 from 300 to 830 nm.
"""

import math
import warnings

warnings.filterwarnings("ignore")
import colour  # noqa: E402

from speclib import array, dataset, write  # noqa: E402

CIE = {"licence": "facts (published standard)", "authors": "Commission Internationale de l'Eclairage (CIE)"}
LED = {"LED-B1": "blue-pumped phosphor LED, about 2733 K", "LED-B2": "blue-pumped phosphor LED, about 2998 K",
       "LED-B3": "blue-pumped phosphor LED, about 4103 K", "LED-B4": "blue-pumped phosphor LED, about 5109 K",
       "LED-B5": "blue-pumped phosphor LED, about 6598 K"}
FL = {1: "standard fluorescent lamp, daylight", 2: "standard fluorescent lamp, cool white",
      3: "standard fluorescent lamp, white", 4: "standard fluorescent lamp, warm white",
      5: "standard fluorescent lamp, daylight", 6: "standard fluorescent lamp, light white",
      7: "broad-band fluorescent lamp, simulating D65", 8: "broad-band fluorescent lamp, simulating D50",
      9: "broad-band fluorescent lamp, cool white deluxe", 10: "three-band fluorescent lamp, about 5000 K",
      11: "three-band fluorescent lamp, about 4000 K", 12: "three-band fluorescent lamp, about 3000 K"}


def observers():
    for key, name, title, year in (
        ("cie-1931-2", "CIE 1931 2 Degree Standard Observer", "CIE 1931 standard colorimetric observer, 2 degrees", 1931),
        ("cie-1964-10", "CIE 1964 10 Degree Standard Observer", "CIE 1964 standard colorimetric observer, 10 degrees",
         1964),
        ("cie-2015-2", "CIE 2015 2 Degree Standard Observer",
         "CIE 2015 cone-fundamental-based colour matching functions, 2 degrees", 2015),
    ):
        cmfs = colour.MSDS_CMFS[name]
        source = CIE | {"title": title, "year": year, "origin": f"colour-science: {name}"}
        if year != 2015:
            source["journal"] = "ISO/CIE 11664-1"
        else:
            source["journal"] = "CIE 170-2:2015"
        sample = {"description": "colour matching functions at 1 nm", "confidence": "high"}
        lines = [array("wavelength_nm", cmfs.wavelengths)]
        lines += [array(c, cmfs.values[:, i]) for i, c in enumerate("xyz")]
        write(f"observer/{key}", dataset("observer", source, sample, [("table", lines)]))


def illuminant(key, title, description, wavelengths, values, origin, remarks=None):
    source = CIE | {"title": title, "origin": origin,
                    "journal": "CIE 15" if key != "e" else None}
    sample = {"description": description, "confidence": "high", "remarks": remarks}
    lines = [array("wavelength_nm", wavelengths), array("value", values)]
    write(f"illuminant/{key}", dataset("illuminant", source, sample, [("table", lines)]))


def illuminants():
    def table(name):
        sd = colour.SDS_ILLUMINANTS[name]
        return [float(w) for w in sd.wavelengths], [float(v) for v in sd.values]

    w, v = table("A")
    planck = lambda nm: 1 / (nm**5 * (math.exp(1.435e7 / (2848 * nm)) - 1))
    more = [float(x) for x in range(785, 835, 5)]
    v += [round(100 * planck(x) / planck(560), 3) for x in more]
    illuminant("a", "CIE standard illuminant A", "incandescent lamp, 2856 K", w + more, v, "colour-science: A",
               "up to 780 nm the published table; 785 to 830 nm by the formula that defines the illuminant")
    for name, kelvin in (("D50", 5003), ("D55", 5503), ("D65", 6504), ("D75", 7504)):
        kind = "standard" if name in ("D50", "D65") else "daylight"
        illuminant(name.lower(), f"CIE {kind} illuminant {name}", f"daylight phase, about {kelvin} K", *table(name),
                   f"colour-science: {name}", "the published 5 nm table, 300 to 780 nm")
    grid = [300.0, 830.0]
    illuminant("e", "CIE equal-energy illuminant E", "constant spectral power", grid, [1.0, 1.0], "by definition")
    for i, text in FL.items():
        illuminant(f"fl{i}", f"CIE fluorescent illuminant FL{i}", text, *table(f"FL{i}"), f"colour-science: FL{i}",
                   "tabulated means over 5 nm: the mercury lines are spread over their intervals")
    for name, text in LED.items():
        illuminant(name.lower(), f"CIE LED illuminant {name}", text, *table(name), f"colour-science: {name}")


PATCHES = ("dark-skin light-skin blue-sky foliage blue-flower bluish-green orange purplish-blue moderate-red purple "
           "yellow-green orange-yellow blue green red yellow magenta cyan white neutral-8 neutral-6.5 neutral-5 "
           "neutral-3.5 black").split()


def patches():
    for key, (name, sd) in zip(PATCHES, colour.SDS_COLOURCHECKERS["ColorChecker N Ohta"].items(), strict=True):
        source = {"title": "The Basis of Color Reproduction Engineering: reflectance of the ColorChecker chart",
                  "authors": "N. Ohta", "year": 1997, "licence": "facts (measured values)",
                  "origin": f"colour-science: ColorChecker N Ohta, {name}"}
        sample = {"description": f"ColorChecker patch: {name}", "method": "spectrophotometry", "confidence": "high",
                  "remarks": "one chart of the pre-2014 formulation; individual charts differ"}
        lines = [array("wavelength_nm", [float(w) for w in sd.wavelengths]),
                 array("value", [float(x) for x in sd.values])]
        write(f"reflectance/colorchecker/{key.replace('.', '-')}",
              dataset("reflectance", source, sample, [("table", lines)]))


if __name__ == "__main__":
    observers()
    illuminants()
    patches()
