//! Stand-in for the colour spaces of `spectrum` until that room has them.

/// An RGB colour space: name and CIE 1931 xy of the primaries and of the white.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RgbSpace {
    pub name: &'static str,
    pub red: [f64; 2],
    pub green: [f64; 2],
    pub blue: [f64; 2],
    pub white: [f64; 2],
}

impl RgbSpace {
    /// IEC 61966-2-1 (primaries of ITU-R BT.709).
    pub const SRGB: Self =
        Self { name: "sRGB", red: [0.64, 0.33], green: [0.30, 0.60], blue: [0.15, 0.06], white: [0.3127, 0.3290] };

    pub fn white_xyz(&self) -> [f64; 3] {
        xyz(self.white)
    }

    pub fn to_xyz(&self) -> [[f64; 3]; 3] {
        let columns = transpose([xyz(self.red), xyz(self.green), xyz(self.blue)]);
        let scale = apply(inverse(columns), self.white_xyz());
        columns.map(|row| [row[0] * scale[0], row[1] * scale[1], row[2] * scale[2]])
    }

    pub fn from_xyz(&self) -> [[f64; 3]; 3] {
        inverse(self.to_xyz())
    }
}

pub fn bradford(from: [f64; 3], to: [f64; 3]) -> [[f64; 3]; 3] {
    const CONE: [[f64; 3]; 3] = [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]];
    let (a, b) = (apply(CONE, from), apply(CONE, to));
    let scaled = [0, 1, 2].map(|i| CONE[i].map(|c| c * b[i] / a[i]));
    multiply(inverse(CONE), scaled)
}

pub fn srgb_encode(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055 }
}

pub fn apply(m: [[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    m.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

pub fn multiply(a: [[f64; 3]; 3], b: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let columns = transpose(b);
    a.map(|row| columns.map(|c| row[0] * c[0] + row[1] * c[1] + row[2] * c[2]))
}

fn xyz([x, y]: [f64; 2]) -> [f64; 3] {
    [x / y, 1.0, (1.0 - x - y) / y]
}

fn transpose(m: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|i| [m[0][i], m[1][i], m[2][i]])
}

fn inverse(m: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let c = [cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])];
    let det = m[0][0] * c[0][0] + m[0][1] * c[0][1] + m[0][2] * c[0][2];
    transpose(c.map(|row| row.map(|x| x / det)))
}
