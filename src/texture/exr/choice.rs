//! Which channels of an EXR are the picture.

use super::Fault;
use exr::meta::header::Header;
use std::collections::BTreeSet;

/// One channel or three of one part.
#[derive(Debug)]
pub struct Choice {
    pub part: usize,
    pub names: Vec<String>,
    pub kind: Kind,
    pub notes: Vec<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Rgb,
    Xyz,
    /// Y, (R − Y)/Y and (B − Y)/Y.
    LuminanceChroma,
    Grey,
}

/// In the order in which they are looked for.
const KINDS: [(Kind, &[&str]); 5] = [
    (Kind::Rgb, &["R", "G", "B"]),
    (Kind::LuminanceChroma, &["Y", "RY", "BY"]),
    (Kind::Xyz, &["X", "Y", "Z"]),
    (Kind::Grey, &["Y"]),
    (Kind::Grey, &["R"]),
];

/// What programs call the layer that is the picture.
const USUAL: [&str; 8] = ["combined", "beauty", "rgba", "rgb", "color", "image", "composite", "default"];

impl Choice {
    /// The picture of a file: channels without a layer's name before those with one.
    pub fn of(headers: &[Header]) -> Result<Self, Fault> {
        for (kind, names) in KINDS {
            let part = parts(headers).find(|(_, header)| names.iter().all(|name| has(header, name)));
            if let Some((part, _)) = part {
                let names = names.iter().map(|name| (*name).to_owned()).collect();
                return Ok(Self { part, names, kind, notes: Vec::new() });
            }
        }
        Self::layer(headers).ok_or_else(|| no_picture(headers))
    }

    /// The layer whose name is that of a picture, or the first.
    fn layer(headers: &[Header]) -> Option<Self> {
        let layers: Vec<(usize, String)> = parts(headers)
            .flat_map(|(part, header)| layers(header).into_iter().map(move |layer| (part, layer)))
            .collect();
        let last = |layer: &str| layer.rsplit('.').next().unwrap_or(layer).to_ascii_lowercase();
        let usual = USUAL.iter().find_map(|usual| layers.iter().find(|(_, layer)| last(layer) == *usual));
        let (part, layer) = usual.or(layers.first())?.clone();
        let mut note = format!("its layer `{layer}` is read");
        let others: BTreeSet<_> = layers.iter().map(|(_, other)| other).filter(|other| **other != layer).collect();
        if !others.is_empty() {
            let others: Vec<_> = others.into_iter().map(|other| format!("`{other}`")).collect();
            note += &format!(", and not {}", others.join(", "));
        }
        let names = ["R", "G", "B"].map(|channel| format!("{layer}.{channel}")).to_vec();
        Some(Self { part, names, kind: Kind::Rgb, notes: vec![note] })
    }
}

fn parts(headers: &[Header]) -> impl Iterator<Item = (usize, &Header)> {
    headers.iter().enumerate().filter(|(_, header)| !header.deep)
}

fn has(header: &Header, name: &str) -> bool {
    header.channels.list.iter().any(|channel| channel.name.eq(name))
}

/// Names of layers with R, G and B.
fn layers(header: &Header) -> Vec<String> {
    let names = header.channels.list.iter().map(|channel| channel.name.to_string());
    let reds = names.filter_map(|name| name.strip_suffix(".R").map(str::to_owned));
    reds.filter(|layer| ["G", "B"].iter().all(|channel| has(header, &format!("{layer}.{channel}")))).collect()
}

fn no_picture(headers: &[Header]) -> Fault {
    let names = headers.iter().flat_map(|header| &header.channels.list).map(|channel| format!("`{}`", channel.name));
    let names = names.collect::<Vec<_>>().join(", ");
    let deep = if headers.iter().all(|header| header.deep) { "deep data, which is not read, and " } else { "" };
    Fault::new(format!(
        "it has {deep}the channels {names}: a picture has `R`, `G` and `B`, `X`, `Y` and `Z`, `Y` with `RY` and `BY`, `Y`, or `R`"
    ))
}
