//! Shapes: sizes checked, placed in the world.

use super::place::place;
use super::{Resolver, vector};
use crate::geometry::{Brilliant, Convex, Disk, GeometryError, Plane, Rectangle, Shape, Sphere, StepCut};
use crate::scene::SceneError;
use crate::scene::describe;
use crate::scene::numbers::{Finite, Length, Numbers};
use glam::{Affine3A, DMat3, DVec3, Vec3};
use toml::Spanned;

impl Resolver<'_> {
    /// The shape of an object where it is made, as seen from an origin; none for a mesh, which is loaded.
    pub fn shape(&self, object: &describe::Object, origin: DVec3) -> Result<Option<Shape>, SceneError> {
        build(object.shape.get_ref(), origin).map_err(|error| self.misshapen(error, &object.shape))
    }

    fn misshapen(&self, error: GeometryError, shape: &Spanned<describe::Shape>) -> SceneError {
        match (&error, shape.get_ref()) {
            (GeometryError::BadPlane { index }, describe::Shape::Convex(convex)) => self
                .text
                .error(&convex.planes[*index].span(), "the normal of this plane, its first three numbers, is zero"),
            _ => self.text.error(&shape.span(), error),
        }
    }
}

fn build(shape: &describe::Shape, origin: DVec3) -> Result<Option<Shape>, GeometryError> {
    let at = |center: Numbers<3>| place(center.values(), origin);
    Ok(Some(match shape {
        describe::Shape::Sphere(sphere) => Shape::Sphere(Sphere::new(at(sphere.center), sphere.radius.0 as f32)?),
        describe::Shape::Rectangle(rectangle) => {
            let [u, v] = edges(rectangle.normal.values())?;
            let [width, height] = rectangle.size.values().map(|side| side as f32);
            Shape::Rectangle(Rectangle::new(at(rectangle.center), u * width, v * height)?)
        }
        describe::Shape::Disk(disk) => {
            let normal = vector(disk.normal.values());
            Shape::Disk(Disk::facing(at(disk.center), normal, disk.radius.0 as f32)?)
        }
        describe::Shape::Box(cuboid) => Convex::cuboid(at(cuboid.center), vector(cuboid.size.values()) / 2.0)?.into(),
        describe::Shape::Convex(convex) => {
            let planes: Vec<_> =
                convex.planes.iter().map(|plane| half_space(plane.get_ref().values(), origin)).collect();
            Convex::from_planes(&planes)?.into()
        }
        describe::Shape::Brilliant(cut) => moved(brilliant(cut).solid()?, origin)?,
        describe::Shape::StepCut(cut) => moved(step_cut(cut).solid()?, origin)?,
        describe::Shape::Mesh(_) => return Ok(None),
    }))
}

/// A solid made around the zero of its coordinates, as seen from an origin.
fn moved(solid: Convex, origin: DVec3) -> Result<Shape, GeometryError> {
    let solid = if origin == DVec3::ZERO {
        solid
    } else {
        solid.transformed(&Affine3A::from_translation(-origin.as_vec3()))?
    };
    Ok(solid.into())
}

/// Two unit vectors that span the plane of a rectangle; its front faces the normal, its width stays level.
fn edges(normal: [f64; 3]) -> Result<[Vec3; 2], GeometryError> {
    let flat = GeometryError::NotPositive { what: "the length of the rectangle's normal", value: 0.0 };
    let normal = DVec3::from_array(normal).try_normalize().ok_or(flat)?;
    let level = DVec3::Z.cross(normal);
    let u = if level.length() > 1e-9 { level.normalize() } else { DVec3::X };
    Ok([u.as_vec3(), normal.cross(u).as_vec3()])
}

/// A transform, as seen from an origin.
pub fn affine(transform: &describe::Transform, origin: DVec3) -> Affine3A {
    let scale = transform.scale.as_ref().map_or([1.0; 3], |scale| scale.get_ref().0.values());
    let [(sx, cx), (sy, cy), (sz, cz)] =
        transform.rotate.unwrap_or_default().values().map(|degrees| libm::sincos(degrees.to_radians()));
    // About the fixed axes x, then y, then z. By `libm`: glam's own rotations use the machine's sine.
    let about_x = DMat3::from_cols(DVec3::X, DVec3::new(0.0, cx, sx), DVec3::new(0.0, -sx, cx));
    let about_y = DMat3::from_cols(DVec3::new(cy, 0.0, -sy), DVec3::Y, DVec3::new(sy, 0.0, cy));
    let about_z = DMat3::from_cols(DVec3::new(cz, sz, 0.0), DVec3::new(-sz, cz, 0.0), DVec3::Z);
    let matrix = about_z * about_y * about_x * DMat3::from_diagonal(DVec3::from_array(scale));
    Affine3A::from_mat3_translation(matrix.as_mat3(), place(transform.translate.unwrap_or_default().values(), origin))
}

fn half_space([x, y, z, offset]: [f64; 4], origin: DVec3) -> Plane {
    let normal = DVec3::new(x, y, z);
    Plane::new(normal, offset - normal.dot(origin))
}

/// A proportion, or the usual one.
fn or(given: Option<Finite>, usual: f64) -> f64 {
    given.map_or(usual, |Finite(value)| value)
}

fn brilliant(cut: &describe::Brilliant) -> Brilliant {
    let usual = Brilliant::default();
    Brilliant {
        diameter: cut.diameter.0,
        table: or(cut.table, usual.table),
        crown_angle: or(cut.crown_angle, usual.crown_angle),
        pavilion_angle: or(cut.pavilion_angle, usual.pavilion_angle),
        girdle: or(cut.girdle, usual.girdle),
        star_length: or(cut.star_length, usual.star_length),
        lower_half_length: or(cut.lower_half_length, usual.lower_half_length),
        culet: or(cut.culet, usual.culet),
        girdle_facets: cut.girdle_facets.unwrap_or(usual.girdle_facets),
    }
}

fn step_cut(cut: &describe::StepCut) -> StepCut {
    let usual = StepCut::default();
    let (Length(width), Length(length)) = (cut.width, cut.length);
    StepCut {
        width,
        length_ratio: length / width,
        corner: or(cut.corner, usual.corner),
        table: or(cut.table, usual.table),
        crown_angles: cut.crown_angles.map_or(usual.crown_angles, |angles| angles.values()),
        pavilion_angles: cut.pavilion_angles.map_or(usual.pavilion_angles, |angles| angles.values()),
        girdle: or(cut.girdle, usual.girdle),
    }
}
