//! Values in a scene: each is refused at its place.

use super::*;

#[test]
fn unknown_keys_and_names_come_with_the_nearest() {
    all_refused_at_mark(&[
        (format!("[render]\n§widht = 4\n{CAMERA}"), &["unknown key `widht`", "did you mean `width`?"]),
        (shape("shape.§shpere = { radius = 1 }"), &["did you mean `sphere`?"]),
        (shape("shape.sphere = { §radus = 1 }"), &["did you mean `radius`?"]),
        (material("§conducter]\nior = 1"), &["did you mean `conductor`?"]),
        (light("emission = { spectrum = { §blackbodi = 5000 } }"), &["did you mean `blackbody`?"]),
        (scene_with("[[objects]]\nmaterial = §\"glod\"\nshape.sphere = { radius = 1 }"), &["did you mean `gold`?"]),
        (material("conductor]\nior = §\"Au/olmon-2012-evaporate\""), &["`Au/olmon-2012-evaporated`"]),
        (material("dielectric]\nior = 1.5\nabsorption = §\"watr\""), &["did you mean `water`?"]),
        (light("emission = { spectrum = §\"led_b1\", luminance = 1 }"), &["did you mean `led-b1`?"]),
        (scene_with("[picture]\nwhite_balance = §\"D655\""), &["did you mean `d65`?"]),
        (scene_with("[picture]\nobserver = §\"cie-1931\""), &["did you mean `cie-1931-2`?"]),
        (scene_with("[picture]\ngamut = §\"clipp\""), &["did you mean `clip`?"]),
        (material("conductor]\nior = 1.5\nfresnel = §\"Schlik\""), &["did you mean `schlick`?"]),
    ]);
}

#[test]
fn a_model_that_does_not_apply_is_told_with_the_material() {
    all_refused_at_mark(&[
        (
            material("conductor]\nior = \"Au/olmon-2012-evaporated\"\nfresnel = §\"cook-torrance\""),
            &["`cook-torrance` does not apply to `m`", "for dielectrics"],
        ),
        (
            format!(
                "{}\n[[objects]]\nmaterial = §\"silver\"\nshape.sphere = {{ radius = 1 }}",
                scene_with("[render]\nfresnel = \"schlick-incident\"").replace(SMALL, "")
            ),
            &["`schlick-incident` does not apply to `silver`"],
        ),
    ]);
    let outcome = render(shape("shape.sphere = { radius = 1 }"), &[], &["-q", "--fresnel", "schlick-transmitted"]);
    assert_refused(&outcome, &["`schlick-transmitted` does not apply to `gold`"]);
    let unknown = render(shape("shape.sphere = { radius = 1 }"), &[], &["-q", "--fresnel", "schlik-rgb"]);
    assert_refused(&unknown, &["unknown Fresnel model `schlik-rgb`", "did you mean `schlick-rgb`?"]);
}

#[test]
fn a_material_of_the_scene_can_be_the_nearest() {
    let scene = "[[objects]]\nmaterial = §\"suade\"\nshape.sphere = { radius = 1 }\n[materials.suede.diffuse]\nreflectance = 0.1";
    refused_at_mark(&scene_with(scene), &[], &["did you mean `suede`?"]);
}

#[test]
fn a_key_of_the_top_below_a_table_is_told_where_it_belongs() {
    refused_at_mark(&scene_with("§meters_per_unit = 0.001"), &[], &["top of the file"]);
}

#[test]
fn wrong_types_are_told_in_plain_words() {
    all_refused_at_mark(&[
        (format!("[render]\nwidth = §\"four\"\n{CAMERA}"), &["expected a whole number", "found the text \"four\""]),
        (format!("[render]\nwidth = §4.5\n{CAMERA}"), &["found 4.5"]),
        (format!("[render]\nwidth = §-4\n{CAMERA}"), &["found -4"]),
        (format!("[render]\nwidth = §4294967296\n{CAMERA}"), &["found 4294967296"]),
        (format!("[render]\nseed = §-1\n{CAMERA}"), &["not negative"]),
        (CAMERA.replace("40", "§\"wide\""), &["expected a number, found the text \"wide\""]),
        (CAMERA.replace("[0, 0, 0]", "§[0, 0]"), &["expected 3 numbers, found 2"]),
        (CAMERA.replace("[0, 0, 0]", "§[0, 0, 0, 1]"), &["expected 3 numbers, found 4"]),
        (CAMERA.replace("[0, 0, 0]", "[0, §\"x\", 0]"), &["found the text \"x\""]),
        (CAMERA.replace("[0, 0, 0]", "§0"), &["expected a list of 3 numbers, found 0"]),
        (shape("shape = §\"sphere\""), &["one kind of shape", "found the text \"sphere\""]),
        (shape("shape = §{}"), &["this table is empty"]),
        (
            shape("§shape.box = { size = [1, 1, 1] }\nshape.disk = { radius = 1 }"),
            &["one kind of shape", "beside another one"],
        ),
        (shape("transform = { scale = §\"big\" }\nshape.sphere = { radius = 1 }"), &["expected a factor"]),
        (light("emission = §5"), &["expected a table, found 5"]),
        (light("emission = { spectrum = §5, luminance = 1 }"), &["an illuminant's name or file", "found 5"]),
        (light("emission = { spectrum = §{ blackbody = 5000, daylight = 5000 } }"), &["beside another one"]),
        (
            format!(
                "{SMALL}{CAMERA}[§environment.constant]\nspectrum = \"D50\"\nluminance = 1\n[environment.gradient]\n"
            ),
            &["one kind of environment"],
        ),
        (scene_with("[picture]\nexposure = §\"automatic\""), &["expected \"auto\" or an exposure value"]),
        (scene_with("[picture]\ngamut = §5"), &["expected a text in quotes"]),
        (scene_with("[materials]\nm = §5"), &["expected a table, found 5"]),
        (format!("meters_per_unit = §\"mm\"\n{CAMERA}"), &["expected a number, found the text \"mm\""]),
        (format!("{CAMERA}material = §gold\n"), &["must be quoted"]),
        (format!("{SMALL}{CAMERA}[§render]\n"), &["given twice"]),
    ]);
}

#[test]
fn what_is_missing_is_named_with_its_table() {
    all_refused_at_mark(&[
        (format!("§{SMALL}{LIGHT}"), &["`camera` is missing in this file"]),
        (shape("shape.sphere = §{}"), &["`radius` is missing in `objects.shape.sphere`"]),
        (scene_with("§[[objects]]\nmaterial = \"gold\""), &["`shape` is missing in `objects`"]),
        (light("emission = §{ luminance = 1 }"), &["`spectrum` is missing in `objects.emission`"]),
        (scene_with("§[[objects]]\nshape.sphere = { radius = 1 }"), &["neither a material nor an emission"]),
        (CAMERA.replace("fov = 40\n", "").replace("[camera]", "§[camera]"), &["how wide", "fov"]),
        (
            scene_with(
                "[[objects]]\nmaterial = \"m\"\nshape.sphere = { radius = 1 }\n§[materials.m]\ndescription = \"\"",
            ),
            &["is of no kind", "[conductor]"],
        ),
    ]);
}

#[test]
fn sizes_must_be_finite_and_above_zero() {
    for bad in ["0", "-1", "nan", "inf", "1e-60", "1e300"] {
        all_refused_at_mark(&[
            (shape(&format!("shape.sphere = {{ radius = §{bad} }}")), &["expected a length"]),
            (shape(&format!("shape.disk = {{ radius = §{bad} }}")), &["expected a length"]),
            (shape(&format!("shape.rectangle = {{ size = [1, §{bad}] }}")), &["expected a length"]),
            (shape(&format!("shape.box = {{ size = [1, §{bad}, 1] }}")), &["expected a length"]),
            (shape(&format!("shape.brilliant.diameter = §{bad}")), &["expected a length"]),
            (shape(&format!("shape.step-cut = {{ width = §{bad}, length = 1 }}")), &["expected a length"]),
        ]);
    }
    all_refused_at_mark(&[
        (shape("§shape.sphere = { radius = 1e30 }"), &["radius of the sphere", "1e30"]),
        (shape("§shape.brilliant = { diameter = 1, crown_angle = 89 }"), &["the crown angle is 89"]),
        (shape("§shape.brilliant = { diameter = 1, girdle_facets = 17 }"), &["multiple of 16"]),
        (shape("§shape.step-cut = { width = 2, length = 1 }"), &["length ratio"]),
        (shape("§shape.rectangle = { size = [1, 1], normal = [0, 0, 0] }"), &["normal"]),
        (shape("shape.disk = { radius = 1, normal = [0, §nan, 0] }"), &["finite"]),
        (shape("shape.sphere = { radius = 1, center = [0, 0, §inf] }"), &["finite"]),
    ]);
}

#[test]
fn transforms_must_not_degenerate() {
    let transformed = |transform: &str| shape(&format!("shape.sphere = {{ radius = 1 }}\ntransform = {transform}"));
    all_refused_at_mark(&[
        (transformed("§{ scale = 0 }"), &["flattens"]),
        (transformed("§{ scale = [1, 0, 1] }"), &["flattens"]),
        (transformed("{ scale = §nan }"), &["finite"]),
        (transformed("{ scale = [1, §nan, 1] }"), &["finite"]),
        (transformed("{ scale = §[1, 2] }"), &["expected 3 numbers, found 2"]),
        (transformed("{ rotate = [0, §nan, 0] }"), &["finite"]),
        (transformed("{ translate = [0, §inf, 0] }"), &["finite"]),
        (transformed("§{ scale = [1, 2, 1] }"), &["ellipsoid"]),
    ]);
}

#[test]
fn planes_must_close_a_volume() {
    all_refused_at_mark(&[
        (shape("§shape.convex.planes = []"), &["close no volume"]),
        (shape("§shape.convex.planes = [[1, 0, 0, 1], [-1, 0, 0, 1]]"), &["close no volume"]),
        (
            shape("§shape.convex.planes = [[1,0,0,-1],[-1,0,0,-1],[0,1,0,1],[0,-1,0,1],[0,0,1,1],[0,0,-1,1]]"),
            &["close no volume"],
        ),
        (shape("shape.convex.planes = [[1,0,0,1],§[0,0,0,1],[-1,0,0,1]]"), &["normal of this plane"]),
        (shape("shape.convex.planes = [[1,0,0,§nan]]"), &["finite"]),
        (shape("shape.convex.planes = [§[1,0,0,1,1]]"), &["expected 4 numbers, found 5"]),
    ]);
}

#[test]
fn optical_constants_must_be_possible() {
    all_refused_at_mark(&[
        (material("conductor]\nior = §{ n = -1, k = 2 }"), &["n is -1"]),
        (material("conductor]\nior = §{ n = 1, k = -1 }"), &["k is -1"]),
        (material("conductor]\nior = §{ n = 1, k = inf }"), &["k is inf"]),
        (material("conductor]\nior = §{ n = 1e200, k = 1 }"), &["n is 1e200"]),
        (material("dielectric]\nior = §0"), &["n is 0"]),
        (material("dielectric]\nior = §nan"), &["n is NaN"]),
        (material("conductor]\nior = { n = 1, k = 1, §q = 1 }"), &["unknown key `q`"]),
        (material("conductor]\nior = 1\nroughness = §2"), &["`roughness` is 2", "between 0 and 1"]),
        (material("conductor]\nior = 1\nroughness = §nan"), &["`roughness` is NaN"]),
        (material("conductor]\nior = 1\nperceptual_roughness = §-0.5"), &["`perceptual_roughness` is -0.5"]),
        (
            material("conductor]\nior = 1\nroughness = 0.1\nperceptual_roughness = §0.3"),
            &["`roughness` and `perceptual_roughness`", "α = r²"],
        ),
        (
            material("conductor]\nior = 1\n[materials.m.diffuse]\nreflectance = 0.5")
                .replace("[materials.m.c", "[materials.§m.c"),
            &["more than one kind"],
        ),
        (material("diffuse]\nreflectance = §1.5"), &["between 0 and 1"]),
        (material("diffuse]\nreflectance = §nan"), &["between 0 and 1"]),
        (material("diffuse]\nreflectance = §{ rgb = [2, 0, 0] }"), &["2, expected 0 to 1"]),
        (material("diffuse]\nreflectance = { rgb = §[0, 0, 0, 1] }"), &["expected 3 numbers, found 4"]),
        (material("dielectric]\nior = 1.5\nabsorption = §-1"), &["not negative"]),
    ]);
}

#[test]
fn absorption_needs_a_scale() {
    let sapphire = "[[objects]]\nmaterial = §\"blue-sapphire\"\nshape.sphere = { radius = 1 }";
    refused_at_mark(&scene_with(sapphire), &[], &["absorbs light", "add `meters_per_unit"]);
    refused_at_mark(&format!("outside = §\"water\"\n{CAMERA}"), &[], &["add `meters_per_unit"]);
    for bad in ["0", "-1", "nan", "inf"] {
        refused_at_mark(&format!("meters_per_unit = §{bad}\n{CAMERA}"), &[], &["`meters_per_unit` is", "above 0"]);
    }
    let huge = format!("meters_per_unit = 1e300\n{}", scene_with(sapphire));
    refused_at_mark(&huge, &[], &["is `meters_per_unit` right?"]);
    refused_at_mark(&format!("outside = §\"gold\"\n{CAMERA}"), &[], &["no dielectric"]);
}

#[test]
fn cameras_must_see() {
    let with = |more: &str| format!("{CAMERA}{more}\n");
    let opened = |more: &str| {
        format!("meters_per_unit = 1\n{}", CAMERA.replace("fov = 40", &format!("focal_length_mm = 50\n{more}")))
    };
    all_refused_at_mark(&[
        (CAMERA.replace("40", "§0"), &["field of view of 0°"]),
        (CAMERA.replace("40", "§-40"), &["field of view of -40°"]),
        (CAMERA.replace("40", "§180"), &["field of view of 180°"]),
        (CAMERA.replace("40", "§nan"), &["field of view of NaN°"]),
        (CAMERA.replace("fov = 40", "focal_length_mm = §0"), &["focal_length_mm is 0"]),
        (CAMERA.replace("fov = 40", "focal_length_mm = 50\nsensor_width_mm = §-1"), &["sensor_width_mm is -1"]),
        (with("focal_length_mm = §50"), &["`fov` and `focal_length_mm`"]),
        (with("sensor_width_mm = §36"), &["goes with `focal_length_mm`"]),
        (with("orthographic_width = 3").replace("fov = 40", "fov = §40"), &["both say how wide"]),
        (CAMERA.replace("fov = 40", "orthographic_width = §0"), &["orthographic_width is 0"]),
        (with("f_number = §2"), &["goes with `focal_length_mm`"]),
        (with("blades = §5"), &["goes with `f_number`"]),
        (with("focus_distance = §5"), &["goes with `f_number`"]),
        (CAMERA.replace("fov = 40", "focal_length_mm = 50\nf_number = §2"), &["meters_per_unit"]),
        (opened("f_number = §0"), &["`f_number` is 0"]),
        (opened("f_number = §-2"), &["`f_number` is -2"]),
        (opened("f_number = 2\nblades = §2"), &["3 to 32"]),
        (opened("f_number = 2\nfocus_distance = §-1"), &["focus_distance is -1"]),
        (with("up = §[0, 1, 0]"), &["`up` is parallel"]),
        (with("up = §[0, 0, 0]"), &["`up` is parallel"]),
        (CAMERA.replace("[0, -10, 0]", "[0, 0, 10]").replace("[camera]", "§[camera]"), &["`up` is parallel"]),
        (CAMERA.replace("look_at = [0, 0, 0]", "look_at = §[0, -10, 0]"), &["same point"]),
        (CAMERA.replace("-10", "§nan"), &["finite"]),
        (CAMERA.replace("-10", "§-1e300"), &["finite"]),
        (format!("{}{SPHERE}", CAMERA.replace("[0, -10, 0]", "§[0, -0.5, 0]")), &["stands inside `object 1`"]),
    ]);
}

#[test]
fn lights_must_have_a_strength_that_can_be() {
    let sun = |keys: &str| format!("{CAMERA}[[suns]]\n{keys}\n");
    all_refused_at_mark(&[
        (sun("direction = §[0, 0, 0]\nspectrum = \"D65\"\nilluminance = 1"), &["a direction other than zero"]),
        (sun("direction = [0, 0, 1]\nangle = §400\nspectrum = \"D65\"\nilluminance = 1"), &["180°"]),
        (sun("direction = [0, 0, 1]\nangle = §-1\nspectrum = \"D65\"\nilluminance = 1"), &["`angle` is -1"]),
        (sun("direction = [0, 0, 1]\nspectrum = §\"D65\""), &["how strong is the sun", "lx"]),
        (sun("direction = [0, 0, 1]\nspectrum = \"D65\"\nilluminance = §nan"), &["`illuminance` is NaN"]),
        (sun("direction = [0, 0, 1]\nspectrum = \"D65\"\nilluminance = 1\nirradiance = §1"), &["both say how strong"]),
        (light("emission = { spectrum = §\"D50\" }"), &["how strong", "`luminance` in cd/m²"]),
        (light("emission = { spectrum = \"D50\", luminance = 1, radiance = §2 }"), &["`luminance` and `radiance`"]),
        (light("emission = { spectrum = \"D50\", luminance = §-1 }"), &["`luminance` is -1"]),
        (light("emission = { spectrum = \"D50\", radiance = §nan }"), &["`radiance` is NaN"]),
        (light("emission = { spectrum = \"D50\", scale = §inf }"), &["`scale` is inf"]),
        (light("emission = { spectrum = §\"D50\", luminance = 1e300 }"), &["1.00e300 cd/m²"]),
        (light("emission = { spectrum = { blackbody = §0 } }"), &["`blackbody` is 0"]),
        (light("emission = { spectrum = §{ blackbody = 1e300 } }"), &["cd/m²"]),
        (light("emission = { spectrum = §{ blackbody = 1e-3 }, luminance = 1 }"), &["no light in 360–830 nm"]),
        (light("emission = { spectrum = { daylight = §100 }, luminance = 1 }"), &["4000 to 25000 K"]),
        (light("emission = { spectrum = { lines = [[500, 1], §[200, 1]] }, luminance = 1 }"), &["200 nm", "360–830"]),
        (light("emission = { spectrum = { lines = [§[831, 1]] }, luminance = 1 }"), &["831 nm"]),
        (light("emission = { spectrum = { lines = [§[500, -1]] }, luminance = 1 }"), &["power -1"]),
        (light("emission = { spectrum = §{ lines = [] }, luminance = 1 }"), &["no light"]),
        (
            light(
                "emission = { spectrum = { table = { wavelength_nm = [400, 500, §450], value = [1, 1, 1] } }, luminance = 1 }",
            ),
            &["wavelengths must grow"],
        ),
        (
            light(
                "emission = { spectrum = { table = { wavelength_nm = [400, 500], value = [1, §-1] } }, luminance = 1 }",
            ),
            &["`value` is -1"],
        ),
        (
            light("emission = { spectrum = §{ table = { wavelength_nm = [400], value = [1, 1] } }, luminance = 1 }"),
            &["1 wavelengths and 2 values"],
        ),
        (
            scene_with(
                "[[objects]]\nmaterial = \"m\"\nshape.sphere = { radius = 1 }\n\
                 emission = §{ spectrum = \"D50\", luminance = 1 }\n[materials.m.dielectric]\nior = 1.5",
            ),
            &["object 1 is a dielectric: it cannot shine"],
        ),
        (
            scene_with(
                "[[objects]]\nmaterial = \"m\"\n§shape.disk = { radius = 1 }\n[materials.m.dielectric]\nior = 1.5",
            ),
            &["flat", "`box`"],
        ),
    ]);
}

#[test]
fn no_light_is_a_black_picture_with_a_warning() {
    for dark in [[SMALL, CAMERA, SPHERE].concat(), scene_with(SPHERE).replace("= 100", "= 0")] {
        let outcome = render(dark, &[], &["-q"]);
        assert_eq!(outcome.code, Some(0), "{}", outcome.stderr);
        assert!(outcome.stderr.contains("warning: nothing in this scene shines"), "{}", outcome.stderr);
        assert!(outcome.written.contains("scene.png"));
    }
}

#[test]
fn settings_must_be_possible() {
    all_refused_at_mark(&[
        (format!("[render]\nwidth = §0\n{CAMERA}"), &["`width` is 0"]),
        (format!("[render]\nheight = §0\n{CAMERA}"), &["`height` is 0"]),
        (format!("[render]\nsamples = §0\n{CAMERA}"), &["`samples` is 0"]),
        (format!("[render]\nmax_depth = §0\n{CAMERA}"), &["`max_depth` is 0"]),
        (scene_with("[picture]\nexposure = §nan"), &["exposure of NaN"]),
        (scene_with("[picture]\nexposure = §65"), &["between −64 and 64"]),
    ]);
}

#[test]
fn point_lights_that_cannot_be() {
    let light = |keys: &str| {
        let metres = "meters_per_unit = 0.001\n";
        [metres, &scene_with(&format!("{SPHERE}[[points]]\nposition = [0, 0, 9]\n{keys}\n"))].concat()
    };
    all_refused_at_mark(&[
        (light("spectrum = §\"A\""), &["how strong is the light?"]),
        (
            light("spectrum = \"A\"\nluminous_flux = 4\nluminous_intensity = 3")
                .replace("luminous_flux = 4", "luminous_flux = §4"),
            &["both say"],
        ),
        (light("spectrum = \"A\"\nluminous_intensity = §-3"), &["not negative"]),
        (light("spectrum = \"A\"\nluminous_intensity = 3\ndirection = §[0, 0, 1]"), &["goes with `cone_angle`"]),
        (light("spectrum = \"A\"\nluminous_intensity = 3\ncone_angle = §30"), &["goes with `direction`"]),
        (light("spectrum = \"A\"\nluminous_intensity = 3\nfade = §30"), &["goes with `cone_angle`"]),
        (
            light("spectrum = \"A\"\nluminous_intensity = 3\ndirection = [0, 0, 0]\ncone_angle = §30"),
            &["a direction other than zero"],
        ),
        (
            light("spectrum = \"A\"\nluminous_intensity = 3\ndirection = [0, 0, 1]\nfade = 20\ncone_angle = §30"),
            &["at most half"],
        ),
    ]);
    let unscaled =
        scene_with(&format!("{SPHERE}[[points]]\nposition = [0, 0, 9]\nspectrum = §\"A\"\nluminous_flux = 4\n"));
    all_refused_at_mark(&[(unscaled, &["meters_per_unit"])]);
}

/// What people who come from other programs write, and what they are told.
#[test]
fn usual_slips_are_told_with_what_was_meant() {
    let lamp = |strength: &str| light(&format!("emission = {{ spectrum = \"A\", luminance = {strength} }}"));
    let named =
        |name: &str| format!("{}[[objects]]\nmaterial = \"{name}\"\nshape.sphere = {{ radius = 1 }}\n", scene_with(""));
    for (scene, says) in [
        (material("conductor]\nior = \"gold\""), "`gold` is a material: its data set is `Au/olmon-2012-evaporated`"),
        (material("dielectric]\nior = \"diamond\""), "`diamond` is a material: its data set is `"),
        (scene_with(SPHERE).replace("[[objects]]", "[objects]"), "write `[[objects]]` above each"),
        (scene_with(SPHERE).replace("[0, -10, 0]", "[0 -10 0]"), "apart by commas"),
        (lamp("200 cd"), "a number stands alone"),
        (lamp("\"200 cd\""), "a number stands alone"),
        (named("aquamarine"), "`material = \"beryl\"`"),
        (named("citrine"), "`material = \"quartz\"`"),
        (named("tsavorite"), "`material = \"grossular\"`"),
        (named("white gold"), "`material = \"rhodium\"`"),
    ] {
        assert_refused(&render(scene, &[], &["-q"]), &[says]);
    }
    for scene in [named("aquamarine"), material("conductor]\nior = 1\nanisotropy = 0.5")] {
        let said = render(scene, &[], &["-q"]).stderr;
        assert!(!said.contains("did you mean"), "{said}");
    }
    let bands = render(scene_with(SPHERE), &[], &["--aovs", "normal", "-o", "a.spectral.exr"]);
    assert_refused(&bands, &["a .spectral.exr has bands", "add -o picture.exr"]);
}

#[test]
fn words_beyond_a_scene_are_told_apart() {
    let folder = tempfile::tempdir().expect("a folder");
    let said = |words: &[&str], says: &str| assert_refused(&spectrel(folder.path(), words), &[says]);
    said(&["rendr", "t.toml"], "did you mean `spectrel render t.toml`?");
    said(&["a.toml", "b.toml"], "one scene at a time: `a.toml`");
    said(&["render", "a.toml", "b.toml"], "one scene at a time: `a.toml`");
}

#[test]
fn what_a_render_did_without_is_told_if_asked() {
    let said = |more: &[&str]| render(scene_with(SPHERE), &[], more).stderr;
    assert!(!said(&[]).contains("left out"), "{}", said(&[]));
    assert!(said(&["-v"]).contains("left out") && said(&["-v"]).contains("visible density"), "{}", said(&["-v"]));
}
