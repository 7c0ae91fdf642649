//! A tree of boxes, eight to a node.
//!
//! obvhs builds a binary tree very well and we collapse it to eight boxes a node ([`build`]), tested together and visited near first.
//! Its own traversals are not used: the binary one has no margin for rounding in its box test, the wide one an absolute
//! epsilon. Here boxes are padded, the far distance is widened by more than 4 ε (T. Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013)
//! and the error of the ray's origin widens every box, so nothing that its shape would report is missed.
//!
//! The tree knows only boxes and numbers. What a number means, a shape or a block of triangles, its user decides.
//!
//! What a ray costs, on a ball of 1.03 M triangles (`benches/peers/embree`, one thread of a Zen 5 server): camera rays 112 ns for 6.8
//! nodes and 1.1 blocks, diffuse ones 181 for 8.5 and 2.1, random ones 351 for 5.6 and 0.9, shadow rays 169 for 8.2 and 2.3. Embree 3.13,
//! robust, takes 1.08, 0.94, 0.92 and 0.91 times that, from one round to the next 0.82 to 1.00 for random rays, as others use the memory
//! more or less. With the point and the normals in double precision it is 0.95, 0.94 and 0.92. The rest is a chain from one box test to
//! the next, and memory: half of a random ray's time is spent on the first touch of nodes (12 MB) and blocks (31 MB).
//!
//! A structure that is written field by field and read whole, as a copy does, is not forwarded from the processor's store buffer: the load
//! waits until the stores are done. Handing rays over by reference and results in registers took a camera's ray from 147 to 112 ns, with the
//! same arithmetic. So look at copies first (`perf annotate`: much time at a wide load from the stack).
//!
//! Tried, and no faster: to touch what goes onto the stack, or to prefetch it by `_mm_prefetch` (all lines of nodes and of blocks; nothing
//! beyond the noise); while blocks held four triangles, leaves of two (random rays 10 % faster, diffuse ones 7 % slower); bits of hits in
//! eight bits rather than 32, or handed back apart from the distances: then the compiler takes [`Node::meet`] apart (25 % slower). Two vectors of
//! four for one of eight are 2 to 13 % slower. Since blocks share corners: nodes and blocks in mapped memory with `MADV_HUGEPAGE`, which it got
//! (nothing beyond the noise in 12 rounds; before, by glibc's tunable, random rays had become 3 to 11 % faster); [`Node::meet`] by vectors of eight
//! by name, inlined (camera rays 4 to 6 % slower, the latter with the distances kept in a register and fetched lane by lane, shadow rays
//! 14 %); nothing sorted for shadow rays (8 % more nodes, the same time); all nodes tried elsewhere ([`build`]: blocks fall by 4 %, nodes do
//! not); leaves joined once more at the end (0.5 % fewer). The nodes' children lie together and their blocks too, as they are made.

mod build;
mod leaves;
mod reinsert;

use glam::Vec3;

use super::Bounds;
pub(super) use build::Groups;

const WIDTH: usize = 8;

/// What a slot of a node holds: an inner node, or an item if this bit is set.
const ITEM: u32 = 1 << 31;

/// An unused slot, whose empty box is never met.
const NOTHING: u32 = u32::MAX;

/// Eight numbers.
type Eight = [f32; WIDTH];

/// Four lines of a cache, the children in the first, which is read in any case.
///
/// Eight boxes: `planes[axis][0]` their minima, `planes[axis][1]` their maxima. Unused slots hold empty boxes.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
struct Node {
    children: [u32; WIDTH],
    planes: [[Eight; 2]; 3],
}

/// What a ray meets of a node.
struct Boxes {
    /// Where it enters each box.
    nears: Eight,
    /// A bit for each box that it meets.
    hits: u32,
}

#[derive(Clone, Debug)]
pub(super) struct Tree {
    nodes: Vec<Node>,
}

/// What box tests want to know of a ray, worked out once.
pub(super) struct BoxRay {
    /// Per axis: 1 if the ray goes towards smaller coordinates, whose near planes are the maxima.
    negative: [usize; 3],
    inverse: [f32; 3],
    /// Widened by five roundings: one of its own and the four of the box test.
    inverse_far: [f32; 3],
    /// Origins shifted by the origin's error: against the near planes, and against the far ones.
    near_origin: [f32; 3],
    far_origin: [f32; 3],
}

impl BoxRay {
    #[inline]
    pub fn new(origin: Vec3, direction: Vec3, error: f32) -> Self {
        let (o, d) = (origin.to_array(), direction.to_array());
        let negative = d.map(|x| x.is_sign_negative() as usize);
        // Towards where the ray goes.
        let shift = d.map(|x| error.copysign(x));
        Self {
            negative,
            inverse: d.map(|x| 1.0 / x),
            inverse_far: d.map(|x| 1.0 / x * (1.0 + 5.0 * f32::EPSILON)),
            near_origin: [0, 1, 2].map(|axis| o[axis] + shift[axis]),
            far_origin: [0, 1, 2].map(|axis| o[axis] - shift[axis]),
        }
    }
}

impl Tree {
    /// A tree over boxes; items are their indices. One item a leaf: testing a shape costs more than testing its box.
    pub fn new(boxes: &[Bounds]) -> Self {
        if boxes.len() <= WIDTH {
            return Self::single(boxes);
        }
        let (mut tree, groups) = build::build(boxes.len(), 1, |i| boxes[i], |_| false);
        for child in tree.nodes.iter_mut().flat_map(|node| &mut node.children) {
            if *child & ITEM != 0 && *child != NOTHING {
                *child = groups.get((*child & !ITEM) as usize)[0] | ITEM;
            }
        }
        tree
    }

    /// A tree over `count` boxes whose leaves hold up to `size` of them that `fit` together. Items are leaves, in the order of the
    /// groups.
    pub fn grouped(
        count: usize,
        size: u32,
        bounds: impl Fn(usize) -> Bounds + Sync,
        fit: impl Fn(&[u32]) -> bool + Sync,
    ) -> (Self, Groups) {
        build::build(count, size, bounds, fit)
    }

    fn single(boxes: &[Bounds]) -> Self {
        let mut node = Node::empty();
        for (slot, b) in boxes.iter().map(Bounds::padded).enumerate() {
            node.set(slot, b.min, b.max, slot as u32 | ITEM);
        }
        Self { nodes: vec![node] }
    }

    /// The items whose boxes meet a box.
    pub fn near(&self, bounds: &Bounds) -> Vec<u32> {
        let (mut found, mut work) = (Vec::new(), vec![0]);
        while let Some(node) = work.pop() {
            let Node { planes, children } = &self.nodes[node as usize];
            for (slot, &child) in children.iter().enumerate() {
                let corner = |end: usize| Vec3::from_array(planes.each_ref().map(|ends| ends[end][slot]));
                if child == NOTHING || !bounds.meets(&Bounds { min: corner(0), max: corner(1) }) {
                    continue;
                }
                if child & ITEM == 0 { work.push(child) } else { found.push(child & !ITEM) }
            }
        }
        found
    }

    /// Shows `visit` the items whose boxes the ray meets within `t_max`, roughly near first. `visit` returns the new
    /// `t_max`; a negative one ends it.
    #[inline(always)]
    pub fn visit(&self, ray: &BoxRay, t_max: f32, mut visit: impl FnMut(u32, f32) -> f32) {
        self.visit_with(ray, t_max, || (), |(), item, t_max| visit(item, t_max));
    }

    /// The same for a visitor that wants to know more of the ray. `prepare` works it out, but only where anything of the topmost node
    /// is met: of most rays that leave a floor nothing is.
    #[inline(always)]
    pub fn visit_with<R>(
        &self,
        ray: &BoxRay,
        mut t_max: f32,
        prepare: impl FnOnce() -> R,
        mut visit: impl FnMut(&R, u32, f32) -> f32,
    ) {
        let Some(top) = self.nodes.first() else { return };
        let met = top.meet(ray, t_max);
        if met.hits == 0 {
            return;
        }
        let prepared = prepare();
        let mut stack = Stack::new();
        let mut next = child(stack.push(&met.nears, &top.children, met.hits));
        loop {
            if next & ITEM != 0 {
                // A ray that is no number meets all boxes, empty ones too.
                if next != NOTHING {
                    t_max = visit(&prepared, next & !ITEM, t_max);
                }
                if t_max < 0.0 {
                    return;
                }
            } else if let Some(node) = self.nodes.get(next as usize) {
                // Kept whole: taken apart it is copied (5 % of a camera's ray).
                let met = node.meet(ray, t_max);
                if met.hits != 0 {
                    next = child(stack.push(&met.nears, &node.children, met.hits));
                    continue;
                }
            }
            next = loop {
                match stack.pop() {
                    None => return,
                    Some(entry) if near(entry) <= t_max => break child(entry),
                    Some(_) => {}
                }
            };
        }
    }
}

/// A node or item to be visited, and above it, in bits that are in order of their numbers, where the ray enters its box (≥ 0).
type Entry = u64;

#[inline]
fn entry(near: f32, child: u32) -> Entry {
    u64::from(near.to_bits()) << 32 | u64::from(child)
}

#[inline]
fn near(entry: Entry) -> f32 {
    f32::from_bits((entry >> 32) as u32)
}

#[inline]
fn child(entry: Entry) -> u32 {
    entry as u32
}

/// Entries to come back to. Clearing them costs as much as a node for every hundred, so there are few, and room for more where a
/// tree is that deep.
struct Stack {
    entries: [Entry; Self::USUAL],
    size: usize,
    more: Vec<Entry>,
}

impl Stack {
    const USUAL: usize = 32;

    #[inline]
    fn new() -> Self {
        Self { entries: [0; Self::USUAL], size: 0, more: Vec::new() }
    }

    #[inline]
    fn pop(&mut self) -> Option<Entry> {
        self.size = self.size.checked_sub(1)?;
        match self.entries.get(self.size) {
            Some(&entry) => Some(entry),
            None => self.more.pop(),
        }
    }

    #[inline]
    fn add(&mut self, entry: Entry) {
        match self.entries.get_mut(self.size) {
            Some(slot) => *slot = entry,
            None => self.more.push(entry),
        }
        self.size += 1;
    }

    /// Adds the boxes that are hit, at least one, far first, but for the nearest, which is returned.
    #[inline(always)]
    fn push(&mut self, nears: &[f32; WIDTH], children: &[u32; WIDTH], mut hits: u32) -> Entry {
        let mut take = || {
            let slot = hits.trailing_zeros() as usize & (WIDTH - 1);
            hits &= hits - 1;
            (entry(nears[slot], children[slot]), hits == 0)
        };
        let (mut a, last) = take();
        if last {
            return a;
        }
        let (mut b, last) = take();
        sort(&mut a, &mut b);
        if last {
            self.add(b);
            return a;
        }
        let (mut c, last) = take();
        sort(&mut b, &mut c);
        sort(&mut a, &mut b);
        if last {
            self.add(c);
            self.add(b);
            return a;
        }
        self.push_many([a, b, c], nears, children, hits)
    }

    /// Three in order, and more that are hit.
    #[cold]
    fn push_many(
        &mut self,
        [a, b, c]: [Entry; 3],
        nears: &[f32; WIDTH],
        children: &[u32; WIDTH],
        mut hits: u32,
    ) -> Entry {
        let mut sorted = [a, b, c, 0, 0, 0, 0, 0];
        let mut size = 3;
        while hits != 0 {
            let slot = hits.trailing_zeros() as usize & (WIDTH - 1);
            hits &= hits - 1;
            let entry = entry(nears[slot], children[slot]);
            let mut place = size;
            while place > 0 && sorted[place - 1] > entry {
                sorted[place & (WIDTH - 1)] = sorted[place - 1];
                place -= 1;
            }
            sorted[place & (WIDTH - 1)] = entry;
            size += 1;
        }
        for &entry in sorted[1..size].iter().rev() {
            self.add(entry);
        }
        sorted[0]
    }
}

/// The lesser first.
#[inline]
fn sort(a: &mut Entry, b: &mut Entry) {
    (*a, *b) = ((*a).min(*b), (*a).max(*b));
}

impl Node {
    fn empty() -> Self {
        Self { planes: [[[f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]]; 3], children: [NOTHING; WIDTH] }
    }

    fn set(&mut self, slot: usize, min: Vec3, max: Vec3, child: u32) {
        for axis in 0..3 {
            self.planes[axis][0][slot] = min[axis];
            self.planes[axis][1][slot] = max[axis];
        }
        self.children[slot] = child;
    }

    /// What the ray meets within `t_max`. A ray within a box's plane gives 0·∞ = NaN there; the comparisons are such that NaN says nothing.
    ///
    /// A function of its own, so that it becomes vectors of eight: amid other code the compiler takes the loops apart (15 % slower).
    #[inline(never)]
    fn meet(&self, ray: &BoxRay, t_max: f32) -> Boxes {
        let mut near = [0.0f32; WIDTH];
        let mut far = [t_max; WIDTH];
        for axis in 0..3 {
            let sign = ray.negative[axis] & 1;
            let (near_planes, far_planes) = (&self.planes[axis][sign], &self.planes[axis][1 - sign]);
            for k in 0..WIDTH {
                let t0 = (near_planes[k] - ray.near_origin[axis]) * ray.inverse[axis];
                let t1 = (far_planes[k] - ray.far_origin[axis]) * ray.inverse_far[axis];
                near[k] = if t0 > near[k] { t0 } else { near[k] };
                far[k] = if t1 < far[k] { t1 } else { far[k] };
            }
        }
        let mut hits = 0;
        for k in 0..WIDTH {
            hits |= ((near[k] <= far[k]) as u32) << k;
        }
        Boxes { nears: near, hits }
    }
}
