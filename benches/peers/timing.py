"""Error against CPU time of both renderers, with a reference that both agree on.

The vectorised variants of Mitsuba need LLVM 17 or newer; `DRJIT_LIBLLVM_PATH` names its library if an older one is found first.
Run as a script it renders with one variant of Mitsuba in a process of its own, since a variant is chosen once.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

SAMPLES = 256
# Far apart: Mitsuba adds the number of a picture's block to its seed.
SEEDS = [1100, 1200, 1300, 1400, 1500]
PEERS = [
    ("scalar_spectral", "independent"),
    ("scalar_spectral", "multijitter"),
    ("llvm_ad_spectral", "independent"),
    ("llvm_ad_spectral", "multijitter"),
]


class Reference:
    """The mean of both renderers' pictures, and how large its own error still is."""

    def __init__(self, ours, theirs):
        both = [np.array(ours), np.array(theirs)]
        self.picture = sum(pictures.mean(axis=0) for pictures in both) / 2
        self.scale = self.picture.mean(axis=(0, 1))
        noise = sum(pictures.var(axis=0, ddof=1) / len(pictures) for pictures in both) / 4
        self.mse = (noise / self.scale**2).mean()

    def error(self, picture):
        """Mean square over pixels and channels, each channel in units of its mean, less what the reference adds."""
        return (((picture - self.picture) / self.scale) ** 2).mean() - self.mse


def measure(path, ours, theirs, library):
    """Rows of a name, CPU seconds of a render and its mean square error; None where a variant does not run."""
    from renderers import Spectrel

    reference = Reference(ours, theirs)

    def row(name, results):
        return name, np.median([seconds for _, seconds in results]), np.mean([reference.error(p) for p, _ in results])

    renderer = Spectrel(path, library)
    rows = [row("spectrel", [renderer.render(SAMPLES, seed) for seed in SEEDS])]
    for variant, sampler in PEERS:
        name = f"Mitsuba {variant}, {sampler}"
        with tempfile.TemporaryDirectory() as folder:
            output = Path(folder) / "results.npz"
            command = [sys.executable, __file__, variant, sampler, path, output]
            run = subprocess.run(command, stderr=subprocess.DEVNULL)
            if run.returncode != 0:
                rows.append((name, None, None))
                continue
            data = np.load(output)
            rows.append(row(name, list(zip(data["pictures"], data["seconds"]))))
    return rows


def table(name, rows):
    """Efficiency is 1 / (MSE × CPU s), here against the first row."""
    lines = [
        f"### {name[0].upper()}{name[1:]}",
        "",
        "| renderer | CPU s | MSE | spectrel is more efficient by |",
        "|---|--:|--:|--:|",
    ]
    own = rows[0][1] * rows[0][2]
    for title, seconds, mse in rows:
        if seconds is None:
            lines.append(f"| {title} | does not run here | | |")
        else:
            lines.append(f"| {title} | {seconds:.3f} | {mse:.3e} | {seconds * mse / own:.2f} × |")
    return "\n".join(lines) + "\n"


def main(variant, sampler, path, output):
    import mitsuba as mi

    mi.set_variant(variant)
    import renderers
    import translate

    renderer = renderers.Mitsuba(translate.load(path), sampler=sampler)
    # The first render compiles, where a variant does; that is not counted.
    renderer.render(SAMPLES, 1)
    results = [renderer.render(SAMPLES, seed) for seed in SEEDS]
    np.savez(output, pictures=[p for p, _ in results], seconds=[s for _, s in results])


if __name__ == "__main__":
    main(*sys.argv[1:])
