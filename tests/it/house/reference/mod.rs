//! `docs/reference.md` is written from `src/scene/describe.rs`, `lamps.rs`, `materials`, `pictures.rs` and `own_index.rs`, so that it cannot go stale: run with `WRITE_REFERENCE=1` after
//! a change there. Its examples are scenes that resolve.

mod parse;

use parse::{Item, Kind};
use spectrel::scene::Overrides;
use std::fmt::Write;

const SOURCE: &str = concat!(
    include_str!("../../../../src/scene/describe.rs"),
    "\n",
    include_str!("../../../../src/scene/lamps.rs"),
    "\n",
    include_str!("../../../../src/scene/materials/mod.rs"),
    "\n",
    include_str!("../../../../src/scene/materials/conductor.rs"),
    "\n",
    include_str!("../../../../src/scene/materials/dielectric.rs"),
    "\n",
    include_str!("../../../../src/scene/materials/diffuse.rs"),
    "\n",
    include_str!("../../../../src/scene/pictures.rs"),
    "\n",
    include_str!("../../../../src/scene/own_index.rs")
);
const PATH: &str = "docs/reference.md";

/// How a scene's TOML shows each part: one example below the part's heading, put into a whole scene by [`whole`].
const EXAMPLES: &[(&str, &str)] = &[
    ("Scene file", "meters_per_unit = 0.001    # millimetres\noutside = \"water\""),
    (
        "Render",
        "[render]\nwidth = 1200\nheight = 800\nsamples = 256\nseed = 3\nmax_depth = 40\nfilter = \"tent\"\nsampler = \"sobol\"\nfresnel = \"schlick\"",
    ),
    (
        "Camera",
        "[camera]\nposition = [0, -200, 120]\nlook_at = [0, 0, 4]\nup = [0, 0, 1]\nfocal_length_mm = 85\nsensor_width_mm = 36\nf_number = 8\nfocus_distance = 230\nblades = 7",
    ),
    (
        "Picture",
        "[picture]\nexposure = 9.5            # or \"auto\"\nwhite_balance = \"D50\"\ngamut = \"preserve-chroma\"\nobserver = \"cie-1931-2\"",
    ),
    ("Environment", "[environment.constant]\nspectrum = \"D65\"\nluminance = 120"),
    (
        "Sun light",
        "[[suns]]\ndirection = [0.3, -0.5, 0.8]\nangle = 0.533\nspectrum = { blackbody = 5778 }\nilluminance = 90000",
    ),
    (
        "Point light",
        "[[points]]\nposition = [0, 0, 300]\nspectrum = \"A\"\nluminous_flux = 400\ndirection = [0, 0, -1]\ncone_angle = 40\nfade = 10",
    ),
    (
        "Gradient",
        "[environment.gradient]\nzenith = { spectrum = { daylight = 7000 }, luminance = 300 }\nhorizon = { spectrum = \"D65\", luminance = 120 }\nnadir = { spectrum = \"A\", luminance = 10 }",
    ),
    (
        "Environment image",
        "[environment.image]\nfile = \"data/sky.hdr\"\nilluminant = \"D65\"\nluminance = 400       # or scale = 1\nrotate = 30\ncolor_space = \"srgb\"",
    ),
    (
        "Image texture",
        "[materials.sky.diffuse]\nreflectance = { image = \"data/sky.hdr\", scale = [3, 2], wrap = \"clamp\" }    # color_space = \"srgb\" for a PNG",
    ),
    (
        "Emission",
        "[[objects]]\nname = \"sodium lamp\"\nshape.disk = { center = [0, 0, 90], radius = 4, normal = [0, 0, -1] }\nemission = { spectrum = { lines = [[589.0, 2], [589.6, 1]] }, luminance = 5000, two_sided = true }",
    ),
    (
        "Own table",
        "[[objects]]\nshape.sphere = { center = [0, 0, 90], radius = 4 }\nemission = { spectrum = { table = { wavelength_nm = [400, 550, 700], value = [0.1, 1, 2] } }, radiance = 20 }",
    ),
    (
        "Conductor",
        "[materials.brushed-steel.conductor]\nior = \"stainless-steel/karlsson-1982-austenitic\"\nperceptual_roughness = 0.4\nfresnel = \"exact\"",
    ),
    ("Dielectric", "[materials.amber.dielectric]\nior = 1.54\nabsorption = 120           # 1/m, or a data set's name"),
    (
        "Diffuse",
        "[materials.terracotta.diffuse]\nreflectance = { rgb = [0.4, 0.12, 0.06] }    # linear sRGB; or 0.3, or \"colorchecker/orange\"",
    ),
    (
        "Object",
        "[[objects]]\nname = \"ring stone\"\nmaterial = \"ruby\"\nshape.brilliant = { diameter = 6 }\ntransform = { translate = [0, 0, 12] }",
    ),
    (
        "Convex",
        "[[objects]]\nmaterial = \"quartz\"\nshape.convex.planes = [[1, 0, 0, 2], [-1, 0, 0, 2], [0, 1, 0, 2], [0, -1, 0, 2], [0, 0, 1, 3], [0, 0, -1, 3]]",
    ),
    (
        "Brilliant",
        "[[objects]]\nmaterial = \"diamond\"\nshape.brilliant = { diameter = 6.5, table = 0.58, crown_angle = 34, pavilion_angle = 40.9, girdle = 0.03, culet = 0.01 }",
    ),
    (
        "Step cut",
        "[[objects]]\nmaterial = \"emerald\"\nshape.step-cut = { width = 6, length = 8, table = 0.65, pavilion_angles = [52, 46, 41] }",
    ),
    (
        "Transform",
        "[[objects]]\nmaterial = \"gold\"\nshape.box = { size = [20, 10, 3] }\ntransform = { scale = [1, 1, 0.5], rotate = [0, 0, 30], translate = [5, 0, 1] }",
    ),
];

const HEAD: &str = "# Scenes and materials\n\n\
    Every key of a scene file, and of the material files of `materials/`, which hold one entry of `[materials]` each. Names of\n\
    materials and data are those of `spectrel list`; names of files\n\
    (`.csv`, `.txt`, `.toml`, `.yml` and more, see [data files](data-files.md)) are relative to the scene.\n\
    This page is written from the program's own descriptions (`tests/it/house/reference`).\n";

fn reference() -> String {
    let items = parse::items(SOURCE);
    let mut page = HEAD.to_owned();
    for item in items.iter().filter(|item| item.shown()) {
        let title = item.title();
        let _ = write!(page, "\n## {title}\n\n{}\n", item.doc);
        match &item.kind {
            Kind::Keys(keys) => {
                let _ = write!(page, "\n| key | value | |\n|---|---|---|\n");
                for key in keys {
                    let _ = writeln!(page, "| `{}` | {}{} | {} |", key.name, key.value(&items), key.need(), key.doc);
                }
            }
            Kind::Choices(choices) => {
                let _ = write!(page, "\n| one of | value | |\n|---|---|---|\n");
                for choice in choices {
                    let _ = writeln!(page, "| `{}` | {} | {} |", choice.name, choice.value(&items), choice.doc);
                }
            }
        }
        if let Some((_, example)) = EXAMPLES.iter().find(|(name, _)| *name == title) {
            let _ = write!(page, "\n```toml\n{example}\n```\n");
        }
    }
    page
}

#[test]
fn the_reference_says_what_the_program_reads() {
    let written = reference();
    if std::env::var_os("WRITE_REFERENCE").is_some() {
        std::fs::write(PATH, &written).expect("a writable folder");
    }
    let page = std::fs::read_to_string(PATH).unwrap_or_default();
    assert!(page == written, "{PATH} is stale: run this test with WRITE_REFERENCE=1");
}

/// A scene around an example: what every scene needs and the example does not give.
fn whole(example: &str) -> String {
    let (camera, scale) = (!example.contains("[camera]"), !example.contains("meters_per_unit"));
    let mut text = String::new();
    if scale {
        text += "meters_per_unit = 0.001\n";
    }
    let at_top = if example.starts_with('[') { "" } else { example };
    text += &format!("{at_top}\n");
    if camera {
        text += "camera = { position = [0, -300, 200], look_at = [0, 0, 0], fov = 20 }\n";
    }
    if at_top.is_empty() {
        text += example;
    }
    text
}

#[test]
fn the_examples_are_scenes() {
    let titles: Vec<String> = parse::items(SOURCE).iter().map(Item::title).collect();
    for (title, example) in EXAMPLES {
        assert!(titles.iter().any(|known| known == title), "there is no part `{title}`");
        let text = whole(example);
        let used = match example.split("[materials.").nth(1) {
            Some(rest) => {
                let name = rest.split('.').next().expect("a name");
                format!("{text}\n[[objects]]\nmaterial = \"{name}\"\nshape.sphere.radius = 1\n")
            }
            None => text,
        };
        crate::common::scene(&used, &Overrides::default());
    }
}

#[test]
fn every_key_and_choice_is_explained_or_leads_to_an_explanation() {
    let items = parse::items(SOURCE);
    for item in items.iter().filter(|item| item.shown()) {
        assert!(!item.doc.is_empty(), "{} has no words", item.name);
        let (Kind::Keys(entries) | Kind::Choices(entries)) = &item.kind;
        for entry in entries {
            assert!(!entry.value(&items).is_empty() || !entry.doc.is_empty(), "{}.{}", item.name, entry.name);
        }
    }
}
