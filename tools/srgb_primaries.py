"""Writes three reflectances whose colours under D65 are red, green and blue of linear sRGB into spectra/reflectance/srgb/.

    pip install numpy osqp scipy
    python tools/srgb_primaries.py

The smoothest ones (least sum of squared differences of neighbours) within 0 to 1 that add up to 1 at every wavelength: the quadratic
programme of I. Mallett and C. Yuksel, "Spectral primary decomposition for rendering with sRGB reflectance" (EGSR 2019), solved here
for 5 nm steps from the committed D65 and observer. Beyond 780 nm, where D65 ends, smoothness alone decides.
"""

import tomllib
from pathlib import Path

import numpy as np
import osqp
from scipy import sparse

from speclib import array, dataset, write

ROOT = Path(__file__).resolve().parent.parent
KNOTS = np.arange(360.0, 831.0, 5.0)
FINE = np.arange(360.0, 830.25, 0.5)
PRIMARIES = ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06))
WHITE = (0.3127, 0.3290)
BRADFORD = np.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])


def table(path):
    return tomllib.loads((ROOT / "spectra" / path).read_text())


def xyz(x, y):
    return np.array([x / y, 1.0, (1 - x - y) / y])


def rgb_from_xyz(white):
    """Linear sRGB of XYZ under a light of this white, adapted by Bradford."""
    columns = np.array([xyz(*p) for p in PRIMARIES]).T
    matrix = columns * np.linalg.solve(columns, xyz(*WHITE))
    gains = (BRADFORD @ xyz(*WHITE)) / (BRADFORD @ white)
    adapt = np.linalg.inv(BRADFORD) @ np.diag(gains) @ BRADFORD
    return np.linalg.inv(matrix) @ adapt


def weights():
    """What a reflectance that is linear between the knots adds to linear sRGB by its value at each knot: 3 rows."""
    light = table("illuminant/d65.toml")["table"]
    observer = table("observer/cie-1931-2.toml")["table"]
    at = lambda values, nm: np.interp(FINE, nm, values, left=0.0, right=0.0)
    power = at(light["value"], light["wavelength_nm"])
    seen = np.array([at(observer[k], observer["wavelength_nm"]) * power for k in ("x", "y", "z")])
    # Between whole nanometres the product of the three tables is a cubic, for which Simpson's rule is exact.
    step = np.tile([1 / 3, 2 / 3], FINE.size // 2 + 1)[: FINE.size]
    step[[0, -1]] = 1 / 6
    hats = np.array([np.interp(FINE, KNOTS, row) for row in np.eye(KNOTS.size)])
    sums = (seen * step) @ hats.T
    sums /= sums[1].sum()
    return rgb_from_xyz(sums.sum(axis=1)) @ sums


def solve():
    n = KNOTS.size
    difference = sparse.diags([-np.ones(n - 1), np.ones(n - 1)], [0, 1], shape=(n - 1, n))
    smooth = sparse.block_diag([difference.T @ difference] * 3)
    color = sparse.block_diag([sparse.csc_matrix(weights())] * 3)
    total = sparse.hstack([sparse.eye(n)] * 3)
    rows = sparse.vstack([color, total, sparse.eye(3 * n)]).tocsc()
    low = np.concatenate([np.eye(3).ravel(), np.ones(n), np.zeros(3 * n)])
    high = np.concatenate([np.eye(3).ravel(), np.ones(n), np.ones(3 * n)])
    solver = osqp.OSQP()
    solver.setup(smooth.tocsc(), np.zeros(3 * n), rows, low, high, eps_abs=1e-9, eps_rel=1e-9, max_iter=400000, polishing=True,
                 verbose=False)
    found = solver.solve()
    print(found.info.status, "residual", np.abs(color @ found.x - np.eye(3).ravel()).max())
    return found.x.reshape(3, n)


def main():
    for name, values in zip(("red", "green", "blue"), solve()):
        source = {"title": f"Smoothest reflectance that is {name} of linear sRGB under D65", "licence": "CC0 (computed)",
                  "authors": "spectrel, after I. Mallett and C. Yuksel (2019)", "origin": "tools/srgb_primaries.py"}
        sample = {"description": f"one of three reflectances with the sum 1: the {name} primary", "confidence": "modelled",
                  "method": "quadratic programme over values every 5 nm"}
        lines = [array("wavelength_nm", KNOTS), array("value", np.round(np.clip(values, 0.0, 1.0), 7))]
        write(f"reflectance/srgb/{name}", dataset("reflectance", source, sample, [("table", lines)]))


if __name__ == "__main__":
    main()
