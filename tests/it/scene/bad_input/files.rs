//! Files and options: what is no scene, data files that are broken, pictures that are too large, outputs that cannot be.

use super::*;

#[test]
fn the_good_scene_is_good() {
    let outcome = render(scene_with(SPHERE), &[], &["-q"]);
    assert_eq!((outcome.code, outcome.stderr.as_str()), (Some(0), ""));
    assert_eq!(outcome.written, BTreeSet::from(["scene.exr".into(), "scene.png".into()]));
}

#[test]
fn files_that_are_no_scenes() {
    for (content, says) in [
        (b"".to_vec(), "nothing in this file"),
        (b" \n# a remark\n".to_vec(), "nothing in this file"),
        (b"a = 1\nb = \"\xff\"".to_vec(), "scene.toml:2: this is no text: byte 12"),
        ((0..=255).cycle().take(5000).collect(), "no text"),
        (b"a\0b = 1".to_vec(), "scene.toml:1:2: "),
        (b"[camera".to_vec(), "scene.toml:1:8: unclosed table"),
    ] {
        assert_refused(&render(content, &[], &["-q"]), &[says]);
    }
    let folder = tempfile::tempdir().expect("a folder");
    fs::create_dir(folder.path().join("folder.toml")).expect("a folder");
    fs::write(folder.path().join("ring.toml"), scene_with(SPHERE)).expect("a file");
    for (name, says) in [
        ("folder.toml", "folder.toml is a folder"),
        ("rings.toml", "did you mean ring.toml?"),
        ("none/ring.toml", "there is no file none/ring.toml"),
        ("rendr", "did you mean the command `render`?"),
    ] {
        for command in ["render", "inspect"] {
            let outcome = spectrel(folder.path(), &[command, name]);
            assert_eq!(outcome.code, Some(2));
            assert!(outcome.stderr.contains(says), "{}", outcome.stderr);
            assert_eq!(outcome.written.len(), 2, "{:?}", outcome.written);
        }
    }
}

#[test]
fn ten_thousand_levels_do_not_overflow_the_stack() {
    let n = 10_000;
    for scene in [
        format!("a = {}", "[".repeat(n)),
        format!("a = {}{}", "[".repeat(n), "]".repeat(n)),
        format!("a = {}1{}", "{a = ".repeat(n), "}".repeat(n)),
        format!("{}b = 1", "a.".repeat(n)),
        format!("[{}b]", "a.".repeat(n)),
        format!("[[{}b]]", "a.".repeat(n)),
        (1..n / 100).map(|i| format!("[{}b]\n", "a.".repeat(i))).collect(),
    ] {
        assert_refused(&render(scene, &[], &["-q"]), &[]);
    }
}

#[test]
fn a_spectrum_short_of_the_visible_is_warned_of_with_its_range() {
    let scene = material("conductor]\nior = \"own.csv\"");
    let outcome = render(scene, &[("own.csv", "wavelength_nm,n,k\n450,1,2\n650,1,3\n")], &["-q"]);
    assert_eq!(outcome.code, Some(0), "{}", outcome.stderr);
    assert!(outcome.stderr.starts_with("warning: `own.csv` (m) covers 450–650 nm"), "{}", outcome.stderr);
}

#[test]
fn broken_data_files_are_told_with_both_places() {
    let scene = |file: &str| material(&format!("conductor]\nior = §\"{file}\""));
    for (file, content, says) in [
        ("own.csv", "", "own.csv: the file is empty"),
        ("own.csv", "0.3,1,2\n2.5,1,2\n", "own.csv:1:1: numbers without a header"),
        ("own.csv", "wavelength_nm,n,k\n400,1,2\n500,-1,2\n", "own.csv:3:5: n is -1"),
        ("own.csv", "wavelength_nm,n,k\n400,1,2\n500,1,nan\n", "own.csv:3:7: "),
        ("own.csv", "wavelength_nm,n,k\n400,1,2\n400,2,2\n", "own.csv:3:1: "),
        ("own.xlsx", "PK", "`own.xlsx` is a file of a kind that is not read"),
        ("own.csv", "wavelength_nm,n,k\n400,1\n", "own.csv:2:1: 2 columns"),
        ("own.yml", "", "own.yml"),
        ("own.yml", "DATA:\n  - type: tabulated nk\n    data: |\n        0.4 1\n", "own.yml:4:"),
        ("own.yml", "DATA:\n  - type: nonsense\n", "own.yml:2:11: the type `nonsense`"),
        ("own.yml", "DATA: [\n", "own.yml:"),
        ("own.toml", "quantity = \"ior\"\n", "own.toml:"),
    ] {
        refused_at_mark(&scene(file), &[(file, content)], &[says]);
    }
    refused_at_mark(&scene("none.csv"), &[], &["cannot read none.csv"]);
}

#[test]
fn errors_in_a_users_material_stand_in_its_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let materials = folder.path().join("library/materials");
    fs::create_dir_all(&materials).expect("a folder");
    fs::write(materials.join("own.toml"), "[conductor]\nior = 1\nroughnes = 0.1\n").expect("a file");
    fs::write(folder.path().join("scene.toml"), scene_with(&SPHERE.replace("gold", "own"))).expect("a file");
    for args in
        [&["render", "scene.toml", "--library", "library"] as &[&str], &["list", "materials", "--library", "library"]]
    {
        let outcome = spectrel(folder.path(), args);
        assert_eq!(outcome.code, Some(2));
        let expected = "error: library/materials/own.toml:3:1: unknown key `roughnes`";
        assert!(outcome.stderr.starts_with(expected), "{}", outcome.stderr);
        assert_eq!(outcome.written.len(), 2, "{:?}", outcome.written);
    }
}

#[test]
fn pictures_beyond_memory_say_how_much_they_would_take() {
    for [width, height] in [["200000", "200000"], ["4294967295", "4294967295"]] {
        let outcome = render(scene_with(SPHERE), &[], &["--width", width, "--height", height]);
        assert_refused(&outcome, &["GiB of memory"]);
    }
}

#[test]
fn impossible_options_are_refused_before_the_render() {
    for (args, says) in [
        (&["--width", "0"] as &[&str], "--width"),
        (&["--spp", "0"], "--spp"),
        (&["--threads", "0"], "--threads"),
        (&["--threads", "60000"], "--threads"),
        (&["--lanes", "2"], "1, 4 or 8"),
        (&["--crop", "0,0,9,9"], "no part of a picture of 4 × 3 pixels"),
        (&["--crop", "1,1,1,2"], "no part of a picture"),
        (&["--crop", "a,b"], "four whole numbers"),
        (&["--fresnel", "schlik"], "did you mean `schlick`?"),
        (&["--png-bits", "12"], "8 or 16"),
        (&["--library", "none"], "no such folder"),
        (&["--spq", "1"], "--spp"),
        (&["-o", "none/a.png"], "the folder `none` does not exist"),
        (&["-o", "a.jpg"], "must end in .exr or .png"),
        (&["-o", "a"], "must end in .exr or .png"),
        (&["-o", "."], "must end in .exr or .png"),
        (&["-o", "a.png", "-o", "none/b.exr"], "does not exist"),
    ] {
        let outcome = render(scene_with(SPHERE), &[], args);
        assert_refused(&outcome, &[says]);
    }
}

#[test]
fn an_output_that_is_a_folder_or_cannot_be_encoded_leaves_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::create_dir(folder.path().join("a.png")).expect("a folder");
    fs::write(folder.path().join("scene.toml"), scene_with(SPHERE)).expect("a file");
    let outcome = spectrel(folder.path(), &["render", "scene.toml", "-o", "b.png", "-o", "a.png"]);
    assert_eq!(outcome.code, Some(2));
    assert!(outcome.stderr.contains("`a.png`: it is a folder"), "{}", outcome.stderr);
    assert_eq!(outcome.written, BTreeSet::from(["a.png".into(), "scene.toml".into()]));
    let side = "4294967295";
    let outcome = render(scene_with(SPHERE), &[], &["--width", side, "--height", side, "--crop", "0,0,2,2", "-q"]);
    assert_refused(&outcome, &["cannot encode the EXR"]);
}
