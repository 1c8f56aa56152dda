//! Arguments of studies.

use clap::{Args, Subcommand};
use std::path::PathBuf;

/// The commands of a study.
#[derive(Debug, Subcommand)]
pub(crate) enum Study {
    /// Check a study: compile every texture, and say how long a participant takes
    Check(CheckStudy),
    /// Run a study: serve its page to participants, and write what they answer
    #[command(
        after_help = "Prints the address of the participants' page. Whoever opens it takes part, as P01, P02 and so on, in a browser \
of this machine; a page that is closed goes on where it was. The address is the same as long as the folder is. Each trial is \
written as soon as it is answered, as a Psych-DS dataset. Ctrl-C ends it.

Example:
  asperity study run study.toml -o data"
    )]
    Run(RunStudy),
    /// Write the dataset of simulated participants, to plan a study and to try its analysis
    #[command(
        after_help = "Simulated participants rate what Asperity itself predicts, with the noise and the bias of [simulate]. They \
show how many people a design needs for effects of a known size, and nothing of what people feel.

Example:
  asperity study simulate study.toml --participants 20 -o simulated"
    )]
    Simulate(SimulateStudy),
}

#[derive(Debug, Args)]
pub(crate) struct CheckStudy {
    /// The study, TOML (see docs/studies.md)
    #[arg(value_name = "STUDY.toml")]
    pub(crate) study: PathBuf,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct RunStudy {
    /// The study, TOML (see docs/studies.md)
    #[arg(value_name = "STUDY.toml")]
    pub(crate) study: PathBuf,
    /// Folder of the dataset: new, empty, or that of this study, which then goes on
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: PathBuf,
    /// Port to listen on; 0 is a free one
    #[arg(long, value_name = "N", default_value_t = 8418)]
    pub(crate) port: u16,
    /// Only print the address, and open no browser
    #[arg(long)]
    pub(crate) no_open: bool,
}

#[derive(Debug, Args)]
pub(crate) struct SimulateStudy {
    /// The study, TOML (see docs/studies.md)
    #[arg(value_name = "STUDY.toml")]
    pub(crate) study: PathBuf,
    /// Number of participants
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=9999))]
    pub(crate) participants: u32,
    /// Seed of what they answer
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    pub(crate) seed: u64,
    /// Folder of the dataset, new or empty
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: PathBuf,
}
