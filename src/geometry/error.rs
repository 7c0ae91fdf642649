//! What can be wrong with a shape.

/// A shape that cannot be built, in words for the person who described it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GeometryError {
    #[error("{what} is not a finite number")]
    NotFinite { what: &'static str },

    #[error(
        "{what} is {value:e}; single precision wants sizes and coordinates within 1e-15 … 1e15 (choose another unit)"
    )]
    OutOfRange { what: &'static str, value: f64 },

    #[error("{what} must be above zero, it is {value}")]
    NotPositive { what: &'static str, value: f64 },

    #[error("the two edges of the {what} are parallel or zero: it has no area")]
    NoArea { what: &'static str },

    #[error("plane {index} of the convex solid is not finite, or its normal is zero")]
    BadPlane { index: usize },

    #[error("the planes close no volume: they leave an opening, or no point lies behind all of them")]
    NoVolume,

    #[error("the transform flattens the shape: its matrix has no inverse")]
    Singular,

    #[error(
        "the transform would turn the sphere into an ellipsoid, which is not supported: \
         scale by the same factor along x, y and z, and do not shear"
    )]
    Ellipsoid,

    /// A proportion of a gem cut: its name, what it was and what it can be.
    #[error("{name} is {value}: {wants}")]
    Proportion { name: &'static str, value: f64, wants: String },

    #[error("the mesh has no triangle")]
    NoTriangles,

    #[error("none of the mesh's {count} triangles has an area: nothing of it can be seen")]
    NoTriangleWithArea { count: usize },

    #[error("a triangle of the mesh names corner {index}, but it has {count} (the first one is 0)")]
    NoSuchCorner { index: u32, count: usize },

    #[error("{count} triangles or corners are more than the {max} a mesh can hold: cut it into several")]
    TooManyTriangles { count: usize, max: usize },

    #[error("{count} shapes are more than the {max} a world can hold")]
    TooManyShapes { count: usize, max: usize },
}
