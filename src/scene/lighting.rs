//! All light of a scene as one spectrum, and the wavelengths that see it best.

use super::resolve::{BRIGHTEST, surface};
use super::{Decision, Scene};
use crate::light::Environment;
use crate::spectrum::{Density, LUMENS_PER_WATT, Nodes, Spectrum, SpectrumId, luminance, tristimulus};

/// The visible density serves lights for which one set of wavelengths is off by no more than this (variance over squared mean).
///
/// A, D50…D75 and E: 0.0034 at most; LED-B1 and B2: 0.005 and 0.009; LED-B3…5: 0.04–0.07; FL1…FL12: 0.08–0.44; five lines of mercury: 84.
const SMOOTH: f64 = 0.01;

/// Lamps as bright as can be count this share of all light at least, others in proportion to their luminance.
///
/// Wavelengths to which a lamp adds little power are chosen rarely, and one that shows its line counts
/// for all those that do not: 16 times the lamp's luminance and more, which would leave the film's range.
/// A lamp with a share s of what is seen has s/2 of the wavelengths where it shines, so a sample of eight
/// is at most 3/(4 s) times its light in X, Y or Z: 2e11 for one of the brightest lamps, whose squares the
/// film holds 6000 times. A lamp of 1e6 cd/m² asks for a share of 5e-6 only.
const SHARE_OF_BRIGHTEST: f64 = 0.5;

/// How the wavelengths of a scene are chosen, and why.
pub fn wavelengths(scene: &Scene) -> (Density, Decision) {
    let part = "emission lines";
    let observer = &scene.picture.observer;
    let light = all_light(scene);
    let visible = Density::visible();
    let error = |density: &Density| Nodes::new(density).variance(&light, observer).sqrt() * 100.0;
    let before = error(&visible);
    let following = Density::following(&light, observer);
    if following.lines() == 0 && before * before <= SMOOTH * 1e4 {
        let reason = format!(
            "the lights are smooth: wavelengths follow the visible density, by which a single path is off by {before:.0} % on white"
        );
        return (visible, Decision { part, used: false, reason });
    }
    let what = match following.lines() {
        0 => "narrow bands".to_owned(),
        1 => "a line".to_owned(),
        count => format!("{count} lines"),
    };
    let after = error(&following);
    let reason = format!(
        "{what} in the lights: half of the wavelengths follow what is seen of them, so that a single path is off by {after:.0} % on white instead of {before:.0} %"
    );
    (following, Decision { part, used: true, reason })
}

/// The light of all lamps and the surroundings, each by its power, and not much less than by its luminance.
fn all_light(scene: &Scene) -> Spectrum {
    let mut sum = Sum { scene, parts: Vec::new() };
    for emitter in scene.lights.emitters() {
        sum.add(emitter.radiance, emitter.power);
    }
    let area = surface(&scene.world.bounds());
    match scene.lights.environment {
        // The light of a picture is among the emitters.
        Environment::Dark | Environment::Map(_) => {}
        Environment::Constant(id) => sum.add_around(id, area),
        Environment::Gradient { nadir, horizon, zenith } => {
            [nadir, horizon, zenith].into_iter().for_each(|id| sum.add_around(id, area / 3.0));
        }
    }
    sum.whole()
}

/// A weighted sum of spectra, each kind of lamp once.
struct Sum<'a> {
    scene: &'a Scene,
    parts: Vec<Part<'a>>,
}

struct Part<'a> {
    spectrum: &'a Spectrum,
    /// cd/m², of the spectrum as it is.
    luminance: f64,
    /// In the same measure, the mean of X, Y and Z, each over that of equal-energy white.
    seen: f64,
    /// By how much the spectrum is multiplied in the sum.
    factor: f64,
    /// By how much in the brightest lamp.
    brightest: f64,
}

impl<'a> Sum<'a> {
    /// Adds a spectrum at a luminous power.
    fn add(&mut self, id: SpectrumId, power: f64) {
        let brightness = self.scene.spectra.get(id).factor();
        let part = self.part(id);
        if part.luminance > 0.0 && power > 0.0 {
            part.factor += power / part.luminance;
            part.brightest = part.brightest.max(brightness);
        }
    }

    /// Adds a spectral radiance that comes through an area.
    fn add_around(&mut self, id: SpectrumId, area: f64) {
        let power = area * luminance(self.scene.spectra.get(id), &self.scene.picture.observer);
        self.add(id, power);
    }

    fn part(&mut self, id: SpectrumId) -> &mut Part<'a> {
        let spectrum = self.scene.spectra.get(id).unscaled();
        let known = self.parts.iter().position(|part| part.spectrum == spectrum);
        let index = known.unwrap_or_else(|| {
            let (luminance, seen) = self.brightness(spectrum);
            self.parts.push(Part { spectrum, luminance, seen, factor: 0.0, brightest: 0.0 });
            self.parts.len() - 1
        });
        &mut self.parts[index]
    }

    /// Returns the luminance of a spectral radiance and what is seen of it, cd/m².
    fn brightness(&self, spectrum: &Spectrum) -> (f64, f64) {
        let xyz = |spectrum| tristimulus(&[spectrum], &self.scene.picture.observer);
        let (of, white) = (xyz(spectrum), xyz(&Spectrum::Constant(1.0)));
        let mean = (0..3).map(|c| of[c] / white[c]).sum::<f64>() / 3.0;
        (LUMENS_PER_WATT * of[1], LUMENS_PER_WATT * white[1] * mean)
    }

    fn whole(self) -> Spectrum {
        let all: f64 = self.parts.iter().map(|part| part.factor * part.seen).sum();
        let share = SHARE_OF_BRIGHTEST * all / BRIGHTEST;
        let factor = |part: &Part| part.factor.max(part.brightest * share);
        Spectrum::Sum(self.parts.iter().map(|part| part.spectrum.clone().scaled(factor(part))).collect())
    }
}
