//! `asperity-lab feel`: a simulated hand explores a texture on a simulated device.

use std::path::PathBuf;

use asperity::emit::textures::Textures;
use asperity_console::Console;
use asperity_formats::Asset;
use asperity_io::diagnostic::{Failures, one};
use asperity_io::output::{Outputs, display};
use asperity_lab::feel::{FeelOptions, Summary, csv, record, sheet, wav};
use asperity_sim::device::DeviceConfig;
use asperity_sim::hand::{Grip, GripPreset};

use crate::error::Plain;
use crate::loop_options::within;

/// Explore a texture with a simulated hand on a simulated device
///
/// The hand approaches, taps at four speeds, presses, rests, strokes at four
/// speeds and forces, scrubs and lifts. Time is virtual, and the same seed gives
/// the same bytes. The summary goes to standard output.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  asperity-lab feel                             the built-in texture
  asperity-lab feel brick.asp --plot feel.png --wav feel.wav
  asperity-lab feel all.aspl --texture Cork --grip firm --seed 7 --csv feel.csv
  asperity-lab feel brick.asp --device my-touch.toml --seconds 60

Columns of the CSV: tick, t_s, motion; true position, true velocity, measured
position; depth, speed, k·δ, vibration, tap, friction and force as rendered; the
force that the device applied; the normal force that the hand aimed for; flags.")]
pub(crate) struct Arguments {
    /// Asset (.asp) or library (.aspl); `-` is standard input [default: the built-in texture]
    file: Option<PathBuf>,
    /// Texture of a library, by name or index from 0
    #[arg(long, value_name = "NAME", requires = "file")]
    texture: Option<String>,
    /// Simulated device, a TOML file [default: a 3D Systems Touch]
    #[arg(long, value_name = "TOML")]
    device: Option<PathBuf>,
    /// Grip of the hand: light, firm, or a TOML file
    #[arg(long, value_name = "light|firm|TOML", default_value = "light")]
    grip: String,
    /// Seed of the variations of the script and of the texture's excitation
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Virtual time to run, s (0.1 to 600) [default: one whole exploration, about 12 s]
    #[arg(long, value_name = "S", value_parser = within(0.1..=600.0, " s"))]
    seconds: Option<f64>,
    /// Write every tick to a CSV file; `-` is standard output
    #[arg(long, value_name = "OUT.csv")]
    csv: Option<PathBuf>,
    /// Write a sheet with position, force, vibration, spectrogram and taps; `-` is standard output
    #[arg(long, value_name = "OUT.png")]
    plot: Option<PathBuf>,
    /// Write the vibration as a 16-bit WAV at 48 kHz; `-` is standard output
    #[arg(long, value_name = "OUT.wav")]
    wav: Option<PathBuf>,
    /// Print the summary as JSON
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments, console: Console) -> Result<(), Failures> {
    let grip = match arguments.grip.as_str() {
        "light" => Ok(GripPreset::Light),
        "firm" => Ok(GripPreset::Firm),
        path => Err(PathBuf::from(path)),
    };
    let inputs = arguments.file.iter().chain(&arguments.device);
    let mut outputs = Outputs::beside(inputs.chain(grip.as_ref().err()));
    // Opened before the work, so that a bad path costs no time.
    let mut open = |path: &Option<PathBuf>| outputs.open_if(path.as_deref()).map_err(one);
    let csv_file = open(&arguments.csv)?;
    let plot_file = open(&arguments.plot)?;
    let wav_file = open(&arguments.wav)?;
    let console = console.beside(&outputs);
    let options = FeelOptions {
        device: match &arguments.device {
            None => DeviceConfig::touch().map_err(one)?,
            Some(path) => DeviceConfig::load(path).map_err(one)?,
        },
        grip: match grip {
            Ok(preset) => Grip::preset(preset).map_err(one)?,
            Err(path) => Grip::load(&path).map_err(one)?,
        },
        seed: arguments.seed,
        seconds: arguments.seconds,
    };
    let (bytes, origin) = texture(arguments)?;

    let activity = console.activity();
    activity.set_message("simulating");
    let asset = Asset::parse(&bytes).map_err(|error| {
        Plain::failure(
            format!("{origin}: {error}"),
            "build the file again from its source",
        )
    })?;
    let recording = record(&asset, &origin, &options).map_err(one)?;
    let summary = Summary::new(&recording);
    let mut report = summary.to_string();
    if let (Some(file), Some(path)) = (csv_file, &arguments.csv) {
        activity.set_message("writing the table");
        let rows = recording.records.len();
        report += &format!("\ncsv        {}, {rows} rows", display(path));
        let table = csv::encode(&recording).map_err(one)?;
        outputs.fill(file, &table).map_err(one)?;
    }
    if let (Some(file), Some(path)) = (plot_file, &arguments.plot) {
        activity.set_message("drawing the sheet");
        report += &format!("\nplot       {}", display(path));
        let sheet = sheet::draw(&recording).map_err(one)?;
        outputs.fill(file, &sheet).map_err(one)?;
    }
    if let (Some(file), Some(path)) = (wav_file, &arguments.wav) {
        activity.set_message("writing the sound");
        let sound = wav::encode(&recording).map_err(one)?;
        report += &format!(
            "\nwav        {}, {} Hz, 16 bit, vibration before device gain; full scale is {}",
            display(path),
            sound.sample_rate_hz,
            if sound.gain_per_m_s2 > 1e3 {
                // A vibration that no hand feels.
                format!("{:.2e} m/s²", 1.0 / sound.gain_per_m_s2)
            } else if sound.gain_per_m_s2 > 0.0 {
                format!("{:.4} m/s²", 1.0 / sound.gain_per_m_s2)
            } else {
                "undefined: silence".to_owned()
            }
        );
        outputs.fill(file, &sound.bytes).map_err(one)?;
    }
    outputs.commit().map_err(one)?;
    activity.finish_and_clear();
    if arguments.json {
        return console.json(&summary.json()).map_err(one);
    }
    let report = format!("{}\n", report.trim_end());
    let wrote = arguments.csv.is_some() || arguments.plot.is_some() || arguments.wav.is_some();
    console.result_of(wrote, &report).map_err(one)
}

/// Bytes of the asset to feel, and where it came from.
fn texture(arguments: &Arguments) -> Result<(Vec<u8>, String), Failures> {
    let Some(path) = &arguments.file else {
        let lowered = asperity::emit::lower::lower(&asperity::sources::builtin::texture(), None)
            .map_err(one)?;
        return Ok((lowered.bytes, "built in".to_owned()));
    };
    let mut textures = Textures::open(path).map_err(one)?;
    let bytes = textures.choose(arguments.texture.as_deref()).map_err(one)?;
    Ok((bytes, textures.shown()))
}
