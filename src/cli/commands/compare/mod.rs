//! `spectrel compare`: variants of a scene with the same random numbers, and a report of how far they are apart.

mod interfaces;
mod outcome;
mod replicates;
mod variants;

use crate::cli::folder::{Folder, Kind};
use crate::cli::interrupt::Interrupt;
use crate::cli::progress::Shown;
use crate::cli::scene_file::{LibraryArgs, pair, scene_name, scene_text};
use crate::cli::settings::SettingsArgs;
use crate::cli::show::{self, quoted};
use crate::cli::{memory, picture};
use crate::film::Film;
use crate::fresnel::FresnelModel;
use crate::report::comparison::JSON_FILE;
use crate::report::difference::FEWEST;
use crate::report::jackknife::MOST;
use crate::scene::{Scene, SceneError, Text};
use clap::Args;
use outcome::Outcome;
use replicates::{Replication, render_all};
use std::path::PathBuf;
use std::time::Instant;
use variants::{DEFAULT_MODELS, Variant, variants};

/// The scene that is compared when none is named.
const DEFAULT_SCENE: (&str, &str) = ("built-in:scenes/compare.toml", include_str!("../../../../scenes/compare.toml"));

const KIND: Kind = Kind { file: JSON_FILE, command: "compare" };

#[derive(Debug, Args)]
pub struct CompareArgs {
    /// Scene file (TOML) [default: a built-in one in which models part: grazing metals, a gem, many bounces]
    scene: Option<PathBuf>,
    #[command(flatten)]
    library: LibraryArgs,
    #[arg(long, value_name = "MODEL,…", value_delimiter = ',', help = models_help())]
    models: Vec<FresnelModel>,
    /// One more variant: a material of the scene replaced by another one, such as gold=silver; can be repeated
    #[arg(long, value_name = "MATERIAL=NAME", value_parser = pair)]
    vary: Vec<(String, String)>,
    /// One more variant: another data set for a material of the scene, such as gold=Au/johnson-christy-1972; can be repeated
    #[arg(long, value_name = "MATERIAL=DATASET", value_parser = pair)]
    ior: Vec<(String, String)>,
    /// Folder of the report [default: the scene's name with -compare]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Replace an earlier report in that folder
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    settings: SettingsArgs,
    /// Independent renders that each variant is the mean of, by which noise is told from difference; together they have the
    /// samples of --spp
    #[arg(long, value_name = "R", default_value = "8", value_parser = clap::value_parser!(u16).range(FEWEST as i64..=MOST as i64))]
    replicates: u16,
    /// Print nothing but warnings and errors
    #[arg(long, short)]
    quiet: bool,
}

fn models_help() -> String {
    let names = |models: &[FresnelModel], separator| {
        models.iter().map(|model| model.name()).collect::<Vec<_>>().join(separator)
    };
    let (all, usual) = (names(FresnelModel::ALL, ", "), names(DEFAULT_MODELS, ","));
    format!(
        "Fresnel models to compare, the reference first: {all} [default: {usual}; exact alone with --vary or --ior]"
    )
}

impl CompareArgs {
    /// The command that makes the same report, whatever the scene's file says by then of its size and samples.
    fn command(&self, variants: &[Variant], scene: &Scene, replication: &Replication) -> String {
        let models: Vec<_> =
            variants.iter().filter(|v| v.vary.is_empty() && v.ior.is_empty()).map(|v| v.model.name()).collect();
        let mut words: Vec<String> = vec!["spectrel".into(), "compare".into()];
        words.extend(self.scene.iter().map(|path| path.display().to_string()));
        let mut option = |name: &str, value: String| words.extend([format!("--{name}"), value]);
        self.library.library.iter().for_each(|folder| option("library", folder.display().to_string()));
        option("models", models.join(","));
        self.vary.iter().for_each(|(material, by)| option("vary", format!("{material}={by}")));
        self.ior.iter().for_each(|(material, data)| option("ior", format!("{material}={data}")));
        option("width", scene.settings.width.to_string());
        option("height", scene.settings.height.to_string());
        option("spp", replication.samples_in_all().to_string());
        option("seed", replication.seed.to_string());
        option("replicates", replication.seeds.len().to_string());
        words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ")
    }

    fn folder(&self) -> PathBuf {
        self.output.clone().unwrap_or_else(|| format!("{}-compare", scene_name(self.scene.as_deref())).into())
    }
}

pub fn run(args: &CompareArgs) -> Result<(), SceneError> {
    args.settings.threads.start()?;
    let variants = variants(args)?;
    let folder = Folder::claim(&args.folder(), KIND, args.force)?;
    let text = scene_text(args.scene.as_deref(), DEFAULT_SCENE)?;
    let mut scenes = resolve_all(&variants, &text, args)?;
    let settings = &scenes[0].settings;
    let replication = Replication::new(settings.seed, settings.samples, args.replicates);
    check_memory(&scenes, &replication)?;
    let identities: Vec<u64> = scenes.iter().map(picture::fingerprint).collect();
    let interrupt = Interrupt::listen();
    let progress = Shown::new(samples(&scenes, &replication), args.quiet);
    let started = Instant::now();
    let rendered = render_all(&mut scenes, &replication, &progress, &interrupt)?;
    progress.finish();
    if rendered[0].replicates.len() < FEWEST {
        // Too little to tell noise from difference: as if nobody had listened.
        std::process::exit(130);
    }
    if interrupt.pressed() {
        show::warning("interrupted: comparing what there is");
    }
    let (rendering, started) = (started.elapsed().as_secs_f64(), Instant::now());
    let outcome = Outcome {
        args,
        text: &text,
        variants: &variants,
        scenes: &scenes,
        identities: &identities,
        replication: &replication,
        rendered: &rendered,
    };
    let report = outcome.compare(rendering, interrupt.pressed())?;
    folder.write(&outcome.files(&report)?)?;
    outcome.tell(&report, started.elapsed().as_secs_f64())
}

fn resolve_all(variants: &[Variant], text: &Text, args: &CompareArgs) -> Result<Vec<Scene>, SceneError> {
    let library = args.library.open()?;
    let scenes = variants.iter().map(|variant| variant.resolve(text, &library, args)).collect::<Result<Vec<_>, _>>()?;
    let mut warned = Vec::new();
    for warning in scenes.iter().flat_map(|scene| &scene.warnings) {
        if !warned.contains(&warning) {
            show::warning(warning);
            warned.push(warning);
        }
    }
    Ok(scenes)
}

/// Films of all variants and of their newest replicates; what is kept of every replicate, and what is made of all: XYZ, RGB, maps.
fn check_memory(scenes: &[Scene], replication: &Replication) -> Result<(), SceneError> {
    let window = picture::window(scenes[0].settings.crop);
    let images = (replication.seeds.len() + 3) * size_of::<[f32; 3]>();
    let a_pixel = 2 * Film::memory_bytes(1, 1) + images as u64;
    memory::check_or(window, a_pixel * scenes.len() as u64, 0, "make it smaller with --width, or name fewer variants")
}

fn samples(scenes: &[Scene], replication: &Replication) -> u64 {
    let pixels = |scene: &Scene| u64::from(scene.settings.width) * u64::from(scene.settings.height);
    scenes.iter().map(pixels).sum::<u64>() * u64::from(replication.samples_in_all())
}
