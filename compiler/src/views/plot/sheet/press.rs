//! A press, a hold and a release on what gives way, as the runtime renders them on the default device.

use crate::emit::lower::lower;
use asperity_formats::Asset;
use asperity_runtime::{Config, HostTexture, Renderer, Sample, State};
use asperity_texture::model::TextureModel;

/// Speed of pressing and leaving, m/s.
pub(super) const SPEED_M_S: f64 = 0.05;
/// Time of a hold, s.
pub(super) const HOLD_S: f64 = 1.0;

/// Depths, mm, and forces away from the surface, N.
pub(super) struct Press {
    pub down: Vec<(f64, f64)>,
    pub held: Vec<(f64, f64)>,
    pub up: Vec<(f64, f64)>,
}

/// Presses to a force, holds the depth and leaves. `None` where the texture cannot be an asset.
pub(super) fn press(model: &TextureModel, force_n: f64) -> Option<Press> {
    let silent = model.clone().silent();
    let bytes = lower(&silent, None).ok()?.bytes;
    let asset = Asset::parse(&bytes).ok()?;
    let config = Config {
        servo_rate_hz: silent.grid.sample_rate_hz as f32,
        ..Config::default()
    };
    let renderer = Renderer::new(&config).ok()?;
    let mut slot = Box::new(HostTexture::new());
    slot.load(&asset, config.servo_rate_hz).ok()?;
    let deepest_mm = model
        .contact
        .as_ref()?
        .pressed_mm(force_n, model.wall.stiffness_n_m);
    let tick_s = 1.0 / f64::from(config.servo_rate_hz);
    let step_mm = 1000.0 * SPEED_M_S * tick_s;
    let mut state = State::new(1);
    let mut at = |depth_mm: f64| {
        let sample = Sample::at([0.0, 0.0, (-depth_mm / 1000.0) as f32]);
        let [.., up_n] = renderer.tick(&slot, &mut state, &sample).force_n;
        (depth_mm, f64::from(up_n))
    };
    // The first tick has no speed.
    at(-step_mm);
    let mut down = Vec::new();
    let mut depth_mm = 0.0;
    while depth_mm < deepest_mm && down.last().is_none_or(|&(_, up_n)| up_n < force_n) {
        down.push(at(depth_mm));
        depth_mm += step_mm;
    }
    let held = (0..(HOLD_S / tick_s) as usize)
        .map(|_| at(depth_mm))
        .collect();
    let steps = (0..=(depth_mm / step_mm) as usize).rev();
    let up = steps.map(|n| at(n as f64 * step_mm)).collect();
    Some(Press { down, held, up })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Claim: memory foam bears less while it is held, and gives back less than it took; the force is met.
    #[test]
    fn a_press_has_a_hold_and_a_loop() {
        let mut model = crate::sources::builtin::texture();
        let foam =
            crate::learned::contact::materials().find(|material| material.name == "memory foam");
        crate::learned::contact::set(&mut model, Some(foam.unwrap().law.clone()));
        let Press { down, held, up } = press(&model, 1.0).unwrap();
        let work = |path: &[(f64, f64)]| path.iter().map(|(_, force_n)| force_n).sum::<f64>();
        assert!((down.last().unwrap().1 - 1.0).abs() < 0.05);
        assert!(held.last().unwrap().1 < 0.8 * held[0].1);
        assert!(work(&up) < 0.8 * work(&down));
        assert!(
            press(&crate::sources::builtin::texture(), 1.0).is_none(),
            "a wall has no loop"
        );
    }
}
