//! How a tree comes about: obvhs builds one of two, whose nodes look for better places ([`super::reinsert`]), and they are gathered to nodes
//! of eight.
//!
//! Which of the many ways to gather is best, the least sum of areas tells (H. Ylitie, T. Karras, S. Laine, "Efficient Incoherent Ray
//! Traversal on GPUs Through Compressed Wide BVHs", HPG 2017, section 3.1), all leaves being given. Against opening the widest child
//! until there are eight it saves 1–3 % of a ray's time.
//!
//! obvhs is given nodes made in place rather than boxes to make nodes of, and nodes of 32 bytes: building a mesh takes 166 bytes for each
//! triangle at most (the process whole), where `build_bvh2` with boxes of ours and of its own took 310.

use std::mem;

use glam::{Vec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::leaf_collapser::collapse;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::ploc::{PlocBuilder, SortPrecision};
use rayon::prelude::*;

use super::reinsert::reinsert;
use super::{ITEM, Node, Tree, WIDTH, leaves};
use crate::geometry::Bounds;

/// Neighbours along Morton's curve, each way, among which a node looks for its best mate.
const MATES: usize = 14;

/// Boxes gathered in leaves.
pub(in crate::geometry) struct Groups {
    /// The numbers of all boxes, a leaf's side by side.
    order: Vec<u32>,
    /// Where each leaf begins in `order`, and how many boxes it has.
    leaves: Vec<[u32; 2]>,
}

impl Groups {
    pub fn len(&self) -> usize {
        self.leaves.len()
    }

    /// The boxes of a leaf.
    pub fn get(&self, leaf: usize) -> &[u32] {
        let [first, count] = self.leaves[leaf].map(|x| x as usize);
        &self.order[first..first + count]
    }
}

/// Of all nodes of two, how many are tried elsewhere at first; later rounds try fewer. The more, the better the tree and the longer its
/// build. On a ball of 1.03 M triangles camera rays had 0.79, 0.83 and 0.82 of Embree's speed with 0.05, 0.3 and 1.0, diffuse ones
/// 0.84, 0.85 and 0.90 (of an earlier kernel). The time for it is in proportion; meshes above 3 M get less, as their builds are what one
/// waits for.
fn effort(count: usize) -> f32 {
    match count {
        0..50_000 => 1.0,
        50_000..3_000_000 => 0.3,
        _ => 0.05,
    }
}

/// Boxes whose areas together are this many times that around all of them lie upon each other, and the search for a better place of each
/// would go through all others. Surfaces have 1 … 10.
const CROWDED: f32 = 1000.0;

/// A tree over `count` boxes, up to `size` in a leaf, those that `fit`; items are the numbers of leaves.
pub(super) fn build(
    count: usize,
    size: u32,
    bounds: impl Fn(usize) -> Bounds + Sync,
    fits: impl Fn(&[u32]) -> bool + Sync,
) -> (Tree, Groups) {
    let mut binary = binary(count, size, &bounds, fits);
    let mut groups = Groups { order: mem::take(&mut binary.primitive_indices), leaves: Vec::new() };
    let order = fit(&mut binary, &groups.order, &bounds);
    let nodes = gather(&binary, &Plan::new(&binary, &order), &mut groups.leaves);
    (Tree { nodes }, groups)
}

fn binary(
    count: usize,
    size: u32,
    bounds: &(impl Fn(usize) -> Bounds + Sync),
    fits: impl Fn(&[u32]) -> bool + Sync,
) -> Bvh2 {
    let whole = (0..count).into_par_iter().map(bounds).reduce(|| Bounds::EMPTY, |a, b| a.union(&b));
    let mut builder = PlocBuilder::new();
    builder.current_nodes = (0..count).into_par_iter().map(|i| leaf(&bounds(i), &whole, i)).collect();
    let around = |a: Aabb, b: Aabb| a.union(&b);
    let unit = builder.current_nodes.par_iter().map(|node| *node.aabb()).reduce(Aabb::empty, around);
    let areas: f32 = builder.current_nodes.iter().map(|node| node.aabb().half_area()).sum();
    let reinsertions = if areas > CROWDED * unit.half_area() { 0.0 } else { effort(count) };
    let mut tree = Bvh2::zeroed(count);
    tree.primitive_indices = (0..count as u32).collect();
    builder.build_ploc_from_leaves::<MATES, false>(&mut tree, unit, SortPrecision::U64, 3);
    drop(builder);
    reinsert(&mut tree, reinsertions);
    // A block costs the same however full it is: the fewer the better, and no slower than obvhs's own 3.
    collapse(&mut tree, size, 10.0);
    leaves::split(&mut tree, fits, |item| *leaf(&bounds(item as usize), &whole, item as usize).aabb());
    reinsert(&mut tree, 2.0 * reinsertions);
    tree
}

/// A leaf for obvhs: its box in a whole of size 1, lest areas underflow, and wider by chance, by at most 1/4096 of itself and a millionth
/// of the whole. Without the chance boxes that are equal all choose the same mate, one pair joins in each round, and 200,000
/// triangles on one place took hours.
fn leaf(bounds: &Bounds, whole: &Bounds, number: usize) -> Bvh2Node {
    const OWN: f32 = 1.0 / 4096.0;
    const WHOLE: f32 = 1e-6;
    let extent = whole.size().max_element();
    let scale = if extent > 0.0 { 1.0 / extent } else { 1.0 };
    let (min, max) = if bounds.is_empty() { (whole.min, whole.min) } else { (bounds.min, bounds.max) };
    let [min, max] = [min, max].map(|corner| (corner - whole.min) * scale);
    let mut chance = number as u64 ^ 0x9e37_79b9_7f4a_7c15;
    let mut wider = || {
        chance = (chance ^ (chance >> 31)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let parts = Vec3::new((chance >> 22 & 1023) as f32, (chance >> 32 & 1023) as f32, (chance >> 42 & 1023) as f32);
        ((max - min) * OWN + WHOLE) * parts / 1023.0
    };
    let (below, above) = (wider(), wider());
    Bvh2Node::new(Aabb::new(Vec3A::from(min - below), Vec3A::from(max + above)), 1, number as u32)
}

/// Gives all nodes the boxes that hold what is in them. Returns the nodes, children after their parents.
fn fit(binary: &mut Bvh2, items: &[u32], bounds: &(impl Fn(usize) -> Bounds + Sync)) -> Vec<u32> {
    binary.nodes.par_iter_mut().filter(|node| node.is_leaf()).for_each(|node| {
        let first = node.first_index as usize;
        let items = &items[first..first + node.prim_count as usize];
        let around = items.iter().map(|&i| bounds(i as usize).padded()).fold(Bounds::EMPTY, |a, b| a.union(&b));
        (node.min, node.max) = (around.min, around.max);
    });
    let mut order = Vec::with_capacity(binary.nodes.len());
    order.push(0u32);
    let mut next = 0;
    while let Some(&at) = order.get(next) {
        next += 1;
        let node = &binary.nodes[at as usize];
        if !node.is_leaf() {
            order.extend([node.first_index, node.first_index + 1]);
        }
    }
    for &at in order.iter().rev() {
        let first = binary.nodes[at as usize].first_index as usize;
        if !binary.nodes[at as usize].is_leaf() {
            let (a, b) = (binary.nodes[first], binary.nodes[first + 1]);
            let node = &mut binary.nodes[at as usize];
            (node.min, node.max) = (a.min.min(b.min), a.max.max(b.max));
        }
    }
    order
}

/// Nodes of eight from nodes of two, with what their leaves hold. Not recursive, since a tree over odd boxes may be deep.
fn gather(binary: &Bvh2, plan: &Plan, leaves: &mut Vec<[u32; 2]>) -> Vec<Node> {
    let mut nodes = vec![Node::empty()];
    let mut work = vec![(0, 0)];
    let mut children = Vec::with_capacity(WIDTH);
    while let Some((source, target)) = work.pop() {
        children.clear();
        plan.children(binary, source, &mut children);
        for (slot, &n) in children.iter().enumerate() {
            let node = &binary.nodes[n];
            let child = if node.is_leaf() {
                leaves.push([node.first_index, node.prim_count]);
                (leaves.len() - 1) as u32 | ITEM
            } else {
                nodes.push(Node::empty());
                work.push((n, nodes.len() - 1));
                (nodes.len() - 1) as u32
            };
            nodes[target].set(slot, node.min, node.max, child);
        }
    }
    nodes.shrink_to_fit();
    nodes
}

struct Plan {
    choices: Vec<Choice>,
}

/// What is best for a node of the binary tree that has room for 1, 2 … 8 boxes in its place.
#[derive(Clone, Copy, Default)]
struct Choice {
    /// Least sums of areas for 1 … 7.
    cost: [f32; WIDTH - 1],
    /// How many of the boxes go to the first child; 0 if one box fewer is as good.
    first: [u8; WIDTH],
}

impl Plan {
    fn new(binary: &Bvh2, order: &[u32]) -> Self {
        let mut choices = vec![Choice::default(); binary.nodes.len()];
        for &at in order.iter().rev() {
            let node = &binary.nodes[at as usize];
            if !node.is_leaf() {
                let first = node.first_index as usize;
                choices[at as usize] = Choice::of(area(node), &choices[first], &choices[first + 1]);
            }
        }
        Self { choices }
    }

    /// The nodes of the binary tree that become the boxes of one of eight.
    fn children(&self, binary: &Bvh2, root: usize, found: &mut Vec<usize>) {
        let mut work = vec![(root, WIDTH)];
        while let Some((at, mut room)) = work.pop() {
            let (node, first) = (&binary.nodes[at], &self.choices[at].first);
            while room > 1 && first[room - 1] == 0 {
                room -= 1;
            }
            if room == 1 || node.is_leaf() {
                found.push(at);
                continue;
            }
            let (child, first) = (node.first_index as usize, usize::from(first[room - 1]));
            work.extend([(child + 1, room - first), (child, first)]);
        }
    }
}

/// Half of a box's surface.
fn area(node: &Bvh2Node) -> f32 {
    let size = node.max - node.min;
    size.x * (size.y + size.z) + size.y * size.z
}

impl Choice {
    fn of(area: f32, a: &Self, b: &Self) -> Self {
        // Of the boxes of both children together.
        let split = |room: usize| {
            let cost = |first: usize| a.cost[first - 1] + b.cost[room - first - 1];
            // Some way even where no cost is a number.
            (2..room)
                .fold((cost(1), 1), |best, first| if cost(first) < best.0 { (cost(first), first as u8) } else { best })
        };
        let mut choice = Self::default();
        let (below, first) = split(WIDTH);
        choice.first[WIDTH - 1] = first;
        choice.cost[0] = area + below;
        for room in 2..WIDTH {
            let fewer = choice.cost[room - 2];
            let (cost, first) = split(room);
            (choice.cost[room - 1], choice.first[room - 1]) = if cost < fewer { (cost, first) } else { (fewer, 0) };
        }
        choice
    }
}
