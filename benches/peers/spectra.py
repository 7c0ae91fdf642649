"""Measured spectra as spectrel ships them: read from `spectra/` at run time, so that both renderers see the same numbers."""

import tomllib
from functools import cache
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
RANGE_NM = (360.0, 830.0)
LUMENS_PER_WATT = 683.0


@cache
def table(path):
    """The `[table]` of a data set as arrays, by its path below `spectra/`."""
    with open(ROOT / "spectra" / f"{path}.toml", "rb") as file:
        data = tomllib.load(file)
    if "table" not in data:
        raise SystemExit(f"{path}: only tables can be handed to a peer as they are, this is a formula")
    return {name: np.array(values) for name, values in data["table"].items()}


def held(nm, value):
    """A table that keeps its end values over the whole visible range, as spectrel reads n, k and reflectances."""
    low, high = RANGE_NM
    if nm[0] > low:
        nm, value = np.r_[low, nm], np.r_[value[0], value]
    if nm[-1] < high:
        nm, value = np.r_[nm, high], np.r_[value, value[-1]]
    return nm, value


def ior(name):
    data = table(f"ior/{name}")
    return tuple(held(data["wavelength_nm"], data[column]) for column in "nk")


def reflectance(name):
    data = table(f"reflectance/{name}")
    return held(data["wavelength_nm"], data["value"])


def illuminant(name):
    data = table(f"illuminant/{name.lower()}")
    return data["wavelength_nm"], data["value"]


def observer():
    data = table("observer/cie-1931-2")
    return data["wavelength_nm"], np.stack([data[column] for column in "xyz"], axis=1)


def integral(a, b):
    """∫ a b dλ over the visible range of two piecewise linear tables; `b` may have columns.

    Between neighbouring points of either the product is a parabola, which Simpson's rule integrates exactly.
    The illuminant ends where its table ends.
    """
    low, high = max(RANGE_NM[0], a[0][0], b[0][0]), min(RANGE_NM[1], a[0][-1], b[0][-1])
    nm = np.unique(np.concatenate([a[0], b[0], [low, high]]))
    nm = nm[(nm >= low) & (nm <= high)]

    def product(x):
        columns = np.atleast_2d(b[1].T)
        return np.stack([np.interp(x, *a) * np.interp(x, b[0], column) for column in columns])

    mid = (nm[1:] + nm[:-1]) / 2
    terms = product(nm[:-1]) + 4 * product(mid) + product(nm[1:])
    return (terms * np.diff(nm) / 6).sum(axis=1)


def emission(entry):
    """Spectral radiance in W m⁻² sr⁻¹ nm⁻¹ of a scene's `{ spectrum, radiance }`.

    The scenes state radiance rather than luminance, so that no observer has a say in the light.
    """
    nm, value = illuminant(entry["spectrum"])
    total = integral((nm, value), (np.array(RANGE_NM), np.ones(2)))[0]
    return nm, value * (entry["radiance"] / total)


OBSERVER_HEAD = """\
quantity = "observer"

[source]
title = "The 1931 observer at the points of a peer"
authors = "see the peer"
licence = "facts (published standard)"
origin = "asked of the peer at run time"

[sample]
description = "colour matching functions, linear in between"
confidence = "high"

[table]
"""


def write_observer(folder, nm, xyz):
    """A data folder for `spectrel --library` whose 1931 observer is this table."""
    path = folder / "spectra" / "observer" / "cie-1931-2.toml"
    path.parent.mkdir(parents=True, exist_ok=True)
    columns = zip(["wavelength_nm", *"xyz"], [nm, *xyz.T])
    lines = [f"{name} = [{', '.join(repr(float(x)) for x in column)}]\n" for name, column in columns]
    path.write_text(OBSERVER_HEAD + "".join(lines))
