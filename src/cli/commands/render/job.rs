//! One render of one scene: exposed, developed, written.

use super::layers::{Picture, Recording};
use super::preview::Preview;
use crate::adaptive::{Effort, Look, Reached, RenderLoop, Session};
use crate::cli::effort::so_far;
use crate::cli::interrupt::Interrupt;
use crate::cli::picture::{development, fingerprint, metadata, samples_each, window};
use crate::cli::progress::Shown;
use crate::cli::show;
use crate::film::{Developed, Film, Layers, Window};
use crate::image::{self, Encoded, Extra, Options};
use crate::render::Kernel;
use crate::scene::{Decision, Needs, Scene, SceneError};
use std::iter::{once, repeat};
use std::path::{Path, PathBuf};
use std::time::Instant;

pub struct Job<'a> {
    pub recording: &'a Recording,
    pub scene: &'a Scene,
    pub effort: &'a Effort,
    pub options: Options,
    pub quiet: bool,
    pub verbose: bool,
}

impl Job<'_> {
    /// Renders and writes; writes nothing if the render was ended because it is to begin anew.
    pub fn run(
        &self,
        outputs: &[PathBuf],
        interrupt: &Interrupt,
        preview: Option<&mut Preview>,
    ) -> Result<(), SceneError> {
        // Before the render: what its files hold by its end is not what it was made of.
        let identity = fingerprint(self.scene);
        let layers = self.expose(interrupt, preview)?;
        if interrupt.stopped() && !interrupt.pressed() {
            return Ok(());
        }
        if interrupt.pressed() && layers.film().samples() == 0 {
            // Before there was anything to show: as if nobody had listened.
            std::process::exit(130);
        }
        let developed = self.develop(&layers)?;
        report(&developed, self.quiet);
        self.write(outputs, identity, &layers, &developed)
    }

    /// Renders until it is done or interrupted.
    fn expose(&self, interrupt: &Interrupt, preview: Option<&mut Preview>) -> Result<Layers, SceneError> {
        let (scene, quiet) = (self.scene, self.quiet);
        let window = window(scene.settings.crop);
        let started = Instant::now();
        let mut layers = self.recording.layers(scene, window)?;
        let progress = match self.effort.samples() {
            Some(samples) => Shown::new(window.pixel_count() * samples, quiet),
            None => Shown::open(quiet),
        };
        let needs = Needs::of(scene);
        let kernel = Kernel::new(scene, &needs);
        let recorder = self.recording.recorder(&kernel, scene, &needs);
        let develop = development(scene);
        match preview {
            None => {
                let look = |look: &Look| {
                    if !quiet {
                        show::note(so_far(look));
                    }
                };
                let session = Session {
                    develop: &develop,
                    chance: &needs.chance,
                    progress: &progress,
                    look: &look,
                    cancel: interrupt.flag(),
                };
                let reached = self.effort.render(recorder, &mut layers, &session).map_err(SceneError::new)?;
                reached.iter().for_each(|reached| tell(reached, quiet));
            }
            Some(preview) => {
                let render = RenderLoop::new(&recorder, &progress, interrupt.flag());
                self.expose_and_show(&mut layers, preview, &render)?;
            }
        }
        progress.finish();
        if interrupt.pressed() {
            show::warning("interrupted: writing what there is");
        }
        if !quiet && interrupt.pressed() == interrupt.stopped() {
            summary(layers.film(), started);
            if self.verbose {
                left_out(&needs);
            }
        }
        Ok(layers)
    }

    /// Renders with a look at what there is in between.
    fn expose_and_show(
        &self,
        layers: &mut Layers,
        preview: &mut Preview,
        render: &RenderLoop,
    ) -> Result<(), SceneError> {
        render.evenly_seen(layers, u64::from(self.scene.settings.samples), |layers, ends| {
            if ends || preview.is_due() {
                preview.show(&self.develop(layers)?);
            }
            Ok(())
        })
    }

    fn develop(&self, layers: &Layers) -> Result<Developed, SceneError> {
        layers.film().develop(&development(self.scene)).map_err(SceneError::new)
    }

    /// Writes all pictures, or none if one of them cannot be encoded.
    fn write(
        &self,
        paths: &[PathBuf],
        identity: u64,
        layers: &Layers,
        developed: &Developed,
    ) -> Result<(), SceneError> {
        let files =
            paths.iter().map(|path| self.encode(path, identity, layers, developed)).collect::<Result<Vec<_>, _>>()?;
        for (path, file) in paths.iter().zip(files) {
            image::atomic::write(path, &file.bytes).map_err(SceneError::new)?;
            if file.beyond_half > 0 {
                show::warning(format_args!("{} channels are beyond the range of 16-bit floats", file.beyond_half));
            }
            if !self.quiet {
                show::note(format_args!("wrote {} ({:.0} kB)", path.display(), file.bytes.len() as f64 / 1e3));
            }
        }
        Ok(())
    }

    fn encode(
        &self,
        path: &Path,
        identity: u64,
        layers: &Layers,
        developed: &Developed,
    ) -> Result<Encoded, SceneError> {
        let (format, options) = (image::Format::of(path).map_err(SceneError::new)?, self.options);
        let metadata = metadata(self.scene, identity, layers.film(), developed);
        let metadata = self.recording.describe(path, self.scene, &metadata)?;
        let extra = match format {
            image::Format::Png => Extra::default(),
            image::Format::Exr => {
                let picture =
                    Picture::new(developed, &development(self.scene), options.exr_space).map_err(SceneError::new)?;
                self.recording.extra(path, self.scene, layers, &picture)
            }
        };
        image::encode_with(format, developed, &extra, &options, &metadata).map_err(SceneError::new)
    }
}

/// Whether a bound was reached: told in any case if it was not.
fn tell(reached: &Reached, quiet: bool) {
    if !reached.met {
        show::warning(format_args!("stopped before the error was small enough: {reached}"));
        reached.reason().iter().for_each(show::note);
    } else if !quiet {
        show::note(reached);
    }
    reached.held_by().filter(|_| !quiet).iter().for_each(show::note);
}

/// What the render did without, and why.
fn left_out(needs: &Needs) {
    for (Decision { part, reason, .. }, first) in
        needs.decisions.iter().filter(|d| !d.used).zip(once("left out").chain(repeat("")))
    {
        show::note(format_args!("{first:<8}  {part:<18}  {reason}"));
    }
}

fn summary(film: &Film, started: Instant) {
    let seconds = started.elapsed().as_secs_f64();
    let rate = film.samples() as f64 / seconds / 1e6;
    let each = samples_each(film);
    let Window { width, height, .. } = film.window();
    show::note(format_args!("{width} × {height} pixels, {each} samples each: {seconds:.1} s, {rate:.2} M samples/s"));
}

fn report(developed: &Developed, quiet: bool) {
    if !quiet {
        show::note(format_args!("exposure {:.2} EV: white is {:.4} cd/m²", developed.ev, developed.ev.exp2()));
        if !developed.report.fits() {
            show::note(developed.report);
        }
    }
    developed.report.warnings().iter().for_each(show::warning);
}
