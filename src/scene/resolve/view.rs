//! Where the camera stands and looks: by the scene, or by a camera of a mesh file.

use super::place::place;
use super::{Resolver, vector};
use crate::geometry::loaders::{FileCamera, Projection};
use crate::scene::SceneError;
use crate::scene::describe::{self, Vector};
use glam::{DVec3, Vec3};
use std::ops::Range;
use toml::Spanned;

/// Up in the picture unless the scene says otherwise.
const UP: Vec3 = Vec3::Z;

/// A place and a direction of view.
pub struct View {
    pub position: Vec3,
    pub look_at: Vec3,
    pub up: Vec3,
    /// What the file's camera sees.
    pub projection: Option<Projection>,
    /// Where the scene says the position, for errors, and what is looked at.
    pub position_at: Range<usize>,
    pub look_at_at: Range<usize>,
}

impl Resolver<'_> {
    pub fn view(&mut self, described: &Spanned<describe::Camera>) -> Result<View, SceneError> {
        let camera = described.get_ref();
        let from_file = camera.file.as_ref().map(|file| self.file_camera(file, camera.named.as_ref())).transpose()?;
        if let (None, Some(named)) = (&from_file, &camera.named) {
            return Err(self.text.error(&named.span(), "`named` goes with `file`: it names one of the file's cameras"));
        }
        let span = |own: &Option<Vector>| own.as_ref().map_or(described.span(), Spanned::span);
        let given = |own: &Option<Vector>| own.as_ref().map(|at| place(at.get_ref().values(), self.origin));
        let own = |value: Option<Vec3>, name: &str| {
            value.ok_or_else(|| {
                let error = self.text.error(&described.span(), format!("missing `{name}`"));
                error.help("say where the camera stands and looks, or name a glTF `file` with a camera")
            })
        };
        let filed = |of: fn(&FileCamera) -> DVec3| from_file.as_ref().map(|camera| of(camera).as_vec3());
        let filed_position = from_file.as_ref().map(|camera| place(camera.position.to_array(), self.origin));
        let position = own(given(&camera.position).or(filed_position), "position")?;
        let ahead = filed(|camera| camera.direction).map(|direction| position + direction * depth(position));
        Ok(View {
            position,
            look_at: own(given(&camera.look_at).or(ahead), "look_at")?,
            up: camera.up.as_ref().map(|up| vector(up.get_ref().values())).or(filed(|camera| camera.up)).unwrap_or(UP),
            projection: from_file.as_ref().map(|camera| camera.projection),
            position_at: span(&camera.position),
            look_at_at: span(&camera.look_at),
        })
    }

    fn file_camera(
        &mut self,
        file: &Spanned<String>,
        named: Option<&Spanned<String>>,
    ) -> Result<FileCamera, SceneError> {
        let loaded = self.loaded(file, None)?;
        let cameras: Vec<FileCamera> = loaded.cameras(self.file_unit(&loaded)).collect();
        let names = || cameras.iter().map(|camera| camera.name.as_str());
        let found = match named {
            None => cameras.first(),
            Some(named) => {
                let is = |name: Option<&String>| name == Some(named.get_ref());
                let by_node = || cameras.iter().find(|camera| is(camera.node.as_ref()));
                cameras.iter().find(|camera| is(Some(&camera.name))).or_else(by_node)
            }
        };
        found.cloned().ok_or_else(|| match named {
            None => self.text.error(&file.span(), "this file has no camera"),
            Some(named) => self.not_in_file("camera", named, &names().collect::<Vec<_>>()),
        })
    }
}

/// How far ahead a point to look at is put, so that single precision keeps the direction.
fn depth(position: Vec3) -> f32 {
    position.abs().max_element().max(1.0)
}
