#!/usr/bin/env python3
"""Finds what `src/sampler/net.rs` knows by heart: the order of Sobol's dimensions, and which columns of Pascal's matrix are mixed.

    pip install numpy scipy
    python3 tools/sampler_net.py        # half a minute; prints FIRST and MIXED

Everything is linear over the numbers modulo 2, and random scrambling changes nothing of it. The quality of some dimensions is told by
ranks: n = 2^m points fill every box of volume 2^(t − m) alike if any m − t leading rows, shared out among the dimensions, are
independent (t is the net's quality, 0 the best). The same with k columns of the shifts beside the m of the points tells how well the
samples of 2^k neighbouring pixels are spread together.
"""

import itertools
from functools import lru_cache

import numpy as np
from scipy.stats import qmc

DIMENSIONS, DIGITS, BITS = 64, 12, 24
PAIRS, MIXES = 14, 16
# Sets of four dimensions are looked at for these numbers of points, 2^m.
FOUR_AT = (4, 6, 8)
# Candidates of which the four dimensions are looked at.
SHORT_LIST = 25
# Numbers of samples 2^m and of pixels 2^k, with their weights: few samples, and blocks of 2 × 2 and 4 × 4, count most.
SAMPLES = {0: 3, 1: 2, 2: 2, 3: 1, 4: 1}
PIXELS = {1: 1, 2: 3, 3: 1, 4: 2}


def sobol_columns():
    """Direction numbers of Joe and Kuo, a column each; SciPy goes through the sequence in Gray code."""
    points = (qmc.Sobol(DIMENSIONS, scramble=False, bits=30).random(1 << DIGITS) * 2**BITS).astype(np.int64)
    place = {n ^ (n >> 1): n for n in range(1 << DIGITS)}
    return [[int(points[place[1 << c]][d]) for c in range(DIGITS)] for d in range(DIMENSIONS)]


def rows(columns, count, width):
    """The first digits of `width` columns: a row of bits each."""
    return [sum(((columns[c] >> (BITS - 1 - r)) & 1) << c for c in range(width)) for r in range(count)]


def rank(vectors):
    basis = []
    for vector in vectors:
        for other in basis:
            vector = min(vector, vector ^ other)
        if vector:
            basis.append(vector)
    return len(basis)


def independent(blocks, total):
    """Shares of `total` leading rows among the blocks: whether each is independent."""
    for cut in itertools.product(range(total + 1), repeat=len(blocks) - 1):
        if sum(cut) <= total:
            shares = [*cut, total - sum(cut)]
            yield rank(sum((block[:share] for block, share in zip(blocks, shares)), [])) == total


SOBOL = sobol_columns()
SQUARE = {(d, m): rows(SOBOL[d], m, m) for d in range(DIMENSIONS) for m in range(1, DIGITS + 1)}


@lru_cache(None)
def t_value(dimensions, m):
    blocks = [SQUARE[d, m] for d in dimensions]
    return next(t for t in range(m + 1) if all(independent(blocks, m - t)))


@lru_cache(None)
def of_pair(a, b):
    return sum(t_value((min(a, b), max(a, b)), m) for m in range(1, DIGITS + 1))


def of_four(pair, a, b):
    return sum(t_value((*pair, a, b), m) for m in FOUR_AT)


def order():
    left, pairs = set(range(3, DIMENSIONS)), []
    while len(pairs) < PAIRS:

        def with_pixel(a, b):
            of_pixel = sum(of_pair(x, y) for x in (0, 1) for y in (a, b))
            return 3 * of_pair(a, b) + of_pixel + 0.5 * (of_pair(2, a) + of_pair(2, b))

        short = sorted((with_pixel(a, b), a, b) for a, b in itertools.combinations(sorted(left), 2))[:SHORT_LIST]
        full = [
            (cost + 4 * of_four((0, 1), a, b) + (3 * of_four((a, b), *pairs[-1]) if pairs else 0), a, b)
            for cost, a, b in short
        ]
        _, a, b = min(full)
        pairs.append((a, b))
        left -= {a, b}
    single = min(left, key=lambda s: sum(of_pair(x, s) for x in (0, 1, 2)))
    return [0, 1, 2, single, *itertools.chain(*pairs)]


def pascal(column):
    """Modulo 2, by Lucas's theorem."""
    return sum(1 << (BITS - 1 - row) for row in range(BITS) if row & column == column)


def mixed(code):
    """The first four columns, with those before them added as the bits of `code` say."""
    columns = [pascal(c) for c in range(4)]
    places = [(c, before) for c in range(4) for before in range(c)]
    for i, (c, before) in enumerate(places):
        if code >> i & 1:
            columns[c] ^= pascal(before)
    return columns


def mixes(first):
    longest = max(SAMPLES) + max(PIXELS)
    points = [{m: rows(SOBOL[d], longest, m) for m in SAMPLES} for d in first]
    shifts = [{k: rows(mixed(code), longest, k) for k in PIXELS} for code in range(64)]

    @lru_cache(None)
    def together(d, e, u, v):
        """The share of boxes that dimensions d and e with mixes u and v fill alike."""
        good = total = 0
        for (m, wm), (k, wk) in itertools.product(SAMPLES.items(), PIXELS.items()):
            blocks = [[points[x][m][r] | shifts[w][k][r] << m for r in range(m + k)] for x, w in ((d, u), (e, v))]
            found = list(independent(blocks, m + k))
            good += wm * wk * sum(found) / len(found)
            total += wm * wk
        return good / total

    codes = range(64)
    u, v = max(itertools.product(codes, codes), key=lambda uv: (together(0, 1, *uv), uv))
    chosen = [u, v]

    def with_pixel(d, w):
        return together(0, d, u, w) + together(1, d, v, w)

    chosen.append(max(codes, key=lambda w: with_pixel(2, w)))
    chosen.append(max(codes, key=lambda w: with_pixel(3, w) + together(2, 3, chosen[2], w)))
    for d in range(4, MIXES, 2):

        def of_both(uv):
            of_wavelength = together(2, d, chosen[2], uv[0]) + together(2, d + 1, chosen[2], uv[1])
            return 4 * together(d, d + 1, *uv) + with_pixel(d, uv[0]) + with_pixel(d + 1, uv[1]) + 0.5 * of_wavelength

        chosen += max(itertools.product(codes, codes), key=lambda uv: (of_both(uv), uv))
    return chosen


first = order()
print("FIRST", first)
print("MIXED", mixes(first[:MIXES]))
