//! Every tick of a servo loop as a row of CSV.
//!
//! | column | unit | what |
//! |---|---|---|
//! | `period` | – | period since the loop began |
//! | `t_s` | s | when the tick was due, after the first |
//! | `missed` | – | periods missed just before |
//! | `x_mm`, `y_mm`, `z_mm` | mm | position that the device told; empty where it told none |
//! | `elapsed_ticks` | – | of the runtime's sample; 0 if it was stale |
//! | `depth_mm`, `speed_mm_s` | mm, mm/s | as the runtime sees them |
//! | `normal_force_n`, `vib_m_s2`, `tap_n`, `friction_n` | N, m/s² | parts of the force |
//! | `fx_n`, `fy_n`, `fz_n` | N | the force |
//! | `flags` | – | the runtime's flags as a number |
//! | `wakeup_us`, `read_us`, `compute_us`, `write_us` | µs | what each stage took |
//! | `fault` | – | what the device failed with |

use asperity_host::servo::{Record, Stage};
use std::io::{self, Write};

/// Names of the columns, in order.
pub const COLUMNS: [&str; 21] = [
    "period",
    "t_s",
    "missed",
    "x_mm",
    "y_mm",
    "z_mm",
    "elapsed_ticks",
    "depth_mm",
    "speed_mm_s",
    "normal_force_n",
    "vib_m_s2",
    "tap_n",
    "friction_n",
    "fx_n",
    "fy_n",
    "fz_n",
    "flags",
    "wakeup_us",
    "read_us",
    "compute_us",
    "write_us",
];

/// Writes records as rows.
#[derive(Debug)]
pub struct Trace {
    first_due_ns: Option<u64>,
    rows: u64,
}

impl Trace {
    /// Begins with the names of the columns.
    ///
    /// # Errors
    /// [`io::Error`].
    pub fn begin(out: &mut impl Write) -> io::Result<Self> {
        writeln!(out, "{},fault", COLUMNS.join(","))?;
        Ok(Self {
            first_due_ns: None,
            rows: 0,
        })
    }

    /// Writes a row.
    ///
    /// # Errors
    /// [`io::Error`].
    pub fn row(&mut self, record: &Record, out: &mut impl Write) -> io::Result<()> {
        let times = &record.times;
        let first_ns = *self.first_due_ns.get_or_insert(times.due_ns);
        let t_s = 1e-9 * times.due_ns.saturating_sub(first_ns) as f64;
        write!(out, "{},{t_s:.6},{}", record.period, record.missed)?;
        match record.reading {
            Ok(reading) => {
                for x_m in reading.position_m {
                    write!(out, ",{}", 1e3 * f64::from(x_m))?;
                }
            }
            Err(_) => out.write_all(b",,,")?,
        }
        let output = &record.output;
        write!(
            out,
            ",{},{},{},{},{},{},{}",
            record.sample.elapsed_ticks,
            1e3 * f64::from(output.depth_m),
            output.speed_mm_s,
            output.normal_force_n,
            output.vib_m_s2,
            output.tap_n,
            output.friction_n
        )?;
        let [x, y, z] = output.force_n;
        write!(out, ",{x},{y},{z},{}", output.flags.bits())?;
        for stage in Stage::PARTS {
            write!(out, ",{:.3}", 1e-3 * times.of(stage).unwrap_or(0) as f64)?;
        }
        let fault = record.reading.err().or(record.written.err());
        match fault {
            Some(fault) => writeln!(out, ",\"{fault}\"")?,
            None => writeln!(out, ",")?,
        }
        self.rows += 1;
        Ok(())
    }

    /// Rows so far.
    #[must_use]
    pub fn rows(&self) -> u64 {
        self.rows
    }
}
