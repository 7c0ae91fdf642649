"""Means of regions over replicates, and how sure their ratio is."""

from dataclasses import dataclass

import numpy as np

# Per cent that single-precision sums may be off; the light alone is seen more sharply than that.
ROUNDING = 0.001
Z_975 = 1.959963984540054


@dataclass
class Deviation:
    """Of spectrel from Mitsuba, in per cent, with the half width of its 95 % confidence interval."""

    percent: float
    half_width: float

    def __str__(self):
        return f"{self.percent:+.3f} ± {self.half_width:.3f}"

    def agrees(self):
        return abs(self.percent) <= self.half_width + ROUNDING

    def beyond(self, limit):
        """Surely more than `limit` per cent away."""
        return abs(self.percent) - self.half_width > limit


def student_975(degrees):
    """The 97.5 % quantile of Student's distribution, by its expansion in 1/degrees (error below 1e-3 from 6 on)."""
    z = Z_975
    first = (z**3 + z) / 4
    second = (5 * z**5 + 16 * z**3 + 3 * z) / 96
    third = (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / 384
    return z + first / degrees + second / degrees**2 + third / degrees**3


def means(pictures, mask):
    """One row a replicate, one column a channel."""
    return np.array([picture[mask].mean(axis=0) for picture in pictures])


def deviations(ours, theirs):
    """By channel, from the rows of `means`: the ratio of two means that scatter independently (Welch)."""
    result = []
    for a, b in zip(ours.T, theirs.T):
        variance = [x.var(ddof=1) / len(x) / x.mean() ** 2 for x in (a, b)]
        total = sum(variance)
        scatter = sum(v**2 / (len(x) - 1) for v, x in zip(variance, (a, b)))
        degrees = total**2 / scatter if scatter else 1e9
        ratio = a.mean() / b.mean()
        result.append(Deviation((ratio - 1) * 100, student_975(degrees) * ratio * total**0.5 * 100))
    return result
