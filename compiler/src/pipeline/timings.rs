//! Which passes ran, and how long each took.

use serde_json::{Map, Value, json};
use std::{fmt, time::Duration};

/// Clock: the time since an arbitrary origin. The default stands still, so that passes take no time where there is no
/// clock; callers that have one pass it in.
#[derive(Clone, Copy)]
pub struct Clock(pub fn() -> Duration);

impl Default for Clock {
    fn default() -> Self {
        Self(|| Duration::ZERO)
    }
}

impl fmt::Debug for Clock {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Clock")
    }
}

/// A step on the way from a source to a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Pass {
    /// A built-in texture is computed.
    Generate,
    /// A file becomes a model.
    Read,
    /// A recording is checked, and its files are aligned.
    Check,
    /// The resonances of tool and sensor are found and compensated.
    Resonance,
    /// A recording is cut into stretches of strokes.
    Segments,
    /// Models are fitted over speed and force.
    Grid,
    /// Friction is measured.
    Friction,
    /// Impacts are found, and become transients.
    Taps,
    /// A prompt becomes a text vector and a latent.
    Text,
    /// A latent becomes a model.
    Decode,
    /// A missing modality is decoded from the other.
    Complete,
    /// The models are converted to another rate.
    Rerate,
    /// The models are moved towards white noise.
    Stabilise,
    /// The model is reduced to the fidelity.
    Reduce,
    /// The gains are lowered to what the device can hold.
    Ceiling,
    /// The preview is drawn.
    Preview,
    /// The model becomes the bytes of an asset.
    Lower,
    /// The runtime renders the asset over its whole domain.
    Verify,
    /// The asset is compared with its source.
    Compare,
    /// A fidelity is chosen for every texture of a scene, and the library is packed.
    Pack,
    /// Files are written.
    Write,
}

impl Pass {
    /// The name that reports use.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Generate => "generate",
            Self::Read => "read",
            Self::Check => "check and align",
            Self::Resonance => "resonance",
            Self::Segments => "segments",
            Self::Grid => "grid",
            Self::Friction => "friction",
            Self::Taps => "taps",
            Self::Text => "text",
            Self::Decode => "decode",
            Self::Complete => "complete",
            Self::Rerate => "rerate",
            Self::Stabilise => "stabilise",
            Self::Reduce => "reduce",
            Self::Ceiling => "ceiling",
            Self::Preview => "preview",
            Self::Lower => "lower",
            Self::Verify => "verify",
            Self::Compare => "compare",
            Self::Pack => "pack",
            Self::Write => "write",
        }
    }
}

/// The time each pass took, in the order in which the passes first ran.
///
/// A pass that runs several times counts with the sum. Of work on several threads the times of
/// all threads are added, so the total can exceed the time on the clock. Nothing that is
/// compiled depends on these numbers.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Timings(Vec<(Pass, Duration)>);

impl Timings {
    /// Adds the times of other work.
    pub fn merge(&mut self, other: &Self) {
        for (pass, took) in other.iter() {
            self.add(pass, took);
        }
    }

    /// The passes with their times.
    pub fn iter(&self) -> impl Iterator<Item = (Pass, Duration)> + '_ {
        self.0.iter().copied()
    }

    /// The times in milliseconds, by the names of the passes.
    #[must_use]
    pub fn json(&self) -> Value {
        let entry = |(pass, took): (Pass, Duration)| {
            let ms = json!(1e3 * took.as_secs_f64());
            (pass.name().to_owned(), ms)
        };
        self.iter().map(entry).collect::<Map<_, _>>().into()
    }

    pub(super) fn add(&mut self, pass: Pass, took: Duration) {
        match self.0.iter_mut().find(|(known, _)| *known == pass) {
            Some((_, sum)) => *sum += took,
            None => self.0.push((pass, took)),
        }
    }
}

/// A table with one line a pass, in milliseconds.
impl fmt::Display for Timings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut line = |name: &str, took: Duration| {
            writeln!(f, "  {name:<15} {:>10.3} ms", 1e3 * took.as_secs_f64())
        };
        for (pass, took) in self.iter() {
            line(pass.name(), took)?;
        }
        line("total", self.iter().map(|(_, took)| took).sum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::Pipeline;
    use std::cell::Cell;

    #[test]
    fn a_pass_that_runs_twice_counts_once_with_the_sum() {
        let pause = Duration::from_millis(2);
        let mut timings = Timings::default();
        for pass in [Pass::Reduce, Pass::Lower, Pass::Reduce] {
            timings.add(pass, pause);
        }
        let mut both = timings.clone();
        both.merge(&timings);
        let passes: Vec<Pass> = both.iter().map(|(pass, _)| pass).collect();
        assert_eq!(passes, [Pass::Reduce, Pass::Lower]);
        for ((_, once), (_, twice)) in timings.iter().zip(both.iter()) {
            assert_eq!(2 * once, twice);
        }
        let took: Vec<Duration> = timings.iter().map(|(_, took)| took).collect();
        assert_eq!(took, [2 * pause, pause]);
    }

    #[test]
    fn work_takes_the_time_that_the_clock_says() {
        thread_local!(static NOW: Cell<Duration> = const { Cell::new(Duration::MAX) });
        NOW.set(Duration::from_secs(5));
        for (clock, took) in [
            (Clock(|| NOW.get()), Duration::from_secs(3)),
            (Clock::default(), Duration::ZERO),
        ] {
            let mut pipeline = Pipeline::timed(clock);
            pipeline.run(Pass::Read, || NOW.set(NOW.get() + Duration::from_secs(3)));
            assert_eq!(pipeline.timings().0, [(Pass::Read, took)]);
        }
    }
}
