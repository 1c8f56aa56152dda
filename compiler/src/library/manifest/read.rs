//! Reading a manifest with all that it includes.

use super::{
    check::{Draft, Reference},
    csv_file,
    entry::{Entry, EntryLocation, Origin},
    graph::order,
    json_file,
    row::{Field, MAX_FAULTS, MAX_ROWS, Sheet, Value},
    toml_file,
    values::{Checker, PartialOptions, of_type, unknown_key},
};
use crate::sources::Registry;
use asperity_io::{
    diagnostic::Fault,
    input::{self, InputKind, Reach},
    shown::suggestion,
};
use std::{
    collections::HashMap,
    fs,
    path::{Path, PathBuf},
    sync::Arc,
};

/// A checked manifest.
#[derive(Debug, Clone)]
pub struct Manifest {
    /// The file.
    pub file: PathBuf,
    /// Its textures in ascending order of name.
    pub entries: Vec<Entry>,
    /// Model, text encoder and back end, as far as it states them.
    pub setup: Setup,
    /// Every other file that it reads: includes, imports, assets.
    pub sources: Vec<PathBuf>,
}

/// Text-to-texture setup, as far as a manifest states it.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Setup {
    /// A model folder.
    pub model: Option<PathBuf>,
    /// A text encoder, as `--text-encoder` takes it.
    pub text_encoder: Option<String>,
    /// A back end, as `--backend` takes it.
    pub backend: Option<String>,
}

/// Remedy for a file that is not what its name says.
const EXAMPLES: &str = "see the examples in docs/libraries.md";
/// Keys at the top that make a manifest a scene.
const OF_SCENES: [&str; 2] = ["servo_rate_hz", "surface"];

/// Returns true if a TOML text is a scene rather than a library: it has surfaces, or a servo rate.
#[must_use]
pub fn is_scene(text: &str) -> bool {
    match toml::de::DeTable::parse(text) {
        Ok(top) => {
            let has = |key: &&str| top.get_ref().contains_key(*key);
            OF_SCENES.iter().any(has)
        }
        // Whoever wants a scene reads of scenes.
        Err(_) => text.contains("[[surface]]") || text.contains("servo_rate_hz"),
    }
}

impl Manifest {
    /// Reads and checks a manifest; paths in it are relative to its folder.
    ///
    /// # Errors
    /// Every fault of every file, in the order of files and lines.
    pub fn read(file: &Path) -> Result<Self, Vec<Fault>> {
        let text = text(file).map_err(|error| vec![error])?;
        Self::of_text(file, &text)
    }

    /// Checks the text of a manifest, which may name any file.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn of_text(file: &Path, text: &str) -> Result<Self, Vec<Fault>> {
        Self::within(file, text, Reach::Anywhere, &Registry::default())
    }

    /// Checks the text of a manifest that may name only files within reach, and sources of a
    /// registry.
    ///
    /// # Errors
    /// As [`read`](Self::read), and every path that leads elsewhere.
    pub fn within(
        file: &Path,
        text: &str,
        reach: Reach,
        registry: &Registry,
    ) -> Result<Self, Vec<Fault>> {
        Self::checked(file, text, reach, registry, false)
    }

    /// Checks the textures of a scene; its other keys are left to whoever builds scenes.
    pub(crate) fn of_scene(
        file: &Path,
        text: &str,
        reach: Reach,
        registry: &Registry,
    ) -> Result<Self, Vec<Fault>> {
        Self::checked(file, text, reach, registry, true)
    }

    fn checked(
        file: &Path,
        text: &str,
        reach: Reach,
        registry: &Registry,
        scene: bool,
    ) -> Result<Self, Vec<Fault>> {
        let mut reader = Reader {
            reach,
            registry: registry.clone(),
            scene,
            ..Reader::default()
        };
        reader.take(file, text, &PartialOptions::default());
        reader.manifest(file)
    }
}

/// The most that the kinds of manifests may have: TOML is read with the lines of all values.
fn kind(file: &Path) -> InputKind {
    if syntax(file) == Some(Syntax::Toml) {
        InputKind::Scene
    } else {
        InputKind::Manifest
    }
}

/// Returns the fault of an unexpected top-level key.
fn top_fault(field: &Field, scene: bool) -> Fault {
    let wanted = match (field.key.as_str(), &field.value) {
        ("texture", Value::Table(_)) => {
            let what = "one table in single brackets, but a list of tables is expected";
            return Fault::new(
                what,
                "write [[texture]], in two brackets, above each texture",
            );
        }
        ("texture", _) => "a list of tables, each written [[texture]],",
        ("include", _) => "a list of manifests",
        ("defaults", _) => "one table, written [defaults],",
        _ => {
            let of_scenes: &[&str] = if scene { &OF_SCENES } else { &[] };
            let known = [&["include", "defaults", "texture"], of_scenes].concat();
            return unknown_key(field, &known);
        }
    };
    of_type(wanted, field.value.kind())
}

fn text(file: &Path) -> Result<String, Fault> {
    input::read_text(file, kind(file)).map_err(|problem| Fault::from(problem).at(file))
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Syntax {
    Toml,
    Csv,
    JsonLines,
}

fn syntax(file: &Path) -> Option<Syntax> {
    let Some(extension) = file.extension() else {
        // A pipe of the shell has a number for a name.
        return Some(Syntax::Toml);
    };
    match extension.to_str()?.to_ascii_lowercase().as_str() {
        "toml" => Some(Syntax::Toml),
        "csv" => Some(Syntax::Csv),
        "jsonl" | "ndjson" => Some(Syntax::JsonLines),
        _ => None,
    }
}

#[derive(Default)]
struct Reader {
    reach: Reach,
    registry: Registry,
    /// True if the first file is a scene.
    scene: bool,
    drafts: Vec<Draft>,
    /// Names of all rows, of those with a fault, too.
    names: Vec<(String, EntryLocation)>,
    /// Rows of all files so far.
    rows: usize,
    errors: Vec<Fault>,
    sources: Vec<PathBuf>,
    setup: Setup,
    /// Files that are being read, each including the next.
    open: Vec<PathBuf>,
    /// Files that were read.
    read: Vec<PathBuf>,
}

impl Reader {
    fn take(&mut self, file: &Path, text: &str, outer: &PartialOptions) {
        let Some(sheet) = self.sheet(file, text) else {
            return;
        };
        let first = self.open.is_empty();
        // By its own name, so that a file is known by whatever path it is reached.
        self.open
            .push(fs::canonicalize(file).unwrap_or_else(|_| file.to_owned()));
        let folder = file.parent().unwrap_or(Path::new(""));
        let location = EntryLocation {
            file: Arc::from(file),
            line: 1,
        };
        let mut checker = Checker {
            file: &location,
            folder,
            reach: &self.reach,
            errors: &mut self.errors,
            registry: &self.registry,
            columns: Vec::new(),
        };
        let scene = first && self.scene;
        for field in &sheet.wrong {
            if !(scene && OF_SCENES.contains(&field.key.as_str())) {
                checker.fault(field.line, &field.key, top_fault(field, scene));
            }
        }
        let mut stated = outer.clone();
        if let Some(row) = &sheet.defaults {
            let (own, setup) = checker.defaults(row, first);
            stated = own.within(outer);
            for (key, value) in setup {
                match key.as_str() {
                    "model" => self.setup.model = Some(folder.join(value)),
                    "text_encoder" => {
                        let encoder = match value.strip_prefix("clip:") {
                            Some(own) if !own.is_empty() => {
                                format!("clip:{}", folder.join(own).display())
                            }
                            _ => value,
                        };
                        self.setup.text_encoder = Some(encoder);
                    }
                    _ => self.setup.backend = Some(value),
                }
            }
        }
        self.rows += sheet.rows.len();
        if self.rows > MAX_ROWS {
            let what = format!("more than {MAX_ROWS} textures");
            let remedy = "split the manifest, and join the libraries with `asperity merge`";
            checker.fault(1, "", Fault::new(what, remedy));
            return;
        }
        for row in &sheet.rows {
            if checker.errors.len() > MAX_FAULTS {
                let more = Fault::new("further faults are not shown", "correct these first");
                checker.fault(row.line, "", more);
                break;
            }
            let (name, draft) = checker.row(row, &stated);
            let line = row.line;
            let location = || EntryLocation {
                line,
                ..location.clone()
            };
            self.names.extend(name.map(|name| (name, location())));
            self.drafts.extend(draft);
        }
        for field in &sheet.include {
            self.include(field, &location, folder, &stated);
        }
        self.open.pop();
    }

    fn sheet(&mut self, file: &Path, text: &str) -> Option<Sheet> {
        let mut fault = |line: usize, message: String| {
            let fault = Fault::new(message, EXAMPLES).at(file);
            self.errors.push(fault.line(line as u64));
        };
        match syntax(file) {
            Some(Syntax::Toml) => toml_file::parse(text)
                .map_err(|error| {
                    // Of a file that another one includes nothing is shown: it may be any file.
                    let shown = if self.open.is_empty() {
                        error.to_string()
                    } else {
                        error.without_text()
                    };
                    // The line stands beside the name of the file.
                    let line = format!("line {}, ", error.line);
                    fault(
                        error.line,
                        shown.strip_prefix(&line).unwrap_or(&shown).to_owned(),
                    );
                })
                .ok(),
            Some(Syntax::Csv) => csv_file::parse(text, &self.registry)
                .map_err(|(line, message)| fault(line, message))
                .ok(),
            Some(Syntax::JsonLines) => {
                let (sheet, wrong) = json_file::parse(text, &self.registry);
                wrong
                    .into_iter()
                    .for_each(|(line, message)| fault(line, message));
                Some(sheet)
            }
            None => {
                let what = "not a manifest: the name must end in .toml, .csv or .jsonl";
                self.errors.push(Fault::new(what, EXAMPLES).at(file));
                None
            }
        }
    }

    fn include(
        &mut self,
        field: &Field,
        location: &EntryLocation,
        folder: &Path,
        stated: &PartialOptions,
    ) {
        let mut checker = Checker {
            file: location,
            folder,
            reach: &self.reach,
            errors: &mut self.errors,
            registry: &self.registry,
            columns: Vec::new(),
        };
        let Value::Text(_) = field.value else {
            let fault = of_type("the path of a manifest", field.value.kind());
            checker.fault(field.line, "include", fault);
            return;
        };
        let Some(file) = checker.file(field, "include") else {
            return;
        };
        let own = fs::canonicalize(&file).unwrap_or_else(|_| file.clone());
        let shown = |path: &PathBuf| {
            path.file_name()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned()
        };
        if let Some(from) = self.open.iter().position(|open| *open == own) {
            let chain = self.open[from..].iter().chain([&own]);
            let chain: Vec<String> = chain.map(shown).collect();
            let what = format!("the manifest includes itself: {}", chain.join(" → "));
            let fault = Fault::new(what, "remove one of the includes");
            checker.fault(field.line, "include", fault);
            return;
        }
        if self.read.contains(&own) {
            let what = format!("{} is included twice", shown(&own));
            let fault = Fault::new(what, "remove one of the includes");
            checker.fault(field.line, "include", fault);
            return;
        }
        match text(&file) {
            Ok(text) => {
                self.take(&file, &text, stated);
                self.sources.push(file);
                self.read.push(own);
            }
            Err(error) => self.errors.push(error),
        }
    }

    /// Checks all textures together.
    fn manifest(mut self, file: &Path) -> Result<Manifest, Vec<Fault>> {
        let complete = self.errors.is_empty();
        let mut drafts = std::mem::take(&mut self.drafts);
        let mut names = std::mem::take(&mut self.names);
        // Stable: of two textures of one name, the first stays first.
        names.sort_by(|a, b| a.0.cmp(&b.0));
        for pair in names.windows(2) {
            if let [(first, other), (second, location)] = pair
                && first == second
            {
                let what = format!("{second:?} is also the name of the texture at {other}");
                let fault = Fault::new(what, "rename one of them");
                self.errors
                    .push(location.fault(location.line, "name", fault));
            }
        }
        drafts.sort_by(|a, b| a.name.cmp(&b.name));
        let index: HashMap<String, usize> = drafts
            .iter()
            .enumerate()
            .rev()
            .map(|(index, draft)| (draft.name.clone(), index))
            .collect();
        let mut entries = Vec::with_capacity(drafts.len());
        for draft in drafts {
            if let Some(origin) = self.resolved(draft.origin, &draft.location, &index, complete) {
                entries.push(Entry {
                    name: draft.name,
                    origin,
                    options: draft.options,
                    location: draft.location,
                });
            }
        }
        if self.errors.is_empty()
            && let Err(cycle) = order(&entries)
        {
            let names: Vec<String> = cycle
                .iter()
                .map(|&i| format!("{:?}", entries[i].name))
                .collect();
            let Entry {
                location, origin, ..
            } = &entries[cycle[0]];
            let what = format!("the texture depends on itself: {}", names.join(" → "));
            let fault = Fault::new(what, "give one of them another source");
            self.errors
                .push(location.fault(location.line, origin.key(), fault));
        }
        if entries.is_empty() && self.errors.is_empty() {
            let remedy = "add a [[texture]] with a name and a prompt";
            let fault = Fault::new("the manifest lists no texture", remedy);
            self.errors.push(fault.at(file));
        }
        if self.errors.is_empty() {
            Ok(Manifest {
                file: file.to_owned(),
                entries,
                setup: self.setup,
                sources: self.sources,
            })
        } else {
            self.errors
                .sort_by(|a, b| (&a.file, a.line).cmp(&(&b.file, b.line)));
            Err(self.errors)
        }
    }

    /// The source with indices for names. Where rows were left out because of faults, a name may
    /// be one of theirs and is not called missing.
    fn resolved(
        &mut self,
        origin: Origin<Reference>,
        location: &EntryLocation,
        index: &HashMap<String, usize>,
        complete: bool,
    ) -> Option<Origin> {
        if let Origin::Source { source, .. } = &origin {
            self.sources.extend(source.inputs());
        }
        origin.try_map(|reference| {
            let found = index.get(&reference.name).copied();
            if found.is_none() && complete {
                let names = index.keys().map(String::as_str);
                let what = format!("no texture {:?} in this manifest", reference.name);
                let fault = Fault::new(what, "add it, or correct the name")
                    .suggest(suggestion(&reference.name, names));
                self.errors
                    .push(location.fault(reference.line, reference.key, fault));
            }
            found
        })
    }
}
