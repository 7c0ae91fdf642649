//! Leaves whose items do not fit together become several, as few as can be.
//!
//! Leaves are first made by number alone, as large as may be, since one costs the same however full it is. To ask of every part of the tree
//! whether it fits took 2 s longer for 10 M triangles.

use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;
use rayon::prelude::*;

/// Splits leaves until what is in each of them `fits`; single items do, and so does a part of what fits.
pub(super) fn split(binary: &mut Bvh2, fits: impl Fn(&[u32]) -> bool + Sync, bounds: impl Fn(u32) -> Aabb + Sync) {
    let leaves = Leaves { items: &binary.primitive_indices, fits, bounds };
    let nodes = &binary.nodes;
    let crowded = (0..nodes.len() as u32).into_par_iter().filter(|&at| leaves.is_crowded(&nodes[at as usize]));
    let parts: Vec<(u32, Vec<Bvh2Node>)> = crowded.map(|at| (at, leaves.parts(nodes[at as usize]))).collect();
    for (at, parts) in parts {
        // The first part takes the leaf's place.
        let beyond = binary.nodes.len() as u32 - 1;
        let mut placed = parts.into_iter().map(|mut node| {
            node.first_index += if node.is_leaf() { 0 } else { beyond };
            node
        });
        if let Some(top) = placed.next() {
            binary.nodes[at as usize] = top;
        }
        binary.nodes.extend(placed);
    }
    binary.parents.clear();
    binary.primitives_to_nodes.clear();
}

struct Leaves<'a, F, B> {
    /// A leaf's side by side, in the order of the tree.
    items: &'a [u32],
    fits: F,
    bounds: B,
}

impl<F: Fn(&[u32]) -> bool, B: Fn(u32) -> Aabb> Leaves<'_, F, B> {
    fn of(&self, leaf: &Bvh2Node) -> &[u32] {
        &self.items[leaf.first_index as usize..][..leaf.prim_count as usize]
    }

    fn is_crowded(&self, node: &Bvh2Node) -> bool {
        node.prim_count > 1 && !(self.fits)(self.of(node))
    }

    /// The tree that a leaf becomes; inner nodes name their children by their places in it.
    fn parts(&self, leaf: Bvh2Node) -> Vec<Bvh2Node> {
        let (mut parts, mut at) = (vec![leaf], 0);
        while at < parts.len() {
            let node = parts[at];
            if self.is_crowded(&node) {
                let middle = self.middle(self.of(&node));
                let children = [[0, middle], [middle, node.prim_count]].map(|[from, to]| {
                    let mut child = Bvh2Node::new(Aabb::empty(), to - from, node.first_index + from);
                    child.set_aabb(self.around(self.of(&child)));
                    child
                });
                (parts[at].first_index, parts[at].prim_count) = (parts.len() as u32, 0);
                parts.extend(children);
            }
            at += 1;
        }
        parts
    }

    /// Where to split items so that they come into few leaves, and these are small.
    fn middle(&self, items: &[u32]) -> u32 {
        let cost = |middle: &u32| {
            let (a, b) = items.split_at(*middle as usize);
            (self.leaves(a) + self.leaves(b), self.around(a).half_area() + self.around(b).half_area())
        };
        let costs = (1..items.len() as u32).map(|middle| (cost(&middle), middle));
        let best = costs.min_by(|((few, small), _), ((many, large), _)| few.cmp(many).then(small.total_cmp(large)));
        best.map_or(1, |(_, middle)| middle)
    }

    /// Into how many leaves items side by side can come: each takes as many as it can.
    fn leaves(&self, mut items: &[u32]) -> usize {
        let mut leaves = 0;
        while !items.is_empty() {
            let taken = (1..items.len()).rev().find(|&count| (self.fits)(&items[..=count]));
            items = &items[taken.map_or(1, |count| count + 1)..];
            leaves += 1;
        }
        leaves
    }

    fn around(&self, items: &[u32]) -> Aabb {
        items.iter().map(|&item| (self.bounds)(item)).fold(Aabb::empty(), |a, b| a.union(&b))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3A;

    /// Item i is a cube around (i, 0, 0).
    fn bounds(item: u32) -> Aabb {
        let center = Vec3A::X * item as f32;
        Aabb::new(center - 0.25, center + 0.25)
    }

    /// A tree of two leaves, of three and six items.
    fn tree() -> Bvh2 {
        let leaf = |first: u32, count: u32| {
            let around = (first..first + count).map(bounds).fold(Aabb::empty(), |a, b| a.union(&b));
            Bvh2Node::new(around, count, first)
        };
        let leaves = [leaf(0, 3), leaf(3, 6)];
        let whole = leaves[0].aabb().union(leaves[1].aabb());
        let nodes = vec![Bvh2Node::new(whole, 0, 1), leaves[0], leaves[1]];
        Bvh2 { nodes, primitive_indices: (0..9).collect(), ..Bvh2::default() }
    }

    /// Items of each leaf, once it is sure that boxes hold just what is in them and children stand side by side.
    fn leaves(tree: &Bvh2, at: usize) -> Vec<Vec<u32>> {
        let node = &tree.nodes[at];
        let (first, count) = (node.first_index as usize, node.prim_count as usize);
        let found = match node.is_leaf() {
            true => vec![tree.primitive_indices[first..first + count].to_vec()],
            false => {
                assert_eq!(first % 2, 1);
                [leaves(tree, first), leaves(tree, first + 1)].concat()
            }
        };
        let around = found.iter().flatten().map(|&item| bounds(item)).fold(Aabb::empty(), |a, b| a.union(&b));
        assert_eq!((node.aabb().min, node.aabb().max), (around.min, around.max));
        found
    }

    #[test]
    fn items_that_do_not_fit_come_into_as_few_leaves_as_can_be() {
        for (most, expected) in [(1, 9), (2, 5), (3, 3), (4, 3), (6, 2)] {
            let mut tree = tree();
            split(&mut tree, |items| items.len() <= most, bounds);
            let leaves = leaves(&tree, 0);
            assert_eq!(leaves.concat(), (0..9).collect::<Vec<u32>>(), "{most}");
            assert!(leaves.iter().all(|leaf| leaf.len() <= most), "{most}: {leaves:?}");
            assert_eq!(leaves.len(), expected, "{most}: {leaves:?}");
        }
    }

    #[test]
    fn single_items_fit_whatever_is_said() {
        let mut tree = tree();
        split(&mut tree, |_| false, bounds);
        assert_eq!(leaves(&tree, 0).len(), 9);
    }
}
