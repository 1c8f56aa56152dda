//! Online detection of the tool's motion (rest in the air, taps, steady strokes), and of the next step.

use super::coverage::Coverage;
use std::collections::VecDeque;

/// Stretches over which position and load are averaged, s.
const PIECE_S: f64 = 0.025;
/// Pieces of a stretch that counts if it is steady.
const STRETCH: usize = 4;
/// Largest deviation of speed and load within a steady stretch: a fraction of their mean, or mm/s and N if larger.
const STEADY: (f64, f64, f64) = (0.3, 10.0, 0.12);
/// Time in the air that tells a force sensor's bias, s, and how far its load may vary meanwhile, N.
const REST_S: f64 = 2.0;
const REST_N: f64 = 0.1;
/// Load that is contact, N: of a force sensor, and of a loop, which knows.
const CONTACT_N: (f64, f64) = (0.08, 0.01);
/// Time in the air before a landing that counts as a tap, s.
const AIR_S: f64 = 0.04;
/// Time before a landing over which its speed is looked for, and over which it is taken, s.
const LANDING_S: (f64, f64) = (0.04, 0.008);
/// Bands of impact speed, m/s: their edges.
pub const TAPS_M_S: [f64; 5] = [0.03, 0.075, 0.15, 0.25, 0.5];

/// Requirements of a recording.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// The grid of strokes.
    pub coverage: Coverage,
    /// Taps in every band of impact speed.
    pub taps: u32,
    /// Seconds in the air.
    pub air_s: f64,
    /// True if the load is a force sensor's, with a bias to estimate; false if it is the loop's.
    pub is_sensor: bool,
}

/// Current motion of the tool.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Now {
    /// Speed in the plane, mm/s.
    pub speed_mm_s: f64,
    /// Load without its bias, N.
    pub load_n: f64,
    /// True in contact; `None` until the bias is known.
    pub touches: Option<bool>,
}

/// The next step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NextStep {
    /// Hold the tool in the air.
    Air,
    /// Tap in a band of impact speed.
    Tap(usize),
    /// Stroke in a cell: bands of speed and force.
    Stroke((usize, usize)),
    /// Everything was visited.
    Nothing,
}

#[derive(Debug, Clone, Copy, Default)]
struct Sum {
    began_s: f64,
    count: u32,
    place_m: [f64; 2],
    load_n: f64,
}

/// Follows the tool.
#[derive(Debug)]
pub struct Exploration {
    plan: Plan,
    sum: Sum,
    /// Place of the last piece and when it was, m and s.
    last: Option<([f64; 2], f64)>,
    /// Speed, load and length of the last pieces, mm/s, N and s.
    pieces: Vec<(f64, f64, f64)>,
    /// Loads of the last pieces while the bias is not known, N.
    rest: VecDeque<f64>,
    bias_n: Option<f64>,
    air_s: f64,
    taps: [u32; TAPS_M_S.len() - 1],
    /// Time and height of the last samples, s and m.
    heights: VecDeque<(f64, f64)>,
    touched_s: Option<f64>,
    now: Now,
    cell: (usize, usize),
}

impl Exploration {
    /// Nothing was visited yet.
    #[must_use]
    pub fn new(plan: Plan) -> Self {
        let bias_n = if plan.is_sensor { None } else { Some(0.0) };
        Self {
            plan,
            sum: Sum::default(),
            last: None,
            pieces: Vec::new(),
            rest: VecDeque::new(),
            bias_n,
            air_s: 0.0,
            taps: [0; TAPS_M_S.len() - 1],
            heights: VecDeque::new(),
            touched_s: None,
            now: Now::default(),
            cell: (0, 0),
        }
    }

    /// Takes where the tool is, m, and the load on it, N. Times ascend.
    pub fn take(&mut self, t_s: f64, place_m: [f64; 3], load_n: f64) {
        if !(load_n.is_finite() && place_m.iter().all(|x| x.is_finite())) {
            return;
        }
        self.look_for_tap(t_s, place_m[2], load_n);
        if self.sum.count == 0 {
            self.sum.began_s = t_s;
        }
        self.sum.count += 1;
        self.sum.load_n += load_n;
        self.sum.place_m[0] += place_m[0];
        self.sum.place_m[1] += place_m[1];
        let length_s = t_s - self.sum.began_s;
        if length_s >= PIECE_S {
            self.piece(length_s);
        }
    }

    fn contact_n(&self) -> f64 {
        if self.plan.is_sensor {
            CONTACT_N.0
        } else {
            CONTACT_N.1
        }
    }

    fn look_for_tap(&mut self, t_s: f64, height_m: f64, load_n: f64) {
        let Some(bias_n) = self.bias_n else { return };
        if load_n - bias_n > self.contact_n() {
            let is_landing = self
                .touched_s
                .is_none_or(|touched_s| t_s - touched_s > AIR_S);
            if is_landing {
                let speed_m_s = self.landing_m_s();
                let band = TAPS_M_S
                    .windows(2)
                    .position(|b| speed_m_s >= b[0] && speed_m_s < b[1]);
                if let Some(band) = band {
                    self.taps[band] += 1;
                }
            }
            self.touched_s = Some(t_s);
        }
        self.heights.push_back((t_s, height_m));
        while self
            .heights
            .front()
            .is_some_and(|(first_s, _)| t_s - first_s > LANDING_S.0)
        {
            self.heights.pop_front();
        }
    }

    /// The steepest way down just before a landing, m/s.
    fn landing_m_s(&self) -> f64 {
        let mut steepest = 0.0_f64;
        for (n, &(from_s, from_m)) in self.heights.iter().enumerate() {
            let later = self.heights.iter().skip(n + 1);
            let Some(&(to_s, to_m)) = later.clone().find(|(to_s, _)| to_s - from_s >= LANDING_S.1)
            else {
                break;
            };
            steepest = steepest.max((from_m - to_m) / (to_s - from_s));
        }
        steepest
    }

    fn piece(&mut self, length_s: f64) {
        let sum = std::mem::take(&mut self.sum);
        let count = f64::from(sum.count);
        let place_m = sum.place_m.map(|x| x / count);
        let middle_s = sum.began_s + 0.5 * length_s;
        let load_n = sum.load_n / count;
        let speed_mm_s = match self.last.replace((place_m, middle_s)) {
            Some((before_m, before_s)) => {
                let (dx, dy) = (place_m[0] - before_m[0], place_m[1] - before_m[1]);
                1e3 * libm::hypot(dx, dy) / (middle_s - before_s)
            }
            None => 0.0,
        };
        let Some(bias_n) = self.bias_n else {
            self.now = Now {
                speed_mm_s,
                load_n,
                touches: None,
            };
            self.look_for_bias(load_n);
            return;
        };
        let load_n = load_n - bias_n;
        let touches = load_n > self.contact_n();
        self.now = Now {
            speed_mm_s,
            load_n,
            touches: Some(touches),
        };
        if !touches {
            self.air_s += length_s;
            self.pieces.clear();
            return;
        }
        self.pieces.push((speed_mm_s, load_n, length_s));
        if self.pieces.len() == STRETCH {
            self.stretch();
            self.pieces.clear();
        }
    }

    /// A force that rests for two seconds is that of a tool in the air.
    fn look_for_bias(&mut self, load_n: f64) {
        self.rest.push_back(load_n);
        let pieces = (REST_S / PIECE_S) as usize;
        if self.rest.len() > pieces {
            self.rest.pop_front();
        }
        let (least, most) = self
            .rest
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, m), x| {
                (l.min(*x), m.max(*x))
            });
        if self.rest.len() == pieces && most - least < REST_N {
            self.bias_n = Some(self.rest.iter().sum::<f64>() / pieces as f64);
            self.air_s = REST_S;
        }
    }

    fn stretch(&mut self) {
        let count = self.pieces.len() as f64;
        let mean =
            |pick: fn(&(f64, f64, f64)) -> f64| self.pieces.iter().map(pick).sum::<f64>() / count;
        let (speed_mm_s, load_n) = (mean(|p| p.0), mean(|p| p.1));
        let (part, least_mm_s, least_n) = STEADY;
        let is_steady = self.pieces.iter().all(|(speed, load, _)| {
            (speed - speed_mm_s).abs() <= (part * speed_mm_s).max(least_mm_s)
                && (load - load_n).abs() <= (part * load_n).max(least_n)
        });
        if let Some(cell) = self.plan.coverage.cell(speed_mm_s, load_n) {
            self.cell = cell;
        }
        if is_steady {
            let seconds = self.pieces.iter().map(|p| p.2).sum();
            self.plan.coverage.add(speed_mm_s, load_n, seconds);
        }
    }

    /// Returns the current motion of the tool.
    #[must_use]
    pub fn now(&self) -> Now {
        self.now
    }

    /// Returns the grid of strokes so far.
    #[must_use]
    pub fn coverage(&self) -> &Coverage {
        &self.plan.coverage
    }

    /// Taps in each band of [`TAPS_M_S`].
    #[must_use]
    pub fn taps(&self) -> &[u32] {
        &self.taps
    }

    /// Time in the air, s.
    #[must_use]
    pub fn air_s(&self) -> f64 {
        self.air_s
    }

    /// Returns the next step.
    #[must_use]
    pub fn next_step(&self) -> NextStep {
        if self.bias_n.is_none() || self.air_s < self.plan.air_s {
            return NextStep::Air;
        }
        if let Some(band) = self.taps.iter().position(|taps| *taps < self.plan.taps) {
            return NextStep::Tap(band);
        }
        self.plan
            .coverage
            .next(self.cell)
            .map_or(NextStep::Nothing, NextStep::Stroke)
    }
}

#[cfg(test)]
#[path = "exploration_tests.rs"]
mod tests;
