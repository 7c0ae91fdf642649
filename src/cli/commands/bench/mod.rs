//! `spectrel bench`: what renders of a scene cost against how far they are from a reference.

mod clock;
mod reference;
mod sweep;
mod table;
mod ways;

use crate::adaptive::Aim;
use crate::cli::effort::duration;
use crate::cli::folder::{Folder, Kind};
use crate::cli::memory;
use crate::cli::picture::{development, window};
use crate::cli::scene_file::{LibraryArgs, read_text};
use crate::cli::settings::lanes;
use crate::cli::show::{self, quoted};
use crate::cli::threads::ThreadArgs;
use crate::film::Film;
use crate::film::View;
use crate::fresnel::FresnelModel;
use crate::report::bench::{
    Bench, HTML_FILE, JSON_FILE, Measured, SVG_FILE, Scale, Scene as Found, Standard, figure, measure, page, picture,
};
use crate::scene::describe::SamplerName;
use crate::scene::{Overrides, Scene, SceneError, Text};
use clap::Args;
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use sweep::{Assignment, LADDER, REPEATS, REPLICATES, Sweep, Swept};
use ways::{Way, ways};

/// The scenes that are rendered when none is named.
const DEFAULT_SCENES: [(&str, &str); 2] = [
    ("built-in:scenes/metals.toml", include_str!("../../../../scenes/metals.toml")),
    ("built-in:scenes/diamond.toml", include_str!("../../../../scenes/diamond.toml")),
];

/// Pixels of a picture unless --width says otherwise: enough for a mean over them, few enough for many renders.
const PIXELS: f64 = 16_000.0;

const KIND: Kind = Kind { file: JSON_FILE, command: "bench" };

#[derive(Debug, Args)]
pub struct BenchArgs {
    /// Scene files (TOML) [default: two built-in ones, metals and a diamond]
    #[arg(value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    #[command(flatten)]
    library: LibraryArgs,
    /// Folder of the report
    #[arg(short, long, value_name = "DIR", default_value = "bench")]
    output: PathBuf,
    /// Replace an earlier report in that folder
    #[arg(long)]
    force: bool,
    /// What all renders together may take, such as 90s or 10m: what does not fit is left out, and told
    #[arg(long, value_name = "TIME", default_value = "120s", value_parser = duration)]
    time_budget: Duration,
    /// Fresnel models beside `exact`, separated by commas [default: schlick,f82,rgb-exact]
    #[arg(long, value_name = "MODEL,…", value_delimiter = ',')]
    models: Vec<FresnelModel>,
    /// Wavelengths a path beside 8, of 1, 4 and 8 [default: 4,1]
    #[arg(long, value_name = "N,…", value_parser = lanes, value_delimiter = ',')]
    lanes: Vec<u32>,
    /// Samplers beside `sobol` [default: independent]
    #[arg(long, value_name = "NAME,…", value_parser = ways::sampler, value_delimiter = ',')]
    samplers: Vec<SamplerName>,
    /// Ways to share samples out beside `off`, dE or rmse; below 16 samples a pixel there is nothing to share [default: rmse]
    #[arg(long, value_name = "AIM,…", value_parser = ways::sharing, value_delimiter = ',')]
    adaptive: Vec<Option<Aim>>,
    /// Dispersion beside `on`; where it is off, every n is that of 587.6 nm [default: off]
    #[arg(long, value_name = "on,off", value_parser = ways::switch, value_delimiter = ',')]
    dispersion: Vec<bool>,
    /// Try all combinations of these, and not only one change at a time; those that change the fewest things go first
    #[arg(long)]
    product: bool,
    /// Samples a pixel, separated by commas [default: 4, 16, 64, … as far as time goes]
    #[arg(long, value_name = "N,…", value_parser = clap::value_parser!(u32).range(1..), value_delimiter = ',')]
    spp: Vec<u32>,
    /// Samples a pixel of the reference [default: what there is time for, 16 to 64 times the most of the others]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..), conflicts_with = "reference")]
    reference_spp: Option<u32>,
    /// A reference that `spectrel render` wrote of the scene (EXR), in place of one of our own
    #[arg(long, value_name = "FILE.exr")]
    reference: Option<PathBuf>,
    /// Width in pixels; the height follows [default: what makes about 16000 pixels, or the reference's]
    #[arg(long, value_name = "W", value_parser = clap::value_parser!(u32).range(1..))]
    width: Option<u32>,
    /// Another seed gives another noise
    #[arg(long, value_name = "S", default_value = "0")]
    seed: u64,
    #[command(flatten)]
    threads: ThreadArgs,
    /// Print the answer, warnings and errors only
    #[arg(long, short)]
    quiet: bool,
}

/// A scene that is ready to be rendered in every way.
struct Subject {
    text: Text,
    ways: Vec<Way>,
    scenes: Vec<Scene>,
    file: Option<reference::File>,
    left_out: Vec<String>,
}

pub fn run(args: &BenchArgs) -> Result<(), SceneError> {
    let started = Instant::now();
    args.threads.start()?;
    let folder = Folder::claim(&args.output, KIND, args.force)?;
    let counts = counts(&args.spp)?;
    let subjects = subjects(args, &counts)?;
    let mut left = subjects.len() as u32;
    let (mut scenes, mut pictures) = (Vec::new(), Vec::new());
    for subject in subjects {
        let time = args.time_budget.saturating_sub(started.elapsed()) / left;
        let (scene, picture) = subject.found(args, &counts, time)?;
        scenes.push(scene);
        pictures.push(picture);
        left -= 1;
    }
    let bench = Bench {
        version: env!("CARGO_PKG_VERSION").into(),
        command: command(),
        threads: rayon::current_num_threads(),
        clock: clock::source(),
        time_budget_seconds: args.time_budget.as_secs_f64(),
        seconds: started.elapsed().as_secs_f64(),
        seed: args.seed,
        repeats: REPEATS,
        scenes,
    };
    folder.write(&files(&bench, &pictures)?)?;
    show::answer(table::answer(&bench))?;
    if !args.quiet {
        let (seconds, page) = (started.elapsed().as_secs_f64(), args.output.join(HTML_FILE));
        show::note(format_args!("{seconds:.1} s; wrote {}", page.display()));
    }
    Ok(())
}

/// The samples of every way, ascending.
fn counts(given: &[u32]) -> Result<Vec<u32>, SceneError> {
    let mut counts = if given.is_empty() { LADDER.to_vec() } else { given.to_vec() };
    counts.sort_unstable();
    match counts.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => Err(SceneError::new(format!("--spp names {} twice", pair[0]))),
        None => Ok(counts),
    }
}

fn command() -> String {
    let words = std::env::args_os().skip(1).map(|word| quoted(&word.to_string_lossy()));
    std::iter::once("spectrel".into()).chain(words).collect::<Vec<_>>().join(" ")
}

fn files(bench: &Bench, pictures: &[Vec<u8>]) -> Result<Vec<(String, Vec<u8>)>, SceneError> {
    let json = bench.json().map_err(SceneError::new)?;
    let page = page(bench, pictures).map_err(SceneError::new)?;
    let files = [(JSON_FILE, json), (SVG_FILE, figure(bench).svg()), (HTML_FILE, page)];
    Ok(files.into_iter().map(|(name, text)| (name.to_owned(), text.into_bytes())).collect())
}

/// Every check that can be made is made before the first render.
fn subjects(args: &BenchArgs, counts: &[u32]) -> Result<Vec<Subject>, SceneError> {
    let ways = ways(args)?;
    let texts = match args.scenes.as_slice() {
        [] => DEFAULT_SCENES.iter().map(|(name, content)| Text::new(*name, *content)).collect(),
        paths => paths.iter().map(|path| read_text(path)).collect::<Result<Vec<_>, _>>()?,
    };
    if args.reference.is_some() && texts.len() > 1 {
        let error = SceneError::new("--reference is of one scene, and there are several");
        return Err(error.help("name the scene that the reference is of"));
    }
    texts.into_iter().map(|text| Subject::new(text, &ways, args, counts)).collect()
}

impl Subject {
    fn new(text: Text, ways: &[Way], args: &BenchArgs, counts: &[u32]) -> Result<Self, SceneError> {
        let (library, mut ways) = (args.library.open()?, ways.to_vec());
        let own = Way::USUAL.resolve(&text, &library, &Overrides::default())?;
        own.warnings.iter().for_each(show::warning);
        let file = args.reference.as_deref().map(reference::File::read).transpose()?;
        let size = Overrides { width: Some(width(&own, file.as_ref(), args)?), ..Overrides::default() };
        let mut left_out = Vec::new();
        if !own.media.iter().any(|medium| medium.dispersive) {
            let before = ways.len();
            ways.retain(|way| way.described().dispersion);
            left_out.extend((ways.len() < before).then(|| "no dispersion: nothing in this scene has any".to_owned()));
        }
        let scenes = ways.iter().map(|way| way.resolve(&text, &library, &size)).collect::<Result<Vec<_>, _>>()?;
        let subject = Self { text, ways, scenes, file, left_out };
        subject.check(counts)?;
        Ok(subject)
    }

    fn check(&self, counts: &[u32]) -> Result<(), SceneError> {
        let scene = &self.scenes[0];
        let [width, height] = [scene.settings.width, scene.settings.height];
        if let Some(file) = self.file.as_ref().filter(|file| file.size() != [width, height]) {
            let [file_width, file_height] = file.size();
            return Err(SceneError::new(format!(
                "--reference {}: it has {file_width} × {file_height} pixels, the scene {width} × {height}",
                file.name()
            )));
        }
        let images = self.ways.len() * counts.len() * REPEATS + REPLICATES;
        let a_pixel = Film::memory_bytes(1, 1) + (images * size_of::<[f32; 3]>()) as u64;
        let advice = "make it smaller with --width, or name fewer --spp";
        memory::check_or(window(scene.settings.crop), a_pixel, 0, advice)
    }

    /// Renders, and measures what was rendered; with a picture of the reference.
    fn found(self, args: &BenchArgs, counts: &[u32], time: Duration) -> Result<(Found, Vec<u8>), SceneError> {
        let name = name(&self.text.path);
        let tell = |line: String| {
            if !args.quiet {
                show::note(format_args!("{name}: {line}"));
            }
        };
        let (needs_reference, reference) = (self.file.is_none(), args.reference_spp);
        let singles = self.ways.iter().filter(|way| way.changes().len() < 2).count();
        let assignment = Assignment { seed: args.seed, counts, singles, reference, needs_reference, time };
        let Self { text, ways, scenes, file, mut left_out } = self;
        let [width, height] = [scenes[0].settings.width, scenes[0].settings.height];
        let (development, white_balance) = (development(&scenes[0]), scenes[0].picture.white_balance.clone());
        let from_file = file.map(|file| from_file(file, &scenes[0])).transpose()?;
        let subjects = scenes.into_iter().zip(&ways).map(|(scene, way)| (scene, way.aim())).collect();
        let swept = Sweep::begin(subjects, &assignment, &tell)?.run()?;
        left_out.extend(missing(&ways, &swept, args));
        let Swept { renders, replicates, replicate_samples, .. } = swept;
        let rendered = Standard::Rendered { replicates, samples: replicate_samples.into() };
        let standard = from_file.unwrap_or(rendered);
        let image = standard.image();
        let luminances = image.par_iter().map(|xyz| f64::from(xyz[1]));
        let ev = development.exposure.ev(luminances).map_err(SceneError::new)?;
        let all = ways.iter().zip(renders).map(|(way, renders)| Measured { way: way.described(), renders });
        let (view, scale) = (View::new(ev, development.white), Scale { pixels: f64::from(width) * f64::from(height) });
        let (reference, variants) = measure(&view, &standard, &all.collect::<Vec<_>>(), scale)
            .ok_or_else(|| SceneError::new("there was no time for a single render"))?;
        let picture = picture(&view, &image, [width, height]).map_err(SceneError::new)?;
        let found = Found {
            scene: text.path.display().to_string(),
            name,
            width,
            height,
            exposure_ev: ev,
            white_balance,
            reference,
            variants,
            left_out,
            findings: Vec::new(),
        };
        Ok((found.with_findings(), picture))
    }
}

fn from_file(file: reference::File, scene: &Scene) -> Result<Standard, SceneError> {
    let (name, samples) = (file.name(), file.samples);
    Ok(Standard::File { name, samples, image: file.image(scene)? })
}

/// What there was no time for.
fn missing(ways: &[Way], swept: &Swept, args: &BenchArgs) -> Vec<String> {
    let untried = &ways[swept.renders.len()..];
    let single = untried.iter().filter(|way| way.changes().len() == 1);
    let of_ways = single.map(|way| format!("{}: no time for it", way.label()));
    // Too many to be named.
    let of_products = (2..=4).filter_map(|changes| {
        let [left, all] = [untried, ways].map(|some| some.iter().filter(|way| way.changes().len() == changes).count());
        (left > 0).then(|| format!("{left} of {all} ways that change {changes} things at once: no time for them"))
    });
    let counts: Vec<_> = swept.counts_left_out.iter().map(u32::to_string).collect();
    // Of the default ones nobody asked for all.
    let of_counts = (!counts.is_empty() && !args.spp.is_empty())
        .then(|| format!("{} samples a pixel: no time for them", counts.join(", ")));
    of_ways.chain(of_products).chain(of_counts).collect()
}

/// Pixels of a row.
fn width(own: &Scene, file: Option<&reference::File>, args: &BenchArgs) -> Result<u32, SceneError> {
    let [width, height] = [own.settings.width, own.settings.height].map(f64::from);
    let small = (PIXELS * width / height).sqrt().min(width).round().max(1.0) as u32;
    match (file.map(reference::File::size), args.width) {
        (None, asked) => Ok(asked.unwrap_or(small)),
        (Some([of_file, _]), None) => Ok(of_file),
        (Some([of_file, _]), Some(asked)) if of_file == asked => Ok(asked),
        (Some([of_file, _]), Some(asked)) => {
            Err(SceneError::new(format!("--width {asked}, but the --reference is {of_file} pixels wide")))
        }
    }
}

/// The name of a scene's file without folder and ending.
fn name(path: &Path) -> String {
    path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}
