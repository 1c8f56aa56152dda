//! The whole tick.

use super::{
    Bank, Butterworth2, Contact, DirectionFactors, Excitation, Forces, Interpolator, Model,
    Texture, Vector, distance_and_normal, dot, norm, plus, polynomial, times,
};
use asperity_formats::{Asset, Direction};
use asperity_runtime::{Config, Sample, VibrationAxis, stage::vibration::LAG_SAMPLES};
use std::collections::VecDeque;

/// Output of a tick.
#[derive(Debug, Clone, Copy, Default)]
pub struct Tick {
    /// Force on the hand, N.
    pub force_n: Vector,
    /// Depth, m.
    pub depth_m: f64,
    /// Tangential speed, mm/s.
    pub speed_mm_s: f64,
    /// k·δ, N.
    pub normal_force_n: f64,
    /// y\[n\], m/s².
    pub vib_m_s2: f64,
    /// Tap force, N.
    pub tap_n: f64,
    /// Friction, N.
    pub friction_n: f64,
}

/// Texture, configuration and state.
#[derive(Debug)]
pub struct Oracle {
    config: Config,
    texture: Texture,
    bank: Bank,
    mu: f64,
    /// Speeds, mm/s, and factors of μ.
    law: Vec<(f64, f64)>,
    coupling: asperity_formats::Coupling,
    contact: Option<Contact>,
    axis: Option<Direction>,
    // The factors of the last query, and the factor of μ that follows.
    factors: DirectionFactors,
    mu_factor: f64,
    // Gate.
    bad_in_a_row: u32,
    seen: bool,
    gain: f64,
    position: Vector,
    // Motion.
    velocity: [Butterworth2; 3],
    outward: Butterworth2,
    last_position: Vector,
    last_distance: f64,
    direction: Vector,
    // Vibration: samples in a cycle, ticks in a sample, ticks since the last sample, and the
    // sample within the cycle.
    cycle: usize,
    ticks: usize,
    tick: usize,
    sample: usize,
    interpolator: Interpolator,
    follows: bool,
    smoothed: Option<Model>,
    pending: Option<Model>,
    sounds: Option<Model>,
    excitation: Excitation,
    past_e: VecDeque<f64>,
    past_y: VecDeque<f64>,
    // Tap.
    distances: VecDeque<f64>,
    place_ticks: u32,
    armed: bool,
    transient: VecDeque<f64>,
    // Friction and limits.
    bristle: Vector,
    force: Vector,
}

impl Oracle {
    /// At rest. A query is taken every `cycle_samples` samples.
    #[must_use]
    pub fn new(asset: &Asset<'_>, cycle_samples: u8, config: &Config, seed: u64) -> Self {
        let rate = f64::from(config.servo_rate_hz);
        let velocity = Butterworth2::new(config.velocity_cutoff_hz.into(), rate);
        let ticks = (rate / f64::from(asset.grid().sample_rate_hz())).round() as usize;
        Self {
            texture: Texture::new(asset),
            bank: Bank::new(asset.taps(), rate),
            mu: asset.friction().mu().into(),
            law: asset.friction().law().map_or(Vec::new(), |law| {
                let points = law.points();
                points
                    .map(|p| (p.speed_mm_s().into(), p.factor().into()))
                    .collect()
            }),
            coupling: *asset.coupling(),
            contact: (asset.contact()).map(|law| Contact::new(law, asset.coupling(), config)),
            axis: asset.direction().copied(),
            factors: DirectionFactors::ACROSS,
            mu_factor: 1.0,
            bad_in_a_row: 0,
            seen: false,
            gain: 1.0,
            position: [0.0; 3],
            velocity: [velocity.clone(), velocity.clone(), velocity],
            outward: Butterworth2::new(config.normal_cutoff_hz.into(), rate),
            last_position: [0.0; 3],
            last_distance: 0.0,
            direction: [1.0, 0.0, 0.0],
            cycle: cycle_samples.into(),
            ticks,
            tick: 0,
            sample: 0,
            interpolator: Interpolator::new(ticks),
            follows: false,
            smoothed: None,
            pending: None,
            sounds: None,
            excitation: Excitation::new(seed),
            past_e: VecDeque::from(vec![0.0; 24]),
            past_y: VecDeque::from(vec![0.0; 24]),
            distances: VecDeque::from(vec![0.0; 8]),
            place_ticks: 0,
            armed: false,
            transient: VecDeque::new(),
            bristle: [0.0; 3],
            force: [0.0; 3],
            config: config.clone(),
        }
    }

    /// The texture.
    #[must_use]
    pub const fn texture(&self) -> &Texture {
        &self.texture
    }

    /// Renders a servo period.
    pub fn tick(&mut self, sample: &Sample) -> Tick {
        let rate = f64::from(self.config.servo_rate_hz);
        let (safe, elapsed, restart) = self.gate(sample);
        let (distance, normal) = distance_and_normal(&self.config.solid, self.position);
        if restart {
            self.restart(distance);
        }
        let tangential = |v: Vector| plus(v, normal, -dot(v, normal));

        let motion = plus(self.position, self.last_position, -1.0);
        let backward = times(motion, rate / f64::from(elapsed));
        let velocity: Vector = std::array::from_fn(|i| self.velocity[i].step(backward[i]));
        let before = (-self.last_distance).max(0.0);
        let outward = self
            .outward
            .step((distance - self.last_distance) * rate / f64::from(elapsed));
        (self.last_position, self.last_distance) = (self.position, distance);
        let slide = tangential(velocity);
        let speed = norm(slide);
        if speed > 1e-4 {
            self.direction = times(slide, 1.0 / speed);
        }

        let touching = distance < 0.0;
        let depth = (-distance).max(0.0);
        let (stiffness, damping) = self.wall();
        let contact = self.contact.as_mut();
        let forces = contact.map(|law| law.tick(before, depth, outward, speed, elapsed));
        let crunch = self.contact.as_ref().map_or(0.0, Contact::crunch_mm_s);
        let normal_force = forces.map_or(stiffness * depth, |forces| forces.load);
        self.follow_direction(normal);
        let grid_speed = speed * 1000.0 * self.factors.speed + crunch;
        let vib = self.vibration(grid_speed, normal_force, touching && !safe);
        let tap = f64::from(self.coupling.effective_mass_kg) * self.tap(distance);
        let mu = self.mu * self.factor(speed * 1000.0) * self.mu_factor;
        let drag = forces.map_or(0.0, |forces| forces.drag);
        let limit = mu * normal_force + drag;
        let grip = normal_force + drag;
        let (friction, slip) = self.friction(tangential, motion, limit, grip, touching);
        if let Some(contact) = &mut self.contact {
            contact.heal(slip, norm(friction), normal_force);
        }

        let damped = normal_force - damping * outward;
        let wall = match forces {
            Some(Forces { total, .. }) => total,
            None if touching => damped.max(0.0),
            None => 0.0,
        };
        let axis = match self.config.vibration_axis {
            VibrationAxis::Tangent => self.direction,
            VibrationAxis::Binormal => {
                let (t, n) = (self.direction, normal);
                [
                    t[1] * n[2] - t[2] * n[1],
                    t[2] * n[0] - t[0] * n[2],
                    t[0] * n[1] - t[1] * n[0],
                ]
            }
        };
        let vib_n = f64::from(self.coupling.vib_s2_m) * f64::from(self.coupling.f_max_n) * vib;
        let total = plus(plus(times(normal, wall + tap), friction, 1.0), axis, vib_n);
        self.limit(times(total, self.gain));
        Tick {
            force_n: self.force,
            depth_m: depth,
            speed_mm_s: speed * 1000.0,
            normal_force_n: normal_force,
            vib_m_s2: vib,
            tap_n: tap,
            friction_n: norm(friction),
        }
    }

    /// Lets a sample through, holds the last one, or enters the safe state. Returns whether the
    /// state is safe, the periods since the last position, and whether motion restarts.
    fn gate(&mut self, sample: &Sample) -> (bool, u32, bool) {
        let position = sample.position_m.map(f64::from);
        let good = sample.elapsed_ticks > 0
            && position
                .iter()
                .all(|x| x.abs() <= f64::from(self.config.safety.reach_m));
        let hold = self.config.safety.hold_ticks;
        let ramp =
            (f64::from(self.config.safety.ramp_s) * f64::from(self.config.servo_rate_hz)).max(1.0);
        if good {
            self.bad_in_a_row = 0;
            self.position = position;
            let first = !self.seen;
            self.seen = true;
            let gap = !first && sample.elapsed_ticks - 1 > hold;
            self.gain = if gap {
                0.0
            } else {
                (self.gain + 1.0 / ramp).min(1.0)
            };
            let restart = first || gap;
            return (gap, if restart { 1 } else { sample.elapsed_ticks }, restart);
        }
        self.bad_in_a_row += 1;
        let held = self.seen && self.bad_in_a_row <= hold;
        if !held {
            (self.seen, self.gain) = (false, 0.0);
        }
        (!held, 1, false)
    }

    fn restart(&mut self, distance: f64) {
        self.velocity.iter_mut().for_each(Butterworth2::reset);
        self.outward.reset();
        (self.last_position, self.last_distance) = (self.position, distance);
        (self.follows, self.pending, self.sounds) = (false, None, None);
        self.interpolator.reset();
        self.past_e = VecDeque::from(vec![0.0; 24]);
        self.past_y = VecDeque::from(vec![0.0; 24]);
        self.distances = VecDeque::from(vec![distance; 8]);
        self.place_ticks = 0;
        self.armed = false;
        self.transient.clear();
        self.bristle = [0.0; 3];
        if let Some(contact) = &mut self.contact {
            contact.restart();
        }
    }

    /// Takes the direction with the query; the factor of μ goes to that of the query in every tick.
    fn follow_direction(&mut self, normal: Vector) {
        let Some(axis) = &self.axis else { return };
        if self.takes_query() {
            self.factors = DirectionFactors::of(axis, self.direction, normal);
        }
        let ticks =
            f64::from(self.config.parameter_time_constant_s) * f64::from(self.config.servo_rate_hz);
        let share = if ticks > 0.0 {
            1.0 - (-1.0 / ticks).exp()
        } else {
            1.0
        };
        self.mu_factor += share * (self.factors.mu - self.mu_factor);
    }

    /// Whether this tick takes a query.
    const fn takes_query(&self) -> bool {
        self.sample == 0 && self.tick == self.ticks - 1
    }

    /// Every cycle takes one query, in the last tick before its second sample. The new model
    /// sounds late enough that a change of the query is heard after at most ten samples, if the
    /// contact lasts. Parameters follow the query in one step per cycle; those of a new contact
    /// follow at once.
    fn model_at_work(&mut self, speed_mm_s: f64, force_n: f64, sounding: bool) {
        if !sounding {
            (self.follows, self.pending, self.sounds) = (false, None, None);
        }
        if self.takes_query() {
            let mut target = self.texture.model(speed_mm_s, force_n);
            target.level_m_s2 *= self.factors.level;
            let steps = f64::from(self.config.parameter_time_constant_s)
                * f64::from(self.config.servo_rate_hz)
                / (self.cycle * self.ticks) as f64;
            let share = if self.follows && steps > 0.0 {
                1.0 - (-1.0 / steps).exp()
            } else {
                1.0
            };
            let model = match &self.smoothed {
                None => target,
                Some(last) => {
                    let follow = |last: &[f64], target: &[f64]| {
                        let step = |(l, t): (&f64, &f64)| l + share * (t - l);
                        last.iter().zip(target).map(step).collect()
                    };
                    Model {
                        cosines: follow(&last.cosines, &target.cosines),
                        ma_cosines: follow(&last.ma_cosines, &target.ma_cosines),
                        level_m_s2: target.level_m_s2,
                    }
                }
            };
            self.smoothed = Some(model.clone());
            self.pending = sounding.then_some(model);
        }
        if self.sample == LAG_SAMPLES + 1 - self.cycle && self.tick == 0 {
            self.sounds = self.pending.take();
            self.follows = self.sounds.is_some();
        }
    }

    /// A sample of the model in one of `ticks` ticks, through the low-pass.
    fn vibration(&mut self, speed_mm_s: f64, force_n: f64, sounding: bool) -> f64 {
        self.model_at_work(speed_mm_s, force_n, sounding);
        let y = if self.tick == 0 { self.sample() } else { 0.0 };
        self.tick += 1;
        if self.tick == self.ticks {
            (self.tick, self.sample) = (0, (self.sample + 1) % self.cycle);
        }
        if self.ticks == 1 {
            return y;
        }
        if !sounding {
            self.interpolator.reset();
            return 0.0;
        }
        self.interpolator.step(y)
    }

    /// y[n] = e[n] + Σ b_k e[n−k] − Σ a_k y[n−k].
    fn sample(&mut self) -> f64 {
        let epsilon = self.excitation.draw();
        let (mut e, mut y) = (0.0, 0.0);
        if let Some(model) = &self.sounds {
            let past = |c: &[f64], line: &VecDeque<f64>| -> f64 {
                c.iter().zip(line).map(|(c, x)| c * x).sum()
            };
            e = model.level_m_s2 * epsilon;
            y = e + past(&self.texture.numerator(model), &self.past_e)
                - past(&polynomial(&model.cosines), &self.past_y);
        }
        for (line, newest) in [(&mut self.past_e, e), (&mut self.past_y, y)] {
            line.pop_back();
            line.push_front(newest);
        }
        y
    }

    /// Acceleration of the transient under way, m/s².
    fn tap(&mut self, distance: f64) -> f64 {
        // A height is kept every 2ⁿ ticks, the largest power of two within 1 ms. The newest is
        // updated in every tick.
        let rate = f64::from(self.config.servo_rate_hz);
        let mut place = 1;
        while place < 16 && 2.0 * f64::from(place) <= rate / 1000.0 {
            place *= 2;
        }
        if self.place_ticks.is_multiple_of(place) {
            self.distances.pop_front();
        } else {
            self.distances.pop_back();
        }
        self.place_ticks = self.place_ticks % place + 1;
        self.distances.push_back(distance);
        let passed = f64::from(self.place_ticks) / f64::from(place);
        // The slope of a least-squares line through eight heights. The newest interval may be
        // shorter than the others.
        let mean = 3.5;
        let slope: f64 = self
            .distances
            .iter()
            .enumerate()
            .map(|(i, d)| (i as f64 - mean) * d)
            .sum::<f64>()
            / 42.0;
        let speed = -slope * rate / f64::from(place) * 12.0 / (11.0 + passed);
        let touching = distance < 0.0;
        if self.armed && touching && speed >= f64::from(self.config.tap.min_speed_m_s) {
            self.transient = self.bank.transient(speed).into();
        }
        self.armed = !touching && (self.armed || distance > f64::from(self.config.tap.rearm_m));
        self.transient.pop_front().unwrap_or(0.0)
    }

    /// The factor of μ at a speed: straight lines between the points of the law, constant outside.
    fn factor(&self, speed_mm_s: f64) -> f64 {
        let Some((first, last)) = self.law.first().zip(self.law.last()) else {
            return 1.0;
        };
        for pair in self.law.windows(2) {
            let ((slow, above), (fast, below)) = (pair[0], pair[1]);
            if (slow..fast).contains(&speed_mm_s) {
                return above + (below - above) * (speed_mm_s - slow) / (fast - slow);
            }
        }
        if speed_mm_s < first.0 {
            first.1
        } else {
            last.1
        }
    }

    /// The bristle with deflection d. Each tick keeps the fraction 1/(1 + T/τ) of it, with
    /// τ = F_n/(k·v_c), and |d| is at most μF/k + h. Beyond the dead zone h the force is
    /// k(|d| − h + lead), at most the limit, against the deflection; the root slips by what is not kept.
    /// Drag adds to F and to the limit. The lead is the motion along d
    /// during a tick and the delay, at most half of |d| − h.
    fn friction(
        &mut self,
        tangential: impl Fn(Vector) -> Vector,
        motion: Vector,
        limit: f64,
        grip: f64,
        touching: bool,
    ) -> (Vector, f64) {
        let (k, h) = (
            f64::from(self.config.friction.stiffness_n_m),
            f64::from(self.config.friction.dead_zone_m),
        );
        if !touching {
            self.bristle = [0.0; 3];
            return (self.bristle, 0.0);
        }
        let time_constant = grip / (k * f64::from(self.config.friction.leak_speed_m_s));
        let leak = 1.0 / (time_constant * f64::from(self.config.servo_rate_hz));
        let motion = tangential(motion);
        let pulled = tangential(plus(self.bristle, motion, 1.0));
        let moved = times(pulled, 1.0 / (1.0 + leak));
        let (length, reach) = (norm(moved), limit / k + h);
        self.bristle = if length > reach {
            times(moved, reach / length)
        } else {
            moved
        };
        let length = norm(self.bristle);
        let slip = norm(pulled) - length;
        if length <= h {
            return ([0.0; 3], slip);
        }
        let along = times(self.bristle, 1.0 / length);
        let ticks = 1.0 + f64::from(self.config.mechanics.delay_ticks);
        let lead = (ticks * dot(along, motion)).min((length - h) / 2.0);
        let force = (k * (length - h + lead)).clamp(0.0, limit);
        (times(along, -force), slip)
    }

    /// Stiffness and damping of the passive wall nearest to that of the asset.
    fn wall(&self) -> (f64, f64) {
        let mechanics = &self.config.mechanics;
        let period = 1.0 / f64::from(self.config.servo_rate_hz);
        let (fastest, step) = (
            f64::from(mechanics.fastest_m_s),
            f64::from(mechanics.position_step_m),
        );
        let coulomb = f64::from(mechanics.coulomb_n);
        let budget = f64::from(mechanics.damping_n_s_m) + coulomb / fastest;
        let held = period * (1.0 + 2.0 * f64::from(mechanics.delay_ticks)) / 2.0;
        let cost = held + step / (2.0 * fastest);
        let stiffness = f64::from(self.coupling.stiffness_n_m)
            .min(budget / cost)
            .min(if step > 0.0 {
                2.0 * coulomb / step
            } else {
                f64::INFINITY
            });
        let left = (budget - stiffness * cost).max(0.0) / (1.0 + step / (period * fastest));
        (stiffness, f64::from(self.coupling.damping_n_s_m).min(left))
    }

    fn limit(&mut self, wanted: Vector) {
        let peak = f64::from(self.config.limits.peak_n);
        let step = f64::from(self.config.limits.slew_n_s) / f64::from(self.config.servo_rate_hz);
        let size = norm(wanted);
        let target = if size > peak {
            times(wanted, peak / size)
        } else {
            wanted
        };
        let change = plus(target, self.force, -1.0);
        let size = norm(change);
        let share = if size > step { step / size } else { 1.0 };
        self.force = plus(self.force, change, share);
    }
}
