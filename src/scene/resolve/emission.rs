//! Lights: a spectrum and a strength become spectral radiance in W m⁻² sr⁻¹ nm⁻¹.

use super::{Resolver, half_diagonal, surface, vector};
use crate::geometry::Bounds;
use crate::light::{Emitter, Environment, Source, Sun};
use crate::scene::SceneError;
use crate::scene::describe::{self, LightSpectrum, OwnLight};
use crate::scene::numbers::Numbers;
use crate::spectrum::{
    Daylight, LAMBDA_MAX_NM, LAMBDA_MIN_NM, LUMENS_PER_WATT, Line, Outside, Spectrum, SpectrumId, Table, Xyz,
    integrate, luminance, tristimulus,
};
use std::ops::Range;
use toml::Spanned;

/// cd/m², of X, Y and Z alike. Single samples of a light with few wavelengths are brighter, and the film counts them up to 9e12.
pub const BRIGHTEST: f64 = 1e11;

/// Mean diameter of the sun from the earth, degrees.
const SUN_DEGREES: f64 = 0.533;

/// A light with the strength it was given.
pub struct Resolved {
    pub id: SpectrumId,
    /// cd/m².
    pub luminance: f64,
}

impl Resolver<'_> {
    /// The light all around shapes within these bounds; one that is aimed at is added to the emitters.
    pub fn environment(
        &mut self,
        environment: &describe::Environment,
        bounds: &Bounds,
        emitters: &mut Vec<Emitter>,
    ) -> Result<Environment, SceneError> {
        let area = surface(bounds);
        Ok(match environment {
            describe::Environment::Constant(emission) => {
                let light = self.emission(emission, "the environment")?;
                self.white_candidates.push((light.luminance * area, light.id));
                Environment::Constant(light.id)
            }
            describe::Environment::Gradient(gradient) => {
                let mut part = |emission, name| self.emission(emission, name);
                let zenith = part(&gradient.zenith, "the environment's zenith")?;
                let horizon = part(&gradient.horizon, "the environment's horizon")?;
                let nadir = part(&gradient.nadir, "the environment's nadir")?;
                for light in [&zenith, &horizon, &nadir] {
                    self.white_candidates.push((light.luminance * area / 3.0, light.id));
                }
                Environment::Gradient { nadir: nadir.id, horizon: horizon.id, zenith: zenith.id }
            }
            describe::Environment::Image(image) => {
                let surroundings = self.surroundings(image)?;
                self.white_candidates.push((surroundings.luminance * area, surroundings.map.light()));
                emitters.push(surroundings.emitter(half_diagonal(bounds)));
                Environment::Map(Box::new(surroundings.map))
            }
        })
    }

    /// A sun, and how much it matters beside the lights of a scene in a box of this half-diagonal.
    pub fn sun(&mut self, sun: &describe::SunLight, half_diagonal: f64) -> Result<Emitter, SceneError> {
        let angle = sun.angle.as_ref().map_or(Ok(SUN_DEGREES), |angle| self.positive(angle, "`angle`"))?;
        let place = sun.angle.as_ref().map_or(sun.direction.span(), Spanned::span);
        let toward = vector(sun.direction.get_ref().values());
        let Some(disk) = Sun::new(toward, angle.to_radians() / 2.0) else {
            let message = "a sun needs a direction other than zero and an angle between 0.0002° and 180°";
            return Err(self.text.error(&place, message));
        };
        let span = sun.spectrum.span();
        let (spectrum, _) = self.light_spectrum(sun.spectrum.get_ref(), &span, "the sun")?;
        let facing = disk.projected_solid_angle();
        let factor = match (&sun.illuminance, &sun.irradiance) {
            (Some(lux), None) => {
                self.factor("luminance", self.not_negative(lux, "illuminance")? / facing, &spectrum, &span)?
            }
            (None, Some(watts)) => {
                self.factor("radiance", self.not_negative(watts, "irradiance")? / facing, &spectrum, &span)?
            }
            (Some(_), Some(watts)) => {
                let message = "`illuminance` and `irradiance` both say how strong the sun is";
                return Err(self.text.error(&watts.span(), message));
            }
            (None, None) => {
                let help = "give `illuminance` in lx (the sun at noon: 100000) or `irradiance` in W m⁻²";
                return Err(self.text.error(&span, "how strong is the sun?").help(help));
            }
        };
        let light = self.scaled(spectrum, factor, &span, "cd/m²")?;
        // Light through the cross-section of the scene, over the π that a lamp's power lacks too.
        let power = light.luminance * facing * half_diagonal * half_diagonal;
        self.white_candidates.push((power, light.id));
        Ok(Emitter { source: Source::Sun(disk), radiance: light.id, power })
    }

    /// Spectral radiance of a light, checked and scaled.
    pub fn emission(&mut self, emission: &describe::Emission, used_by: &str) -> Result<Resolved, SceneError> {
        let span = emission.spectrum.span();
        let (spectrum, absolute) = self.light_spectrum(emission.spectrum.get_ref(), &span, used_by)?;
        let factor = self.strength(emission, &spectrum, absolute, &span)?;
        self.scaled(spectrum, factor, &span, "cd/m²")
    }

    /// `unit`: of what the luminance counts.
    pub fn scaled(
        &mut self,
        spectrum: Spectrum,
        factor: f64,
        span: &Range<usize>,
        unit: &str,
    ) -> Result<Resolved, SceneError> {
        let spectrum = spectrum.scaled(factor);
        let xyz = tristimulus(&[&spectrum], &self.observer_1931).map(|value| LUMENS_PER_WATT * value);
        self.check_luminance(xyz, span, unit)?;
        let luminance = xyz[1];
        Ok(Resolved { id: self.spectra.add(spectrum), luminance })
    }

    fn check_luminance(&self, xyz: Xyz, span: &Range<usize>, unit: &str) -> Result<(), SceneError> {
        let [_, luminance, _] = xyz;
        if !(0.0..=BRIGHTEST).contains(&luminance) {
            let message = format!(
                "this light has {luminance:.2e} {unit}: it can have up to {BRIGHTEST:e} (the sun's disc has 1.6e9 cd/m²)"
            );
            return Err(self.text.error(span, message));
        }
        let largest = xyz.into_iter().fold(0.0, f64::max);
        if largest > BRIGHTEST {
            let message = format!(
                "this light has {luminance:.2e} {unit}, and X or Z of {largest:.2e} in the same measure: each can be up to {BRIGHTEST:e}"
            );
            return Err(self.text.error(span, message));
        }
        Ok(())
    }

    /// The spectrum, and whether its values are already radiance.
    pub fn light_spectrum(
        &mut self,
        source: &LightSpectrum,
        span: &Range<usize>,
        used_by: &str,
    ) -> Result<(Spectrum, bool), SceneError> {
        let own = match source {
            LightSpectrum::Name(name) => {
                let found = self.library.light(name, self.text.base()).map_err(|error| self.text.error(span, error))?;
                self.note_data(used_by, &found.about);
                return Ok((found.spectrum.clone(), false));
            }
            LightSpectrum::Own(own) => own,
        };
        Ok(match own {
            OwnLight::Blackbody(kelvin) => {
                let value = self.positive(kelvin, "`blackbody`")?;
                (Spectrum::Blackbody { kelvin: value }, true)
            }
            OwnLight::Daylight(kelvin) => {
                let daylight =
                    Daylight::new(*kelvin.get_ref()).map_err(|error| self.text.error(&kelvin.span(), error))?;
                (Spectrum::Daylight(daylight), false)
            }
            OwnLight::Table(table) => (self.own_table(table, span)?, false),
            OwnLight::Lines(lines) => (self.lines(lines)?, false),
        })
    }

    fn own_table(&self, table: &describe::OwnTable, span: &Range<usize>) -> Result<Spectrum, SceneError> {
        let (nm, value) = (&table.wavelength_nm, &table.value);
        if nm.len() != value.len() || nm.len() < 2 {
            let message =
                format!("{} wavelengths and {} values: a table needs at least two pairs", nm.len(), value.len());
            return Err(self.text.error(span, message));
        }
        for number in nm {
            self.not_negative(number, "wavelength_nm")?;
        }
        for number in value {
            self.not_negative(number, "value")?;
        }
        if let Some([before, after]) = nm.array_windows().find(|[before, after]| before.get_ref() >= after.get_ref()) {
            let message =
                format!("wavelengths must grow: {} nm is followed by {} nm", before.get_ref(), after.get_ref());
            return Err(self.text.error(&after.span(), message));
        }
        let points: Vec<_> = nm.iter().zip(value).map(|(nm, value)| (*nm.get_ref(), *value.get_ref())).collect();
        Ok(Spectrum::Table(Table::from_points(&points, Outside::Zero)))
    }

    fn lines(&self, lines: &[Spanned<Numbers<2>>]) -> Result<Spectrum, SceneError> {
        let line = |line: &Spanned<Numbers<2>>| {
            let [nm, power] = line.get_ref().values();
            if (LAMBDA_MIN_NM..=LAMBDA_MAX_NM).contains(&nm) && power > 0.0 {
                return Ok(Line { nm, power });
            }
            let message =
                format!("a line of power {power} at {nm} nm: lines lie in 360–830 nm and have a power above 0");
            Err(self.text.error(&line.span(), message))
        };
        lines.iter().map(line).collect::<Result<_, _>>().map(Spectrum::Lines)
    }

    /// The factor that gives a spectrum the strength asked for.
    fn strength(
        &self,
        emission: &describe::Emission,
        spectrum: &Spectrum,
        absolute: bool,
        span: &Range<usize>,
    ) -> Result<f64, SceneError> {
        let given = [("luminance", &emission.luminance), ("radiance", &emission.radiance), ("scale", &emission.scale)];
        let mut given = given.iter().filter_map(|(name, value)| value.as_ref().map(|value| (*name, value)));
        let Some((name, number)) = given.next() else {
            if absolute {
                return Ok(1.0);
            }
            let message = "this spectrum is relative: how strong is it?";
            return Err(self.text.error(span, message).help("give `luminance` in cd/m² or `radiance` in W m⁻² sr⁻¹"));
        };
        if let Some((other, second)) = given.next() {
            return Err(self
                .text
                .error(&second.span(), format!("`{name}` and `{other}` both say how strong the light is")));
        }
        let value = self.not_negative(number, name)?;
        if name == "scale" { Ok(value) } else { self.factor(name, value, spectrum, span) }
    }

    /// The factor that gives a spectrum a luminance or a radiance.
    pub fn factor(&self, name: &str, value: f64, spectrum: &Spectrum, span: &Range<usize>) -> Result<f64, SceneError> {
        let own = match name {
            "luminance" => luminance(spectrum, &self.observer_1931),
            _ => integrate(&[spectrum]),
        };
        if own > 0.0 {
            return Ok(value / own);
        }
        Err(self.text.error(span, format!("this spectrum has no light in 360–830 nm, so no factor gives it a {name}")))
    }
}
