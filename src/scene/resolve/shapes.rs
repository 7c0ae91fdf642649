//! Shapes: sizes checked, placed in the world.

use super::Resolver;
use crate::geometry::{Brilliant, Convex, Disk, GeometryError, Plane, Rectangle, Shape, Sphere, StepCut};
use crate::scene::SceneError;
use crate::scene::describe;
use glam::{Affine3A, DVec3, EulerRot, Quat, Vec3};

fn vector(v: [f64; 3]) -> Vec3 {
    DVec3::from_array(v).as_vec3()
}

impl Resolver<'_> {
    pub fn shape(&self, object: &describe::Object) -> Result<Shape, SceneError> {
        let span = object.shape.span();
        let shape = build(object.shape.get_ref()).map_err(|error| self.text.error(&span, error))?;
        let Some(transform) = &object.transform else { return Ok(shape) };
        let affine = affine(transform.get_ref());
        shape.transformed(&affine).map_err(|error| self.text.error(&transform.span(), error))
    }
}

fn build(shape: &describe::Shape) -> Result<Shape, GeometryError> {
    Ok(match shape {
        describe::Shape::Sphere(sphere) => Shape::Sphere(Sphere::new(vector(sphere.center), sphere.radius as f32)?),
        describe::Shape::Rectangle(rectangle) => {
            let [u, v] = edges(rectangle.normal)?;
            let [width, height] = rectangle.size.map(|side| side as f32);
            positive("the rectangle's size", rectangle.size)?;
            Shape::Rectangle(Rectangle::new(vector(rectangle.center), u * width, v * height)?)
        }
        describe::Shape::Disk(disk) => {
            Shape::Disk(Disk::facing(vector(disk.center), vector(disk.normal), disk.radius as f32)?)
        }
        describe::Shape::Box(cuboid) => {
            positive("the box's size", cuboid.size)?;
            Convex::cuboid(vector(cuboid.center), vector(cuboid.size) / 2.0)?.into()
        }
        describe::Shape::Convex(convex) => {
            Convex::from_planes(&convex.planes.iter().map(half_space).collect::<Vec<_>>())?.into()
        }
        describe::Shape::Brilliant(cut) => brilliant(cut).solid()?.into(),
        describe::Shape::StepCut(cut) => step_cut(cut).solid()?.into(),
    })
}

fn positive<const N: usize>(what: &'static str, sizes: [f64; N]) -> Result<(), GeometryError> {
    match sizes.into_iter().find(|size| !(*size > 0.0)) {
        Some(value) => Err(GeometryError::NotPositive { what, value }),
        None => Ok(()),
    }
}

/// Two unit vectors that span the plane of a rectangle; its front faces the normal, its width stays level.
fn edges(normal: [f64; 3]) -> Result<[Vec3; 2], GeometryError> {
    let what = "the normal";
    let normal = DVec3::from_array(normal);
    if !normal.is_finite() {
        return Err(GeometryError::NotFinite { what });
    }
    let normal = normal.try_normalize().ok_or(GeometryError::NotPositive { what, value: 0.0 })?;
    let level = DVec3::Z.cross(normal);
    let u = if level.length() > 1e-9 { level.normalize() } else { DVec3::X };
    Ok([u.as_vec3(), normal.cross(u).as_vec3()])
}

fn affine(transform: &describe::Transform) -> Affine3A {
    let scale = transform.scale.as_ref().map_or([1.0; 3], |scale| scale.get_ref().0);
    let [x, y, z] = transform.rotate.unwrap_or_default().map(|degrees| degrees.to_radians() as f32);
    // Extrinsic rotations about the fixed axes x, then y, then z.
    let rotation = Quat::from_euler(EulerRot::ZYX, z, y, x);
    Affine3A::from_scale_rotation_translation(vector(scale), rotation, vector(transform.translate.unwrap_or_default()))
}

fn half_space(&[x, y, z, offset]: &[f64; 4]) -> Plane {
    Plane::new(DVec3::new(x, y, z), offset)
}

fn brilliant(cut: &describe::Brilliant) -> Brilliant {
    let usual = Brilliant::default();
    Brilliant {
        diameter: cut.diameter,
        table: cut.table.unwrap_or(usual.table),
        crown_angle: cut.crown_angle.unwrap_or(usual.crown_angle),
        pavilion_angle: cut.pavilion_angle.unwrap_or(usual.pavilion_angle),
        girdle: cut.girdle.unwrap_or(usual.girdle),
        star_length: cut.star_length.unwrap_or(usual.star_length),
        lower_half_length: cut.lower_half_length.unwrap_or(usual.lower_half_length),
        culet: cut.culet.unwrap_or(usual.culet),
        girdle_facets: cut.girdle_facets.unwrap_or(usual.girdle_facets),
    }
}

fn step_cut(cut: &describe::StepCut) -> StepCut {
    let usual = StepCut::default();
    StepCut {
        width: cut.width,
        length_ratio: cut.length / cut.width,
        corner: cut.corner.unwrap_or(usual.corner),
        table: cut.table.unwrap_or(usual.table),
        crown_angles: cut.crown_angles.unwrap_or(usual.crown_angles),
        pavilion_angles: cut.pavilion_angles.unwrap_or(usual.pavilion_angles),
        girdle: cut.girdle.unwrap_or(usual.girdle),
    }
}
