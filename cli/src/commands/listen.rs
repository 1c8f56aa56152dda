//! `asperity listen`.

use super::input::Chosen;
use crate::cli::Listen;
use asperity::views::listen::{self, Gesture, Part, RenderedSound, SOUND_HZ};
use asperity_console::Console;
use asperity_io::{
    diagnostic::{Failures, one},
    output::{Outputs, display},
    shown::counted,
};
use serde_json::{Value, json};
use std::path::Path;

pub(crate) fn run(args: &Listen, console: Console) -> Result<(), Failures> {
    let mut outputs = Outputs::beside([&args.file]);
    let sound = outputs.open(&args.output).map_err(one)?;
    let console = console.beside(&outputs);
    let chosen = Chosen::open(&args.file, args.texture.clone())?;
    let asset = chosen.asset()?;
    let session = Gesture::asked(args.speed, args.force, args.taps);
    let rendered = listen::listen(&asset, &session, args.rate, args.seed).map_err(one)?;
    outputs.fill(sound, &rendered.wav).map_err(one)?;
    outputs.commit().map_err(one)?;
    console.warnings(&rendered.warnings, args.json);
    if args.json {
        console.json(&in_json(&args.output, &rendered)).map_err(one)
    } else {
        console
            .report(&report(&args.output, &rendered))
            .map_err(one)
    }
}

fn in_json(path: &Path, rendered: &RenderedSound) -> Value {
    let part = |part: &Part| {
        json!({
            "count": part.count,
            "peak_m_s2": part.peak_m_s2,
            "full_scale_per_m_s2": part.gain_per_m_s2,
        })
    };
    json!({
        "output": display(path).to_string(),
        "seconds": rendered.seconds,
        "sample_rate_hz": SOUND_HZ,
        "strokes": part(&rendered.strokes),
        "taps": part(&rendered.taps),
        "warnings": rendered.warnings,
    })
}

fn report(path: &Path, rendered: &RenderedSound) -> String {
    let part = |part: &Part, one: &str, many: &str| match part.count {
        0 => None,
        count => Some(format!(
            "{}, peak {:.3} m/s², gain {}\n",
            counted(count, one, many),
            part.peak_m_s2,
            gain(part.gain_per_m_s2)
        )),
    };
    let mut text = format!("{}: {:.2} s at 44.1 kHz\n", display(path), rendered.seconds);
    for line in [
        part(&rendered.strokes, "stroke", "strokes"),
        part(&rendered.taps, "tap", "taps"),
    ] {
        text += &line.map(|line| format!("  {line}")).unwrap_or_default();
    }
    text
}

/// A gain in full scales for 1 m/s².
fn gain(per_m_s2: f64) -> String {
    if per_m_s2 > 0.0 {
        format!("{:+.1} dB re full scale per m/s²", 20.0 * per_m_s2.log10())
    } else {
        "none: silent".to_owned()
    }
}
