//! Where a ray meets matter: rays, shapes, the world they make, gem cuts, and points on shapes that send light.
//!
//! There is no epsilon in this room. Every ray says from which surface it departs, and into which side; shapes that cannot
//! be met again are not asked, and from inside a solid only the exit is looked for. Where two surfaces touch, rounding
//! decides on which side of the other an origin lies: there the bound of the rounding error, worked out from the numbers
//! at hand, tells "at the surface" from "inside", at every scale.
//!
//! Lengths are scene units. Computations are in single precision with IEEE operations and `libm` only, in an order that the
//! source fixes, so a hit is the same on every machine; solids are built in double precision.

// `!(a > b)` is meant: it is also true of NaN, which must never count as a hit.
#![allow(clippy::neg_cmp_op_on_partial_ord)]

mod bounds;
mod check;
mod coincide;
mod contact;
pub mod convex;
pub mod cuts;
mod disk;
mod error;
mod escape;
mod flat;
pub mod loaders;
pub mod mend;
pub mod mesh;
mod ray;
mod rectangle;
mod sampling;
mod shape;
mod sphere;
mod tree;
mod triangles;
mod world;

pub use bounds::Bounds;
pub use convex::{Convex, Exits, Facet, Plane};
pub use cuts::{Brilliant, StepCut};
pub use disk::Disk;
pub use error::GeometryError;
pub use mend::{Mended, Rim};
pub use mesh::{Mesh, Placed, Surroundings};
pub use ray::{Departure, Hit, Met, Ray, ShapeId, Side, Target};
pub use rectangle::Rectangle;
pub use sampling::Toward;
pub use shape::Shape;
pub use sphere::Sphere;
pub use triangles::Triangles;
pub use world::World;
