//! `asperity-lab study`: a study whose textures are felt on a device.

use std::path::PathBuf;

use asperity::learned::inference::Backend;
use asperity::sources::prompt::PromptCompiler;
use asperity_console::Console;
use asperity_host::device::{Scheme, Uri};
use asperity_host::servo::privileges::Policy;
use asperity_io::diagnostic::{Failure, Failures, one};
use asperity_studio::{Site, Study, StudyHost};

use crate::error::Plain;
use crate::loop_options::{LoopOptions, OverrunName};
use crate::servo;

/// Run a study on a device: its textures play in the servo loop, participants answer on a page
///
/// As `asperity study run`, with a device in the place of the mouse. One participant at a time feels it.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  asperity-lab study study.toml --device sim: -o data
  asperity-lab study study.toml --device openhaptics: --profile touch.toml -o data")]
pub(crate) struct Arguments {
    /// The study, TOML (see docs/studies.md)
    #[arg(value_name = "STUDY.toml")]
    study: PathBuf,
    /// Folder of the dataset: new, empty, or that of this study, which then goes on
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Device to render on, such as sim:
    #[arg(long, value_name = "URI")]
    device: Uri,
    /// Device profile, TOML, whose filter is applied to every texture
    #[arg(long, value_name = "TOML")]
    profile: Option<PathBuf>,
    /// Servo rate, 250 to 10000 Hz [default: 1000]
    #[arg(long, value_name = "HZ", value_parser = clap::value_parser!(u32).range(250..=10_000))]
    rate: Option<u32>,
    /// Scheduling policy: other, fifo, fifo:PRIORITY, deadline or deadline:PERCENT
    #[arg(long, value_name = "POLICY", default_value = "fifo")]
    policy: Policy,
    /// Do not lock memory
    #[arg(long)]
    no_lock: bool,
    /// Port of the page
    #[arg(long, value_name = "N", default_value_t = 8418)]
    port: u16,
    /// Only print the address, and open no browser
    #[arg(long)]
    no_open: bool,
}

pub(crate) fn run(arguments: &Arguments, console: Console) -> Result<(), Failures> {
    if arguments.device.scheme == Scheme::Replay {
        return Err(Plain::usage(
            "a recorded session takes part in no study",
            "give a device, such as sim:",
        ));
    }
    let activity = console.activity();
    let study = Study::open(&arguments.study, prompts, || activity.tick());
    activity.finish_and_clear();
    let study = study?;
    let options = LoopOptions {
        file: None,
        texture: None,
        profile: arguments.profile.clone(),
        rate: arguments.rate,
        overrun: OverrunName::Skip,
        policy: arguments.policy,
        cpu: None,
        spin: 0,
        no_lock: arguments.no_lock,
        deep_idle: false,
        seed: None,
    };
    let Arguments {
        device,
        port,
        no_open,
        ..
    } = arguments;
    let servo = servo::Arguments::beside_a_page(options, device.clone(), *port, *no_open);
    let output = arguments.output.clone();
    let host = move |device| {
        let said = move |text: &str| console.aside(&format!("{text}\n"));
        let host = StudyHost::open(study, &output, Some(device), said).map_err(one)?;
        Ok(Site::from(host))
    };
    servo::run_beside(&servo, ("study", Box::new(host)), console)
}

fn prompts() -> Result<PromptCompiler, Failure> {
    Ok(PromptCompiler::embedded(&Backend::Portable)?)
}
