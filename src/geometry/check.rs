//! The range of numbers in which shapes work.

use glam::{Affine3A, DMat3, DVec3, Vec3};

use super::GeometryError;

/// Sizes and coordinates are kept far enough from the ends of single precision (1e±38) that squares and products of two
/// squares of them still are numbers.
const SMALLEST: f64 = 1e-15;
const LARGEST: f64 = 1e15;

/// A coordinate: finite and not too large.
pub(super) fn point(what: &'static str, p: Vec3) -> Result<(), GeometryError> {
    if !p.is_finite() {
        return Err(GeometryError::NotFinite { what });
    }
    let largest = p.abs().max_element() as f64;
    if largest > LARGEST { Err(GeometryError::OutOfRange { what, value: largest }) } else { Ok(()) }
}

/// A length: finite, above zero, neither too large nor too small.
pub(super) fn length(what: &'static str, value: f64) -> Result<(), GeometryError> {
    if !value.is_finite() {
        return Err(GeometryError::NotFinite { what });
    }
    if value <= 0.0 {
        return Err(GeometryError::NotPositive { what, value });
    }
    if (SMALLEST..=LARGEST).contains(&value) { Ok(()) } else { Err(GeometryError::OutOfRange { what, value }) }
}

/// A transform in double precision. (Its own products are not used: they are vector code that may round differently
/// between processors.)
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Transform {
    pub matrix: DMat3,
    pub translation: DVec3,
    /// The matrix is that of no change: what is only moved is not multiplied by ones and zeros.
    only_moves: bool,
}

impl Transform {
    pub fn new(affine: &Affine3A) -> Result<Self, GeometryError> {
        let columns = [affine.matrix3.x_axis, affine.matrix3.y_axis, affine.matrix3.z_axis, affine.translation];
        if columns.iter().any(|c| !c.is_finite()) {
            return Err(GeometryError::NotFinite { what: "the transform" });
        }
        let [x, y, z, t] = columns.map(|c| Vec3::from(c).as_dvec3());
        Ok(Self::of(DMat3::from_cols(x, y, z), t))
    }

    fn of(matrix: DMat3, translation: DVec3) -> Self {
        Self { matrix, translation, only_moves: matrix == DMat3::IDENTITY }
    }

    #[inline]
    pub fn point(&self, p: DVec3) -> DVec3 {
        self.vector(p) + self.translation
    }

    #[inline]
    pub fn vector(&self, v: DVec3) -> DVec3 {
        if self.only_moves {
            return v;
        }
        self.matrix.x_axis * v.x + self.matrix.y_axis * v.y + self.matrix.z_axis * v.z
    }

    /// This map after another one.
    pub fn after(&self, first: &Self) -> Self {
        let [x, y, z] = [first.matrix.x_axis, first.matrix.y_axis, first.matrix.z_axis].map(|axis| self.vector(axis));
        Self::of(DMat3::from_cols(x, y, z), self.point(first.translation))
    }

    /// The way back; none if the map flattens space.
    pub fn inverse(&self) -> Option<Self> {
        let (x, y, z) = (self.matrix.x_axis, self.matrix.y_axis, self.matrix.z_axis);
        let rows = [y.cross(z), z.cross(x), x.cross(y)].map(|row| row / self.determinant());
        let matrix = DMat3::from_cols(rows[0], rows[1], rows[2]).transpose();
        let mut back = Self::of(matrix, DVec3::ZERO);
        back.translation = -back.vector(self.translation);
        (back.matrix.is_finite() && back.translation.is_finite()).then_some(back)
    }

    /// A bound on how many times longer a vector becomes: the Frobenius norm.
    pub fn stretch(&self) -> f64 {
        let axes = [self.matrix.x_axis, self.matrix.y_axis, self.matrix.z_axis];
        axes.iter().map(|axis| axis.length_squared()).sum::<f64>().sqrt()
    }

    pub fn determinant(&self) -> f64 {
        self.matrix.x_axis.dot(self.matrix.y_axis.cross(self.matrix.z_axis))
    }

    /// How normals turn, and change their lengths; outwards stays outwards under mirrors. (The matrix of cofactors, with the sign of the
    /// determinant.)
    pub fn of_normals(&self) -> Self {
        let (x, y, z) = (self.matrix.x_axis, self.matrix.y_axis, self.matrix.z_axis);
        let sign = self.determinant().signum();
        Self::of(DMat3::from_cols(y.cross(z) * sign, z.cross(x) * sign, x.cross(y) * sign), DVec3::ZERO)
    }
}
