//! From ticks at 16 kHz to frames at 48 kHz.
//!
//! A linear-phase FIR in three phases of a third-band low-pass
//!
//! ```text
//! h[n] = sin(πn/3)/(πn/3) · I₀(β√(1 − (n/33)²))/I₀(β),   −33 < n < 33,
//! ```
//!
//! a sinc with its edge at 8 kHz under a Kaiser window of β = 6.755, which stands for 70 dB (Kaiser
//! 1974). Up to 6 kHz it is flat within 0.01 dB; the images, from 10 kHz on, are 70 dB down or more.
//! Since h vanishes at every third n but 0, each third frame is a tick, bit for bit. The delay is
//! [`DELAY_TICKS`] ticks, 0.69 ms.

/// Frames a tick.
pub const FACTOR: usize = 3;
/// Ticks by which the frames are late.
pub const DELAY_TICKS: usize = 11;

const KAISER_BETA: f64 = 6.755;
/// Ticks that a frame is computed from.
const LENGTH: usize = 2 * DELAY_TICKS;
/// The weights of the second and the third frame of a tick, the newest tick first.
const WEIGHTS: [[f32; LENGTH]; FACTOR - 1] = [phase(1), phase(2)];

/// The last ticks.
#[derive(Debug, Clone)]
pub struct Upsampler {
    /// The newest first.
    ticks: [f32; LENGTH],
}

impl Default for Upsampler {
    fn default() -> Self {
        Self::new()
    }
}

impl Upsampler {
    /// Silence.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            ticks: [0.0; LENGTH],
        }
    }

    /// Takes a tick; [`Upsampler::frame`] then gives its frames.
    pub fn push(&mut self, tick: f32) {
        self.ticks.copy_within(..LENGTH - 1, 1);
        self.ticks[0] = tick;
    }

    /// The frame of a phase, 0 to 2, in the unit of the ticks.
    #[must_use]
    pub fn frame(&self, phase: usize) -> f32 {
        match phase.checked_sub(1).and_then(|late| WEIGHTS.get(late)) {
            Some(weights) => (self.ticks.iter().zip(weights))
                .map(|(tick, weight)| tick * weight)
                .sum(),
            None => self.ticks[DELAY_TICKS],
        }
    }
}

/// The weights of the frame `phase` thirds of a tick after the newest one.
const fn phase(phase: usize) -> [f32; LENGTH] {
    let mut weights = [0.0; LENGTH];
    let mut age = 0;
    while age < LENGTH {
        let place = (FACTOR * age + phase) as f64 - (FACTOR * DELAY_TICKS) as f64;
        weights[age] = (sinc(place) * window(place)) as f32;
        age += 1;
    }
    weights
}

/// sin(πn/3)/(πn/3) of a whole n that 3 does not divide; the sine is then ±√3/2.
const fn sinc(n: f64) -> f64 {
    const SINE: f64 = 0.866_025_403_784_438_6;
    // The sinc is even, and its sign changes at every multiple of 3.
    let lobe = n.abs() as u32 / 3;
    let sign = if lobe.is_multiple_of(2) { 1.0 } else { -1.0 };
    sign * SINE * 3.0 / (core::f64::consts::PI * n.abs())
}

/// The Kaiser window, 1 at 0.
const fn window(n: f64) -> f64 {
    let place = n / (FACTOR * DELAY_TICKS) as f64;
    let square = KAISER_BETA * KAISER_BETA / 4.0;
    bessel_i0(square * (1.0 - place * place)) / bessel_i0(square)
}

/// I₀(x) by its power series in (x/2)², which is `quarter_square`. Thirty terms are exact for x < 10.
const fn bessel_i0(quarter_square: f64) -> f64 {
    let (mut sum, mut term, mut k) = (1.0, 1.0, 1.0);
    while k <= 30.0 {
        term *= quarter_square / (k * k);
        sum += term;
        k += 1.0;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::TAU;

    /// The answer to a tick of 1.
    fn impulse_response() -> [f64; FACTOR * LENGTH] {
        let mut upsampler = Upsampler::new();
        let mut response = [0.0; FACTOR * LENGTH];
        for (n, frame) in response.iter_mut().enumerate() {
            if n.is_multiple_of(FACTOR) {
                upsampler.push(if n == 0 { 1.0 } else { 0.0 });
            }
            *frame = f64::from(upsampler.frame(n % FACTOR));
        }
        response
    }

    /// Level, dB, of what a tick's sine of `frequency_hz` becomes at that frequency: a third of the
    /// spectrum's energy is in each of the three bands.
    fn level_db(frequency_hz: f64) -> f64 {
        let (mut re, mut im) = (0.0, 0.0);
        for (n, h) in impulse_response().iter().enumerate() {
            let angle = TAU * frequency_hz * n as f64 / 48_000.0;
            re += h * angle.cos();
            im -= h * angle.sin();
        }
        20.0 * (re.hypot(im) / FACTOR as f64).log10()
    }

    #[test]
    fn the_band_to_6_khz_is_flat_and_its_images_are_70_db_down() {
        for step in 0..=600 {
            let hz = f64::from(step) * 10.0;
            assert!(level_db(hz).abs() < 0.01, "{hz} Hz: {} dB", level_db(hz));
            for image in [16_000.0 - hz, 16_000.0 + hz] {
                let image = if image > 24_000.0 { 24_000.0 } else { image };
                let level = level_db(image);
                assert!(level < -70.0, "{image} Hz: {level} dB");
            }
        }
    }

    #[test]
    fn the_response_is_symmetric_about_its_delay() {
        let response = impulse_response();
        let centre = FACTOR * DELAY_TICKS;
        assert_eq!(response[centre], 1.0);
        for n in 1..centre {
            assert_eq!(response[centre - n], response[centre + n], "{n}");
        }
    }

    #[test]
    fn each_third_frame_is_a_tick_bit_for_bit() {
        let tick = |n: usize| ((n * n) as f32).sin();
        let mut upsampler = Upsampler::new();
        for n in 0..200 {
            upsampler.push(tick(n));
            if n >= DELAY_TICKS {
                assert_eq!(
                    upsampler.frame(0).to_bits(),
                    tick(n - DELAY_TICKS).to_bits()
                );
            }
        }
    }
}
