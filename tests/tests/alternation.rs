//! Speed and force that jump back and forth between two points do not make the vibration louder
//! than it is at the louder point. The jumps come at every sample, and in step with the cycles of
//! the runtime, which then sees each point in turn. Textures are the built-in one and HaTT
//! materials, servo loops run at the rate of the models and faster.

use crate::support;
use asperity_formats::Asset;
use asperity_runtime::quantity::Quantity;
use asperity_runtime::{HostTexture, stage::vibration::Vibration};
use asperity_tests::{
    draw::Draw,
    hatt,
    oracle::Texture,
    size::{Size, sized},
};
use rayon::prelude::*;

const SECOND: usize = 1000;
const BLOCK: usize = 20;
/// Samples at the start that are not counted, because the contact fades in.
const SETTLE: usize = 200;
/// Fraction of the way that parameters go in a cycle, for 5 ms at 1 kHz.
const FOLLOW: f64 = 5.0;

/// RMS over a second, and of every block of 20 ms. `query` gives speed and force of each tick.
fn levels(slot: &HostTexture, seed: u64, query: impl Fn(usize) -> (f32, f32)) -> (f64, Vec<f64>) {
    let fraction = (1.0 - (-f64::from(slot.cycle_samples()) / FOLLOW).exp()) as f32;
    let mut vibration = Vibration::new(seed);
    let ticks = usize::from(slot.ticks_per_sample());
    let signal: Vec<f64> = (0..(SETTLE + SECOND) * ticks)
        .map(|tick| {
            let (speed, force) = query(tick);
            let (at_speed, at_force) = (Quantity(speed), Quantity(force));
            let sounded = vibration.step(slot, at_speed, at_force, Quantity(fraction), true);
            assert!(!sounded.clamped, "{speed} mm/s, {force} N");
            sounded.y.value().into()
        })
        .skip(SETTLE * ticks)
        .collect();
    let rms = |part: &[f64]| (part.iter().map(|y| y * y).sum::<f64>() / part.len() as f64).sqrt();
    (
        rms(&signal),
        signal.chunks(BLOCK * ticks).map(rms).collect(),
    )
}

#[derive(Default)]
struct Excess {
    /// RMS of a second relative to that at the louder point alone, dB.
    seconds: Vec<f64>,
    /// RMS of blocks of 20 ms relative to the same, dB.
    blocks: Vec<f64>,
}

fn percentile(values: &mut [f64], share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let at = (share * (values.len() as f64 - 1.0)).round() as usize;
    values.get(at).copied().unwrap_or(f64::NEG_INFINITY)
}

impl Excess {
    /// Random pairs of points of one texture that alternate every `step`, in a loop at `ratio`
    /// times the rate of the models.
    fn of(bytes: &[u8], ratio: u8, step: Step, seed: u64) -> Self {
        let asset = Asset::parse(bytes).unwrap();
        let mut slot = Box::new(HostTexture::new());
        let servo_hz = asset.grid().sample_rate_hz() * f32::from(ratio);
        slot.load(&asset, servo_hz).unwrap();
        let every = step.ticks(&slot);
        let oracle = Texture::new(&asset);
        let mut draw = Draw::new(seed);
        let mut excess = Self::default();
        for pair in 0..Size::asked().of(4, 60) {
            let mut point = || {
                if draw.below(2) == 0 {
                    let v = &oracle.vertices[draw.below(oracle.vertices.len())];
                    return (v.speed_mm_s as f32, v.force_n as f32);
                }
                (
                    draw.range(0.0, oracle.max_speed_mm_s) as f32,
                    draw.range(0.0, oracle.max_force_n) as f32,
                )
            };
            let ends = [point(), point()];
            let stationary = ends.map(|end| levels(&slot, pair, |_| end).0);
            let loudest = stationary[0].max(stationary[1]);
            if loudest < 1e-6 {
                continue;
            }
            let (rms, blocks) = levels(&slot, pair, |tick| ends[tick / every % 2]);
            let db = |level: f64| 20.0 * (level / loudest).max(1e-9).log10();
            excess.seconds.push(db(rms));
            excess.blocks.extend(blocks.into_iter().map(db));
        }
        excess
    }

    fn and(mut self, other: Self) -> Self {
        self.seconds.extend(other.seconds);
        self.blocks.extend(other.blocks);
        self
    }

    fn verdict(&mut self, name: &str) {
        let second = percentile(&mut self.seconds, 1.0);
        let block = percentile(&mut self.blocks, 0.999);
        let (pairs, loudest) = (self.seconds.len(), percentile(&mut self.blocks, 1.0));
        println!(
            "{name}: {pairs} pairs, a second at most {second:.2} dB, blocks of 20 ms: \
             99.9 % below {block:.2} dB, loudest {loudest:.2} dB"
        );
        assert!(second <= 3.5 && block <= 7.0, "{name}: {second} {block}");
    }
}

/// Interval at which the query jumps from one point to the other.
#[derive(Debug, Clone, Copy)]
enum Step {
    Tick,
    Sample,
    /// Every cycle plus a number of ticks.
    Cycle(usize),
}

impl Step {
    const AT_ONE_KHZ: [Self; 3] = [Self::Sample, Self::Cycle(0), Self::Cycle(1)];

    fn ticks(self, slot: &HostTexture) -> usize {
        let sample = usize::from(slot.ticks_per_sample());
        match self {
            Self::Tick => 1,
            Self::Sample => sample,
            Self::Cycle(more) => usize::from(slot.cycle_samples()) * sample + more,
        }
    }
}

#[test]
fn the_builtin_texture() {
    for step in Step::AT_ONE_KHZ {
        Excess::of(&support::builtin(), 1, step, 1).verdict(&format!("built-in, {step:?}"));
    }
}

/// Jumps in a loop five or ten times as fast: in every tick, sample and cycle of the models, and
/// a little less often than every cycle.
#[test]
fn faster_loops() {
    for ratio in [5, 10] {
        for step in [Step::Tick, Step::Sample, Step::Cycle(0), Step::Cycle(1)] {
            let name = format!("built-in, {ratio} ticks a sample, {step:?}");
            Excess::of(&support::builtin(), ratio, step, 1).verdict(&name);
        }
    }
}

#[test]
#[cfg_attr(
    not(hatt),
    ignore = "no HaTT materials; set ASPERITY_HATT to their folder"
)]
fn every_hatt_material() {
    let files = hatt::some_materials(sized("every so many materials", 5, 1));
    for step in Step::AT_ONE_KHZ {
        files
            .par_iter()
            .map(|file| Excess::of(&support::hatt(file), 1, step, 2))
            .reduce(Excess::default, Excess::and)
            .verdict(&format!("HaTT, {step:?}"));
    }
    let (ratio, step) = (5, Step::Cycle(1));
    files
        .par_iter()
        .map(|file| Excess::of(&support::hatt(file), ratio, step, 2))
        .reduce(Excess::default, Excess::and)
        .verdict(&format!("HaTT, {ratio} ticks a sample, {step:?}"));
}
