"""How far pictures are from a reference, and what time brings them how near.

Pictures are linear sRGB in units of the reference's mean over pixels and channels. MSE is the mean of (x − r)² over both,
relMSE that of (x − r)² / (r² + 0.01) (F. Rousselle, C. Knaus & M. Zwicker, ACM Transactions on Graphics 30 (2011)). What the
reference's own noise adds to them is subtracted: it is known from how the renders that the reference is the mean of scatter.
"""

import numpy as np

# Primaries of BT.709, white D65 at (0.3127, 0.3290).
PRIMARIES_XY = np.array([[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]])
WHITE_XY = np.array([0.3127, 0.3290])
DARK = 0.01
# Of the reference's mean in relMSE, to which time is measured.
TARGET = 0.01


def rgb_from_xyz():
    def xyz(xy):
        return np.array([xy[0] / xy[1], 1.0, (1 - xy[0] - xy[1]) / xy[1]])

    columns = np.stack([xyz(xy) for xy in PRIMARIES_XY], axis=1)
    return np.linalg.inv(columns * np.linalg.solve(columns, xyz(WHITE_XY)))


def linear(picture):
    return picture @ rgb_from_xyz().T


class Reference:
    """The mean of what renderers say, each by pictures of its own seeds: one list of pictures a renderer."""

    def __init__(self, groups):
        groups = [linear(np.array(pictures)) for pictures in groups]
        means = [pictures.mean(axis=0) for pictures in groups]
        self.unit = np.mean(means)
        self.picture = np.mean(means, axis=0) / self.unit
        noises = [pictures.var(axis=0, ddof=1) / len(pictures) / self.unit**2 for pictures in groups]
        self.noise = sum(noises) / len(groups) ** 2
        self.weight = 1 / (self.picture**2 + DARK)
        # What a renderer's MSE owes to the other's having another mean: as an estimate it may fall below 0.
        self.disagreement = None
        if len(groups) == 2:
            difference = (means[0] - means[1]) / self.unit
            self.disagreement = (difference**2 - sum(noises)).mean() / 4

    def mse(self, picture):
        return (self.squares(picture) - self.noise).mean()

    def rel_mse(self, picture):
        return ((self.squares(picture) - self.noise) * self.weight).mean()

    def squares(self, picture):
        return (linear(picture) / self.unit - self.picture) ** 2


def time_to(target, seconds, errors):
    """Seconds at which an error falls to the target: along straight lines between the logarithms, on beyond the ends. And
    whether it is beyond."""
    points = [(np.log(s), np.log(e)) for s, e in zip(seconds, errors) if s > 0 and e > 0]
    if len(points) < 2:
        return None, True
    aim = np.log(target)
    inside = [i for i in range(len(points) - 1) if points[i][1] >= aim >= points[i + 1][1]]
    first = inside[0] if inside else (0 if aim > points[0][1] else len(points) - 2)
    (x0, y0), (x1, y1) = points[first], points[first + 1]
    if y0 == y1:
        return None, True
    return float(np.exp(x0 + (aim - y0) * (x1 - x0) / (y1 - y0))), not inside
