//! `spectrel render`: a scene becomes pictures.

mod job;
mod layers;
mod preview;
mod watch;

use crate::cli::effort::EffortArgs;
use crate::cli::interrupt::Interrupt;
use crate::cli::scene_file::{SceneArgs, pair, scene_name};
use crate::cli::settings::{SettingsArgs, lanes};
use crate::cli::show;
use crate::fresnel::FresnelModel;
use crate::image::{self, Bits, ExrSpace, Options};
use crate::scene::{Overrides, SceneError, Text, resolve};
use clap::Args;
use job::Job;
use layers::LayerArgs;
use preview::{DEFAULT_HOST, Preview};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct RenderArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Picture to write: .png, .exr, or .spectral.exr for bands of wavelength; can be repeated [default: the scene's
    /// name with .png and .exr]
    #[arg(short, long, value_name = "FILE")]
    output: Vec<PathBuf>,
    #[command(flatten)]
    settings: SettingsArgs,
    /// Render this part only: pixels from the upper left, x1 and y1 excluded
    #[arg(long, value_name = "x0,y0,x1,y1", value_parser = crop)]
    crop: Option<[u32; 4]>,
    #[arg(long, value_name = "MODEL", help = format!("Fresnel model for every material: {}", FresnelModel::NAMES.join(", ")))]
    fresnel: Option<FresnelModel>,
    /// Take another data set of n and k for a material of the scene, such as gold=Au/johnson-christy-1972 (`spectrel list
    /// spectra` shows them, and a .csv, .yml or .toml file of yours will do); can be repeated
    #[arg(long, value_name = "MATERIAL=DATASET", value_parser = pair)]
    ior: Vec<(String, String)>,
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
    effort: EffortArgs,
    #[command(flatten)]
    layers: LayerArgs,
    /// Render again when the scene or a file that it names changes, until Ctrl-C
    #[arg(long)]
    watch: bool,
    /// Show progress in a running tev [default: 127.0.0.1:14158] (needs a build with the feature `preview`)
    #[arg(long, value_name = "HOST:PORT", num_args = 0..=1, require_equals = true, default_missing_value = DEFAULT_HOST)]
    preview: Option<String>,
    /// Print nothing but warnings and errors
    #[arg(long, short)]
    quiet: bool,
    /// Say also which physics the scene did without, and why
    #[arg(long, short, conflicts_with = "quiet")]
    verbose: bool,
}

#[derive(Clone, Copy, Debug)]
struct PngBits(Bits);

fn crop(text: &str) -> Result<[u32; 4], String> {
    let numbers: Result<Vec<u32>, _> = text.split(',').map(|number| number.trim().parse::<u32>()).collect();
    let expected = || "expected four whole numbers x0,y0,x1,y1".to_owned();
    numbers.map_err(|_| expected())?.try_into().map_err(|_| expected())
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
            crop: self.crop,
            fresnel: self.fresnel,
            lanes: self.lanes,
            ior: self.ior.clone(),
            ..self.settings.overrides()
        }
    }

    fn outputs(&self) -> Vec<PathBuf> {
        if !self.output.is_empty() {
            return self.output.clone();
        }
        [".png", ".exr"].map(|ending| format!("{}{ending}", self.name()).into()).to_vec()
    }

    /// What pictures are called unless they are named.
    fn name(&self) -> String {
        scene_name(self.scene.scene.as_deref())
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
    if args.effort.is_open() && args.preview.is_some() {
        return Err(SceneError::new(
            "--preview shows a render of a known length: it does not go with --target-error, --time or --adaptive",
        ));
    }
    args.settings.threads.start()?;
    let recording = args.layers.recording(&outputs, &args.effort)?;
    let mut preview = args.preview.as_deref().map(|host| Preview::connect(host, &args.name())).transpose()?;
    let interrupt = Interrupt::listen();
    let mut render = |read: &dyn Fn(&[Text])| {
        let scene = resolve(args.scene.read()?, &args.scene.library.open()?, &args.overrides())?;
        read(&scene.sources);
        scene.warnings.iter().for_each(show::warning);
        let effort = args.effort.effort(args.settings.samples(), scene.settings.samples)?;
        let job = Job {
            recording: &recording,
            scene: &scene,
            effort: &effort,
            options: args.options(),
            quiet: args.quiet,
            verbose: args.verbose,
        };
        job.run(&outputs, &interrupt, preview.as_mut())
    };
    if !args.watch {
        return render(&|_| {});
    }
    let Some(scene) = &args.scene.scene else {
        return Err(SceneError::new("--watch needs a scene file: the built-in scene never changes"));
    };
    watch::run(scene, &interrupt, args.quiet, render);
    Ok(())
}
