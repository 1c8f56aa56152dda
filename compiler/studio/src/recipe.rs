//! How a texture came about, and the commands that write its bytes again.

use asperity::edit::{AXES, Axis, Edit, Sliders};
use asperity_io::{output::FileNames, shown::shell_word};
use std::{borrow::Cow, collections::HashMap, path::Path, sync::Arc};

/// Steps that are remembered: more are no command that anyone would copy.
const MOST: usize = 64;

/// Steps from prompts and files to a texture; each after those that it takes textures of. The last one gives the
/// texture itself.
#[derive(Clone)]
pub(crate) struct Recipe(Vec<Arc<Step>>);

/// A step, which gives one texture.
struct Step {
    /// What names the bytes of its texture.
    id: String,
    /// The name of its texture.
    name: String,
    what: What,
}

/// A file that commands find where the user has it.
#[derive(Clone, PartialEq, Eq)]
pub(crate) struct Opened {
    /// Its path, or its name alone where it was dropped on the page.
    pub(crate) path: String,
    /// What tells it from others of this path.
    pub(crate) id: String,
}

/// What a step does. Other textures are named by what names their bytes.
pub(crate) enum What {
    /// A file holds the texture.
    File(Opened),
    /// `asperity import`, of a file as `hatt` or another kind
    Import { kind: &'static str, file: Opened },
    /// `asperity extract`
    Extract { library: Opened, texture: String },
    /// `asperity compile`
    Compile { prompt: String, seed: u64 },
    /// `asperity edit`; a draft has no picture
    Edit {
        texture: String,
        edit: Edit,
        draft: bool,
    },
    /// `asperity blend`
    Blend { a: String, b: String, t: f64 },
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
        what: What,
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
        if steps.len() == MOST || !what.is_sayable() {
            return None;
        }
        steps.push(Arc::new(Step {
            id: id.to_owned(),
            name: name.to_owned(),
            what,
        }));
        Some(Self(steps))
    }

    /// The file that the last command writes, by its name alone.
    pub(crate) fn file(&self) -> Option<String> {
        let last = self.0.last()?;
        match &last.what {
            What::File(opened) => {
                let stem = opened.asset_stem()?;
                FileNames::of(&[stem], "asp").files.pop()
            }
            _ => self.files().remove(last.id.as_str()),
        }
    }

    /// The commands, one a line, for a POSIX shell. `None` where a file holds the texture already, and where two files
    /// have the same path.
    pub(crate) fn command(&self) -> Option<String> {
        let opened = || self.0.iter().filter_map(|step| step.what.opened());
        let ambiguous = |file: &Opened| opened().any(|o| o.path == file.path && o.id != file.id);
        if opened().any(ambiguous) {
            return None;
        }
        let files = self.files();
        let lines: Vec<String> = self.0.iter().filter_map(|step| step.line(&files)).collect();
        let writes = !matches!(self.0.last()?.what, What::File(_));
        writes.then(|| lines.join("\n"))
    }

    /// The file of each step: where it lies, or to which the step writes it. All differ.
    fn files(&self) -> HashMap<&str, String> {
        let opened = self.0.iter().filter_map(|step| step.what.opened());
        let mut names: Vec<&str> = opened.filter_map(Opened::asset_stem).collect();
        let taken = names.len();
        let written = || {
            let steps = self.0.iter();
            steps.filter(|step| !matches!(step.what, What::File(_)))
        };
        names.extend(written().map(|step| step.name.as_str()));
        let outputs = FileNames::of(&names, "asp").files.into_iter().skip(taken);
        let outputs = written().map(|step| step.id.as_str()).zip(outputs);
        let found = self.0.iter().filter_map(|step| match &step.what {
            What::File(opened) => Some((step.id.as_str(), opened.path.clone())),
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
        Some(match &self.what {
            What::File(_) => return None,
            What::Import { kind, file } => {
                format!("asperity import {kind} {} {to}", path_word(&file.path))
            }
            What::Extract { library, texture } => {
                let (library, word) = (path_word(&library.path), shell_word(texture));
                if texture.starts_with('-') {
                    format!("asperity extract {to} -- {library} {word}")
                } else {
                    format!("asperity extract {library} {word} {to}")
                }
            }
            What::Compile { prompt, seed } => {
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
            What::Edit {
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
                let picture = if *draft { " --no-preview" } else { "" };
                format!("asperity edit {} {asked}{picture} {to}", file(texture))
            }
            What::Blend { a, b, t } => {
                format!("asperity blend {} {} -t {t} {to}", file(a), file(b))
            }
            What::Compose {
                tap,
                slide,
                friction,
            } => {
                let [tap, slide, friction] = [tap, slide, friction].map(|id| file(id));
                format!("asperity compose --tap {tap} --slide {slide} --friction {friction} {to}")
            }
            What::Encode { texture } => format!("asperity encode {} {to}", file(texture)),
        })
    }
}

impl What {
    fn opened(&self) -> Option<&Opened> {
        match self {
            Self::File(file) | Self::Import { file, .. } | Self::Extract { library: file, .. } => {
                Some(file)
            }
            _ => None,
        }
    }

    /// Whether a command line can hold it, which ends texts at U+0000. Files with control characters in their names are
    /// for no one to type.
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
    /// Its name without the ending, if it is called an asset.
    fn asset_stem(&self) -> Option<&str> {
        let path = Path::new(&self.path);
        let ending = path.extension()?;
        let stem = path.file_stem()?.to_str();
        stem.filter(|_| ending.eq_ignore_ascii_case("asp"))
    }
}

/// The options of `asperity edit` for these sliders.
fn options(sliders: &Sliders) -> String {
    let option = |axis: Axis| {
        let steps = sliders.along(axis);
        let (up, down) = match axis {
            Axis::Rough => ("rougher", "smoother"),
            Axis::Sharp => ("sharper", "duller"),
            Axis::Hard => ("harder", "softer"),
            Axis::Slippery => ("slipperier", "stickier"),
        };
        let name = if steps > 0.0 { up } else { down };
        (steps != 0.0).then(|| format!("--{name} {}", steps.abs()))
    };
    let given: Vec<String> = AXES.into_iter().filter_map(option).collect();
    given.join(" ")
}

/// A path as a word of a shell, that no command takes for an option.
fn path_word(path: &str) -> Cow<'_, str> {
    if path.starts_with('-') {
        Cow::Owned(shell_word(&format!("./{path}")).into_owned())
    } else {
        shell_word(path)
    }
}

/// A text in quotation marks, even if it is one word: people change it.
fn quoted(text: &str) -> String {
    match shell_word(text) {
        quoted if quoted.starts_with('\'') => quoted.into_owned(),
        plain => format!("'{plain}'"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn compiled(id: &str, prompt: &str, seed: u64) -> Recipe {
        let prompt = prompt.to_owned();
        Recipe::new([], id, &prompt.clone(), What::Compile { prompt, seed }).unwrap()
    }

    fn edited(of: &Recipe, from: &str, id: &str, name: &str, edit: Edit) -> Option<Recipe> {
        let texture = from.to_owned();
        Recipe::new(
            [Some(of)],
            id,
            name,
            What::Edit {
                texture,
                edit,
                draft: false,
            },
        )
    }

    fn file(id: &str, path: &str) -> Recipe {
        let (path, id) = (path.to_owned(), id.to_owned());
        let opened = Opened { path, id };
        Recipe::new([], &opened.id.clone(), "any", What::File(opened)).unwrap()
    }

    fn softer(steps: f64) -> Edit {
        Edit::Steps(Sliders {
            harder: -steps,
            slipperier: 2.5,
            ..Sliders::default()
        })
    }

    #[test]
    fn a_prompt_is_one_word_of_a_shell() {
        let cases = [
            ("cork", 0, "asperity compile 'cork' -o cork.asp"),
            (
                "wet ice",
                7,
                "asperity compile 'wet ice' -o 'wet ice.asp' --seed 7",
            ),
            ("-x", 1, "asperity compile -o _-x.asp --seed 1 -- '-x'"),
            ("a'b", 0, r"asperity compile 'a'\''b' -o 'a'\''b.asp'"),
            ("$(id)", 0, "asperity compile '$(id)' -o '$(id).asp'"),
        ];
        for (prompt, seed, command) in cases {
            let recipe = compiled("1", prompt, seed);
            assert_eq!(recipe.command().as_deref(), Some(command));
        }
        let what = What::Compile {
            prompt: "a\0b".into(),
            seed: 0,
        };
        assert!(Recipe::new([], "1", "a b", what).is_none());
    }

    #[test]
    fn each_line_writes_a_file_of_its_own_and_reads_those_before() {
        let cork = compiled("c", "cork", 0);
        let edited = edited(&cork, "c", "e", "cork", softer(20.0)).unwrap();
        let dropped = file("f", "-cork (2).asp");
        let what = What::Blend {
            a: "e".into(),
            b: "f".into(),
            t: 0.25,
        };
        let blend = Recipe::new([Some(&edited), Some(&dropped)], "b", "cork – any", what).unwrap();
        let what = What::Compose {
            tap: "b".into(),
            slide: "c".into(),
            friction: "e".into(),
        };
        let all = [&blend, &cork, &edited].map(Some);
        let composed = Recipe::new(all, "x", "cork", what).unwrap();
        assert_eq!(
            composed.command().unwrap(),
            "asperity compile 'cork' -o cork.asp\n\
             asperity edit cork.asp --softer 20 --slipperier 2.5 -o 'cork (2).asp'\n\
             asperity blend 'cork (2).asp' './-cork (2).asp' -t 0.25 -o 'cork – any.asp'\n\
             asperity compose --tap 'cork – any.asp' --slide cork.asp --friction 'cork (2).asp' -o 'cork (3).asp'"
        );
        assert_eq!(composed.file().as_deref(), Some("cork (3).asp"));
    }

    #[test]
    fn no_line_overwrites_a_file_that_was_opened() {
        let dropped = file("f", "cork.asp");
        assert_eq!(dropped.command(), None);
        assert_eq!(dropped.file().as_deref(), Some("cork.asp"));
        let words = Edit::Words("-a bit softer".into());
        let edited = edited(&dropped, "f", "e", "cork", words).unwrap();
        assert_eq!(
            edited.command().unwrap(),
            "asperity edit cork.asp --prompt='-a bit softer' -o 'cork (2).asp'"
        );
        let what = What::Blend {
            a: "f".into(),
            b: "g".into(),
            t: 0.5,
        };
        let other = file("g", "cork.asp");
        let blend = Recipe::new([Some(&dropped), Some(&other)], "b", "two", what).unwrap();
        assert_eq!(blend.command(), None, "two files of one path");
    }

    #[test]
    fn other_files_are_imported_and_textures_of_libraries_extracted() {
        let opened = |path: &str| Opened {
            path: path.into(),
            id: "o".into(),
        };
        let (kind, file) = ("hatt", opened("Models_Oak.xml"));
        let oak = Recipe::new([], "1", "Oak", What::Import { kind, file }).unwrap();
        let command = "asperity import hatt Models_Oak.xml -o Oak.asp";
        assert_eq!(oak.command().as_deref(), Some(command));
        for (texture, command) in [
            ("wet ice", "asperity extract my.aspl 'wet ice' -o any.asp"),
            ("-x", "asperity extract -o any.asp -- my.aspl -x"),
        ] {
            let (library, texture) = (opened("my.aspl"), texture.to_owned());
            let what = What::Extract { library, texture };
            let recipe = Recipe::new([], "2", "any", what).unwrap();
            assert_eq!(recipe.command().as_deref(), Some(command));
        }
    }

    #[test]
    fn what_no_one_can_type_has_no_recipe() {
        let cork = compiled("0", "cork", 0);
        let words = Edit::Words("softer\0".into());
        assert!(edited(&cork, "0", "1", "cork", words).is_none());
        let mut last = cork;
        for n in 1..MOST {
            let (from, id) = ((n - 1).to_string(), n.to_string());
            last = edited(&last, &from, &id, "cork", softer(1.0)).unwrap();
        }
        assert_eq!(last.command().unwrap().lines().count(), MOST);
        let from = (MOST - 1).to_string();
        assert!(edited(&last, &from, "more", "cork", softer(1.0)).is_none());
    }
}
