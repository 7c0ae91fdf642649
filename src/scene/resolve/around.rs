//! What the camera's rays begin in: the same for all of them, or for each what is at its origin.

use super::Resolver;
use super::view::View;
use crate::geometry::{Rectangle, Shape, ShapeId, World};
use crate::scene::{Around, Filling, Object, SceneError, listed};

impl Resolver<'_> {
    /// The clear solids that rays begin in, from one point or from all over their `origins`. A
    /// camera that stands inside something opaque is an error; where only a part of its rays begins
    /// there, that part is black.
    pub fn around_camera(
        &mut self,
        view: &View,
        origins: Option<Rectangle>,
        world: &World,
        objects: &[Object],
    ) -> Result<Around, SceneError> {
        let origins = origins.map(Shape::from);
        let reaches =
            |of: fn(&Shape, &Shape) -> bool, shape| origins.as_ref().is_some_and(|origins| of(shape, origins));
        let (mut around, mut dark) = (Around::default(), Vec::new());
        for (id, (shape, object)) in (0..).map(ShapeId).zip(world.shapes().iter().zip(objects)) {
            let filling = self.interface(object).map(|i| Filling { rank: object.rank, medium: i.medium });
            match (filling, shape) {
                (Some(filling), _) if reaches(Shape::may_touch, shape) => around.some.push((id, filling)),
                (Some(filling), _) if shape.contains(view.position) => around.all.push(filling),
                // A closed mesh may be a room.
                (Some(_), _) | (None, Shape::Mesh(_)) => {}
                (None, _) if shape.contains(view.position) => return Err(self.inside(view, object)),
                (None, _) if reaches(Shape::may_touch_inside, shape) => dark.push(object.name.as_str()),
                (None, _) => {}
            }
        }
        if !dark.is_empty() {
            let names = listed(&dark);
            self.warnings.push(format!("a part of the camera's rays begins inside {names}: it is black there"));
        }
        Ok(around)
    }

    fn inside(&self, view: &View, object: &Object) -> SceneError {
        let message = format!("the camera stands inside `{}`, which lets no light through", object.name);
        self.text.error(&view.position_at, message).help("move it out of the object")
    }
}
