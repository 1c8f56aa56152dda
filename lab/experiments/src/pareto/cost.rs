//! Cost of a design: executed instructions of mixing, conversion and synthesis, and bytes of an asset.
//!
//! Callgrind counts the instructions. It runs this program with a single kernel for n and for 2n ticks of a
//! [`Workload`]; the difference divided by n is the cost per tick, without start-up.

use super::contact;
use asperity::{
    emit::lower,
    model::{ModelGrid, Numerator, TextureModel},
};
use asperity_kernels::{
    design::{Design, variants},
    workload::{Orders, TICKS, Workload, kernel_of},
};
use std::{collections::HashMap, env, process::Command, sync::Mutex};
use thiserror::Error;

/// Name of the hidden command that runs one kernel.
pub const COMMAND: &str = "pareto-kernel";

/// The orders of a grid.
#[must_use]
pub fn orders(grid: &ModelGrid) -> Orders {
    let zeros = grid.vertices.first().and_then(|v| v.ma_lsf_rad.as_ref());
    Orders {
        poles: grid.order,
        zeros: match grid.numerator {
            Numerator::Lsf => zeros.map_or(0, Vec::len),
            Numerator::None | Numerator::Nyquist => 0,
        },
        nyquist: grid.numerator == Numerator::Nyquist,
    }
}

/// The orders as arguments of the hidden command.
fn numbers(orders: Orders) -> [usize; 3] {
    [orders.poles, orders.zeros, usize::from(orders.nyquist)]
}

/// Why instructions could not be counted.
#[derive(Debug, Error)]
pub enum CountError {
    /// Valgrind is not installed or does not start.
    #[error("valgrind cannot be started ({0})")]
    Missing(std::io::Error),
    /// Valgrind printed no count.
    #[error("valgrind counted nothing: {0}")]
    Nothing(String),
}

/// Counts instructions, once for each kind of kernel.
#[derive(Default)]
pub struct Counter {
    known: Mutex<HashMap<(usize, Orders), f64>>,
}

impl Counter {
    /// Instructions a tick of a design on a texture of given orders.
    ///
    /// The kernel runs in a process of its own, so the running program must know [`COMMAND`].
    ///
    /// # Errors
    /// [`CountError`] if valgrind does not start or prints no count.
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
        let a_tick = per_tick(&[&[index][..], &numbers(orders)].concat())?;
        lock().insert((index, orders), a_tick);
        Ok(Some(a_tick))
    }
}

/// Instructions a tick of what the hidden command runs with these numbers.
pub(super) fn per_tick(numbers: &[usize]) -> Result<f64, CountError> {
    let (once, twice) = (counted(numbers, TICKS)?, counted(numbers, 2 * TICKS)?);
    Ok(twice.saturating_sub(once) as f64 / TICKS as f64)
}

fn counted(numbers: &[usize], ticks: usize) -> Result<u64, CountError> {
    let program = env::current_exe().map_err(CountError::Missing)?;
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .arg(COMMAND)
        .args(numbers.iter().chain([&ticks]).map(usize::to_string))
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

/// The hidden command. Its arguments are variant, poles, zeros, whether the numerator is
/// 1 + z⁻¹, and ticks; or material and design of a contact law, and ticks.
///
/// Returns the last sample, or `None` for arguments that name no kernel.
#[must_use]
pub fn run(arguments: &[usize]) -> Option<f64> {
    let (variant, poles, zeros, nyquist, ticks) = match *arguments {
        [variant, poles, zeros, nyquist, ticks] => (variant, poles, zeros, nyquist, ticks),
        [material, design, ticks] => return contact::run([material, design], ticks),
        _ => return None,
    };
    let orders = Orders {
        poles,
        zeros,
        nyquist: nyquist == 1,
    };
    let mut kernel = kernel_of(&variants().get(variant)?.design, orders)?;
    Some(Workload::default().run(kernel.as_mut(), ticks))
}

/// Bytes that a runtime needs of a texture with this grid and LSFs of `lsf_bits` bits.
///
/// The bytes of an asset with 16 bits are counted; for fewer bits the difference is calculated.
/// `None` where the format cannot hold the texture.
#[must_use]
pub fn bytes(texture: &TextureModel, grid: &ModelGrid, lsf_bits: u32) -> Option<usize> {
    let texture = TextureModel {
        grid: grid.clone(),
        ..texture.clone()
    };
    let lowered = lower::lower(&texture, None).ok()?;
    let orders = orders(grid);
    let codes = lowered.models * (orders.poles + orders.zeros);
    let packed = (codes * lsf_bits.min(16) as usize).div_ceil(8);
    Some(lowered.haptic_bytes - 2 * codes + packed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity::sources::builtin;

    #[test]
    fn the_hidden_command_knows_every_kernel() {
        for index in 0..variants().len() {
            let last = run(&[index, 20, 18, 0, 32]);
            assert!(last.is_some_and(f64::is_finite), "variant {index}");
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
