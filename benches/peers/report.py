"""What `compare.py` found: tables, what they mean, and its part of the page."""

import datetime
from dataclasses import asdict, dataclass, field

import numpy as np

import mitsuba as mi
import renderers
import spectra
from measure import Deviation

LIMIT = 0.2
CHANNELS = "YXZ"
LIGHTS = [("A", None), ("D65", None), ("A", "red"), ("A", "green"), ("D65", "orange"), ("D65", "neutral-5")]


@dataclass
class Result:
    """Of one scene: sections of a title and rows of (region, pixels, deviations)."""

    sections: list
    date: str = field(default_factory=lambda: datetime.date.today().isoformat())

    def __str__(self):
        return f"{tables(self.sections)}\n{summary(self.sections)}"

    def to_json(self):
        return asdict(self)

    @classmethod
    def from_json(cls, data):
        sections = [
            (title, [(region, pixels, [Deviation(**each) for each in found]) for region, pixels, found in rows])
            for title, rows in data["sections"]
        ]
        return cls(sections, data["date"])


def tables(sections):
    lines = []
    for title, rows in sections:
        lines += [f"#### {title[0].upper()}{title[1:]}", ""]
        lines += ["| region | pixels | " + " | ".join(f"{c}, %" for c in CHANNELS) + " |", "|---|--:|--:|--:|--:|"]
        for region, pixels, (x, y, z) in rows:
            lines.append(f"| {region} | {pixels} | {y} | {x} | {z} |")
        lines.append("")
    return "\n".join(lines)


def summary(sections):
    """One line a section: how far, how often the interval holds zero, how fine it could see."""
    lines = [
        "| scene | whole picture, Y, % | largest of a region, % | intervals within 0.001 of 0 "
        f"| surely beyond {LIMIT} % | widest interval of Y, % |",
        "|---|--:|--:|--:|--:|--:|",
    ]
    for title, rows in sections:
        every = [(deviation, region, c) for region, _, found in rows for c, deviation in zip("XYZ", found)]
        largest, region, channel = max(every, key=lambda one: abs(one[0].percent))
        agree = sum(deviation.agrees() for deviation, _, _ in every)
        beyond = sum(deviation.beyond(LIMIT) for deviation, _, _ in every)
        widest = max(found[1].half_width for _, _, found in rows)
        lines.append(
            f"| {title} | {rows[0][2][1]} | {largest} ({region}, {channel}) | {agree} of {len(every)} | {beyond} | {widest:.3f} |"
        )
    return "\n".join(lines) + "\n"


def observers():
    """How far the two observers are apart once the constant is allowed for: lights, alone and on patches, by quadrature."""
    ours, theirs = spectra.observer(), renderers.observer()
    white = np.array(spectra.RANGE_NM), np.ones(2)
    lines = ["| light | on | Y, % | X, % | Z, % |", "|---|---|--:|--:|--:|"]
    for light, patch in LIGHTS:
        # Their product on a grid so fine that its chords do not matter.
        nm = np.arange(spectra.RANGE_NM[0], spectra.RANGE_NM[1] + 0.05, 0.1)
        value = np.interp(nm, *spectra.illuminant(light), right=0)
        if patch:
            value = value * np.interp(nm, *spectra.reflectance(f"colorchecker/{patch}"))
        ratio = spectra.integral((nm, value), ours) / spectra.integral((nm, value), theirs)
        x, y, z = (ratio - 1) * 100
        lines.append(f"| {light} | {patch or 'nothing'} | {y:+.3f} | {x:+.3f} | {z:+.3f} |")
    return spectra.integral(white, theirs)[1], "\n".join(lines) + "\n"


SECTION = """\
## Means

By `python3 benches/peers/compare.py`: means of regions of the same scenes.

- {spectrel}; {mitsuba}, its `path` integrator and `multijitter` sampler; {date}
- Renders of each with seeds of their own, as many as each title says; box filter, no limit on path length but roulette

Figures are 100 (spectrel / Mitsuba − 1), with the half width of the 95 % confidence interval from the scatter between renders.
The aim is means within {limit} %. "Alike" is the strict comparison: what the two do differently on purpose is exchanged in one of
them, as described below. "As they are" exchanges nothing but the constant. No figure is fitted.

{summary}
### What is allowed for

1. **Mitsuba's constant.** It divides XYZ by {constant:.4f}, while its own observer integrates to {integral:.4f}: a white light of
   luminance 1 comes out as {factor:.5f}. Its pictures are multiplied by 683 × {constant:.4f}, which undoes the division and gives
   cd/m². The regions `sky` and `lamp` show the light itself.
2. **The masking term of rough metal** (alike). Mitsuba multiplies Smith's terms for the two directions as if they were independent,
   spectrel uses the height-correlated form, which is brighter. In "alike" Mitsuba's rough conductor is wrapped in a material that
   multiplies it by (1 + Λi)(1 + Λo) / (1 + Λi + Λo), the quotient of the two; normals, Fresnel term and sampling stay Mitsuba's own.
   It counts where both directions graze, as in the pixels at the edges of the spheres; a polished metal knows nothing of it.
   The difference that it makes is rendered with and without it from equal seeds and added to the pictures of Mitsuba as it is.
3. **The observer** (alike). Both sample wavelengths over 360–830 nm, but Mitsuba's observer is a table of 5 nm, spectrel's one of 1 nm,
   both read linearly. For lights without edges that is nothing; behind a steep reflectance it is more than the noise here. In "alike"
   spectrel is given Mitsuba's table (`--library`). With both tables as they are, spectrel / Mitsuba − 1 by quadrature:

{observers}
Made alike in the scenes: lamps are given a black surface in Mitsuba (half grey unless told; spectrel's are black), `uniform` spectra
stand where a plain number would pass through an RGB model, and tables that end inside the visible keep their end value, as spectrel
reads them.

### By region

A pixel belongs to an object if rays through its corners and its centre meet it. Neither the regions nor the channels are independent of
each other, so of many intervals about one in twenty misses zero by chance, and neighbours miss it together.

{tables}"""


def section(results):
    """Of the page."""
    spectrel, mitsuba = renderers.versions()
    integral, lights = observers()
    sections = [section for result in results for section in result.sections]
    return SECTION.format(
        spectrel=spectrel,
        mitsuba=mitsuba,
        date=max(result.date for result in results),
        limit=LIMIT,
        summary=summary(sections),
        constant=renderers.MITSUBA_CONSTANT,
        integral=integral,
        factor=integral / renderers.MITSUBA_CONSTANT,
        observers=lights,
        tables=tables(sections),
    )


def write_pictures(path, ours, theirs):
    """spectrel, Mitsuba, and their difference in Y (grey is none, black and white are 20 % of the picture's mean)."""
    to_rgb = np.array([[3.2405, -1.5371, -0.4985], [-0.9693, 1.8760, 0.0416], [0.0556, -0.2040, 1.0572]])
    a, b = np.mean(ours, axis=0), np.mean(theirs, axis=0)
    colour = np.concatenate([a, b], axis=1) @ to_rgb.T
    colour = np.clip(colour / np.percentile(colour, 97), 0, 1) ** (1 / 2.2)
    difference = np.clip(0.5 + 2.5 * (a - b)[..., 1] / b[..., 1].mean(), 0, 1)
    picture = np.concatenate([colour, np.repeat(difference[..., None], 3, axis=2)], axis=1)
    path.parent.mkdir(parents=True, exist_ok=True)
    mi.Bitmap((np.kron(picture, np.ones((4, 4, 1))) * 255).astype(np.uint8)).write(str(path))
