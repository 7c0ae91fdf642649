//! Solids that touch, overlap and stand in each other, against piles of plates worked out on paper.
//!
//! Blocks wide enough to be plates: glass on water face to face is one boundary between two media, whether the faces are boxes'
//! or meshes', along the axes or turned so that rounding parts them; overlaps belong to one of the two; shells hold what is in
//! them. Expected is the series of `common::plates` for the media in their order; a film of air between them, or the other order
//! of rank, must be rejected.

use crate::common::compare::{apart, renders};
use crate::common::files::{cuboid, hollowed, obj};
use crate::common::plates::{Layer, check_by, half_sky, looking, pile, seen};
use crate::common::{film, lanes::with, mean, scene};
use glam::{DMat3, DVec3};
use std::path::Path;

const COSINES: [f64; 3] = [1.0, std::f64::consts::FRAC_1_SQRT_2, 0.3];

const GLASS: (f64, f64) = (1.5, 0.3);
const WATER: (f64, f64) = (4.0 / 3.0, 0.2);
const DIAMOND: (f64, f64) = (2.42, 0.1);
const AIR: Layer = (1.0, 0.0, 1.0);

fn layer((n, absorption): (f64, f64), thickness: f64) -> Layer {
    (n, absorption, thickness)
}

fn materials() -> String {
    [("glass", GLASS), ("water", WATER), ("diamond", DIAMOND), ("air", (1.0, 0.0))]
        .map(|(name, (n, a))| format!("materials.{name}.dielectric = {{ ior = {n}, absorption = {a} }}\n"))
        .concat()
}

/// Samples a pixel.
const SAMPLES: u32 = 48;

/// How a block is made.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Box,
    Mesh,
}

const PAIRS: [[Kind; 2]; 4] =
    [[Kind::Box, Kind::Box], [Kind::Mesh, Kind::Mesh], [Kind::Box, Kind::Mesh], [Kind::Mesh, Kind::Box]];

/// A block between two heights.
fn block(folder: &Path, kind: Kind, width: f64, [low, high]: [f64; 2]) -> String {
    let (center, height) = (0.5 * (low + high), high - low);
    match kind {
        Kind::Box => format!("shape.box = {{ size = [{width}, {width}, {height}], center = [0, 0, {center}] }}"),
        Kind::Mesh => {
            let size = [width as f32, width as f32, height as f32];
            obj(folder, &format!("block {width} {low} {high}"), &cuboid([0.0, 0.0, center as f32], size))
        }
    }
}

fn object(material: &str, shape: &str, more: &str) -> String {
    format!("[[objects]]\nname = \"{material}\"\nmaterial = \"{material}\"\n{shape}\n{more}\n")
}

/// Light through piles of blocks from a sky below, under each angle.
fn through(name: &str, top: f64, objects: &str, layers: &[Layer], wrong: &[&[Layer]]) {
    for cos in COSINES {
        let light = |layers: &[Layer]| 100.0 * cos * pile(1.0, layers, 1.0, cos).t;
        let text = format!("{}{}{}{objects}", seen(top * DVec3::Z, cos, 1), half_sky("\"E\"", false), materials());
        let wrong: Vec<f64> = wrong.iter().map(|layers| light(layers)).collect();
        check_by(64, &format!("{name}, cos {cos:.1}"), &mut scene(&text, &with(8, SAMPLES)), light(layers), &wrong);
    }
}

#[test]
fn glass_on_water_is_one_optical_contact() {
    let folder = tempfile::tempdir().expect("a folder");
    let (upper, lower) = (layer(GLASS, 1.0), layer(WATER, 1.0));
    for [first, second] in PAIRS {
        let glass = object("glass", &block(folder.path(), first, 200.0, [0.0, 1.0]), "");
        let water = object("water", &block(folder.path(), second, 180.0, [-1.0, 0.0]), "");
        // In either order of the objects.
        for objects in [format!("{glass}{water}"), format!("{water}{glass}")] {
            let name = format!("{first:?} on {second:?}");
            through(&name, 1.0, &objects, &[upper, lower], &[&[upper, AIR, lower]]);
        }
    }
}

#[test]
#[ignore = "long: many seconds of paths"]
fn an_overlap_belongs_to_the_smaller_or_to_whom_the_scene_says() {
    let folder = tempfile::tempdir().expect("a folder");
    for [first, second] in PAIRS {
        let glass = |more| object("glass", &block(folder.path(), first, 200.0, [-0.5, 1.0]), more);
        let water = |more| object("water", &block(folder.path(), second, 180.0, [-1.0, 0.0]), more);
        let by_water = [layer(GLASS, 1.0), layer(WATER, 1.0)];
        let by_glass = [layer(GLASS, 1.5), layer(WATER, 0.5)];
        let unsaid = glass("") + &water("");
        let name = format!("{first:?} into {second:?}");
        through(&format!("{name}, unsaid"), 1.0, &unsaid, &by_water, &[&by_glass]);
        let said = glass("priority = 1") + &water("");
        through(&format!("{name}, glass first"), 1.0, &said, &by_glass, &[&by_water]);
        let warnings = |objects: &str| {
            let text = format!("{}{}{objects}", seen(DVec3::Z, 1.0, 1), materials());
            scene(&text, &with(8, 1)).warnings
        };
        let unsaid = warnings(&unsaid);
        assert!(unsaid.iter().any(|w| w.contains("overlap") && w.contains("`water` fills")), "{name}: {unsaid:?}");
        assert!(!warnings(&said).iter().any(|w| w.contains("overlap")), "{name}");
    }
}

/// From less than a rounding of these coordinates to far more. One render each: what was lost here was a tenth or all.
#[test]
fn an_overlap_of_a_hair_changes_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let layers = [layer(GLASS, 1.0), layer(WATER, 1.0)];
    for [first, second] in PAIRS {
        for hair in [1e-5, 3e-5, 6e-5, 8e-5, 1e-4, 1.2e-4, 1.5e-4, 2e-4, 3e-4, 6e-4] {
            for glass_above in [true, false] {
                let heights = |[low, high]: [f64; 2]| if glass_above { [low, high] } else { [-high, -low] };
                let glass = object("glass", &block(folder.path(), first, 200.0, heights([-hair, 1.0])), "");
                let water = object("water", &block(folder.path(), second, 180.0, heights([-1.0, 0.0])), "");
                for cos in [1.0, 0.3] {
                    let head = seen(DVec3::Z, cos, 1) + &half_sky("\"E\"", false) + &materials();
                    let light = mean(&film(&scene(&format!("{head}{glass}{water}"), &with(8, 128))))[1];
                    let off = light / (100.0 * cos * pile(1.0, &layers, 1.0, cos).t) - 1.0;
                    let name = format!("{first:?} {hair} into {second:?}, cos {cos}, glass above: {glass_above}");
                    assert!(off.abs() < 0.02, "{name}: off by {off:+.3}");
                }
            }
        }
    }
}

/// Turned about all axes, so that faces which coincide on paper are a rounding apart or in each other.
#[test]
fn contact_survives_a_turn() {
    let folder = tempfile::tempdir().expect("a folder");
    let turn = DMat3::from_rotation_z(30f64.to_radians())
        * DMat3::from_rotation_y(20f64.to_radians())
        * DMat3::from_rotation_x(10f64.to_radians());
    let (upper, lower) = (layer(GLASS, 1.0), layer(WATER, 1.0));
    let rotate = "transform.rotate = [10, 20, 30]";
    for [first, second] in PAIRS {
        let glass = object("glass", &block(folder.path(), first, 200.0, [0.0, 1.0]), rotate);
        let water = object("water", &block(folder.path(), second, 180.0, [-1.0, 0.0]), rotate);
        for cos in COSINES {
            let (at, from) = (DVec3::Z, DVec3::Z + 9.0 * DVec3::new((1.0 - cos * cos).sqrt(), 0.0, cos));
            let (normal, center) = (turn * DVec3::Z, turn * (-2.0 * DVec3::Z));
            let lamp = format!(
                "[[objects]]\nshape.rectangle = {{ size = [170, 170], center = {:?}, normal = {:?} }}
                emission = {{ spectrum = \"E\", luminance = 100 }}\n",
                center.to_array(),
                normal.to_array()
            );
            let text = format!("{}{}{glass}{water}{lamp}", looking(turn * from, turn * at, 1), materials());
            let light = |layers: &[Layer]| 100.0 * pile(1.0, layers, 1.0, cos).t;
            let name = format!("turned {first:?} on {second:?}, cos {cos:.1}");
            let (right, gap) = (light(&[upper, lower]), light(&[upper, AIR, lower]));
            check_by(64, &name, &mut scene(&text, &with(8, SAMPLES)), right, &[gap]);
        }
    }
}

#[test]
#[ignore = "long: many seconds of paths"]
fn two_blocks_of_one_glass_are_one_block() {
    let folder = tempfile::tempdir().expect("a folder");
    let (half, whole) = (layer(GLASS, 1.0), layer(GLASS, 2.0));
    for [first, second] in PAIRS {
        for overlap in [0.0, 0.25] {
            let upper = object("glass", &block(folder.path(), first, 200.0, [-overlap, 1.0]), "");
            let lower = object("glass", &block(folder.path(), second, 180.0, [-1.0, 0.0]), "");
            let name = format!("{first:?} on {second:?}, {overlap} shared");
            through(&name, 1.0, &(upper + &lower), &[whole], &[&[half, AIR, half]]);
        }
    }
}

/// Where rough glass touches the same glass there is nothing to scatter; across a gap there is.
#[test]
fn two_blocks_of_one_rough_glass_are_one_block() {
    let folder = tempfile::tempdir().expect("a folder");
    let glass = "materials.frosted.dielectric = { ior = 1.5, absorption = 0.3, roughness = 0.2 }\n";
    let pictures = |objects: &str, first: u64| {
        let text = seen(DVec3::Z, 0.7, 1) + &half_sky("\"E\"", false) + glass + objects;
        renders(&mut scene(&text, &with(8, 4 * SAMPLES)), first..first + 16)
    };
    let frosted = |kind, heights| object("frosted", &block(folder.path(), kind, 200.0, heights), "");
    let one = pictures(&frosted(Kind::Box, [-1.0, 1.0]), 0);
    for [first, second] in PAIRS {
        let (upper, lower) = (frosted(first, [0.0, 1.0]), frosted(second, [-1.0, 0.0]));
        let found = apart(&one, &pictures(&(upper.clone() + &lower), 100), [2, 2]);
        println!("frosted {first:?} on {second:?}: {found:.4?}");
        assert!(found.agrees() && found.relative < 5e-3, "{first:?} on {second:?}: {found:?}");
        let gap = frosted(second, [-1.01, -0.01]);
        let found = apart(&one, &pictures(&(upper + &gap), 100), [2, 2]);
        assert!(!found.agrees(), "{first:?} over {second:?}: {found:?}");
    }
}

#[test]
#[ignore = "long: many seconds of paths"]
fn shells_hold_what_is_in_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let box_of = |width, heights| block(folder, Kind::Box, width, heights);
    // By size alone: air in water in glass.
    let nested = object("glass", &box_of(200.0, [-1.0, 1.0]), "")
        + &object("air", &box_of(190.0, [-0.25, 0.25]), "")
        + &object("water", &box_of(195.0, [-0.5, 0.5]), "");
    let [wall, fill] = [layer(GLASS, 0.5), layer(WATER, 0.25)];
    through("air in water in glass", 1.0, &nested, &[wall, fill, AIR, fill, wall], &[&[layer(GLASS, 2.0)]]);
    // A solid with a hollow, and water that reaches into its walls.
    let hollow = cuboid([0.0; 3], [190.0, 190.0, 1.0]);
    let shell = obj(folder, "shell", &hollowed(cuboid([0.0; 3], [200.0, 200.0, 2.0]), &hollow));
    let empty = object("glass", &shell, "");
    through("an empty shell", 1.0, &empty, &[wall, AIR, wall], &[&[wall, layer(WATER, 1.0), wall]]);
    let (thin, thick) = (layer(GLASS, 0.375), layer(WATER, 1.25));
    let (as_shell, as_water) = ([wall, layer(WATER, 1.0), wall], [thin, thick, thin]);
    for kind in [Kind::Box, Kind::Mesh] {
        let water = |more| object("water", &block(folder, kind, 195.0, [-0.625, 0.625]), more);
        for (name, objects, right, wrong) in [
            ("glass first", object("glass", &shell, "priority = 2") + &water("priority = 1"), as_shell, as_water),
            ("water first", object("glass", &shell, "priority = -1") + &water(""), as_water, as_shell),
        ] {
            let gap = [wall, AIR, layer(WATER, 1.0), AIR, wall];
            through(&format!("{kind:?} of water in a shell, {name}"), 1.0, &objects, &right, &[&wrong, &gap]);
        }
        // Just as large as the hollow.
        let water = object("water", &block(folder, kind, 190.0, [-0.5, 0.5]), "");
        let name = format!("{kind:?} of water that fills a shell");
        through(&name, 1.0, &(empty.clone() + &water), &as_shell, &[&[wall, AIR, layer(WATER, 1.0), AIR, wall]]);
    }
}

/// Beside a small block on a large one there is nothing but the large one.
#[test]
#[ignore = "long: many seconds of paths"]
fn contact_ends_where_the_smaller_block_ends() {
    let folder = tempfile::tempdir().expect("a folder");
    let (upper, lower) = (layer(GLASS, 1.0), layer(WATER, 1.0));
    for [first, second] in PAIRS {
        let objects = object("glass", &block(folder.path(), first, 2.0, [0.0, 1.0]), "")
            + &object("water", &block(folder.path(), second, 180.0, [-1.0, 0.0]), "");
        let (both, one) = ([upper, lower], [lower]);
        for (x, layers, wrong) in
            [(0.0, &both[..], &one[..]), (0.97, &both, &one), (1.03, &one, &both), (5.0, &one, &both)]
        {
            for (above, sign) in [(true, 1.0), (false, -1.0)] {
                let at = DVec3::X * x;
                let sky = half_sky("\"E\"", !above);
                let text = format!("{}{sky}{}{objects}", looking(at + sign * 9.0 * DVec3::Z, at, 1), materials());
                let [expected, wrong] = [layers, wrong].map(|layers| 100.0 * pile(1.0, layers, 1.0, 1.0).t);
                let name = format!("{first:?} on {second:?} at {x}, from above: {above}");
                check_by(64, &name, &mut scene(&text, &with(8, SAMPLES)), expected, &[wrong]);
            }
        }
    }
}
