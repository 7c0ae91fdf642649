"""Both renderers behind the same call: a picture of XYZ in cd/m² from a scene, a number of samples and a seed."""

import os
import resource
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np

import mitsuba as mi
import spectra
import translate

# What Mitsuba divides XYZ by (`MI_CIE_Y_NORMALIZATION`); its observer's integral is 106.857.
MITSUBA_CONSTANT = 106.7502593994140625
TO_CANDELA = spectra.LUMENS_PER_WATT * MITSUBA_CONSTANT

SPECTREL = Path(os.environ.get("SPECTREL", spectra.ROOT / "target" / "release" / "spectrel"))


class Spectrel:
    """With a folder of data to be searched before its own, if one is given."""

    def __init__(self, path, library=None):
        self.path = path
        self.library = ["--library", library] if library else []

    def render(self, samples, seed):
        """The picture and the CPU seconds of the whole process."""
        with tempfile.TemporaryDirectory() as folder:
            output = Path(folder) / "picture.exr"
            command = [SPECTREL, "render", self.path, "--exr-xyz", "-q", "-o", output, *self.library]
            command += ["--spp", str(samples), "--seed", str(seed)]
            before = children()
            subprocess.run(command, check=True)
            seconds = children() - before
            bitmap = mi.Bitmap(str(output))
        # XYZ stands in channels called R, G and B, see `src/image/exr.rs`.
        return np.array(bitmap, dtype=np.float64), seconds


class Mitsuba:
    def __init__(self, description, correlated=False, sampler="multijitter"):
        # Unoptimised, for merged shapes lose the names that regions go by.
        self.scene = mi.load_dict(translate.scene(description, correlated, sampler), optimize=False)

    def render(self, samples, seed):
        before = time.process_time()
        picture = np.array(mi.render(self.scene, spp=samples, seed=seed), dtype=np.float64)
        return picture * TO_CANDELA, time.process_time() - before


def observer():
    """Mitsuba's own table of the 1931 observer, at its points."""
    nm = np.arange(spectra.RANGE_NM[0], spectra.RANGE_NM[1] + 1, 5)
    return nm, np.array([np.array(mi.cie1931_xyz(float(x))).ravel() for x in nm], dtype=np.float64)


def children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def versions():
    run = subprocess.run([SPECTREL, "--version"], check=True, capture_output=True, text=True)
    return run.stdout.strip(), f"Mitsuba {mi.__version__}, variant `{mi.variant()}`"
