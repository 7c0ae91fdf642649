//! Whether faces of two shapes coincide: lie in one plane but for rounding, and overlap there.
//!
//! A sphere has no faces, but two spheres may be one. Polygons overlap unless a line along an edge
//! of one of them parts them (the theorem of separating axes in the plane of both). A disk counts
//! as the square around it.

use glam::DVec3;

use super::{Bounds, Shape, ShapeId, World};

/// Faces that coincide on paper are this far apart at most, in roundings of the shapes'
/// coordinates: each has been through a transform of its own.
const ROUNDINGS: f64 = 8.0;

impl Shape {
    /// Whether faces of two shapes may coincide over an area. To touch in a point or along an edge
    /// is not enough.
    pub fn may_share_a_face(&self, other: &Shape) -> bool {
        let tolerance = tolerance(&self.bounds(), &other.bounds());
        if let (Shape::Sphere(a), Shape::Sphere(b)) = (self, other) {
            let apart = (a.center() - b.center()).as_dvec3().length();
            return apart.max(f64::from((a.radius() - b.radius()).abs())) <= tolerance;
        }
        self.any_face_near(&other.bounds().widened(tolerance), &|own| {
            let around = Bounds::of(own.iter().map(|corner| corner.as_vec3())).widened(tolerance);
            other.any_face_near(&around, &|its| coincide(own, its, tolerance))
        })
    }

    /// Whether something holds for the corners of a face whose box meets another one.
    fn any_face_near(&self, near: &Bounds, holds: &dyn Fn(&[DVec3]) -> bool) -> bool {
        let flat = |center: glam::Vec3, u: glam::Vec3, v: glam::Vec3| {
            let [c, u, v] = [center, u, v].map(|p| p.as_dvec3());
            holds(&[c + u + v, c - u + v, c - u - v, c + u - v])
        };
        match self {
            Shape::Sphere(_) => false,
            Shape::Rectangle(s) => flat(s.flat.center, s.flat.u, s.flat.v),
            Shape::Disk(s) => flat(s.flat.center, s.flat.u, s.flat.v),
            Shape::Convex(s) => (0..s.facets().len() as u32).any(|facet| {
                let corners = || s.corners(facet).iter().map(|&corner| s.vertices()[corner as usize]);
                Bounds::of(corners()).padded().meets(near)
                    && holds(&corners().map(|p| p.as_dvec3()).collect::<Vec<_>>())
            }),
            Shape::Mesh(s) => s.any_triangle_near(near, |triangle| holds(triangle)),
        }
    }
}

impl World {
    /// Those of the shapes `asked` for that may share a face with one of them, in their order.
    pub fn sharing_a_face(&self, id: ShapeId, asked: impl Fn(ShapeId) -> bool) -> Vec<ShapeId> {
        let Some(own) = self.shape(id) else { return Vec::new() };
        let mut near = self.meeting(&own.bounds().widened(tolerance(&own.bounds(), &self.bounds())));
        let shares = |other| self.shape(other).is_some_and(|its| own.may_share_a_face(its));
        near.retain(|&other| other != id && asked(other) && shares(other));
        near
    }
}

/// How far faces of shapes in two boxes are apart at most if they coincide.
fn tolerance(a: &Bounds, b: &Bounds) -> f64 {
    let reach = |of: &Bounds| f64::from(of.min.abs().max(of.max.abs()).max_element());
    ROUNDINGS * f64::from(f32::EPSILON) * (reach(a) + reach(b))
}

/// Whether two convex polygons lie in one plane to within a length, and overlap there by more than
/// that.
fn coincide(a: &[DVec3], b: &[DVec3], tolerance: f64) -> bool {
    let (Some(across_a), Some(across_b)) = (normal(a), normal(b)) else { return false };
    // The smaller one tells: its plane may be far from the other's corners.
    let lies_in = |corners: &[DVec3], plane: &[DVec3], normal: DVec3| {
        corners.iter().all(|corner| normal.dot(*corner - plane[0]).abs() <= tolerance)
    };
    (lies_in(a, b, across_b) || lies_in(b, a, across_a))
        && !parts(a, across_a, b, tolerance)
        && !parts(b, across_b, a, tolerance)
}

/// Whether a line along an edge of a polygon has it on one side and another one, but for a margin,
/// on the other.
fn parts(polygon: &[DVec3], normal: DVec3, other: &[DVec3], margin: f64) -> bool {
    let edges = polygon.iter().zip(polygon.iter().cycle().skip(1));
    let mut outwards = edges.filter_map(|(from, to)| Some((*from, (*to - *from).cross(normal).try_normalize()?)));
    outwards.any(|(from, out)| other.iter().all(|corner| out.dot(*corner - from) >= -margin))
}

/// The unit normal about which the corners of a polygon turn left; none without an area (Newell's
/// sum).
fn normal(corners: &[DVec3]) -> Option<DVec3> {
    let from_first = corners.windows(2).map(|pair| (pair[0] - corners[0]).cross(pair[1] - corners[0]));
    from_first.sum::<DVec3>().try_normalize()
}

#[cfg(test)]
mod tests {
    use super::super::{Brilliant, Convex, Disk, Rectangle, Sphere};
    use super::*;
    use glam::{Affine3A, Quat, Vec3};

    fn cube(center: Vec3, half: Vec3) -> Shape {
        Convex::cuboid(center, half).expect("a box").into()
    }

    fn rectangle(center: Vec3, u: Vec3, v: Vec3) -> Shape {
        Rectangle::new(center, 2.0 * u, 2.0 * v).expect("a rectangle").into()
    }

    /// In either order, and wherever both are taken together.
    fn found(a: &Shape, b: &Shape) -> bool {
        let turn = Quat::from_axis_angle(Vec3::new(0.3, -0.5, 0.8).normalize(), 1.1);
        let move_to = |scale: f32, at: Vec3| {
            let affine = Affine3A::from_scale_rotation_translation(Vec3::splat(scale), turn, at);
            [a, b].map(|shape| shape.transformed(&affine).expect("a good transform"))
        };
        let shares = a.may_share_a_face(b);
        assert_eq!(b.may_share_a_face(a), shares);
        for (scale, at) in [(1.0, Vec3::ZERO), (1e-3, Vec3::ZERO), (1e3, Vec3::ZERO), (1.0, Vec3::new(20.0, -7.0, 3.0))]
        {
            let [a, b] = move_to(scale, at);
            assert_eq!((a.may_share_a_face(&b), b.may_share_a_face(&a)), (shares, shares), "× {scale} at {at}");
        }
        shares
    }

    #[test]
    fn sheets_on_faces_are_told_from_those_beside_them() {
        let solid = cube(Vec3::ZERO, Vec3::ONE);
        let (x, y, z) = (Vec3::X, Vec3::Y, Vec3::Z);
        for (sheet, lies) in [
            (rectangle(z, 5.0 * x, 5.0 * y), true),
            (rectangle(z + 0.2 * x, 0.1 * x, 0.1 * y), true),
            (rectangle(-z, y, x), true),
            (Disk::new(y, 0.3 * x, 0.3 * z).expect("a disk").into(), true),
            // Beside it, over it, in it, across it, and along an edge.
            (rectangle(z + 3.0 * x, 0.5 * x, 0.5 * y), false),
            (rectangle(1.001 * z, x, y), false),
            (rectangle(0.999 * z, x, y), false),
            (rectangle(Vec3::ZERO, 3.0 * x, 3.0 * y), false),
            (rectangle(z + 2.0 * x, x, y), false),
            (rectangle(z + x, y, z), true),
            (rectangle(2.0 * z + x, y, z), false),
        ] {
            assert_eq!(found(&solid, &sheet), lies, "{sheet:?}");
        }
    }

    #[test]
    fn solids_share_faces_but_not_edges_or_points() {
        let solid = cube(Vec3::ZERO, Vec3::ONE);
        assert!(found(&solid, &cube(2.0 * Vec3::X, Vec3::ONE)), "side by side");
        assert!(found(&solid, &cube(0.5 * Vec3::Z, Vec3::new(0.2, 0.2, 0.5))), "within, flush");
        assert!(!found(&solid, &cube(Vec3::new(2.0, 2.0, 0.0), Vec3::ONE)), "along an edge");
        assert!(!found(&solid, &cube(Vec3::splat(2.0), Vec3::ONE)), "in a corner");
        assert!(!found(&solid, &cube(Vec3::ZERO, Vec3::splat(0.5))), "within");
        let ball = |x: f32, radius: f32| Shape::from(Sphere::new(x * Vec3::X, radius).expect("a ball"));
        assert!(!found(&solid, &ball(2.0, 1.0)), "a ball against a face");
        assert!(found(&ball(0.0, 1.0), &ball(0.0, 1.0)), "one ball");
        assert!(!found(&ball(0.0, 1.0), &ball(2.0, 1.0)) && !found(&ball(0.0, 1.0), &ball(0.0, 0.99)));
    }

    #[test]
    fn a_stone_lies_on_its_table_but_not_on_its_culet() {
        let cut = Brilliant::default();
        let solid = cut.solid().expect("a stone");
        let [top, bottom] = [solid.bounds().max.z, solid.bounds().min.z];
        let stone = Shape::from(solid);
        let floor = |z: f32| rectangle(z * Vec3::Z, 9.0 * Vec3::X, 9.0 * Vec3::Y);
        assert!(found(&stone, &floor(top)));
        assert!(!found(&stone, &floor(bottom)));
    }
}
