//! The codes of a PNG or a JPEG as its file has them: one or two bytes a channel, and what colours there are.
//!
//! A picture has far more texels than colours. What is computed of a colour is kept once, and a texel keeps the number of its
//! colour, in as few bytes as that takes.

use rayon::prelude::*;

/// Texels of one to four channels (grey, with alpha, RGB, with alpha), whole numbers of one byte or two, the high one first.
#[derive(Clone, Debug, PartialEq)]
pub struct Codes {
    pub channels: usize,
    /// Whether a channel has two bytes.
    pub wide: bool,
    pub bytes: Vec<u8>,
}

/// The colour of each texel by its number.
#[derive(Clone, Debug, PartialEq)]
pub enum Index {
    One(Vec<u8>),
    Two(Vec<u16>),
    Four(Vec<u32>),
}

/// Bits of a colour of three bytes.
const COLOR_BITS: u32 = 24;

impl Codes {
    pub fn len(&self) -> usize {
        self.bytes.len() / self.texel_bytes()
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    pub fn is_grey(&self) -> bool {
        self.channels < 3
    }

    fn texel_bytes(&self) -> usize {
        self.channels << usize::from(self.wide)
    }

    /// R, G and B over the largest code; those of grey are alike.
    pub fn colors(&self) -> impl IndexedParallelIterator<Item = [f64; 3]> + '_ {
        self.bytes.par_chunks_exact(self.texel_bytes()).map(|texel| {
            let channels = if self.is_grey() { [0; 3] } else { [0, 1, 2] };
            channels.map(|channel| match self.wide {
                false => f64::from(f32::from(texel[channel]) / 255.0),
                true => {
                    let code = u16::from_be_bytes([texel[2 * channel], texel[2 * channel + 1]]);
                    f64::from(f32::from(code) / 65535.0)
                }
            })
        })
    }

    /// The colours of the picture and which of them each texel has. `None` where the colours could be as many as the texels:
    /// with three channels of two bytes.
    pub fn indexed(self) -> Result<(Vec<[f64; 3]>, Index), Self> {
        let grey = |largest: u32| (0..=largest).map(|code| [f64::from(code as f32 / largest as f32); 3]).collect();
        let stride = self.texel_bytes();
        match (self.is_grey(), self.wide) {
            (true, false) if stride == 1 => Ok((grey(255), Index::One(self.bytes))),
            (true, false) => Ok((grey(255), Index::One(self.bytes.par_chunks_exact(stride).map(|t| t[0]).collect()))),
            (true, true) => {
                let code = |texel: &[u8]| u16::from_be_bytes([texel[0], texel[1]]);
                Ok((grey(65535), Index::Two(self.bytes.par_chunks_exact(stride).map(code).collect())))
            }
            (false, false) => Ok(ranked(&self.bytes, stride)),
            (false, true) => Err(self),
        }
    }
}

/// Colours of three bytes in order, without those that no texel has.
fn ranked(bytes: &[u8], stride: usize) -> (Vec<[f64; 3]>, Index) {
    let color = |texel: &[u8]| u32::from_be_bytes([0, texel[0], texel[1], texel[2]]) as usize;
    let mut used = vec![0u64; 1 << (COLOR_BITS - 6)];
    bytes.chunks_exact(stride).map(color).for_each(|color| used[color >> 6] |= 1 << (color & 63));
    let before = used.iter().scan(0u32, |sum, word| {
        let before = *sum;
        *sum += word.count_ones();
        Some(before)
    });
    let before: Vec<u32> = before.collect();
    let rank = |color: usize| {
        let below = used[color >> 6] & ((1u64 << (color & 63)) - 1);
        before[color >> 6] + below.count_ones()
    };
    let all = (0..1usize << COLOR_BITS).filter(|color| used[color >> 6] >> (color & 63) & 1 == 1);
    let colors: Vec<_> =
        all.map(|color| [16, 8, 0].map(|bits| f64::from((color >> bits & 255) as f32 / 255.0))).collect();
    let ranks = bytes.par_chunks_exact(stride).map(|texel| rank(color(texel)));
    let index = match colors.len() {
        0..=0x100 => Index::One(ranks.map(|rank| rank as u8).collect()),
        0x101..=0x1_0000 => Index::Two(ranks.map(|rank| rank as u16).collect()),
        _ => Index::Four(ranks.collect()),
    };
    (colors, index)
}

impl Index {
    #[inline]
    pub fn at(&self, texel: usize) -> usize {
        match self {
            Self::One(all) => all[texel].into(),
            Self::Two(all) => all[texel].into(),
            Self::Four(all) => all[texel] as usize,
        }
    }

    pub fn len(&self) -> usize {
        match self {
            Self::One(all) => all.len(),
            Self::Two(all) => all.len(),
            Self::Four(all) => all.len(),
        }
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Which of so many colours a texel has.
    pub fn used(&self, colors: usize) -> Vec<bool> {
        let mut used = vec![false; colors];
        (0..self.len()).for_each(|texel| used[self.at(texel)] = true);
        used
    }

    /// How many texels have one of the colours that `is` is true of.
    pub fn count(&self, is: &[bool]) -> usize {
        if !is.contains(&true) {
            return 0;
        }
        (0..self.len()).into_par_iter().filter(|&texel| is[self.at(texel)]).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The codes of a texel by its index.
    fn same(codes: Codes) -> Index {
        let direct: Vec<_> = codes.colors().collect();
        let (colors, index) = codes.indexed().expect("an index");
        assert!(direct.iter().enumerate().all(|(texel, color)| colors[index.at(texel)] == *color));
        index
    }

    #[test]
    fn an_index_gives_every_texel_its_color_in_the_fewest_bytes() {
        let bytes = |count: usize| (0..count).map(|i| (i * i / 7 + i) as u8).collect::<Vec<_>>();
        let codes = |channels, wide, bytes| Codes { channels, wide, bytes };
        assert!(matches!(same(codes(1, false, bytes(1000))), Index::One(_)));
        assert!(matches!(same(codes(2, false, bytes(1000))), Index::One(_)));
        assert!(matches!(same(codes(1, true, bytes(1000))), Index::Two(_)));
        assert!(matches!(same(codes(3, false, bytes(300))), Index::One(_)));
        let many = |count: u32| (0..count).flat_map(|i| (i * 211).to_be_bytes()).collect::<Vec<_>>();
        assert!(matches!(same(codes(4, false, many(60_000))), Index::Two(_)));
        let index = same(codes(4, false, many(1_000_000)));
        assert!(matches!(index, Index::Four(_)));
        assert!(codes(3, true, bytes(600)).indexed().is_err(), "as many colours as texels");
    }
}
