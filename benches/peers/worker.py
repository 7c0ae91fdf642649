"""Mitsuba with one variant in a process of its own, since a variant is chosen once: asked for renders, one after the other.

`Worker` is the side that asks. The vectorised variants need LLVM 17 or newer; `DRJIT_LIBLLVM_PATH` names its library if an older
one is found first.
"""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

# Debian's name of one that is new enough, unless told.
LIBLLVM = "/usr/lib/x86_64-linux-gnu/libLLVM.so.19.1"


class Worker:
    """One scene, seen from sensors of several samplers and sizes."""

    def __init__(self, variant, path, views, threads):
        self.folder = tempfile.TemporaryDirectory()
        self.output = Path(self.folder.name) / "picture.npy"
        self.variant = variant
        environment = dict(os.environ)
        if Path(LIBLLVM).exists():
            environment.setdefault("DRJIT_LIBLLVM_PATH", LIBLLVM)
        task = {"variant": variant, "path": str(path), "views": views, "threads": threads, "output": str(self.output)}
        self.process = subprocess.Popen(
            [sys.executable, __file__, json.dumps(task)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env=environment,
        )
        self.answer()

    def answer(self):
        line = self.process.stdout.readline()
        if not line:
            raise SystemExit(f"Mitsuba {self.variant} does not run here, see above; it needs libLLVM 17 to 20, as {LIBLLVM}")
        return json.loads(line)

    def render(self, samples, seed, view=0):
        from renderers import Render

        self.process.stdin.write(json.dumps({"samples": samples, "seed": seed, "view": view}) + "\n")
        self.process.stdin.flush()
        said = self.answer()
        return Render(np.load(self.output), **said)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.stdin.close()
        self.process.wait()
        self.folder.cleanup()


def main(variant, path, views, threads, output):
    import drjit
    import mitsuba as mi

    # Whatever else is printed must not be taken for an answer.
    answers, sys.stdout = sys.stdout, sys.stderr
    mi.set_variant(variant)
    drjit.set_thread_count(threads)
    import renderers
    import translate

    renderer = renderers.Mitsuba(translate.load(path), views=[(sampler, size) for sampler, size in views])

    def answer(**said):
        print(json.dumps(said), file=answers, flush=True)

    answer()
    compiled = set()
    for line in sys.stdin:
        asked = json.loads(line)
        key = asked["samples"], asked["view"]
        if "llvm" in variant and key not in compiled:
            # The first render of its kind compiles; that is not counted.
            renderer.render(**asked)
            compiled.add(key)
        render = renderer.render(**asked)
        np.save(output, render.picture)
        answer(cpu=render.cpu, wall=render.wall, alone=render.alone)


if __name__ == "__main__":
    main(**json.loads(sys.argv[1]))
