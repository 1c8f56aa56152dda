//! The passivity observer: the exact energy that a rendered force gives off.
//!
//! A force that is held from one tick to the next does the work F·Δx, whatever the path between.
//! The energy that leaves the renderer is therefore known without a model. On any path the
//! device absorbs at least b·Δx²/T + f_c·|Δx| (Jensen's inequality). A contact is passive if the
//! energy given off never exceeds the energy absorbed.

/// Physical damping and friction of a device, which absorb energy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Absorber {
    /// Viscous damping, N·s/m.
    pub damping_n_s_m: f64,
    /// Coulomb friction, N.
    pub coulomb_n: f64,
}

/// Energies since the beginning, J.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Observer {
    /// Work of the rendered force on the device.
    pub given_j: f64,
    /// Energy that the device absorbed.
    pub absorbed_j: f64,
    /// Largest `given − absorbed` so far. Above 0 the contact was active.
    pub worst_j: f64,
}

impl Observer {
    /// Adds a tick of `tick_s` s in which `force_n` N was held over a motion of `motion_m` m.
    pub fn tick(&mut self, absorber: &Absorber, force_n: f64, motion_m: f64, tick_s: f64) {
        self.given_j += force_n * motion_m;
        self.absorbed_j += absorber.damping_n_s_m * motion_m * motion_m / tick_s
            + absorber.coulomb_n * motion_m.abs();
        self.worst_j = self.worst_j.max(self.given_j - self.absorbed_j);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sampled spring pressed and released in steps of Δ gives off KΔ per unit of depth:
    /// ½KΔ² a tick. A damper of KT/2 absorbs just that.
    #[test]
    fn a_held_spring_gives_off_half_k_delta_squared_a_tick() {
        let (stiffness, step, ticks) = (500.0, 1e-4, 20);
        for (damping, net) in [(0.0, 1.0), (0.25, 0.0), (0.1, 0.6)] {
            let absorber = Absorber {
                damping_n_s_m: damping,
                coulomb_n: 0.0,
            };
            let mut observer = Observer::default();
            let mut depth = 0.0;
            for n in 0..2 * ticks {
                let outward = if n < ticks { -step } else { step };
                observer.tick(&absorber, stiffness * depth, outward, 1e-3);
                depth -= outward;
            }
            let given = 0.5 * stiffness * step * step * f64::from(2 * ticks);
            assert!((observer.given_j - given).abs() < 1e-12);
            let found = observer.given_j - observer.absorbed_j;
            assert!((found - net * given).abs() < 1e-12, "{found}");
        }
    }
}
