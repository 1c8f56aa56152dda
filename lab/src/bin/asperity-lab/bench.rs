//! `asperity-lab bench`: known textures, recorded by simulated sensors and imported again.

use std::{fmt::Write as _, path::PathBuf};

use asperity::{model::TextureModel, sources::hatt};
use asperity_console::Console;
use asperity_experiments::import_accuracy::{
    self, Figures, LearningCurvePoint, MOST_FREE_TAPS, Resonance, Sensors, Strokes, Until,
};
use asperity_io::diagnostic::{Failures, one};

use crate::error::Plain;
use crate::loop_options::within;

/// Materials of the learned model that are decoded where no HaTT is given.
const REFERENCE: usize = 24;

/// Record known textures with simulated sensors, import them, and compare with the truth
///
/// A hand strokes and taps every texture on a simulated Touch with irregular motion. An accelerometer,
/// a force sensor and the device write files with noise, gravity, delay and drift. What an import
/// makes of the files is held against the texture that was touched, at every part of the plane of
/// speed and force that was visited.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  asperity-lab bench
  asperity-lab bench --hatt materials/ --seconds 5,15,60,300
  asperity-lab bench -o oak --seconds 30        a recording to try an import on

Without --hatt, the textures are the built-in one and materials of the learned model.")]
pub(crate) struct Arguments {
    /// Folder of HaTT XML files
    #[arg(long, value_name = "DIR")]
    hatt: Option<PathBuf>,
    /// Seconds of strokes, one or more values; time in the air and taps are added. With --output, the
    /// length of the whole recording
    #[arg(long, value_name = "S,…", value_delimiter = ',', default_value = "60", value_parser = within(3.0..=1200.0, " s"))]
    seconds: Vec<f64>,
    /// Stroke freely: speed and force change all the time
    #[arg(long)]
    free: bool,
    /// Use at most this many textures
    #[arg(long, value_name = "N")]
    textures: Option<usize>,
    /// Use only every Nth texture
    #[arg(long, value_name = "N", default_value_t = 1)]
    every: usize,
    /// Noise of the accelerometer, as a multiple of 80 µg/√Hz
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0)]
    noise: f64,
    /// Resonance of the tool with its accelerometer: frequency in Hz, and Q
    #[arg(long, value_name = "HZ,Q")]
    resonance: Option<Resonance>,
    /// Number of taps of the tool in free air, at the start
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u8).range(..=MOST_FREE_TAPS as i64))]
    free_taps: u8,
    /// Do not record the position along z
    #[arg(long)]
    no_height: bool,
    /// Write every visited cell of every texture to this CSV file
    #[arg(long, value_name = "FILE", conflicts_with = "write")]
    cells: Option<PathBuf>,
    /// Instead, write one recording of the first texture to this new folder, whose parent must exist
    #[arg(short = 'o', long = "output", alias = "write", value_name = "DIR")]
    write: Option<PathBuf>,
    /// Seed of all random numbers
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Arguments {
    fn strokes(&self) -> Strokes {
        if self.free {
            Strokes::Free
        } else {
            Strokes::Steady
        }
    }

    /// Changes the usual sensors as asked.
    fn alter(&self, sensors: &mut Sensors) {
        sensors.accel_noise *= self.noise;
        sensors.resonance = self.resonance;
        sensors.free_taps = usize::from(self.free_taps);
        sensors.has_height = !self.no_height;
    }
}

pub(crate) fn run(arguments: &Arguments, console: Console) -> Result<(), Failures> {
    let mut textures = textures(arguments)?;
    textures = textures
        .into_iter()
        .step_by(arguments.every.max(1))
        .collect();
    textures.truncate(arguments.textures.unwrap_or(usize::MAX).max(1));
    if let Some(folder) = &arguments.write {
        return write(arguments, &textures[0], folder, console);
    }
    let mut all: Vec<(Figures, Vec<LearningCurvePoint>)> = Vec::new();
    for &seconds in &arguments.seconds {
        let bar = console.bar(textures.len(), "recording and importing");
        let alter = |sensors: &mut Sensors| arguments.alter(sensors);
        let rows = import_accuracy::learn(
            &textures,
            arguments.strokes(),
            seconds,
            arguments.seed,
            alter,
            || bar.inc(1),
        )
        .map_err(one)?;
        bar.finish_and_clear();
        all.push((import_accuracy::summary(&rows), rows));
    }
    let written = match &arguments.cells {
        Some(path) => std::fs::write(path, cells_csv(&all)).map_err(|error| {
            Plain::failure(
                format!("{}: {error}", path.display()),
                "give a path that you can write to",
            )
        }),
        None => Ok(()),
    };
    // Figures of single materials of others stay with their owner.
    let figures: Vec<&Figures> = all.iter().map(|(figures, _)| figures).collect();
    let printed = if arguments.json {
        console.json(&serde_json::json!(figures))
    } else {
        console.text(&figures_text(&all))
    };
    crate::error::all([written, printed.map_err(one)])
}

fn figures_text(all: &[(Figures, Vec<LearningCurvePoint>)]) -> String {
    let mut text = String::from(
        "| seconds of strokes | textures | mean of a texture's cells, median dB | 95 % of the textures, dB | median cell, median dB | cells | 95 % of the cells, dB | within 3 dB, % | 10 dB over noise, % | their 95 % dB | level, mean dB | 95 % of the cells, dB | μ, median % | 95 % | taps, median dB | 95 % dB | vertices |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for (f, rows) in all {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "| {:.0} | {} of {} | {:.2} | {:.2} | {:.2} | {} | {:.2} | {:.1} | {:.0} | {:.2} | {:.2} | {:.2} | {:.1} | {:.1} | {:.2} | {:.2} | {:.0} |",
            f.seconds,
            f.imported,
            rows.len(),
            f.texture_db.0,
            f.texture_db.1,
            f.median_db,
            f.cells,
            f.p95_db,
            f.within_percent,
            f.loud_percent,
            f.loud_p95_db,
            f.level_db,
            f.level_p95_db,
            f.mu_percent.0,
            f.mu_percent.1,
            f.taps_db.0,
            f.taps_db.1,
            f.vertices
        );
        for row in rows {
            if let Some(why) = &row.refused {
                let _ = writeln!(text, "  {} refused: {why}", row.name);
            }
        }
    }
    text
}

fn cells_csv(all: &[(Figures, Vec<LearningCurvePoint>)]) -> String {
    let mut csv = String::from(
        "texture,recorded_s,vertices,order,speed_mm_s,force_n,seconds,used_s,over_noise_db,error_db,level_db\n",
    );
    for row in all.iter().flat_map(|(_, rows)| rows) {
        for cell in row.comparison.iter().flat_map(|c| &c.cells) {
            // Writing to a string cannot fail.
            let _ = writeln!(
                csv,
                "\"{}\",{:.0},{},{},{:.2},{:.3},{:.3},{:.3},{:.2},{:.3},{:.3}",
                row.name.replace('"', "\"\""),
                row.seconds,
                row.vertices,
                row.order,
                cell.speed_mm_s,
                cell.force_n,
                cell.seconds,
                cell.used_s,
                cell.over_noise_db,
                cell.error_db,
                cell.level_db
            );
        }
    }
    csv
}

fn write(
    arguments: &Arguments,
    texture: &TextureModel,
    folder: &PathBuf,
    console: Console,
) -> Result<(), Failures> {
    let fail = |error: std::io::Error| {
        Plain::failure(
            format!("{}: {error}", folder.display()),
            "give a folder that can be created",
        )
    };
    if folder.exists() {
        return Err(Plain::failure(
            format!("{}: already exists", folder.display()),
            "give a folder that does not exist yet",
        ));
    }
    let until = Until::Seconds(arguments.seconds[0]);
    let performance = import_accuracy::perform(texture, arguments.strokes(), until, arguments.seed)
        .map_err(one)?;
    let mut sensors = Sensors::seeded(arguments.seed);
    arguments.alter(&mut sensors);
    std::fs::create_dir(folder).map_err(fail)?;
    let written = import_accuracy::record(&performance, texture, &sensors, arguments.seed, folder);
    if let Err(error) = written {
        // Half a recording is none.
        let _ = std::fs::remove_dir_all(folder);
        return Err(fail(error));
    }
    let text = format!(
        "{}: {:.0} s of {}, {} impacts\n",
        folder.display(),
        arguments.seconds[0],
        texture.name,
        performance.impacts.len()
    );
    console.report(&text).map_err(one)
}

/// The textures that are touched.
fn textures(arguments: &Arguments) -> Result<Vec<TextureModel>, Failures> {
    if let Some(folder) = &arguments.hatt {
        let files = hatt::files(folder).map_err(one)?;
        return files
            .iter()
            .map(|file| {
                let material = hatt::bytes(file)
                    .and_then(|bytes| hatt::parse(file, &bytes))
                    .map_err(one)?;
                let name = file.file_name().unwrap_or_default().to_string_lossy();
                Ok(hatt::to_model(&material, &name, 0))
            })
            .collect();
    }
    import_accuracy::materials(REFERENCE).map_err(one)
}
