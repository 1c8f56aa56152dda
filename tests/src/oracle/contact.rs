//! The contact law of a material that gives way, in f64.

use asperity_formats::{ContactLaw, Coupling};
use asperity_runtime::Config;

/// Law, what the device bears of it, and state.
#[derive(Debug, Clone)]
pub struct Contact {
    /// Elastic depth and shape, m.
    spring: Vec<(f64, f64)>,
    stiffness: f64,
    damping: f64,
    load_damping: f64,
    relaxing: f64,
    relaxation_s: f64,
    yield_m: f64,
    share: f64,
    heal: f64,
    recovery_s: f64,
    viscous: f64,
    plough: f64,
    pull: f64,
    sticking: f64,
    period_s: f64,
    // State.
    branch_n: f64,
    imprint_m: f64,
    pull_n: f64,
    crunch_mm_s: f64,
}

/// Forces of a tick, N.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Forces {
    /// Elastic part.
    pub load: f64,
    /// Along the normal.
    pub total: f64,
    /// Limit that drag adds.
    pub drag: f64,
}

impl Contact {
    /// What a device renders of a law: stiffness first, then relaxation, adhesion, and both dampings.
    #[must_use]
    pub fn new(law: &ContactLaw<'_>, coupling: &Coupling, config: &Config) -> Self {
        let mechanics = &config.mechanics;
        let period_s = 1.0 / f64::from(config.servo_rate_hz);
        let (fastest, step) = (
            f64::from(mechanics.fastest_m_s),
            f64::from(mechanics.position_step_m),
        );
        let coulomb = f64::from(mechanics.coulomb_n);
        let budget = f64::from(mechanics.damping_n_s_m) + coulomb / fastest;
        let held = period_s * (1.0 + 2.0 * f64::from(mechanics.delay_ticks)) / 2.0;
        let cost = held + step / (2.0 * fastest);
        let quantised = if step > 0.0 {
            2.0 * coulomb / step
        } else {
            f64::INFINITY
        };
        let stiffest = (budget / cost).min(quantised);
        let stiffness = f64::from(coupling.stiffness_n_m).min(stiffest);
        let relaxing = f64::from(law.relaxation.stiffness_n_m).min(stiffest - stiffness);
        let sticking = f64::from(law.adhesion.stiffness_n_m).min(stiffest - stiffness - relaxing);
        let used = (stiffness + relaxing + sticking) * cost;
        let left = (budget - used).max(0.0) / (1.0 + step / (period_s * fastest));
        let damping = f64::from(coupling.damping_n_s_m).min(left);
        let at_peak = (left - damping) / f64::from(config.limits.peak_n);
        Self {
            spring: [(0.0, 0.0)]
                .into_iter()
                .chain(law.points().map(|p| (p.depth_m(), p.shape_m())))
                .collect(),
            stiffness,
            damping,
            load_damping: f64::from(law.damping_s_m).min(at_peak),
            relaxing,
            relaxation_s: law.relaxation.time_s.into(),
            yield_m: law.imprint.yield_m.into(),
            share: law.imprint.share.into(),
            heal: law.imprint.heal.into(),
            recovery_s: law.imprint.recovery_s.into(),
            viscous: law.drag.viscous_n_s_m2.into(),
            plough: law.drag.plough_n_m.into(),
            pull: law.adhesion.pull_n.into(),
            sticking,
            period_s,
            branch_n: 0.0,
            imprint_m: 0.0,
            pull_n: 0.0,
            crunch_mm_s: 0.0,
        }
    }

    /// An untouched surface.
    pub fn restart(&mut self) {
        (self.branch_n, self.imprint_m, self.pull_n, self.crunch_mm_s) = (0.0, 0.0, 0.0, 0.0);
    }

    /// Speed with which the surface yields, mm/s.
    #[must_use]
    pub const fn crunch_mm_s(&self) -> f64 {
        self.crunch_mm_s
    }

    /// s(e), m.
    fn shape(&self, elastic_m: f64) -> f64 {
        let lines = self.spring.windows(2);
        let line = lines
            .clone()
            .find(|line| elastic_m < line[1].0)
            .or_else(|| lines.clone().next_back());
        line.map_or(elastic_m, |line| {
            let ((from, low), (to, high)) = (line[0], line[1]);
            low + (high - low) * (elastic_m - from) / (to - from)
        })
    }

    /// The depth goes from `before_m` to `depth_m` in `elapsed` periods.
    pub fn tick(
        &mut self,
        before_m: f64,
        depth_m: f64,
        outward_m_s: f64,
        speed_m_s: f64,
        elapsed: u32,
    ) -> Forces {
        let imprint = self.imprint_m.max(self.share * (before_m - self.yield_m));
        let before = (before_m - imprint).max(0.0);
        let yielded = self.share * (depth_m - self.yield_m);
        if yielded > self.imprint_m {
            self.imprint_m = yielded;
            self.crunch_mm_s = 1000.0 * (-outward_m_s).max(0.0);
        } else {
            self.crunch_mm_s *= 15.0 / 16.0;
        }
        let elastic = (depth_m - self.imprint_m).max(0.0);
        let deeper = elastic - before;
        if self.relaxing > 0.0 {
            let time = f64::from(elapsed) * self.period_s / self.relaxation_s;
            let kept = (-time).exp();
            self.branch_n = kept * self.branch_n + self.relaxing * deeper * (1.0 - kept) / time;
        }
        if depth_m <= 0.0 {
            if self.recovery_s > 0.0 {
                self.imprint_m *= (-f64::from(elapsed) * self.period_s / self.recovery_s).exp();
            }
            let travel = f64::from(elapsed) * speed_m_s * self.period_s;
            self.imprint_m -= 0.25 * travel;
            if self.imprint_m < 20e-6 {
                self.imprint_m = 0.0;
            }
            self.pull_n = 0.0;
            return Forces::default();
        }
        let spring = self.stiffness * self.shape(elastic);
        let load = if elastic > 0.0 {
            (spring + self.branch_n).max(0.0)
        } else {
            0.0
        };
        let damping = self.damping + self.load_damping * load;
        let pressed = if load > 0.0 {
            (load - damping * outward_m_s).max(0.0)
        } else {
            0.0
        };
        let most = self.pull.min(self.sticking * elastic);
        self.pull_n = (self.pull_n - self.sticking * deeper).max(0.0).min(most);
        Forces {
            load,
            total: pressed - self.pull_n,
            drag: (self.viscous * speed_m_s + self.plough) * depth_m,
        }
    }

    /// Slip along the surface, m, under a friction, N.
    pub fn heal(&mut self, slip_m: f64, friction_n: f64, load_n: f64) {
        let paid = if load_n > 0.0 {
            self.heal.min(friction_n / load_n)
        } else {
            self.heal
        };
        self.imprint_m = (self.imprint_m - paid * slip_m).max(0.0);
    }
}
