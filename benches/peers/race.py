"""One scene after the other: both renderers ready for it, their references, and their turns."""

import hashlib
import shutil

import numpy as np

import errors
import own
import renderers
import results
import solids
import translate
from environment import HERE, WORK
from worker import Worker

COUNTS = [1, 4, 16, 64, 256]
# Independent samples a pixel, by each renderer, and of each of its renders: spectrel starts anew for each, Mitsuba has them in memory.
REFERENCE, OWN_PART, PEER_PART = 8192, 1024, 256
SAMPLERS = ["independent", "multijitter"]
VARIANTS = ["scalar_spectral", "llvm_ad_spectral"]


def tell(line):
    print(f"  {line}", flush=True)


def copied(name, sampler=None):
    """The scene's file, beside the meshes that it names, with a sampler that the command line cannot choose."""
    folder = WORK / "scenes"
    folder.mkdir(parents=True, exist_ok=True)
    text = (HERE / f"{name}.toml").read_text()
    torus, made_by = folder / "torus.ply", HERE / "solids.py"
    if torus.name in text and (not torus.exists() or torus.stat().st_mtime < made_by.stat().st_mtime):
        solids.write_ply(torus, *solids.displaced_torus())
    if sampler is not None:
        assert "[render]\n" in text
        text = text.replace("[render]\n", f'[render]\nsampler = "{sampler}"\n')
    path = folder / (f"{name}.toml" if sampler is None else f"{name}-{sampler}.toml")
    path.write_text(text)
    return path


def shaped(pixels, size):
    """About so many pixels, in this shape."""
    factor = (pixels / (size[0] * size[1])) ** 0.5
    return [round(side * factor) for side in size]


def reference_folder(name, who, size, options):
    """Another one for all that another picture may come from."""
    scene = (HERE / f"{name}.toml").read_text() + (HERE / "solids.py").read_text()
    says = f"{scene} {renderers.versions()} {size} {options.share}"
    return options.work / "references" / f"{name}-{who}-{hashlib.sha256(says.encode()).hexdigest()[:12]}"


def pictures(folder):
    return [np.load(path) for path in sorted(folder.glob("*.npy"))]


class Subject:
    """A scene with both renderers ready for it."""

    def __init__(self, name, options):
        self.name, self.options = name, options
        path = copied(name)
        size = translate.size(translate.load(path))
        self.small, self.large = (shaped(pixels, size) for pixels in options.pixels)
        views = [(sampler, size) for size in (self.small, self.large) for sampler in SAMPLERS]
        # Mitsuba's observer, so that nothing but the masking term is different on purpose.
        self.library = WORK / "library"
        self.usual, self.independent = self.renderer(path), self.renderer(copied(name, "independent"))
        self.owns = {
            results.USUAL: self.usual,
            results.ADAPTIVE: self.renderer(path, adaptive=True),
            results.INDEPENDENT: self.independent,
        }
        if name == "diamond":
            self.owns[results.DISPERSIVE] = self.renderer(path, *own.DISPERSIVE)
            self.owns[results.BOTH] = self.renderer(path, *own.DISPERSIVE, adaptive=True)
        self.peers = {variant: Worker(variant, path, views, options.threads) for variant in VARIANTS}

    def renderer(self, path, *more, adaptive=False):
        return renderers.Spectrel(path, self.library, ["--threads", self.options.threads, *more], adaptive)

    def contestants(self, large):
        """By name: a function from samples and seed to a render."""
        width, height = self.large if large else self.small
        size = ["--width", width, "--height", height]
        first = len(SAMPLERS) if large else 0

        def of_own(renderer):
            return lambda samples, seed: renderer.render(samples, seed, *size)

        def of_peer(peer, view):
            return lambda samples, seed: peer.render(samples, seed, view)

        found = {name: of_own(renderer) for name, renderer in self.owns.items()}
        for variant, peer in self.peers.items():
            for number, sampler in enumerate(SAMPLERS):
                found[f"Mitsuba {variant}, {sampler}"] = of_peer(peer, first + number)
        return found

    def references(self):
        """The common one, and that of the dispersive stone if there is one."""
        width, height = self.small
        size = ["--width", width, "--height", height]
        peer = self.peers["llvm_ad_spectral"]
        ours = self.kept("spectrel", REFERENCE, OWN_PART, lambda s, seed: self.independent.render(s, seed, *size))
        theirs = self.kept("mitsuba", REFERENCE, PEER_PART, lambda s, seed: peer.render(s, seed))
        common = errors.Reference([ours, theirs])
        if results.DISPERSIVE not in self.owns:
            return common, None
        stone = self.renderer(copied(self.name, "independent"), *own.DISPERSIVE)
        # Twice as many, for nobody else's are there.
        alone = self.kept("dispersive", 2 * REFERENCE, OWN_PART, lambda s, seed: stone.render(s, seed, *size))
        return common, errors.Reference([alone])

    def kept(self, who, samples, part, render):
        """Pictures of a third set of seeds, so many samples together, each kept as soon as it is there."""
        count, part = samples // part, max(part // self.options.share, 1)
        folder = reference_folder(self.name, who, self.small, self.options)
        if self.options.fresh:
            shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True, exist_ok=True)
        for number in range(count):
            path = folder / f"{number}.npy"
            if not path.exists():
                tell(f"reference by {who}, {number + 1} of {count} × {part} samples")
                # Far apart: Mitsuba adds the number of a picture's block to its seed.
                picture = render(part, 100_000 + 1000 * number).picture
                with open(path.with_suffix(".part"), "wb") as file:
                    np.save(file, picture)
                path.with_suffix(".part").rename(path)
        return pictures(folder)

    def close(self):
        for peer in self.peers.values():
            peer.__exit__()


def measure(name, options):
    """All of one scene."""
    subject = Subject(name, options)
    try:
        common, dispersive = subject.references()
        renders = turns(subject, lambda who: dispersive if who in (results.DISPERSIVE, results.BOTH) else common)
        raw = raw_turns(subject)
        width, height = subject.large
        loading = [subject.usual.loading("--width", width, "--height", height) for _ in range(3)]
    finally:
        subject.close()
    return {
        "scene": name,
        "small": subject.small,
        "large": subject.large,
        "loading": np.median([[made.cpu, made.wall] for made in loading], axis=0).tolist(),
        "noise": float(common.noise.mean()),
        "disagreement": float(common.disagreement),
        "rows": [row(who, renders[who], raw[who]) for who in renders],
    }


def turns(subject, reference):
    """By renderer and samples a pixel: CPU s, wall s, MSE and relMSE of each render."""
    contestants = subject.contestants(False)
    renders = {who: {samples: [] for samples in COUNTS} for who in contestants}
    for turn in range(subject.options.repeats):
        tell(f"turn {turn + 1} of {subject.options.repeats}: {', '.join(map(str, COUNTS))} samples a pixel")
        for samples in COUNTS:
            for who, render in contestants.items():
                made, judge = render(samples, 1000 + 1000 * turn), reference(who)
                found = [made.cpu, made.wall, judge.mse(made.picture), judge.rel_mse(made.picture)]
                renders[who][samples].append(found)
    return renders


def raw_turns(subject):
    """By renderer: CPU s, wall s and wall s of rendering alone, of each render of the large picture."""
    contestants = subject.contestants(True)
    raw = {who: [] for who in contestants}
    for turn in range(subject.options.raw_repeats):
        tell(f"raw rate, turn {turn + 1} of {subject.options.raw_repeats}")
        for who, render in contestants.items():
            made = render(results.RAW_SAMPLES, 1000 + 1000 * turn)
            raw[who].append([made.cpu, made.wall, made.alone])
    return raw


def row(who, renders, raw):
    levels = [[samples, *results.level(made)] for samples, made in renders.items()]
    seconds, beyond = errors.time_to(errors.TARGET, [level[1] for level in levels], [level[4] for level in levels])
    raw = np.median(raw, axis=0).tolist()
    return {"who": who, "levels": levels, "raw": raw, "target": seconds, "beyond": bool(beyond)}


def measure_own(options):
    """With the references that the scenes have by now."""

    def wanted(name, who, *more):
        size = shaped(options.pixels[0], translate.size(translate.load(copied(name))))
        found = pictures(reference_folder(name, who, size, options))
        if not found:
            raise SystemExit(f"there is no reference of {name} yet: run `speed.py {name}` first")
        command = ["--library", WORK / "library", "--width", size[0], "--height", size[1], *more]
        return command, errors.Reference([found])

    references = [
        ("metals", *wanted("metals", "spectrel")),
        ("cornell", *wanted("cornell", "spectrel")),
        ("diamond, with dispersion", *wanted("diamond", "dispersive", *own.DISPERSIVE)),
    ]
    return {"scene": "own", "rows": own.measure(copied, references, options.threads, options.quick, tell)}
