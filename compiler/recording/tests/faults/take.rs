//! Recordings of a hand that strokes, in the layouts and dialects of files that people have.

use super::hand::Hand;
use std::{fmt::Write as _, fs, path::Path};

pub(super) const GRAVITY_M_S2: f64 = 9.806_65;

/// Seeded numbers (SplitMix64).
pub(super) struct Random(pub(super) u64);

impl Random {
    /// In 0..1.
    pub(super) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(super) fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    pub(super) fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    pub(super) fn pick<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())]
    }

    /// Noise of variance 1.
    pub(super) fn noise(&mut self) -> f64 {
        let sum: f64 = (0..6).map(|_| self.unit()).sum();
        (sum - 3.0) * std::f64::consts::SQRT_2
    }
}

/// Distribution of quantities over files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Layout {
    /// `log.csv`.
    Single,
    /// `accel.csv`, `force.csv`, `position.csv`.
    Several,
    /// `accel.wav`, `touch.csv`.
    Wav,
    /// `accel.csv`, `force.npy`, `position.csv`.
    Npy,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Format {
    Csv,
    /// Bits, and whether they are floats.
    Wav(u16, bool),
    Npy,
}

/// Naming style of CSV columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Style {
    /// `t`, `ax`.
    Plain,
    /// `"Time (s)"`, `"Acceleration x (m/s^2)"`.
    Brackets,
    /// `t_ms`, `ax_g`.
    Suffix,
}

/// A channel: SI values, and the form in which they are written and described.
#[derive(Debug, Clone)]
pub(super) struct Column {
    pub(super) quantity: &'static str,
    pub(super) axis: &'static str,
    pub(super) unit: &'static str,
    /// Written numbers in one SI unit.
    pub(super) written: f64,
    pub(super) values: Vec<f64>,
}

impl Column {
    pub(super) fn label(&self) -> String {
        format!("{} {}", self.quantity, self.axis)
    }

    fn name(&self, style: Style) -> String {
        let letter = match self.quantity {
            "acceleration" => "a",
            "force" => "f",
            _ if style == Style::Plain => "",
            _ => "p",
        };
        match style {
            Style::Plain => format!("{letter}{}", self.axis),
            Style::Brackets => format!("\"{} {} ({})\"", self.quantity, self.axis, self.unit),
            Style::Suffix => format!("{letter}{}_{}", self.axis, self.unit.replace("/s^2", "_s2")),
        }
    }
}

/// A file of a recording.
#[derive(Debug, Clone)]
pub(super) struct File {
    pub(super) name: &'static str,
    pub(super) format: Format,
    pub(super) rate_hz: f64,
    /// The time that each row is stamped with, s.
    pub(super) stamps: Vec<f64>,
    /// The unit of the clock in the description, and stamps written for one second.
    pub(super) clock_unit: &'static str,
    pub(super) clock_written: f64,
    /// True if the description names the clock.
    pub(super) uses_clock: bool,
    pub(super) stated_hz: Option<f64>,
    /// Added to the time of a file without a clock, s.
    pub(super) start_s: f64,
    pub(super) columns: Vec<Column>,
    pub(super) style: Style,
    pub(super) delimiter: char,
    /// Text before the header, with what stands before its first name.
    pub(super) before: String,
    pub(super) has_label: bool,
    pub(super) has_units: bool,
    pub(super) decimal_comma: bool,
    /// A chunk of odd length before the values of a WAV.
    pub(super) has_chunk: bool,
    /// Formats a stamp.
    pub(super) stamp: fn(f64) -> String,
}

/// A change to a folder.
type Change = Box<dyn FnOnce(&Path)>;

/// A recording.
pub(super) struct Take {
    pub(super) layout: Layout,
    pub(super) files: Vec<File>,
    /// Changes to the folder once it is written.
    pub(super) after: Vec<Change>,
}

impl Take {
    pub(super) fn file(&mut self, quantity: &str) -> &mut File {
        let mut all = self.files.iter_mut();
        all.find(|file| file.columns.iter().any(|c| c.quantity == quantity))
            .expect("every quantity is recorded")
    }

    pub(super) fn column(&mut self, quantity: &str, axis: &str) -> &mut Column {
        let mut all = self.files.iter_mut().flat_map(|file| &mut file.columns);
        all.find(|c| c.quantity == quantity && c.axis == axis)
            .expect("every axis is recorded")
    }

    /// Writes the files and their description.
    pub(super) fn write(self, folder: &Path) {
        let mut toml = "name = \"oak\"\n[tool]\nmass_kg = 0.05\n".to_owned();
        for file in &self.files {
            file.describe(&mut toml);
            let bytes = match file.format {
                Format::Csv => file.csv().into_bytes(),
                Format::Wav(bits, float) => file.wav(bits, float),
                Format::Npy => file.npy(),
            };
            fs::write(folder.join(file.name), bytes).expect("written");
        }
        fs::write(folder.join("recording.toml"), toml).expect("written");
        for after in self.after {
            after(folder);
        }
    }
}

impl File {
    pub(super) fn clock_name(&self) -> String {
        match self.style {
            Style::Plain => "t".into(),
            Style::Brackets => format!("\"Time ({})\"", self.clock_unit),
            Style::Suffix => format!("t_{}", self.clock_unit),
        }
    }

    fn describe(&self, toml: &mut String) {
        let _ = writeln!(toml, "[[file]]\npath = {:?}", self.name);
        let is_csv = self.format == Format::Csv;
        if is_csv && self.uses_clock {
            let name = self.clock_name().replace('"', "");
            let _ = writeln!(toml, "clock = {name:?}\nclock_unit = {:?}", self.clock_unit);
        }
        let needs_rate = self.format == Format::Npy || is_csv && !self.uses_clock;
        if let Some(rate_hz) = self.stated_hz.or(needs_rate.then_some(self.rate_hz)) {
            let _ = writeln!(toml, "rate_hz = {rate_hz}");
        }
        if !is_csv {
            let _ = writeln!(toml, "start_s = {}", self.start_s + self.stamps[0]);
        }
        for (index, column) in self.columns.iter().enumerate() {
            let name = column.name(self.style).replace('"', "");
            let which = if is_csv {
                format!("{name:?}")
            } else {
                index.to_string()
            };
            let _ = writeln!(
                toml,
                "[[file.channel]]\ncolumn = {which}\nquantity = {:?}\naxis = {:?}\nunit = {:?}",
                column.quantity, column.axis, column.unit
            );
            if matches!(self.format, Format::Wav(_, false)) {
                let _ = writeln!(toml, "scale = {FULL_SCALE}");
            }
        }
    }

    fn csv(&self) -> String {
        let delimiter = self.delimiter.to_string();
        let mut names = vec![self.clock_name()];
        names.extend(self.columns.iter().map(|column| column.name(self.style)));
        names.extend(self.has_label.then(|| "label".to_owned()));
        let mut text = format!("{}{}\n", self.before, names.join(&delimiter));
        if self.has_units {
            let units = names.iter().map(|_| "(s)").collect::<Vec<_>>();
            text += &(units.join(&delimiter) + "\n");
        }
        let head = text.len();
        for (row, stamp) in self.stamps.iter().enumerate() {
            text += &(self.stamp)(stamp * self.clock_written);
            for column in &self.columns {
                let value = column.values[row] * column.written;
                text.push(self.delimiter);
                if value.is_finite() {
                    let _ = write!(text, "{value:.5}");
                }
            }
            if self.has_label {
                let _ = write!(text, "{}stroke {}", self.delimiter, row / 500);
            }
            text.push('\n');
        }
        if self.decimal_comma {
            let rows = text.split_off(head);
            text += &rows.replace('.', ",");
        }
        text
    }

    fn wav(&self, bits: u16, float: bool) -> Vec<u8> {
        let bytes = bits / 8;
        let align = bytes * self.columns.len() as u16;
        let mut data = Vec::new();
        for row in 0..self.stamps.len() {
            for column in &self.columns {
                let value = column.values[row] * column.written;
                match (bits, float) {
                    (64, true) => data.extend(value.to_le_bytes()),
                    (_, true) => data.extend((value as f32).to_le_bytes()),
                    _ => {
                        let full = f64::from(1_u32 << (bits - 1));
                        let number = (value / FULL_SCALE * full).round().clamp(-full, full - 1.0);
                        data.extend(&(number as i32).to_le_bytes()[..usize::from(bytes)]);
                    }
                }
            }
        }
        let mut format = vec![if float { 3 } else { 1 }, 0];
        format.extend((self.columns.len() as u16).to_le_bytes());
        format.extend((self.rate_hz as u32).to_le_bytes());
        format.extend((self.rate_hz as u32 * u32::from(align)).to_le_bytes());
        format.extend(align.to_le_bytes());
        format.extend(bits.to_le_bytes());
        let mut chunks = vec![(b"fmt ", format), (b"data", data)];
        if self.has_chunk {
            chunks.insert(1, (b"LIST", b"INFO by".to_vec()));
        }
        let mut body = b"WAVE".to_vec();
        for (id, chunk) in chunks {
            body.extend(id);
            body.extend((chunk.len() as u32).to_le_bytes());
            body.extend(&chunk);
            body.resize(body.len() + chunk.len() % 2, 0);
        }
        [
            b"RIFF".to_vec(),
            (body.len() as u32).to_le_bytes().to_vec(),
            body,
        ]
        .concat()
    }

    fn npy(&self) -> Vec<u8> {
        let shape = format!("({}, {})", self.stamps.len(), self.columns.len());
        let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}");
        let mut bytes = b"\x93NUMPY\x01\x00\x76\x00".to_vec();
        bytes.extend(format!("{header:<117}\n").as_bytes());
        for row in 0..self.stamps.len() {
            let values = self.columns.iter().map(|c| c.values[row] * c.written);
            bytes.extend(values.flat_map(f64::to_le_bytes));
        }
        bytes
    }
}

/// m/s² of full scale of a WAV of integers.
const FULL_SCALE: f64 = 160.0;

/// A clean recording of some seconds in a layout.
pub(super) fn clean(random: &mut Random, layout: Layout, seconds: f64) -> Take {
    let hand = Hand::new(random, seconds);
    let style = random.pick(&[Style::Plain, Style::Brackets, Style::Suffix]);
    let delimiter = random.pick(&[',', ',', ';', '\t']);
    let in_g = random.below(2) == 0;
    let names: &[(&'static str, &[usize])] = match layout {
        Layout::Single => &[("log.csv", &[0, 1, 2])],
        Layout::Several => &[
            ("accel.csv", &[0]),
            ("force.csv", &[1]),
            ("position.csv", &[2]),
        ],
        Layout::Wav => &[("accel.wav", &[0]), ("touch.csv", &[1, 2])],
        Layout::Npy => &[
            ("accel.csv", &[0]),
            ("force.npy", &[1]),
            ("position.csv", &[2]),
        ],
    };
    // Steps of the converters, and noise: an accelerometer of 12 to 16 bits and ±16 g.
    let steps = [
        random.pick(&[0.0, 0.0049, 0.038]),
        random.pick(&[0.0, 0.0012, 0.005]),
        1e-6,
    ];
    let noises = [random.within(0.01, 0.04), random.within(0.001, 0.004), 2e-6];
    let bias: [f64; 3] = [0; 3].map(|_| random.within(-0.04, 0.04));
    let files = names.iter().map(|&(name, kinds)| {
        let rate_hz = random.pick(&[800.0, 1000.0, 1000.0, 1600.0]);
        let stamps: Vec<f64> = (0..(seconds * rate_hz) as usize)
            .map(|n| n as f64 / rate_hz)
            .collect();
        let felt: Vec<[[f64; 3]; 3]> = stamps.iter().map(|t| hand.feel(*t)).collect();
        let format = match (name.ends_with("wav"), name.ends_with("npy")) {
            (true, _) => {
                let (bits, float) =
                    random.pick(&[(16, false), (24, false), (32, true), (64, true)]);
                Format::Wav(bits, float)
            }
            (_, true) => Format::Npy,
            _ => Format::Csv,
        };
        let mut columns = Vec::new();
        for &kind in kinds {
            for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
                let mut value = |row: &[[f64; 3]; 3]| {
                    let offset = if kind == 1 { bias[k] } else { 0.0 };
                    let value = row[kind][k] + offset + noises[kind] * random.noise();
                    if steps[kind] > 0.0 {
                        (value / steps[kind]).round() * steps[kind]
                    } else {
                        value
                    }
                };
                let values: Vec<f64> = felt.iter().map(&mut value).collect();
                let is_int = matches!(format, Format::Wav(_, false));
                let (quantity, unit, written) = match kind {
                    0 if in_g && !is_int => ("acceleration", "g", 1.0 / GRAVITY_M_S2),
                    0 => ("acceleration", "m/s^2", 1.0),
                    1 => ("force", "N", 1.0),
                    _ => ("position", "mm", 1e3),
                };
                columns.push(Column {
                    quantity,
                    axis,
                    unit,
                    written,
                    values,
                });
            }
        }
        let (clock_unit, clock_written) = random.pick(&[("s", 1.0), ("ms", 1e3), ("us", 1e6)]);
        File {
            name,
            format,
            rate_hz,
            stamps,
            clock_unit,
            clock_written,
            uses_clock: true,
            stated_hz: None,
            start_s: 0.0,
            columns,
            style,
            delimiter,
            before: String::new(),
            has_label: false,
            has_units: false,
            decimal_comma: false,
            has_chunk: false,
            stamp: |stamp| format!("{stamp:.6}"),
        }
    });
    Take {
        layout,
        files: files.collect(),
        after: Vec::new(),
    }
}
