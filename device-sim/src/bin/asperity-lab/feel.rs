//! `asperity-lab feel`: a simulated hand explores a texture on a simulated device.

use std::io::{self, IsTerminal as _, Write as _};
use std::path::{Path, PathBuf};

use asperity::output::AtomicFile;
use asperity::source::Source;
use asperity_formats::Asset;
use asperity_sim::device::DeviceConfig;
use asperity_sim::feel::{FeelOptions, Summary, csv, record, sheet, wav};
use asperity_sim::hand::{Grip, GripPreset};

use crate::error::{Failure, Plain, boxed, print};

/// Let a simulated hand explore a texture on a simulated device
///
/// The hand approaches, taps at four speeds, presses, rests, strokes at four
/// speeds and forces, scrubs and lifts. Time is virtual, and the same seed gives
/// the same bytes. The summary goes to stdout.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  asperity-lab feel                             the built-in texture
  asperity-lab feel brick.asp --plot feel.png --wav feel.wav
  asperity-lab feel all.aspl --texture Cork --grip firm --seed 7 --csv feel.csv
  asperity-lab feel brick.asp --device my-touch.toml --seconds 60

Columns of the CSV: tick, t_s, motion; true position, true velocity, measured
position; depth, speed, k·δ, vibration, tap, friction and force as the renderer
gives them; the force the device held; the normal force the hand meant; flags.")]
pub(crate) struct Arguments {
    /// Asset (.asp) or library (.aspl); the built-in texture without it
    file: Option<PathBuf>,
    /// Which texture of a library, by name or index
    #[arg(long, value_name = "NAME", requires = "file")]
    texture: Option<String>,
    /// Device to simulate, a TOML file; a 3D Systems Touch without it
    #[arg(long, value_name = "TOML")]
    device: Option<PathBuf>,
    /// Grip of the hand: light, firm, or a TOML file
    #[arg(long, value_name = "light|firm|TOML", default_value = "light")]
    grip: String,
    /// Seed of the script's variations and of the texture's excitation
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Virtual time to run, s (0.1 to 600); one whole exploration, about 12 s, without it
    #[arg(long, value_name = "S", value_parser = seconds)]
    seconds: Option<f64>,
    /// Write every tick to a CSV file
    #[arg(long, value_name = "OUT.csv")]
    csv: Option<PathBuf>,
    /// Write a sheet with position, force, vibration, spectrogram and taps
    #[arg(long, value_name = "OUT.png")]
    plot: Option<PathBuf>,
    /// Write the vibration as sound, 16 bit, 48 kHz
    #[arg(long, value_name = "OUT.wav")]
    wav: Option<PathBuf>,
    /// No progress on the terminal
    #[arg(long, short)]
    quiet: bool,
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(value) if (0.1..=600.0).contains(&value) => Ok(value),
        Ok(_) => Err("must be 0.1 to 600 s".into()),
        Err(_) => Err("not a number of seconds".into()),
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let progress = Progress {
        shown: !arguments.quiet && io::stderr().is_terminal(),
    };
    check_outputs(arguments)?;
    let options = FeelOptions {
        device: match &arguments.device {
            None => DeviceConfig::touch().map_err(boxed)?,
            Some(path) => DeviceConfig::load(path).map_err(boxed)?,
        },
        grip: match arguments.grip.as_str() {
            "light" => Grip::preset(GripPreset::Light).map_err(boxed)?,
            "firm" => Grip::preset(GripPreset::Firm).map_err(boxed)?,
            path => Grip::load(Path::new(path)).map_err(boxed)?,
        },
        seed: arguments.seed,
        seconds: arguments.seconds,
    };
    let (bytes, origin) = texture(arguments)?;
    // Opened before the work, so that a bad path costs no time.
    let open = |path: &Option<PathBuf>| path.as_deref().map(AtomicFile::create).transpose();
    let csv_file = open(&arguments.csv).map_err(boxed)?;
    let plot_file = open(&arguments.plot).map_err(boxed)?;
    let wav_file = open(&arguments.wav).map_err(boxed)?;

    progress.say("simulating");
    let asset = Asset::parse(&bytes).map_err(|error| {
        Plain::boxed(
            format!("{origin}: {error}"),
            "make the file again from its source",
        )
    })?;
    let recording = record(&asset, &origin, &options).map_err(boxed)?;
    let mut report = Summary::new(&recording).to_string();
    let mut finished = Vec::new();
    if let Some(file) = csv_file {
        progress.say("writing the table");
        let rows = recording.records.len();
        report += &format!("\ncsv        {}, {rows} rows", file.target().display());
        finished.push(filled(file, &csv::encode(&recording).map_err(boxed)?)?);
    }
    if let Some(file) = plot_file {
        progress.say("drawing the sheet");
        report += &format!("\nplot       {}", file.target().display());
        finished.push(filled(file, &sheet::draw(&recording).map_err(boxed)?)?);
    }
    if let Some(file) = wav_file {
        progress.say("writing the sound");
        let sound = wav::encode(&recording).map_err(boxed)?;
        report += &format!(
            "\nwav        {}, {} Hz, 16 bit, vibration before device gain, full scale is {}",
            file.target().display(),
            sound.sample_rate_hz,
            if sound.gain_per_m_s2 > 0.0 {
                format!("{:.4} m/s²", 1.0 / sound.gain_per_m_s2)
            } else {
                "undefined: silence".to_owned()
            }
        );
        finished.push(filled(file, &sound.bytes)?);
    }
    for file in finished {
        file.commit().map_err(boxed)?;
    }
    progress.clear();
    print(&format!("{}\n", report.trim_end()))
}

/// Bytes of the asset to feel, and where it came from.
fn texture(arguments: &Arguments) -> Result<(Vec<u8>, String), Failure> {
    let Some(path) = &arguments.file else {
        let lowered = asperity::lower::lower(&asperity::builtin::texture(), None).map_err(boxed)?;
        return Ok((lowered.bytes, "built in".to_owned()));
    };
    let mut source = Source::open(path).map_err(boxed)?;
    let bytes = source.choose(arguments.texture.as_deref()).map_err(boxed)?;
    Ok((bytes, path.display().to_string()))
}

/// Refuses outputs that would replace an input or each other.
fn check_outputs(arguments: &Arguments) -> Result<(), Failure> {
    let inputs = [&arguments.file, &arguments.device];
    let outputs = [&arguments.csv, &arguments.plot, &arguments.wav];
    let same = |a: &Path, b: &Path| {
        a == b
            || matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b && a.is_file())
    };
    for (index, output) in outputs.iter().enumerate() {
        let Some(output) = output else { continue };
        let others = inputs.iter().chain(&outputs[..index]);
        if others
            .filter_map(|path| path.as_deref())
            .any(|other| same(other, output))
        {
            return Err(Plain::boxed(
                format!("{}: given twice", output.display()),
                "give every output a path of its own",
            ));
        }
    }
    Ok(())
}

fn filled(mut file: AtomicFile, bytes: &[u8]) -> Result<AtomicFile, Failure> {
    match file.write_all(bytes) {
        Ok(()) => Ok(file),
        Err(error) => Err(Plain::boxed(
            format!("{}: cannot write it: {error}", file.target().display()),
            "check the path and the disk",
        )),
    }
}

/// What is being done, on a terminal only.
struct Progress {
    shown: bool,
}

impl Progress {
    fn say(&self, what: &str) {
        if self.shown {
            eprint!("\r\x1b[2K{what} …");
        }
    }

    fn clear(&self) {
        if self.shown {
            eprint!("\r\x1b[2K");
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.clear();
    }
}
