//! What came of a comparison: developed, measured, written.

use super::CompareArgs;
use super::interfaces::{curves, nanoseconds};
use super::replicates::{Rendered, Replication};
use super::variants::Variant;
use crate::cli::{picture, show};
use crate::film::Unseen;
use crate::film::View;
use crate::film::{Develop, Developed, Exposure};
use crate::image::{self, Format, Metadata, Options, png};
use crate::report::colormap::{DELTA_E, LUMINANCE, Scale};
use crate::report::comparison::{self, Comparison, Data, Files, HTML_FILE, JSON_FILE, Pictures, Settings};
use crate::report::difference::{Compared, Image, compare, noise};
use crate::report::{Difference, Verdict, markup};
use crate::scene::{Chance, Needs, Scene, SceneError, Text};
use rayon::prelude::*;
use std::time::Instant;

pub struct Outcome<'a> {
    pub args: &'a CompareArgs,
    pub text: &'a Text,
    pub variants: &'a [Variant],
    pub scenes: &'a [Scene],
    /// What determines each scene, as it was before the render.
    pub identities: &'a [u64],
    pub replication: &'a Replication,
    pub rendered: &'a [Rendered],
}

/// The report and the pictures beside it.
pub struct Report {
    comparison: Comparison,
    pictures: Vec<Pictures>,
    /// EXR files.
    exr: Vec<Vec<u8>>,
}

impl Outcome<'_> {
    /// Compares every variant with the first one, in the exposure and white of the first one.
    pub fn compare(&self, rendering_seconds: f64, interrupted: bool) -> Result<Report, SceneError> {
        let started = Instant::now();
        let developed = self.develop()?;
        let first = &developed[0];
        let (view, reference) = (View::new(first.ev, first.white), self.replicates(0));
        let chance = self.chance();
        let unseen = self.unseen(&view, &chance);
        let compared: Vec<_> =
            (1..self.variants.len()).map(|i| compare(&view, reference, self.replicates(i), &unseen)).collect();
        let encode = |i: usize| self.encode(i, &developed[i], i.checked_sub(1).map(|before| &compared[before]));
        let files = (0..developed.len()).into_par_iter().map(encode).collect::<Result<Vec<_>, _>>()?;
        let (pictures, exr) = files.into_iter().unzip();
        let data = show::data_sets(self.scenes.iter().flat_map(|scene| &scene.data));
        let mut comparison = Comparison {
            version: env!("CARGO_PKG_VERSION").into(),
            scene: self.text.path.display().to_string(),
            settings: self.settings(first),
            variants: self.variants(&compared),
            reference_noise: noise(&view, reference),
            rendering_seconds,
            report_seconds: 0.0,
            interrupted,
            data: data.into_iter().map(|(about, used_by)| Data::new(about, used_by)).collect(),
            curves: curves(self.scenes, &self.labels()),
            by_chance: chance.way,
        };
        comparison.report_seconds = started.elapsed().as_secs_f64();
        Ok(Report { comparison, pictures, exr })
    }

    /// Names and contents of all files.
    pub fn files(&self, report: &Report) -> Result<Vec<(String, Vec<u8>)>, SceneError> {
        let Report { comparison, pictures, exr } = report;
        let json = markup::json(comparison).map_err(SceneError::new)?;
        let page = comparison::page(comparison, pictures).map_err(SceneError::new)?;
        let mut files = vec![(JSON_FILE.to_owned(), json.into_bytes()), (HTML_FILE.to_owned(), page.into_bytes())];
        for ((variant, pictures), exr) in comparison.variants.iter().zip(pictures).zip(exr) {
            files.push((variant.files.png.clone(), pictures.picture.clone()));
            files.push((variant.files.exr.clone(), exr.clone()));
            let maps =
                [(&variant.files.delta_e_png, &pictures.delta_e), (&variant.files.luminance_png, &pictures.luminance)];
            for (name, map) in maps {
                files.extend(name.clone().zip(map.clone()));
            }
        }
        Ok(files)
    }

    /// What a person wants to know at once; `seconds` is what all but the renders took.
    pub fn tell(&self, report: &Report, seconds: f64) -> Result<(), SceneError> {
        if self.args.quiet {
            return Ok(());
        }
        let comparison = &report.comparison;
        let names = ["variant", "render s", "ns", "mean ΔE", "95 % interval", "noise ΔE", "max ΔE", "energy %", ""];
        show::answer(show::table(names, comparison.variants.iter().map(row)))?;
        let unsure = |variant: &comparison::Variant| variant.difference.as_ref().is_some_and(Difference::may_miss_much);
        if comparison.variants.iter().any(unsure) {
            show::warning(format_args!(
                "paths may have missed light that matters, which makes intervals wide: {}",
                comparison.by_chance
            ));
        }
        let rendering = comparison.rendering_seconds;
        show::note(format_args!(
            "rendering {rendering:.1} s, report {seconds:.2} s ({:.1} %)",
            100.0 * seconds / rendering
        ));
        show::note(format_args!("wrote {}", self.args.folder().join(HTML_FILE).display()));
        Ok(())
    }

    /// The brightest light that any of the variants may not have found.
    fn chance(&self) -> Chance {
        let of = |scene: &Scene| Needs::of(scene).chance;
        self.scenes.iter().map(of).reduce(Chance::brighter).unwrap_or_default()
    }

    fn unseen(&self, view: &View, chance: &Chance) -> Unseen {
        let film = &self.rendered[0].film;
        let pixels = film.pixels().len() as f64;
        let brightest = view.display_f64(chance.brightest);
        Unseen { brightest, samples: film.samples() as f64 / pixels, pixels }
    }

    fn replicates(&self, variant: usize) -> &[Image] {
        &self.rendered[variant].replicates
    }

    fn labels(&self) -> Vec<String> {
        self.variants.iter().map(|variant| variant.label.clone()).collect()
    }

    fn develop(&self) -> Result<Vec<Developed>, SceneError> {
        let development = picture::development(&self.scenes[0]);
        let first = self.rendered[0].film.develop(&development).map_err(SceneError::new)?;
        let same = Develop { exposure: Exposure::Ev(first.ev), ..development };
        let others =
            self.rendered[1..].par_iter().map(|rendered| rendered.film.develop(&same).map_err(SceneError::new));
        let others = others.collect::<Result<Vec<_>, _>>()?;
        let all: Vec<_> = std::iter::once(first).chain(others).collect();
        let mut warnings: Vec<_> = all.iter().flat_map(|developed| developed.report.warnings()).collect();
        warnings.dedup();
        warnings.iter().for_each(show::warning);
        Ok(all)
    }

    fn encode(
        &self,
        variant: usize,
        developed: &Developed,
        compared: Option<&Compared>,
    ) -> Result<(Pictures, Vec<u8>), SceneError> {
        let metadata = self.metadata(variant, developed);
        let file = |format| {
            let encoded = image::encode(format, developed, &Options::default(), &metadata).map_err(SceneError::new)?;
            Ok::<_, SceneError>(encoded.bytes)
        };
        let map = |scale: Scale, values: &[f32]| {
            png::encode_srgb8(developed.width(), developed.height(), &scale.paint(values)).map_err(SceneError::new)
        };
        let pictures = Pictures {
            picture: file(Format::Png)?,
            delta_e: compared.map(|compared| map(DELTA_E, &compared.delta_e)).transpose()?,
            luminance: compared.map(|compared| map(LUMINANCE, &compared.luminance)).transpose()?,
        };
        Ok((pictures, file(Format::Exr)?))
    }

    /// As of any render, but that its seeds are several.
    fn metadata(&self, variant: usize, developed: &Developed) -> Metadata {
        let (scene, rendered) = (&self.scenes[variant], &self.rendered[variant]);
        picture::metadata(scene, self.identities[variant], &rendered.film, developed)
            .with("seed", self.replication.seed)
            .with("replicates", rendered.replicates.len())
    }

    fn settings(&self, first: &Developed) -> Settings {
        let (scene, rendered) = (&self.scenes[0], &self.rendered[0]);
        let replicates = rendered.replicates.len();
        Settings {
            command: self.args.command(self.variants, scene, self.replication),
            width: scene.settings.width,
            height: scene.settings.height,
            samples: u64::from(self.replication.samples) * replicates as u64,
            seed: self.replication.seed,
            replicate_seeds: self.replication.seeds[..replicates].to_vec(),
            exposure_ev: first.ev,
            white_balance: scene.picture.white_balance.clone(),
            observer: scene.picture.observer.about.name.clone(),
            threads: rayon::current_num_threads(),
        }
    }

    fn variants(&self, compared: &[Compared]) -> Vec<comparison::Variant> {
        let of = |(i, variant): (usize, &Variant)| comparison::Variant {
            id: variant.id.clone(),
            label: variant.label.clone(),
            model: variant.model.name().into(),
            vary: variant.vary.clone(),
            ior: variant.ior.clone(),
            render_seconds: self.rendered[i].seconds,
            ns_per_evaluation: nanoseconds(&self.scenes[i]),
            difference: i.checked_sub(1).map(|before| compared[before].difference.clone()),
            files: Files::new(&variant.id, i == 0),
        };
        self.variants.iter().enumerate().map(of).collect()
    }
}

/// A line of the table.
fn row(variant: &comparison::Variant) -> [String; 9] {
    let seconds = format!("{:.2}", variant.render_seconds);
    let ns = variant.ns_per_evaluation.map_or(String::new(), |ns| format!("{ns:.1}"));
    let Some(difference) = &variant.difference else {
        let empty = || String::new();
        return [variant.label.clone(), seconds, ns, empty(), empty(), empty(), empty(), empty(), "reference".into()];
    };
    let delta_e = &difference.delta_e2000;
    let [low, high] = delta_e.interval_95;
    [
        variant.label.clone(),
        seconds,
        ns,
        format!("{:.3}", delta_e.mean),
        format!("{low:.3}–{high:.3}"),
        format!("{:.3}", delta_e.noise),
        format!("{:.1}", delta_e.max),
        format!("{:+.3}", 100.0 * difference.energy.value).replace("-0.000", "0.000"),
        match difference.verdict {
            Verdict::Identical => "identical".into(),
            Verdict::Indistinguishable => "indistinguishable at this sample count".into(),
            Verdict::Different => String::new(),
        },
    ]
}
