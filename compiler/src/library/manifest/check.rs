//! The check of one row by itself. It goes on after a fault, so that all are told at once.

use super::{
    entry::{Options, Place},
    error::ManifestProblem,
    row::{Field, Row, Value},
    values::{Checker, OPTIONS, Stated},
};
use crate::{passes::reduce::Fidelity, pipeline::Request, sources::prompt, views::preview};
use asperity_formats::limits::MAX_NAME_BYTES;
use asperity_io::input::{self, InputProblem, Kind};
use std::{fs, io, path::PathBuf};

/// Keys of a texture's source.
const ORIGINS: [&str; 6] = ["prompt", "import", "asset", "of", "blend", "compose"];
/// Keys of a texture besides its source and its options.
const OWN: [&str; 2] = ["name", "texture"];
/// Keys of the defaults besides the options.
const SETUP: [&str; 3] = ["model", "text_encoder", "backend"];

/// Whether a texture has such a key, also in one of its tables.
pub(super) fn is_key(key: &str) -> bool {
    let own = key.split('.').next().unwrap_or(key);
    OWN.contains(&own) || ORIGINS.contains(&own) || OPTIONS.contains(&own)
}

/// A row whose references to other textures are names yet.
pub(super) struct Draft {
    pub(super) name: String,
    pub(super) origin: DraftOrigin,
    pub(super) options: Options,
    pub(super) place: Place,
}

/// A source whose references are names, with the lines where they stand.
pub(super) enum DraftOrigin {
    Prompt(String),
    Import(PathBuf),
    Asset {
        file: PathBuf,
        texture: Option<String>,
    },
    Of(Reference),
    Blend {
        a: Reference,
        b: Reference,
        t: f64,
    },
    Compose {
        tap: Reference,
        slide: Reference,
        friction: Reference,
    },
}

/// A texture by name.
#[derive(Clone)]
pub(super) struct Reference {
    pub(super) name: String,
    pub(super) key: &'static str,
    pub(super) line: usize,
}

impl Checker<'_> {
    /// The options of `[defaults]`, and what only the first file may state: model, text encoder,
    /// back end.
    pub(super) fn defaults(&mut self, row: &Row, first: bool) -> (Stated, Vec<(String, String)>) {
        let mut stated = Stated::default();
        let mut setup = Vec::new();
        for field in &row.fields {
            if self.option(field, row.untyped, &mut stated) {
                continue;
            }
            if first && SETUP.contains(&field.key.as_str()) {
                if let Some(text) = self.text(field, &field.key) {
                    let key = format!("defaults.{}", field.key);
                    let folder = match field.key.as_str() {
                        "model" => Some(text),
                        _ => text.strip_prefix("clip:"),
                    };
                    if folder.is_none_or(|folder| self.reaches(field, &key, folder, true)) {
                        setup.push((field.key.clone(), text.to_owned()));
                    }
                }
            } else {
                let setup: &[&str] = if first { &SETUP } else { &[] };
                self.unknown(field, "defaults.", &[&OPTIONS, setup].concat());
            }
        }
        (stated, setup)
    }

    /// The name of one row, where it has one, and its texture, unless a fault keeps it from being one.
    pub(super) fn row(&mut self, row: &Row, defaults: &Stated) -> (Option<String>, Option<Draft>) {
        let before = self.errors.len();
        let mut stated = Stated::default();
        let mut sources = Vec::new();
        let mut name = None;
        for field in &row.fields {
            if self.option(field, row.untyped, &mut stated) {
                continue;
            }
            match field.key.as_str() {
                "name" => name = Some(field),
                // It goes with `asset`, and is checked there.
                "texture" => {}
                key if ORIGINS.contains(&key) => sources.push(field),
                _ => {
                    self.unknown(field, "", &[&OWN[..], &ORIGINS, &OPTIONS].concat());
                }
            }
        }
        let origin = match sources[..] {
            [source] => self.origin(source, row),
            [] => {
                let found = "nothing that it is made of".into();
                self.fault(row.line, "", ManifestProblem::Origin { found });
                None
            }
            _ => {
                let found: Vec<&str> = sources.iter().map(|f| f.key.as_str()).collect();
                let found = found.join(" and ");
                self.fault(sources[1].line, "", ManifestProblem::Origin { found });
                None
            }
        };
        let name = self.name(name, origin.as_ref(), row.line);
        if let Some(origin) = &origin {
            self.placed(row, origin);
        }
        let (Some(origin), Some(named), true) = (origin, &name, self.errors.len() == before) else {
            return (name, None);
        };
        let options = options(&stated.within(defaults), &stated, &origin);
        let place = Place {
            file: self.file.file.clone(),
            line: row.line,
        };
        let draft = Draft {
            name: named.clone(),
            origin,
            options,
            place,
        };
        (name, Some(draft))
    }

    /// The name, or else what the prompt begins with.
    fn name(
        &mut self,
        field: Option<&Field>,
        origin: Option<&DraftOrigin>,
        line: usize,
    ) -> Option<String> {
        let (name, line) = match (field, origin) {
            (Some(field), _) => (self.text(field, "name")?.to_owned(), field.line),
            (None, Some(DraftOrigin::Prompt(prompt))) => (title(prompt), line),
            (None, Some(_)) => (String::new(), line),
            // The missing source is reported.
            (None, None) => return None,
        };
        let fits =
            !name.is_empty() && name.len() <= MAX_NAME_BYTES && !name.chars().any(char::is_control);
        if !fits {
            self.fault(line, "name", ManifestProblem::Name(name));
            return None;
        }
        Some(name)
    }

    fn origin(&mut self, field: &Field, row: &Row) -> Option<DraftOrigin> {
        match field.key.as_str() {
            "prompt" => {
                let text = self.text(field, "prompt")?;
                if prompt::check(text).is_err() {
                    self.fault(field.line, "prompt", ManifestProblem::EmptyPrompt);
                    return None;
                }
                Some(DraftOrigin::Prompt(text.trim().to_owned()))
            }
            "import" => {
                let file = self.file(field, "import")?;
                let known = file.extension().is_some_and(|extension| {
                    extension.eq_ignore_ascii_case("xml") || extension.eq_ignore_ascii_case("json")
                });
                if !known {
                    // What it really is helps more than how its name ends.
                    if let Err(problem) = input::read(&file, Kind::Model) {
                        let problem = ManifestProblem::File { file, problem };
                        self.fault(field.line, "import", problem);
                        return None;
                    }
                    let wanted = "a HaTT material (.xml) or a model (.json)".into();
                    return self.wrong_value(
                        field.line,
                        "import",
                        wanted,
                        file.display().to_string(),
                    );
                }
                Some(DraftOrigin::Import(file))
            }
            "asset" => {
                let file = self.file(field, "asset")?;
                let texture = row.fields.iter().find(|field| field.key == "texture");
                let texture = match texture {
                    Some(field) => Some(self.text(field, "texture")?.to_owned()),
                    None => None,
                };
                Some(DraftOrigin::Asset { file, texture })
            }
            "of" => Some(DraftOrigin::Of(Reference {
                name: self.text(field, "of")?.to_owned(),
                key: "of",
                line: field.line,
            })),
            "blend" => {
                let inner = self.table(field, "blend", &["a", "b", "t"])?;
                let a = self.reference(inner, "blend.a", field.line);
                let b = self.reference(inner, "blend.b", field.line);
                let t = match inner.iter().find(|inner| inner.key == "t") {
                    Some(t) => self.number(t, "blend.t", (0.0, 1.0), row.untyped),
                    None => Some(0.5),
                };
                Some(DraftOrigin::Blend {
                    a: a?,
                    b: b?,
                    t: t?,
                })
            }
            _ => {
                let inner = self.table(field, "compose", &["tap", "slide", "friction"])?;
                let tap = self.reference(inner, "compose.tap", field.line);
                let slide = self.reference(inner, "compose.slide", field.line);
                let friction = match inner.iter().any(|inner| inner.key == "friction") {
                    true => self.reference(inner, "compose.friction", field.line),
                    // What is slid on decides how slippery it is.
                    false => slide.clone(),
                };
                Some(DraftOrigin::Compose {
                    tap: tap?,
                    slide: slide?,
                    friction: friction?,
                })
            }
        }
    }

    fn table<'v>(&mut self, field: &'v Field, key: &str, known: &[&str]) -> Option<&'v [Field]> {
        let Value::Table(inner) = &field.value else {
            return self.wrong_type(field.line, key, "a table", &field.value);
        };
        for stranger in inner
            .iter()
            .filter(|inner| !known.contains(&inner.key.as_str()))
        {
            self.unknown(stranger, &format!("{key}."), known);
        }
        Some(inner)
    }

    fn reference(&mut self, inner: &[Field], key: &'static str, line: usize) -> Option<Reference> {
        let own = key.rsplit('.').next().unwrap_or(key);
        let Some(field) = inner.iter().find(|inner| inner.key == own) else {
            self.fault(
                line,
                key,
                ManifestProblem::Type {
                    wanted: "the name of a texture",
                    found: "nothing",
                },
            );
            return None;
        };
        let name = self.text(field, key)?.to_owned();
        Some(Reference {
            name,
            key,
            line: field.line,
        })
    }

    /// A file that is there; paths are relative to the manifest.
    pub(super) fn file(&mut self, field: &Field, key: &str) -> Option<PathBuf> {
        let stated = self.text(field, key)?;
        if !self.reaches(field, key, stated, false) {
            return None;
        }
        let file = self.folder.join(stated);
        let problem = match fs::metadata(&file) {
            Ok(found) if found.is_file() => return Some(file),
            Ok(found) if found.is_dir() => InputProblem::Folder,
            // A pipe gives its bytes once, and a key needs them before.
            Ok(_) => InputProblem::Device,
            Err(error) => InputProblem::Unreadable(match error.kind() {
                io::ErrorKind::NotFound => io::ErrorKind::NotFound.into(),
                _ => error,
            }),
        };
        self.fault(field.line, key, ManifestProblem::File { file, problem });
        None
    }

    /// Refuses keys of a row that its source does not take.
    fn placed(&mut self, row: &Row, origin: &DraftOrigin) {
        let (name, refused): (_, &[&str]) = match origin {
            DraftOrigin::Prompt(_) => ("prompt", &["texture"]),
            DraftOrigin::Import(_) => ("import", &["texture", "seed", "edit"]),
            // It is taken as it is.
            DraftOrigin::Asset { .. } => ("asset", &OPTIONS),
            DraftOrigin::Of(_) => ("of", &["texture", "seed"]),
            DraftOrigin::Blend { .. } => ("blend", &["texture", "seed"]),
            DraftOrigin::Compose { .. } => ("compose", &["texture", "seed"]),
        };
        for field in &row.fields {
            if refused.contains(&field.key.as_str()) {
                let problem = ManifestProblem::Misplaced { origin: name };
                self.fault(field.line, &field.key, problem);
            }
        }
    }
}

/// What is not stated is as the commands have it. Edits and seeds of the defaults go to the
/// textures that can have them.
fn options(stated: &Stated, own: &Stated, origin: &DraftOrigin) -> Options {
    let asset = matches!(origin, DraftOrigin::Asset { .. });
    let import = matches!(origin, DraftOrigin::Import(_));
    let prompt = matches!(origin, DraftOrigin::Prompt(_));
    let stated = if asset { own } else { stated };
    Options {
        seed: stated.seed.filter(|_| prompt).unwrap_or(0),
        request: Request {
            fidelity: stated.fidelity.unwrap_or(if import {
                Fidelity::Full
            } else {
                Fidelity::Auto
            }),
            rate_hz: stated.rate_hz,
            preview_px: match stated.preview_px {
                None => (!import).then_some(preview::SIZE),
                Some(0) => None,
                size => size,
            },
            loudness_db: stated.loudness_db,
            ..Request::default()
        },
        edit: stated.edit.clone().filter(|_| !import).unwrap_or_default(),
    }
}

/// What a prompt begins with, as a name.
fn title(prompt: &str) -> String {
    let plain = prompt.replace(char::is_control, " ");
    let words: Vec<&str> = plain.split_whitespace().collect();
    let words = words.join(" ");
    let mut end = words.len().min(MAX_NAME_BYTES);
    while !words.is_char_boundary(end) {
        end -= 1;
    }
    words[..end].trim_end().to_owned()
}
