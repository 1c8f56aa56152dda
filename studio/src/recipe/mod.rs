//! Provenance of a texture, and the commands that reproduce its bytes.

mod link;
#[cfg(test)]
mod tests;
mod words;

use asperity::sources::latents::Edit;
use asperity_io::{output::FileNames, shown::shell_word};
use serde::{Deserialize, Serialize};
use std::{collections::HashMap, path::Path, sync::Arc};
use words::{options, path_word, quoted};

pub(crate) use link::Link;

/// Steps that are remembered: more are no command that anyone would copy.
const MOST: usize = 64;

/// Steps from prompts and files to a texture; each after those that it takes textures of. The last one gives the
/// texture itself.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct Recipe(Vec<Arc<Step>>);

/// A step, which gives one texture.
#[derive(Serialize, Deserialize)]
struct Step {
    /// Identifier of its texture's bytes.
    id: String,
    /// The name of its texture.
    name: String,
    operation: Operation,
}

/// A file that commands find where the user has it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Opened {
    /// Its path, or its name alone where it was dropped on the page.
    pub(crate) path: String,
    /// Identifier that distinguishes it from others of this path.
    pub(crate) id: String,
}

/// Operation of a step. Other textures are named by the identifiers of their bytes.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) enum Operation {
    /// A file holds the texture.
    File(Opened),
    /// `asperity import`, of a file as `hatt` or another kind
    Import {
        kind: String,
        file: Opened,
        /// The rest of the command line, from a space on.
        options: String,
    },
    /// `asperity extract`
    Extract { library: Opened, texture: String },
    /// `asperity build` of a list, and `asperity extract` from the library that it writes
    Build { list: Opened, texture: String },
    /// `asperity compile`
    Compile { prompt: String, seed: u64 },
    /// `asperity edit`; a draft of it, or of a blend, has no picture
    Edit {
        texture: String,
        edit: Edit,
        draft: bool,
    },
    /// `asperity blend`
    Blend {
        a: String,
        b: String,
        t: f64,
        draft: bool,
    },
    /// `asperity compose`
    Compose {
        tap: String,
        slide: String,
        friction: String,
    },
    /// `asperity encode`
    Encode { texture: String },
}

impl Recipe {
    /// The recipe of a texture that is made of others. `None` where one of those has none, for what no command line can
    /// hold, and for very many steps.
    pub(crate) fn new<'a>(
        others: impl IntoIterator<Item = Option<&'a Self>>,
        id: &str,
        name: &str,
        operation: Operation,
    ) -> Option<Self> {
        let mut steps: Vec<Arc<Step>> = Vec::new();
        for other in others {
            for step in &other?.0 {
                if !steps.iter().any(|known| known.id == step.id) {
                    steps.push(Arc::clone(step));
                }
            }
        }
        // The same bytes came before: how they did is shorter.
        if let Some(at) = steps.iter().position(|step| step.id == id) {
            steps.truncate(at + 1);
            return Some(Self(steps));
        }
        if steps.len() == MOST || !operation.is_sayable() {
            return None;
        }
        steps.push(Arc::new(Step {
            id: id.to_owned(),
            name: name.to_owned(),
            operation,
        }));
        Some(Self(steps))
    }

    /// The file that the last command writes, by its name alone.
    pub(crate) fn file(&self) -> Option<String> {
        let last = self.0.last()?;
        match &last.operation {
            Operation::File(opened) => {
                let stem = opened.asset_stem()?;
                FileNames::of(&[stem], "asp").files.pop()
            }
            _ => self.files().remove(last.id.as_str()),
        }
    }

    /// The commands, one a line, for a POSIX shell. `None` where a file holds the texture already, and where two files
    /// have the same path.
    pub(crate) fn command(&self) -> Option<String> {
        let opened = || self.0.iter().filter_map(|step| step.operation.opened());
        let ambiguous = |file: &Opened| opened().any(|o| o.path == file.path && o.id != file.id);
        if opened().any(ambiguous) {
            return None;
        }
        let files = self.files();
        let mut lines = Vec::new();
        for step in &self.0 {
            // Several textures may come from one list.
            let build = step.operation.build().filter(|line| !lines.contains(line));
            lines.extend(build.into_iter().chain(step.line(&files)));
        }
        let writes = !matches!(self.0.last()?.operation, Operation::File(_));
        writes.then(|| lines.join("\n"))
    }

    /// The file of each step: where it lies, or to which the step writes it. All differ.
    fn files(&self) -> HashMap<&str, String> {
        let opened = self.0.iter().filter_map(|step| step.operation.opened());
        let mut names: Vec<&str> = opened.filter_map(Opened::asset_stem).collect();
        let taken = names.len();
        let written = || {
            let steps = self.0.iter();
            steps.filter(|step| !matches!(step.operation, Operation::File(_)))
        };
        names.extend(written().map(|step| step.name.as_str()));
        let outputs = FileNames::of(&names, "asp").files.into_iter().skip(taken);
        let outputs = written().map(|step| step.id.as_str()).zip(outputs);
        let found = self.0.iter().filter_map(|step| match &step.operation {
            Operation::File(opened) => Some((step.id.as_str(), opened.path.clone())),
            _ => None,
        });
        found.chain(outputs).collect()
    }
}

impl Step {
    /// The command of this step, where these are the files of the textures.
    fn line(&self, files: &HashMap<&str, String>) -> Option<String> {
        // Each step comes after those that it takes textures of.
        let file = |id: &str| path_word(files.get(id).map_or("", String::as_str)).into_owned();
        let to = format!("-o {}", file(&self.id));
        Some(match &self.operation {
            Operation::File(_) => return None,
            Operation::Import {
                kind,
                file,
                options,
            } => format!(
                "asperity import {kind} {}{options} {to}",
                path_word(&file.path)
            ),
            Operation::Extract { library, texture } => extract(&library.path, texture, &to),
            Operation::Build { list, texture } => extract(&list.library(), texture, &to),
            Operation::Compile { prompt, seed } => {
                let seed = match seed {
                    0 => String::new(),
                    _ => format!(" --seed {seed}"),
                };
                let quoted = quoted(prompt);
                if prompt.starts_with('-') {
                    // What begins with a dash is no prompt unless options have ended.
                    format!("asperity compile {to}{seed} -- {quoted}")
                } else {
                    format!("asperity compile {quoted} {to}{seed}")
                }
            }
            Operation::Edit {
                texture,
                edit,
                draft,
            } => {
                let asked = match edit {
                    Edit::Steps(sliders) => options(sliders),
                    Edit::Words(words) if words.starts_with('-') => {
                        format!("--prompt={}", quoted(words))
                    }
                    Edit::Words(words) => format!("--prompt {}", quoted(words)),
                };
                let picture = without_picture(*draft);
                format!("asperity edit {} {asked}{picture} {to}", file(texture))
            }
            Operation::Blend { a, b, t, draft } => {
                let (a, b, picture) = (file(a), file(b), without_picture(*draft));
                format!("asperity blend {a} {b} -t {t}{picture} {to}")
            }
            Operation::Compose {
                tap,
                slide,
                friction,
            } => {
                let [tap, slide, friction] = [tap, slide, friction].map(|id| file(id));
                format!("asperity compose --tap {tap} --slide {slide} --friction {friction} {to}")
            }
            Operation::Encode { texture } => format!("asperity encode {} {to}", file(texture)),
        })
    }
}

fn extract(library: &str, texture: &str, to: &str) -> String {
    let (library, word) = (path_word(library), shell_word(texture));
    if texture.starts_with('-') {
        format!("asperity extract {to} -- {library} {word}")
    } else {
        format!("asperity extract {library} {word} {to}")
    }
}

fn without_picture(draft: bool) -> &'static str {
    if draft { " --no-preview" } else { "" }
}

impl Operation {
    /// The same of textures by other names.
    fn of(&self, name: impl Fn(&str) -> String) -> Self {
        let mut operation = self.clone();
        for texture in operation.others_mut() {
            *texture = name(texture);
        }
        operation
    }

    /// The textures that it takes, by their names.
    pub(crate) fn others_mut(&mut self) -> Vec<&mut String> {
        match self {
            Self::File(_)
            | Self::Import { .. }
            | Self::Extract { .. }
            | Self::Build { .. }
            | Self::Compile { .. } => Vec::new(),
            Self::Edit { texture, .. } | Self::Encode { texture } => vec![texture],
            Self::Blend { a, b, .. } => vec![a, b],
            Self::Compose {
                tap,
                slide,
                friction,
            } => vec![tap, slide, friction],
        }
    }

    /// Returns true for what is heard while a slider moves.
    pub(crate) const fn is_draft(&self) -> bool {
        matches!(
            self,
            Self::Edit { draft: true, .. } | Self::Blend { draft: true, .. }
        )
    }

    fn opened(&self) -> Option<&Opened> {
        match self {
            Self::File(file)
            | Self::Import { file, .. }
            | Self::Extract { library: file, .. }
            | Self::Build { list: file, .. } => Some(file),
            _ => None,
        }
    }

    /// The command that writes the library of a list.
    fn build(&self) -> Option<String> {
        let Self::Build { list, .. } = self else {
            return None;
        };
        let (path, library) = (path_word(&list.path), list.library());
        Some(format!("asperity build {path} -o {}", path_word(&library)))
    }

    /// Returns true if a command line can hold it: arguments end at U+0000, and paths with control characters cannot be
    /// typed.
    fn is_sayable(&self) -> bool {
        let text = match self {
            Self::Compile { prompt, .. } => Some(prompt),
            Self::Edit {
                edit: Edit::Words(words),
                ..
            } => Some(words),
            _ => None,
        };
        let path_is_plain = |opened: &Opened| !opened.path.contains(char::is_control);
        !text.is_some_and(|text| text.contains('\0')) && self.opened().is_none_or(path_is_plain)
    }
}

impl Opened {
    /// The library that is written of a list.
    fn library(&self) -> String {
        let path = Path::new(&self.path).with_extension("aspl");
        path.to_string_lossy().into_owned()
    }

    /// Its name without the ending, if it is called an asset.
    fn asset_stem(&self) -> Option<&str> {
        let path = Path::new(&self.path);
        let ending = path.extension()?;
        let stem = path.file_stem()?.to_str();
        stem.filter(|_| ending.eq_ignore_ascii_case("asp"))
    }
}
