//! Auto-gain: gains that a device can hold, for each texture on its own.
//!
//! A device gives its peak force for moments and its continuous force for hours. The ceiling lowers
//! `g_vib` until the RMS of the vibration stays within the continuous force everywhere on the grid,
//!
//! ```text
//! g_vib·F_max·rms(v, F_n) ≤ F_c,   F_c = F_max·0.88/3.3
//! ```
//!
//! and then both gains until wall, friction, vibration (at three times its RMS) and tap together
//! stay within the peak wherever the wall alone is within F_c. A harder push than that takes the
//! whole device by itself, and the limiter shortens the sum. Models and traces stay as they are, so
//! the objective attributes do.
//!
//! ```
//! use asperity::{sources::builtin, passes::ceiling};
//!
//! let mut texture = builtin::texture();
//! for vertex in &mut texture.grid.vertices {
//!     vertex.sigma_m_s2 *= 100.0;
//! }
//! let before = texture.gains;
//! ceiling::limit(&mut texture);
//! assert!(texture.gains.vib_s2_m < before.vib_s2_m);
//! ```

use asperity_texture::{
    model::{
        Direction, Gains, Numerator, TextureModel,
        mixture::{self, Field},
    },
    signal::{level, reflection, spectrum::ArmaModel},
};

/// Continuous force of the 3D Systems Touch over its peak force: 0.88 N of 3.3 N.
pub const CONTINUOUS_SHARE: f64 = 0.88 / 3.3;
/// Multiples of its RMS that a vibration is given room for. Noise exceeds them once in 370 samples.
const CREST: f64 = 3.0;
/// Room for rounding: gains are stored in binary32, levels in binary16.
const ROOM: f64 = 0.999;
/// Frequencies that the power of a model with zeros is averaged over.
const POINTS: usize = 2048;

/// Lowers the gains of a texture as far as its device asks, never raises them.
pub fn limit(texture: &mut TextureModel) {
    let gains = texture.gains;
    let peak_n = gains.f_max_n;
    let continuous_n = CONTINUOUS_SHARE * peak_n;
    let levels = levels(texture);
    let to_force = gains.vib_s2_m * gains.f_max_n;
    let asked_n = to_force * loudest(&levels);
    let mut vibration = factor(continuous_n, asked_n);
    for at in levels.iter().filter(|at| at.force_n <= continuous_n) {
        // Wall and friction stand at right angles; the vibration goes along the friction.
        let along_n = (peak_n * peak_n - at.force_n * at.force_n).sqrt();
        let room_n = along_n - at.mu * at.force_n;
        // Where friction alone takes the device, no gain of the vibration helps.
        if room_n > 0.0 {
            vibration = vibration.min(factor(room_n, CREST * to_force * at.rms_m_s2));
        }
    }
    let taps = taps(texture, continuous_n);
    texture.gains = Gains {
        vib_s2_m: gains.vib_s2_m * vibration,
        effective_mass_kg: gains.effective_mass_kg * taps,
        ..gains
    };
}

/// The factor on the effective mass: m_eff·a(t) + k·v·t stays within the peak while the wall's
/// k·v·t, or the force of its spring, of a hand that does not slow down, is within the continuous force.
fn taps(texture: &TextureModel, continuous_n: f64) -> f64 {
    let rate_hz = texture.taps.sample_rate_hz;
    let (peak_n, mass_kg) = (texture.gains.f_max_n, texture.gains.effective_mass_kg);
    let mut taps = 1.0_f64;
    for trace in &texture.taps.traces {
        for (n, accel_m_s2) in trace.accel_m_s2.iter().enumerate() {
            let depth_m = trace.speed_m_s * n as f64 / rate_hz;
            let stiffness_n_m = texture.wall.stiffness_n_m;
            let wall_n = match &texture.contact {
                Some(law) => law.spring_n(1000.0 * depth_m, stiffness_n_m),
                None => stiffness_n_m * trace.speed_m_s * n as f64 / rate_hz,
            };
            if wall_n <= continuous_n {
                taps = taps.min(factor(peak_n - wall_n, mass_kg * accel_m_s2));
            }
        }
    }
    taps
}

/// Returns the factor that reduces `asked` to `most`; 1 if it is within.
fn factor(most: f64, asked: f64) -> f64 {
    if asked > most {
        ROOM * most / asked
    } else {
        1.0
    }
}

/// The vibration at a place of the grid.
struct Level {
    force_n: f64,
    rms_m_s2: f64,
    mu: f64,
}

/// Levels across the axis; along it and halfway, too, where there is one.
fn levels(texture: &TextureModel) -> Vec<Level> {
    let grid = &texture.grid;
    let field = Field::new(grid);
    let places = mixture::places(grid);
    let sines: &[f64] = if texture.direction.is_some() {
        &[0.0, 0.5, 1.0]
    } else {
        &[0.0]
    };
    let direction = texture.direction.unwrap_or(Direction::NONE);
    let at = |sine: &f64| {
        let factors = direction.at(*sine);
        let level = |&(speed_mm_s, force_n): &(f64, f64)| {
            let model = field.model(&field.locate(factors.speed * speed_mm_s, force_n)?);
            Some(Level {
                force_n,
                rms_m_s2: factors.level * rms_m_s2(&model, grid.numerator),
                mu: factors.mu * texture.friction.mu_at(speed_mm_s),
            })
        };
        places.iter().filter_map(level).collect::<Vec<_>>()
    };
    sines.iter().flat_map(at).collect()
}

/// Largest RMS of the vibration anywhere on the grid of a texture, in any direction, m/s².
#[must_use]
pub fn loudest_m_s2(texture: &TextureModel) -> f64 {
    loudest(&levels(texture))
}

fn loudest(levels: &[Level]) -> f64 {
    levels.iter().map(|at| at.rms_m_s2).fold(0.0, f64::max)
}

/// RMS of what a model vibrates with, m/s².
fn rms_m_s2(model: &ArmaModel, numerator: Numerator) -> f64 {
    if numerator == Numerator::Nyquist {
        // An unstable model is verified away later; its level counts as it is.
        return reflection::step_down(&model.a).map_or(model.level_m_s2, |reflection| {
            model.level_m_s2 * level::nyquist_rms_of(&reflection)
        });
    }
    let half = model.sample_rate_hz / 2.0;
    let power = |n: usize| model.power((n as f64 + 0.5) / POINTS as f64 * half);
    ((0..POINTS).map(power).sum::<f64>() / POINTS as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sources::builtin;
    use asperity_texture::model::{FrictionLaw, LawPoint, attributes};

    fn louder(factor: f64) -> TextureModel {
        let mut texture = builtin::texture();
        for vertex in &mut texture.grid.vertices {
            vertex.sigma_m_s2 *= factor;
        }
        texture
    }

    fn rms_n(texture: &TextureModel) -> f64 {
        texture.gains.vib_s2_m * texture.gains.f_max_n * loudest_m_s2(texture)
    }

    #[test]
    fn a_texture_within_the_device_keeps_its_gains() {
        let mut texture = builtin::texture();
        limit(&mut texture);
        assert_eq!(texture, builtin::texture());
    }

    #[test]
    fn a_loud_texture_comes_down_to_the_continuous_force_and_feels_as_rough_by_its_attributes() {
        let mut texture = louder(300.0);
        let before = attributes::of(&texture);
        assert!(rms_n(&texture) > 0.88);
        limit(&mut texture);
        let lowered_n = rms_n(&texture);
        assert!((0.87..0.88).contains(&lowered_n), "{lowered_n}");
        assert_eq!(attributes::of(&texture), before);
        // The second time there is nothing to lower.
        let once = texture.clone();
        limit(&mut texture);
        assert_eq!(texture, once);
    }

    #[test]
    fn friction_leaves_the_peaks_of_a_vibration_their_room() {
        // A coefficient of 3, a law that reaches it from 0.5 within 1 mm/s, and a nap that has it one way.
        let point = |speed_mm_s, factor| LawPoint { speed_mm_s, factor };
        let law = FrictionLaw {
            points: vec![point(0.0, 1.0), point(1.0, 6.0)],
        };
        let nap = Direction {
            mu_backward: 3.0,
            ..Direction::NONE
        };
        for (mu, law, direction) in [
            (3.0, None, None),
            (0.5, Some(law), None),
            (1.0, None, Some(nap)),
        ] {
            let mut texture = louder(300.0);
            // As loud under a light hand as under a heavy one.
            let loud = texture.grid.vertices[texture.grid.vertices.len() - 1].clone();
            for vertex in &mut texture.grid.vertices {
                vertex.lsf_rad.clone_from(&loud.lsf_rad);
                vertex.sigma_m_s2 = loud.sigma_m_s2;
            }
            (texture.friction.mu, texture.friction.law) = (mu, law);
            texture.direction = direction;
            limit(&mut texture);
            let peak_n = texture.gains.f_max_n;
            let continuous_n = CONTINUOUS_SHARE * peak_n;
            // Friction takes so much that the continuous force is no longer what limits.
            assert!(rms_n(&texture) < 0.8 * continuous_n);
            let to_force = texture.gains.vib_s2_m * peak_n;
            let share = |at: &Level| {
                let along_n = at.mu * at.force_n + 3.0 * to_force * at.rms_m_s2;
                at.force_n.hypot(along_n) / peak_n
            };
            let levels = levels(&texture);
            let steepest = levels.iter().map(|at| at.mu).fold(0.0, f64::max);
            assert!((steepest - 3.0).abs() < 1e-9);
            let light = levels.iter().filter(|at| at.force_n <= continuous_n);
            let most = light.map(share).fold(0.0, f64::max);
            assert!((0.99..1.0).contains(&most), "μ {mu}: {most} of the peak");
        }
    }

    #[test]
    fn a_tap_beyond_the_peak_comes_down_to_it() {
        let mut texture = builtin::texture();
        for trace in &mut texture.taps.traces {
            trace.accel_m_s2.iter_mut().for_each(|a| *a *= 50.0);
        }
        let before_kg = texture.gains.effective_mass_kg;
        limit(&mut texture);
        assert!(texture.gains.effective_mass_kg < before_kg);
        let largest = texture.taps.traces.iter().flat_map(|t| &t.accel_m_s2);
        let largest_n = texture.gains.effective_mass_kg * largest.fold(0.0, |m: f64, &a| m.max(a));
        assert!(largest_n <= texture.gains.f_max_n, "{largest_n}");
    }

    #[test]
    fn the_closed_form_and_the_average_agree() {
        let texture = builtin::texture();
        let vertex = texture.grid.vertices.last().unwrap();
        let model = ArmaModel::at_vertex(&texture.grid, vertex);
        let closed = rms_m_s2(&model, Numerator::Nyquist);
        let average = rms_m_s2(&model, Numerator::Lsf);
        assert!(
            (closed - average).abs() <= 1e-3 * closed,
            "{closed} {average}"
        );
    }
}
