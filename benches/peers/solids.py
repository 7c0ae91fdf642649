"""Triangle meshes that the scenes need: a round brilliant from its proportions, and a displaced torus; and PLY files of them."""

import os

import numpy as np

# As in `src/geometry/cuts/brilliant.rs`, which tells what they are.
BRILLIANT = {
    "diameter": 1.0,
    "table": 0.57,
    "crown_angle": 34.5,
    "pavilion_angle": 40.75,
    "girdle": 0.035,
    "star_length": 0.5,
    "lower_half_length": 0.77,
    "culet": 0.0,
    "girdle_facets": 64,
}
# Corners nearer to each other than this × the size are one.
SAME = 1e-9


def brilliant(proportions):
    """Corners and triangles of the cut that spectrel calls `brilliant`, standing on its culet: an own calculation of its facets."""
    unknown = set(proportions) - set(BRILLIANT)
    if unknown:
        raise SystemExit(f"not translated: {', '.join(sorted(unknown))} of a brilliant")
    return hull(*planes(**(BRILLIANT | proportions)))


def planes(diameter, table, crown_angle, pavilion_angle, girdle, star_length, lower_half_length, culet, girdle_facets):
    """Normals n and distances d of half-spaces n · p ≤ d."""
    if culet:
        raise SystemExit("not translated: a culet")
    radius = diameter / 2
    crown, pavilion = np.radians([crown_angle, pavilion_angle])
    bottom = np.tan(pavilion) * radius
    top = bottom + girdle * diameter
    height = top + np.tan(crown) * radius * (1 - table)
    eighth, sixteenth = np.pi / 4, np.pi / 8

    def at(r, angle, z):
        return np.array([r * np.cos(angle), r * np.sin(angle), z])

    # Where two bezels, a star and two upper halves meet, and two mains and two lower halves.
    inner = table * radius * np.cos(sixteenth)
    star = inner + star_length * (radius - inner)
    star_z = top + np.tan(crown) * (radius - star * np.cos(sixteenth))
    lower = (1 - lower_half_length) * radius
    lower_z = bottom - np.tan(pavilion) * (radius - lower * np.cos(sixteenth))

    found = [(np.array([0, 0, 1.0]), np.array([0, 0, height]))]

    def through(up, a, b, c):
        normal = np.cross(b - a, c - a)
        found.append((normal * np.sign(normal[2] * up), a))

    for k in range(8):
        main = k * eighth
        found.append((at(np.sin(crown), main, np.cos(crown)), at(radius, main, top)))
        found.append((at(np.sin(pavilion), main, -np.cos(pavilion)), at(radius, main, bottom)))
        corners = [at(table * radius, main, height), at(star, main + sixteenth, star_z)]
        through(1, *corners, at(table * radius, main + eighth, height))
        for side in (1, -1):
            middle = main + side * sixteenth
            through(1, at(radius, main, top), at(radius, middle, top), at(star, middle, star_z))
            through(-1, at(radius, main, bottom), at(radius, middle, bottom), at(lower, middle, lower_z))
    for i in range(girdle_facets):
        angle = (2 * i + 1) * np.pi / girdle_facets
        found.append((at(1, angle, 0), at(radius * np.cos(np.pi / girdle_facets), angle, 0)))
    normals = np.array([normal / np.linalg.norm(normal) for normal, _ in found])
    return normals, np.array([normal @ point for normal, (_, point) in zip(normals, found)])


def hull(normals, distances):
    """The solid that half-spaces leave, as welded corners and triangles that turn left seen from outside."""
    size = np.abs(distances).max()
    corners, triangles = [], []

    def index(point):
        for number, known in enumerate(corners):
            if np.abs(known - point).max() < SAME * size:
                return number
        corners.append(point)
        return len(corners) - 1

    for i, (normal, distance) in enumerate(zip(normals, distances)):
        u = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
        u /= np.linalg.norm(u)
        v = np.cross(normal, u)
        square = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
        facet = [normal * distance + 8 * size * (a * u + b * v) for a, b in square]
        for j in range(len(normals)):
            if j != i:
                facet = clipped(facet, normals[j], distances[j])
        ring = []
        for number in map(index, facet):
            if number not in ring:
                ring.append(number)
        triangles += [(ring[0], ring[k], ring[k + 1]) for k in range(1, len(ring) - 1)]
    return np.array(corners), np.array(triangles)


def clipped(polygon, normal, distance):
    """What of a convex polygon a half-space leaves (I. E. Sutherland & G. W. Hodgman 1974)."""
    result = []
    for a, b in zip(polygon, polygon[1:] + polygon[:1]):
        above = normal @ a - distance, normal @ b - distance
        if above[0] <= 0:
            result.append(a)
        if above[0] * above[1] < 0:
            result.append(a + (b - a) * (above[0] / (above[0] - above[1])))
    return result


def displaced_torus(around=1300, across=500):
    """A ring of 2 × around × across triangles, rough on every scale down to a few of them; about +z, its middle in the origin."""
    u, v = np.meshgrid(2 * np.pi * np.arange(around) / around, 2 * np.pi * np.arange(across) / across, indexing="ij")
    draw = np.random.default_rng(1)
    height = np.zeros_like(u)
    # Waves that close around the ring; half as high where twice as many.
    for octave in range(6):
        for _ in range(6):
            m, n = draw.integers(-4, 5) * 2**octave, draw.integers(1, 3) * 2**octave
            height += 0.02 / 2**octave * np.sin(m * u + n * v + draw.uniform(0, 2 * np.pi))
    minor = 0.36 + height
    ring = 1 + minor * np.cos(v)
    corners = np.stack([ring * np.cos(u), ring * np.sin(u), minor * np.sin(v)], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    a, b = i * across + j, (i + 1) % around * across + j
    c, d = (i + 1) % around * across + (j + 1) % across, i * across + (j + 1) % across
    triangles = np.stack([np.stack([a, b, c], axis=-1), np.stack([a, c, d], axis=-1)], axis=2).reshape(-1, 3)
    return corners, triangles


def write_ply(path, corners, triangles):
    """Binary, without normals: both renderers take those of the triangles."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_suffix(f".{os.getpid()}")
    faces = np.empty(len(triangles), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    faces["count"], faces["corners"] = 3, triangles
    head = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(corners)}\n"
        "property float x\nproperty float y\nproperty float z\n"
        f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    part.write_bytes(head.encode() + corners.astype("<f4").tobytes() + faces.tobytes())
    # Whole or not at all, for several processes may do this at once.
    os.replace(part, path)
