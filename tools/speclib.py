"""Shared by the importers: number formatting and the TOML layout of a data set."""

import json
from decimal import Decimal
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
SPECTRA = ROOT / "spectra"


def decimal32(x):
    """The shortest decimal that rounds to the float32 `x`."""
    return Decimal(str(np.float32(x)))


def number(x):
    """A TOML float: always with a point or an exponent."""
    if isinstance(x, Decimal):
        x = x.normalize()
        text = format(x, "f") if x == 0 or abs(x) >= Decimal("1e-3") else format(x, "e")
    else:
        text = repr(float(x))
    if "." not in text and "e" not in text.lower():
        text += ".0"
    return text.replace("E", "e").replace("e+", "e")


def array(name, values):
    """`name = [...]` wrapped below 120 characters."""
    lines, line = [f"{name} = ["], "   "
    for value in values:
        text = f" {number(value)},"
        if len(line) + len(text) > 116:
            lines.append(line)
            line = "   "
        line += text
    lines += [line, "]"]
    short = f"{name} = [{', '.join(number(v) for v in values)}]"
    return short if len(short) <= 100 else "\n".join(lines)


def fields(table, keys):
    """The given keys of a dictionary, in this order, those that are there."""
    out = []
    for key in keys:
        value = table.get(key)
        if value is None or value == "":
            continue
        if isinstance(value, str):
            out.append(f"{key} = {json.dumps(value, ensure_ascii=False)}")
        elif isinstance(value, int):
            out.append(f"{key} = {value}")
        else:
            out.append(f"{key} = {number(value)}")
    return "\n".join(out)


SOURCE_KEYS = ("title", "authors", "journal", "year", "doi", "licence", "origin")
SAMPLE_KEYS = ("description", "method", "temperature_k", "thickness_nm", "confidence", "remarks")


def dataset(quantity, source, sample, sections):
    """The text of one file. `sections`: list of (name, [line, ...])."""
    parts = [f'quantity = "{quantity}"', "", "[source]", fields(source, SOURCE_KEYS), "", "[sample]"]
    parts.append(fields(sample, SAMPLE_KEYS))
    for name, lines in sections:
        parts += ["", f"[{name}]", *lines]
    return "\n".join(parts) + "\n"


def write(relative, text):
    path = SPECTRA / f"{relative}.toml"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path
