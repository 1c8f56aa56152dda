//! The commands that are attacked.

use super::{
    programs::Program::{self, Compiler, Lab},
    seeds::{ENTRY, Seed},
};

/// A command with the file that is attacked. Every other file of it is valid. Names that begin with
/// `out` are outputs.
pub(crate) struct Form {
    pub(crate) program: Program,
    pub(crate) line: &'static str,
    /// The attacked file, as it stands in the line or is read from a folder or a file in it. Of a
    /// folder, `stability` reads the materials that it knows.
    pub(crate) target: &'static str,
    pub(crate) seed: Seed,
    /// Takes many seconds with a valid input, so it gets only inputs that it must refuse.
    pub(crate) is_long: bool,
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

const fn asperity(line: &'static str, target: &'static str, seed: Seed) -> Form {
    form(Compiler, line, target, seed)
}

const fn lab(line: &'static str, target: &'static str, seed: Seed) -> Form {
    form(Lab, line, target, seed)
}

const fn long(program: Program, line: &'static str, target: &'static str, seed: Seed) -> Form {
    Form {
        is_long: true,
        ..form(program, line, target, seed)
    }
}

const PAINT: &str =
    "preview good.asp -o out.png --diffusion sd --diffusion-backend portable --steps 2 --tile";

const CACHED: &str = "build cached.toml -o out.aspl --cache cache --json";

/// Their number shares no divisor with the stride of the small size, so that it meets as many of them as it can.
pub(crate) const FORMS: [Form; 94] = [
    asperity("inspect in.asp", "in.asp", Seed::Asset),
    asperity("inspect in.asp --json", "in.asp", Seed::Asset),
    asperity("inspect in.aspl", "in.aspl", Seed::Library),
    asperity(
        "inspect in.aspl --texture a --json",
        "in.aspl",
        Seed::Library,
    ),
    asperity("inspect in.aspl --json", "in.aspl", Seed::Scene),
    lab(
        "jitter in.asp --seconds 0.1 --policy other --no-lock",
        "in.asp",
        Seed::Asset,
    ),
    asperity("split in.aspl -o out --into 2", "in.aspl", Seed::Library),
    asperity("plot in.asp -o out.png", "in.asp", Seed::Asset),
    asperity(
        "plot in.aspl --texture 1 -o out.png",
        "in.aspl",
        Seed::Library,
    ),
    asperity(
        "render in.asp --trajectory stroke.csv -o out.csv",
        "in.asp",
        Seed::Asset,
    ),
    asperity(
        "render in.aspl --trajectory stroke.csv -o out.csv",
        "in.aspl",
        Seed::Scene,
    ),
    asperity(
        "render in.aspl --texture b --trajectory stroke.csv -o out.csv --seed 3",
        "in.aspl",
        Seed::Library,
    ),
    asperity(
        "render good.asp --trajectory in.csv -o out.csv",
        "in.csv",
        Seed::Trajectory,
    ),
    asperity(
        "render scene.aspl --trajectory in.csv -o out.csv",
        "in.csv",
        Seed::Trajectory,
    ),
    asperity("import hatt in.xml -o out.asp", "in.xml", Seed::Material),
    asperity(
        "import hatt in.xml -o out.asp --fidelity auto",
        "in.xml",
        Seed::Material,
    ),
    asperity(
        "import hatt in.xml -o out.asp --complete-taps --emit-model out.json",
        "in.xml",
        Seed::Material,
    ),
    asperity(
        "import hatt materials -o out.aspl",
        "materials/in.xml",
        Seed::Material,
    ),
    asperity(
        "import hatt materials -o out",
        "materials/in.xml",
        Seed::Material,
    ),
    asperity(
        "import model in.json -o out.asp --no-preview",
        "in.json",
        Seed::Model,
    ),
    asperity(
        "import model in.json -o out.asp --fidelity auto --rate 2000 --json",
        "in.json",
        Seed::Model,
    ),
    asperity(
        "import haptic in.haptic -o out.asp --no-preview",
        "in.haptic",
        Seed::Haptic,
    ),
    asperity(
        "import ahap in.ahap -o out.asp --no-preview --json",
        "in.ahap",
        Seed::Ahap,
    ),
    asperity(
        "import hjif in.hjif -o out.asp --no-preview --fidelity full",
        "in.hjif",
        Seed::Hjif,
    ),
    asperity(
        "import surface in.png -o out.asp --width-mm 6 --depth-mm 0.1 --no-preview",
        "in.png",
        Seed::Heights,
    ),
    asperity(
        "import surface in.png -o out.asp --width-mm 6 --like cork --plot out.png --json",
        "in.png",
        Seed::Normals,
    ),
    asperity(
        "export in.asp --to hjif -o out.hjif --json",
        "in.asp",
        Seed::Asset,
    ),
    asperity(
        "export in.asp --to gltf -o out.gltf --size 64",
        "in.asp",
        Seed::Asset,
    ),
    asperity(
        "export in.aspl --texture a --to ahap -o out.ahap --taps",
        "in.aspl",
        Seed::Library,
    ),
    asperity(
        "export in.aspl --to c-array -o out.c",
        "in.aspl",
        Seed::Scene,
    ),
    asperity(
        "export in.aspl --to csv -o out --time 0.3",
        "in.aspl",
        Seed::Library,
    ),
    asperity(
        "build in.toml -o out.aspl --no-cache",
        "in.toml",
        Seed::Description,
    ),
    asperity(
        "build in.toml -o out.aspl --no-cache --target cortex-m4f@48MHz --budget-bytes 9000 --json",
        "in.toml",
        Seed::Description,
    ),
    asperity("build in.toml --check", "in.toml", Seed::Manifest),
    asperity("build in.csv --check", "in.csv", Seed::Rows),
    asperity(
        "build scene.toml -o out.aspl --no-cache",
        "good.asp",
        Seed::Asset,
    ),
    asperity(
        "build scene.toml -o out.aspl --no-cache",
        "wood.xml",
        Seed::Material,
    ),
    asperity(
        "compile cork -o out.asp --model model",
        "model/model.json",
        Seed::ModelFolder,
    ),
    asperity(
        "compile cork -o out.asp --model model --no-preview",
        "model/text_projection.onnx",
        Seed::Projection,
    ),
    asperity(
        "import hatt wood.xml -o out.asp --complete-taps --model model",
        "model/tap_decoder.onnx",
        Seed::TapDecoder,
    ),
    asperity(
        "doctor --model model --json",
        "model/model.json",
        Seed::ModelFolder,
    ),
    asperity(
        "doctor --text-encoder clip:clip",
        "clip/model.onnx",
        Seed::Projection,
    ),
    asperity(
        "compile cork -o out.asp --text-encoder clip:clip",
        "clip/text_model.onnx",
        Seed::Projection,
    ),
    lab(
        "feel in.asp --seconds 0.5 --csv out.csv --wav out.wav",
        "in.asp",
        Seed::Asset,
    ),
    lab(
        "feel in.aspl --texture a --seconds 0.5 --plot out.png",
        "in.aspl",
        Seed::Library,
    ),
    lab(
        "feel good.asp --seconds 1 --device in.toml --csv out.csv",
        "in.toml",
        Seed::Device,
    ),
    lab(
        "feel --seconds 1 --grip in.toml --csv out.csv",
        "in.toml",
        Seed::Grip,
    ),
    asperity("record-check oak", "oak/recording.toml", Seed::Recording),
    asperity("record-check oak", "oak/accel.wav", Seed::RecordedWave),
    asperity("record-check oak", "oak/force.npy", Seed::RecordedArray),
    asperity("record-check oak", "oak/position.csv", Seed::RecordedTable),
    asperity(
        PAINT,
        "sd/model_index.json",
        Seed::Diffusion("model_index.json"),
    ),
    asperity(
        PAINT,
        "sd/scheduler/scheduler_config.json",
        Seed::Diffusion("scheduler/scheduler_config.json"),
    ),
    asperity(
        PAINT,
        "sd/tokenizer/vocab.json",
        Seed::Diffusion("tokenizer/vocab.json"),
    ),
    asperity(
        PAINT,
        "sd/tokenizer/merges.txt",
        Seed::Diffusion("tokenizer/merges.txt"),
    ),
    asperity(
        PAINT,
        "sd/tokenizer/tokenizer_config.json",
        Seed::Diffusion("tokenizer/tokenizer_config.json"),
    ),
    asperity(
        PAINT,
        "sd/text_encoder/model.onnx",
        Seed::Diffusion("text_encoder/model.onnx"),
    ),
    asperity(
        PAINT,
        "sd/unet/model.onnx",
        Seed::Diffusion("unet/model.onnx"),
    ),
    asperity(
        PAINT,
        "sd/vae_decoder/model.onnx",
        Seed::Diffusion("vae_decoder/model.onnx"),
    ),
    long(
        Compiler,
        "import recording oak -o out.asp --no-preview",
        "oak/recording.toml",
        Seed::Recording,
    ),
    long(
        Compiler,
        "import recording oak -o out.asp --no-preview",
        "oak/position.csv",
        Seed::RecordedTable,
    ),
    lab(
        "device calibrate in.csv -o out.toml",
        "in.csv",
        Seed::Measurement,
    ),
    lab(
        "device calibrate sweep.csv --profile in.toml -o out.toml",
        "in.toml",
        Seed::Profile,
    ),
    lab(
        "servo good.asp --device null: --profile in.toml --policy other --no-lock --seconds 0.1",
        "in.toml",
        Seed::Profile,
    ),
    lab(
        "record out in.asp --device sim:?time=stepped --accel sim: --seconds 1.5 --policy other --no-lock",
        "in.asp",
        Seed::Asset,
    ),
    asperity(CACHED, ENTRY, Seed::CacheEntry),
    lab(
        "servo good.asp --device replay:in.aspr --seconds 0.1 --policy other --no-lock",
        "in.aspr",
        Seed::Session,
    ),
    lab(
        "jitter compare in.hlog good.hlog",
        "in.hlog",
        Seed::Intervals,
    ),
    lab(
        "jitter merge good.hlog in.hlog -o out.hlog",
        "in.hlog",
        Seed::Intervals,
    ),
    long(
        Lab,
        "record out --device null: --accel wav:in.wav?g=16 --seconds 1 --policy other --no-lock",
        "in.wav",
        Seed::RecordedWave,
    ),
    long(
        Lab,
        "record out --device null: --accel serial:in.txt --seconds 1 --policy other --no-lock",
        "in.txt",
        Seed::RecordedTable,
    ),
    lab(
        "device probe sim:in.toml?time=stepped --seconds 0.1",
        "in.toml",
        Seed::Device,
    ),
    lab("device list --rules --ids in.toml", "in.toml", Seed::Ids),
    long(
        Lab,
        "stability --hatt materials --out out",
        "materials/Models_Stone Tile 1.xml",
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
    asperity(
        "edit in.asp --rougher 5 -o out.asp --no-preview",
        "in.asp",
        Seed::Prompted,
    ),
    asperity(
        "blend cork.asp in.asp -o out.asp --no-preview",
        "in.asp",
        Seed::Prompted,
    ),
    asperity(
        "compose --tap in.asp --slide cork.asp -o out.asp --no-preview",
        "in.asp",
        Seed::Prompted,
    ),
    asperity(
        "encode in.asp -o out.asp --no-preview --json",
        "in.asp",
        Seed::Asset,
    ),
    asperity(
        "merge in.aspl cork.asp -o out.aspl",
        "in.aspl",
        Seed::Library,
    ),
    asperity("list in.aspl --json", "in.aspl", Seed::Library),
    asperity("extract in.aspl a -o out.asp", "in.aspl", Seed::Library),
    asperity(
        "rename in.aspl a other -o out.aspl",
        "in.aspl",
        Seed::Library,
    ),
    asperity("split in.aspl -o out", "in.aspl", Seed::Library),
    asperity("diff in.asp good.asp", "in.asp", Seed::Asset),
    asperity(
        "listen in.asp -o out.wav --speed 100",
        "in.asp",
        Seed::Asset,
    ),
    asperity("studio in.aspl --export out", "in.aspl", Seed::Library),
    asperity("study check in.toml --json", "in.toml", Seed::Study),
    asperity(
        "study simulate in.toml --participants 2 -o out",
        "in.toml",
        Seed::Study,
    ),
    lab(
        "jitter overlay in.hlog good.hlog -o out.png",
        "in.hlog",
        Seed::Intervals,
    ),
    lab(
        "bench --hatt materials --seconds 3 -o out",
        "materials/in.xml",
        Seed::Material,
    ),
    lab(
        "device faults sim:in.toml?time=stepped&grip=firm --patience 1",
        "in.toml",
        Seed::Device,
    ),
    long(
        Lab,
        "measured --hatt materials -o out",
        "materials/in.xml",
        Seed::Material,
    ),
];
