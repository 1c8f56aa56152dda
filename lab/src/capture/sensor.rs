//! Sensors by name: `serial:/dev/ttyACM0?baud=115200`, `wav:accel.wav?g=16`, `sim:?seed=1`.

use super::columns::Layout;
use super::error::SensorError;
use super::reader::Reader;
use super::source::{LineSource, Sent};
use super::wav::{Full, Wav};
use std::io;
use std::path::Path;
use std::str::FromStr;
use std::sync::mpsc::Receiver;

/// Where a sensor is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SensorKind {
    /// Lines on a serial port or a pipe.
    Serial,
    /// A WAV file that another program is writing.
    Wav,
    /// A simulated accelerometer on a simulated device.
    Simulated,
}

/// A named sensor.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensor {
    /// As it was given.
    pub name: String,
    /// Where it is.
    pub kind: SensorKind,
    /// Port or file.
    pub which: String,
    /// Bits a second of a serial line.
    pub baud: u32,
    /// Columns, if they were given.
    pub columns: Option<Layout>,
    /// Full scale of a WAV, and the limits of the sensor that the recording states: accelerations in
    /// the unit of their channels.
    pub full_acceleration: Option<f64>,
    /// The same of forces.
    pub full_force: Option<f64>,
    /// Time by which the sensor is known to be late, s.
    pub delay_s: f64,
    /// Seed of a simulated sensor's noise.
    pub seed: u64,
}

/// Usual rate of a serial line, bits a second.
const BAUD: u32 = 115_200;

impl FromStr for Sensor {
    type Err = SensorError;

    fn from_str(name: &str) -> Result<Self, SensorError> {
        let fail = |why: &str| SensorError::Name {
            name: name.chars().take(200).collect(),
            why: why.into(),
        };
        let (scheme, rest) = name
            .split_once(':')
            .ok_or_else(|| fail("it names no kind of sensor"))?;
        let (which, settings) = rest.split_once('?').unwrap_or((rest, ""));
        let (kind, known): (_, &[&str]) = match scheme {
            "serial" => (
                SensorKind::Serial,
                &["baud", "columns", "delay_ms", "g", "n"],
            ),
            "wav" => (SensorKind::Wav, &["columns", "delay_ms", "g", "n"]),
            "sim" => (SensorKind::Simulated, &["seed"]),
            _ => {
                return Err(fail(
                    "unknown kind of sensor; known kinds are serial:, wav: and sim:",
                ));
            }
        };
        if (kind == SensorKind::Simulated) != which.is_empty() {
            return Err(fail(match kind {
                SensorKind::Simulated => "sim: has no file",
                _ => "it names no port and no file",
            }));
        }
        let mut sensor = Self {
            name: name.to_owned(),
            kind,
            which: which.to_owned(),
            baud: BAUD,
            columns: None,
            full_acceleration: None,
            full_force: None,
            delay_s: 0.0,
            seed: 1,
        };
        for setting in settings.split('&').filter(|setting| !setting.is_empty()) {
            let (key, value) = setting
                .split_once('=')
                .ok_or_else(|| fail(&format!("`{setting}` is no setting; write key=value")))?;
            if !known.contains(&key) {
                return Err(fail(&format!(
                    "it has {}, and no `{key}`",
                    known.join(", ")
                )));
            }
            let number = |low: f64, high: f64| match value.parse::<f64>() {
                Ok(number) if number >= low && number <= high => Ok(number),
                _ => Err(fail(&format!("{key} must be {low} to {high}"))),
            };
            match key {
                "baud" => sensor.baud = number(300.0, 20e6)? as u32,
                "g" => sensor.full_acceleration = Some(number(1e-3, 1e6)?),
                "n" => sensor.full_force = Some(number(1e-3, 1e6)?),
                "delay_ms" => sensor.delay_s = 1e-3 * number(-1000.0, 1000.0)?,
                "seed" => {
                    let seed = value.parse();
                    sensor.seed = seed.map_err(|_| fail("seed must be a whole number"))?;
                }
                _ => {
                    let layout = Layout::parse(value);
                    sensor.columns =
                        Some(layout.map_err(|why| fail(&format!("columns: it {why}")))?);
                }
            }
        }
        if kind == SensorKind::Wav && sensor.full_acceleration.is_none() {
            return Err(fail("g is missing: what full scale is, such as g=16"));
        }
        let has_force =
            |layout: &Layout| layout.has(asperity_recording::description::Quantity::Force);
        if kind == SensorKind::Wav
            && sensor.full_force.is_none()
            && sensor.columns.as_ref().is_some_and(has_force)
        {
            return Err(fail("n is missing: the force of full scale, such as n=20"));
        }
        Ok(sensor)
    }
}

impl Sensor {
    /// Opens it, and begins to read. Lines of a simulated sensor come from `sent`.
    ///
    /// # Errors
    /// [`SensorError`] for a port that cannot be opened.
    pub fn open(&self, sent: Receiver<Vec<u8>>) -> Result<Reader, SensorError> {
        let reader = match self.kind {
            SensorKind::Simulated => {
                Reader::start(LineSource::new("sim:", Sent { from: sent }, None))
            }
            SensorKind::Wav => {
                let full = Full {
                    acceleration: self.full_acceleration.unwrap_or(1.0),
                    force: self.full_force.unwrap_or(1.0),
                };
                Reader::start(Wav::follow(
                    Path::new(&self.which),
                    self.columns.clone(),
                    full,
                ))
            }
            SensorKind::Serial => self.serial()?,
        };
        reader.map_err(|cause| self.not_opened(cause))
    }

    #[cfg(unix)]
    fn serial(&self) -> Result<io::Result<Reader>, SensorError> {
        let port = super::serial::Serial::open(&self.which, self.baud)?;
        let source = LineSource::new(&self.which, port, self.columns.clone());
        Ok(Reader::start(source))
    }

    #[cfg(not(unix))]
    fn serial(&self) -> Result<io::Result<Reader>, SensorError> {
        let why = "serial ports are read on Linux and macOS alone; follow a WAV here";
        Err(self.not_opened(io::Error::other(why)))
    }

    fn not_opened(&self, cause: io::Error) -> SensorError {
        SensorError::Open {
            name: self.which.clone(),
            cause,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_says_where_a_sensor_is_and_what_it_sends() {
        let sensor: Sensor = "serial:/dev/ttyACM0?baud=921600&columns=t_us,az_g&delay_ms=1.5"
            .parse()
            .expect("a sensor");
        assert_eq!((sensor.kind, sensor.baud), (SensorKind::Serial, 921_600));
        assert_eq!(sensor.which, "/dev/ttyACM0");
        assert!((sensor.delay_s - 0.0015).abs() < 1e-12 && sensor.columns.is_some());
    }

    #[test]
    fn a_name_that_is_wrong_is_told_with_what_would_be_right() {
        for (name, part) in [
            ("accel", "no kind"),
            ("usb:1", "known kinds are"),
            ("serial:", "no port"),
            ("sim:x", "no file"),
            ("wav:a.wav", "g is missing"),
            ("wav:a.wav?g=16&columns=ax,fz", "n is missing"),
            ("wav:a.wav?g=nan", "must be"),
            ("wav:a.wav?baud=9600", "no `baud`"),
            ("serial:p?columns=", "column"),
            ("serial:p?baud", "key=value"),
        ] {
            let error = name.parse::<Sensor>().expect_err(name).to_string();
            assert!(error.contains(part), "{name}: {error}");
        }
    }
}
