//! A description to start from, by the headers of the files in a folder and by their first rows.
//!
//! What a header says is taken. What it does not say is not made up: a column of an unknown quantity, or a
//! rate that is nowhere, becomes a comment that says what to write.

use super::{
    column_name::{Meaning, meaning},
    quantity::{GRAVITY_M_S2, Quantity, Unit},
    schema::Axis,
};
use crate::{
    error::RecordingError,
    reader::{self, Header, clock_period, rows},
    signal::quantile::mean,
};
use std::{fmt::Write as _, path::Path};

/// Units of a clock, and the seconds in one.
pub(crate) const TIME_UNITS: [(&str, f64); 4] =
    [("s", 1.0), ("ms", 1e-3), ("us", 1e-6), ("ns", 1e-9)];
/// Most files that are looked at.
const MAX_FILES: usize = 32;
/// Rows that tell the unit of a clock, and of an acceleration.
const ROWS: usize = 4000;
/// How far the mean acceleration may be from gravity to tell its unit.
const GRAVITY_TOLERANCE: f64 = 1.15;
/// The middle of the rates of sensors, Hz.
const USUAL_HZ: f64 = 1000.0;
/// What Klipper writes: mm/s², without saying so.
const KLIPPER: [&str; 4] = ["time", "accel_x", "accel_y", "accel_z"];

/// A `recording.toml` that fits the headers of the folder's files; `None` where there is no file of
/// a known kind.
///
/// # Errors
/// [`RecordingError`] of the first file of a known kind where none can be read.
pub fn propose(folder: &Path) -> Result<Option<String>, RecordingError> {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return Ok(None);
    };
    let mut names: Vec<String> = entries
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter(|name| reader::is_known(Path::new(name)))
        .collect();
    names.sort();
    let name = folder
        .file_name()
        .map_or("texture".into(), |name| name.to_string_lossy().into_owned());
    let mut text = format!(
        "name = {name:?}\n\n[tool]\n# mass_kg = 0.05  # measure it: it tells wrong units of the force\n"
    );
    let (mut any, mut fault) = (false, None);
    for file in names.into_iter().take(MAX_FILES) {
        let path = folder.join(&file);
        match reader::header(&path) {
            Ok(header) => {
                any = true;
                entry(&mut text, &path, &file, &header);
            }
            Err(error) => {
                // Writing to a string cannot fail.
                let _ = writeln!(text, "\n# {file:?} is left out: {}", error.problem);
                fault.get_or_insert(error);
            }
        }
    }
    match fault {
        Some(fault) if !any => Err(fault),
        _ => Ok(any.then_some(text)),
    }
}

/// A column that a description can name.
struct Proposed<'a> {
    name: &'a str,
    index: usize,
    quantity: Quantity,
    axis: Axis,
    unit: Option<Unit>,
}

fn entry(text: &mut String, path: &Path, file: &str, header: &Header) {
    let (channels, unknown) = channels(file, header);
    if channels.is_empty() {
        let columns = header.columns.join(", ");
        let _ = writeln!(
            text,
            "\n# {file:?} is left out: no name of its columns ({columns}) says what it measures"
        );
        return;
    }
    let accelerated = by_gravity(path, header, &channels);
    let _ = writeln!(text, "\n[[file]]\npath = {file:?}");
    match (clock(path, header), header.rate_hz) {
        (Some((name, unit, guessed)), _) => {
            let why = if guessed {
                "  # by its steps; the header names no unit"
            } else {
                ""
            };
            let _ = writeln!(text, "clock = {name:?}\nclock_unit = {unit:?}{why}");
        }
        (None, Some(rate_hz)) => {
            let _ = writeln!(text, "rate_hz = {rate_hz}");
        }
        (None, None) => {
            let _ = writeln!(
                text,
                "# rate_hz =   # rows a second: the file does not say it, so give it"
            );
        }
    }
    for name in unknown {
        let _ = writeln!(
            text,
            "# column {name:?} is left out: its name says no quantity"
        );
    }
    for channel in &channels {
        let column = if header.named {
            format!("{:?}", channel.name)
        } else {
            channel.index.to_string()
        };
        let (unit, why) = match (channel.unit, accelerated, channel.quantity) {
            (Some(unit), ..) => (unit.name, ""),
            (None, Some(unit), Quantity::Acceleration) => {
                (unit, "  # by gravity; the header names no unit")
            }
            (None, _, quantity) => (usual(quantity), "  # a guess: the header names no unit"),
        };
        let place = if header.named {
            ""
        } else {
            "  # a guess: the file names no channels"
        };
        let _ = writeln!(
            text,
            "[[file.channel]]\ncolumn = {column}\nquantity = \"{}\"\naxis = \"{}\"{place}\nunit = \"{unit}\"{why}",
            channel.quantity, channel.axis
        );
        if header.full_scale {
            let _ = writeln!(text, "scale = 1.0  # {unit} of full scale: look it up");
        }
    }
}

/// The columns that measure something, and the names of the others.
fn channels<'a>(file: &str, header: &'a Header) -> (Vec<Proposed<'a>>, Vec<&'a str>) {
    let of_file = of_file(file, header);
    let mut channels: Vec<Proposed<'a>> = Vec::new();
    let mut unknown = Vec::new();
    let meanings: Vec<Meaning> = header.columns.iter().map(|name| meaning(name)).collect();
    // Beside accelerations and forces that are named, x, y and z are a position.
    let beside = meanings
        .iter()
        .any(|meaning| matches!(meaning, Meaning::Channel { .. }))
        .then_some(Quantity::Position);
    let klipper = header.columns == KLIPPER;
    for (index, (name, meaning)) in header.columns.iter().zip(&meanings).enumerate() {
        let found = match *meaning {
            Meaning::Clock(_) => continue,
            Meaning::Channel {
                quantity,
                axis,
                unit,
            } => Some((quantity, axis, unit)),
            Meaning::Bare(axis) => of_file.or(beside).map(|quantity| (quantity, axis, None)),
            Meaning::Unknown if !header.named => {
                let axis = match (header.columns.len(), index) {
                    (2.., 0) => Axis::X,
                    (2.., 1) => Axis::Y,
                    (3, 2) => Axis::Z,
                    _ => Axis::Along,
                };
                of_file
                    .filter(|_| header.columns.len() <= 3)
                    .map(|quantity| (quantity, axis, None))
            }
            Meaning::Unknown => None,
        };
        let is_new = |&(quantity, axis, _): &(Quantity, Axis, Option<Unit>)| {
            channels
                .iter()
                .all(|known| (known.quantity, known.axis) != (quantity, axis))
        };
        match found.filter(is_new) {
            Some((quantity, axis, unit)) => channels.push(Proposed {
                name,
                index,
                quantity,
                axis,
                unit: if klipper { Unit::any("mm/s^2") } else { unit },
            }),
            None => unknown.push(name.as_str()),
        }
    }
    (channels, unknown)
}

/// What a file measures by its own name. A WAV without one is an accelerometer's.
fn of_file(file: &str, header: &Header) -> Option<Quantity> {
    let stem = file
        .rsplit_once('.')
        .map_or(file, |(stem, _)| stem)
        .to_lowercase();
    let has = |words: &[&str]| words.iter().any(|word| stem.contains(word));
    if has(&["acc", "vibration"]) {
        Some(Quantity::Acceleration)
    } else if has(&["force", "load"]) {
        Some(Quantity::Force)
    } else if has(&["torque"]) {
        Some(Quantity::Torque)
    } else if has(&["pos", "motion", "traject"]) {
        Some(Quantity::Position)
    } else if has(&["speed", "veloc"]) {
        Some(Quantity::Speed)
    } else {
        (!header.named && header.rate_hz.is_some()).then_some(Quantity::Acceleration)
    }
}

fn usual(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Acceleration => "m/s^2",
        other => Unit::si(other),
    }
}

/// The clock's column, its unit, and whether that is a guess. A unit that the header does not name is the
/// one in which the rows come at a usual rate.
fn clock<'a>(path: &Path, header: &'a Header) -> Option<(&'a str, &'static str, bool)> {
    let clocks: Vec<(usize, Option<&'static str>)> = header
        .columns
        .iter()
        .enumerate()
        .filter_map(|(index, name)| match meaning(name) {
            Meaning::Clock(unit) => Some((index, unit)),
            _ => None,
        })
        .collect();
    let period = |index| clock_period(path, index).filter(|period| *period > 0.0);
    if let Some((index, unit)) = clocks
        .iter()
        .find_map(|(index, unit)| Some((*index, (*unit)?)))
        && period(index).is_some()
    {
        return Some((&header.columns[index], unit, false));
    }
    let (index, period) = clocks
        .iter()
        .find_map(|(index, _)| Some((*index, period(*index)?)))?;
    let off = |unit_s: f64| libm::log(1.0 / (period * unit_s) / USUAL_HZ).abs();
    let (unit, _) = TIME_UNITS
        .into_iter()
        .min_by(|(_, one), (_, other)| off(*one).total_cmp(&off(*other)))?;
    Some((&header.columns[index], unit, true))
}

/// The unit in which the mean of an acceleration without a unit is gravity.
fn by_gravity(path: &Path, header: &Header, channels: &[Proposed<'_>]) -> Option<&'static str> {
    let axes: Vec<usize> = channels
        .iter()
        .filter(|channel| channel.quantity == Quantity::Acceleration && channel.unit.is_none())
        .map(|channel| channel.index)
        .collect();
    if axes.len() < 3 || header.full_scale {
        return None;
    }
    let mut columns = vec![Vec::with_capacity(ROWS); axes.len()];
    rows(path, &axes, &mut |_, row| {
        for (column, &axis) in columns.iter_mut().zip(&axes) {
            if row[axis].is_finite() {
                column.push(row[axis]);
            }
        }
        Ok(columns[0].len() < ROWS)
    })
    .ok()?;
    let means = columns.iter().map(|column| mean(column));
    let size = means.map(|x| x * x).sum::<f64>().sqrt();
    let units = [
        ("m/s^2", GRAVITY_M_S2),
        ("g", 1.0),
        ("mg", 1e3),
        ("mm/s^2", 1e3 * GRAVITY_M_S2),
    ];
    let is_near = |gravity: f64| (size / gravity).max(gravity / size) < GRAVITY_TOLERANCE;
    let found = units.into_iter().find(|(_, gravity)| is_near(*gravity));
    found.map(|(unit, _)| unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn proposal(files: &[(&str, &str)]) -> (tempfile::TempDir, String) {
        let folder = tempfile::tempdir().expect("a folder");
        for (name, content) in files {
            std::fs::write(folder.path().join(name), content).expect("written");
        }
        let text = propose(folder.path()).expect("read").expect("a file");
        (folder, text)
    }

    #[test]
    fn a_proposal_can_be_read_again() {
        let (folder, text) = proposal(&[
            ("a.csv", "t_ms,ax_g,ay_g,az_g\n0,0,0,1\n1,0,0,1\n"),
            ("f.csv", "time_s,fz,x_mm\n0,0,1\n0.001,0,1\n"),
        ]);
        std::fs::write(folder.path().join("recording.toml"), &text).expect("written");
        let read = crate::description::read(folder.path()).expect("valid");
        assert_eq!(read.files.len(), 2);
        assert_eq!(read.files[0].channels[2].label(), "acceleration z");
        assert_eq!(read.files[1].channels[1].unit.name, "mm");
        assert_eq!(read.files[0].clock_s, 1e-3);
    }

    #[test]
    fn nothing_is_made_up() {
        let (_, text) = proposal(&[("a.csv", "ax_g,label,x\n0,a,0\n1,b,0\n")]);
        assert!(!text.contains("\nrate_hz"), "{text}");
        assert!(text.contains("# column \"label\" is left out"), "{text}");
        let (_, text) = proposal(&[("a.csv", "x,y,z\n0,0,0\n1,0,0\n")]);
        assert!(text.contains("# \"a.csv\" is left out"), "{text}");
        assert!(!text.contains("position"), "{text}");
        let (_, text) = proposal(&[(
            "log.csv",
            "time,seconds_elapsed,z,y,x\n0,0,0,0,0\n1,1,0,0,0\n",
        )]);
        assert!(!text.contains("position"), "{text}");
    }

    #[test]
    fn a_clock_without_a_unit_has_the_one_of_a_usual_rate() {
        for (step, unit) in [(0.002, "s"), (2.0, "ms"), (312.5, "us"), (2e6, "ns")] {
            let rows: Vec<String> = (0..50)
                .map(|n| format!("{},1\n", step * f64::from(n)))
                .collect();
            let (_, text) = proposal(&[("a.csv", &format!("time,ax_g\n{}", rows.concat()))]);
            assert!(
                text.contains(&format!("clock_unit = {unit:?}  # by")),
                "{step} {text}"
            );
        }
    }

    #[test]
    fn an_acceleration_without_a_unit_has_the_one_in_which_it_shows_gravity() {
        for (gravity, unit) in [
            ("1.01", "g"),
            ("9.79", "m/s^2"),
            ("998", "mg"),
            ("9820", "mm/s^2"),
        ] {
            let table = format!("t_s,ax,ay,az\n0,0,0,{gravity}\n0.001,0,0,{gravity}\n");
            let (_, text) = proposal(&[("a.csv", &table)]);
            assert!(
                text.contains(&format!("unit = {unit:?}  # by gravity")),
                "{text}"
            );
        }
    }

    #[test]
    fn a_wav_of_three_channels_is_taken_for_an_accelerometer_along_x_y_and_z() {
        let folder = tempfile::tempdir().expect("a folder");
        let header = |data: u32| {
            let mut bytes = b"RIFF".to_vec();
            bytes.extend((36 + data).to_le_bytes());
            bytes.extend(b"WAVEfmt \x10\0\0\0\x01\0\x03\0");
            bytes.extend(8000_u32.to_le_bytes());
            bytes.extend(48_000_u32.to_le_bytes());
            bytes.extend(b"\x06\0\x10\0data");
            bytes.extend(data.to_le_bytes());
            bytes
        };
        let file = [header(600), vec![1; 600]].concat();
        std::fs::write(folder.path().join("oak.wav"), file).expect("written");
        let text = propose(folder.path()).expect("read").expect("a file");
        std::fs::write(folder.path().join("recording.toml"), &text).expect("written");
        let read = crate::description::read(folder.path()).expect("valid");
        let labels: Vec<String> = read.files[0].channels.iter().map(|c| c.label()).collect();
        assert_eq!(
            labels,
            ["acceleration x", "acceleration y", "acceleration z"]
        );
        assert_eq!(
            text.matches("# a guess: the file names no channels")
                .count(),
            3
        );
    }

    #[test]
    fn a_file_that_cannot_be_read_is_said_to_be_left_out() {
        let pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:1\nsize 1\n";
        let (_, text) = proposal(&[("a.csv", "t_s,ax_g\n0,1\n1,1\n"), ("b.wav", pointer)]);
        assert!(
            text.contains("# \"b.wav\" is left out: is a Git LFS pointer"),
            "{text}"
        );
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("b.wav"), pointer).expect("written");
        let error = propose(folder.path()).expect_err("nothing to read");
        assert!(error.to_string().contains("pointer"), "{error}");
    }

    #[test]
    fn a_folder_without_sensor_files_has_no_proposal() {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("notes.md"), "hello").expect("written");
        assert!(propose(folder.path()).expect("read").is_none());
    }
}
