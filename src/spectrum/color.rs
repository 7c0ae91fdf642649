//! XYZ: matrices, chromatic adaptation, CIELAB.

/// Tristimulus values.
pub type Xyz = [f64; 3];

/// A 3 × 3 matrix, row by row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matrix3(pub [[f64; 3]; 3]);

impl Matrix3 {
    pub const IDENTITY: Self = Self::diagonal([1.0; 3]);

    pub const fn diagonal([a, b, c]: [f64; 3]) -> Self {
        Self([[a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]])
    }

    /// Matrix times column vector.
    pub fn apply(&self, v: [f64; 3]) -> [f64; 3] {
        self.0.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
    }

    /// `self` after `first`: the matrix product self · first.
    pub fn after(&self, first: &Self) -> Self {
        let columns = first.transposed().0.map(|column| self.apply(column));
        Self(columns).transposed()
    }

    pub fn transposed(&self) -> Self {
        Self(std::array::from_fn(|i| std::array::from_fn(|j| self.0[j][i])))
    }

    /// The inverse by cofactors; `None` if there is none.
    pub fn inverse(&self) -> Option<Self> {
        let m = &self.0;
        let cofactor = |i: usize, j: usize| {
            let (a, b, c, d) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
            m[a][c] * m[b][d] - m[a][d] * m[b][c]
        };
        let determinant = (0..3).map(|j| m[0][j] * cofactor(0, j)).sum::<f64>();
        let inverse = std::array::from_fn(|i| std::array::from_fn(|j| cofactor(j, i) / determinant));
        (determinant != 0.0 && determinant.is_finite()).then_some(Self(inverse))
    }
}

/// XYZ of a chromaticity, Y = 1.
pub fn xyz_from_xy([x, y]: [f64; 2]) -> Xyz {
    [x / y, 1.0, (1.0 - x - y) / y]
}

/// Cone responses of K. M. Lam, "Metamerism and colour constancy" (PhD thesis, Bradford, 1985), linear part, as in the
/// ICC profile specification, annex E.
const BRADFORD: Matrix3 = Matrix3([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]]);

/// Chromatic adaptation from one white to another: XYZ to XYZ, and `from` to exactly `to`'s chromaticity and size.
/// The identity if a white has a cone response of 0, which no light does.
pub fn bradford(from: Xyz, to: Xyz) -> Matrix3 {
    let (from, to) = (BRADFORD.apply(from), BRADFORD.apply(to));
    let gains: [f64; 3] = std::array::from_fn(|i| to[i] / from[i]);
    match BRADFORD.inverse() {
        Some(back) if gains.iter().all(|gain| gain.is_finite()) => {
            back.after(&Matrix3::diagonal(gains)).after(&BRADFORD)
        }
        _ => Matrix3::IDENTITY,
    }
}

/// CIE 1976 L*a*b* with respect to a white (CIE 15:2004, equations 8.3–8.8, exact constants 216/24389 and 24389/27).
pub fn lab_from_xyz(xyz: Xyz, white: Xyz) -> [f64; 3] {
    let [x, y, z]: [f64; 3] = std::array::from_fn(|i| {
        let t = xyz[i] / white[i];
        if t > 216.0 / 24389.0 { libm::cbrt(t) } else { (24389.0 / 27.0 * t + 16.0) / 116.0 }
    });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// The inverse of [`lab_from_xyz`].
pub fn xyz_from_lab([l, a, b]: [f64; 3], white: Xyz) -> Xyz {
    let y = (l + 16.0) / 116.0;
    let f = [y + a / 500.0, y, y - b / 200.0];
    std::array::from_fn(|i| {
        let t = if f[i] > 6.0 / 29.0 { f[i] * f[i] * f[i] } else { (116.0 * f[i] - 16.0) * 27.0 / 24389.0 };
        t * white[i]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn adaptation_takes_white_to_white() {
        let (a, d65) = ([1.0985, 1.0, 0.3558], [0.9505, 1.0, 1.089]);
        let adapted = bradford(a, d65).apply(a);
        assert!(adapted.iter().zip(d65).all(|(a, b)| (a - b).abs() < 1e-14));
        assert_eq!(bradford([0.0; 3], d65), Matrix3::IDENTITY);
    }

    #[test]
    fn inverse_and_lab_round_trip() {
        let back = BRADFORD.inverse().unwrap().after(&BRADFORD);
        for (row, one) in back.0.iter().zip(Matrix3::IDENTITY.0) {
            assert!(row.iter().zip(one).all(|(a, b)| (a - b).abs() < 1e-15));
        }
        assert_eq!(Matrix3([[0.0; 3]; 3]).inverse(), None);
        let white = [0.95, 1.0, 1.09];
        for xyz in [[0.2, 0.1, 0.3], [0.001, 0.002, 0.0005], [0.9, 1.2, 1.0]] {
            let again = xyz_from_lab(lab_from_xyz(xyz, white), white);
            assert!(again.iter().zip(xyz).all(|(a, b)| (a - b).abs() < 1e-14));
        }
        assert_eq!(lab_from_xyz(white, white), [100.0, 0.0, 0.0]);
    }
}
