//! `asperity-lab device calibrate`: how a device answers a force, and the filter that evens it out.

use std::path::PathBuf;

use asperity_console::Console;
use asperity_host::profile::Profile;
use asperity_host::profile::sweep::Sweep;
use asperity_io::diagnostic::{Failures, one};
use asperity_io::output::{Outputs, display};
use asperity_lab::calibration::{
    CalibrationError, Measured, base, doubts, draw, median_gain, simulate,
};
use asperity_sim::device::DeviceConfig;

use crate::error::Plain;
use crate::loop_options::within;

/// Fit the response of a device to commanded forces, and write its profile
///
/// The table has one row per servo period: t_s, force_n (the commanded force) and accel_m_s2
/// (the acceleration of the tip along that force). Without a table, the sweep is played on the
/// simulated device. The report gives resonance, delay and coherence, and the deviation from
/// the reference between 40 and 400 Hz, without and with the filter.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  asperity-lab device calibrate                          the simulated Touch
  asperity-lab device calibrate --table sweep.csv        its table, as an example
  asperity-lab device calibrate measured.csv --profile touch.toml -o mine.toml --plot mine.png
  asperity-lab servo brick.asp --device falcon: --profile mine.toml

The sweep: 20 Hz to 0.48 of the rate and back in 20 s, at --amplitude. Hold the stylus by a
thread or a weak spring. No table of real hardware has been fitted yet.")]
pub(crate) struct Arguments {
    /// Measured table, CSV [default: a sweep of the simulated device]
    table_file: Option<PathBuf>,
    /// Profile to start from, TOML: limits and mechanics
    #[arg(long, value_name = "TOML")]
    profile: Option<PathBuf>,
    /// Simulated device, a TOML file [default: a 3D Systems Touch]
    #[arg(long, value_name = "TOML", conflicts_with = "table_file")]
    device: Option<PathBuf>,
    /// Amplitude of the simulated sweep, N (0.01 to 10)
    #[arg(long, value_name = "N", default_value_t = 1.0, value_parser = within(0.01..=10.0, " N"), conflicts_with = "table_file")]
    amplitude: f64,
    /// Write the table of the simulated sweep; `-` is standard output
    #[arg(long, value_name = "OUT.csv", conflicts_with = "table_file")]
    table: Option<PathBuf>,
    /// Plot the response without and with the filter, and the coherence; `-` is standard output
    #[arg(long, value_name = "OUT.png")]
    plot: Option<PathBuf>,
    /// Write the profile, including the filter; `-` is standard output
    #[arg(short, long, value_name = "OUT.toml")]
    output: Option<PathBuf>,
    /// Keep a calibration whose gain, unit, force or filter is implausible
    #[arg(long)]
    force: bool,
}

pub(crate) fn run(arguments: &Arguments, console: Console) -> Result<(), Failures> {
    let inputs = arguments
        .table_file
        .iter()
        .chain(&arguments.profile)
        .chain(&arguments.device);
    let mut outputs = Outputs::beside(inputs);
    let mut open = |path: &Option<PathBuf>| outputs.open_if(path.as_deref()).map_err(one);
    let table_file = open(&arguments.table)?;
    let plot_file = open(&arguments.plot)?;
    let profile_file = open(&arguments.output)?;
    let console = console.beside(&outputs);

    let device = match &arguments.device {
        None => DeviceConfig::touch().map_err(one)?,
        Some(path) => DeviceConfig::load(path).map_err(one)?,
    };
    let mut profile = base(arguments.profile.as_ref(), &device).map_err(one)?;
    let (measured, origin) = match &arguments.table_file {
        Some(path) => (
            Measured::load(path).map_err(one)?,
            display(path).to_string(),
        ),
        None => {
            let sweep = Sweep::standard(device.timing.servo_rate_hz, arguments.amplitude);
            (
                simulate(&device, &sweep),
                format!("{}, simulated", device.name),
            )
        }
    };
    let (response, design) = measured.fit(&origin).map_err(one)?;
    let doubts = doubts(&origin, &measured, &response, &design, &profile);
    if !arguments.force && !doubts.is_empty() {
        return Err(doubts.into_iter().flat_map(one).collect());
    }
    for doubt in doubts {
        console.warn(&doubt.to_string());
    }
    let gain_m_s2_n = median_gain(&response);
    let mut report = format!(
        "measured   {origin}, {} periods at {:.0} Hz\n\
         gain       {gain_m_s2_n:.1} m/s² a newton, as a mass of {:.0} g\n\
         resonance  {:.0} Hz, {:+.1} dB over the median gain\n\
         delay      {:.2} ms\n\
         coherence  {:.2} at worst, 40 to 400 Hz\n\
         deviation  {:.1} dB from the reference without the filter, {:.2} dB with it\n\
         filter     {} coefficients, minimum phase\n",
        measured.force_n.len(),
        measured.rate_hz,
        1e3 / gain_m_s2_n,
        response.resonance_hz,
        response.resonance_db,
        1e3 * response.delay_s,
        response.worst_coherence,
        design.before_db,
        design.after_db,
        design.filter.taps.len(),
    );
    if let (Some(file), Some(path)) = (table_file, &arguments.table) {
        report += &format!("table      {}\n", display(path));
        outputs
            .fill(file, measured.to_csv().as_bytes())
            .map_err(one)?;
    }
    if let (Some(file), Some(path)) = (plot_file, &arguments.plot) {
        report += &format!("plot       {}\n", display(path));
        let drawn = draw(&origin, &response, &design);
        let png = drawn.map_err(|error| Plain::failure(error, "report this as a bug"))?;
        outputs.fill(file, &png).map_err(one)?;
    }
    if let (Some(file), Some(path)) = (profile_file, &arguments.output) {
        report += &format!("profile    {}\n", display(path));
        let field = "compensation.taps".to_owned();
        if arguments.table_file.is_none() && !profile.unconfirmed.contains(&field) {
            profile.unconfirmed.push(field);
        }
        profile.compensation = Some(design.filter);
        let text = profile.to_toml();
        // What --force keeps must be read back all the same.
        Profile::from_toml(&text, &origin).map_err(|error| one(CalibrationError::from(error)))?;
        outputs.fill(file, text.as_bytes()).map_err(one)?;
    }
    outputs.commit().map_err(one)?;
    let wrote = arguments.output.is_some() || arguments.table.is_some() || arguments.plot.is_some();
    console.result_of(wrote, &report).map_err(one)
}
