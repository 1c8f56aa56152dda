//! The summary of a recording: its figures, then its caveats.

use std::fmt;

use asperity_io::shown::counted;
use asperity_recording::signal::quantile::quantile;
use asperity_runtime::Flags;
use serde::Serialize;
use serde_json::{Value, json};

use super::recording::Recording;
use super::statistics::{mean, peak, rms};
use super::stroke::{StrokeReport, strokes};
use super::tap::{Taps, taps};
use asperity_sim::device::norm;
use asperity_sim::session::Record;

/// Lower ends of the speed bands, mm/s.
const BANDS_MM_S: [f64; 5] = [0.0, 50.0, 100.0, 150.0, 200.0];
/// Speed above which the stylus counts as sliding, mm/s.
const SLIDING_MM_S: f64 = 20.0;

/// Vibration while the estimated speed is in a band.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Band {
    /// Lower end, mm/s.
    pub from_mm_s: f64,
    /// Upper end, mm/s; infinite for the last.
    pub to_mm_s: f64,
    /// Time spent in the band, s.
    pub time_s: f64,
    /// RMS of the vibration, m/s².
    pub rms_m_s2: f64,
    /// Largest magnitude of the vibration, m/s².
    pub peak_m_s2: f64,
}

/// The figures of a recording.
#[derive(Debug, Clone)]
pub struct Summary<'a> {
    recording: &'a Recording,
    /// Fraction of the time in contact, 0..=1.
    pub contact_fraction: f64,
    /// Mean, 5th, 50th, 95th percentile and maximum of the normal force, N.
    pub normal_n: [f64; 5],
    /// Vibration by speed band, in contact.
    pub bands: Vec<Band>,
    /// Mean friction while sliding, N.
    pub friction_n: f64,
    /// Mean of μ·F_n over the same ticks, N.
    pub coulomb_n: f64,
    /// Scripted and other taps.
    pub taps: Taps,
    /// Strokes over their steady parts.
    pub strokes: Vec<StrokeReport>,
    /// Largest commanded force, N.
    pub peak_n: f64,
    /// Largest change of the commanded force, N/s.
    pub slew_n_s: f64,
    /// RMS of the force that the device held, N.
    pub device_rms_n: f64,
    /// Ticks outside the texture's grid, while in contact.
    pub outside_grid: u64,
    /// Ticks with the vibration at its bound.
    pub vib_clamped: u64,
    /// Ticks in the safe state.
    pub safe_ticks: u64,
}

impl<'a> Summary<'a> {
    /// Computes the figures of a recording.
    #[must_use]
    pub fn new(recording: &'a Recording) -> Self {
        let records = &recording.records;
        let contact: Vec<&Record> = with(records, Flags::CONTACT).collect();
        let mut forces: Vec<f64> = contact
            .iter()
            .map(|r| f64::from(r.output.normal_force_n))
            .collect();
        forces.sort_by(f64::total_cmp);
        let sliding = contact
            .iter()
            .filter(|r| f64::from(r.output.speed_mm_s) > SLIDING_MM_S);
        let force = |r: &Record| r.output.force_n.map(f64::from);
        let rate_hz = recording.device.timing.servo_rate_hz;
        let steps = records.windows(2).map(|pair| {
            let (a, b) = (force(&pair[0]), force(&pair[1]));
            norm(std::array::from_fn(|i| b[i] - a[i])) * rate_hz
        });
        Self {
            recording,
            contact_fraction: contact.len() as f64 / records.len().max(1) as f64,
            normal_n: [
                mean(forces.iter().copied()),
                quantile(forces.iter().copied(), 0.05),
                quantile(forces.iter().copied(), 0.5),
                quantile(forces.iter().copied(), 0.95),
                quantile(forces.iter().copied(), 1.0),
            ],
            bands: bands(&contact, recording.tick_s()),
            friction_n: mean(sliding.clone().map(|r| f64::from(r.output.friction_n))),
            coulomb_n: mean(sliding.map(|r| {
                let (speed, force) = (r.output.speed_mm_s, r.output.normal_force_n);
                recording.texture.mu_at(speed.into()) * f64::from(force)
            })),
            taps: taps(recording),
            strokes: strokes(recording),
            peak_n: peak(records.iter().map(|r| norm(force(r)))),
            slew_n_s: peak(steps),
            device_rms_n: rms(records.iter().map(|r| norm(r.device_n))),
            outside_grid: contact
                .iter()
                .filter(|r| r.output.flags.contains(Flags::OUTSIDE_GRID))
                .count() as u64,
            vib_clamped: with(records, Flags::VIB_CLAMPED).count() as u64,
            safe_ticks: with(records, Flags::SAFE_STATE).count() as u64,
        }
    }

    /// The figures for machines, in the units of the fields.
    #[must_use]
    pub fn json(&self) -> Value {
        let Recording {
            device,
            grip,
            texture,
            ..
        } = self.recording;
        let [mean_n, p5_n, p50_n, p95_n, max_n] = self.normal_n;
        json!({
            "texture": texture.name,
            "origin": texture.origin,
            "device": device.name,
            "grip": grip.name,
            "seed": self.recording.seed,
            "rate_hz": device.timing.servo_rate_hz,
            "seconds": self.recording.duration_s(),
            "ticks": self.recording.records.len(),
            "contact_fraction": self.contact_fraction,
            "normal_n": {
                "mean": mean_n, "p5": p5_n, "p50": p50_n, "p95": p95_n, "max": max_n,
            },
            "friction_n": self.friction_n,
            "coulomb_n": self.coulomb_n,
            "peak_n": self.peak_n,
            "slew_n_s": self.slew_n_s,
            "device_rms_n": self.device_rms_n,
            "bands": self.bands,
            "taps": self.taps,
            "strokes": self.strokes,
            "outside_grid_ticks": self.outside_grid,
            "vib_clamped_ticks": self.vib_clamped,
            "safe_ticks": self.safe_ticks,
            "caveats": self.caveats(),
        })
    }

    /// Every value of the session that nobody could confirm, and every synthetic part.
    #[must_use]
    pub fn caveats(&self) -> Vec<String> {
        let Recording {
            device,
            grip,
            texture,
            ..
        } = self.recording;
        let mut caveats = vec!["device and hand are simulated".to_owned()];
        if !device.unconfirmed.is_empty() {
            caveats.push(format!(
                "unconfirmed, {}: {}",
                device.name,
                device.unconfirmed.join(", ")
            ));
        }
        if !grip.unconfirmed.is_empty() {
            caveats.push(format!(
                "unconfirmed, {} grip: {}",
                grip.name,
                grip.unconfirmed.join(", ")
            ));
        }
        caveats.extend(texture.caveats.iter().cloned());
        caveats
    }
}

fn with(records: &[Record], flag: Flags) -> impl Iterator<Item = &Record> {
    records
        .iter()
        .filter(move |r| r.output.flags.contains(flag))
}

fn bands(contact: &[&Record], tick_s: f64) -> Vec<Band> {
    let ends = BANDS_MM_S.iter().skip(1).copied().chain([f64::INFINITY]);
    BANDS_MM_S
        .into_iter()
        .zip(ends)
        .map(|(from_mm_s, to_mm_s)| {
            let inside: Vec<f64> = contact
                .iter()
                .filter(|r| (from_mm_s..to_mm_s).contains(&f64::from(r.output.speed_mm_s)))
                .map(|r| f64::from(r.output.vib_m_s2))
                .collect();
            Band {
                from_mm_s,
                to_mm_s,
                time_s: inside.len() as f64 * tick_s,
                rms_m_s2: rms(inside.iter().copied()),
                peak_m_s2: peak(inside),
            }
        })
        .collect()
}

impl fmt::Display for Summary<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Recording {
            texture,
            device,
            grip,
            counters,
            device_counts,
            ..
        } = self.recording;
        writeln!(
            f,
            "texture    {} ({}), μ {:.3}, wall {:.0} N/m, grid to {:.0} mm/s and {:.2} N",
            texture.name,
            texture.origin,
            texture.mu,
            texture.stiffness_n_m,
            texture.grid.0,
            texture.grid.1
        )?;
        writeln!(
            f,
            "device     {} (simulated), {:.0} Hz, {} of transport delay",
            device.name,
            device.timing.servo_rate_hz,
            counted(device.timing.transport_delay_ticks, "tick", "ticks")
        )?;
        writeln!(
            f,
            "hand       {} grip, seed {}",
            grip.name, self.recording.seed
        )?;
        writeln!(
            f,
            "duration   {:.3} s of virtual time, {} ticks, {:.1} % of them in contact",
            self.recording.duration_s(),
            self.recording.records.len(),
            100.0 * self.contact_fraction
        )?;
        self.write_taps(f)?;
        self.write_strokes(f)?;
        writeln!(f, "\nvibration in contact, by estimated speed")?;
        writeln!(
            f,
            "  {:>13} {:>8} {:>10} {:>10} {:>9}",
            "mm/s", "s", "rms m/s²", "peak m/s²", "rms N"
        )?;
        for band in self.bands.iter().filter(|band| band.time_s > 0.0) {
            let name = if band.to_mm_s.is_finite() {
                format!("{:.0} to {:.0}", band.from_mm_s, band.to_mm_s)
            } else {
                format!("above {:.0}", band.from_mm_s)
            };
            writeln!(
                f,
                "  {name:>13} {:>8.2} {:>10.3} {:>10.3} {:>9.4}",
                band.time_s,
                band.rms_m_s2,
                band.peak_m_s2,
                band.rms_m_s2 * texture.vib_n_per_m_s2
            )?;
        }
        let [mean_n, p5, p50, p95, max] = self.normal_n;
        writeln!(f, "\nforces")?;
        writeln!(
            f,
            "  normal     mean {mean_n:.3} N, 5/50/95 % quantiles {p5:.3} / {p50:.3} / {p95:.3} N, max {max:.3} N"
        )?;
        writeln!(
            f,
            "  friction   mean {:.3} N while sliding, against a mean μ·F_n of {:.3} N",
            self.friction_n, self.coulomb_n
        )?;
        writeln!(
            f,
            "  total      peak {:.3} N of {:.3} N, slew {:.0} N/s of {:.0} N/s, rms {:.3} N (continuous limit {:.2} N)",
            self.peak_n,
            device.actuator.peak_force_n,
            self.slew_n_s,
            self.recording.slew_limit_n_s,
            self.device_rms_n,
            device.actuator.continuous_force_n
        )?;
        writeln!(
            f,
            "  limiter    {} at the peak limit, {} at the slew limit; vibration clamped in {}",
            counted(counters.peak_limited, "tick", "ticks"),
            counters.slew_limited,
            counted(self.vib_clamped, "tick", "ticks")
        )?;
        writeln!(
            f,
            "  grid       {} in contact outside it",
            counted(self.outside_grid, "tick", "ticks")
        )?;
        writeln!(
            f,
            "\nfaults     {} (bad samples {}, missed ticks {}, ticks in the safe state {})",
            counters.faults, counters.bad_samples, counters.missed_ticks, self.safe_ticks
        )?;
        writeln!(
            f,
            "device     {} clipped, {} not finite, {} at a workspace stop",
            counted(device_counts.clipped, "command", "commands"),
            device_counts.not_finite,
            counted(device_counts.at_stop, "tick", "ticks")
        )?;
        writeln!(f, "\ncaveats")?;
        for caveat in self.caveats() {
            writeln!(f, "  {caveat}")?;
        }
        Ok(())
    }
}

impl Summary<'_> {
    fn write_taps(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let played = self
            .taps
            .scripted
            .iter()
            .filter(|tap| tap.delay_s.is_some())
            .count();
        writeln!(
            f,
            "\ntaps       {} scripted, {played} rendered, {} unscripted",
            self.taps.scripted.len(),
            self.taps.others_s.len()
        )?;
        if self.taps.scripted.is_empty() {
            return Ok(());
        }
        writeln!(
            f,
            "  {:>8} {:>14} {:>10} {:>10} {:>8}",
            "t s", "scripted mm/s", "true mm/s", "delay ms", "peak N"
        )?;
        for tap in &self.taps.scripted {
            let or_dash = |value: Option<f64>, digits: usize| {
                value.map_or_else(|| "-".to_owned(), |v| format!("{v:.digits$}"))
            };
            writeln!(
                f,
                "  {:>8} {:>14.1} {:>10.1} {:>10} {:>8.3}",
                or_dash(tap.impact_s, 3),
                tap.scripted_m_s * 1e3,
                tap.true_m_s * 1e3,
                or_dash(tap.delay_s.map(|s| s * 1e3), 2),
                tap.peak_n
            )?;
        }
        Ok(())
    }

    fn write_strokes(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "\nstrokes    {}, measured over their steady parts",
            self.strokes.len()
        )?;
        if self.strokes.is_empty() {
            return Ok(());
        }
        writeln!(
            f,
            "  {:>8} {:>14} {:>10} {:>15} {:>9} {:>9} {:>11} {:>13}",
            "t s",
            "scripted mm/s",
            "true mm/s",
            "estimated mm/s",
            "wanted N",
            "normal N",
            "friction N",
            "vib rms m/s²"
        )?;
        for stroke in &self.strokes {
            writeln!(
                f,
                "  {:>8.3} {:>14.1} {:>10.1} {:>15.1} {:>9.3} {:>9.3} {:>11.3} {:>13.3}",
                stroke.steady_s.0,
                stroke.scripted_mm_s,
                stroke.true_mm_s,
                stroke.estimated_mm_s,
                stroke.wanted_n,
                stroke.normal_n,
                stroke.friction_n,
                stroke.vib_m_s2
            )?;
        }
        Ok(())
    }
}
