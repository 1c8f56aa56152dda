//! Seeded trajectories of a stylus.

use crate::draw::Draw;

/// Positions at 1 kHz, m. The stylus hovers over the plane z = 0, and taps, strokes and scrubs
/// it over a few centimetres.
#[must_use]
pub fn strokes(seed: u64, ticks: usize) -> Vec<[f32; 3]> {
    strokes_at(1000.0, seed, ticks)
}

/// [`strokes`] at another rate, Hz.
#[must_use]
pub fn strokes_at(rate_hz: f64, seed: u64, ticks: usize) -> Vec<[f32; 3]> {
    let mut draw = Draw::new(seed);
    let wave = |draw: &mut Draw, amplitude: f64, low_hz: f64, high_hz: f64| {
        let (hz, phase) = (
            draw.range(low_hz, high_hz),
            draw.range(0.0, std::f64::consts::TAU),
        );
        move |t: f64| amplitude * (std::f64::consts::TAU * hz * t + phase).sin()
    };
    let x = [
        wave(&mut draw, 0.02, 0.3, 1.0),
        wave(&mut draw, 0.003, 2.0, 6.0),
    ];
    let y = [
        wave(&mut draw, 0.02, 0.2, 0.8),
        wave(&mut draw, 0.002, 2.0, 6.0),
    ];
    let z = [
        wave(&mut draw, 0.004, 0.8, 1.6),
        wave(&mut draw, 0.001, 3.0, 7.0),
    ];
    (0..ticks)
        .map(|n| {
            let t = n as f64 / rate_hz;
            let height = z[0](t) + z[1](t);
            // Depth is compressed: 5 mm at 500 N/m would be 2.5 N.
            let height = if height < 0.0 { 0.8 * height } else { height };
            [
                (x[0](t) + x[1](t)) as f32,
                (y[0](t) + y[1](t)) as f32,
                height as f32,
            ]
        })
        .collect()
}

/// A straight stroke along x at a constant speed and depth, m, at 1 kHz.
pub fn steady(speed_mm_s: f64, depth_m: f64, ticks: usize) -> impl Iterator<Item = [f32; 3]> {
    // Strokes back and forth would change the direction. A circle of 1 m keeps the speed, and
    // its positions are small enough for f32.
    let radius_m = 1.0;
    (0..ticks).map(move |n| {
        let angle = speed_mm_s * 1e-6 * n as f64 / radius_m;
        [
            (radius_m * angle.sin()) as f32,
            (radius_m * angle.cos()) as f32,
            -depth_m as f32,
        ]
    })
}
