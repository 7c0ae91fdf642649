"""Checks spectra/ and materials/: format, order, signs, sources, references, names. Exits with 1 if something is wrong.

    python tools/check_library.py            # problems, counts, and what does not cover the visible
    python tools/check_library.py --values   # also n, k at 589.3 nm and the reflectance there
"""

import math
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SPECTRA, MATERIALS = ROOT / "spectra", ROOT / "materials"
VISIBLE, OBSERVER = (380.0, 780.0), (360.0, 830.0)

SOURCE = {"title": str, "authors": str, "journal": str, "year": int, "doi": str, "licence": str, "origin": str}
SAMPLE = {"description": str, "method": str, "temperature_k": float, "thickness_nm": float, "confidence": str, "remarks": str}
FOLDERS = {"ior": "ior", "absorption": "absorption", "reflectance": "reflectance", "illuminant": "illuminant",
           "observer": "observer"}
FORMULAS = ("sellmeier", "sellmeier-2", "polynomial", "rii", "cauchy", "gases", "herzberger", "retro", "exotic")

problems, short, flagged = [], [], []


def formula(kind, c, um):
    """n of a formula of refractiveindex.info at a wavelength in micrometres."""
    w2 = um * um
    pairs = list(zip(c[1::2], c[2::2]))
    if kind == "sellmeier":
        return math.sqrt(1 + c[0] + sum(b * w2 / (w2 - d * d) for b, d in pairs))
    if kind == "sellmeier-2":
        return math.sqrt(1 + c[0] + sum(b * w2 / (w2 - d) for b, d in pairs))
    if kind == "polynomial":
        return math.sqrt(c[0] + sum(b * um**e for b, e in pairs))
    if kind == "rii":
        fractions = sum(c[i] * um ** c[i + 1] / (w2 - c[i + 2] ** c[i + 3]) for i in (1, 5))
        return math.sqrt(c[0] + fractions + sum(b * um**e for b, e in zip(c[9::2], c[10::2])))
    if kind == "cauchy":
        return c[0] + sum(b * um**e for b, e in pairs)
    if kind == "gases":
        return 1 + c[0] + sum(b / (d - 1 / w2) for b, d in pairs)
    raise ValueError(f"{kind}: no set uses it yet")


def interpolate(x, y, at):
    if at <= x[0]:
        return y[0]
    for a, b, c, d in zip(x, x[1:], y, y[1:]):
        if at <= b:
            return c + (d - c) * (at - a) / (b - a)
    return y[-1]


def keys(where, table, allowed, required):
    for key, value in table.items():
        if key not in allowed:
            problems.append(f"{where}: unknown key {key}")
        elif not isinstance(value, allowed[key]):
            problems.append(f"{where}: {key} should be {allowed[key].__name__}")
    for key in required:
        if not table.get(key):
            problems.append(f"{where}: {key} is missing")


def columns(where, table, names, optional=()):
    """The grid is strictly increasing, all columns have its length, every number is a finite float."""
    for name in table:
        if name not in (*names, *optional):
            problems.append(f"{where}: unknown column {name}")
    grid = table["wavelength_nm"]
    if any(b <= a for a, b in zip(grid, grid[1:])) or len(grid) < 2:
        problems.append(f"{where}: wavelengths do not increase strictly")
    for name, values in table.items():
        if len(values) != len(grid):
            problems.append(f"{where}: {name} has {len(values)} values for {len(grid)} wavelengths")
        if not all(isinstance(v, float) and math.isfinite(v) for v in values):
            problems.append(f"{where}: {name} is not all finite floats")
    for name in names:
        if name not in table:
            problems.append(f"{where}: {name} is missing")
    return grid


def check_ior(where, data):
    sections = {"table", "formula", "k_table"} & set(data)
    if "table" in sections:
        if sections != {"table"}:
            problems.append(f"{where}: a table stands alone")
        table = data["table"]
        grid = columns(where, table, ("wavelength_nm", "n"), ("k",))
        n, k, spans = table["n"], table.get("k", [0.0]), [(grid[0], grid[-1])]
    else:
        f = data["formula"]
        keys(where, f, {"type": str, "coefficients": list, "range_nm": list}, ("type", "coefficients", "range_nm"))
        if f["type"] not in FORMULAS:
            problems.append(f"{where}: unknown formula {f['type']}")
        low, high = f["range_nm"]
        steps = [*range(math.ceil(max(low, 300)), int(min(high, 1000)) + 1, 5), *range(360, 831, 5)]
        n = [formula(f["type"], f["coefficients"], w / 1000) for w in steps]
        k, spans = [0.0], [(low, high)]
        if "k_table" in sections:
            k_grid = columns(where, data["k_table"], ("wavelength_nm", "k"))
            k, spans = data["k_table"]["k"], [*spans, (k_grid[0], k_grid[-1])]
    if not all(math.isfinite(x) and x > 0 for x in n) or not all(x >= 0 for x in k):
        problems.append(f"{where}: n > 0 and k >= 0 do not hold")
    return max(s[0] for s in spans), min(s[1] for s in spans)


def check_absorption(where, data):
    a = data["absorption"]
    keys(where, a, {"unit": str, "base": str}, ("unit", "base"))
    if a["unit"] not in ("1/m", "1/cm", "1/mm") or a["base"] not in ("e", "10"):
        problems.append(f"{where}: unit or base")
    if ("table" in data) == ("bands" in data):
        problems.append(f"{where}: either a table or bands")
    for band in data.get("bands", ()):
        keys(where, band, {"center_nm": float, "fwhm_nm": float, "peak": float, "source": str},
             ("center_nm", "fwhm_nm", "peak", "source"))
    if "table" not in data:
        return OBSERVER
    grid = columns(where, data["table"], ("wavelength_nm", "value"))
    if min(data["table"]["value"]) < 0:
        problems.append(f"{where}: negative absorption")
    return grid[0], grid[-1]


def check_spectrum(path):
    where = str(path.relative_to(SPECTRA))
    data = tomllib.loads(path.read_text(encoding="utf-8"))
    if not where.isascii():
        problems.append(f"{where}: the name is not ASCII")
    quantity = data["quantity"]
    if FOLDERS.get(quantity) != path.relative_to(SPECTRA).parts[0]:
        problems.append(f"{where}: is {quantity}")
    for key in data:
        if key not in ("quantity", "source", "sample", "table", "formula", "k_table", "absorption", "bands"):
            problems.append(f"{where}: unknown section {key}")
    keys(where, data["source"], SOURCE, ("title", "authors", "licence", "origin"))
    keys(where, data["sample"], SAMPLE, ("description", "confidence"))
    if data["sample"]["confidence"] not in ("high", "medium", "low", "modelled"):
        problems.append(f"{where}: confidence")
    if quantity == "ior":
        low, high = check_ior(where, data)
    elif quantity == "absorption":
        low, high = check_absorption(where, data)
    else:
        names = ("x", "y", "z") if quantity == "observer" else ("value",)
        grid = columns(where, data["table"], ("wavelength_nm", *names))
        low, high = grid[0], grid[-1]
        values = [v for name in names for v in data["table"][name]]
        if min(values) < 0 or (quantity == "reflectance" and max(values) > 1):
            problems.append(f"{where}: values out of range")
    if low > VISIBLE[0] or high < VISIBLE[1]:
        short.append(f"{where[:-5]}: {low:g} to {high:g} nm")
    elif low > OBSERVER[0] or high < OBSERVER[1]:
        flagged.append(f"{where[:-5]}: {low:g} to {high:g} nm")
    if any(len(line) >= 120 for line in path.read_text(encoding="utf-8").split("\n") if line.startswith("    ")):
        problems.append(f"{where}: an array line is too long")
    return where[:-5], data


def check_materials(sets):
    names = {}
    for path in sorted(MATERIALS.glob("*.toml")):
        where = f"materials/{path.name}"
        data = tomllib.loads(path.read_text(encoding="utf-8"))
        kinds = [k for k in ("conductor", "dielectric", "diffuse") if k in data]
        if len(kinds) != 1 or set(data) - {"description", "aliases", *kinds} or not data.get("description"):
            problems.append(f"{where}: sections")
            continue
        body = data[kinds[0]]
        allowed = {"conductor": {"ior"}, "dielectric": {"ior", "absorption"}, "diffuse": {"reflectance"}}[kinds[0]]
        if set(body) - allowed or not set(body) & {"ior", "reflectance"}:
            problems.append(f"{where}: keys")
        for key, value in body.items():
            if f"{key}/{value}" not in sets:
                problems.append(f"{where}: no {key}/{value}")
        if kinds[0] == "dielectric" and "absorption" in body:
            ior = sets[f"ior/{body['ior']}"]
            if "k" in ior.get("table", {}) or "k_table" in ior:
                problems.append(f"{where}: absorption beside an index that has k")
        if kinds[0] == "dielectric":
            ior = sets.get(f"ior/{body['ior']}", {})
            table = ior.get("k_table") or ior.get("table")
            if table and "k" in table:
                worst = max(k for w, k in zip(table["wavelength_nm"], table["k"]) if 400 <= w <= 780)
                if worst > 1e-3:
                    problems.append(f"{where}: k up to {worst:g} in the visible: not a dielectric")
        for name in (path.stem, *data.get("aliases", ())):
            if name in names:
                problems.append(f"{where}: {name} is also {names[name]}")
            names[name] = path.stem
    required = (Path(__file__).parent / "required_names.txt").read_text().split("\n")
    for name in required:
        if name and not name.startswith("#") and name not in names:
            problems.append(f"no material is called {name}")
    return names


def main():
    paths = sorted(SPECTRA.rglob("*.toml"))
    sets = dict(check_spectrum(path) for path in paths)
    names = check_materials(sets)
    size = sum(path.stat().st_size for path in paths)
    counts = {q: sum(d["quantity"] == q for d in sets.values()) for q in FOLDERS}
    print(f"{len(sets)} data sets, {size / 1e6:.2f} MB: " + ", ".join(f"{c} {q}" for q, c in counts.items()))
    print(f"{len(set(names.values()))} materials with {len(names)} names")
    print("largest: " + ", ".join(f"{p.stem} {p.stat().st_size // 1000} kB" for p in
                                   sorted(paths, key=lambda p: -p.stat().st_size)[:4]))
    print(f"{len(short)} sets do not cover 380-780 nm:\n  " + "\n  ".join(short))
    print(f"{len(flagged)} more do not cover 360-830 nm:\n  " + "\n  ".join(flagged))
    if "--values" in sys.argv:
        for name, data in sets.items():
            if data["quantity"] != "ior":
                continue
            if "table" in data:
                t = data["table"]
                n = interpolate(t["wavelength_nm"], t["n"], 589.3)
                k = interpolate(t["wavelength_nm"], t["k"], 589.3) if "k" in t else 0.0
            else:
                n = formula(data["formula"]["type"], data["formula"]["coefficients"], 0.5893)
                t = data.get("k_table")
                k = interpolate(t["wavelength_nm"], t["k"], 589.3) if t else 0.0
            r = ((n - 1) ** 2 + k * k) / ((n + 1) ** 2 + k * k)
            print(f"{name:48} n {n:8.5f}  k {k:10.4g}  R {r:.4f}")
    for problem in problems:
        print("WRONG:", problem)
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
