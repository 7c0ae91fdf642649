"""A spectrel scene file as a Mitsuba scene: same geometry, same camera, same tables.

Only what the comparison scenes use is known; anything else stops the run, so that no difference slips in unnoticed.
"""

import tomllib
from pathlib import Path

import numpy as np

import mitsuba as mi
import solids
import spectra
from environment import WORK


def load(path):
    """A scene file, with the names of the files in it as seen from here."""
    with open(path, "rb") as file:
        description = tomllib.load(file)
    for entry in description["objects"]:
        if "mesh" in entry["shape"]:
            entry["shape"]["mesh"]["file"] = str(Path(path).parent / entry["shape"]["mesh"]["file"])
    return description


def only(entry, *known):
    """Fails on a key that the translation would silently drop."""
    unknown = set(entry) - set(known)
    if unknown:
        raise SystemExit(f"not translated: {', '.join(sorted(unknown))}")
    return entry


def spectrum(nm, value):
    return {
        "type": "irregular",
        "wavelengths": ", ".join(repr(float(x)) for x in nm),
        "values": ", ".join(repr(float(x)) for x in value),
    }


def constant(value):
    """The same at every wavelength. A plain number would be upsampled from RGB."""
    return {"type": "uniform", "value": float(value)}


def emission(entry):
    return spectrum(*spectra.emission(only(entry, "spectrum", "radiance")))


def bsdf(material, correlated):
    only(material, "conductor", "dielectric", "diffuse")
    if "diffuse" in material:
        name = only(material["diffuse"], "reflectance")["reflectance"]
        inner = {"type": "diffuse", "reflectance": spectrum(*spectra.reflectance(name))}
        return {"type": "twosided", "bsdf": inner}
    if "dielectric" in material:
        n = only(material["dielectric"], "ior")["ior"]
        return {"type": "dielectric", "int_ior": float(n), "ext_ior": 1.0}
    metal = only(material["conductor"], "ior", "roughness")
    n, k = spectra.ior(metal["ior"])
    optics = {"eta": spectrum(*n), "k": spectrum(*k)}
    if "roughness" not in metal:
        return {"type": "conductor", **optics}
    rough = {
        "type": "roughconductor",
        "distribution": "ggx",
        "alpha": metal["roughness"],
        "sample_visible": True,
        **optics,
    }
    if correlated:
        return {"type": "correlated", "alpha": metal["roughness"], "inner": rough}
    return rough


def transform(place):
    """Of an object: about the x axis, then along."""
    x, y, z = only(place, "rotate", "translate").get("rotate", [0, 0, 0])
    if y or z:
        raise SystemExit("not translated: a rotation about y or z")
    return mi.ScalarTransform4f().translate(place.get("translate", [0, 0, 0])).rotate([1, 0, 0], x)


def mesh(path, to_world):
    return {"type": "ply", "filename": str(path), "face_normals": True, "to_world": to_world}


def cut(proportions, to_world):
    """A convex solid of spectrel's, as triangles."""
    name = " ".join(f"{key} {value}" for key, value in sorted(proportions.items()))
    path = WORK / "meshes" / f"brilliant {name}.ply"
    solids.write_ply(path, *solids.brilliant(proportions))
    return mesh(path, to_world)


def shape(entry, place):
    kind, value = next(iter(only(entry, "sphere", "rectangle", "box", "brilliant", "mesh").items()))
    if kind == "mesh":
        return mesh(only(value, "file")["file"], transform(place))
    if kind == "brilliant":
        return cut(value, transform(place))
    # The others stand where they say.
    only(place)
    center = value.get("center", [0, 0, 0])
    if kind == "sphere":
        return {"type": "sphere", "center": center, "radius": value["radius"]}
    if kind == "box":
        half = [x / 2 for x in value["size"]]
        to_world = mi.ScalarTransform4f().translate(center).scale(half)
        return {"type": "cube", "to_world": to_world}
    normal = np.array(only(value, "center", "size", "normal").get("normal", [0, 0, 1]), float)
    normal /= np.linalg.norm(normal)
    # The width of a spectrel rectangle is level; where every direction is, it lies along x.
    u = np.cross([0, 0, 1], normal)
    u = u / np.linalg.norm(u) if np.linalg.norm(u) > 1e-9 else np.array([1.0, 0, 0])
    v = np.cross(normal, u)
    matrix = np.eye(4)
    matrix[:3, 0] = u * value["size"][0] / 2
    matrix[:3, 1] = v * value["size"][1] / 2
    matrix[:3, 2] = normal
    matrix[:3, 3] = center
    return {"type": "rectangle", "to_world": mi.ScalarTransform4f(matrix)}


def sensor(description, sampler, size):
    camera = only(description["camera"], "position", "look_at", "fov")
    width, height = size
    return {
        "type": "perspective",
        "fov": camera["fov"],
        "fov_axis": "x",
        "near_clip": 1e-3,
        "to_world": mi.ScalarTransform4f().look_at(camera["position"], camera["look_at"], [0, 0, 1]),
        "film": {
            "type": "hdrfilm",
            "width": width,
            "height": height,
            "pixel_format": "xyz",
            "component_format": "float32",
            "rfilter": {"type": "box"},
        },
        "sampler": {"type": sampler},
    }


def size(description):
    return description["render"]["width"], description["render"]["height"]


def scene(description, correlated=False, views=None):
    """The dictionary that Mitsuba loads. Shapes are named `object 0`, `object 1`, … in the order of the file.

    `views`, of a sampler and a size in pixels each, become its sensors in this order; one of the file's size unless given.
    """
    only(description, "render", "camera", "environment", "materials", "objects")
    settings = only(description["render"], "width", "height", "samples", "filter")
    assert settings["filter"] == "box"
    result = {"type": "scene", "integrator": {"type": "path", "max_depth": -1}}
    for number, view in enumerate(views or [("multijitter", size(description))]):
        result[f"sensor {number}"] = sensor(description, *view)
    if "environment" in description:
        sky = only(description["environment"], "constant")["constant"]
        result["sky"] = {"type": "constant", "radiance": emission(sky)}
    materials = {name: bsdf(material, correlated) for name, material in description["materials"].items()}
    for number, entry in enumerate(description["objects"]):
        only(entry, "name", "material", "shape", "emission", "transform")
        translated = shape(entry["shape"], entry.get("transform", {}))
        if "emission" in entry:
            translated["emitter"] = {"type": "area", "radiance": emission(entry["emission"])}
        # A lamp without a material is black in spectrel, half grey in Mitsuba.
        translated["bsdf"] = (
            materials[entry["material"]] if "material" in entry else {"type": "diffuse", "reflectance": constant(0)}
        )
        translated["id"] = f"object {number}"
        result[f"object {number}"] = translated
    return result


class Correlated(mi.BSDF):
    """Mitsuba's rough conductor with the height-correlated Smith term in place of the separable one.

    Mitsuba takes G = G1(wi) G1(wo), spectrel G2 = 1 / (1 + Λ(wi) + Λ(wo)) (E. Heitz 2014, "Understanding the
    masking-shadowing function in microfacet-based BRDFs", equation 99). With G1 = 1 / (1 + Λ), all that differs is the
    factor (1 + Λi)(1 + Λo) / (1 + Λi + Λo); directions are drawn as before.
    """

    def __init__(self, props):
        mi.BSDF.__init__(self, props)
        self.alpha = props["alpha"]
        self.inner = props["inner"]
        self.m_components = [self.inner.flags(i) for i in range(self.inner.component_count())]
        self.m_flags = self.inner.flags()

    def factor(self, wi, wo):
        def smith_lambda(w):
            tan2 = max(0.0, 1 - w.z * w.z) / (w.z * w.z)
            return ((1 + self.alpha**2 * tan2) ** 0.5 - 1) / 2

        if wi.z <= 0 or wo.z <= 0:
            return 0.0
        a, b = smith_lambda(wi), smith_lambda(wo)
        return (1 + a) * (1 + b) / (1 + a + b)

    def sample(self, ctx, si, sample1, sample2, active=True):
        drawn, weight = self.inner.sample(ctx, si, sample1, sample2, active)
        return drawn, weight * self.factor(si.wi, drawn.wo)

    def eval(self, ctx, si, wo, active=True):
        return self.inner.eval(ctx, si, wo, active) * self.factor(si.wi, wo)

    def pdf(self, ctx, si, wo, active=True):
        return self.inner.pdf(ctx, si, wo, active)

    def eval_pdf(self, ctx, si, wo, active=True):
        value, pdf = self.inner.eval_pdf(ctx, si, wo, active)
        return value * self.factor(si.wi, wo), pdf

    def to_string(self):
        return f"Correlated[{self.inner}]"


def register():
    """Once a variant is chosen."""
    mi.register_bsdf("correlated", Correlated)
