//! A recording as CSV, one row for each tick.
//!
//! | column | unit | what |
//! |---|---|---|
//! | `tick`, `t_s` | –, s | index and virtual time of the tick's start |
//! | `motion` | – | name of the script's motion |
//! | `x_mm`, `y_mm`, `z_mm` | mm | true position |
//! | `vx_mm_s`, `vy_mm_s`, `vz_mm_s` | mm/s | true velocity |
//! | `measured_x_mm`, `measured_y_mm`, `measured_z_mm` | mm | position that the servo is given |
//! | `depth_mm`, `speed_mm_s` | mm, mm/s | depth and tangential speed as the renderer sees them |
//! | `normal_force_n` | N | k·δ |
//! | `vib_m_s2` | m/s² | y\[n\] before device gain |
//! | `tap_n`, `friction_n` | N | tap force along the normal, magnitude of friction |
//! | `fx_n`, `fy_n`, `fz_n` | N | the renderer's force |
//! | `device_x_n`, `device_y_n`, `device_z_n` | N | what the device holds: limited, rounded, delayed |
//! | `wanted_n` | N | normal force that the hand means to hold; empty in the air |
//! | `flags` | – | the renderer's flags as a number |
//!
//! Numbers are printed so that they read back to the same bits.

use super::error::FeelError;
use super::recording::Recording;

/// Names of the columns, in order.
pub const COLUMNS: [&str; 26] = [
    "tick",
    "t_s",
    "motion",
    "x_mm",
    "y_mm",
    "z_mm",
    "vx_mm_s",
    "vy_mm_s",
    "vz_mm_s",
    "measured_x_mm",
    "measured_y_mm",
    "measured_z_mm",
    "depth_mm",
    "speed_mm_s",
    "normal_force_n",
    "vib_m_s2",
    "tap_n",
    "friction_n",
    "fx_n",
    "fy_n",
    "fz_n",
    "device_x_n",
    "device_y_n",
    "device_z_n",
    "wanted_n",
    "flags",
];

/// The recording as CSV.
///
/// # Errors
/// [`FeelError::Csv`] if the encoder fails.
pub fn encode(recording: &Recording) -> Result<Vec<u8>, FeelError> {
    let mut writer = ::csv::Writer::from_writer(Vec::new());
    writer.write_record(COLUMNS)?;
    let mut row: Vec<String> = Vec::with_capacity(COLUMNS.len());
    for (tick, record) in recording.records.iter().enumerate() {
        let motion = recording
            .motions
            .get(record.intent.motion)
            .map_or("", |m| m.name());
        let output = &record.output;
        row.clear();
        row.push(tick.to_string());
        row.push(record.t_s.to_string());
        row.push(motion.to_owned());
        for vector_m in [record.true_m, record.true_m_s, record.measured_m] {
            row.extend(vector_m.map(|v| (v * 1e3).to_string()));
        }
        row.push((output.depth_m * 1e3).to_string());
        for value in [
            output.speed_mm_s,
            output.normal_force_n,
            output.vib_m_s2,
            output.tap_n,
            output.friction_n,
        ] {
            row.push(value.to_string());
        }
        row.extend(output.force_n.map(|v| v.to_string()));
        row.extend(record.device_n.map(|v| v.to_string()));
        row.push(
            record
                .intent
                .wanted_n
                .map(|v| v.to_string())
                .unwrap_or_default(),
        );
        row.push(output.flags.bits().to_string());
        writer.write_record(&row)?;
    }
    writer
        .into_inner()
        .map_err(|error| ::csv::Error::from(error.into_error()).into())
}
