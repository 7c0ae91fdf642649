//! Which object a pixel shows, and how far away it is: one ray through the middle of the pixel and of the lens.
//!
//! Numbers of objects and distances must not be mixed: half of object 3 and half of object 5 is not object 4. So these are not
//! means over samples but what is seen at one point, without filter or depth of field, and the same for every seed.

use crate::film::Window;
use crate::scene::Scene;
use rayon::prelude::*;

/// What a pixel's middle shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstHit {
    /// Scene units in front of the camera, along its direction of view.
    pub depth: f32,
    /// Index into the scene's objects.
    pub object: u32,
}

/// By pixel, row by row from the top; `None` where there is nothing.
pub fn first_hits(scene: &Scene, window: Window) -> Vec<Option<FirstHit>> {
    let rows = window.y0..window.y0 + window.height;
    let columns = window.x0..window.x0 + window.width;
    rows.into_par_iter().flat_map_iter(|y| columns.clone().map(move |x| first_hit(scene, x, y))).collect()
}

fn first_hit(scene: &Scene, x: u32, y: u32) -> Option<FirstHit> {
    let ray = scene.camera.principal_ray(x as f32 + 0.5, y as f32 + 0.5);
    let hit = scene.closest(&ray)?;
    Some(FirstHit { depth: scene.camera.depth(hit.point), object: hit.shape.0 })
}
