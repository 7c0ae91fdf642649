//! The tree of nodes: what stands where.

use glam::{DAffine3, DMat3, DQuat, DVec3};

use super::super::error::Fault;
use super::super::gather::in_range;
use super::super::{FileCamera, Projection};
use super::accessor::Accessors;
use super::json::{Camera, InstanceAttributes, Node, Root};

/// From y upwards to z upwards: (x, y, z) becomes (x, −z, y).
pub const Z_UP: DMat3 = DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y);

/// How far the last row of a matrix may be from [0, 0, 0, 1].
const ROUNDING: f64 = 1e-5;

/// A node with its place in the world.
pub(super) struct Placed<'a> {
    pub node: &'a Node,
    index: usize,
    /// In the axes of the file.
    global: DAffine3,
}

/// All nodes of the scene that is shown, parents first, children in their order.
pub(super) fn walk(root: &Root) -> Result<Vec<Placed<'_>>, Fault> {
    let mut waiting: Vec<(usize, DAffine3)> = roots(root)?.into_iter().map(|node| (node, DAffine3::IDENTITY)).collect();
    waiting.reverse();
    let mut seen = vec![false; root.nodes.len()];
    let mut placed = Vec::new();
    while let Some((index, parent)) = waiting.pop() {
        let (Some(node), Some(seen)) = (root.nodes.get(index), seen.get_mut(index)) else {
            return Err(Fault::new(format!("there is no node {index}")));
        };
        if std::mem::replace(seen, true) {
            return Err(Fault::new(format!("node {index} hangs in the scene twice: nodes must be a tree")));
        }
        let fault = |message| Fault::new(format!("node {index}: {message}"));
        let global = parent * local(node).map_err(fault)?;
        let DMat3 { x_axis, y_axis, z_axis } = global.matrix3;
        for column in [x_axis, y_axis, z_axis, global.translation] {
            in_range("a number of its transform", column).map_err(fault)?;
        }
        if !global.is_finite() {
            return Err(fault("its transform is not finite".to_owned()));
        }
        waiting.extend(node.children.iter().rev().map(|&child| (child, global)));
        placed.push(Placed { node, index, global });
    }
    Ok(placed)
}

fn roots(root: &Root) -> Result<Vec<usize>, Fault> {
    if root.scenes.is_empty() {
        let mut is_child = vec![false; root.nodes.len()];
        for &child in root.nodes.iter().flat_map(|node| &node.children) {
            if let Some(is_child) = is_child.get_mut(child) {
                *is_child = true;
            }
        }
        return Ok(is_child.iter().enumerate().filter(|(_, is_child)| !**is_child).map(|(index, _)| index).collect());
    }
    let index = root.scene.unwrap_or(0);
    let scene = root.scenes.get(index).ok_or_else(|| Fault::new(format!("there is no scene {index}")))?;
    Ok(scene.nodes.clone())
}

fn local(node: &Node) -> Result<DAffine3, String> {
    if let Some(matrix) = node.matrix {
        let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = matrix;
        // Products of matrices leave roundings.
        if !([d, h, l, p - 1.0].iter().all(|rest| rest.abs() <= ROUNDING)) {
            return Err(format!("the last row of its matrix is {:?}, expected [0, 0, 0, 1]", [d, h, l, p]));
        }
        let matrix3 = DMat3::from_cols(DVec3::new(a, b, c), DVec3::new(e, f, g), DVec3::new(i, j, k));
        return Ok(DAffine3 { matrix3, translation: DVec3::new(m, n, o) });
    }
    let identity = [0.0, 0.0, 0.0, 1.0];
    moved(node.translation.unwrap_or([0.0; 3]), node.rotation.unwrap_or(identity), node.scale.unwrap_or([1.0; 3]))
}

/// Scaled, then turned by a quaternion, then moved.
pub(super) fn moved(translation: [f64; 3], rotation: [f64; 4], scale: [f64; 3]) -> Result<DAffine3, String> {
    let rotation = DQuat::from_array(rotation);
    // Files round; a unit quaternion is meant.
    let length = rotation.length();
    if !(length > 0.0 && length.is_finite()) {
        return Err(format!("its rotation {:?} is no quaternion of length 1", rotation.to_array()));
    }
    let matrix3 = DMat3::from_quat(rotation * (1.0 / length)) * DMat3::from_diagonal(DVec3::from_array(scale));
    Ok(DAffine3 { matrix3, translation: DVec3::from_array(translation) })
}

impl Placed<'_> {
    pub fn name(&self) -> String {
        self.node.name.clone().unwrap_or_else(|| format!("node {}", self.index))
    }

    pub fn transform(&self) -> DAffine3 {
        turned(self.global)
    }

    /// Where the mesh of the node stands: once, or at each of its instances.
    pub fn places(&self, accessors: &Accessors) -> Result<Vec<DAffine3>, Fault> {
        let Some(instancing) = &self.node.extensions.instancing else { return Ok(vec![self.transform()]) };
        let InstanceAttributes { translation, rotation, scale } = instancing.attributes;
        let Some(some) = translation.or(rotation).or(scale) else { return Ok(vec![self.transform()]) };
        let count = accessors.count(some)?;
        let translations = values(accessors, translation, count)?;
        let rotations = values(accessors, rotation, count)?;
        let scales = values(accessors, scale, count)?;
        let place = |index: usize| {
            let at = |values: &[[f64; 3]], usual| values.get(index).copied().unwrap_or(usual);
            let rotation = rotations.get(index).copied().unwrap_or([0.0, 0.0, 0.0, 1.0]);
            let local = moved(at(&translations, [0.0; 3]), rotation, at(&scales, [1.0; 3]));
            let global = self.global * local.map_err(|message| Fault::new(format!("instance {index}: {message}")))?;
            in_range("a number of its transform", global.translation).map_err(Fault::new)?;
            match global.is_finite() {
                true => Ok(turned(global)),
                false => Err(Fault::new(format!("instance {index}: its transform is not finite"))),
            }
        };
        (0..count).map(place).collect()
    }

    /// A camera looks along −z of its node, y is up; scale does not matter. `None` if the transform leaves no
    /// direction.
    pub fn camera(&self, index: usize, root: &Root) -> Result<Option<FileCamera>, Fault> {
        let camera = root.cameras.get(index).ok_or_else(|| Fault::new(format!("there is no camera {index}")))?;
        let name = camera.name.clone().or_else(|| self.node.name.clone()).unwrap_or_else(|| format!("camera {index}"));
        let projection = projection(camera).map_err(|message| Fault::new(format!("camera `{name}`: {message}")))?;
        let DAffine3 { matrix3, translation: position } = self.transform();
        let direction = (-matrix3.z_axis).try_normalize();
        let up = direction.and_then(|direction| matrix3.y_axis.reject_from_normalized(direction).try_normalize());
        let node = self.node.name.clone();
        Ok(direction.zip(up).map(|(direction, up)| FileCamera { name, node, position, direction, up, projection }))
    }
}

/// From the axes of the file to ours.
fn turned(global: DAffine3) -> DAffine3 {
    DAffine3 { matrix3: Z_UP * global.matrix3, translation: Z_UP * global.translation }
}

/// An attribute of instances, one value each; none where they do not have it.
fn values<const N: usize>(
    accessors: &Accessors,
    accessor: Option<usize>,
    count: usize,
) -> Result<Vec<[f64; N]>, Fault> {
    let Some(accessor) = accessor else { return Ok(Vec::new()) };
    let found = accessors.count(accessor)?;
    if found != count {
        return Err(Fault::new(format!("accessor {accessor} has {found} elements for {count} instances")));
    }
    accessors.vectors(accessor, 0..count)
}

fn projection(camera: &Camera) -> Result<Projection, String> {
    if let Some(perspective) = &camera.perspective {
        let aspect_ratio = perspective.aspect_ratio;
        if !(perspective.yfov > 0.0 && perspective.yfov < std::f64::consts::PI) {
            return Err(format!("yfov is {}, expected an angle between 0 and π", perspective.yfov));
        }
        if let Some(ratio) = aspect_ratio.filter(|ratio| !(*ratio > 0.0)) {
            return Err(format!("aspectRatio is {ratio}, it must be above zero"));
        }
        return Ok(Projection::Perspective { vertical_fov_degrees: perspective.yfov.to_degrees(), aspect_ratio });
    }
    let Some(orthographic) = &camera.orthographic else {
        return Err("it has neither `perspective` nor `orthographic`".to_owned());
    };
    let (width, height) = (2.0 * orthographic.xmag.abs(), 2.0 * orthographic.ymag.abs());
    if !(width > 0.0 && height > 0.0) {
        return Err("xmag and ymag must not be zero".to_owned());
    }
    Ok(Projection::Orthographic { width, height })
}
