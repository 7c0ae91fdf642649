//! The scenes of the README and of the tutorial are scenes, and the tutorial's error is the program's.

use spectrel::scene::{Overrides, Scene, SceneError, Text, resolve};

const README: &str = include_str!("../../../README.md");
const TUTORIAL: &str = include_str!("../../../docs/tutorial.md");

#[test]
fn the_scene_of_the_readme_resolves() {
    let after = README.split("```toml\n").nth(1).expect("a TOML block");
    let text = after.split("```").next().expect("its end");
    let scene = crate::common::scene(text, &Overrides::default());
    assert_eq!(scene.objects.len(), 2);
    assert_eq!(scene.warnings, Vec::<String>::new());
}

/// The tutorial's file, where it says that it stands.
fn mine(text: &str) -> Result<Scene, SceneError> {
    resolve(Text::new("scenes/mine.toml", text), &crate::common::library(), &Overrides::default())
}

#[test]
fn every_step_of_the_tutorial_is_a_scene() {
    let mut text = String::new();
    let blocks: Vec<&str> = TUTORIAL.split("```toml\n").skip(1).filter_map(|rest| rest.split("```").next()).collect();
    for (block, objects) in blocks.iter().zip([1, 3, 4, 5]) {
        text += block;
        let scene = mine(&text).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(scene.objects.len(), objects);
        assert_eq!(scene.warnings, Vec::<String>::new());
    }
    assert_eq!(blocks.len(), 4);
    let said = TUTORIAL.split("```text\n").nth(1).and_then(|rest| rest.split("```").next()).expect("an error");
    let misspelt = text.replacen("material = \"gold\"", "material = \"goild\"", 1);
    let error = format!("error: {}\n", mine(&misspelt).expect_err("a misspelt metal"));
    assert_eq!(error, said);
}

/// The gallery and the README show what is there, and every scene of the repository resolves.
#[test]
fn every_scene_resolves_and_every_picture_is_there() {
    for entry in std::fs::read_dir("scenes").expect("scenes") {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            let text = std::fs::read_to_string(&path).expect("text");
            resolve(Text::new(&path, text), &crate::common::library(), &Overrides::default())
                .unwrap_or_else(|error| panic!("{error}"));
        }
    }
    for (page, folder) in [(README, ""), (include_str!("../../../docs/gallery.md"), "docs/")] {
        for link in page.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            if !link.starts_with("http") {
                let path = format!("{folder}{}", link.split('#').next().unwrap_or(link));
                assert!(std::path::Path::new(&path).exists(), "{path}");
            }
        }
    }
}
