//! From spectra to colours: published pairs, reference colours of metals, whites, and the renderer's nodes as a quadrature.

use std::path::Path;

use spectrel::math::Lanes;
use spectrel::spectrum::{
    Arena, Chromaticities, ColorMatching, Daylight, Density, Library, Line, NODE_COUNT, Nodes, Observer, Outside,
    RgbSpace, Sigmoid, Spectrum, Table, Tint, UpsampleTable, Upsampler, Wavelengths, bradford, ciede2000, lab_from_xyz,
    luminance, tristimulus, tristimulus_1nm, white_xyz, white_xyz_1nm,
};

fn library() -> Library {
    Library::new(Vec::new())
}

fn observer(library: &Library) -> std::sync::Arc<ColorMatching> {
    library.observer(Observer::Cie1931).unwrap()
}

fn light(library: &Library, name: &str) -> Spectrum {
    library.illuminant(name, Path::new("")).unwrap().spectrum.clone()
}

fn far_apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn ciede2000_gives_the_published_differences() {
    for line in include_str!("../../data/ciede2000_sharma_2005.csv").lines().skip(1) {
        let v: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
        let (a, b) = ([v[0], v[1], v[2]], [v[3], v[4], v[5]]);
        for difference in [ciede2000(a, b), ciede2000(b, a)] {
            assert!((difference - v[6]).abs() <= 5.0001e-5, "{line}: {difference}");
        }
    }
    assert_eq!(ciede2000([50.0, 10.0, -10.0], [50.0, 10.0, -10.0]), 0.0);
}

#[test]
fn palette_agrees_on_lab_and_difference() {
    use palette::color_difference::Ciede2000;
    let white = RgbSpace::Srgb.white_xyz();
    let lab = |rgb| lab_from_xyz(RgbSpace::Srgb.xyz_from_rgb().apply(rgb), white);
    let theirs = |[l, a, b]: [f64; 3]| palette::Lab::<palette::white_point::D65, f64>::new(l, a, b);
    let (red, gold) = (lab([0.8, 0.1, 0.1]), lab([1.0, 0.77, 0.33]));
    assert!((ciede2000(red, gold) - theirs(red).difference(theirs(gold))).abs() < 1e-9);
}

/// F0 by 1 nm sums under D65, linear sRGB, Bradford from the integrated white.
fn f0(library: &Library, name: &str) -> [f64; 3] {
    let ior = library.ior(name, Path::new("")).unwrap();
    let (observer, d65) = (observer(library), light(library, "D65"));
    let points: Vec<_> = (360..=830)
        .map(|nm| {
            let nm = f64::from(nm);
            let (n, k) = ior.at(nm);
            (nm, ((n - 1.0) * (n - 1.0) + k * k) / ((n + 1.0) * (n + 1.0) + k * k))
        })
        .collect();
    let reflectance = Spectrum::Table(Table::from_points(&points, Outside::Hold));
    let y = tristimulus_1nm(&[&d65], &observer)[1];
    let xyz = tristimulus_1nm(&[&d65, &reflectance], &observer).map(|value| value / y);
    let white = white_xyz_1nm(&d65, &observer).unwrap();
    let space = RgbSpace::Srgb;
    space.rgb_from_xyz().apply(bradford(white, space.white_xyz()).apply(xyz))
}

#[test]
fn reference_colours_of_metals_and_diamond() {
    let library = library();
    let mut names = Vec::new();
    for line in include_str!("../../data/f0_srgb.csv").lines().skip(1) {
        let [name, r, g, b] = line.split(',').collect::<Vec<_>>().try_into().unwrap();
        let expected = [r, g, b].map(|value| value.parse().unwrap());
        let rgb = f0(&library, name);
        // The fixture's tables are the database's float32, ours the decimals behind them.
        assert!(far_apart(rgb, expected) < 2e-7, "{name}: {rgb:?} against {expected:?}");
        names.push(name);
    }
    assert!(names.starts_with(&["Au/olmon-2012-evaporated", "Ag/yang-2015", "C/peter-1923"]));
}

#[test]
fn whites_of_the_standard_illuminants() {
    let library = library();
    let observer = observer(&library);
    // CIE 15, table T.3: chromaticities for the 2° observer.
    for (name, x, y) in
        [("A", 0.44758, 0.40745), ("D50", 0.34567, 0.35851), ("D65", 0.31272, 0.32903), ("E", 1.0 / 3.0, 1.0 / 3.0)]
    {
        let xyz = white_xyz(&light(&library, name), &observer).unwrap();
        let sum: f64 = xyz.iter().sum();
        assert!((xyz[0] / sum - x).abs() < 5e-5 && (xyz[1] / sum - y).abs() < 5e-5, "{name}: {xyz:?}");
        let rectangles = white_xyz_1nm(&light(&library, name), &observer).unwrap();
        assert!(far_apart(xyz, rectangles) < 1e-4, "{name}: {xyz:?} {rectangles:?}");
    }
    assert!(white_xyz(&Spectrum::Constant(0.0), &observer).is_err());
    let line = Spectrum::Lines(vec![Line { nm: 555.0, power: 1.0 }]);
    assert!((luminance(&line, &observer) - 683.0).abs() < 0.1);
}

/// Tables end at 780 nm as published; light that shines goes on by the series.
#[test]
fn daylight_in_a_scene_reaches_830_nm() {
    let library = library();
    for (name, nominal) in [("D50", 5000.0), ("D55", 5500.0), ("d65", 6500.0), ("D75", 7500.0)] {
        let table = library.illuminant(name, Path::new("")).unwrap();
        let shining = library.light(name, Path::new("")).unwrap();
        assert_eq!((table.about.range_nm, table.spectrum.at(785.0)), (Some((300.0, 780.0)), 0.0), "{name}");
        assert_eq!(shining.about.range_nm, Some((300.0, 830.0)));
        let series = Daylight::new(nominal * 1.4388 / 1.438).unwrap();
        for nm in [410.0, 543.0, 780.0, 785.0, 790.0, 825.0, 830.0] {
            let (own, theirs) = (shining.spectrum.at(nm), series.at(nm));
            assert!((own / theirs - 1.0).abs() < 1e-4, "{name} at {nm} nm: {own} {theirs}");
        }
    }
    let a = library.light("A", Path::new("")).unwrap();
    assert_eq!(*a, *library.illuminant("A", Path::new("")).unwrap());
    let scene = "[camera]\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\nup = [0, 1, 0]\nfov = 10\n\
        [environment.constant]\nspectrum = \"D65\"\nluminance = 100\n";
    let text = spectrel::scene::Text::new("scene.toml", scene);
    let scene = spectrel::scene::resolve(text, &library, &spectrel::scene::Overrides::default()).unwrap();
    assert_eq!(scene.data[0].about.range_nm, Some((300.0, 830.0)));
}

#[test]
fn daylight_follows_the_table_and_an_independent_evaluation() {
    let library = library();
    let table = light(&library, "D65");
    let d65 = Daylight::new(6500.0 * 1.4388 / 1.438).unwrap();
    for nm in 300..=780 {
        let nm = f64::from(nm);
        assert!((d65.at(nm) - table.at(nm)).abs() < 6e-3, "{nm} nm: {} {}", d65.at(nm), table.at(nm));
    }
    let mut lines = include_str!("../../data/daylight.csv").lines();
    let series: Vec<_> = lines
        .next()
        .unwrap()
        .split(',')
        .skip(1)
        .map(|kelvin| Daylight::new(kelvin.parse().unwrap()).unwrap())
        .collect();
    for line in lines {
        let row: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
        for (daylight, expected) in series.iter().zip(&row[1..]) {
            assert!(
                (daylight.at(row[0]) - expected).abs() < 1e-6,
                "{} K {line}: {}",
                daylight.kelvin(),
                daylight.at(row[0])
            );
        }
    }
}

/// Largest relative error of X, Y, Z by the nodes.
fn node_error(nodes: &Nodes, light: &Spectrum, observer: &ColorMatching) -> f64 {
    let exact = tristimulus(&[light], observer);
    let ours = nodes.tristimulus(light, observer);
    (0..3).map(|i| (ours[i] - exact[i]).abs() / exact[i].abs()).fold(0.0, f64::max)
}

#[test]
fn nodes_are_a_quadrature() {
    let library = library();
    let observer = observer(&library);
    let nodes = Nodes::new(&Density::visible());
    for name in library.names(spectrel::spectrum::Quantity::Illuminant) {
        let error = node_error(&nodes, &light(&library, &name), &observer);
        let smooth = ["a", "d50", "d65", "e", "d55", "d75"].contains(&name.as_str());
        eprintln!("{name}: {error:.1e}");
        assert!(error < if smooth { 1e-6 } else { 1e-5 }, "{name}: {error:e}");
    }
    let mercury = [404.656, 435.833, 546.074, 576.96, 579.066];
    let lines = mercury.map(|nm| Line { nm, power: 100.0 });
    let lamp = Spectrum::Sum(vec![light(&library, "FL2"), Spectrum::Lines(lines.to_vec())]);
    let error = node_error(&Nodes::new(&Density::following(&lamp, &observer)), &lamp, &observer);
    eprintln!("FL2 with mercury lines: {error:.1e}");
    assert!(error < 2e-5, "{error:e}");
}

/// Reflectances of all kinds: flat, steep, narrow.
fn reflectances() -> Vec<(&'static str, Spectrum)> {
    let of = |f: &dyn Fn(f64) -> f64| {
        let points: Vec<_> = (360..=830).map(|nm| (f64::from(nm), f(f64::from(nm)))).collect();
        Spectrum::Table(Table::from_points(&points, Outside::Hold))
    };
    let edge = |nm: f64, width: f64| 1.0 / (1.0 + ((nm) / width).exp());
    let bump = |x: f64| (-x * x).exp();
    vec![
        ("white", of(&|_| 1.0)),
        ("red", of(&|nm| 0.05 + 0.9 * edge(600.0 - nm, 12.0))),
        ("green", of(&|nm| 0.05 + 0.9 * bump((nm - 530.0) / 35.0))),
        ("blue", of(&|nm| 0.05 + 0.8 * edge(nm - 480.0, 12.0))),
        ("gold", of(&|nm| 0.35 + 0.6 * edge(510.0 - nm, 20.0))),
        ("a notch", of(&|nm| 1.0 - 0.9 * bump((nm - 560.0) / 15.0))),
        ("a narrow band", of(&|nm| 0.02 + bump((nm - 640.0) / 8.0))),
    ]
}

/// Mean square over sets of eight of what one tells of a reflectance under a light, less the truth, over the white's square; and the
/// largest error of the mean over all sets.
fn told(nodes: &Nodes, light: &Spectrum, reflectance: &Spectrum, observer: &ColorMatching) -> (f64, f64) {
    let sets = NODE_COUNT / 8;
    let weights = nodes.observer_weights(observer);
    let (lights, reflectances) = (nodes.values(light), nodes.values(reflectance));
    let white = tristimulus(&[light], observer);
    let whole: f64 = white.iter().map(|c| c * c).sum();
    let exact = tristimulus(&[light, reflectance], observer);
    let mut square = 0.0;
    let mut mean = [0.0; 3];
    for set in 0..sets {
        let lanes = (0..8).map(|lane| set + lane * sets);
        for c in 0..3 {
            let sum: f64 = lanes.clone().map(|i| lights[i] * reflectances[i] * weights[i][c]).sum();
            square += (sets as f64 * sum - exact[c]).powi(2) / sets as f64;
            mean[c] += sum;
        }
    }
    let off = (0..3).map(|c| (mean[c] - exact[c]).abs() / whole.sqrt()).fold(0.0, f64::max);
    (square / whole, off)
}

#[test]
fn wavelengths_that_follow_lights_with_lines_tell_more_of_colours() {
    let library = library();
    let observer = observer(&library);
    let lines = |nm: &[f64]| Spectrum::Lines(nm.iter().map(|&nm| Line { nm, power: 100.0 }).collect());
    let mercury = [404.656, 435.833, 546.074, 576.96, 579.066];
    let mut lights: Vec<(String, Spectrum)> = library
        .names(spectrel::spectrum::Quantity::Illuminant)
        .into_iter()
        .map(|name| (name.clone(), light(&library, &name)))
        .collect();
    for lamp in ["FL2", "FL11"] {
        lights.push((format!("{lamp}, mercury"), Spectrum::Sum(vec![light(&library, lamp), lines(&mercury)])));
    }
    lights.push(("mercury".into(), lines(&mercury)));
    lights.push(("laser".into(), lines(&[532.0])));
    lights.push(("blackbody".into(), Spectrum::Blackbody { kelvin: 1500.0 }));
    let visible = Nodes::new(&Density::visible());
    for (name, light) in &lights {
        let following = Nodes::new(&Density::following(light, &observer));
        let (white, off) = (visible.variance(light, &observer), node_error(&following, light, &observer));
        let mut gains = Vec::new();
        for (color, reflectance) in reflectances() {
            let [before, after] = [&visible, &following].map(|nodes| told(nodes, light, &reflectance, &observer));
            gains.push((before.0 / after.0).ln());
            let most = if name == "laser" { 5e-5 } else { 3e-6 };
            assert!(after.1 < most, "{color} under {name}: {:e} off in the mean", after.1);
        }
        let gain = (gains.iter().sum::<f64>() / gains.len() as f64).exp();
        let after = following.variance(light, &observer);
        println!("{name:>15}: white {white:.4}, then {after:.4}; gain {gain:.1}; off {off:.1e}");
        assert!(off < if name == "laser" { 4e-5 } else { 5e-6 }, "{name}: {off:e}");
        // What `scene::lighting` takes for smooth stays below a hundredth, and would gain little.
        let smooth = ["a", "d50", "d55", "d65", "d75", "e", "led-b1", "led-b2", "blackbody"].contains(&name.as_str());
        assert_eq!(white < 0.01, smooth, "{name}: {white}");
        assert!(if smooth { gain < 3.0 } else { gain > 3.5 && after < 0.05 }, "{name}: {gain}");
    }
}

#[test]
fn sets_estimate_the_luminance_in_candela() {
    let library = library();
    let observer = observer(&library);
    let nodes = Nodes::new(&Density::visible());
    let lamp = Spectrum::Blackbody { kelvin: 2856.0 };
    let mut arena = Arena::default();
    let id = arena.add(lamp.clone());
    let mut tables = arena.tabulate(&nodes, 8);
    let [_, y, _] = tables.push_observer(&nodes.observer_weights(&observer));
    let set = |set: u32| {
        let wavelengths = Wavelengths::<8>::new(&tables, set);
        f64::from((wavelengths.at(id) * wavelengths.at(y)).sum())
    };
    let estimate = (0..tables.sets()).map(set).sum::<f64>() / f64::from(tables.sets());
    assert!((estimate / luminance(&lamp, &observer) - 1.0).abs() < 1e-5);
}

#[test]
fn wavelengths_follow_the_density() {
    let library = library();
    let lines = [546.074, 589.3].map(|nm| Line { nm, power: 1.0 });
    let lamp = Spectrum::Sum(vec![light(&library, "FL11"), Spectrum::Lines(lines.to_vec())]);
    let density = Density::following(&lamp, &observer(&library));
    let nodes = Nodes::new(&density);
    // Sets drawn uniformly show each node equally often; bin the nodes and compare with the density: χ² per bin.
    let bins = 47;
    let count = NODE_COUNT;
    let mut seen = vec![0.0; bins];
    (0..count).for_each(|i| seen[((nodes.wavelength_nm(i) - 360.0) / 10.0) as usize] += 1.0);
    for (bin, seen) in seen.iter().enumerate() {
        let low = 360.0 + 10.0 * bin as f64;
        let expected = count as f64 * (density.cdf(low + 10.0) - density.cdf(low));
        assert!((seen - expected).abs() <= 1.0, "{low} nm: {seen} nodes, {expected} expected");
    }
}

#[test]
fn colours_survive_the_way_to_a_reflectance_and_back() {
    let library = library();
    let upsampler = Upsampler::new(&library).unwrap();
    let mut worst: f64 = 0.0;
    for r in 0..=6 {
        for g in 0..=6 {
            for b in 0..=6 {
                let rgb = [r, g, b].map(|i| 0.02 + 0.8 * f64::from(i) / 6.0);
                let reflectance = upsampler.reflectance(rgb).unwrap();
                let error = far_apart(upsampler.rgb(&reflectance), rgb);
                worst = worst.max(error);
                assert!((360..=830).all(|nm| (0.0..=1.0).contains(&reflectance.at(f64::from(nm)))), "{rgb:?}");
                // What is far from the gamut's corners comes back.
                let (low, high) = (rgb.into_iter().fold(1.0, f64::min), rgb.into_iter().fold(0.0, f64::max));
                if low > 0.1 * high {
                    assert!(error < 1e-6, "{rgb:?}: {error:e} {reflectance:?}");
                }
            }
        }
    }
    eprintln!("worst round trip: {worst:.1e}");
    assert!(worst < 0.05, "{worst}");
    for rgb in [[0.0; 3], [1.0; 3], [0.18; 3]] {
        assert!(far_apart(upsampler.rgb(&upsampler.reflectance(rgb).unwrap()), rgb) < 1e-12);
    }
    // The samples that the fit uses are as good as the exact integral, even for the steep curves at the corners.
    let (observer, d65) = (observer(&library), light(&library, "D65"));
    let space = RgbSpace::Srgb;
    let adapt = bradford(white_xyz(&d65, &observer).unwrap(), space.white_xyz());
    let y = tristimulus(&[&d65], &observer)[1];
    for corner in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0], [1.0, 0.0, 1.0]]
    {
        let back = upsampler.rgb(&upsampler.reflectance(corner).unwrap());
        assert!(far_apart(back, corner) < 1e-6, "{corner:?} {back:?}");
        let exact = tristimulus(&[&d65, &upsampler.reflectance(corner).unwrap()], &observer).map(|value| value / y);
        let exact = space.rgb_from_xyz().apply(adapt.apply(exact));
        assert!(far_apart(exact, corner) < 1e-4, "{corner:?} {exact:?}");
    }
    assert!(upsampler.reflectance([1.1, 0.0, 0.0]).is_err() && upsampler.reflectance([f64::NAN, 0.0, 0.0]).is_err());
}

/// ΔE2000 of colours that go through a table and back, sorted; the colours are random and the same every day.
fn table_errors(library: &Library, table: &UpsampleTable, space: RgbSpace) -> Vec<f64> {
    let upsampler = Upsampler::for_space(library, space).unwrap();
    let mut random: u64 = 0x1234567;
    let mut unit = || {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        (random >> 40) as f64 / f64::from(1 << 24)
    };
    let mut errors: Vec<f64> = (0..3000)
        .map(|_| {
            let rgb = [unit(), unit(), unit()];
            let tint = table.tint(rgb.map(|value| value as f32));
            let spectrum = Spectrum::Sigmoid(Sigmoid(tint.coefficients.map(f64::from))).scaled(f64::from(tint.scale));
            let lab = |rgb| lab_from_xyz(space.xyz_from_rgb().apply(rgb), space.white_xyz());
            ciede2000(lab(rgb), lab(upsampler.rgb(&spectrum)))
        })
        .collect();
    errors.sort_by(f64::total_cmp);
    errors
}

#[test]
fn colours_survive_the_table_for_pictures() {
    let library = library();
    let radiance = |space| UpsampleTable::for_radiance(&library, space).unwrap();
    let reflectance = UpsampleTable::for_reflectance(&library).unwrap();
    for (name, table, space, limits) in [
        ("reflectance", reflectance, RgbSpace::Srgb, [0.08, 0.3, 1.1]),
        ("radiance", radiance(RgbSpace::Srgb), RgbSpace::Srgb, [0.006, 0.05, 0.5]),
        ("radiance", radiance(RgbSpace::DisplayP3), RgbSpace::DisplayP3, [0.01, 0.1, 2.5]),
        ("radiance", radiance(RgbSpace::Rec2020), RgbSpace::Rec2020, [0.03, 0.3, 5.0]),
        ("radiance", radiance(RgbSpace::AcesCg), RgbSpace::AcesCg, [0.05, 1.5, 6.0]),
    ] {
        let errors = table_errors(&library, &table, space);
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        let found = [mean, errors[errors.len() * 99 / 100], errors[errors.len() - 1]];
        println!("{name} in {}: ΔE mean {:.4}, 99 % {:.3}, largest {:.2}", space.name(), found[0], found[1], found[2]);
        assert!(found.iter().zip(limits).all(|(found, limit)| *found < limit), "{name} in {space:?}: {found:?}");
    }
}

#[test]
fn greys_of_the_tables_are_flat_and_exact() {
    let library = library();
    let radiance = UpsampleTable::for_radiance(&library, RgbSpace::Srgb).unwrap();
    let reflectance = UpsampleTable::for_reflectance(&library).unwrap();
    let positions = Lanes([0.0, 0.2, 0.4, 0.5, 0.6, 0.8, 0.9, 1.0]);
    for grey in [1e-6f32, 0.003, 0.18, 0.5, 0.7, 1.0, 3.7, 1e6] {
        assert_eq!(radiance.tint([grey; 3]).at(positions), Lanes::splat(grey));
        let seen = reflectance.tint([grey.min(1.0); 3]).at(positions);
        assert!(seen.0.iter().all(|value| (value / grey.min(1.0) - 1.0).abs() < 7e-5 && *value == seen[0]), "{seen:?}");
    }
    assert_eq!(radiance.tint([0.0; 3]), Tint::BLACK);
}

#[test]
fn chromaticities_of_files_are_known_or_converted() {
    for space in RgbSpace::ALL {
        let stated = space.chromaticities();
        assert_eq!(stated.space(), Some(space));
        let white = stated.to(RgbSpace::Rec2020).unwrap().apply([1.0; 3]);
        assert!(far_apart(white, [1.0; 3]) < 1e-12, "{space:?}: {white:?}");
    }
    // Files of XYZ: no luminance in X and Z.
    let xyz = Chromaticities { primaries_xy: [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]], white_xy: [1.0 / 3.0, 1.0 / 3.0] };
    let rows = xyz.xyz_from_rgb().unwrap();
    assert!(far_apart(rows.apply([0.3, 0.5, 0.9]), [0.3, 0.5, 0.9]) < 1e-12 && xyz.space().is_none());
    for [x, y] in [[0.3, 0.3], [f64::NAN, 0.2]] {
        let none = Chromaticities { primaries_xy: [[0.6, 0.3], [x, y], [0.3, 0.3]], white_xy: [0.31, 0.33] };
        assert!(none.xyz_from_rgb().is_none(), "{x} {y}");
    }
}
