//! Measures of the Falcon: a platform on three legs, each a thigh that a motor turns and a shin
//! that is a parallelogram.
//!
//! Names and values are those that libnifalcon publishes (BSD), after R. E. Stamper's thesis on
//! such mechanisms (University of Maryland, 1997). The device's z axis points from its body to the
//! user. Nobody confirmed them on a device here.

/// Length a of the thigh, from the motor's axis to the knee, m.
pub const THIGH_M: f64 = 0.060;
/// Length b of the shin's parallelogram, m.
pub const SHIN_M: f64 = 0.1025;
/// Distance c of the platform's joint from the platform's centre, radial, m.
pub const PLATFORM_RADIAL_M: f64 = 0.01443;
/// Length d + e of the two joints at the ends of the shin, m.
pub const JOINTS_M: f64 = 2.0 * 0.01125;
/// Distance f of the platform's joint from the platform's centre, tangential, m.
pub const PLATFORM_TANGENTIAL_M: f64 = -0.025;
/// Distance r of a leg's base from the origin, radial, m.
pub const BASE_RADIAL_M: f64 = 0.0400;
/// Distance s of a leg's base from the origin, tangential, m.
pub const BASE_TANGENTIAL_M: f64 = -0.02309;

/// Cosine and sine of the three legs' directions: 105°, −15°, −135°.
pub const LEGS: [[f64; 2]; 3] = [
    [-0.258_819_045_102_520_76, 0.965_925_826_289_068_3],
    [0.965_925_826_289_068_3, -0.258_819_045_102_520_76],
    [
        -std::f64::consts::FRAC_1_SQRT_2,
        -std::f64::consts::FRAC_1_SQRT_2,
    ],
];

/// Angle of a thigh where its encoder counts 0, rad: 35°.
pub const ANGLE_AT_ZERO: f64 = 35.0 * std::f64::consts::PI / 180.0;
/// Counts of an encoder in a turn of its motor: 320 slots, counted fourfold.
const COUNTS_PER_TURN: f64 = 320.0 * 4.0;
/// Angle of a thigh per count of its encoder, rad: the cable runs from a shaft of 14.25 mm to an
/// arc of 110 mm.
pub const RAD_PER_COUNT: f64 = std::f64::consts::TAU / COUNTS_PER_TURN * 14.25 / 110.0;

/// Centre of the workspace in the device's frame, m: the origin of ours.
pub const CENTRE_M: [f64; 3] = [0.0, 0.0, 0.125];

/// Largest force, N: "more than 2 lb", as its maker published.
pub const PEAK_FORCE_N: f32 = 8.9;
/// Force that is taken as permanent, N. Its maker published none; this is cautious.
pub const CONTINUOUS_FORCE_N: f32 = 3.0;
/// Counts of a motor's command per torque at its thigh, 1/(N·m).
pub const COUNTS_PER_NM: f64 = 10_000.0;

/// Angle of a thigh from the count of its encoder, rad.
#[must_use]
pub fn angle(count: i16) -> f64 {
    f64::from(count) * RAD_PER_COUNT + ANGLE_AT_ZERO
}

/// Count of an encoder, the nearest one, from the angle of its thigh in rad.
#[must_use]
pub fn count(angle: f64) -> i16 {
    libm::round((angle - ANGLE_AT_ZERO) / RAD_PER_COUNT) as i16
}
