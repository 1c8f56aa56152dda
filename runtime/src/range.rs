//! The configurations, solids and textures that an arithmetic can hold.
//!
//! Floats hold everything that is valid. Fixed point is narrower: see
//! [units](crate::quantity::unit).

use crate::{
    arithmetic::{Arithmetic, Fixed, Float},
    config::{Config, ConfigError},
    load_error::LoadError,
    math::{max, sqrt},
};
use asperity_formats::{Asset, Direction, LawPoint, Solid};

/// Checks against the range of an arithmetic.
pub trait Checked: Arithmetic {
    /// The largest max |A(e^jω)| of a model.
    const LARGEST_MAGNITUDE: f32;

    /// Checks that a configuration lies in the range.
    ///
    /// # Errors
    /// The first field out of range.
    fn check_config(config: &Config) -> Result<(), ConfigError>;

    /// Checks that a solid lies in the range.
    ///
    /// # Errors
    /// The first field out of range.
    fn check_solid(solid: &Solid) -> Result<(), ConfigError>;

    /// Checks that a texture lies in the range.
    ///
    /// # Errors
    /// [`LoadError::Range`] with the first field out of range.
    fn check_asset(asset: &Asset<'_>) -> Result<(), LoadError>;
}

impl Checked for Float {
    // The range of |A(e^jω)| bounds it: its minimum is at most 1.
    const LARGEST_MAGNITUDE: f32 = f32::MAX;

    fn check_config(_: &Config) -> Result<(), ConfigError> {
        Ok(())
    }

    fn check_solid(_: &Solid) -> Result<(), ConfigError> {
        Ok(())
    }

    fn check_asset(_: &Asset<'_>) -> Result<(), LoadError> {
        Ok(())
    }
}

impl Checked for Fixed {
    // Partial products end at 64.
    const LARGEST_MAGNITUDE: f32 = 32.0;

    fn check_config(config: &Config) -> Result<(), ConfigError> {
        check_config(config)
    }

    fn check_solid(solid: &Solid) -> Result<(), ConfigError> {
        check_solid(solid)
    }

    fn check_asset(asset: &Asset<'_>) -> Result<(), LoadError> {
        check_asset(asset)
    }
}

/// Largest coordinate of a position, and size of a solid, m.
const FARTHEST_M: f32 = 1.0;
const STRONGEST_PEAK_N: f32 = 1000.0;
const WEAKEST_PEAK_N: f32 = 1.0e-3;
/// The smallest slew in a tick: six steps of a force.
const WEAKEST_STEP_N: f32 = 1.0e-4;
/// The lowest cut-off, in servo rates. A low-pass this slow still moves in steps far below a
/// millimetre per second.
const SLOWEST_CUTOFF: f32 = 0.001;
const FASTEST_GRID_MM_S: f32 = 1000.0;
const SLOWEST_GRID_MM_S: f32 = 1.0;
const WEAKEST_GRID_N: f32 = 0.01;
const LOUDEST_M_S2: f32 = 500.0;
/// Numbers of this unit end at 8.
const LARGEST_MU_FACTOR: f32 = 7.9999;

fn check_config(config: &Config) -> Result<(), ConfigError> {
    let slowest_hz = SLOWEST_CUTOFF * config.servo_rate_hz;
    let too_slow = "in fixed point at least 0.001 of the servo rate";
    for (field, value, fits, rule) in [
        (
            "limits.peak_n",
            config.limits.peak_n,
            (WEAKEST_PEAK_N..=STRONGEST_PEAK_N).contains(&config.limits.peak_n),
            "in fixed point 0.001 to 1000 N",
        ),
        (
            "limits.slew_n_s",
            config.limits.slew_n_s,
            config.limits.slew_n_s >= 0.999 * WEAKEST_STEP_N * config.servo_rate_hz,
            "in fixed point at least 1e-4 N a tick",
        ),
        (
            "velocity_cutoff_hz",
            config.velocity_cutoff_hz,
            config.velocity_cutoff_hz >= slowest_hz,
            too_slow,
        ),
        (
            "normal_cutoff_hz",
            config.normal_cutoff_hz,
            config.normal_cutoff_hz >= slowest_hz,
            too_slow,
        ),
        (
            "safety.reach_m",
            config.safety.reach_m,
            config.safety.reach_m <= FARTHEST_M,
            "in fixed point at most 1 m",
        ),
    ] {
        if !fits {
            return Err(ConfigError { field, value, rule });
        }
    }
    check_solid(&config.solid)
}

fn check_solid(solid: &Solid) -> Result<(), ConfigError> {
    let (field, numbers) = match *solid {
        Solid::Plane { point_m, .. } => ("solid.point_m", [point_m, [0.0; 3]]),
        Solid::Sphere { center_m, radius_m } => ("solid.sphere", [center_m, [radius_m; 3]]),
        Solid::Box {
            center_m,
            half_extents_m,
        } => ("solid.box", [center_m, half_extents_m]),
    };
    let numbers = numbers.as_flattened();
    match numbers.iter().find(|x| x.abs() > FARTHEST_M) {
        Some(&value) => Err(ConfigError {
            field,
            value,
            rule: "in fixed point at most 1 m from the origin",
        }),
        None => Ok(()),
    }
}

fn check_asset(asset: &Asset<'_>) -> Result<(), LoadError> {
    let grid = asset.grid();
    let (speed, force) = (grid.max_speed_mm_s(), grid.max_force_n());
    let range = |field, value, least, most| {
        if value >= least && value <= most {
            Ok(())
        } else {
            Err(LoadError::Range {
                field,
                value,
                least,
                most,
            })
        }
    };
    let speeds = (SLOWEST_GRID_MM_S, FASTEST_GRID_MM_S);
    range("grid.max_speed_mm_s", speed, speeds.0, speeds.1)?;
    range("grid.max_force_n", force, WEAKEST_GRID_N, f32::MAX)?;
    let level = match asset.direction() {
        Some(direction) => check_direction(asset, direction, range)?,
        None => 1.0,
    };
    grid.vertices().try_for_each(|vertex| {
        let gain = grid
            .model(usize::from(vertex.model))
            .map_or(0.0, |model| model.gain);
        range(
            "grid gain·sigma_m_s2",
            level * gain * vertex.sigma_m_s2,
            0.0,
            LOUDEST_M_S2,
        )
    })
}

/// Checks that μ of a law and of a direction together lies in the range; returns the largest factor of the level in any
/// direction.
fn check_direction(
    asset: &Asset<'_>,
    direction: &Direction,
    range: impl Fn(&'static str, f32, f32, f32) -> Result<(), LoadError>,
) -> Result<f32, LoadError> {
    let law = asset.friction().law().into_iter();
    let factors = law.flat_map(|law| law.points().map(LawPoint::factor));
    let factor = factors.reduce(max).unwrap_or(1.0);
    let ratio = max(direction.mu_forward, direction.mu_backward);
    let field = "friction.law.factor · direction.mu";
    range(field, factor * max(ratio, 1.0), 0.0, LARGEST_MU_FACTOR)?;
    let speed = direction.speed_ratio;
    Ok(sqrt(1.0 + direction.power_ratio / (speed * speed)))
}
