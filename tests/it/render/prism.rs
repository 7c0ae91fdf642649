//! Refraction measured as in a laboratory: a prism at minimum deviation, and diamond's critical angle.

use glam::{DVec3, Vec3};
use spectrel::bsdf::dielectric::refract_lanes;
use spectrel::fresnel::SpectralModel;
use spectrel::geometry::{Convex, Departure, Plane, Ray, Shape, ShapeId, Side, World};
use spectrel::math::{Lanes, Vectors};
use spectrel::spectrum::Library;
use std::path::Path;

const APEX: f64 = 60.0;

/// An equilateral prism along y, its apex up.
fn prism() -> Convex {
    let half = (APEX / 2.0).to_radians();
    let side = |sign: f64| Plane::new(DVec3::new(sign * half.cos(), 0.0, half.sin()), 1.0);
    let ends = [1.0, -1.0].map(|y| Plane::new(DVec3::new(0.0, y, 0.0), 5.0));
    Convex::from_planes(&[side(1.0), side(-1.0), Plane::new(DVec3::NEG_Z, 2.0), ends[0], ends[1]]).expect("a prism")
}

/// Refraction of one lane at a facet; `None` when it is totally reflected.
fn refracted(direction: Vec3, normal: Vec3, n1: f32, n2: f32) -> Option<Vec3> {
    let cos = Lanes([-direction.dot(normal)]);
    let boundary = SpectralModel::Exact.dielectric(&Lanes([n1]), &Lanes([n2]), &cos);
    let out = refract_lanes(
        &Vectors::splat(direction),
        &Vectors::splat(normal),
        &Lanes([n1 / n2]),
        &cos,
        &boundary.cos_theta_t,
    );
    (boundary.r[0] < 1.0).then(|| out.get(0))
}

/// Deviation in radians of a ray that meets the left side of the prism at an angle of incidence, degrees.
fn deviation(world: &World, n: f32, incidence: f64) -> Option<f64> {
    let Shape::Convex(solid) = world.shape(ShapeId(0))? else { return None };
    let half = (APEX / 2.0).to_radians();
    let normal = DVec3::new(-half.cos(), 0.0, half.sin());
    // From below the normal, so that the light is bent towards the base.
    let tangent = DVec3::new(half.sin(), 0.0, half.cos());
    let angle = incidence.to_radians();
    let direction = (tangent * angle.sin() - normal * angle.cos()).as_vec3();
    let foot = (normal * 1.0).as_vec3();
    let ray = Ray { origin: foot - direction * 3.0, direction, departs: Departure::Free };
    let hit = world.closest(&ray, f32::INFINITY)?;
    assert_eq!(hit.side, Side::Outside);
    let within = refracted(direction, hit.normal, 1.0, n)?;
    let exit = solid.exit_lanes::<1>(&Vectors::splat(hit.point), &Vectors::splat(within));
    let out = refracted(within, -solid.normal(exit.facet[0]), n, 1.0)?;
    Some(direction.as_dvec3().normalize().angle_between(out.as_dvec3().normalize()))
}

/// n = sin((A + D)/2) / sin(A/2) at the smallest deviation D (Fraunhofer 1814).
fn index_recovered(world: &World, n: f32) -> f64 {
    let deviations =
        (0..40_000).map(|i| 20.0 + f64::from(i) * 69.0 / 40_000.0).filter_map(|angle| deviation(world, n, angle));
    let smallest = deviations.fold(f64::INFINITY, f64::min);
    let apex = APEX.to_radians();
    ((apex + smallest) / 2.0).sin() / (apex / 2.0).sin()
}

#[test]
fn minimum_deviation_gives_back_the_index_of_sf11() {
    let world = World::new(vec![prism().into()]).expect("one shape");
    let glass = Library::new(Vec::new()).ior("SCHOTT/sf11", Path::new("")).expect("in the library");
    let mut found = Vec::new();
    for nm in [486.1, 587.6, 656.3] {
        let n = glass.n.at(nm);
        let recovered = index_recovered(&world, n as f32);
        println!("prism of SF11 at {nm} nm: n off by {:.1e}", (recovered - n).abs());
        assert!((recovered - n).abs() < 1e-4, "{nm} nm: {recovered} against {n}");
        found.push(recovered);
    }
    assert!(found[0] - found[2] > 0.03, "the prism disperses: {found:?}");
}

#[test]
fn diamond_reflects_totally_from_its_critical_angle_on() {
    let diamond = Library::new(Vec::new()).ior("C/peter-1923", Path::new("")).expect("in the library");
    let n = diamond.n.at(589.3);
    let critical = (1.0 / n).asin();
    assert!((critical.to_degrees() - 24.43).abs() < 0.02, "the handbook's angle");
    let reflectance = |angle: f64| {
        let cos = Lanes([angle.cos() as f32]);
        SpectralModel::Exact.dielectric(&Lanes([n as f32]), &Lanes([1.0]), &cos).r[0]
    };
    assert_eq!(reflectance(critical + 1e-4), 1.0);
    assert!(reflectance(critical - 1e-4) < 0.96);
}
