//! Small scenes of all the kinds of light that a picture's error has to be promised for, each 16 × 16 pixels.

/// A scene, and what is asked for: mean ΔE2000, its 95th percentile, RMSE.
pub struct Case {
    pub name: &'static str,
    pub text: String,
    pub targets: [f64; 3],
}

/// A picture of a camera under a sky of so many cd/m².
fn framed(exposure: f64, camera: &str, sky: f64) -> String {
    format!(
        "meters_per_unit = 0.01\nrender = {{ width = 16, height = 16 }}\npicture.exposure = {exposure}\n\
         camera = {{ {camera} }}\nenvironment.constant = {{ spectrum = \"D65\", luminance = {sky} }}\n"
    )
}

/// A matt floor that is looked at from above.
fn on_floor(name: &'static str, exposure: f64, rest: &str, targets: [f64; 3]) -> Case {
    let camera = "position = [0, -6, 4], look_at = [0, 0, 0.3], fov = 28";
    let text = framed(exposure, camera, 1.0)
        + &matt("grey", "0.5")
        + &matt("red", "{ rgb = [0.7, 0.1, 0.1] }")
        + &floor("grey");
    Case { name, text: text + rest, targets }
}

fn matt(name: &str, reflectance: &str) -> String {
    format!("[materials.{name}.diffuse]\nreflectance = {reflectance}\n")
}

fn floor(material: &str) -> String {
    format!("[[objects]]\nmaterial = \"{material}\"\nshape.rectangle = {{ size = [40, 40] }}\n")
}

/// A scene of the repository, made small.
fn of_repository(name: &'static str, text: &str, targets: [f64; 3]) -> Case {
    Case { name, text: text.to_owned(), targets }
}

fn ball(material: &str, center: [f64; 3], radius: f64) -> String {
    format!("[[objects]]\nmaterial = \"{material}\"\nshape.sphere = {{ center = {center:?}, radius = {radius} }}\n")
}

fn lamp(center: [f64; 3], radius: f64, luminance: f64) -> String {
    format!(
        "[[objects]]\nshape.sphere = {{ center = {center:?}, radius = {radius} }}\n\
         emission = {{ spectrum = \"D65\", luminance = {luminance} }}\n"
    )
}

fn panel(center: [f64; 3], radius: f64, luminance: f64) -> String {
    format!(
        "[[objects]]\nshape.disk = {{ center = {center:?}, radius = {radius}, normal = [0, 0, -1] }}\n\
         emission = {{ spectrum = \"D65\", luminance = {luminance} }}\n"
    )
}

fn metal(name: &str, ior: &str, roughness: f64) -> String {
    format!("[materials.{name}.conductor]\nior = \"{ior}\"\nroughness = {roughness}\n")
}

const GOLD: &str = "Au/olmon-2012-evaporated";
const SILVER: &str = "Ag/mcpeak-2015";

/// What friendly and unfriendly light looks like; `sky.exr` is a sky with one bright texel.
pub fn all() -> Vec<Case> {
    let unfriendly = vec![
        on_floor(
            "caustic of a gold ball",
            4.0,
            &(ball("gold", [0.0, 0.0, 0.6], 0.6) + &lamp([1.5, 0.5, 3.0], 0.05, 4e4)),
            [2.0, 8.0, 0.3],
        ),
        on_floor(
            "caustic of a glass ball",
            4.0,
            &(ball("bk7", [0.0, 0.0, 0.7], 0.6) + &lamp([0.5, 0.5, 3.0], 0.05, 4e4)),
            [4.0, 10.0, 0.2],
        ),
        bokeh(),
        sun_texel(),
        lines_through_a_prism(),
        on_floor(
            "tiny lamps over rough silver",
            4.0,
            &(metal("satin", SILVER, 0.05)
                + &ball("satin", [-0.8, 0.0, 0.6], 0.6)
                + &ball("satin", [0.8, 0.3, 0.6], 0.6)
                + &[[1.0, 0.0, 3.0], [-1.0, 1.0, 3.0], [0.0, -2.0, 2.5]].map(|at| lamp(at, 0.01, 1e6)).concat()),
            [2.0, 8.0, 0.3],
        ),
        on_floor(
            "frosted lamp",
            3.0,
            &("[materials.frost.dielectric]\nior = 1.5\nroughness = 0.3\n".to_owned()
                + &ball("frost", [0.0, 0.5, 1.4], 0.4)
                + &ball("air", [0.0, 0.5, 1.4], 0.37)
                + &lamp([0.0, 0.5, 1.4], 0.05, 1e4)),
            [2.0, 8.0, 0.3],
        ),
        Case { name: "lamp in a clear bulb", text: BULB.to_owned(), targets: [1.0, 4.0, 0.1] },
        on_floor(
            "sun over smooth metal",
            12.0,
            &(ball("silver", [0.0, 0.0, 0.6], 0.6)
                + "[[suns]]\ndirection = [0.5, -0.3, 0.8]\nspectrum = \"D65\"\nilluminance = 20000\n"),
            [2.0, 8.0, 0.3],
        ),
        on_floor(
            "iron balls under a small lamp",
            4.0,
            &([-0.9, 0.0, 0.9].map(|x| ball("iron", [x, 0.0, 0.42], 0.42)).concat()
                + &lamp([0.5, -0.5, 3.0], 0.03, 1e5)),
            [2.0, 8.0, 0.3],
        ),
    ];
    let friendly = vec![
        on_floor(
            "slit",
            3.0,
            "[[objects]]\nshape.rectangle = { center = [0, 2, 1.5], size = [0.05, 2], normal = [0, -1, 0] }\n\
             emission = { spectrum = \"D65\", luminance = 400 }\n",
            [1.0, 4.0, 0.05],
        ),
        textured(),
        on_floor(
            "matt things under a panel",
            3.0,
            &(ball("red", [0.6, 0.0, 0.5], 0.5)
                + &ball("grey", [-0.6, 0.2, 0.5], 0.5)
                + &panel([0.0, 0.0, 4.0], 1.0, 60.0)),
            [1.0, 4.0, 0.05],
        ),
        on_floor(
            "metals and matt things",
            3.0,
            &(metal("satin", GOLD, 0.2)
                + &ball("satin", [-0.8, 0.0, 0.6], 0.6)
                + &ball("silver", [0.3, -0.9, 0.4], 0.4)
                + &ball("red", [0.9, 0.3, 0.6], 0.6)
                + &panel([-2.0, -1.0, 4.0], 1.2, 50.0)),
            [1.0, 4.0, 0.05],
        ),
        on_floor(
            "metals under a sky",
            1.0,
            &(ball("gold", [-0.8, 0.0, 0.6], 0.6) + &ball("copper", [0.8, 0.2, 0.6], 0.6)),
            [1.0, 4.0, 0.02],
        ),
        on_floor(
            "sun over matt things and satin",
            12.0,
            &(metal("satin", SILVER, 0.3)
                + &ball("satin", [-0.7, 0.0, 0.6], 0.6)
                + &ball("red", [0.7, 0.0, 0.6], 0.6)
                + "[[suns]]\ndirection = [0.5, -0.3, 0.8]\nspectrum = \"D65\"\nilluminance = 20000\n"),
            [2.0, 8.0, 0.1],
        ),
        on_floor(
            "many lamps",
            3.0,
            &((0..20)
                .map(|i| {
                    let (sin, cos) = (f64::from(i) * 2.4).sin_cos();
                    let r = 0.7 * f64::from(i).sqrt();
                    panel([r * cos, r * sin, 6.0], 0.3, 100.0)
                })
                .collect::<String>()
                + &ball("red", [0.0, 0.0, 0.6], 0.6)),
            [1.0, 4.0, 0.05],
        ),
        on_floor(
            "rough glass under a panel",
            3.0,
            &("[materials.frost.dielectric]\nior = 1.5\nroughness = 0.4\n".to_owned()
                + &ball("frost", [0.0, 0.0, 0.7], 0.6)
                + &panel([-1.0, -1.0, 4.0], 1.2, 50.0)),
            [2.0, 6.0, 0.05],
        ),
        of_repository("diamond", include_str!("../../scenes/diamond.toml"), [4.0, 12.0, 0.1]),
        of_repository("Cornell box", include_str!("../../scenes/cornell-box.toml"), [4.0, 12.0, 0.1]),
        of_repository("twelve metals", include_str!("../../scenes/metals.toml"), [2.0, 8.0, 0.05]),
        of_repository("tray", include_str!("../../scenes/tray.toml"), [3.0, 10.0, 0.1]),
        of_repository("gold in water", include_str!("../../scenes/gold-in-water.toml"), [2.0, 8.0, 0.05]),
        of_repository("coloured glass", include_str!("../../scenes/coloured-glass.toml"), [3.0, 10.0, 0.1]),
    ];
    unfriendly.into_iter().chain(friendly).collect()
}

/// Lamps far out of focus.
fn bokeh() -> Case {
    let lamps = [[-1.5, 12.0, 1.0], [0.0, 14.0, 0.4], [1.2, 11.0, 0.2], [0.4, 13.0, 1.4]];
    let camera =
        "position = [0, -10, 0.6], look_at = [0, 0, 0.6], focal_length_mm = 60, f_number = 1.4, focus_distance = 10";
    let text = framed(3.0, camera, 2.0) + &matt("grey", "0.4") + &ball("grey", [0.0, 0.0, 0.5], 0.5);
    Case { name: "bokeh", text: text + &lamps.map(|at| lamp(at, 0.01, 1e6)).concat(), targets: [2.0, 8.0, 0.3] }
}

/// One bright texel over gold and glass.
fn sun_texel() -> Case {
    let balls = ball("gold", [-0.7, 0.0, 0.6], 0.6) + &ball("bk7", [0.7, 0.0, 0.7], 0.6);
    let case = on_floor("sun texel over gold and glass", 3.0, &balls, [3.0, 12.0, 0.5]);
    let constant = "environment.constant = { spectrum = \"D65\", luminance = 1 }";
    let sky = "environment.image = { file = \"sky.exr\", illuminant = \"D65\", scale = 1 }";
    assert!(case.text.contains(constant));
    Case { text: case.text.replace(constant, sky), ..case }
}

/// Width and texels of `sky.exr`: a sun over a dim sky.
pub fn sky() -> (usize, Vec<[f32; 3]>) {
    let mut texels = vec![[1.0; 3]; 64 * 32];
    texels[6 * 64 + 20] = [3000.0; 3];
    (64, texels)
}

/// Two lines of a lamp, parted by flint, on a screen.
fn lines_through_a_prism() -> Case {
    let prism = r#"
[[objects]]
material = "SF11"
shape.convex = { planes = [[0.866, 0, 0.5, 0.5], [-0.866, 0, 0.5, 0.5], [0, 0, -1, 0.4], [0, 1, 0, 1], [0, -1, 0, 1]] }
transform = { translate = [0, 0, 0.9] }
[[objects]]
shape.rectangle = { center = [-3, 0, 2], size = [0.05, 1.5], normal = [0.9, 0, -0.3] }
emission = { spectrum = { lines = [[532, 1], [633, 1]] }, luminance = 4000 }
"#;
    let camera = "position = [0, -8, 3], look_at = [0, 0, 0.6], fov = 30";
    let text = framed(2.0, camera, 1.0) + &matt("screen", "0.8") + &floor("screen") + prism;
    Case { name: "laser lines through a prism", text, targets: [3.0, 12.0, 0.2] }
}

/// A picture on the floor.
fn textured() -> Case {
    let things = ball("grey", [0.5, 0.0, 0.5], 0.5) + &panel([0.0, 0.0, 4.0], 1.0, 60.0);
    let case = on_floor("picture on the floor", 3.0, &things, [2.0, 6.0, 0.05]);
    let text = case.text.replace("material = \"grey\"\nshape.rectangle", "material = \"printed\"\nshape.rectangle");
    let printed = "[materials.printed.diffuse]\nreflectance = { image = \"checks.png\", scale = [8, 8] }\n";
    Case { text: text + printed, ..case }
}

/// RGB samples of `checks.png`, 8 × 8.
pub fn checks() -> Vec<u8> {
    (0..64u32).flat_map(|i| if (i % 8 + i / 8) % 2 == 0 { [230, 220, 200] } else { [30, 60, 120] }).collect()
}

/// 22.54 cd/m² in the middle (closed form): all of the lamp's light comes through the bulb.
const BULB: &str = include_str!("../data/bulb.toml");
