//! Colours a display cannot show: counted at development, moved inside only when a file can hold nothing else.

use std::fmt;

use super::Pixel;
use crate::spectrum::RgbSpace;

/// How linear RGB gets into [0, 1] for files that cannot hold more.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Gamut {
    /// Each channel is clipped: keeps saturation and shifts hue (bright gold turns lemon).
    Clip,
    /// The colour moves towards the grey of its own luminance until it is inside: keeps luminance and dominant
    /// wavelength and loses saturation. From luminance 1 on it is white.
    #[default]
    PreserveChroma,
}

impl Gamut {
    /// `rgb` moved into [0, 1]³. `luminance` holds the luminances of the three primaries; they sum to 1.
    pub fn map(self, rgb: [f64; 3], luminance: [f64; 3]) -> [f64; 3] {
        match self {
            Gamut::Clip => rgb.map(|c| c.clamp(0.0, 1.0)),
            Gamut::PreserveChroma => towards_grey(rgb, luminance),
        }
    }
}

fn towards_grey(rgb: [f64; 3], luminance: [f64; 3]) -> [f64; 3] {
    let grey = rgb[0] * luminance[0] + rgb[1] * luminance[1] + rgb[2] * luminance[2];
    if grey <= 0.0 || grey >= 1.0 {
        return [grey.clamp(0.0, 1.0); 3];
    }
    // The largest part of each channel's distance from grey that stays inside; the smallest serves all three.
    let room = rgb.map(|c| {
        if c > 1.0 {
            (1.0 - grey) / (c - grey)
        } else if c < 0.0 {
            grey / (grey - c)
        } else {
            1.0
        }
    });
    let part = room[0].min(room[1]).min(room[2]);
    if part == 1.0 { rgb } else { rgb.map(|c| (grey + part * (c - grey)).clamp(0.0, 1.0)) }
}

/// What the development of a film met that a display cannot show, or that should not have been there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GamutReport {
    /// Pixels of the film.
    pub pixels: u64,
    /// Pixels with a channel above display white.
    pub above_one: u64,
    /// Pixels with a negative channel: outside the gamut of the RGB space.
    pub negative: u64,
    /// Samples that were not finite numbers, left out of the sums.
    pub rejected: u64,
    /// Pixels whose sums left their range; too dark in every file.
    pub overflow: u64,
    /// Pixels without any sample; black in every file.
    pub unsampled: u64,
    /// How the PNG brings the first two kinds inside.
    pub gamut: Gamut,
    /// The space whose gamut is meant.
    pub space: RgbSpace,
}

/// Rounding of f32 pixels must not count as out of gamut.
const TOLERANCE: f32 = 1e-6;

impl GamutReport {
    /// And this pixel, whose development is `rgb`.
    pub(super) fn with(self, pixel: &Pixel, rgb: [f32; 3]) -> Self {
        let scale = rgb.iter().fold(1.0f32, |scale, c| scale.max(c.abs()));
        self.and(Self {
            pixels: 1,
            above_one: u64::from(rgb.iter().any(|c| *c > 1.0 + TOLERANCE)),
            negative: u64::from(rgb.iter().any(|c| *c < -TOLERANCE * scale)),
            rejected: u64::from(pixel.rejected()),
            overflow: u64::from(pixel.overflowed()),
            unsampled: u64::from(pixel.count() == 0),
            ..self
        })
    }

    /// Of both films, developed alike.
    pub(super) fn and(self, other: Self) -> Self {
        Self {
            pixels: self.pixels + other.pixels,
            above_one: self.above_one + other.above_one,
            negative: self.negative + other.negative,
            rejected: self.rejected + other.rejected,
            overflow: self.overflow + other.overflow,
            unsampled: self.unsampled + other.unsampled,
            ..self
        }
    }

    /// Whether a PNG shows every colour as it is.
    pub fn fits(&self) -> bool {
        self.above_one == 0 && self.negative == 0
    }

    /// What went wrong in rendering, one sentence each; empty if nothing did.
    pub fn warnings(&self) -> Vec<String> {
        let mut lines = Vec::new();
        let mut warn = |n: u64, one: &str, many: &str| match n {
            0 => {}
            1 => lines.push(format!("1 {one}")),
            n => lines.push(format!("{n} {many}")),
        };
        warn(
            self.rejected,
            "sample was not a finite number and was left out",
            "samples were not finite numbers and were left out",
        );
        warn(
            self.overflow,
            "pixel left the range of the film (9e12 cd/m² a sample) and is too dark",
            "pixels left the range of the film (9e12 cd/m² a sample) and are too dark",
        );
        warn(self.unsampled, "pixel has no samples and is black", "pixels have no samples and are black");
        lines
    }
}

impl fmt::Display for GamutReport {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let (above, outside, total, space) = (self.above_one, self.negative, self.pixels, title(self.space));
        if self.fits() {
            return write!(f, "all {total} pixels within display white and the {space} gamut");
        }
        let fate = match self.gamut {
            Gamut::Clip => "clipped",
            Gamut::PreserveChroma => "desaturated at equal luminance",
        };
        let share = percent(above, total);
        write!(
            f,
            "{above} of {total} pixels{share} brighter than display white, {outside} outside the {space} gamut; "
        )?;
        write!(f, "{fate} in the PNG, kept in the EXR")
    }
}

fn title(space: RgbSpace) -> &'static str {
    match space {
        RgbSpace::Srgb => "sRGB",
        RgbSpace::DisplayP3 => "Display P3",
        RgbSpace::Rec2020 => "Rec. 2020",
        RgbSpace::AcesCg => "ACEScg",
    }
}

fn percent(part: u64, total: u64) -> String {
    match 100.0 * part as f64 / total.max(1) as f64 {
        0.0 => String::new(),
        p if p < 0.01 => " (< 0.01 %)".into(),
        p => format!(" ({p:.2} %)"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const SRGB_LUMINANCE: [f64; 3] = [0.2126, 0.7152, 0.0722];

    fn luminance(rgb: [f64; 3]) -> f64 {
        (0..3).map(|i| rgb[i] * SRGB_LUMINANCE[i]).sum()
    }

    proptest! {
        #[test]
        fn mapping_keeps_hue_and_luminance(rgb: [f64; 3]) {
            // Any finite numbers to −1…3: around and far outside the cube.
            let rgb = rgb.map(|c| if c.is_finite() { libm::fmod(c.abs(), 4.0) - 1.0 } else { 0.5 });
            let (y, mapped) = (luminance(rgb), Gamut::PreserveChroma.map(rgb, SRGB_LUMINANCE));
            prop_assert!(mapped.iter().all(|c| (0.0..=1.0).contains(c)));
            prop_assert!((luminance(mapped) - y.clamp(0.0, 1.0)).abs() < 1e-12);
            // The same direction from grey: differences to grey stay in proportion.
            let (from, to) = (rgb.map(|c| c - y), mapped.map(|c| c - y));
            if (0.0..1.0).contains(&y) {
                for (i, j) in [(0, 1), (1, 2), (2, 0)] {
                    prop_assert!((from[i] * to[j] - from[j] * to[i]).abs() < 1e-12);
                }
            }
        }

        #[test]
        fn colours_inside_stay(rgb in [0.0..=1.0f64, 0.0..=1.0f64, 0.0..=1.0f64]) {
            prop_assert_eq!(Gamut::Clip.map(rgb, SRGB_LUMINANCE), rgb);
            prop_assert_eq!(Gamut::PreserveChroma.map(rgb, SRGB_LUMINANCE), rgb);
        }
    }

    #[test]
    fn the_report_reads_well() {
        let mut report = GamutReport { pixels: 614_400, gamut: Gamut::Clip, ..Default::default() };
        assert_eq!(report.to_string(), "all 614400 pixels within display white and the sRGB gamut");
        (report.above_one, report.negative) = (312, 41);
        assert_eq!(
            report.to_string(),
            "312 of 614400 pixels (0.05 %) brighter than display white, 41 outside the sRGB gamut; \
             clipped in the PNG, kept in the EXR"
        );
        (report.rejected, report.overflow) = (1, 2);
        assert_eq!(report.warnings().len(), 2);
    }
}
