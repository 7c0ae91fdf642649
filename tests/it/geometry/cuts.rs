//! Gem cuts: counts, angles, symmetry and proportions, recovered from the solids.

use glam::Vec3;
use spectrel::geometry::{Brilliant, Convex, Facet, GeometryError, StepCut};

const ANGLE: f32 = 1e-3;

/// Angle of a facet against the girdle plane, degrees.
fn slope(facet: &Facet) -> f32 {
    let n = facet.normal;
    (n.x * n.x + n.y * n.y).sqrt().atan2(n.z.abs()).to_degrees()
}

/// Euler's formula, and outlines that fit together.
fn check_closed(solid: &Convex) {
    let (v, e, f) = (solid.vertices().len(), solid.edges().len(), solid.facets().len());
    assert_eq!(v + f, e + 2);
    let sides: usize = (0..f as u32).map(|facet| solid.corners(facet).len()).sum();
    assert_eq!(sides, 2 * e);
    // Areas as vectors sum to zero on a closed surface.
    let sum: Vec3 = solid.facets().iter().map(|f| f.normal * f.area).sum();
    assert!(sum.length() < 1e-6 * solid.area(), "{sum}");
    for (number, facet) in (0..).zip(solid.facets()) {
        assert!(facet.area > 0.0);
        for &corner in solid.corners(number) {
            let height = facet.normal.dot(solid.vertices()[corner as usize] - solid.center()) - facet.offset;
            assert!(height.abs() < 1e-6 * solid.radius());
        }
    }
}

#[test]
fn brilliant_has_its_facets_and_angles() {
    for (culet, girdle_facets) in [(0.0, 32), (0.02, 32), (0.0, 64), (0.01, 96)] {
        let cut = Brilliant { culet, girdle_facets, ..Brilliant::default() };
        let solid = cut.solid().unwrap();
        check_closed(&solid);
        let extra = usize::from(culet > 0.0);
        assert_eq!(solid.facets().len(), 57 + extra + girdle_facets as usize);
        let up = solid.facets().iter().filter(|f| f.normal.z > 1e-4).count();
        let down = solid.facets().iter().filter(|f| f.normal.z < -1e-4).count();
        assert_eq!((up, down), (33, 24 + extra));
        let at = |range: std::ops::Range<usize>| solid.facets()[range].iter().map(slope);
        assert!(at(0..1).all(|a| a < ANGLE));
        assert!(at(1..9).all(|a| (a - 34.5).abs() < ANGLE), "bezels");
        let mains = 33 + girdle_facets as usize;
        assert!(at(33..mains).all(|a| (a - 90.0).abs() < ANGLE), "girdle");
        assert!(at(mains..mains + 8).all(|a| (a - 40.75).abs() < ANGLE), "mains");
        // Known from the trade: stars are flatter than bezels by 10 to 14 degrees, halves steeper than their mains.
        assert!(at(9..17).all(|a| (20.0..25.0).contains(&a)), "stars {:?}", at(9..17).next());
        assert!(at(17..33).all(|a| (38.0..44.0).contains(&a)), "upper halves {:?}", at(17..33).next());
        assert!(at(mains + 8..mains + 24).all(|a| (41.0..43.0).contains(&a)), "lower halves");
    }
}

#[test]
fn brilliant_is_eightfold() {
    let solid = Brilliant::default().solid().unwrap();
    let (sin, cos) = std::f32::consts::FRAC_PI_4.sin_cos();
    let turned = |p: Vec3| Vec3::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y, p.z);
    let mirrored = |p: Vec3| Vec3::new(p.x, -p.y, p.z);
    for &vertex in solid.vertices() {
        for image in [turned(vertex), mirrored(vertex)] {
            assert!(solid.vertices().iter().any(|v| v.distance(image) < 1e-6), "{vertex}");
        }
    }
}

#[test]
fn brilliant_proportions_come_back_from_its_vertices() {
    let cut = Brilliant { diameter: 6.5, star_length: 0.45, lower_half_length: 0.8, ..Brilliant::default() };
    let solid = cut.solid().unwrap();
    let near = |a: f32, b: f64| assert!((a as f64 - b).abs() < 2e-6 * cut.diameter, "{a} {b}");
    let plan = |v: &Vec3| (v.x * v.x + v.y * v.y).sqrt();
    let corners = |facets: std::ops::Range<usize>| {
        let corners = facets.flat_map(|facet| solid.corners(facet as u32));
        corners.map(|&corner| solid.vertices()[corner as usize]).collect::<Vec<_>>()
    };
    near(solid.bounds().size().x, cut.diameter);
    near(solid.bounds().min.z, 0.0);
    near(solid.bounds().max.z, cut.height());
    let table = corners(0..1);
    assert_eq!(table.len(), 8);
    table.iter().for_each(|v| near(plan(v), 0.5 * 0.57 * cut.diameter));
    // The lowest point of a star is its tip.
    let radius = 0.5 * cut.diameter;
    let edge = 0.57 * radius * (std::f64::consts::PI / 8.0).cos();
    let star = corners(9..10);
    assert_eq!(star.len(), 3);
    let tip = star.iter().min_by(|a, b| a.z.total_cmp(&b.z)).unwrap();
    near(plan(tip), edge + 0.45 * (radius - edge));
    // The lowest point of a lower half likewise.
    let lower = solid.facets().len() - 16;
    let tip = *corners(lower..lower + 1).iter().min_by(|a, b| a.z.total_cmp(&b.z)).unwrap();
    near(plan(&tip), 0.2 * radius);
    // Mains and bezels reach the girdle at its thickest.
    let main = solid.facets().len() - 24;
    let bottom = corners(main..main + 1).iter().map(|v| v.z).fold(0.0, f32::max);
    let top = corners(1..2).iter().map(|v| v.z).fold(f32::INFINITY, f32::min);
    near(top - bottom, 0.035 * cut.diameter);
    near(0.5 * (top + bottom), cut.girdle_height());
}

#[test]
fn brilliant_in_single_precision_angles_stay_exact_at_any_size() {
    for diameter in [1e-6, 1.0, 1e6] {
        let solid = Brilliant { diameter, ..Brilliant::default() }.solid().unwrap();
        assert_eq!(solid.facets().len(), 57 + Brilliant::default().girdle_facets as usize);
    }
}

#[test]
fn impossible_proportions_say_which() {
    let cases = [
        (Brilliant { table: 1.2, ..Brilliant::default() }, "the table is 1.2"),
        (Brilliant { crown_angle: f64::NAN, ..Brilliant::default() }, "the crown angle is NaN"),
        (Brilliant { girdle_facets: 50, ..Brilliant::default() }, "multiple of 16"),
        (Brilliant { diameter: 0.0, ..Brilliant::default() }, "the diameter of the brilliant must be above zero"),
        (Brilliant { girdle: 0.005, ..Brilliant::default() }, "girdle"),
        (Brilliant { culet: 0.4, ..Brilliant::default() }, "culet"),
    ];
    for (cut, words) in cases {
        let error = cut.solid().expect_err(words);
        assert!(error.to_string().contains(words), "{error}");
        assert!(!matches!(error, GeometryError::NoVolume));
    }
}

#[test]
fn step_cut_has_its_steps() {
    let cut = StepCut::default();
    let solid = cut.solid().unwrap();
    check_closed(&solid);
    let size = solid.bounds().size();
    assert!((size.y - 1.0).abs() < 1e-6 && (size.x - 1.4).abs() < 1e-6);
    let slopes = |up: bool| {
        let mut all: Vec<f32> = solid
            .facets()
            .iter()
            .filter(|f| if up { f.normal.z > 1e-4 } else { f.normal.z < -1e-4 })
            .map(slope)
            .collect();
        all.sort_by(f32::total_cmp);
        all.dedup_by(|a, b| (*a - *b).abs() < ANGLE);
        all
    };
    let same = |a: Vec<f32>, b: &[f32]| {
        assert!(a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < ANGLE), "{a:?}")
    };
    same(slopes(true), &[0.0, 33.0, 40.0, 47.0]);
    same(slopes(false), &[41.0, 48.0, 55.0]);
    let table = solid.corners(solid.facets().iter().position(|f| f.normal.z > 0.9999).unwrap() as u32);
    assert_eq!(table.len(), 8);
    let across: Vec<f32> = table.iter().map(|&c| solid.vertices()[c as usize].y).collect();
    let width = across.iter().fold(0.0f32, |m, y| m.max(*y)) * 2.0;
    assert!((width - 0.6).abs() < 1e-6);
    assert!(StepCut { crown_angles: [30.0, 40.0, 20.0], ..cut }.solid().err().unwrap().to_string().contains("crown"));
}
