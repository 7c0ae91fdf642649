//! A tree of boxes, eight to a node.
//!
//! obvhs builds a binary tree very well and we collapse it to eight boxes a node, tested together and visited near first.
//! Its own traversals are not used: the binary one has no margin for rounding in its box test, the wide one an absolute
//! epsilon. Here boxes are padded, the far distance is widened by 4 ε (T. Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013)
//! and the error of the ray's origin widens every box, so nothing that its shape would report is missed.
//!
//! The tree knows only boxes and numbers. What a number means, a shape or a block of triangles, its user decides.

use std::time::Duration;

use glam::{Vec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;

use super::Bounds;

const WIDTH: usize = 8;

/// The item of an unused slot, whose empty box is never met.
const NO_ITEM: u32 = u32::MAX;

/// Eight boxes: `planes[axis][0]` their minima, `planes[axis][1]` their maxima. Unused slots hold empty boxes.
#[derive(Clone, Debug)]
struct Node {
    planes: [[[f32; WIDTH]; 2]; 3],
    children: [Child; WIDTH],
}

/// An inner node if `count` is 0, else `count` items from `first` on in the tree's order.
#[derive(Clone, Copy, Debug)]
struct Child {
    first: u32,
    count: u32,
}

#[derive(Clone, Debug)]
pub(super) struct Tree {
    nodes: Vec<Node>,
    /// The items of all leaves, a leaf's side by side.
    order: Vec<u32>,
    /// Entries the traversal may have to remember.
    stack: usize,
}

/// What box tests want to know of a ray, worked out once.
pub(super) struct BoxRay {
    /// Per axis: 1 if the ray goes towards smaller coordinates, whose near planes are the maxima.
    negative: [usize; 3],
    inverse: [f32; 3],
    /// Origins shifted by the origin's error: against the near planes, and against the far ones.
    near_origin: [f32; 3],
    far_origin: [f32; 3],
}

impl BoxRay {
    pub fn new(origin: Vec3, direction: Vec3, error: f32) -> Self {
        let (o, d) = (origin.to_array(), direction.to_array());
        let negative = d.map(|x| x.is_sign_negative() as usize);
        let shift = |axis: usize, amount: f32| if negative[axis] == 1 { o[axis] - amount } else { o[axis] + amount };
        Self {
            negative,
            inverse: d.map(|x| 1.0 / x),
            near_origin: [0, 1, 2].map(|axis| shift(axis, error)),
            far_origin: [0, 1, 2].map(|axis| shift(axis, -error)),
        }
    }
}

/// A node or leaf to be visited, and where the ray enters its box.
#[derive(Clone, Copy, Debug)]
struct Entry {
    near: f32,
    child: Child,
}

const NOTHING: Entry = Entry { near: 0.0, child: Child { first: 0, count: 0 } };

struct Item(Aabb);

impl obvhs::Boundable for Item {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

impl Tree {
    /// A tree over boxes; items are their indices. One item a leaf: testing a shape costs more than testing its box.
    pub fn new(boxes: &[Bounds]) -> Self {
        let padded: Vec<Bounds> = boxes.iter().map(Bounds::padded).collect();
        if padded.len() <= WIDTH {
            return Self::single(&padded);
        }
        Self::build(&padded, 1)
    }

    /// A tree over boxes whose leaves hold up to `size` of them. Items are leaves; `group` is told the boxes of each in
    /// the order of their numbers.
    pub fn grouped(boxes: &[Bounds], size: u32, mut group: impl FnMut(&[u32])) -> Self {
        let padded: Vec<Bounds> = boxes.iter().map(Bounds::padded).collect();
        let mut tree = Self::build(&padded, size);
        let mut leaves = 0;
        for child in tree.nodes.iter_mut().flat_map(|node| &mut node.children).filter(|child| child.count > 0) {
            if child.first == NO_ITEM {
                continue;
            }
            let first = child.first as usize;
            group(&tree.order[first..first + child.count as usize]);
            *child = Child { first: leaves, count: 1 };
            leaves += 1;
        }
        tree.order = (0..leaves).collect();
        tree
    }

    fn build(padded: &[Bounds], leaf: u32) -> Self {
        let items: Vec<Item> = padded.iter().map(|b| Item(Aabb::new(Vec3A::from(b.min), Vec3A::from(b.max)))).collect();
        let params = BvhBuildParams {
            pre_split: false,
            max_prims_per_leaf: leaf,
            // A block costs the same however full it is: the fewer the better, and no slower than obvhs's own 3.
            collapse_traversal_cost: 10.0,
            ..if items.len() < 10_000 { BvhBuildParams::very_slow_build() } else { BvhBuildParams::medium_build() }
        };
        let binary = build_bvh2(&items, params, &mut Duration::default());
        let mut tree = Self { nodes: Vec::new(), order: binary.primitive_indices.clone(), stack: 0 };
        let depth = tree.collapse(&binary);
        tree.stack = depth * (WIDTH - 1) + 1;
        tree
    }

    fn single(boxes: &[Bounds]) -> Self {
        let mut node = Node::empty();
        for (slot, b) in boxes.iter().enumerate() {
            node.set(slot, b.min, b.max, Child { first: slot as u32, count: 1 });
        }
        Self { nodes: vec![node], order: (0..boxes.len() as u32).collect(), stack: WIDTH }
    }

    /// The items whose boxes meet a box.
    pub fn near(&self, bounds: &Bounds) -> Vec<u32> {
        let (mut found, mut work) = (Vec::new(), vec![0]);
        while let Some(node) = work.pop() {
            let Node { planes, children } = &self.nodes[node];
            for (slot, child) in children.iter().enumerate() {
                let corner = |end: usize| Vec3::new(planes[0][end][slot], planes[1][end][slot], planes[2][end][slot]);
                if child.first == NO_ITEM || !bounds.meets(&Bounds { min: corner(0), max: corner(1) }) {
                    continue;
                }
                let first = child.first as usize;
                match child.count {
                    0 => work.push(first),
                    count => found.extend(&self.order[first..first + count as usize]),
                }
            }
        }
        found
    }

    /// Nodes of eight from nodes of two: the child with the largest surface is opened until there are eight. Returns the
    /// depth. Not recursive, since a tree over odd boxes may be deep.
    fn collapse(&mut self, binary: &Bvh2) -> usize {
        self.nodes.push(Node::empty());
        let mut work = vec![(0usize, 0usize, 1usize)];
        let mut depth = 1;
        while let Some((source, target, level)) = work.pop() {
            depth = depth.max(level);
            let mut open = vec![source];
            while open.len() < WIDTH {
                let inner = open.iter().enumerate().filter(|(_, n)| !binary.nodes[**n].is_leaf());
                let widest = inner.max_by(|a, b| {
                    let area = |n: usize| binary.nodes[n].aabb().half_area();
                    area(*a.1).total_cmp(&area(*b.1))
                });
                let Some((slot, &node)) = widest else { break };
                let first = binary.nodes[node].first_index as usize;
                open[slot] = first;
                open.push(first + 1);
            }
            for (slot, &n) in open.iter().enumerate() {
                let node = &binary.nodes[n];
                let child = if node.is_leaf() {
                    Child { first: node.first_index, count: node.prim_count }
                } else {
                    self.nodes.push(Node::empty());
                    work.push((n, self.nodes.len() - 1, level + 1));
                    Child { first: self.nodes.len() as u32 - 1, count: 0 }
                };
                self.nodes[target].set(slot, node.aabb().min.into(), node.aabb().max.into(), child);
            }
        }
        depth
    }

    /// Shows `visit` the items whose boxes the ray meets within `t_max`, roughly near first. `visit` returns the new
    /// `t_max`; a negative one ends it.
    #[inline]
    pub fn visit(&self, ray: &BoxRay, t_max: f32, visit: impl FnMut(u32, f32) -> f32) {
        // Clearing the stack costs as much as a node for every hundred entries.
        const FEW: usize = 16;
        const USUAL: usize = 128;
        if self.stack <= FEW {
            self.walk(ray, t_max, &mut [NOTHING; FEW], visit);
        } else if self.stack <= USUAL {
            self.walk(ray, t_max, &mut [NOTHING; USUAL], visit);
        } else {
            self.walk(ray, t_max, &mut vec![NOTHING; self.stack], visit);
        }
    }

    #[inline]
    fn walk(&self, ray: &BoxRay, mut t_max: f32, stack: &mut [Entry], mut visit: impl FnMut(u32, f32) -> f32) {
        let mut size = 1;
        stack[0] = NOTHING;
        while size > 0 {
            size -= 1;
            let Entry { near, child } = stack[size];
            if !(near <= t_max) {
                continue;
            }
            if child.count > 0 {
                let first = child.first as usize;
                for &item in self.order.get(first..first + child.count as usize).unwrap_or(&[]) {
                    t_max = visit(item, t_max);
                    if t_max < 0.0 {
                        return;
                    }
                }
                continue;
            }
            let node = &self.nodes[child.first as usize];
            let (nears, hits) = node.meet(ray, t_max);
            // Far first onto the stack, by insertion: few of the eight are hit.
            let base = size;
            let mut rest = hits;
            while rest != 0 {
                let slot = rest.trailing_zeros() as usize;
                rest &= rest - 1;
                let entry = Entry { near: nears[slot], child: node.children[slot] };
                let mut place = size;
                while place > base && stack[place - 1].near < entry.near {
                    stack[place] = stack[place - 1];
                    place -= 1;
                }
                stack[place] = entry;
                size += 1;
            }
        }
    }
}

impl Node {
    fn empty() -> Self {
        Self {
            planes: [[[f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]]; 3],
            children: [Child { first: NO_ITEM, count: 1 }; WIDTH],
        }
    }

    fn set(&mut self, slot: usize, min: Vec3, max: Vec3, child: Child) {
        for axis in 0..3 {
            self.planes[axis][0][slot] = min[axis];
            self.planes[axis][1][slot] = max[axis];
        }
        self.children[slot] = child;
    }

    /// Where the ray enters each box, and a bit for each box it meets.
    ///
    /// A ray within a box's plane gives 0·∞ = NaN there; the comparisons are such that NaN says nothing.
    #[inline]
    fn meet(&self, ray: &BoxRay, t_max: f32) -> ([f32; WIDTH], u32) {
        let mut near = [0.0f32; WIDTH];
        let mut far = [t_max; WIDTH];
        for axis in 0..3 {
            let sign = ray.negative[axis];
            let (near_planes, far_planes) = (&self.planes[axis][sign], &self.planes[axis][1 - sign]);
            for k in 0..WIDTH {
                let t0 = (near_planes[k] - ray.near_origin[axis]) * ray.inverse[axis];
                let t1 = (far_planes[k] - ray.far_origin[axis]) * ray.inverse[axis] * (1.0 + 4.0 * f32::EPSILON);
                near[k] = if t0 > near[k] { t0 } else { near[k] };
                far[k] = if t1 < far[k] { t1 } else { far[k] };
            }
        }
        let mut hits = 0;
        for k in 0..WIDTH {
            hits |= ((near[k] <= far[k]) as u32) << k;
        }
        (near, hits)
    }
}
