//! `spectrel render`: a scene becomes pictures.

use super::layers::{LayerArgs, Picture, Plan};
use super::progress::Shown;
use super::{SceneArgs, show};
use crate::film::{Develop, Developed, Exposure, Film, Gamut, Layers, Window, fnv1a_64};
use crate::fresnel::FresnelModel;
use crate::image::{self, Bits, Encoded, ExrSpace, Extra, Metadata, Options};
use crate::render::{Kernel, render_layers};
use crate::scene::describe::{ExposureValue, GamutName};
use crate::scene::{Needs, Overrides, Scene, SceneError, resolve};
use crate::spectrum::RgbSpace;
use clap::Args;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

#[derive(Debug, Args)]
pub struct RenderArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Picture to write, .png or .exr; can be repeated [default: the scene's name with both]
    #[arg(short, long, value_name = "FILE")]
    output: Vec<PathBuf>,
    /// Samples a pixel
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    spp: Option<u32>,
    /// Another seed gives another noise
    #[arg(long, value_name = "S")]
    seed: Option<u64>,
    /// Threads, which change nothing but the time [default: all cores]
    #[arg(long, value_name = "T", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Width in pixels; the height follows if it is not given
    #[arg(long, value_name = "W", value_parser = clap::value_parser!(u32).range(1..))]
    width: Option<u32>,
    /// Height in pixels; the width follows if it is not given
    #[arg(long, value_name = "H", value_parser = clap::value_parser!(u32).range(1..))]
    height: Option<u32>,
    /// Render this part only: pixels from the upper left, x1 and y1 excluded
    #[arg(long, value_name = "x0,y0,x1,y1", value_parser = crop)]
    crop: Option<[u32; 4]>,
    #[arg(long, value_name = "MODEL", value_parser = model, help = format!("Fresnel model for every material: {}", FresnelModel::NAMES.join(", ")))]
    fresnel: Option<FresnelModel>,
    /// Wavelengths a path carries [default: 8]
    #[arg(long, value_name = "1|4|8", value_parser = lanes)]
    lanes: Option<u32>,
    /// Bits a channel of PNG files
    #[arg(long, value_name = "8|16", value_parser = bits, default_value = "8")]
    png_bits: PngBits,
    /// Write XYZ in cd/m² into EXR files instead of linear Rec.709
    #[arg(long)]
    exr_xyz: bool,
    /// Write 16-bit floats into EXR files
    #[arg(long)]
    exr_half: bool,
    #[command(flatten)]
    layers: LayerArgs,
    /// Print nothing but warnings and errors
    #[arg(long, short)]
    quiet: bool,
}

#[derive(Clone, Copy, Debug)]
struct PngBits(Bits);

fn crop(text: &str) -> Result<[u32; 4], String> {
    let numbers: Result<Vec<u32>, _> = text.split(',').map(|number| number.trim().parse::<u32>()).collect();
    let expected = || "expected four whole numbers x0,y0,x1,y1".to_owned();
    numbers.map_err(|_| expected())?.try_into().map_err(|_| expected())
}

fn model(name: &str) -> Result<FresnelModel, String> {
    name.parse().map_err(|error: crate::fresnel::UnknownModel| error.to_string())
}

fn lanes(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(lanes @ (1 | 4 | 8)) => Ok(lanes),
        _ => Err("a path carries 1, 4 or 8 wavelengths".into()),
    }
}

fn bits(text: &str) -> Result<PngBits, String> {
    match text {
        "8" => Ok(PngBits(Bits::Eight)),
        "16" => Ok(PngBits(Bits::Sixteen)),
        _ => Err("a PNG has 8 or 16 bits a channel".into()),
    }
}

impl RenderArgs {
    fn overrides(&self) -> Overrides {
        Overrides {
            width: self.width,
            height: self.height,
            crop: self.crop,
            samples: self.spp,
            seed: self.seed,
            fresnel: self.fresnel,
            lanes: self.lanes,
        }
    }

    fn outputs(&self) -> Vec<PathBuf> {
        if !self.output.is_empty() {
            return self.output.clone();
        }
        let name = self.scene.scene.as_deref().and_then(Path::file_stem).unwrap_or("spectrel".as_ref());
        let with = |ending: &str| {
            let mut name = name.to_owned();
            name.push(ending);
            name.into()
        };
        [".png", ".exr"].map(with).to_vec()
    }

    fn options(&self) -> Options {
        Options {
            bits: self.png_bits.0,
            exr_space: if self.exr_xyz { ExrSpace::Xyz } else { ExrSpace::Rgb },
            half: self.exr_half,
        }
    }
}

pub fn run(args: &RenderArgs) -> Result<(), SceneError> {
    let outputs = args.outputs();
    outputs.iter().try_for_each(|path| image::check_writable(path)).map_err(SceneError::new)?;
    let plan = args.layers.plan(&outputs)?;
    let library = args.scene.library.open()?;
    let scene = resolve(args.scene.read()?, &library, &args.overrides())?;
    scene.warnings.iter().for_each(show::warning);
    let layers = expose(&scene, &plan, args)?;
    let developed = layers.film().develop(&development(&scene)).map_err(SceneError::new)?;
    report(&developed, args.quiet);
    Job { args, plan: &plan, scene: &scene }.write(&outputs, &layers, &developed)
}

/// A render that is done.
struct Job<'a> {
    args: &'a RenderArgs,
    plan: &'a Plan,
    scene: &'a Scene,
}

impl Job<'_> {
    /// Writes all pictures, or none if one of them cannot be encoded.
    fn write(&self, paths: &[PathBuf], layers: &Layers, developed: &Developed) -> Result<(), SceneError> {
        let files = paths.iter().map(|path| self.encode(path, layers, developed)).collect::<Result<Vec<_>, _>>()?;
        for (path, file) in paths.iter().zip(files) {
            image::atomic::write(path, &file.bytes).map_err(SceneError::new)?;
            if file.beyond_half > 0 {
                show::warning(format_args!("{} channels are beyond the range of 16-bit floats", file.beyond_half));
            }
            if !self.args.quiet {
                show::note(format_args!("wrote {} ({:.0} kB)", path.display(), file.bytes.len() as f64 / 1e3));
            }
        }
        Ok(())
    }

    fn encode(&self, path: &Path, layers: &Layers, developed: &Developed) -> Result<Encoded, SceneError> {
        let (format, options) = (image::Format::of(path).map_err(SceneError::new)?, self.args.options());
        let metadata = self.plan.describe(path, self.scene, &metadata(self.scene, layers.film(), developed))?;
        let extra = match format {
            image::Format::Png => Extra::default(),
            image::Format::Exr => {
                let matrix = development(self.scene).matrix(developed.ev);
                let picture = Picture::new(developed, matrix, options.exr_space)?;
                self.plan.extra(path, self.scene, layers, &picture)
            }
        };
        image::encode_with(format, developed, &extra, &options, &metadata).map_err(SceneError::new)
    }
}

/// Renders the scene, on a thread pool of its own, until it is done or interrupted.
fn expose(scene: &Scene, plan: &Plan, args: &RenderArgs) -> Result<Layers, SceneError> {
    let settings = &scene.settings;
    let window = window(settings.crop);
    let mut layers = plan.layers(scene, window)?;
    let threads = usize::from(args.threads.unwrap_or(0));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(SceneError::new)?;
    let cancel = cancel_on_interrupt();
    let samples = u64::from(settings.samples);
    let progress = Shown::new(window.pixel_count() * samples, args.quiet);
    let started = Instant::now();
    let needs = Needs::of(scene);
    let kernel = Kernel::new(scene, &needs);
    let recorder = plan.recorder(&kernel, scene, &needs);
    pool.install(|| render_layers(&recorder, &mut layers, 0..samples, &progress, &cancel));
    progress.finish();
    if cancel.load(Ordering::Relaxed) {
        show::warning("interrupted: writing what there is");
    }
    if !args.quiet {
        let seconds = started.elapsed().as_secs_f64();
        let film = layers.film();
        let rate = film.samples() as f64 / seconds / 1e6;
        let each = film.samples() / window.pixel_count();
        let Window { width, height, .. } = window;
        show::note(format_args!(
            "{width} × {height} pixels, {each} samples each: {seconds:.1} s, {rate:.2} M samples/s"
        ));
    }
    Ok(layers)
}

fn window([x0, y0, x1, y1]: [u32; 4]) -> Window {
    Window { x0, y0, width: x1 - x0, height: y1 - y0 }
}

/// The first interrupt ends the render with a picture, the second one at once.
fn cancel_on_interrupt() -> Arc<AtomicBool> {
    let cancel = Arc::new(AtomicBool::new(false));
    let flag = cancel.clone();
    // Without a handler an interrupt ends the program as usual: nothing is lost but the picture.
    let _ = ctrlc::set_handler(move || {
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    });
    cancel
}

fn report(developed: &Developed, quiet: bool) {
    if !quiet {
        show::note(format_args!("exposure {:.2} EV: white is {:.4} cd/m²", developed.ev, developed.ev.exp2()));
        if !developed.report.fits() {
            show::note(&developed.report);
        }
    }
    developed.report.warnings().iter().for_each(show::warning);
}

fn development(scene: &Scene) -> Develop {
    Develop {
        exposure: match scene.picture.exposure {
            ExposureValue::Auto => Exposure::Auto,
            ExposureValue::Ev(ev) => Exposure::Ev(ev),
        },
        white: scene.picture.white,
        space: RgbSpace::Srgb,
        gamut: match scene.picture.gamut {
            GamutName::Clip => Gamut::Clip,
            GamutName::PreserveChroma => Gamut::PreserveChroma,
        },
    }
}

/// What determines the picture.
fn metadata(scene: &Scene, film: &Film, developed: &Developed) -> Metadata {
    let settings = &scene.settings;
    let [x0, y0, x1, y1] = settings.crop;
    Metadata::new()
        .with("version", env!("CARGO_PKG_VERSION"))
        .with("scene", format!("{:016x}", fingerprint(scene)))
        .with("size", format!("{}x{}", settings.width, settings.height))
        .with("crop", format!("{x0},{y0},{x1},{y1}"))
        .with("samples", film.samples() / film.window().pixel_count())
        .with("seed", settings.seed)
        .with("lanes", settings.lanes)
        .with("fresnel", settings.fresnel.map_or("by material", FresnelModel::name))
        .with("exposure", format!("{} EV", developed.ev))
        .with("white", &scene.picture.white_balance)
        .with("observer", &scene.picture.observer.about.name)
}

/// Identifies what is rendered: the texts of scene and materials, and every spectrum that came of them.
fn fingerprint(scene: &Scene) -> u64 {
    let texts: String = scene.sources.iter().map(|text| text.content.as_str()).collect();
    fnv1a_64(format!("{texts}{:?}", scene.spectra).as_bytes())
}
