//! A folder as sensors write it, of six seconds: strokes with a newton after a second in the air.

use std::{f64::consts::TAU, fmt::Write as _};

const ROWS: usize = 6000;
const RATE_HZ: u32 = 1000;
/// Acceleration at full scale of the WAV, m/s².
const FULL_SCALE: f64 = 40.0;

pub(crate) const DESCRIPTION: &str = "name = \"Oak\"
[[file]]
path = \"accel.wav\"
[[file.channel]]
column = 0
quantity = \"acceleration\"
axis = \"x\"
unit = \"m/s^2\"
scale = 40.0
[[file.channel]]
column = 1
quantity = \"acceleration\"
axis = \"z\"
unit = \"m/s^2\"
scale = 40.0
[[file]]
path = \"force.npy\"
rate_hz = 1000
[[file.channel]]
column = 0
quantity = \"force\"
axis = \"x\"
unit = \"N\"
[[file.channel]]
column = 1
quantity = \"force\"
axis = \"z\"
unit = \"N\"
[[file]]
path = \"position.csv\"
clock = \"time_s\"
[[file.channel]]
column = \"x\"
quantity = \"position\"
axis = \"x\"
unit = \"mm\"
";

/// Acceleration, force and position of a row.
fn rows() -> impl Iterator<Item = ([f64; 2], [f64; 2], f64)> {
    let mut state = 5_u64;
    let mut noise = move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
    };
    // Strokes, and a faster motion by which the delay between the files can be told.
    let motions = [(0.03, TAU * 0.7), (0.002, TAU * 3.1), (0.001, TAU * 4.7)];
    (0..ROWS).map(move |n| {
        let t = n as f64 / f64::from(RATE_HZ);
        let load = if t > 1.0 { 1.0 } else { 0.0 };
        let vibration = load * noise();
        let sum = |part: fn(f64, f64, f64) -> f64| -> f64 {
            motions
                .iter()
                .map(|(far, omega)| part(*far, *omega, omega * t))
                .sum()
        };
        let x = sum(|far, _, phase| far * phase.sin());
        let v = sum(|far, omega, phase| far * omega * phase.cos());
        let a = sum(|far, omega, phase| -far * omega * omega * phase.sin());
        (
            [vibration + a + 0.02 * noise(), 9.81 + 0.02 * noise()],
            [
                -0.4 * load * v.signum() + 0.05 * vibration + 0.002 * noise(),
                load + 0.002 * noise(),
            ],
            1e3 * x,
        )
    })
}

/// The accelerometer's WAV of two channels and 16 bits.
pub(crate) fn wave() -> Vec<u8> {
    let data = ROWS as u32 * 4;
    let mut bytes = b"RIFF".to_vec();
    bytes.extend((36 + data).to_le_bytes());
    bytes.extend(b"WAVEfmt \x10\0\0\0\x01\0\x02\0");
    bytes.extend(RATE_HZ.to_le_bytes());
    bytes.extend((4 * RATE_HZ).to_le_bytes());
    bytes.extend(b"\x04\0\x10\0data");
    bytes.extend(data.to_le_bytes());
    for value in rows().flat_map(|row| row.0) {
        bytes.extend(((value / FULL_SCALE * 32768.0).round() as i16).to_le_bytes());
    }
    bytes
}

/// The force sensor's array.
pub(crate) fn array() -> Vec<u8> {
    let header = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({ROWS}, 2), }}");
    let padded = format!("{header:<117}\n");
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((padded.len() as u16).to_le_bytes());
    bytes.extend(padded.as_bytes());
    bytes.extend(
        rows()
            .flat_map(|row| row.1)
            .flat_map(|f| (f as f32).to_le_bytes()),
    );
    bytes
}

/// The device's table.
pub(crate) fn table() -> String {
    let mut text = "time_s,x\n".to_owned();
    for (n, (.., x)) in rows().enumerate() {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{:.3},{x:.4}", n as f64 / f64::from(RATE_HZ));
    }
    text
}
