//! The check of one row by itself. It goes on after a fault, so that all faults are reported at once.

use super::{
    entry::{EntryLocation, Options, Origin},
    missing::{is_error, is_nothing},
    row::{Field, ManifestRow, Value},
    values::{Checker, OPTIONS, PartialOptions, of_type},
};
use crate::{
    name,
    passes::reduce::Fidelity,
    pipeline::Request,
    sources::{self, Operand, Registry, SourceKind, prompt::title},
    views::preview,
};
use asperity_io::{
    diagnostic::Fault,
    input::{InputError, InputProblem},
    shown::suggestion,
};
use std::{borrow::Cow, fs, io, path::PathBuf};

/// Keys of what a texture is made of, where those are other textures.
const OTHERS: [&str; 3] = ["of", "blend", "compose"];
/// Keys of a texture besides its source and its options.
const OWN: [&str; 2] = ["name", "texture"];
/// Keys of the defaults besides the options.
const SETUP: [&str; 3] = ["model", "text_encoder", "backend"];

/// Returns true if a texture has such a key, also in one of its tables.
pub(super) fn is_key(key: &str, registry: &Registry) -> bool {
    let own = key.split('.').next().unwrap_or(key);
    OWN.contains(&own)
        || is_origin(own, registry)
        || OPTIONS.contains(&own)
        || registry.options().any(|option| option == own)
}

/// A key as it is written here: those of spreadsheets begin with a capital.
pub(super) fn own_key<'k>(key: &'k str, registry: &Registry) -> Cow<'k, str> {
    let small = key.to_ascii_lowercase();
    if !is_key(key, registry) && is_key(&small, registry) {
        small.into()
    } else {
        key.into()
    }
}

fn is_origin(key: &str, registry: &Registry) -> bool {
    OTHERS.contains(&key) || registry.get(key).is_some()
}

/// A row whose references to other textures are names yet.
pub(super) struct Draft {
    pub(super) name: String,
    pub(super) origin: Origin<Reference>,
    pub(super) options: Options,
    pub(super) location: EntryLocation,
}

/// A texture by name, with the line where it stands.
#[derive(Clone)]
pub(super) struct Reference {
    pub(super) name: String,
    pub(super) key: &'static str,
    pub(super) line: usize,
}

impl Checker<'_> {
    /// The options of `[defaults]`, and what only the first file may state: model, text encoder,
    /// back end.
    pub(super) fn defaults(
        &mut self,
        row: &ManifestRow,
        first: bool,
    ) -> (PartialOptions, Vec<(String, String)>) {
        let mut stated = PartialOptions::default();
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
                let options: Vec<_> = self.registry.options().collect();
                self.unknown(field, "defaults.", &[&OPTIONS, setup, &options].concat());
            }
        }
        (stated, setup)
    }

    /// The name of one row, where it has one, and its texture, unless a fault keeps it from being one.
    pub(super) fn row(
        &mut self,
        row: &ManifestRow,
        defaults: &PartialOptions,
    ) -> (Option<String>, Option<Draft>) {
        let before = self.errors.len();
        let mut stated = PartialOptions::default();
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
                key if is_origin(key, self.registry) => sources.push(field),
                // A column that is misspelt is so in every row.
                key if row.untyped && self.columns.iter().any(|known| known == key) => {}
                key => {
                    let mut origins = self.origins();
                    origins.extend(self.registry.options());
                    self.unknown(field, "", &[&OWN[..], &origins, &OPTIONS].concat());
                    if row.untyped {
                        self.columns.push(key.to_owned());
                    }
                }
            }
        }
        let all = stated.within(defaults);
        let origin = match sources[..] {
            [source] => self.origin(source, row, &all),
            // It is there, and reported as a key that is misspelt.
            [] if self.has_misspelt_origin(row) => None,
            [] => {
                self.wrong_origin(row.line, "no source");
                None
            }
            _ => {
                let found: Vec<&str> = sources.iter().map(|f| f.key.as_str()).collect();
                self.wrong_origin(sources[1].line, &found.join(" and "));
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
        let options = options(&all, &self.source_defaults(&origin));
        let location = EntryLocation {
            file: self.file.file.clone(),
            line: row.line,
        };
        let draft = Draft {
            name: named.clone(),
            origin,
            options,
            location,
        };
        (name, Some(draft))
    }

    /// The name, or else what the prompt begins with.
    fn name(
        &mut self,
        field: Option<&Field>,
        origin: Option<&Origin<Reference>>,
        line: usize,
    ) -> Option<String> {
        let (name, line) = match (field, origin) {
            (Some(field), _) => (self.text(field, "name")?.to_owned(), field.line),
            (None, Some(Origin::Source { source, .. })) => {
                (source.prompt().map_or_else(String::new, title), line)
            }
            (None, Some(_)) => (String::new(), line),
            // The missing source is reported.
            (None, None) => return None,
        };
        if !name::fits(&name) {
            let fault = match field {
                Some(_) => name::invalid(&name),
                None => Fault::new("the texture has no name", "give it a `name`"),
            };
            self.fault(line, "name", fault);
            return None;
        }
        // NA and None may be names; these are what scripts print.
        let is_printed = ["nan", "null", "undefined"].contains(&name.to_lowercase().as_str());
        if is_printed || is_error(&name) {
            return self.nothing(line, "name", "name", &name);
        }
        Some(name)
    }

    /// Reports a text that stands for none.
    fn nothing<T>(&mut self, line: usize, key: &str, wanted: &str, text: &str) -> Option<T> {
        let what = format!(
            "{text:?} is no {wanted}, but what a table has for a cell without a value, or with an error"
        );
        let remedy = format!("write a {wanted}, or remove the row");
        self.fault(line, key, Fault::new(what, remedy));
        None
    }

    /// Returns true if an unknown key looks like a misspelt origin.
    fn has_misspelt_origin(&self, row: &ManifestRow) -> bool {
        let mut strangers = row
            .fields
            .iter()
            .filter(|field| !is_key(&field.key, self.registry));
        strangers.any(|field| suggestion(&field.key, self.origins()).is_some())
    }

    /// All keys of what a texture is made of.
    fn origins(&self) -> Vec<&'static str> {
        self.registry.keys().chain(OTHERS).collect()
    }

    /// Reports a row without a source, or with several.
    fn wrong_origin(&mut self, line: usize, found: &str) {
        let origins = self.origins();
        let known = match origins.split_last() {
            Some((last, others)) => format!("{} and {last}", others.join(", ")),
            None => String::new(),
        };
        let what = format!("{found}; a texture has one of {known}");
        let remedy = "give every texture exactly one source";
        self.fault(line, "", Fault::new(what, remedy));
    }

    /// A source that the registry knows.
    fn source(
        &mut self,
        kind: SourceKind,
        field: &Field,
        row: &ManifestRow,
        all: &PartialOptions,
    ) -> Option<Origin<Reference>> {
        let key = kind.key;
        let text = self.text(field, key)?;
        if kind.operand == Operand::Text && is_nothing(text) {
            return self.nothing(field.line, key, "prompt", text);
        }
        let mut texture = None;
        if let Some(field) = row.fields.iter().find(|field| field.key == "texture") {
            texture = Some(self.text(field, "texture")?);
        }
        let path = match kind.operand {
            Operand::Text => PathBuf::new(),
            Operand::Folder => self.path(field, key, text, true)?,
            Operand::Path => {
                let is_folder = self.folder.join(text).is_dir();
                self.path(field, key, text, is_folder)?
            }
            // Nothing is asked about a path that the manifest may not name.
            Operand::File if !self.reaches(field, key, text, false) => return None,
            Operand::File => match text.rsplit_once('#') {
                // A file whose name holds a `#` is that file.
                Some((file, of))
                    if !kind.refuses.contains(&"texture")
                        && texture.is_none()
                        && !self.folder.join(text).exists() =>
                {
                    texture = Some(of);
                    self.path(field, key, file, false)?
                }
                _ => self.path(field, key, text, false)?,
            },
        };
        let stated = |key: &&'static str| {
            let field = all.own.iter().find(|field| field.key == **key)?;
            Some((*key, field.value.shown().trim().to_owned()))
        };
        let own: Vec<_> = kind.options.iter().filter_map(stated).collect();
        let entry = sources::SourceEntry {
            text,
            path: &path,
            texture,
            options: &own,
            seed: all
                .seed
                .filter(|_| !kind.refuses.contains(&"seed"))
                .unwrap_or(0),
        };
        match (kind.open)(&entry) {
            Ok(source) => Some(Origin::Source { key, source }),
            Err(failure) => {
                let fault = Fault::new(&failure, failure.remedy());
                self.fault(field.line, key, fault);
                None
            }
        }
    }

    fn origin(
        &mut self,
        field: &Field,
        row: &ManifestRow,
        all: &PartialOptions,
    ) -> Option<Origin<Reference>> {
        if let Some(kind) = self.registry.get(&field.key) {
            return self.source(*kind, field, row, all);
        }
        match field.key.as_str() {
            "of" => Some(Origin::Of(Reference {
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
                Some(Origin::Blend {
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
                Some(Origin::Compose {
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
            self.fault(line, key, of_type("the name of a texture", "missing"));
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
        self.path(field, key, stated, false)
    }

    fn path(&mut self, field: &Field, key: &str, stated: &str, folder: bool) -> Option<PathBuf> {
        if !self.reaches(field, key, stated, folder) {
            return None;
        }
        let file = self.folder.join(stated);
        let problem = match fs::metadata(&file) {
            Ok(found) if folder && found.is_dir() => return Some(file),
            Ok(_) if folder => return self.wrong_type(field.line, key, "a folder", &field.value),
            Ok(found) if found.is_file() => return Some(file),
            Ok(found) if found.is_dir() => InputProblem::Folder,
            // A pipe gives its bytes once, and a key needs them before.
            Ok(_) => InputProblem::Device,
            Err(error) => unreadable(error),
        };
        let fault = Fault::of(&InputError { file, problem });
        self.fault(field.line, key, fault);
        None
    }

    /// The key of a source, and how a texture of it may be made.
    fn source_defaults(&self, origin: &Origin<Reference>) -> SourceDefaults {
        let key = origin.key();
        match self.registry.get(key) {
            Some(kind) => SourceDefaults {
                key,
                refuses: kind.refuses,
                fidelity: kind.fidelity,
                preview: kind.preview,
            },
            None => SourceDefaults {
                key,
                refuses: &["texture", "seed"],
                fidelity: Fidelity::Auto,
                preview: true,
            },
        }
    }

    /// Refuses keys of a row that its source does not take.
    fn placed(&mut self, row: &ManifestRow, origin: &Origin<Reference>) {
        let SourceDefaults { key, refuses, .. } = self.source_defaults(origin);
        let own = self.registry.get(key).map_or(&[][..], |kind| kind.options);
        let strange = |field: &str| {
            !own.contains(&field) && self.registry.options().any(|option| option == field)
        };
        for field in &row.fields {
            if refuses.contains(&field.key.as_str()) || strange(&field.key) {
                self.misplaced(field.line, &field.key, key);
            }
        }
    }
}

/// Defaults of a source, and the keys that it refuses.
struct SourceDefaults {
    key: &'static str,
    refuses: &'static [&'static str],
    fidelity: Fidelity,
    preview: bool,
}

fn unreadable(error: io::Error) -> InputProblem {
    InputProblem::Unreadable(match error.kind() {
        io::ErrorKind::NotFound => io::ErrorKind::NotFound.into(),
        _ => error,
    })
}

/// Fills in the defaults of the commands. Options of `[defaults]` apply to the textures that can have them.
fn options(stated: &PartialOptions, of: &SourceDefaults) -> Options {
    let takes = |key: &str| !of.refuses.contains(&key);
    let fidelity = stated.fidelity.filter(|_| takes("fidelity"));
    Options {
        keeps_fidelity: fidelity.is_some(),
        request: Request {
            name: None,
            fidelity: fidelity.unwrap_or(of.fidelity),
            rate_hz: stated.rate_hz.filter(|_| takes("rate")),
            servo_rate_hz: None,
            preview_px: match stated.preview_px.filter(|_| takes("preview")) {
                None => of.preview.then_some(preview::SIZE),
                Some(0) => None,
                size => size,
            },
            loudness_db: stated.loudness_db.filter(|_| takes("loudness")),
        },
        edit: stated
            .edit
            .clone()
            .filter(|_| takes("edit"))
            .unwrap_or_default(),
    }
}
