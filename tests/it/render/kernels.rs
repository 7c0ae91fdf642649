//! A scene is rendered by the smallest kernel that does what it needs; larger ones give the same picture, to the bit.

use crate::common::{film, film_by, scene};
use spectrel::render::{COMPILED, Kernel};
use spectrel::scene::{Needs, Overrides, Physics};

const METALS: &str = include_str!("../../../scenes/metals.toml");
const GLASS: &str = include_str!("../../../benches/peers/glass.toml");
const DIAMOND: &str = include_str!("../../../scenes/diamond.toml");
const CONTACT: &str = include_str!("../../../scenes/gold-in-water.toml");
const PICTURES: &str = include_str!("../../data/pictures.toml");
const ROUGH: &str = include_str!("../../../scenes/rough-glass.toml");

fn small(fresnel: Option<&str>) -> Overrides {
    Overrides {
        width: Some(24),
        height: Some(16),
        samples: Some(4),
        fresnel: fresnel.map(|name| name.parse().expect("a model")),
        ..Overrides::default()
    }
}

#[test]
fn every_kernel_that_suffices_gives_the_same_picture() {
    for (name, text) in [
        ("metals", METALS),
        ("glass", GLASS),
        ("diamond", DIAMOND),
        ("contact", CONTACT),
        ("rough glass", ROUGH),
        ("pictures", PICTURES),
    ] {
        for fresnel in [None, Some("schlick"), Some("rgb-exact")] {
            let scene = scene(text, &small(fresnel));
            let needs = Needs::of(&scene);
            let expected = film(&scene);
            let suffice: Vec<_> = COMPILED.iter().filter(|compiled| compiled.contains(needs.physics)).collect();
            assert_eq!(Kernel::new(&scene, &needs).physics(), *suffice[0], "{name} takes the smallest");
            for &&physics in &suffice {
                let kernel = Kernel::new(&scene, &needs).compiled_for(physics);
                assert_eq!(kernel.physics(), physics);
                assert!(film_by(&kernel, &scene) == expected, "{name}, {fresnel:?}, {physics:?}");
            }
        }
    }
}

#[test]
fn a_kernel_that_lacks_what_a_scene_needs_is_not_taken() {
    let scene = scene(CONTACT, &small(Some("schlick")));
    let needs = Needs::of(&scene);
    assert!(needs.physics.contains(Physics::CONTACT | Physics::APPROXIMATIONS));
    for &physics in COMPILED {
        assert_eq!(Kernel::new(&scene, &needs).compiled_for(physics).physics(), Physics::ALL);
    }
}

#[test]
fn kernels_are_compiled_from_the_smallest_to_the_one_for_everything() {
    assert!(COMPILED.windows(2).all(|pair| pair[1].contains(pair[0]) && pair[0] != pair[1]));
    assert_eq!(COMPILED.last(), Some(&Physics::ALL));
}
