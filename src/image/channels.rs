//! More channels beside R, G, B in one EXR part, under names that Blender, Nuke and tev group and show.
//!
//! A name is `layer.channel` (OpenEXR, "Technical introduction", layers). Colours end in R, G, B, vectors in X, Y, Z; depth is
//! `depth.Z`, which Nuke reads into its own layer of that name and Blender into a pass. One part with many channels is what
//! every reader takes. Numbers of objects are 32-bit floats, exact up to 2²⁴: not all readers show integers. There
//! is no Cryptomatte: an edge pixel has the number of one object.

/// One more channel of an EXR file.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    pub name: String,
    /// Row by row from the top, as the pixels.
    pub values: Vec<f32>,
    /// Whether 16 bits would spoil it: then it has 32 in every file.
    pub full: bool,
}

/// What an EXR file holds beside the picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Extra {
    pub channels: Vec<Channel>,
    /// Text attributes under names of a standard.
    pub attributes: Vec<(&'static str, String)>,
}

/// Distance of nothing, as Blender's Cycles writes it: far, and no infinity that would turn filters into NaN.
pub const FAR: f32 = 1e10;

impl Channel {
    pub fn new(name: impl Into<String>, values: Vec<f32>) -> Self {
        Self { name: name.into(), values, full: true }
    }

    /// The three channels of a layer, which 16 bits may hold unless `full`.
    pub fn triple(layer: &str, names: [&str; 3], full: bool, values: &[[f32; 3]]) -> [Self; 3] {
        [0, 1, 2].map(|i| Self {
            name: format!("{layer}.{}", names[i]),
            values: values.iter().map(|value| value[i]).collect(),
            full,
        })
    }
}
