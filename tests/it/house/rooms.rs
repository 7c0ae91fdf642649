//! What each room may use, read from its `use crate::` lines.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Every room and the rooms it may use besides itself.
const ALLOWED: &[(&str, &[&str])] = &[
    ("files", &[]),
    ("math", &[]),
    ("spectrum", &["files", "math"]),
    ("fresnel", &["spectrum", "math"]),
    ("bsdf", &["spectrum", "fresnel", "math"]),
    ("geometry", &["files", "math"]),
    ("sampler", &[]),
    ("memory", &[]),
    ("texture", &["spectrum", "memory"]),
    ("light", &["spectrum", "geometry", "math"]),
    ("camera", &["spectrum", "geometry", "math"]),
    ("scene", &["math", "spectrum", "fresnel", "bsdf", "geometry", "texture", "light", "camera"]),
    ("film", &["spectrum"]),
    (
        "render",
        &["math", "spectrum", "fresnel", "bsdf", "geometry", "sampler", "texture", "light", "camera", "scene", "film"],
    ),
    (
        "adaptive",
        &[
            "math", "spectrum", "fresnel", "bsdf", "geometry", "sampler", "texture", "light", "camera", "scene",
            "film", "render",
        ],
    ),
    ("image", &["film", "spectrum"]),
    ("report", &["image", "film", "spectrum", "fresnel", "math"]),
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

/// Siblings that import each other all the same, which are to be parted.
const CIRCLES: &[&[&str]] = &[
    &["scene::resolve::bodies", "scene::resolve::meshes", "scene::resolve::objects"],
    &["spectrum::noise", "spectrum::table"],
];

/// Where a module stands: the names from its room down.
type Place = Vec<String>;

/// The place of a file; of a folder, if the file is its `mod.rs`.
fn place(path: &Path) -> Place {
    let below = path.strip_prefix("src").expect("below src").with_extension("");
    let mut names: Place = below.components().map(|name| name.as_os_str().to_string_lossy().into_owned()).collect();
    names.pop_if(|last| last == "mod");
    names
}

/// The paths of a tree such as `a::{b, c::{d, e}}`.
fn branches(tree: &str) -> Vec<String> {
    let Some((stem, inner)) = tree.trim().strip_suffix('}').and_then(|tree| tree.split_once('{')) else {
        return vec![tree.trim().to_owned()];
    };
    let (mut depth, mut parts) = (0, vec![String::new()]);
    for sign in inner.chars() {
        depth += i32::from(sign == '{') - i32::from(sign == '}');
        match sign {
            ',' if depth == 0 => parts.push(String::new()),
            _ => parts.last_mut().expect("one at least").push(sign),
        }
    }
    let parts = parts.iter().filter(|part| !part.trim().is_empty());
    parts.flat_map(|part| branches(part)).map(|branch| format!("{stem}{branch}")).collect()
}

/// What a file imports of the house, tests beside the code left out; modules inside of it stand one level deeper.
fn imports(text: &str, own: &Place) -> Vec<Place> {
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
    let mut statements: Vec<(usize, String)> = Vec::new();
    for line in lines {
        let words = line.trim_start();
        let begins = words.starts_with("use ") || (words.starts_with("pub") && words.contains(" use "));
        match statements.last_mut() {
            Some((_, open)) if !open.ends_with(';') => open.push_str(words),
            _ if begins => statements.push((line.len() - words.len(), words.to_owned())),
            _ => {}
        }
    }
    let resolved = |(indent, statement): &(usize, String)| {
        let tree = statement.trim_end_matches(';').split_once("use ").map_or("", |(_, tree)| tree);
        let inside = if *indent > 0 { vec!["inside".to_owned()] } else { vec![] };
        let from = [own.clone(), inside].concat();
        branches(tree).into_iter().filter_map(|branch| reached(&branch, from.clone())).collect::<Vec<_>>()
    };
    statements.iter().flat_map(resolved).collect()
}

/// The place that a path names, seen from another one; `None` if it is not of the house.
fn reached(path: &str, mut from: Place) -> Option<Place> {
    let mut names = path.split("::").map(str::trim).peekable();
    match *names.peek()? {
        "crate" => {
            names.next();
            from.clear();
        }
        "super" => {
            while names.next_if_eq(&"super").is_some() {
                from.pop();
            }
        }
        _ => return None,
    }
    from.extend(names.map(str::to_owned));
    Some(from)
}

/// Of every module those of the same folder that it, or a file below it, imports.
fn siblings_used() -> BTreeMap<Place, BTreeSet<Place>> {
    let paths = sources(Path::new("src"));
    let modules: BTreeSet<Place> = paths.iter().map(|path| place(path)).collect();
    let mut used: BTreeMap<Place, BTreeSet<Place>> = BTreeMap::new();
    for path in paths {
        let own = place(&path);
        for other in imports(&fs::read_to_string(&path).expect("readable"), &own) {
            let shared = own.iter().zip(&other).take_while(|(a, b)| a == b).count();
            if let (Some(own), Some(other)) = (own.get(..=shared), other.get(..=shared))
                && modules.contains(other)
            {
                used.entry(own.to_vec()).or_default().insert(other.to_vec());
            }
        }
    }
    used
}

/// All that is used, and used by what is used.
fn all_used(used: &BTreeMap<Place, BTreeSet<Place>>, by: &Place) -> BTreeSet<Place> {
    let (mut found, mut open) = (BTreeSet::new(), vec![by]);
    while let Some(next) = open.pop() {
        open.extend(used.get(next).into_iter().flatten().filter(|other| found.insert((*other).clone())));
    }
    found
}

/// Siblings that use each other, each circle once.
fn circles() -> BTreeSet<Vec<String>> {
    let used = siblings_used();
    let all: BTreeMap<&Place, BTreeSet<Place>> = used.keys().map(|by| (by, all_used(&used, by))).collect();
    let uses = |by: &Place, other: &Place| all.get(by).is_some_and(|all| all.contains(other));
    let circle = |by: &Place| all[by].iter().filter(|other| uses(other, by)).map(|place| place.join("::")).collect();
    used.keys().filter(|by| uses(by, by)).map(circle).collect()
}

#[test]
fn no_siblings_import_each_other_in_a_circle() {
    let known = CIRCLES.iter().map(|circle| circle.iter().map(|name| (*name).to_owned()).collect());
    assert_eq!(circles(), known.collect::<BTreeSet<Vec<String>>>());
}

#[test]
fn the_reader_of_imports_sees_what_it_must() {
    let own = vec!["cli".to_owned(), "bench".to_owned()];
    let text = "use super::{show, job::{self, Job}};\n// use super::no;\npub use crate::film::{Film,\n    Pixel};\nuse std::fmt;
mod inner {\n    use super::super::folder::Kind;\n}\n#[cfg(test)]\nmod tests {\n    use crate::report::Grid;\n}";
    let found: Vec<String> = imports(text, &own).iter().map(|place| place.join("::")).collect();
    let expected = ["cli::show", "cli::job::self", "cli::job::Job", "film::Film", "film::Pixel", "cli::folder::Kind"];
    assert_eq!(found, expected);
    assert_eq!(place(Path::new("src/cli/bench/mod.rs")), own);
}
