//! The level of a model for unit noise, inside a graph: what the paper's variance has to
//! be multiplied with to be felt.

use super::graph::Writer;
use asperity_corpus::ORDER;
use asperity_nn::build::Value;
use std::f64::consts::{FRAC_PI_2, LOG10_E, PI};

/// Frequencies that the spectrum is averaged over. A midpoint sum over a spectrum with
/// poles of radius r is wrong by about r²ᴺ of itself: nothing at 0.986.
const POINTS: usize = 512;
/// Under the logarithm of a squared distance between a frequency and an LSF.
const FLOOR: f32 = 1e-12;

/// `10 log₁₀` of the mean over frequency of `|1 + e^{−jω}|²/|A|²`, [B, 18], for LSFs
/// [B, 18, 21] in rad.
///
/// On the unit circle `|A|² = (|P|² + |Q|²)/4`; for order 21 and c = cos ω,
/// `|Q|² = Π 4(c − c_k)²` over the eleven LSFs of Q, and
/// `|P|² = 4 sin²ω · Π 4(c − c_k)²` over the ten of P.
pub(super) fn decibels(writer: &mut Writer<'_>, lsf_rad: &Value) -> Value {
    let cosines = cosine(writer, lsf_rad);
    let every_second = |first: i64| (first..ORDER as i64).step_by(2).collect::<Vec<_>>();
    let omegas = (0..POINTS).map(|n| PI * (n as f64 + 0.5) / POINTS as f64);
    let table = |value: fn(f64) -> f64| -> Vec<f32> {
        omegas.clone().map(|omega| value(omega) as f32).collect()
    };
    let points = writer.table("spectrum.cos", &[1, 1, POINTS, 1], table(libm::cos));
    let sum = product(writer, &cosines, &every_second(0), &points);
    let difference = product(writer, &cosines, &every_second(1), &points);
    let ends = writer.table(
        "spectrum.ends",
        &[1, 1, POINTS],
        table(|omega| 4.0 * libm::sin(omega) * libm::sin(omega)),
    );
    let difference = writer.graph.mul(&difference, &ends);
    let denominator = writer.graph.add(&sum, &difference);
    // |1 + e^{−jω}|² = 2 + 2c; over |A|² = (…)/4; a mean over the points.
    let numerator = writer.table(
        "spectrum.numerator",
        &[1, 1, POINTS],
        table(|omega| 4.0 * (2.0 + 2.0 * libm::cos(omega)) / POINTS as f64),
    );
    let spectrum = writer.graph.div(&numerator, &denominator);
    let gain = writer.graph.reduce_sum(&spectrum, &[2], false);
    let logarithm = writer.graph.unary("Log", &gain);
    writer.times(&logarithm, (10.0 * LOG10_E) as f32)
}

/// `Π 4(c − c_k)²` over some LSFs, [B, 18, points].
fn product(writer: &mut Writer<'_>, cosines: &Value, which: &[i64], points: &Value) -> Value {
    let some = writer.gather(cosines, 2, which);
    let some = writer.graph.unsqueeze(&some, &[2]);
    let distance = writer.graph.sub(points, &some);
    let doubled = writer.times(&distance, 2.0);
    let square = writer.graph.mul(&doubled, &doubled);
    let square = writer.plus(&square, FLOOR);
    let logarithm = writer.graph.unary("Log", &square);
    let sum = writer.graph.reduce_sum(&logarithm, &[3], false);
    writer.graph.unary("Exp", &sum)
}

/// cos x for x in 0..=π as `−sin(x − π/2)`, by the Taylor series up to the 15th power:
/// within 1e-7, and with no operator that engines round each in their own way.
fn cosine(writer: &mut Writer<'_>, x: &Value) -> Value {
    let x = writer.plus(x, -(FRAC_PI_2 as f32));
    let square = writer.graph.mul(&x, &x);
    let mut factorial = 1_307_674_368_000.0_f64;
    let mut power = 15.0;
    let mut sign = -1.0;
    let mut sum = writer.graph.scalar((sign / factorial) as f32);
    while power > 1.0 {
        factorial /= power * (power - 1.0);
        power -= 2.0;
        sign = -sign;
        let higher = writer.graph.mul(&sum, &square);
        sum = writer.plus(&higher, (sign / factorial) as f32);
    }
    let sine = writer.graph.mul(&sum, &x);
    writer.times(&sine, -1.0)
}
