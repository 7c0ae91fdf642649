"""Both renderers behind the same call: a picture of XYZ in cd/m² from a scene, a number of samples and a seed."""

import os
import re
import resource
import subprocess
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import mitsuba as mi
import spectra
import translate

# What Mitsuba divides XYZ by (`MI_CIE_Y_NORMALIZATION`); its observer's integral is 106.857.
MITSUBA_CONSTANT = 106.7502593994140625
TO_CANDELA = spectra.LUMENS_PER_WATT * MITSUBA_CONSTANT

SPECTREL = Path(os.environ.get("SPECTREL", spectra.ROOT / "target" / "release" / "spectrel"))


@dataclass
class Render:
    picture: np.ndarray
    # Seconds of user and system time of all threads, and on the clock: of spectrel's whole process, of Mitsuba's render alone.
    cpu: float
    wall: float
    # Seconds on the clock of the render alone; of spectrel as it says itself, without loading, development and files.
    alone: float


# Below so many samples a pixel there is nothing to share out.
LEAST_SHARED = 16


class Spectrel:
    """With a folder of data to be searched before its own, and options of its command line; samples shared out or not."""

    def __init__(self, path, library=None, options=(), adaptive=False):
        self.path, self.adaptive = path, adaptive
        self.options = [*(["--library", library] if library else []), *options]

    def command(self, output, *more):
        return [str(word) for word in [SPECTREL, "render", self.path, "--exr-xyz", "-o", output, *self.options, *more]]

    def render(self, samples, seed, *more):
        with tempfile.TemporaryDirectory() as folder:
            output = Path(folder) / "picture.exr"
            shared = ["--adaptive=rmse"] if self.adaptive and samples >= LEAST_SHARED else []
            command = self.command(output, "--spp", samples, "--seed", seed, *shared, *more)
            before = children(), time.perf_counter()
            run = subprocess.run(command, stderr=subprocess.PIPE, text=True)
            cpu, wall = children() - before[0], time.perf_counter() - before[1]
            if run.returncode:
                raise SystemExit(run.stderr)
            return Render(color(mi.Bitmap(str(output))), cpu, wall, alone(run.stderr))

    def loading(self, *more):
        """One sample of one pixel: what is not rendering."""
        return self.render(1, 0, "--crop", "0,0,1,1", *more)


def alone(said):
    """Seconds of a render, from the line that says its size, samples and rate."""
    width, height, samples, rate = re.search(r"(\d+) × (\d+) pixels, (\d+) samples each: .* s, ([\d.]+) M samples/s", said).groups()
    return int(width) * int(height) * int(samples) / max(float(rate) * 1e6, 1.0)


def color(bitmap):
    """XYZ, which stands in channels called R, G and B (`src/image/exr.rs`), of a picture that may have others too."""
    layer = next(layer for name, layer in bitmap.split() if name == "<root>")
    return np.array(layer, dtype=np.float64)


class Mitsuba:
    """With sensors for `views`, see `translate.scene`."""

    def __init__(self, description, correlated=False, views=None):
        # Unoptimised, for merged shapes lose the names that regions go by.
        self.scene = mi.load_dict(translate.scene(description, correlated, views), optimize=False)

    def render(self, samples, seed, view=0):
        before = time.process_time(), time.perf_counter()
        picture = np.array(mi.render(self.scene, sensor=view, spp=samples, seed=seed), dtype=np.float64)
        cpu, wall = time.process_time() - before[0], time.perf_counter() - before[1]
        return Render(picture * TO_CANDELA, cpu, wall, wall)


def observer():
    """Mitsuba's own table of the 1931 observer, at its points."""
    nm = np.arange(spectra.RANGE_NM[0], spectra.RANGE_NM[1] + 1, 5)
    return nm, np.array([np.array(mi.cie1931_xyz(float(x))).ravel() for x in nm], dtype=np.float64)


def children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def version():
    run = subprocess.run([SPECTREL, "--version"], check=True, capture_output=True, text=True)
    return run.stdout.strip()


def versions():
    return version(), f"Mitsuba {mi.__version__}, variant `{mi.variant()}`"
