//! How deep a hand is that presses with a force: a wall of stiffness k answers a depth of F/k at once; a material that
//! gives way is followed down.
//!
//! The hand's depth below zero is its force over the stiffness, d = F/k. Where the material gives way, the hand is
//! e deeper, and
//!
//! ```text
//! b·de/dt = k·d − load,   b = 10 N·s/m,
//! ```
//!
//! so that it comes to rest where the load is F. In the open e returns to zero with a time constant of 30 ms.

use crate::hand::{FASTEST_PRESS_MM_S, RATE_HZ};

/// Damping b of the hand, N·s/m: 1 N too little moves it by 0.1 m/s.
const DAMPING_N_S_M: f64 = 10.0;
/// Time constant of the return, s.
const RETURN_S: f64 = 0.03;
/// Deepest that a hand follows, mm: the deepest point of a spring.
const DEEPEST_MM: f64 = 60.0;
/// A depth that is none, mm; else a decay would end in denormals.
const NONE_MM: f64 = 1e-6;
const TICK_S: f64 = 1.0 / RATE_HZ as f64;

/// What gives way under the hand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Under {
    /// Stiffness of the wall, N/m.
    pub stiffness_n_m: f32,
    /// Load of the last tick, N.
    pub load_n: f32,
}

/// A hand that follows what gives way.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Press {
    /// How much deeper it is than its force over the stiffness, mm.
    deeper_mm: f64,
}

impl Press {
    /// Above everything.
    #[must_use]
    pub const fn new() -> Self {
        Self { deeper_mm: 0.0 }
    }

    /// The position in the next tick, mm, of a hand whose depth is its force over the stiffness, over what gives way
    /// or, with `None`, a wall.
    pub fn step(&mut self, position_mm: [f32; 3], under: Option<Under>) -> [f32; 3] {
        let [x, y, z] = position_mm;
        if let Some(under) = under.filter(|_| z < 0.0) {
            let pressed_n = f64::from(under.stiffness_n_m) * f64::from(-z) / 1000.0;
            let fastest_mm = FASTEST_PRESS_MM_S * TICK_S;
            let step_mm = 1000.0 * (pressed_n - f64::from(under.load_n)) / DAMPING_N_S_M * TICK_S;
            let deeper_mm = self.deeper_mm + step_mm.clamp(-fastest_mm, fastest_mm);
            // It never leaves the surface against its force.
            self.deeper_mm = deeper_mm.clamp(f64::from(z), DEEPEST_MM);
        } else {
            self.deeper_mm -= self.deeper_mm * (TICK_S / RETURN_S);
            if self.deeper_mm.abs() < NONE_MM {
                self.deeper_mm = 0.0;
            }
        }
        if self.deeper_mm == 0.0 {
            return position_mm;
        }
        [x, y, (f64::from(z) - self.deeper_mm) as f32]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_runtime::{HostTexture, Renderer, Sample, State};

    const FOAM: &[u8] = include_bytes!("../../../formats/tests/data/contact-v3.asp");

    /// Claim: a hand on what gives way comes to rest where the load is its force; over steel its depth stays its force over
    /// the stiffness, to the bit; above either it is where it was.
    #[test]
    fn the_load_becomes_the_force_and_the_hand_comes_back() {
        let renderer = Renderer::new(&crate::session::config()).unwrap();
        let mut slot = Box::new(HostTexture::EMPTY);
        slot.load_haptic(FOAM, RATE_HZ).unwrap();
        assert!(slot.gives_way());
        let stiffness_n_m = renderer.wall(&slot.coupling()).stiffness.0;
        let (mut press, mut state, mut load_n) = (Press::new(), State::new(1), 0.0);
        for (force_n, seconds) in [(0.5_f32, 2.0), (1.2, 4.0), (-1.0, 1.0)] {
            let asked_mm = [0.0, 0.0, -1000.0 * force_n / stiffness_n_m];
            let mut position_mm = asked_mm;
            for _ in 0..(seconds * RATE_HZ) as usize {
                let under = Some(Under {
                    stiffness_n_m,
                    load_n,
                });
                let before_mm = position_mm;
                position_mm = press.step(asked_mm, under);
                let step_mm = f64::from((position_mm[2] - before_mm[2]).abs());
                assert!(step_mm <= 2.0 * FASTEST_PRESS_MM_S * TICK_S || before_mm == asked_mm);
                let sample = Sample::at(position_mm.map(|mm| mm / 1000.0));
                load_n = renderer.tick(&slot, &mut state, &sample).normal_force_n;
            }
            if force_n > 0.0 {
                assert!(
                    (load_n / force_n - 1.0).abs() < 0.02,
                    "{load_n} not {force_n}"
                );
            } else {
                assert_eq!((position_mm, &press), (asked_mm, &Press::new()));
            }
        }
        assert_eq!(press.step([1.0, 2.0, -3.0], None), [1.0, 2.0, -3.0]);
    }
}
