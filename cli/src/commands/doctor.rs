//! `asperity doctor`.

use crate::cli::Doctor;
use asperity::learned::{
    LearnedModel, Present, embedded,
    inference::{Backend, BackendName, not_installed},
    text::{TextEncoder, TextEncoderChoice},
};
use asperity_console::Console;
use asperity_io::{
    diagnostic::{Failures, Fault, one},
    realtime::{self, Setting},
    shown::size,
};
use serde::Serialize;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Result of a single check, with a remedy if it failed.
#[derive(Serialize)]
struct Finding {
    #[serde(skip)]
    what: &'static str,
    found: bool,
    detail: String,
    remedy: Option<String>,
}

pub(crate) fn run(args: &Doctor, console: Console) -> Result<(), Failures> {
    let findings = findings(args);
    // Only what was asked for by an option is a failure when it is missing.
    let asked = |finding: &Finding| match finding.what {
        "onnxruntime" => args.inference.backend == BackendName::OnnxRuntime,
        "clip" => matches!(args.inference.text_encoder, TextEncoderChoice::Clip(_)),
        _ => true,
    };
    let settings = realtime::settings(None);
    let printed = if args.json {
        console.json(&as_json(&findings, &settings))
    } else {
        console.text(&as_text(&findings, &settings))
    };
    printed.map_err(one)?;
    match findings.iter().find(|f| !f.found && asked(f)) {
        Some(missing) => {
            let remedy = missing.remedy.clone().unwrap_or_default();
            Err(one(Fault::new(&missing.detail, remedy).field(missing.what)))
        }
        None => Ok(()),
    }
}

/// A text for encoders to try.
const PROBE: &str = "surface";

/// Runs every network once: a file that is there may be cut off, or of another model.
fn runs(model: &LearnedModel) -> Result<(), Fault> {
    let description = model.description();
    let width = description.text_encoder.width;
    let vector = vec![1.0 / (width as f32).sqrt(); width];
    let z = model.project(&vector)?.z;
    let taps = model.decode_taps(&z)?;
    model.encode(Present::Taps(&taps)).map(drop)
}

fn findings(args: &Doctor) -> Vec<Finding> {
    let (encoder_bytes, model_bytes) = embedded::sizes();
    let program = format!(
        "{} ({}, {})",
        env!("CARGO_PKG_VERSION"),
        std::env::consts::ARCH,
        std::env::consts::OS
    );
    let mut findings = vec![check("asperity", Ok(program))];
    findings.push(check(
        "minilm",
        embedded::text_encoder(&Backend::Portable)
            .map_err(|error| error.to_string())
            .and_then(|encoder| encoder.encode(PROBE).map_err(|error| error.to_string()))
            .map(|_| {
                format!(
                    "all-MiniLM-L6-v2, int8 weights, embedded, {}",
                    size(encoder_bytes as u64)
                )
            })
            .map_err(|error| (error, "reinstall or rebuild asperity".to_owned())),
    ));
    let model = args
        .inference
        .setup()
        .model(&Backend::Portable)
        .and_then(|model| {
            runs(&model).map_err(one)?;
            Ok(model)
        });
    findings.push(check(
        "model",
        model
            .map(|model| {
                let description = model.description();
                format!(
                    "{}, {} materials of the {} corpus, text encoder {} ({}), {}",
                    description.name,
                    description.anchors.len(),
                    description.corpus.name,
                    description.text_encoder.name,
                    description.text_encoder.width,
                    args.inference.model.as_ref().map_or_else(
                        || format!("embedded, {}", size(model_bytes as u64)),
                        |folder| folder.display().to_string()
                    )
                )
            })
            .map_err(told),
    ));
    let portable = "built in, the same bits on every machine";
    findings.push(check("portable", Ok(portable.into())));
    findings.push(check(
        "onnxruntime",
        asperity_onnxruntime::discover()
            .map(|discovery| discovery.to_string())
            .map_err(|error| (error.to_string(), not_installed(error).remedy.into())),
    ));
    findings.push(clip(args));
    findings
}

fn clip(args: &Doctor) -> Finding {
    let TextEncoderChoice::Clip(folder) = &args.inference.text_encoder else {
        let remedy = "optional: export the text tower of CLIP ViT-B/32 to DIR/text_model.onnx, train \
             a projection with asperity-train fit --text-encoder clip:DIR, then give both \
             with --text-encoder clip:DIR --model MODEL";
        return check("clip", Err(("no folder given".into(), remedy.into())));
    };
    let opened = Backend::open(args.inference.backend)
        .map_err(|error| one(not_installed(error)))
        .and_then(|backend| args.inference.setup().text_encoder(&backend));
    check(
        "clip",
        opened
            .map(|encoder| format!("{}, width {}", folder.display(), encoder.width()))
            .map_err(told),
    )
}

fn told(failures: Failures) -> (String, String) {
    failures.first().map_or_else(Default::default, |failure| {
        (failure.to_string(), failure.remedy())
    })
}

fn check(what: &'static str, result: Result<String, (String, String)>) -> Finding {
    let found = result.is_ok();
    let (detail, remedy) = match result {
        Ok(detail) => (detail, None),
        Err((detail, remedy)) => (detail, Some(remedy)),
    };
    Finding {
        what,
        found,
        detail,
        remedy,
    }
}

fn as_text(findings: &[Finding], settings: &[Setting]) -> String {
    let mut text = String::new();
    for finding in findings {
        let mark = if finding.found { "found" } else { "—" };
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{:<12} {mark:<6} {}", finding.what, finding.detail);
        if let Some(remedy) = &finding.remedy {
            let _ = writeln!(text, "{:<19} {remedy}", "");
        }
    }
    if !settings.is_empty() {
        text += "\nThis machine for servo loops (asperity-lab), and how to change it:\n";
        text += &realtime::table(settings);
    }
    text
}

fn as_json(findings: &[Finding], settings: &[Setting]) -> Value {
    let mut entries: serde_json::Map<String, Value> = findings
        .iter()
        .map(|finding| (finding.what.to_owned(), json!(finding)))
        .collect();
    let suited = settings.iter().filter(|setting| setting.good == Some(true));
    let machine = json!({
        "found": !settings.is_empty(),
        "detail": format!("{} of {} settings suit a servo loop", suited.count(), settings.len()),
        "remedy": null,
        "settings": settings,
    });
    entries.insert("realtime".to_owned(), machine);
    Value::Object(entries)
}
