"""Prints the colour of white light after 2, 5, 10 and 20 mm of each file of spectra/absorption (no surface losses).

    pip install colour-science numpy
    python tools/preview_absorption.py

sRGB in hexadecimal, under D65 and, for colour change, under A (adapted to A by Bradford).
"""

import tomllib
import warnings
from pathlib import Path

import numpy as np

warnings.filterwarnings("ignore")
import colour  # noqa: E402

SPECTRA = Path(__file__).resolve().parent.parent / "spectra"
GRID = np.arange(380.0, 781.0)
PER_M = {"1/m": 1.0, "1/cm": 100.0, "1/mm": 1000.0}


def alpha(data):
    """Absorption in 1/m, natural logarithm."""
    scale = PER_M[data["absorption"]["unit"]] * (1.0 if data["absorption"]["base"] == "e" else np.log(10.0))
    if "table" in data:
        return scale * np.interp(GRID, data["table"]["wavelength_nm"], data["table"]["value"])
    total = sum(b["peak"] * np.exp(-4 * np.log(2) * ((GRID - b["center_nm"]) / b["fwhm_nm"]) ** 2) for b in data["bands"])
    return scale * total


def srgb(transmittance, light):
    cmfs = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
    xyz = np.array([np.interp(GRID, cmfs.wavelengths, cmfs.values[:, i]) for i in range(3)])
    sd = colour.SDS_ILLUMINANTS[light]
    power = np.interp(GRID, sd.wavelengths, sd.values)
    white = xyz @ power
    value = xyz @ (power * transmittance) / white[1]
    value = colour.adaptation.chromatic_adaptation_VonKries(
        value, white / white[1], colour.xy_to_XYZ([0.3127, 0.3290]), transform="Bradford")
    rgb = np.clip(colour.XYZ_to_sRGB(value), 0, 1)
    return "#" + "".join(f"{round(c * 255):02x}" for c in rgb)


if __name__ == "__main__":
    for path in sorted((SPECTRA / "absorption").glob("*.toml")):
        a = alpha(tomllib.loads(path.read_text(encoding="utf-8")))
        line = [f"{light} " + " ".join(srgb(np.exp(-a * mm / 1000), light) for mm in (2, 5, 10, 20)) for light in ("D65", "A")]
        print(f"{path.stem:16}", "   ".join(line))
