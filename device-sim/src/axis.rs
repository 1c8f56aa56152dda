//! Single-axis stylus dynamics: mass, viscous and Coulomb friction, and the hand's spring and
//! damper, integrated implicitly.
//!
//! ```text
//! m·v̇ = F + k·(x_t − x) + b_t·(v_t − v) − b·v − f_c·sgn(v),   ẋ = v
//! ```
//!
//! `sgn` is the set-valued sign. One step of backward Euler then has a closed form. With
//! `p = m·v + h·(F + k·(x_t − x) + b_t·v_t)` and `M = m + h·(b + b_t) + h²·k`,
//!
//! ```text
//! v' = sgn(p)·max(|p| − h·f_c, 0) / M,   x' = x + h·v'
//! ```
//!
//! At rest below breakaway `v'` is exactly zero: friction holds without chatter or drift.
//! Backward Euler only removes energy, whatever `h` and `k` are. It adds a damping ratio of
//! `ω·h/2` to a mode of frequency ω, which is 0.3 % at 100 rad/s with the sub-step used here.

/// Passive parameters of one axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisParams {
    /// Moving mass, kg, > 0.
    pub mass_kg: f64,
    /// Viscous damping to ground, N·s/m.
    pub damping_n_s_m: f64,
    /// Coulomb friction to ground, N.
    pub coulomb_n: f64,
}

/// Force of a hand on an axis: a spring and a damper to a moving target, plus a feed-forward force.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Pull {
    /// Spring stiffness, N/m.
    pub stiffness_n_m: f64,
    /// Damping relative to the target's velocity, N·s/m.
    pub damping_n_s_m: f64,
    /// Position of the target, m.
    pub target_m: f64,
    /// Velocity of the target, m/s.
    pub target_m_s: f64,
    /// Force that the hand adds, N.
    pub force_n: f64,
}

/// Position and velocity of one axis.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct AxisState {
    /// Position, m.
    pub position_m: f64,
    /// Velocity, m/s.
    pub velocity_m_s: f64,
}

impl AxisState {
    /// Advances by `step_s` under the device's force and the hand's pull.
    #[must_use]
    pub fn step(self, params: &AxisParams, force_n: f64, hand: &Pull, step_s: f64) -> Self {
        let pull_n = force_n
            + hand.force_n
            + hand.stiffness_n_m * (hand.target_m - self.position_m)
            + hand.damping_n_s_m * hand.target_m_s;
        let momentum = params.mass_kg * self.velocity_m_s + step_s * pull_n;
        let inertia = params.mass_kg
            + step_s * (params.damping_n_s_m + hand.damping_n_s_m)
            + step_s * step_s * hand.stiffness_n_m;
        let free = (momentum.abs() - step_s * params.coulomb_n).max(0.0);
        let velocity_m_s = momentum.signum() * free / inertia;
        Self {
            position_m: self.position_m + step_s * velocity_m_s,
            velocity_m_s,
        }
    }

    /// Stops the axis at `±limit_m`, an inelastic end stop. Returns whether it was hit.
    pub fn stop_at(&mut self, limit_m: f64) -> bool {
        if self.position_m.abs() <= limit_m {
            return false;
        }
        self.position_m = self.position_m.clamp(-limit_m, limit_m);
        self.velocity_m_s = 0.0;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEP_S: f64 = 1.0 / 16_000.0;
    const FREE: AxisParams = AxisParams {
        mass_kg: 0.045,
        damping_n_s_m: 0.0,
        coulomb_n: 0.0,
    };

    #[test]
    fn a_free_mass_under_constant_force_falls_on_the_parabola() {
        let force_n = 0.9;
        let accel_m_s2 = force_n / FREE.mass_kg;
        let mut state = AxisState::default();
        for n in 1..=16_000 {
            state = state.step(&FREE, force_n, &Pull::default(), STEP_S);
            let t_s = f64::from(n) * STEP_S;
            assert!((state.velocity_m_s - accel_m_s2 * t_s).abs() < 1e-9);
            // Backward Euler is ahead of the parabola by exactly a·h·t/2.
            let exact_m = 0.5 * accel_m_s2 * t_s * t_s;
            let lead_m = 0.5 * accel_m_s2 * STEP_S * t_s;
            assert!((state.position_m - exact_m - lead_m).abs() < 1e-9);
        }
    }

    #[test]
    fn a_damped_mass_approaches_terminal_velocity_exponentially() {
        let params = AxisParams {
            damping_n_s_m: 0.5,
            ..FREE
        };
        let mut state = AxisState::default();
        for n in 1..=8_000 {
            state = state.step(&params, 1.0, &Pull::default(), STEP_S);
            let t_s = f64::from(n) * STEP_S;
            let exact = 2.0 * (1.0 - (-t_s * 0.5 / FREE.mass_kg).exp());
            assert!((state.velocity_m_s - exact).abs() < 1e-3, "{n}");
        }
    }

    #[test]
    fn friction_holds_below_breakaway_and_yields_above() {
        let params = AxisParams {
            coulomb_n: 0.26,
            ..FREE
        };
        let mut state = AxisState {
            position_m: 0.01,
            velocity_m_s: 0.0,
        };
        for n in 0..100_000 {
            let force_n = if n % 2 == 0 { 0.2599 } else { -0.2599 };
            state = state.step(&params, force_n, &Pull::default(), STEP_S);
            assert_eq!(
                state,
                AxisState {
                    position_m: 0.01,
                    velocity_m_s: 0.0
                }
            );
        }
        let moved = state.step(&params, 0.2601, &Pull::default(), STEP_S);
        assert!(moved.velocity_m_s > 0.0);
    }

    #[test]
    fn friction_stops_a_mass_after_the_time_momentum_over_friction() {
        let params = AxisParams {
            coulomb_n: 0.26,
            ..FREE
        };
        let mut state = AxisState {
            position_m: 0.0,
            velocity_m_s: 0.3,
        };
        let mut steps = 0;
        while state.velocity_m_s > 0.0 {
            state = state.step(&params, 0.0, &Pull::default(), STEP_S);
            steps += 1;
        }
        let exact_s = FREE.mass_kg * 0.3 / 0.26;
        assert!((f64::from(steps) * STEP_S - exact_s).abs() <= STEP_S);
        assert_eq!(state.velocity_m_s, 0.0);
    }

    #[test]
    fn energy_never_grows_on_a_stiff_spring_with_friction() {
        for stiffness_n_m in [10.0, 500.0, 2_000.0, 1e6] {
            let params = AxisParams {
                coulomb_n: 0.26,
                damping_n_s_m: 0.1,
                ..FREE
            };
            let wall = Pull {
                stiffness_n_m,
                ..Pull::default()
            };
            let energy = |s: &AxisState| {
                0.5 * params.mass_kg * s.velocity_m_s.powi(2)
                    + 0.5 * stiffness_n_m * s.position_m.powi(2)
            };
            let mut state = AxisState {
                position_m: 0.02,
                velocity_m_s: -0.5,
            };
            let mut last = energy(&state);
            for _ in 0..50_000 {
                state = state.step(&params, 0.0, &wall, STEP_S);
                let now = energy(&state);
                assert!(
                    now <= last * (1.0 + 1e-12),
                    "k = {stiffness_n_m}: {last} -> {now}"
                );
                last = now;
            }
            // It rests where the spring is weaker than the friction.
            assert!(state.position_m.abs() * stiffness_n_m <= 0.26 + 1e-9);
            assert_eq!(state.velocity_m_s, 0.0);
        }
    }

    #[test]
    fn a_stop_takes_all_velocity_and_reports_itself() {
        let mut inside = AxisState {
            position_m: 0.079,
            velocity_m_s: 1.0,
        };
        assert!(!inside.stop_at(0.08));
        let mut beyond = AxisState {
            position_m: -0.081,
            velocity_m_s: -1.0,
        };
        assert!(beyond.stop_at(0.08));
        assert_eq!(
            beyond,
            AxisState {
                position_m: -0.08,
                velocity_m_s: 0.0
            }
        );
    }
}
