//! Where the data of a scene come from, and what a person should be warned of.

use super::Resolver;
use crate::scene::{DataSet, Surface};
use crate::spectrum::visible_nm;
use crate::spectrum::{About, ColorMatching, luminance};

/// A data set whose range leaves out more than this share of what the observer sees is warned of.
const UNCOVERED: f64 = 1e-3;

impl Resolver<'_> {
    pub fn warn_of_unused_materials(&mut self) {
        let unused = self.own_materials.keys().filter(|name| !self.used_materials.contains(*name));
        let unused: Vec<_> = unused.map(|name| format!("`{name}`")).collect();
        if !unused.is_empty() {
            self.warnings.push(format!("no object uses the material{} {}", plural(unused.len()), unused.join(", ")));
        }
    }

    /// Remembers where a value comes from, and warns where its data do not reach.
    pub fn note_data(&mut self, used_by: &str, about: &About) {
        if !self.noted.insert((used_by.to_owned(), about.name.clone())) {
            return;
        }
        for note in &about.notes {
            self.warnings.push(format!("`{}` ({used_by}): {note}", about.name));
        }
        let missing = about.range_nm.map_or(0.0, |range| share_outside(&self.observer_1931, range));
        if let (true, Some((first, last))) = (missing > UNCOVERED, about.range_nm) {
            self.warnings.push(format!(
                "`{}` ({used_by}) covers {first}–{last} nm: {:.1} % of what the eye sees lies outside, where its ends are held or its formula is extrapolated",
                about.name,
                missing * 100.0
            ));
        }
        self.data.push(DataSet { used_by: used_by.to_owned(), about: about.clone() });
    }

    pub fn warn_of_chromaticities(&mut self, file: &str) {
        self.warnings.push(format!("`{file}` states chromaticities that make no colours: taken for sRGB"));
    }

    pub fn warn_of_endless(&mut self, file: &str, count: usize, all: usize) {
        if count > 0 {
            self.warnings.push(format!(
                "`{file}`: {count} of {all} texels are infinite: they count as the largest value of the others"
            ));
        }
    }

    /// Lights of which nothing arrives.
    pub fn warn_of_lost_light(&mut self, points: bool, far_lights: bool) {
        if points && !self.surfaces.iter().any(Surface::scatters) {
            let warning =
                "point lights light nothing here: every surface is smooth, and smooth ones do not show a point";
            self.warnings.push(warning.into());
        }
        let around = &self.media[0];
        if far_lights && around.absorption.is_some() {
            let warning = "absorbs light and is everywhere: nothing arrives from the environment and the suns, which are infinitely far away";
            self.warnings.push(format!("`{}` {warning}", around.name));
        }
    }

    pub fn warn_of_darkness(&mut self) {
        if self
            .white_candidates
            .iter()
            .all(|&(power, id)| power == 0.0 && luminance(self.spectra.get(id), &self.observer_1931) == 0.0)
        {
            self.warnings.push("nothing in this scene shines: the picture will be black".into());
        }
    }
}

/// How much of what an observer sees lies outside a range of wavelengths, 0…1.
fn share_outside(observer: &ColorMatching, (first, last): (f64, f64)) -> f64 {
    let seen = |nm: f64| observer.at(nm).iter().sum::<f64>();
    let outside: f64 = visible_nm().filter(|nm| !(first..=last).contains(nm)).map(seen).sum();
    outside / visible_nm().map(seen).sum::<f64>()
}

fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}
