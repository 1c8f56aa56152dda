//! A command with a hostile input: a case.

use super::{
    forms::{FORMS, Form},
    mutate::mutated,
    pieces::{PROMPT, Piece},
    programs::Program,
    seeds::{ENTRY, Seeds},
    strange::Strange,
};
use asperity_tests::draw::Draw;
use std::{ffi::OsString, fmt, os::unix::ffi::OsStringExt as _, path::Path};

/// Replacement for the attacked file.
enum Input {
    Bytes(Vec<u8>),
    Strange(Strange),
    Piece(fn(&Seeds) -> Vec<u8>),
}

/// A case.
pub(crate) struct Attack {
    pub(crate) program: Program,
    /// The command as it stands in the table.
    pub(crate) command: &'static str,
    pub(crate) arguments: Vec<OsString>,
    /// Files and folders that a success may leave.
    pub(crate) outputs: Vec<String>,
    target: String,
    input: Input,
    told: String,
}

impl Attack {
    /// A case of the table, and what is done to its input, at random.
    pub(crate) fn drawn(number: usize, seeds: &Seeds, draw: &mut Draw) -> Self {
        let form = &FORMS[number % FORMS.len()];
        let strange = form.is_long || draw.below(6) == 0;
        let (input, told) = if strange {
            let strange = Strange::drawn(form.is_long, draw);
            (Input::Strange(strange), format!("{strange:?}"))
        } else {
            let (bytes, told) = mutated(form.seed, seeds, draw);
            (Input::Bytes(bytes), told)
        };
        let mut attack = Self::of(form.program, form.line, form.target, input, told);
        if draw.below(20) == 0 {
            attack.rename(draw);
        }
        if draw.below(20) == 0 {
            attack.misdirect(draw);
        }
        attack
    }

    /// A command of the table with a valid input.
    pub(crate) fn valid(form: &Form, seeds: &Seeds) -> Self {
        let input = Input::Bytes(seeds.bytes(form.seed).to_vec());
        Self::of(
            form.program,
            form.line,
            form.target,
            input,
            "valid".to_owned(),
        )
    }

    /// A command of the table with something strange in place of its input.
    pub(crate) fn strange(form: &Form, strange: Strange) -> Self {
        let told = format!("{strange:?}");
        Self::of(
            form.program,
            form.line,
            form.target,
            Input::Strange(strange),
            told,
        )
    }

    /// A case that is not left to chance.
    pub(crate) fn of_piece(piece: &Piece, seeds: &Seeds) -> Self {
        let input = Input::Piece(piece.bytes);
        let mut attack = Self::of(
            piece.program,
            piece.line,
            piece.target,
            input,
            piece.told.to_owned(),
        );
        if piece.target == PROMPT {
            let prompt = OsString::from_vec((piece.bytes)(seeds));
            for argument in attack.arguments.iter_mut().filter(|a| **a == *PROMPT) {
                argument.clone_from(&prompt);
            }
            attack.input = Input::Strange(Strange::Missing);
        }
        attack
    }

    fn of(
        program: Program,
        line: &'static str,
        target: &'static str,
        input: Input,
        told: String,
    ) -> Self {
        let words: Vec<&str> = line.split(' ').collect();
        let outputs = words.iter().filter(|word| word.starts_with("out"));
        // The header of a C array lies beside it, and the lock of a build beside its manifest.
        let header = line.contains("c-array").then(|| "out.h".to_owned());
        let lock = (words[0] == "build").then(|| format!("{}.lock", words[1]));
        Self {
            program,
            command: line,
            outputs: outputs
                .map(|&word| word.to_owned())
                .chain(header)
                .chain(lock)
                .collect(),
            arguments: words.iter().map(OsString::from).collect(),
            target: target.to_owned(),
            input,
            told,
        }
    }

    /// Gives the attacked file a name that is hard to print, if the command line names it.
    fn rename(&mut self, draw: &mut Draw) {
        let names = [
            "in\u{1b}[31m.asp".to_owned(),
            "in\nerror: nothing.asp".to_owned(),
            "\u{202e}ni.asp".to_owned(),
            "i".repeat(255),
            "i".repeat(4000),
            "in {0} %s \\.asp".to_owned(),
        ];
        let name = names[draw.below(names.len())].clone();
        if let Some(place) = self.arguments.iter().position(|a| *a == *self.target) {
            self.arguments[place] = name.clone().into();
            self.told += &format!(", named {:?}", name.chars().take(40).collect::<String>());
            self.outputs.push(format!("{name}.lock"));
            self.target = name;
        }
    }

    /// Gives an output a place that cannot be written.
    fn misdirect(&mut self, draw: &mut Draw) {
        let places = [
            "/dev/full",
            "materials",
            "missing/out.bin",
            "stroke.csv/out.bin",
            "",
        ];
        let place = places[draw.below(places.len())];
        if place == "/dev/full" && !Path::new(place).exists() {
            return;
        }
        let output = |a: &OsString| a.to_str().is_some_and(|a| a.starts_with("out"));
        if let Some(at) = self.arguments.iter().position(output) {
            self.arguments[at] = place.into();
            self.told += &format!(", written to {place:?}");
            if place == "materials" {
                // A folder of files goes there; that its inputs stay is checked beside.
                self.outputs.push(place.to_owned());
            }
        }
    }

    /// Puts the attacked file into a folder of valid ones.
    pub(crate) fn prepare(&self, folder: &Path, seeds: &Seeds) {
        let path = match &*self.target {
            ENTRY => folder.join("cache").join(seeds.entry()),
            target => folder.join(target),
        };
        let _ = std::fs::remove_file(&path);
        // A name that the system does not take stays missing.
        match &self.input {
            Input::Bytes(bytes) => drop(std::fs::write(path, bytes)),
            Input::Piece(bytes) => drop(std::fs::write(path, bytes(seeds))),
            Input::Strange(strange) => strange.make(&path),
        }
    }
}

impl fmt::Display for Attack {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.program)?;
        for argument in &self.arguments {
            let shown: String = argument.to_string_lossy().chars().take(80).collect();
            write!(f, " {shown:?}")?;
        }
        write!(
            f,
            ": {} is {}",
            self.target
                .chars()
                .take(80)
                .collect::<String>()
                .escape_debug(),
            self.told
        )
    }
}
