//! What each room may use, read from its `use crate::` lines.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Every room and the rooms it may use besides itself.
const ALLOWED: &[(&str, &[&str])] = &[
    ("files", &[]),
    ("spectrum", &["files"]),
    ("fresnel", &["spectrum"]),
    ("bsdf", &["spectrum", "fresnel"]),
    ("geometry", &["files"]),
    ("sampler", &[]),
    ("memory", &[]),
    ("texture", &["spectrum", "memory"]),
    ("light", &["spectrum", "geometry"]),
    ("camera", &["spectrum", "geometry"]),
    ("scene", &["spectrum", "fresnel", "bsdf", "geometry", "texture", "light", "camera"]),
    ("film", &["spectrum"]),
    ("render", &["spectrum", "fresnel", "bsdf", "geometry", "sampler", "texture", "light", "camera", "scene", "film"]),
    (
        "adaptive",
        &[
            "spectrum", "fresnel", "bsdf", "geometry", "sampler", "texture", "light", "camera", "scene", "film",
            "render",
        ],
    ),
    ("image", &["film", "spectrum"]),
    ("report", &["image", "film", "spectrum", "fresnel"]),
    ("cli", &["*"]),
];

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("src is there").map(|entry| entry.expect("readable").path());
    let (folders, files): (Vec<_>, Vec<_>) = entries.partition(|path| path.is_dir());
    files.into_iter().chain(folders.iter().flat_map(|folder| sources(folder))).collect()
}

/// The room of a file: its folder below `src`, or its own name.
fn room(path: &Path) -> String {
    let below = path.strip_prefix("src").expect("below src");
    let first = below.components().next().expect("a name").as_os_str().to_string_lossy();
    first.trim_end_matches(".rs").to_owned()
}

/// Rooms named after `crate::` in code; comments and doc links are free to name any.
fn used_rooms(text: &str) -> BTreeSet<String> {
    let code = text.lines().map(str::trim_start).filter(|line| !line.starts_with("//"));
    code.flat_map(|line| line.split("crate::").skip(1).map(str::to_owned).collect::<Vec<_>>())
        .map(|rest| rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>())
        .filter(|name| !name.is_empty())
        .collect()
}

fn broken_rules() -> Vec<String> {
    let rules = |name: &str| ALLOWED.iter().find(|(room, _)| *room == name).map(|(_, allowed)| *allowed);
    let mut broken = Vec::new();
    for path in sources(Path::new("src")) {
        let own = room(&path);
        if own == "main" || own == "lib" {
            continue;
        }
        let Some(allowed) = rules(&own) else {
            broken.push(format!("{}: `{own}` is no room of the house", path.display()));
            continue;
        };
        for used in used_rooms(&fs::read_to_string(&path).expect("readable")) {
            let fine = used == own || allowed == ["*"] || allowed.contains(&used.as_str());
            if !fine {
                broken.push(format!("{} uses `{used}`, which {own} may not", path.display()));
            }
        }
    }
    broken
}

#[test]
fn every_room_keeps_to_the_rooms_it_may_use() {
    assert_eq!(broken_rules(), Vec::<String>::new());
}

#[test]
fn the_reader_of_use_lines_sees_what_it_must() {
    let text = "use crate::scene::Scene;\n// crate::cli is fine here\nlet x = crate::film::Film::new();\nuse std::fmt;";
    assert_eq!(used_rooms(text), BTreeSet::from(["scene".to_owned(), "film".to_owned()]));
    assert_eq!(room(Path::new("src/render/path.rs")), "render");
    assert_eq!(room(Path::new("src/sampler.rs")), "sampler");
}
