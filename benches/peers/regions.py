"""Which pixels show what: by casting rays through their corners and centres."""

import numpy as np

import mitsuba as mi

EDGES = "edges between objects"


def of(scene, description):
    """Masks by name, in the order of the scene file, that cover each pixel once.

    A pixel belongs to an object if its centre and corners see it, to `edges` if they differ. The floor is split by whether
    the middle of the lamp is seen from it; behind glass that is the place of the caustic.
    """
    objects = description["objects"]
    width, height = description["render"]["width"], description["render"]["height"]
    sensor = scene.sensors()[0]

    def seen(x, y):
        ray, _ = sensor.sample_ray(0.0, 0.5, mi.Point2f(x / width, y / height), mi.Point2f(0.5))
        hit = scene.ray_intersect(mi.Ray3f(ray.o, ray.d))
        if not hit.is_valid():
            return "sky", hit
        return objects[int(hit.shape.id().split()[-1])]["name"], hit

    # Just inside the picture, so that the outermost corners are too.
    corners = [
        [seen(min(max(x, 1e-3), width - 1e-3), min(max(y, 1e-3), height - 1e-3))[0] for x in range(width + 1)]
        for y in range(height + 1)
    ]
    lamp = next(entry for entry in objects if "emission" in entry)["shape"]["rectangle"]
    # A little in front of it, or the lamp would hide itself.
    target = np.array(lamp["center"]) + 1e-3 * np.array(lamp["normal"])
    names = np.empty((height, width), dtype=object)
    for y in range(height):
        for x in range(width):
            name, hit = seen(x + 0.5, y + 0.5)
            around = {corners[y + j][x + i] for i in (0, 1) for j in (0, 1)}
            if around != {name}:
                name = EDGES
            elif name == "floor":
                hidden = scene.ray_test(hit.spawn_ray_to(mi.Point3f(target)))
                name = "floor, lamp hidden" if hidden else "floor, lamp seen"
            names[y, x] = name
    order = ["sky"]
    for entry in objects:
        floor = entry["name"] == "floor"
        order += ["floor, lamp seen", "floor, lamp hidden"] if floor else [entry["name"]]
    masks = {"whole picture": np.ones((height, width), bool)}
    masks |= {name: names == name for name in [*order, EDGES] if (names == name).any()}
    return masks
