//! Materials: names become data sets, data sets become spectra of the scene.

use super::Resolver;
use super::trade::traded;
use crate::fresnel::FresnelModel;
use crate::fresnel::absorbing::LEAST_K;
use crate::scene::materials::{
    AbsorptionSource, Conductor, Dielectric, Diffuse, IndexSource, Kind, KindError, Material, ReflectanceSource,
    RoughnessSource,
};
use crate::scene::numbers::short;
use crate::scene::{Interface, Matt, Medium, MediumId, Metal, Pattern, RgbColors, SceneError, Surface, Text};
use crate::spectrum::visible_nm;
use crate::spectrum::{
    Adaptation, Colorimeter, HELIUM_D_NM, Ior, Library, Quantity, RgbSpace, Spectrum, SpectrumError, Upsampler,
    nearest, srgb_primaries,
};
use std::fmt::Display;
use std::ops::{Range, RangeInclusive};
use std::path::Path;
use std::sync::Arc;
use toml::Spanned;

/// A material's description with the text it stands in, so that its errors point there.
struct Described {
    name: String,
    /// What the scene calls it, which is another name if the command line replaced it.
    asked: String,
    text: Text,
    material: Arc<Material>,
    span: Range<usize>,
    /// Where the scene asks for it.
    asked_at: Range<usize>,
}

/// Indices that single precision computes with; in the visible, metals and stones are within 0.01 … 20.
const N_RANGE: RangeInclusive<f64> = 1e-6..=1e6;
const K_RANGE: RangeInclusive<f64> = 0.0..=1e6;

/// A medium of this k is opaque like a metal: at 0.1 light is down to a tenth after a micrometre.
const OPAQUE_K: f64 = 0.1;

impl Resolver<'_> {
    /// The surface of a material by its name in this scene or in the library.
    pub fn material(&mut self, name: &Spanned<String>) -> Result<u32, SceneError> {
        if let Some(&known) = self.by_name.get(name.get_ref()) {
            return Ok(known);
        }
        let described = self.described(name)?;
        let mut pattern = Pattern::default();
        let surface = self.surface(&described, &mut pattern)?;
        self.surfaces.push(surface);
        let index = self.surfaces.len() as u32 - 1;
        if pattern != Pattern::default() {
            self.patterns.insert(index, pattern);
        }
        self.by_name.insert(name.get_ref().clone(), index);
        Ok(index)
    }

    /// The medium around everything, by the name of a dielectric.
    pub fn outside(&mut self, name: &Spanned<String>) -> Result<(), SceneError> {
        let described = self.described(name)?;
        let Ok(Kind::Dielectric(dielectric)) = described.material.kind() else {
            let message =
                format!("`{}` is no dielectric: what surrounds a scene must let light through", name.get_ref());
            return Err(self.text.error(&name.span(), message));
        };
        self.media[0] = self.medium(&described, dielectric)?;
        self.outside_name = Some(name.get_ref().clone());
        Ok(())
    }

    fn described(&mut self, name: &Spanned<String>) -> Result<Described, SceneError> {
        let asked = name.get_ref();
        // Replaced, a material of the scene is used all the same: it is no oversight.
        self.used_materials.insert(asked.clone());
        let wanted = &self.substitutes.material(asked).to_owned();
        if let Some((material, span)) = self.own_materials.get(wanted).cloned() {
            self.used_materials.insert(wanted.clone());
            return Ok(Described {
                name: wanted.clone(),
                asked: asked.clone(),
                text: self.text.clone(),
                material,
                span,
                asked_at: name.span(),
            });
        }
        let found = self.library.material(wanted).map_err(|error| self.unknown_material(name, error))?;
        let text = Text::new(found.origin, found.text);
        let material = Arc::new(text.parse()?);
        self.sources.push(text.clone());
        let (name, asked, asked_at) = (wanted.clone(), asked.clone(), name.span());
        Ok(Described { name, asked, text, material, span: 0..0, asked_at })
    }

    fn unknown_material(&self, name: &Spanned<String>, error: SpectrumError) -> SceneError {
        let (asked, wanted) = (name.get_ref(), self.substitutes.material(name.get_ref()));
        if Library::is_file_name(wanted) || self.text.base().join(wanted).is_file() {
            let message = format!("`{wanted}` is a file: no material, but data that one can name");
            let help = format!("write a material: [materials.mine.conductor] (or dielectric) with ior = \"{wanted}\"");
            return self.text.error(&name.span(), message).help(help);
        }
        let traded = traded(wanted);
        let error = match error {
            SpectrumError::UnknownMaterial { name, .. } if traded.is_some() => {
                SpectrumError::UnknownMaterial { name, suggestion: None }
            }
            SpectrumError::UnknownMaterial { name, suggestion } => {
                let known = self.own_materials.keys().map(String::as_str).chain(suggestion.as_deref());
                let suggestion = nearest(wanted, known).map(str::to_owned);
                SpectrumError::UnknownMaterial { name, suggestion }
            }
            other => other,
        };
        let error = match self.substitutes.is_replaced(asked) {
            true => SceneError::new(format!("--vary {asked}={wanted}: {error}")),
            false => self.text.error(&name.span(), error),
        };
        error.maybe_help(traded)
    }

    /// A material's name where that of a data set is asked for is told with the data set that the material has.
    fn unknown_index(&self, name: &str, error: SpectrumError) -> SceneError {
        let own = |material: &Material| match material.data()? {
            (Quantity::Ior, name) => Some(name.to_owned()),
            _ => None,
        };
        let by_library = || {
            let found = self.library.material(name).ok()?;
            own(&Text::new(found.origin, found.text).parse().ok()?)
        };
        let set = match self.own_materials.get(name) {
            Some((material, _)) => own(material),
            None => by_library(),
        };
        match (error, set) {
            (SpectrumError::UnknownData { quantity, name, .. }, Some(set)) => {
                let help = format!("`{name}` is a material: its data set is `{set}`");
                SceneError::new(SpectrumError::UnknownData { quantity, name, suggestion: None }).help(help)
            }
            (error, _) => SceneError::new(error),
        }
    }

    fn surface(&mut self, described: &Described, pattern: &mut Pattern) -> Result<Surface, SceneError> {
        let Described { material, text, span, .. } = described;
        match material.kind() {
            Ok(Kind::Conductor(conductor)) => self.conductor(described, conductor, pattern),
            Ok(Kind::Dielectric(dielectric)) => {
                let medium = self.medium(described, dielectric)?;
                let medium = self.add_medium(medium, described)?;
                let alpha = self.roughness(text, &dielectric.roughness, &dielectric.perceptual_roughness, pattern)?;
                Ok(Surface::Dielectric(Interface { medium, alpha, model: self.model(dielectric.fresnel) }))
            }
            Ok(Kind::Diffuse(diffuse)) => {
                self.refuse_index(&described.asked, "diffuse")?;
                self.diffuse(described, diffuse, pattern)
            }
            Err(fault) => {
                let error = text.error(span, format!("material `{}` is {fault}", described.name));
                let kinds = "give it one of [conductor], [dielectric], [diffuse]";
                Err(if fault == KindError::None { error.help(kinds) } else { error })
            }
        }
    }

    fn add_medium(&mut self, medium: Medium, described: &Described) -> Result<MediumId, SceneError> {
        // In water, a solid of water is not there.
        if self.outside_name.as_ref() == Some(&described.name) {
            return Ok(MediumId::OUTSIDE);
        }
        let Ok(id) = u16::try_from(self.media.len()) else {
            return Err(self.text.error(&described.asked_at, format!("more than {} dielectric materials", u16::MAX)));
        };
        self.media.push(medium);
        Ok(MediumId(id))
    }

    /// The render's model wins over the material's, so that models can be compared by one word.
    fn model(&self, own: Option<FresnelModel>) -> FresnelModel {
        self.fresnel.or(own).unwrap_or(FresnelModel::EXACT)
    }

    /// A metal's model; some are made for dielectrics alone.
    fn metal_model(
        &self,
        described: &Described,
        own: &Option<Spanned<FresnelModel>>,
    ) -> Result<FresnelModel, SceneError> {
        let model = self.model(own.as_ref().map(|own| *own.get_ref()));
        if !model.dielectrics_only() {
            return Ok(model);
        }
        let message = format!(
            "the Fresnel model `{model}` does not apply to `{}`: it is for dielectrics, and this is a conductor",
            described.name
        );
        Err(match (self.fresnel, own) {
            (None, Some(own)) => described.text.error(&own.span(), message),
            _ => self.text.error(&described.asked_at, message),
        })
    }

    /// What RGB models need, if there are any.
    pub fn rgb_colors(&mut self) -> Result<Option<RgbColors>, SceneError> {
        let in_rgb = |surface: &Surface| matches!(surface.model(), Some(FresnelModel::Rgb(_)));
        if !self.surfaces.iter().any(in_rgb) {
            return Ok(None);
        }
        let d65 = self.library.illuminant("D65", Path::new(""))?;
        let meter = Colorimeter::new(&d65.spectrum, &self.observer_1931, RgbSpace::Srgb, Adaptation::Bradford)?;
        let primaries = srgb_primaries(self.library)?.map(|primary| self.spectra.add(primary));
        Ok(Some(RgbColors { meter, primaries }))
    }

    fn conductor(
        &mut self,
        described: &Described,
        conductor: &Conductor,
        pattern: &mut Pattern,
    ) -> Result<Surface, SceneError> {
        let ior = self.ior(described, &conductor.ior)?;
        self.warn_of_odd_metal(described, conductor.ior.get_ref(), &ior);
        let (text, words) = (&described.text, [&conductor.roughness, &conductor.perceptual_roughness]);
        let alpha = self.roughness(text, words[0], words[1], pattern)?;
        Ok(Surface::Conductor(Metal {
            n: self.spectra.add(ior.n.clone()),
            k: self.spectra.add(ior.k.clone()),
            alpha,
            model: self.metal_model(described, &conductor.fresnel)?,
        }))
    }

    /// Tells of numbers that are possible and no metal's. Data sets of the library are what they are.
    fn warn_of_odd_metal(&mut self, described: &Described, source: &IndexSource, ior: &Ior) {
        let own = match source {
            IndexSource::Constant { .. } | IndexSource::Own(_) => true,
            IndexSource::Name(name) => described.text.base().join(name).is_file(),
        };
        let name = &described.name;
        if !own || self.substitutes.index(&described.asked).is_some() {
            return;
        }
        if visible_nm().all(|nm| ior.k.at(nm) == 0.0) {
            self.warnings.push(format!(
                "`{name}` is a conductor whose k is 0: it reflects as glass does, and what enters is lost; what is clear is a [dielectric]"
            ));
        } else if visible_nm().all(|nm| ior.n.at(nm) > ior.k.at(nm)) {
            self.warnings.push(format!(
                "`{name}`: n is above k at all wavelengths, as of few metals (tungsten, molybdenum) and no noble one: are n and k exchanged?"
            ));
        }
    }

    fn ior(&mut self, described: &Described, source: &Spanned<IndexSource>) -> Result<Arc<Ior>, SceneError> {
        let error = |message: &dyn Display| described.text.error(&source.span(), message);
        if let Some(ior) = self.substitute_index(&described.asked, &described.name)? {
            let fault = |fault| SceneError::new(format!("--ior {}={}: {fault}", described.asked, ior.about.name));
            return index_fault(&ior).map_or(Ok(ior.clone()), |found| Err(fault(found)));
        }
        let ior = match source.get_ref() {
            IndexSource::Name(name) => {
                let found = self.library.ior(name, described.text.base()).map_err(|fault| {
                    let SceneError { message, help, .. } = self.unknown_index(name, fault);
                    error(&message).maybe_help(help)
                })?;
                self.note_data(&described.name, &found.about);
                found
            }
            &IndexSource::Constant { n, k } => Arc::new(Ior::constant(&described.name, n, k)),
            IndexSource::Own(own) => {
                let ior = own.ior(&described.name).map_err(|fault| error(&fault))?;
                self.note_data(&described.name, &ior.about);
                Arc::new(ior)
            }
        };
        match index_fault(&ior) {
            Some(fault) => Err(error(&fault)),
            None => Ok(ior),
        }
    }

    fn medium(&mut self, described: &Described, dielectric: &Dielectric) -> Result<Medium, SceneError> {
        let source = &dielectric.ior;
        let ior = self.ior(described, source)?;
        let absorption = match &dielectric.absorption {
            Some(absorption) => self.absorption(described, absorption)?,
            None => visible_nm().any(|nm| ior.k.at(nm) > 0.0).then(|| ior.k.absorption_from_k()),
        };
        let k = match &absorption {
            Some(per_metre) if dielectric.absorption.is_some() => per_metre.k_from_absorption(),
            Some(_) => ior.k.clone(),
            None => Spectrum::Constant(0.0),
        };
        let largest_k = visible_nm().map(|nm| k.at(nm)).fold(0.0, f64::max);
        if largest_k > OPAQUE_K {
            self.warnings.push(format!(
                "`{}` is a dielectric of k up to {}: it is as good as opaque, and `conductor` says the same of what it \
                 reflects, at less cost",
                described.name,
                short(largest_k)
            ));
        }
        let k = (largest_k > LEAST_K).then(|| self.spectra.add(k));
        let absorption = match absorption {
            None => None,
            Some(per_metre) => {
                let metres = self.meters_per_unit.ok_or_else(|| self.needs_scale(described))?;
                let per_unit = per_metre.scaled(metres);
                if visible_nm().any(|nm| !(per_unit.at(nm) as f32).is_finite()) {
                    let message =
                        format!("`{}` absorbs more in one scene unit than can be computed with", described.name);
                    return Err(self.text.error(&described.asked_at, message).help("is `meters_per_unit` right?"));
                }
                Some(self.spectra.add(per_unit))
            }
        };
        let n = if self.without_dispersion { Spectrum::Constant(ior.n.at(HELIUM_D_NM)) } else { ior.n.clone() };
        let dispersive = !is_constant(&n);
        Ok(Medium { name: described.name.clone(), n: self.spectra.add(n), absorption, k, dispersive })
    }

    fn needs_scale(&self, described: &Described) -> SceneError {
        let message = format!("`{}` absorbs light, so the scene must say how large it is", described.name);
        self.text
            .error(&described.asked_at, message)
            .help("add `meters_per_unit = …` at the top, 0.001 if the scene is in millimetres")
    }

    /// In m⁻¹; `None` where nothing is absorbed.
    fn absorption(
        &mut self,
        described: &Described,
        source: &Spanned<AbsorptionSource>,
    ) -> Result<Option<Spectrum>, SceneError> {
        let text = &described.text;
        match source.get_ref() {
            AbsorptionSource::Name(name) => {
                let found =
                    self.library.absorption(name, text.base()).map_err(|error| text.error(&source.span(), error))?;
                self.note_data(&described.name, &found.about);
                Ok(Some(found.spectrum.clone()))
            }
            &AbsorptionSource::PerMetre(value) if value.is_finite() && value >= 0.0 => {
                Ok((value > 0.0).then_some(Spectrum::Constant(value)))
            }
            AbsorptionSource::PerMetre(value) => Err(text.error(
                &source.span(),
                format!("an absorption coefficient of {value} 1/m: it must be finite and not negative"),
            )),
        }
    }

    fn diffuse(
        &mut self,
        described: &Described,
        diffuse: &Diffuse,
        pattern: &mut Pattern,
    ) -> Result<Surface, SceneError> {
        let (text, source) = (&described.text, &diffuse.reflectance);
        let spectrum = match source.get_ref() {
            ReflectanceSource::Name(name) => {
                let found =
                    self.library.reflectance(name, text.base()).map_err(|error| text.error(&source.span(), error))?;
                self.note_data(&described.name, &found.about);
                found.spectrum.clone()
            }
            &ReflectanceSource::Constant(value) if (0.0..=1.0).contains(&value) => Spectrum::Constant(value),
            ReflectanceSource::Constant(value) => {
                return Err(text.error(&source.span(), format!("a reflectance of {value}: it lies between 0 and 1")));
            }
            &ReflectanceSource::Rgb(rgb) => {
                Upsampler::new(self.library)?.reflectance(rgb).map_err(|error| text.error(&source.span(), error))?
            }
            ReflectanceSource::Image(texture) => {
                pattern.reflectance = Some(self.reflectances(text, texture)?);
                pattern.files.push(texture.image.get_ref().clone());
                // Taken by nothing.
                Spectrum::Constant(0.0)
            }
        };
        Ok(Surface::Diffuse(Matt { reflectance: self.spectra.add(spectrum) }))
    }

    /// GGX α from either of the two words for it; of a picture, the largest.
    fn roughness(
        &mut self,
        text: &Text,
        alpha: &Option<Spanned<RoughnessSource>>,
        perceptual: &Option<Spanned<RoughnessSource>>,
        pattern: &mut Pattern,
    ) -> Result<f32, SceneError> {
        let (source, name) = match (alpha, perceptual) {
            (None, None) => return Ok(0.0),
            (Some(alpha), None) => (alpha, "roughness"),
            (None, Some(r)) => (r, "perceptual_roughness"),
            (Some(_), Some(r)) => {
                let message = "`roughness` and `perceptual_roughness` both say how rough the surface is";
                return Err(text
                    .error(&r.span(), message)
                    .help("`roughness` is α itself; `perceptual_roughness` r means α = r²"));
            }
        };
        let of = |value: f64| if name == "roughness" { value } else { value * value };
        match source.get_ref() {
            &RoughnessSource::Constant(value) if (0.0..=1.0).contains(&value) => Ok(of(value) as f32),
            RoughnessSource::Constant(value) => {
                Err(text.error(&source.span(), format!("`{name}` is {value}: it lies between 0 and 1")))
            }
            RoughnessSource::Image(texture) => {
                let alphas = self.data_texels(text, texture)?.map(|value| of(f64::from(value)) as f32);
                let largest = alphas.all().iter().copied().fold(0.0, f32::max);
                pattern.alpha = Some(alphas);
                pattern.files.push(texture.image.get_ref().clone());
                Ok(largest)
            }
        }
    }
}

/// What is wrong with an index: a constant, or data with a formula that does not hold over the whole visible.
fn index_fault(ior: &Ior) -> Option<String> {
    visible_nm().find_map(|nm| {
        let (n, k) = ior.at(nm);
        let (name, value, range) = match (N_RANGE.contains(&n), K_RANGE.contains(&k)) {
            (true, true) => return None,
            (false, _) => ("n", n, N_RANGE),
            (true, false) => ("k", k, K_RANGE),
        };
        let at = if is_constant(&ior.n) && is_constant(&ior.k) { String::new() } else { format!(" at {nm} nm") };
        let [value, low, high] = [value, *range.start(), *range.end()].map(short);
        Some(format!("{name} is {value}{at}: it must lie between {low} and {high}"))
    })
}

/// Whether a spectrum is the same at every wavelength; tables of one value are.
fn is_constant(spectrum: &Spectrum) -> bool {
    let mut values = visible_nm().map(|nm| spectrum.at(nm).to_bits());
    let first = values.next();
    values.all(|value| Some(value) == first)
}
