"""What ways of rendering with spectrel cost against each other, by pairs of renders made one after the other."""

import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np

from renderers import Spectrel

PAIRS = 7
SIZE = ["--width", 512, "--height", 512]
DISPERSIVE = ["--ior", "stone=C/peter-1923"]
# Nothing but stone, in the middle of the picture of that size.
STONE = [*SIZE, "--crop", "190,210,322,338", *DISPERSIVE]
REPLICATES = 8


def measure(scene, references, threads, quick, tell):
    """Rows of what, the bar, the ratio and the least and largest of the pairs. `scene` gives the file of a name."""
    pairs, share = (3, 4) if quick else (PAIRS, 1)

    def pair(what, bar, name, samples, new, old, of="cpu"):
        tell(f"{what}, {pairs} pairs")
        renderer = Spectrel(scene(name), options=["--threads", threads])
        samples = max(samples // share, 1)
        ratios = []
        for i in range(pairs):
            a, b = (getattr(renderer.render(samples, i, *options), of) for options in (new, old))
            ratios.append(a / b)
        return {"what": what, "bar": bar, "ratio": float(np.median(ratios)), "range": [min(ratios), max(ratios)]}

    def faster(what, bar, name, samples):
        renderer = Spectrel(scene(name))
        tell(f"{what}, {pairs} pairs")
        ratios = []
        for i in range(pairs):
            one, two = (renderer.render(max(samples // share, 1), i, *SIZE, "--threads", n).wall for n in (1, 2))
            ratios.append(one / two)
        return {"what": what, "bar": bar, "ratio": float(np.median(ratios)), "range": [min(ratios), max(ratios)]}

    def machine(what, name, samples):
        tell(f"{what}, {pairs} pairs")
        path, options = scene(name), [*SIZE, "--threads", 1, "--spp", max(samples // share, 1)]
        ratios = [2 * together(path, options, 1) / together(path, options, 2) for _ in range(pairs)]
        return {"what": what, "bar": None, "ratio": float(np.median(ratios)), "range": [min(ratios), max(ratios)]}

    one = ["--lanes", 1]
    rows = [
        pair("exact against Schlick, metals: CPU time", "≤ 1.03", "metals", 32, SIZE, [*SIZE, "--fresnel", "schlick"]),
        pair("8 lanes against 1, metals: CPU time", "≤ 1.15", "metals", 32, SIZE, [*SIZE, *one]),
        pair("8 lanes against 1, inside the dispersive diamond: CPU time", "≤ 1.6", "stone", 64, STONE, [*STONE, *one]),
        pair("8 lanes against 1, the diamond and what is around it: CPU time", None, "diamond", 64, STONE, [*STONE, *one]),
        faster("one thread against two, metals, 256 samples: time on the clock", "≥ 1.9", "metals", 256),
        machine("the same of two renders at once, one thread each: what the machine has", "metals", 256),
        faster("one thread against two, mesh with its loading, 16 samples: time on the clock", "≥ 1.9", "mesh", 16),
        memory(scene("cornell"), 512 if quick else 8192, threads, tell),
    ]
    return rows + [nets(scene, name, reference, options, quick, tell) for name, options, reference in references]


def together(path, options, count):
    """Seconds on the clock of so many renders that begin at once and share nothing."""
    with tempfile.TemporaryDirectory() as folder:
        before = time.perf_counter()
        pictures = [Path(folder) / f"{number}.exr" for number in range(count)]
        processes = [subprocess.Popen(Spectrel(path).command(picture, "-q", *options)) for picture in pictures]
        assert all(process.wait() == 0 for process in processes)
        return time.perf_counter() - before


def memory(path, samples, threads, tell):
    """Resident memory of a long render when the last tenth of it begins, over that after the first."""
    what = f"memory at 90 % over that at 10 % of a render, cornell, {samples} samples a pixel"
    tell(what)
    with tempfile.TemporaryDirectory() as folder:
        command = Spectrel(path, options=["--threads", threads]).command(Path(folder) / "p.exr", "--spp", samples)
        process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
        found = {}
        for line in process.stderr:
            percent = line.split("%")[0].strip()
            if percent in ("10", "90"):
                found[percent] = resident(process.pid)
        process.wait()
    ratio = found["90"] / found["10"]
    return {"what": what, "bar": "≤ 1.01", "ratio": ratio, "range": None, "note": f"{found['90'] / 1024:.1f} MiB"}


def resident(process):
    """KiB."""
    lines = Path(f"/proc/{process}/status").read_text().splitlines()
    return int(next(line for line in lines if line.startswith("VmRSS")).split()[1])


def nets(scene, name, reference, options, quick, tell):
    """What `--target-error` pays for its eight independent replicates: the MSE of the mean of eight renders of n/8 samples
    with seeds of their own over that of one render of n."""
    samples, repeats = (64, 2) if quick else (256, 4)
    what = f"MSE of {REPLICATES} nets of {samples // REPLICATES} samples over one of {samples}, {name}"
    tell(what)
    renderer = Spectrel(scene(name.split(",")[0]), options=options)

    def mean_mse(count, seed):
        pictures = [renderer.render(samples // count, seed + i).picture for i in range(count)]
        return reference.mse(np.mean(pictures, axis=0))

    ratios = [(mean_mse(REPLICATES, 5000 + 100 * i), mean_mse(1, 6000 + i)) for i in range(repeats)]
    several, one = np.mean(ratios, axis=0)
    each = [a / b for a, b in ratios]
    return {"what": what, "bar": None, "ratio": float(several / one), "range": [min(each), max(each)]}
