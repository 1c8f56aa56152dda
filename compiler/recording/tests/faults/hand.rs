//! The hand that strokes, and the signals of its sensors.

use super::take::{GRAVITY_M_S2, Random};
use std::f64::consts::TAU;

/// Motion of a hand, and the signals of its sensors at a time.
pub(super) struct Hand {
    length_m: f64,
    stroke_hz: f64,
    /// Amplitude, frequency and phase of what the hand does between strokes.
    tremor: [[f64; 3]; 3],
    air_s: f64,
    lift_s: f64,
    load_n: f64,
    friction: f64,
    /// A texture's vibration at 1 m/s, by samples of 2 kHz.
    texture: Vec<f64>,
    tilt: [f64; 3],
}

impl Hand {
    pub(super) fn new(random: &mut Random, seconds: f64) -> Self {
        let loud = random.within(8.0, 40.0);
        let mut before = 0.0;
        let texture = (0..(2000.0 * seconds) as usize + 2)
            .map(|_| {
                before = 0.5 * before + random.noise();
                loud * before
            })
            .collect();
        let (across, along) = (random.within(-0.3, 0.3), random.within(-0.3, 0.3));
        Self {
            length_m: random.within(0.02, 0.05),
            stroke_hz: random.within(0.5, 1.0),
            tremor: [0; 3].map(|_| {
                [
                    random.within(0.0005, 0.0015),
                    random.within(2.3, 5.5),
                    random.within(0.0, TAU),
                ]
            }),
            air_s: random.within(2.1, 2.4),
            lift_s: seconds - random.within(0.3, 0.7),
            load_n: random.within(0.7, 2.5),
            friction: random.within(0.2, 0.7),
            texture,
            tilt: [
                across,
                along,
                (1.0 - across * across - along * along).sqrt(),
            ],
        }
    }

    /// Position, velocity and acceleration along x and y.
    fn motion(&self, t: f64) -> [[f64; 3]; 2] {
        let wave = |a: f64, hz: f64, phase: f64| {
            let (w, angle) = (TAU * hz, TAU * hz * t + phase);
            [
                a * angle.sin(),
                a * w * angle.cos(),
                -a * w * w * angle.sin(),
            ]
        };
        let [first, second, third] = self.tremor.map(|[a, hz, phase]| wave(a, hz, phase));
        let stroke = wave(self.length_m, self.stroke_hz, 0.3);
        let across = wave(0.3 * self.length_m, 0.37 * self.stroke_hz, 1.0);
        [
            std::array::from_fn(|k| stroke[k] + first[k] + second[k]),
            std::array::from_fn(|k| across[k] + third[k]),
        ]
    }

    fn load(&self, t: f64) -> f64 {
        let down = ((t - self.air_s) / 0.05).clamp(0.0, 1.0);
        let up = ((self.lift_s - t) / 0.05).clamp(0.0, 1.0);
        self.load_n * down.min(up) * (1.0 + 0.25 * (TAU * 0.4 * t).sin())
    }

    /// Acceleration, force and position of three axes.
    pub(super) fn feel(&self, t: f64) -> [[f64; 3]; 3] {
        let [[x, vx, ax], [y, vy, ay]] = self.motion(t);
        let (load, speed) = (self.load(t), vx.hypot(vy));
        let at = (2000.0 * t.max(0.0)).min(self.texture.len() as f64 - 2.0);
        let between = at.fract();
        let texture =
            (1.0 - between) * self.texture[at as usize] + between * self.texture[at as usize + 1];
        let vibration = texture * speed * (load / self.load_n).sqrt();
        let drag = self.friction * load / (speed + 0.004);
        let lowered = if load > 0.0 {
            -load / 900.0
        } else {
            0.01 * ((self.air_s - t).abs() * 5.0).min(1.0)
        };
        let moving = [ax, ay, 0.0];
        [
            std::array::from_fn(|k| {
                moving[k] + GRAVITY_M_S2 * self.tilt[k] + vibration * [0.8, 0.45, 0.4][k]
            }),
            [
                -drag * vx + 0.05 * 0.8 * vibration,
                -drag * vy + 0.05 * 0.45 * vibration,
                load + 0.05 * 0.4 * vibration,
            ],
            [x, y, lowered],
        ]
    }
}
