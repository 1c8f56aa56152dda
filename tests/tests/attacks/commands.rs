//! The commands that are attacked, and how one is made into a case.

use crate::{
    mutate::mutated,
    pieces::Piece,
    programs::Program::{self, Compiler, Lab},
    seeds::{Seed, Seeds},
    strange::Strange,
};
use asperity_tests::draw::Draw;
use std::{ffi::OsString, fmt, path::Path};

/// A command with the file that is attacked. Every other file of it is valid. Names that begin with
/// `out` are outputs.
struct Form {
    program: Program,
    line: &'static str,
    /// The attacked file, as it stands in the line or is read from a folder or a file in it.
    target: &'static str,
    seed: Seed,
    /// Takes many seconds with a valid input, so it gets only inputs that it must refuse.
    is_long: bool,
}

const fn form(program: Program, line: &'static str, target: &'static str, seed: Seed) -> Form {
    Form {
        program,
        line,
        target,
        seed,
        is_long: false,
    }
}

const fn long(program: Program, line: &'static str, target: &'static str, seed: Seed) -> Form {
    Form {
        is_long: true,
        ..form(program, line, target, seed)
    }
}

const FORMS: [Form; 36] = [
    form(Compiler, "inspect in.asp", "in.asp", Seed::Asset),
    form(Compiler, "inspect in.asp --json", "in.asp", Seed::Asset),
    form(Compiler, "inspect in.aspl", "in.aspl", Seed::Library),
    form(
        Compiler,
        "inspect in.aspl --texture a --json",
        "in.aspl",
        Seed::Library,
    ),
    form(Compiler, "inspect in.aspl --json", "in.aspl", Seed::Scene),
    form(Compiler, "plot in.asp -o out.png", "in.asp", Seed::Asset),
    form(
        Compiler,
        "plot in.aspl --texture 1 -o out.png",
        "in.aspl",
        Seed::Library,
    ),
    form(
        Compiler,
        "render in.asp --trajectory stroke.csv -o out.csv",
        "in.asp",
        Seed::Asset,
    ),
    form(
        Compiler,
        "render in.aspl --trajectory stroke.csv -o out.csv",
        "in.aspl",
        Seed::Scene,
    ),
    form(
        Compiler,
        "render in.aspl --texture b --trajectory stroke.csv -o out.csv --seed 3",
        "in.aspl",
        Seed::Library,
    ),
    form(
        Compiler,
        "render good.asp --trajectory in.csv -o out.csv",
        "in.csv",
        Seed::Trajectory,
    ),
    form(
        Compiler,
        "render scene.aspl --trajectory in.csv -o out.csv --rate 2000",
        "in.csv",
        Seed::Trajectory,
    ),
    form(
        Compiler,
        "import hatt in.xml -o out.asp",
        "in.xml",
        Seed::Material,
    ),
    form(
        Compiler,
        "import hatt in.xml -o out.asp --fidelity auto",
        "in.xml",
        Seed::Material,
    ),
    form(
        Compiler,
        "import hatt in.xml -o out.asp --complete-taps --emit-model out.json",
        "in.xml",
        Seed::Material,
    ),
    form(
        Compiler,
        "import hatt materials -o out.aspl",
        "materials/in.xml",
        Seed::Material,
    ),
    form(
        Compiler,
        "import hatt materials -o out",
        "materials/in.xml",
        Seed::Material,
    ),
    form(
        Compiler,
        "import model in.json -o out.asp --no-preview",
        "in.json",
        Seed::Model,
    ),
    form(
        Compiler,
        "import model in.json -o out.asp --fidelity auto --rate 2000 --json",
        "in.json",
        Seed::Model,
    ),
    form(
        Compiler,
        "build in.toml -o out.aspl",
        "in.toml",
        Seed::Description,
    ),
    form(
        Compiler,
        "build in.toml -o out.aspl --target cortex-m4f@48MHz --budget-bytes 9000 --json",
        "in.toml",
        Seed::Description,
    ),
    form(
        Compiler,
        "build scene.toml -o out.aspl",
        "good.asp",
        Seed::Asset,
    ),
    form(
        Compiler,
        "build scene.toml -o out.aspl",
        "wood.xml",
        Seed::Material,
    ),
    form(
        Compiler,
        "compile cork -o out.asp --model model",
        "model/model.json",
        Seed::ModelFolder,
    ),
    form(
        Compiler,
        "compile cork -o out.asp --model model --no-preview",
        "model/text_projection.onnx",
        Seed::Projection,
    ),
    form(
        Compiler,
        "import hatt wood.xml -o out.asp --complete-taps --model model",
        "model/tap_decoder.onnx",
        Seed::TapDecoder,
    ),
    form(
        Compiler,
        "doctor --model model --json",
        "model/model.json",
        Seed::ModelFolder,
    ),
    form(
        Compiler,
        "doctor --text-encoder clip:clip",
        "clip/model.onnx",
        Seed::Projection,
    ),
    form(
        Compiler,
        "compile cork -o out.asp --text-encoder clip:clip",
        "clip/text_model.onnx",
        Seed::Projection,
    ),
    form(
        Lab,
        "feel in.asp --seconds 0.5 --csv out.csv --wav out.wav",
        "in.asp",
        Seed::Asset,
    ),
    form(
        Lab,
        "feel in.aspl --texture a --seconds 0.5 --plot out.png",
        "in.aspl",
        Seed::Library,
    ),
    form(
        Lab,
        "feel good.asp --seconds 1 --device in.toml --csv out.csv",
        "in.toml",
        Seed::Device,
    ),
    form(
        Lab,
        "feel --seconds 1 --grip in.toml --csv out.csv",
        "in.toml",
        Seed::Grip,
    ),
    long(
        Lab,
        "stability --hatt materials --out out",
        "materials/in.xml",
        Seed::Material,
    ),
    long(
        Lab,
        "pareto --quick --hatt materials --out out",
        "materials/in.xml",
        Seed::Material,
    ),
    long(
        Lab,
        "pareto --quick --cortex-m in.csv --out out",
        "in.csv",
        Seed::Counts,
    ),
];

/// What is put in the place of the attacked file.
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

    /// A case that is not left to chance.
    pub(crate) fn of_piece(piece: &Piece) -> Self {
        let input = Input::Piece(piece.bytes);
        Self::of(
            piece.program,
            piece.line,
            piece.target,
            input,
            piece.told.to_owned(),
        )
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
        // Of what lies in an output folder, the programs choose the names.
        let inside = ["Wood.asp", "Test.asp", "wood.asp"].map(|name| format!("out/{name}"));
        Self {
            program,
            command: line,
            outputs: outputs.map(|&word| word.to_owned()).chain(inside).collect(),
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
                // A folder of assets goes there.
                self.outputs
                    .extend(["materials/Wood.asp", "materials/Test.asp"].map(String::from));
            }
        }
    }

    /// Puts the attacked file into a folder of valid ones.
    pub(crate) fn prepare(&self, folder: &Path, seeds: &Seeds) {
        let path = folder.join(&self.target);
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
