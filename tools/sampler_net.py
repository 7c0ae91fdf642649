#!/usr/bin/env python3
"""Finds what `src/sampler/net.rs` knows by heart: the matrices of its pairs of dimensions, and which columns of Pascal's matrix are mixed.

    pip install numpy
    python3 tools/sampler_net.py        # two minutes on two cores; prints SPREAD, MIXED and LATER

Everything is linear over the numbers modulo 2: digit r of a coordinate of point n is the sum of those digits of n that row r of the
coordinate's matrix names. The matrices of a pair are U and Pascal's times U, for an upper triangular U. Whatever U is, the pair is
a (0, m, 2)-net for every m, as Sobol's first two dimensions are, where U = 1; U decides how a pair goes together with others.

How some dimensions go together is told by the error that their points leave of integrands with an edge, over the error that as many
independent points leave (A. B. Owen, "Monte Carlo variance of scrambled net quadrature", SIAM J. Numer. Anal. 34(5), 1997): a part of
the integrand that needs k₁, k₂, … digits of the coordinates is left if rows up to these are dependent, 2^(rows − rank) times as often as
of independent points. Its variance is 2^(−Σ k) for an edge along the axes, 2^(−min k) 4^(−Σ (k − min k)) for one at an angle.

Matrices grow column by column: of all new columns for all matrices kept so far the best go on. What a set of
dimensions leaves, over what a quarter of all random matrices stay below, counts by its square, so that none is bad for the good of others.
Later pairs have random matrices, of which those are taken that go well with all before.
"""

import itertools
from functools import lru_cache
from multiprocessing import Pool

import numpy as np

DIMENSIONS, DIGITS, BITS = 64, 12, 24
MIXES = 16
# Digits of each coordinate that are looked at in sets of two, three and four dimensions.
DEEP = {2: 9, 3: 5, 4: 4}
# What a set of 2^m points counts: those that are rendered most.
COUNT = [0, 0.5, 0.5, 0.5, 2, 1, 3, 1.5, 3, 1, 1.5, 0.3, 0.5]
# Matrices that are kept from column to column, of the pairs that surfaces draw first and of later ones, and how many go on from each.
KEPT, KEPT_LATER, NEXT = 32, 8, 8
FIRST_PAIRS = 8
# Pairs with matrices of their own; those after them have random ones, by the best of so many numbers.
TABLED, NUMBERS = 10, 100
# Numbers of samples 2^m and of pixels 2^k, with their weights: few samples, and blocks of 2 × 2 and 4 × 4, count most.
SAMPLES = {0: 3, 1: 2, 2: 2, 3: 1, 4: 1}
PIXELS = {1: 1, 2: 3, 3: 1, 4: 2}

ONE = [1 << r for r in range(DIGITS)]


def times_pascal(matrix):
    """Pascal's triangle modulo 2 has a 1 where the column holds all bits of the row (Lucas)."""
    size = len(matrix)
    return [np.bitwise_xor.reduce([matrix[c] for c in range(r, size) if c & r == r]) for r in range(size)]


def ranks(blocks, candidates, deep):
    """Of the first k rows of each block together, for all k up to `deep`."""
    found = {}

    def go(block, k, basis, rank):
        if block == len(blocks):
            found[k] = rank
            return
        basis = list(basis)
        go(block + 1, (*k, 0), basis, rank)
        for row in range(deep):
            if row < len(blocks[block]):
                vector = blocks[block][row]
                for other in basis:
                    vector = np.minimum(vector, vector ^ other)
                if vector.any():
                    basis.append(vector)
                    rank = rank + (vector != 0)
            go(block + 1, (*k, row + 1), basis, rank)

    go(0, (), [], np.zeros(candidates, np.int8))
    return found


@lru_cache(None)
def shares(size):
    """What 2^(rows − rank) of the first k rows counts: parts that need exactly k digits are those that need up to k, less those that need
    fewer of any."""
    parts = list(itertools.product(range(1, DEEP[size] + 1), repeat=size))
    along = {k: 2.0 ** -sum(k) for k in parts}
    angled = {k: 2.0 ** -min(k) * 4.0 ** (size * min(k) - sum(k)) for k in parts}
    total_along, total_angled = sum(along.values()), sum(angled.values())
    counted = {}
    for k in parts:
        variance = (along[k] / total_along + angled[k] / total_angled) / 2
        for less in itertools.product((0, 1), repeat=size):
            to = tuple(a - b for a, b in zip(k, less))
            counted[to] = counted.get(to, 0) + variance * (-1) ** sum(less) / 2.0 ** (sum(k) - size)
    return [(k, share * 2.0 ** sum(k)) for k, share in counted.items() if share != 0]


POWERS = 2.0 ** -np.arange(40)


def left_over(blocks, m, candidates):
    """The variance that 2^m points leave of integrands with an edge over that of independent points."""
    found = ranks(blocks, candidates, DEEP[len(blocks)])
    return 2.0**m * sum(share * POWERS[found[k]] for k, share in shares(len(blocks)))


def square(matrix, m):
    """Of the first m columns; later rows have none of them."""
    return [np.full(1, row & ((1 << m) - 1)) for row in matrix[:m]]


def usual():
    """What a quarter of all random matrices stays below, by dimensions and m."""
    rng, found = np.random.default_rng(5), {}

    def random_pair():
        upper = [1 << r | sum(int(rng.integers(2)) << c for c in range(r + 1, DIGITS)) for r in range(DIGITS)]
        return upper, [int(row) for row in times_pascal(upper)]

    for size, m in itertools.product(DEEP, range(1, DIGITS + 1)):
        values = []
        for _ in range(60):
            (a, b), (c, d) = random_pair(), random_pair()
            four = {2: [a, c], 3: [a, b, c], 4: [a, b, c, d]}[size]
            values.append(left_over([square(matrix, m) for matrix in four], m, 1)[0])
        found[size, m] = float(np.quantile(values, 0.25))
    return found


USUAL = usual()


def sets_of(pair):
    """The dimensions that a new pair A, B is looked at with, and what each set counts. 0 and 1 are the place in the pixel, 2 the
    wavelength, 3 the choice of a light; then come pairs for lights, surfaces and cameras as paths draw them."""
    if pair == 1:
        return [((0, "A"), 1), ((1, "A"), 1), ((0, 1, "A"), 2), ((0, "B"), 0.5), ((1, "B"), 0.5), ((0, 1, "B"), 0.5)]
    sets = [((0, 1, "A"), 2), ((0, 1, "B"), 2), ((0, "A", "B"), 1.5), ((1, "A", "B"), 1.5), ((0, 1, "A", "B"), 2)]
    sets += [((d, x), 4) for d in (0, 1) for x in "AB"] + [((2, "A", "B"), 1)]
    for before in range(1, pair):
        a, b = 2 * before, 2 * before + 1
        weight = 1 if before >= pair - 2 else 0.5
        sets += [((d, x), 0.6 * weight) for d in (a, b) for x in "AB"]
        if before > 1:
            sets += [((a, b, "A"), weight), ((a, b, "B"), weight), ((a, "A", "B"), weight), ((b, "A", "B"), weight)]
    if pair > 2:
        sets.append(((2 * pair - 2, 2 * pair - 1, "A", "B"), 1))
    return sets


def longer(task):
    """The best matrices with one more column."""
    cost, rows, pair, known = task
    m, candidates = len(rows) + 1, 1 << len(rows)
    digits = np.arange(candidates)
    upper = [row | (digits >> r & 1) << (m - 1) for r, row in enumerate(rows)] + [np.full(candidates, 1 << (m - 1))]
    new = {"A": upper, "B": times_pascal(upper)}
    total, sets = np.zeros(candidates), sets_of(pair)
    for names, weight in sets:
        if all(name in new or name in known for name in names):
            blocks = [new[name] if name in new else square(known[name], m) for name in names]
            total += weight * (left_over(blocks, m, candidates) / USUAL[len(names), m]) ** 2
    total *= COUNT[m] / sum(weight for _, weight in sets)
    return [(cost + float(total[k]), [int(row[k]) for row in upper]) for k in np.argsort(total, kind="stable")[:NEXT]]


def matrices(pool):
    known = {0: ONE, 1: [int(row) for row in times_pascal(ONE)]}
    for pair in range(1, TABLED):
        states = [(0.0, [])]
        # Old dimensions that are far away are not looked at, but for those of the pixel, the wavelength and the first surfaces.
        near = {d: rows for d, rows in known.items() if d < 8 or d >= 2 * pair - 8}
        for _ in range(DIGITS):
            found = pool.map(longer, [(cost, rows, pair, near) for cost, rows in states], chunksize=1)
            states = sorted(itertools.chain(*found))[: KEPT if pair < FIRST_PAIRS else KEPT_LATER]
        add(known, pair, states[0][1])
        print(f"pair {pair}: {states[0][0]:.2f}", flush=True)
    return known


def add(known, pair, upper):
    known[2 * pair] = upper
    known[2 * pair + 1] = [int(row) for row in times_pascal(upper)]


def mixed_bits(value):
    """`hash` of `net.rs`."""
    state = (value * 747796405 + 2891336453) & 0xFFFFFFFF
    word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737 & 0xFFFFFFFF
    return (word >> 22) ^ word


def random_upper(pair, number):
    columns = [mixed_bits(mixed_bits(pair << 5 | c) ^ number) & ((1 << c) - 1) | 1 << c for c in range(DIGITS)]
    return [sum((column >> r & 1) << c for c, column in enumerate(columns)) for r in range(DIGITS)]


def clashes(one, other, m):
    """How many of the shares of three leading rows are dependent: then some of their first digits are one function of each other's."""
    return sum(not whole for whole in independent([rows(one, 3, m), rows(other, 3, m)], 3))


def numbers(known):
    """Of the pairs without matrices of their own: which let each go well with each dimension before."""
    chosen = []
    for pair in range(TABLED, DIMENSIONS // 2):

        def cost(number):
            upper = random_upper(pair, number)
            lower = [int(row) for row in times_pascal(upper)]
            sets = itertools.product((upper, lower), known.values(), ((6, 1), (8, 4), (10, 16)))
            return sum(weight * clashes(new, old, m) for new, old, (m, weight) in sets)

        chosen.append(min(range(NUMBERS), key=cost))
        add(known, pair, random_upper(pair, chosen[-1]))
    return chosen


def packed(upper):
    """What is above the diagonal, column after column, the first row's digit lowest."""
    bits = [upper[r] >> c & 1 for c in range(1, DIGITS) for r in range(c)]
    return sum(bit << place for place, bit in enumerate(bits))


def rows(matrix, count, width):
    """The first rows, of the first columns."""
    return [matrix[r] & ((1 << width) - 1) if r < DIGITS else 0 for r in range(count)]


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


def leading(columns, count, width):
    """The first digits of `width` columns: a row of bits each."""
    return [sum(((columns[c] >> (BITS - 1 - r)) & 1) << c for c in range(width)) for r in range(count)]


def mixes(known):
    longest = max(SAMPLES) + max(PIXELS)
    points = [{m: rows(known[d], longest, m) for m in SAMPLES} for d in range(MIXES)]
    shifts = [{k: leading(mixed(code), longest, k) for k in PIXELS} for code in range(64)]

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


def main():
    with Pool() as pool:
        known = matrices(pool)
    print("SPREAD", [hex(packed(known[2 * pair])) for pair in range(1, TABLED)])
    print("MIXED", mixes(known))
    print("LATER", numbers(known))


if __name__ == "__main__":
    main()
