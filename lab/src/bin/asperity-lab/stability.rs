//! `asperity-lab stability`: the table of scenarios where methods fail.

use std::path::PathBuf;

use asperity::sources::hatt;
use asperity_console::Console;
use asperity_experiments::stability::{StabilityOptions, markdown, run as make_table, sheet};
use asperity_io::diagnostic::{Failures, one};
use asperity_io::output;

use crate::error::Plain;

/// Compare the runtime with published and textbook methods in scenarios where those fail
///
/// Every row measures one figure in virtual time, for the runtime itself and for other
/// methods in the same scenario. A row passes if the runtime is within its limit. The last
/// line counts the rows; the exit status is 1 if a row fails.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  asperity-lab stability
  asperity-lab stability --hatt materials/ -o pictures/
  asperity-lab stability --json > table.json

With --output: wall-map.png (stiffness, delay and damping against the bound),
waveforms.png (the worst cases) and tables.md (the rows in the form of docs/stability.md).")]
pub(crate) struct Arguments {
    /// Folder of HaTT XML files, for rows that need real materials
    #[arg(long, value_name = "DIR")]
    hatt: Option<PathBuf>,
    /// Folder to write pictures and tables to; created if its parent exists
    #[arg(short = 'o', long = "output", alias = "out", value_name = "DIR")]
    out: Option<PathBuf>,
    /// Seed of all random numbers
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print the rows as JSON, and the count on standard error
    #[arg(long)]
    json: bool,
}

/// Gives whether every row passes.
pub(crate) fn run(arguments: &Arguments, console: Console) -> Result<bool, Failures> {
    let options = StabilityOptions {
        hatt: arguments.hatt.clone(),
        seed: arguments.seed,
    };
    let table = make_table(&options).map_err(one)?;
    if let Some(folder) = &arguments.out {
        let files = [
            ("wall-map.png", sheet::wall_map().map_err(one)?),
            ("waveforms.png", sheet::waveforms(&options).map_err(one)?),
            ("tables.md", markdown::tables(&table.rows).into_bytes()),
        ];
        let files: Vec<(String, &[u8])> = files
            .iter()
            .map(|(name, bytes)| ((*name).to_owned(), &bytes[..]))
            .collect();
        let inputs = match &arguments.hatt {
            Some(folder) => hatt::files(folder).map_err(one)?,
            None => Vec::new(),
        };
        output::write_folder_beside(&inputs, folder, &files).map_err(one)?;
    }
    if arguments.json {
        let text = serde_json::to_string_pretty(&table)
            .map_err(|error| Plain::failure(error, "report this as a bug"))?;
        console.json(&text).map_err(one)?;
        console.aside(&format!("{}\n", table.summary()));
    } else {
        let wrote = arguments.out.is_some();
        console
            .result_of(wrote, &format!("{table}\n"))
            .map_err(one)?;
    }
    let [_, failed, _] = table.counts();
    Ok(failed == 0)
}
