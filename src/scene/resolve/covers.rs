//! Opaque objects that lie on faces of clear solids.

use super::Resolver;
use crate::geometry::{ShapeId, World};
use crate::scene::Object;
use std::collections::BTreeMap;

impl Resolver<'_> {
    /// Finds them for each clear solid, marks both, and warns: a face that is covered is none, and
    /// some who set a glass on a table mean air between.
    pub fn covers(&mut self, world: &World, objects: &mut [Object]) -> BTreeMap<ShapeId, Vec<ShapeId>> {
        let mut covers = BTreeMap::new();
        let is_clear = |id: ShapeId| self.interface(&objects[id.0 as usize]).is_some();
        for id in (0..objects.len() as u32).map(ShapeId).filter(|&id| is_clear(id)) {
            let lying = world.sharing_a_face(id, |other| !is_clear(other));
            if !lying.is_empty() {
                covers.insert(id, lying);
            }
        }
        let told = covers.iter().flat_map(|(solid, lying)| lying.iter().map(|other| warning(objects, *solid, *other)));
        self.warn_of_pairs(told.collect(), "objects lie on clear faces");
        for id in covers.iter().flat_map(|(solid, lying)| lying.iter().chain([solid])) {
            objects[id.0 as usize].covers = true;
        }
        covers
    }
}

fn warning(objects: &[Object], solid: ShapeId, lying: ShapeId) -> String {
    let [solid, lying] = [solid, lying].map(|id| &objects[id.0 as usize].name);
    format!(
        "`{lying}` lies on a face of `{solid}`, without air between: seen from outside as in front of it, from within as in it; a gap of 1e-5 of their size makes air"
    )
}
