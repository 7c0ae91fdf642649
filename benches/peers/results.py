"""Tables of `speed.py`, and its part of the page."""

import numpy as np

from errors import TARGET

USUAL, ADAPTIVE, INDEPENDENT = "spectrel", "spectrel, adaptive", "spectrel, independent"
DISPERSIVE, BOTH = "spectrel, with dispersion", "spectrel, with dispersion, adaptive"
BEST_PEER = "Mitsuba llvm_ad_spectral, multijitter"
SHOWN = [64, 256]
RAW_SAMPLES = 16


def level(renders):
    """Of rows (CPU s, wall s, MSE, relMSE): medians of times, means of errors, and the standard error of the MSE over it."""
    cpu, wall, mse, rel = np.array(renders).T
    scatter = mse.std(ddof=1) / len(mse) ** 0.5 / abs(mse.mean()) if len(mse) > 1 else 0.0
    return [float(x) for x in (np.median(cpu), np.median(wall), mse.mean(), rel.mean(), scatter)]


def of(result, who, samples):
    """(CPU s, MSE, relMSE, standard error of the MSE over it) of a renderer."""
    row = next(row for row in result["rows"] if row["who"] == who)
    _, cpu, _, mse, rel, scatter = next(level for level in row["levels"] if level[0] == samples)
    return cpu, mse, rel, scatter


def ours(row):
    return row["who"].startswith("spectrel")


def rates(result, row):
    """M samples a second by CPU time and by the clock, of spectrel without loading, as of Mitsuba; and of rendering alone."""
    samples = result["large"][0] * result["large"][1] * RAW_SAMPLES
    less = [*result["loading"], 0] if ours(row) else [0, 0, 0]
    return [samples / (seconds - loading) / 1e6 for seconds, loading in zip(row["raw"], less)]


def short(value):
    return f"{value:,.0f}" if value >= 100 else f"{value:.3g}"


def table(result):
    if result["scene"] == "own":
        return own(result)
    heads = ["renderer", "M samples/s by CPU", "by the clock", "rendering alone"]
    heads += [f"{what} at {n}" for what in ("CPU s", "MSE", "relMSE", "1/(MSE × CPU s)") for n in SHOWN]
    heads += [f"CPU s to relMSE {TARGET}"]
    lines = ["| " + " | ".join(heads) + " |", "|---" + "|--:" * (len(heads) - 1) + "|"]
    for row in result["rows"]:
        found = [of(result, row["who"], samples) for samples in SHOWN]
        cells = [row["who"], *(f"{rate:.2f}" for rate in rates(result, row))]
        cells += [f"{cpu:.3f}" for cpu, _, _, _ in found]
        cells += [f"{mse:.2e} ± {100 * scatter:.0f} %" for _, mse, _, scatter in found]
        cells += [f"{rel:.2e}" for _, _, rel, _ in found]
        cells += [short(1 / (cpu * mse)) for cpu, mse, _, _ in found]
        target = "–" if row["target"] is None else f"{row['target']:.3g}"
        cells.append(f"({target})" if row["beyond"] else target)
        lines.append("| " + " | ".join(cells) + " |")
    title = result["scene"]
    small, large = (" × ".join(map(str, result[key])) for key in ("small", "large"))
    cpu, wall = result["loading"]
    return (
        f"### {title[0].upper()}{title[1:]}\n\n{small} pixels; raw rates: {large} pixels, {RAW_SAMPLES} samples each. Loading, "
        f"in spectrel's CPU seconds: {cpu:.3f} s ({wall:.3f} s by the clock). The reference's own MSE, subtracted: {result['noise']:.1e}; "
        f"what the difference of the two renderers' references adds to each MSE: {result['disagreement']:.1e}.\n\n"
        + "\n".join(lines)
        + "\n"
    )


def own(result):
    lines = ["### spectrel against itself", "", "| what | bar | ratio | least … largest of the pairs |", "|---|--:|--:|--:|"]
    for row in result["rows"]:
        span = "–" if row["range"] is None else "{:.3f} … {:.3f}".format(*row["range"])
        lines.append(f"| {row['what']} | {row['bar'] or '–'} | {row['ratio']:.3f} | {row.get('note', span)} |")
    return "\n".join(lines) + "\n"


# Scene, what is said of it, who of ours and who with samples shared out, least efficiency over the best peer's, the aim, least raw
# rate over the peer's.
BARS = [
    ("metals", "metals", USUAL, ADAPTIVE, 3, 6, 1.3),
    ("diamond", "diamond, ours with dispersion, theirs without", DISPERSIVE, BOTH, 0.7, 1.5, None),
    ("diamond", "diamond, both without dispersion", USUAL, ADAPTIVE, None, None, None),
    ("cornell", "cornell", USUAL, ADAPTIVE, None, None, None),
    ("mesh", "mesh", USUAL, ADAPTIVE, None, None, 1.0),
    ("glass", "glass", USUAL, ADAPTIVE, None, None, None),
]


def bars(found):
    """What the renderer is held to, each within one run."""
    by_name = {result["scene"]: result for result in found}
    lines = [
        f"| times {BEST_PEER} | bar | aim | whole process | without loading |",
        "|---|--:|--:|--:|--:|",
    ]
    for name, title, who, shared, least, aim, least_raw in BARS:
        if name in by_name:
            result = by_name[name]
            lines += [efficiency(result, who, title, least, aim, samples) for samples in SHOWN]
            lines += [efficiency(result, shared, f"{title}, adaptive", least, aim, samples) for samples in SHOWN]
            lines += raw(result, who, title, least_raw)
            lines += to_target(result, who, title)
    return "\n".join(lines) + "\n"


def cells(title, bar, aim, whole, bare):
    shown = ["–" if value is None else f"{value} ×" for value in (bar, aim)]
    return f"| {title} | {' | '.join(shown)} | {whole} | {bare} |"


def mark(value, bar):
    return "" if bar is None else " ✓" if value >= bar else " ✗"


def efficiency(result, who, title, bar, aim, samples):
    """Held to the bar with all that the process does."""
    (cpu, mse, _, a), (other_cpu, other_mse, _, b) = (of(result, each, samples) for each in (who, BEST_PEER))
    ratio = other_cpu * other_mse / (cpu * mse)
    whole = f"{ratio:.2f} × ± {100 * (a * a + b * b) ** 0.5:.0f} %{mark(ratio, bar)}"
    return cells(
        f"{title}: efficiency at {samples} samples", bar, aim, whole, f"{ratio * cpu / (cpu - result['loading'][0]):.2f} ×"
    )


def raw(result, who, title, bar):
    """Held to the bar without loading, which is not in the peer's time either."""
    rows = {row["who"]: row for row in result["rows"]}
    quotients = [a / b for a, b in zip(rates(result, rows[who]), rates(result, rows[BEST_PEER]))]
    for i, by in enumerate(["CPU time", "the clock"]):
        whole = rows[BEST_PEER]["raw"][i] / rows[who]["raw"][i]
        yield cells(f"{title}: raw rate by {by}", bar, None, f"{whole:.2f} ×", f"{quotients[i]:.2f} ×{mark(quotients[i], bar)}")
    yield cells(f"{title}: raw rate by the clock, rendering alone", bar, None, "–", f"{quotients[2]:.2f} ×{mark(quotients[2], bar)}")


def to_target(result, who, title):
    rows = {row["who"]: row for row in result["rows"]}
    own, other = rows[who], rows[BEST_PEER]
    if own["target"] and other["target"]:
        ratio = f"{other['target'] / own['target']:.3g} ×"
        shown = f"({ratio})" if own["beyond"] or other["beyond"] else ratio
        yield cells(f"{title}: 1 / CPU time to relMSE {TARGET}", None, None, shown, "–")


SECTION = """\
## Error against time

{when}

Both renderers took turns, render by render, with {threads} threads each. Every figure is a median of times or a mean of errors of
several renders with seeds of their own; ± is one standard error of that mean.

- MSE: of linear sRGB, mean over pixels and channels, pictures scaled so that the reference's mean is 1; relMSE: mean of
  (x − r)² / (r² + 0.01). In parentheses what lies beyond the counts that were rendered (1, 4, 16, 64 and 256 samples a pixel).
- The reference is the mean of 8,192 independent samples a pixel of each renderer, from other seeds than all that is measured; its
  own noise is subtracted. That of the dispersive diamond is spectrel's alone, 16,384 samples.
- CPU seconds are user and system time of all threads: of spectrel's whole process, with loading the scene and writing the picture; of
  Mitsuba's render alone, without loading and, by an earlier render of the same kind, without compiling. Raw rates are without
  loading for both; "rendering alone" is what spectrel says of its render, without the development and the file that Mitsuba does not
  write either.
- "Adaptive" is `--adaptive=rmse`: as many samples in the mean, of which noisy places get more after the first quarter. Mitsuba
  gives every pixel as many.
- Mitsuba's `multijitter` is its best sampler here, `llvm_ad_spectral` its fastest variant (with libLLVM 19).

What differs: Mitsuba has no dispersion, so its diamond has the index of one wavelength at all of them, and it is a mesh of triangles made
of the same facets, where spectrel's is a convex solid; Mitsuba's rough metal has another masking term (see below), which makes no
difference that would be seen among these errors. spectrel carries 8 wavelengths a path, Mitsuba 4. Both end paths by roulette, each
by its own rule.

### The bars

{bars}
{tables}"""


def section(found):
    """Of the page."""
    tables = "\n".join(table(result) for result in found)
    whens = []
    for result in found:
        when = f"{result['date']}, {result['machine']}, load before it {result['load']:.1f}; {', '.join(result['versions'])}"
        whens.append(f"- {result['scene']}: {when}")
    threads = sorted({result["threads"] for result in found})
    return SECTION.format(when="\n".join(whens), threads=" or ".join(map(str, threads)), bars=bars(found), tables=tables)
