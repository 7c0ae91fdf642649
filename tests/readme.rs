//! The README's scene is a scene.

mod common;

use spectrel::scene::Overrides;

const README: &str = include_str!("../README.md");

#[test]
fn the_scene_of_the_readme_resolves() {
    let after = README.split("```toml\n").nth(1).expect("a TOML block");
    let text = after.split("```").next().expect("its end");
    let scene = common::scene(text, &Overrides::default());
    assert_eq!(scene.objects.len(), 2);
    assert_eq!(scene.warnings, Vec::<String>::new());
}
