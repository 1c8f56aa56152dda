//! A recording as a table.

use std::io::{self, Write};

use super::SessionLog;

/// Names of the columns.
pub const COLUMNS: &str = "tick,t_s,elapsed_ticks,x_m,y_m,z_m,fx_n,fy_n,fz_n,buttons,flags,texture,read_fault,write_fault,lost_before";

/// Writes every tick as a row. Floats read back to the same bits; `t_s` counts lost ticks as
/// passed. Faults are in words, empty where there is none. `texture` counts from 0.
///
/// # Errors
/// What the system says.
pub fn write(recording: &SessionLog, to: &mut impl Write) -> io::Result<()> {
    writeln!(to, "{COLUMNS}")?;
    let rate_hz = f64::from(recording.conditions.config.servo_rate_hz);
    let (mut tick, mut texture) = (0_u64, 0_u64);
    for entry in &recording.entries {
        tick += u64::from(entry.lost_before);
        texture += u64::from(entry.next_texture);
        let [x, y, z] = entry.sample.position_m;
        let [fx, fy, fz] = entry.force_n;
        let words = |fault: Option<crate::device::DeviceError>| {
            fault.map(|fault| fault.to_string()).unwrap_or_default()
        };
        writeln!(
            to,
            "{tick},{},{},{x},{y},{z},{fx},{fy},{fz},{},{},{texture},{},{},{}",
            tick as f64 / rate_hz,
            entry.sample.elapsed_ticks,
            entry.buttons,
            entry.flags,
            words(entry.read_fault),
            words(entry.write_fault),
            entry.lost_before,
        )?;
        tick += 1;
    }
    Ok(())
}
