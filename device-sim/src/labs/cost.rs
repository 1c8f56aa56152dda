//! What a design costs: executed instructions of mixing, conversion and synthesis, bytes of
//! an asset, and time beside the default.
//!
//! Instructions are callgrind's, of this very program running one kernel for n and for 2n
//! ticks: the difference over n is one tick, without start-up. They hardly depend on the
//! numbers that are computed with, so a made-up texture of the same orders stands for all.

use super::design::{Design, variants};
use super::kernel::{Rendering, kernel};
use asperity::{
    interpolate::Place,
    lower,
    model::{GridVertex, ModelGrid, Numerator, TextureModel, VertexKind},
};
use std::{
    collections::HashMap,
    env,
    hint::black_box,
    process::Command,
    sync::Mutex,
    time::{Duration, Instant},
};
use thiserror::Error;

/// Name of the hidden command that runs one kernel.
pub const COMMAND: &str = "pareto-kernel";
/// Ticks of a counted run: a multiple of every update interval.
const TICKS: usize = 1632;
/// Ticks of a timed run, and how many of them.
const TIMED: (usize, usize) = (20_000, 7);

/// The orders that a cost depends on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Orders {
    /// Poles.
    pub poles: usize,
    /// Zeros of a numerator of its own.
    pub zeros: usize,
    /// Whether the numerator is 1 + z⁻¹.
    pub nyquist: bool,
}

impl Orders {
    /// Of a grid.
    #[must_use]
    pub fn of(grid: &ModelGrid) -> Self {
        let zeros = grid.vertices.first().and_then(|v| v.ma_lsf_rad.as_ref());
        Self {
            poles: grid.order,
            zeros: match grid.numerator {
                Numerator::Lsf => zeros.map_or(0, Vec::len),
                Numerator::None | Numerator::Nyquist => 0,
            },
            nyquist: grid.numerator == Numerator::Nyquist,
        }
    }

    /// A grid of these orders: one triangle, LSFs spread evenly and then moved a little.
    fn grid(self) -> ModelGrid {
        let spread = |order: usize, seed: usize| -> Vec<f64> {
            let step = std::f64::consts::PI / (order + 1) as f64;
            (1..=order)
                .map(|k| step * (k as f64 + 0.3 * ((k * 37 + seed * 101) as f64).sin()))
                .collect()
        };
        let vertices = [(0.0, 0.0), (250.0, 0.0), (0.0, 4.0)]
            .into_iter()
            .enumerate()
            .map(|(index, (speed_mm_s, force_n))| GridVertex {
                speed_mm_s,
                force_n,
                kind: VertexKind::Edge,
                lsf_rad: spread(self.poles, index),
                ma_lsf_rad: (self.zeros > 0).then(|| spread(self.zeros, index + 7)),
                gain: 1.0,
                sigma_m_s2: 0.1 * (index + 1) as f64,
            })
            .collect();
        ModelGrid {
            sample_rate_hz: 1000.0,
            order: self.poles,
            numerator: match (self.zeros, self.nyquist) {
                (0, false) => Numerator::None,
                (0, true) => Numerator::Nyquist,
                _ => Numerator::Lsf,
            },
            vertices,
            triangles: vec![[0, 1, 2]],
        }
    }

    /// As arguments of the hidden command.
    fn arguments(self) -> [String; 3] {
        [
            self.poles.to_string(),
            self.zeros.to_string(),
            u8::from(self.nyquist).to_string(),
        ]
    }
}

/// Why instructions could not be counted.
#[derive(Debug, Error)]
pub enum CountError {
    /// There is no valgrind.
    #[error("valgrind cannot be started ({0})")]
    Missing(std::io::Error),
    /// It printed no count.
    #[error("valgrind counted nothing: {0}")]
    Nothing(String),
}

/// Counts instructions, every kind of kernel once.
#[derive(Default)]
pub struct Counter {
    known: Mutex<HashMap<(usize, Orders), f64>>,
}

impl Counter {
    /// Instructions a tick of a design on a texture of some orders, in a process of their
    /// own: the running program must know [`COMMAND`].
    ///
    /// # Errors
    /// [`CountError`].
    pub fn instructions(&self, design: &Design, orders: Orders) -> Result<Option<f64>, CountError> {
        let Some(index) = variants().iter().position(|v| v.design == *design) else {
            return Ok(None);
        };
        let lock = || {
            self.known
                .lock()
                .unwrap_or_else(|poisoned| poisoned.into_inner())
        };
        if let Some(&known) = lock().get(&(index, orders)) {
            return Ok(Some(known));
        }
        let (once, twice) = (
            counted(index, orders, TICKS)?,
            counted(index, orders, 2 * TICKS)?,
        );
        let a_tick = twice.saturating_sub(once) as f64 / TICKS as f64;
        lock().insert((index, orders), a_tick);
        Ok(Some(a_tick))
    }
}

fn counted(variant: usize, orders: Orders, ticks: usize) -> Result<u64, CountError> {
    let program = env::current_exe().map_err(CountError::Missing)?;
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args([COMMAND, &variant.to_string()])
        .args(orders.arguments())
        .arg(ticks.to_string())
        .output()
        .map_err(CountError::Missing)?;
    let log = String::from_utf8_lossy(&output.stderr);
    log.lines()
        .find_map(|line| line.split("Collected :").nth(1))
        .and_then(|count| count.trim().parse().ok())
        .ok_or_else(|| {
            let last = log.lines().last().unwrap_or("it printed nothing");
            CountError::Nothing(last.to_owned())
        })
}

/// The hidden command: variant, poles, zeros, whether 1 + z⁻¹, ticks.
///
/// Gives the last sample, or `None` for arguments that name no kernel.
#[must_use]
pub fn run(arguments: &[usize]) -> Option<f64> {
    let &[variant, poles, zeros, nyquist, ticks] = arguments else {
        return None;
    };
    let orders = Orders {
        poles,
        zeros,
        nyquist: nyquist == 1,
    };
    let mut kernel = kernel(&variants().get(variant)?.design, &orders.grid())?;
    Some(spun(kernel.as_mut(), ticks))
}

/// Ticks at places that wander through the triangle.
fn spun(kernel: &mut dyn Rendering, ticks: usize) -> f64 {
    let places: Vec<Place> = (0..TICKS)
        .map(|n| {
            let t = n as f64 / TICKS as f64;
            Place {
                vertices: [0, 1, 2],
                weights: [0.5 - 0.3 * t, 0.2 + 0.5 * t, 0.3 - 0.2 * t],
            }
        })
        .collect();
    let epsilon: Vec<f64> = (0..TICKS).map(|n| ((n * n) as f64).sin()).collect();
    kernel.settle(&places[0]);
    black_box(kernel.repeat(&places, &epsilon, black_box(ticks)))
}

/// Time of a design over that of the default, on this machine, in one run: the best of
/// several, in turn. Informative: it depends on the machine and on its other users.
#[must_use]
pub fn time_ratio(design: &Design, orders: Orders) -> Option<f64> {
    let grid = orders.grid();
    let (mut other, mut default) = (kernel(design, &grid)?, kernel(&Design::DEFAULT, &grid)?);
    let timed = |kernel: &mut dyn Rendering| {
        let start = Instant::now();
        spun(kernel, TIMED.0);
        start.elapsed()
    };
    let (mut best, mut best_default) = (Duration::MAX, Duration::MAX);
    for _ in 0..TIMED.1 {
        best = best.min(timed(other.as_mut()));
        best_default = best_default.min(timed(default.as_mut()));
    }
    Some(best.as_secs_f64() / best_default.as_secs_f64())
}

/// Bytes that a runtime needs of a texture with this grid, its LSFs at `lsf_bits`; `None`
/// where the format does not hold it. At 16 bits they are counted, else the difference is
/// calculated.
#[must_use]
pub fn bytes(texture: &TextureModel, grid: &ModelGrid, lsf_bits: u32) -> Option<usize> {
    let texture = TextureModel {
        grid: grid.clone(),
        ..texture.clone()
    };
    let lowered = lower::lower(&texture, None).ok()?;
    let orders = Orders::of(grid);
    let codes = lowered.models * (orders.poles + orders.zeros);
    let packed = (codes * lsf_bits.min(16) as usize).div_ceil(8);
    Some(lowered.haptic_bytes - 2 * codes + packed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity::builtin;

    #[test]
    fn every_kernel_of_the_comparison_runs_alone() {
        for index in 0..variants().len() {
            for (zeros, nyquist) in [(18, 0), (0, 1), (0, 0)] {
                let last = run(&[index, 20, zeros, nyquist, 32]);
                assert!(last.is_some_and(f64::is_finite), "variant {index}");
            }
        }
        assert_eq!(run(&[9999, 20, 0, 1, 32]), None);
    }

    #[test]
    fn fewer_bits_are_fewer_bytes() {
        let texture = builtin::texture();
        let bytes = |bits| bytes(&texture, &texture.grid, bits).unwrap();
        let models = lower::lower(&texture, None).unwrap().models;
        assert_eq!(bytes(16) - bytes(8), models * texture.grid.order);
    }
}
