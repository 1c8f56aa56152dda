//! A ball in a hand that is dragged over a relief: its contact, its mass and its jumps, step by step.
//!
//! ```text
//! m·z̈ = K·Σ max(0, h − z − r²/2R)·dA − F − c·ż
//! ```
//!
//! `z` is the height of the ball's lowest point and `r` the horizontal distance from it. Every point of the surface is a
//! spring of its own (Winkler's elastic foundation). The hand is a constant force and a damper to the ground; the material
//! has no damping. The parameters say how the ball rests on a flat surface, and foundation, mass and damper follow.

use std::f64::consts::{PI, TAU};

/// Steps a second.
pub const RATE_HZ: f64 = 20_000.0;
/// Time after which the acceleration is recorded, s.
pub const SETTLING_S: f64 = 0.1;

/// Halvings of an interval that holds the height at rest.
const HALVINGS: usize = 50;
/// Partial sums over a row, which the processor adds side by side.
const LANES: usize = 4;

/// Heights on a grid that continues periodically in x and in y.
#[derive(Debug, Clone)]
pub struct Relief {
    width: usize,
    pitch_mm: [f64; 2],
    /// Every row twice, so that a row from any point on is a slice, mm.
    heights_mm: Vec<f64>,
    /// Highest point of every row, mm.
    tops_mm: Vec<f64>,
    top_mm: f64,
}

/// A ball, and how it rests on a flat surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DraggedTip {
    /// Radius of the ball, mm.
    pub radius_mm: f64,
    /// Force of the hand, N.
    pub force_n: f64,
    /// Radius of the contact with a flat surface, mm.
    pub contact_mm: f64,
    /// Resonance on a flat surface without the damper, Hz.
    pub resonance_hz: f64,
    /// Damping ratio of the hand's damper at that resonance.
    pub damping_ratio: f64,
}

/// A drag, recorded at [`RATE_HZ`].
#[derive(Debug, Clone, PartialEq)]
pub struct Drag {
    /// Acceleration of the ball, upwards, m/s².
    pub acceleration_m_s2: Vec<f64>,
    /// Share of the steps without contact.
    pub lost: f64,
}

impl Relief {
    /// A relief of rows of `width` points, `pitch_mm` apart in x and in y; heights in µm, row by row.
    ///
    /// # Panics
    ///
    /// If there is no point, or if a row is not whole.
    #[must_use]
    pub fn new(width: usize, pitch_mm: [f64; 2], heights_um: &[f32]) -> Self {
        assert!(!heights_um.is_empty() && heights_um.len().is_multiple_of(width));
        let rows = heights_um.chunks_exact(width);
        let twice = rows.flat_map(|row| row.iter().chain(row));
        let heights_mm: Vec<f64> = twice.map(|h| 1e-3 * f64::from(*h)).collect();
        let highest = |heights: &[f64]| heights.iter().copied().fold(f64::MIN, f64::max);
        let tops_mm: Vec<f64> = heights_mm.chunks_exact(2 * width).map(highest).collect();
        Self {
            width,
            pitch_mm,
            heights_mm,
            top_mm: highest(&tops_mm),
            tops_mm,
        }
    }

    /// Length of a period in x, mm.
    #[must_use]
    pub fn period_mm(&self) -> f64 {
        self.width as f64 * self.pitch_mm[0]
    }

    /// Volume that a ball of this radius and the relief share, mm³, if its lowest point is at a height over `at_mm`.
    #[must_use]
    pub fn overlap_mm3(&self, radius_mm: f64, at_mm: [f64; 2], height_mm: f64) -> f64 {
        let per_square = 0.5 / radius_mm;
        let [pitch_x, pitch_y] = self.pitch_mm;
        // Points n·pitch within a distance of which the sag is less than `room`.
        let within = |centre: f64, pitch: f64, room: f64, most: usize| {
            let reach = (room / per_square).sqrt();
            let first = ((centre - reach) / pitch).ceil() as i64;
            let last = ((centre + reach) / pitch).floor() as i64;
            (first, last.min(first + most as i64 - 1))
        };
        let (rows, mut sum) = (self.tops_mm.len(), 0.0);
        let room = (self.top_mm - height_mm).max(0.0);
        let (first, last) = within(at_mm[1], pitch_y, room, rows);
        for line in first..=last {
            let row = line.rem_euclid(rows as i64) as usize;
            let away = line as f64 * pitch_y - at_mm[1];
            let base = height_mm + per_square * away * away;
            let room = self.tops_mm[row] - base;
            if room <= 0.0 {
                continue;
            }
            let (first, last) = within(at_mm[0], pitch_x, room, self.width);
            let start = row * 2 * self.width + first.rem_euclid(self.width as i64) as usize;
            let heights = &self.heights_mm[start..][..(last - first + 1).max(0) as usize];
            let ahead = first as f64 * pitch_x - at_mm[0];
            let above = |n: usize, height: f64| {
                let away = ahead + n as f64 * pitch_x;
                (height - base - per_square * away * away).max(0.0)
            };
            let mut sums = [0.0; LANES];
            let (chunks, rest) = heights.as_chunks::<LANES>();
            for (chunk, heights) in chunks.iter().enumerate() {
                for lane in 0..LANES {
                    sums[lane] += above(chunk * LANES + lane, heights[lane]);
                }
            }
            for (lane, height) in rest.iter().enumerate() {
                sums[lane] += above(chunks.len() * LANES + lane, *height);
            }
            sum += sums.iter().sum::<f64>();
        }
        sum * pitch_x * pitch_y
    }
}

impl DraggedTip {
    /// Indentation of a flat surface, mm.
    #[must_use]
    pub fn indentation_mm(&self) -> f64 {
        self.contact_mm * self.contact_mm / (2.0 * self.radius_mm)
    }

    /// Stiffness of the foundation, N/mm³: on a flat surface the force is πKRd² at the indentation d.
    #[must_use]
    pub fn foundation_n_mm3(&self) -> f64 {
        self.force_n / (PI * self.radius_mm * self.indentation_mm().powi(2))
    }

    /// Mass, kg: on the stiffness 2F/d it has the resonance.
    #[must_use]
    pub fn mass_kg(&self) -> f64 {
        let stiffness_n_m = 2e3 * self.force_n / self.indentation_mm();
        stiffness_n_m / (TAU * self.resonance_hz).powi(2)
    }

    /// Height at which the ball rests, mm.
    fn resting_mm(&self, relief: &Relief, at_mm: [f64; 2]) -> f64 {
        let wanted_mm3 = self.force_n / self.foundation_n_mm3();
        let overlaps = |height| relief.overlap_mm3(self.radius_mm, at_mm, height) >= wanted_mm3;
        let (mut above, mut reach) = (relief.top_mm, self.indentation_mm());
        while !overlaps(above - reach) {
            reach *= 2.0;
        }
        for _ in 0..HALVINGS {
            reach *= 0.5;
            if !overlaps(above - reach) {
                above -= reach;
            }
        }
        above
    }

    /// Drags the ball from rest at x = 0 in the direction of x. What is recorded starts after [`SETTLING_S`].
    #[must_use]
    pub fn drag(&self, relief: &Relief, y_mm: f64, speed_mm_s: f64, duration_s: f64) -> Drag {
        let (mass, foundation) = (self.mass_kg(), self.foundation_n_mm3());
        let step_s = 1.0 / RATE_HZ;
        // The damper acts on the mean of the velocities before and after a step.
        let damper = self.damping_ratio * TAU * self.resonance_hz * step_s;
        let [settling, recorded] = [SETTLING_S, duration_s].map(|s| (s * RATE_HZ).round() as usize);
        let (mut height_mm, mut velocity_m_s) = (self.resting_mm(relief, [0.0, y_mm]), 0.0);
        let (mut acceleration_m_s2, mut lost) = (Vec::with_capacity(recorded), 0);
        for step in 0..settling + recorded {
            let x_mm = (speed_mm_s * step as f64 * step_s).rem_euclid(relief.period_mm());
            let contact_n =
                foundation * relief.overlap_mm3(self.radius_mm, [x_mm, y_mm], height_mm);
            let pushed = velocity_m_s * (1.0 - damper) + step_s * (contact_n - self.force_n) / mass;
            let next = pushed / (1.0 + damper);
            if step >= settling {
                acceleration_m_s2.push((next - velocity_m_s) * RATE_HZ);
                lost += usize::from(contact_n == 0.0);
            }
            velocity_m_s = next;
            height_mm += 1e3 * step_s * velocity_m_s;
        }
        Drag {
            acceleration_m_s2,
            lost: lost as f64 / recorded as f64,
        }
    }
}
