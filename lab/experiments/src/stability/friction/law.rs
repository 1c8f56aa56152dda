//! Laws of friction along one axis: the runtime's and two others.

use asperity_runtime::Config;
use asperity_runtime::quantity::{Quantity, Vector};
use asperity_runtime::stage::friction::{Bristle, FrictionState};

use crate::stability::methods::{Regularised, Sign};

/// Servo period, s.
pub(super) const TICK_S: f64 = 1e-3;

/// A law of friction: from position along an axis, m, and normal force, N, to friction force, N.
pub type Law = Box<dyn FnMut(f64, f64) -> f64>;

/// The three laws at rest with their names, ours first.
#[must_use]
pub fn laws(mu: f64, delay_ticks: u32) -> [(&'static str, Law); 3] {
    [
        ("ours", ours(mu, delay_ticks)),
        ("paper's sign of v", {
            let mut law = Sign::new(1.0 / TICK_S);
            Box::new(move |x, normal_n| law.step(x, mu, normal_n))
        }),
        ("reference's viscous", {
            let mut law = Regularised::new(1.0 / TICK_S);
            Box::new(move |x, normal_n| law.step(x, mu, normal_n))
        }),
    ]
}

/// The runtime's bristle along one axis, for a loop with `delay_ticks` of delay.
#[must_use]
pub fn ours(mu: f64, delay_ticks: u32) -> Law {
    let rate_hz = (1.0 / TICK_S) as f32;
    let bristle: Bristle = Bristle::new(&Config::default().friction, delay_ticks, rate_hz);
    let mut state = FrictionState::default();
    let mut last_m = None;
    Box::new(move |x, normal_n| {
        let motion_m = x - last_m.replace(x).unwrap_or(x);
        let friction = bristle.step(
            &mut state,
            Vector::of([motion_m as f32, 0.0, 0.0]),
            Vector::of([0.0, 0.0, 1.0]),
            Quantity::of(normal_n as f32),
            Quantity::of((mu * normal_n) as f32),
        );
        f64::from(friction.force().values()[0])
    })
}
