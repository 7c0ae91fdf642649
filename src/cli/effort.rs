//! What a command line says of how long a render goes on and where, and what people are told of it.

use crate::adaptive::{Aim, Bound, Effort, LEAST_SHARED, LIMIT, Look, Measure, Reached, Target};
use crate::film::REPLICATES;
use crate::scene::SceneError;
use clap::Args;
use std::fmt;
use std::str::FromStr;
use std::time::Duration;

#[derive(Clone, Debug, Args)]
pub struct EffortArgs {
    /// Render until the error of the picture is at most this, with 95 % confidence, what paths may have missed counted in: dE=0.5 for
    /// the mean ΔE2000, dE95=1 for its 95th percentile, rmse=0.01 for linear RGB; several are all kept. Where nothing can be promised
    /// it goes on to --spp, or 65536 samples a pixel, and says so
    #[arg(long, value_name = "MEASURE=BOUND,…", value_delimiter = ',')]
    target_error: Vec<Target>,
    /// Render for this long, such as 60s, 5m or 1h, and then write what there is; samples are shared out unless --adaptive is off
    #[arg(long, value_name = "TIME", value_parser = duration)]
    time: Option<Duration>,
    /// Share samples out: --spp, or what --time is enough for, is their mean, and after the first quarter noisy places get more, so that
    /// the mean ΔE2000 of the picture (dE) or the RMSE of its linear RGB (rmse) falls fastest; off gives all pixels as many
    /// [default: dE, and off without --time]
    #[arg(long, value_name = "dE|rmse|off", num_args = 0..=1, require_equals = true, default_missing_value = "dE", value_parser = sharing)]
    adaptive: Option<Sharing>,
}

/// What samples are shared out for, if they are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sharing(pub Option<Aim>);

const MEASURES: [(&str, Measure); 3] = [("dE", Measure::MeanDe), ("dE95", Measure::De95), ("rmse", Measure::Rmse)];

impl FromStr for Target {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let expected = || "expected dE=BOUND, dE95=BOUND or rmse=BOUND".to_owned();
        let (name, bound) = text.split_once('=').ok_or_else(expected)?;
        let known = MEASURES.iter().find(|(known, _)| known.eq_ignore_ascii_case(name.trim()));
        let (_, measure) = known.ok_or_else(expected)?;
        match bound.trim().parse::<f64>() {
            Ok(bound) if bound > 0.0 && bound.is_finite() => Ok(Self { measure: *measure, bound }),
            _ => Err(format!("a bound on {name} is a number above 0")),
        }
    }
}

/// What an option's samples are shared out for.
pub fn sharing(text: &str) -> Result<Sharing, String> {
    let found = Aim::ALL.into_iter().find(|aim| aim.name().eq_ignore_ascii_case(text));
    match (found, text.eq_ignore_ascii_case("off")) {
        (None, false) => Err("samples are shared out for dE or rmse, or not at all: off".into()),
        _ => Ok(Sharing(found)),
    }
}

pub fn duration(text: &str) -> Result<Duration, String> {
    let text = text.trim();
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let scale = match &text[digits.len()..] {
        "" | "s" => 1.0,
        "ms" => 1e-3,
        "m" | "min" => 60.0,
        "h" => 3600.0,
        _ => return Err("expected a time such as 60s, 5m or 1h".into()),
    };
    match digits.trim().parse::<f64>() {
        Ok(number) if number > 0.0 && number * scale < 1e9 => Ok(Duration::from_secs_f64(number * scale)),
        _ => Err("expected a time above 0, such as 60s, 5m or 1h".into()),
    }
}

impl EffortArgs {
    /// Whether nobody knows how many samples a pixel takes.
    pub fn is_open(&self) -> bool {
        self.time.is_some() || self.judges() || self.shares_out().is_some()
    }

    /// Whether the picture's error decides.
    pub fn judges(&self) -> bool {
        !self.target_error.is_empty()
    }

    /// What samples are shared out for without a bound on the error.
    ///
    /// By default those of a given time: after four seconds metals, a Cornell box, a diamond, a ring and the tray have 0.94–0.99 × the mean
    /// ΔE2000 that they have evenly, 0.80–0.93 × its 95th percentile, 0.40–0.96 × the mean square error and 0.50–0.87 × the relative one. After
    /// one second the mean ΔE2000 is 0.96–1.04 ×, the others are still better.
    pub fn shares_out(&self) -> Option<Aim> {
        let unless_told = if self.time.is_some() && !self.judges() { Some(Aim::MeanDe) } else { None };
        self.adaptive.map_or(unless_told, |Sharing(aim)| aim)
    }

    /// `asked` are the samples of the command line, `own` those of the scene.
    pub fn effort(&self, asked: Option<u32>, own: u32) -> Result<Effort, SceneError> {
        for (i, target) in self.target_error.iter().enumerate() {
            if let Some(other) = self.target_error[..i].iter().find(|other| other.measure == target.measure) {
                let message =
                    format!("--target-error bounds the {} twice: {} and {}", target.measure, other.bound, target.bound);
                return Err(SceneError::new(message));
            }
        }
        let (most, least) = (asked.map_or(LIMIT, u64::from), REPLICATES as u64);
        if self.judges() && most < least {
            let message =
                format!("--target-error compares {least} replicates of each pixel: it needs --spp {least} or more");
            return Err(SceneError::new(message));
        }
        if self.judges() && self.adaptive.is_some() {
            let error = SceneError::new("--adaptive and --target-error do not go together");
            return Err(error.help("--target-error shares samples out by itself, for what it bounds"));
        }
        let aim = self.shares_out();
        if aim.is_some() && self.time.is_none() && own < LEAST_SHARED {
            let message = format!(
                "--adaptive shares samples out by the first quarter of them: it needs --spp {LEAST_SHARED} or more"
            );
            return Err(SceneError::new(message));
        }
        Ok(match (self.target_error.is_empty(), self.time) {
            (true, None) => Effort::Samples { samples: u64::from(own), aim },
            (true, Some(time)) => Effort::Time { time, most, aim },
            (false, time) => Effort::Error { targets: self.target_error.clone(), time, most },
        })
    }
}

/// Says how large the error still is.
pub fn so_far(look: &Look) -> String {
    let each =
        |(target, bound): (&Target, &Bound)| format!("{} ≤ {:.3} of {}", target.measure, bound.promised, target.bound);
    let all: Vec<String> = look.targets.iter().zip(&look.bounds).map(each).collect();
    format!("{:>6.0} samples a pixel: {}", look.mean_samples, all.join(", "))
}

impl Reached {
    /// Says why nothing can be promised, where light that may be missing is more than was asked for.
    pub fn reason(&self) -> Option<String> {
        let missing = |(target, bound): &(&Target, &Bound)| bound.missed > target.bound && bound.missed.is_finite();
        let (target, bound) = self.targets.iter().zip(&self.bounds).find(missing)?;
        Some(format!(
            "nothing aims at some of the light: {}. {:.0} samples a pixel may have missed what adds {:.3} to the {}; \
             what they found has about {:.3}",
            self.way, self.mean_samples, bound.missed, target.measure, bound.estimate
        ))
    }

    /// Says whether a handful of samples decide about the error.
    pub fn held_by(&self) -> Option<String> {
        let pixels = self.held?;
        let what = if pixels == 1 { "one pixel holds" } else { "pixels hold" };
        let count = if pixels == 1 { String::new() } else { format!("{pixels} ") };
        Some(format!(
            "{count}{what} half of the squared error: a few bright samples decide it, and what is promised leaves room for more of them"
        ))
    }
}

impl fmt::Display for Reached {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (i, (target, bound)) in self.targets.iter().zip(&self.bounds).enumerate() {
            let sign = if i == 0 { "" } else { "; " };
            let Bound { promised, estimate, .. } = bound;
            let Target { measure, bound } = target;
            match promised.is_finite() {
                true => write!(
                    f,
                    "{sign}{measure} at most {promised:.3} with 95 % confidence (about {estimate:.3}), asked for {bound}"
                ),
                false => write!(f, "{sign}{measure}: nothing tells how large it is, asked for {bound}"),
            }?;
        }
        Ok(())
    }
}
