//! `asperity build`: the library holds what the scene touches, within its budget, the same to
//! the byte; what is wrong is named by file and field.

use asperity::{
    emit::lower::lower,
    learned::inference::Backend,
    library::{Build, Manifest, Request},
    scene::{Budget, Built, Description, build},
    sources::{builtin, prompt::PromptCompiler},
    views::render::render_scene,
};
use asperity_formats::Library;
use asperity_io::diagnostic::{Failures, report};
use asperity_runtime::{Config, HostScene, HostTexture, Renderer, Sample, SceneState};
use std::{fs, path::Path};
use tempfile::TempDir;

const SCENE: &str = r#"
[[texture]]
name = "hard"
asset = "hard.asp"
[[texture]]
name = "soft"
asset = "soft.asp"
[[texture]]
name = "unused"
asset = "soft.asp"
[[surface]]
texture = "soft"
plane = { point_m = [0, 0, 0], normal = [0, 0, 1] }
to_m = [0, 1, 1]
[[surface]]
texture = "hard"
box = { center_m = [0, 0, 0], half_extents_m = [0.1, 0.1, 0.1] }
[[surface]]
texture = "soft"
sphere = { center_m = [0, 0, 0], radius_m = 0.1 }
"#;

fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut texture = builtin::texture();
    for name in ["hard", "soft"] {
        let bytes = lower(&texture, None).unwrap().bytes;
        fs::write(folder.path().join(format!("{name}.asp")), bytes).unwrap();
        texture.friction.mu *= 0.5;
        for vertex in &mut texture.grid.vertices {
            vertex.sigma_m_s2 *= 0.5;
        }
    }
    folder
}

fn prompt_compiler() -> Result<PromptCompiler, Failures> {
    Ok(PromptCompiler::embedded(&Backend::Portable).unwrap())
}

fn built(folder: &Path, scene: &str, budget: &Budget) -> Result<Built, Failures> {
    let file = folder.join("scene.toml");
    fs::write(&file, scene).unwrap();
    build(
        &Description::read(&file)?,
        budget,
        &Request::default(),
        &prompt_compiler,
        &|| (),
    )
}

/// All failures as a user reads them.
fn told<T>(result: Result<T, Failures>) -> String {
    let failures = result.map(drop).unwrap_err();
    let told = failures.iter().map(|failure| report(&**failure));
    told.collect::<Vec<_>>().join("\n")
}

fn within(target: Option<&str>, bytes: Option<u64>) -> Budget {
    Budget {
        target: target.map(|target| target.parse().unwrap()),
        bytes,
        ..Budget::default()
    }
}

#[test]
fn a_library_holds_each_texture_that_is_touched_once_and_in_full() {
    let folder = folder();
    let built = built(folder.path(), SCENE, &Budget::default()).unwrap();
    let library = Library::parse(&built.bytes).unwrap();
    let names: Vec<&str> = library.index().entries().map(|e| e.name).collect();
    assert_eq!(names, ["hard", "soft"]);
    assert_eq!(built.report.unused, ["unused"]);
    let surfaces = library.scene().unwrap().surfaces();
    let worn: Vec<u16> = surfaces.map(|surface| surface.texture).collect();
    assert_eq!(worn, [1, 0, 1]);
    let order = builtin::texture().grid.order;
    assert!(built.report.textures.iter().all(|row| row.order == order));
    assert!(built.report.textures.iter().all(|row| row.error_db == 0.0));
    let whole = fs::read(folder.path().join("hard.asp")).unwrap();
    let (kept, whole) = (
        library.asset(0).unwrap(),
        asperity_formats::Asset::parse(&whole).unwrap(),
    );
    let lsf = |asset: &asperity_formats::Asset<'_>| -> Vec<f32> {
        let models = asset.grid().models();
        models
            .flat_map(|m| m.lsf().map(|code| code.half_turns()))
            .collect()
    };
    assert_eq!(lsf(&kept), lsf(&whole));
}

#[test]
fn the_same_scene_gives_the_same_bytes_whatever_the_thread_count() {
    let folder = folder();
    let budget = within(Some("2700"), Some(7000));
    let with_threads = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let build = || built(folder.path(), SCENE, &budget).unwrap().bytes;
        pool.build().unwrap().install(build)
    };
    assert_eq!(with_threads(1), with_threads(4));
}

#[test]
fn budgets_are_kept_and_a_tighter_one_never_costs_less_error() {
    let folder = folder();
    let within = |target: Option<u64>, bytes: Option<usize>| {
        let target = target.map(|count| count.to_string());
        let budget = within(target.as_deref(), bytes.map(|bytes| bytes as u64));
        built(folder.path(), SCENE, &budget)
    };
    let whole = within(None, None).unwrap().report;
    let error_db = |built: &Built| -> f64 {
        let rows = built.report.textures.iter();
        rows.map(|row| row.error_db).sum()
    };

    let (mut budget, mut least_db, mut steps) = (whole.instructions, 0.0, 0);
    let refused = loop {
        match within(Some(budget), None) {
            Ok(built) => {
                assert!(built.report.instructions <= budget);
                assert!(error_db(&built) >= least_db);
                least_db = error_db(&built);
                budget = built.report.instructions - 1;
                steps += 1;
            }
            refused => break told(refused),
        }
    };
    assert!(
        steps > 3 && least_db > 1.0,
        "{steps} steps to {least_db} dB"
    );
    assert!(refused.contains("more than the budget"), "{refused}");

    let mut least_db = 0.0;
    for bytes in [
        whole.bytes,
        whole.bytes - 1,
        whole.bytes - 800,
        whole.bytes - 1600,
    ] {
        let built = within(None, Some(bytes)).unwrap();
        assert!(built.bytes.len() <= bytes, "{bytes}");
        assert_eq!(built.report.bytes, built.bytes.len());
        assert!(error_db(&built) >= least_db, "{bytes}");
        least_db = error_db(&built);
        let library = Library::parse(&built.bytes).unwrap();
        assert!(library.asset(0).is_ok() && library.asset(1).is_ok());
    }
    assert!(least_db > 0.0);
}

#[test]
fn a_budget_that_cannot_hold_says_by_how_much() {
    let folder = folder();
    for (budget, expected) in [
        (
            within(Some("1500"), None),
            ["more than the budget of 1500", "--share"],
        ),
        (
            within(None, Some(900)),
            ["more than the budget of 900", "--budget-bytes"],
        ),
    ] {
        let text = told(built(folder.path(), SCENE, &budget));
        for part in expected.into_iter().chain(["scene.toml"]) {
            assert!(text.contains(part), "{part}: {text}");
        }
    }
}

#[test]
fn errors_name_the_file_the_field_and_the_remedy() {
    let folder = folder();
    let cases = [
        ("", "", "surface: the scene has no surface", "[[surface]]"),
        (
            "texture = \"hard\"",
            "texture = \"hrd\"",
            "surface[1].texture: no texture \"hrd\"",
            "correct the name",
        ),
        (
            "radius_m = 0.1",
            "radius_m = nan",
            "surface[2].sphere.radius_m: NaN",
            "in that range",
        ),
        (
            "radius_m = 0.1",
            "radius_m = 0",
            "surface[2].sphere.radius_m: 0",
            "in that range",
        ),
        (
            "normal = [0, 0, 1]",
            "normal = [0, 0, 0]",
            "surface[0].plane.normal length: 0",
            "in that range",
        ),
        (
            "radius_m = 0.1",
            "radius = 0.1",
            "unknown field `radius`",
            "docs/scenes.md",
        ),
        (
            "asset = \"hard.asp\"",
            "asset = \"gone.asp\"",
            "scene.toml:4: asset: ",
            "check the path",
        ),
        (
            "asset = \"hard.asp\"",
            "import = \"gone.xml\"",
            "scene.toml:4: import: ",
            "path",
        ),
        (
            "asset = \"hard.asp\"",
            "",
            "scene.toml:2: no source",
            "exactly one source",
        ),
        (
            "asset = \"hard.asp\"",
            "asset = \"hard.asp\"\nprompt = \"cork\"",
            "scene.toml:5: asset and prompt",
            "exactly one source",
        ),
        (
            "asset = \"hard.asp\"",
            "asset = \"hard.asp\"\nseed = 1",
            "scene.toml:5: seed: cannot be combined with asset",
            "remove",
        ),
        (
            "name = \"soft\"",
            "name = \"hard\"",
            "name: \"hard\" is also the name",
            "rename",
        ),
        (
            "to_m = [0, 1, 1]",
            "from_m = [1, 0, 0]\nto_m = [0, 1, 1]",
            "surface[0].to_m: 0 m is not above 1 m",
            "swap",
        ),
        (
            "[[texture]]\nname = \"hard\"",
            "servo_rate_hz = 5e5\n[[texture]]\nname = \"hard\"",
            "servo_rate_hz: 500000",
            "in that range",
        ),
    ];
    for (part, by, expected, remedy) in cases {
        let scene = if part.is_empty() {
            String::new()
        } else {
            assert!(SCENE.contains(part), "{part}");
            SCENE.replacen(part, by, 1)
        };
        let text = told(built(folder.path(), &scene, &Budget::default()));
        for part in ["scene.toml", expected, remedy] {
            assert!(text.contains(part), "{part}: {text}");
        }
    }
    let gone = told(Description::read(&folder.path().join("gone.toml")));
    assert!(gone.contains("gone.toml: cannot read it"), "{gone}");
}

/// `asperity render` writes a scene exactly as the runtime renders it, tick by tick.
#[test]
fn a_scene_is_rendered_on_its_surfaces() {
    rendered(1, None);
}

/// A faster servo loop leaves the models their clock.
#[test]
fn a_scene_for_a_faster_loop_keeps_the_rates_of_its_textures() {
    rendered(5, Some(5000.0));
}

/// Builds and renders the scene for a loop at `ratio` kHz.
fn rendered(ratio: u32, rate_hz: Option<f32>) {
    let folder = folder();
    let scene = format!("servo_rate_hz = {}\n{SCENE}", 1000 * ratio);
    let built = built(folder.path(), &scene, &Budget::default()).unwrap();
    let library = Library::parse(&built.bytes).unwrap();
    for index in 0..2 {
        let rate = library.asset(index).unwrap().grid().sample_rate_hz();
        assert_eq!(rate, 1000.0);
    }
    // Down onto the plane, and sideways into the box.
    let ms = |n: u32| f64::from(n) / f64::from(ratio);
    let x_mm = |n: u32| -130.0 + 0.0625 * ms(n);
    let z_mm = |n: u32| (2.0 - ms(n) / 64.0).max(-1.0);
    let mut trajectory = String::from("t_s,x_mm,y_mm,z_mm\n");
    for n in 0..900 * ratio {
        let t_s = ms(n) / 1000.0;
        trajectory += &format!("{t_s},{},0,{}\n", x_mm(n), z_mm(n));
    }
    let file = Path::new("stroke.csv");
    let mut table = Vec::new();
    let report = render_scene(
        &library,
        rate_hz,
        file,
        trajectory.as_bytes(),
        &mut table,
        5,
    )
    .unwrap();

    let config = Config {
        servo_rate_hz: rate_hz.unwrap_or(1000.0),
        ..Config::default()
    };
    let renderer = Renderer::new(&config).unwrap();
    let mut slots = vec![HostTexture::new(); 2];
    let scene = HostScene::load(&library, &config, &mut slots).unwrap();
    let mut state = SceneState::new(5);
    let mut rows = csv::Reader::from_reader(table.as_slice());
    let mut seen = Vec::new();
    for (n, row) in rows.records().enumerate() {
        let row = row.unwrap();
        let metres = |mm: f64| (mm / 1000.0) as f32;
        let position_m = [metres(x_mm(n as u32)), 0.0, metres(z_mm(n as u32))];
        let output = renderer.tick_scene(&scene, &mut state, &Sample::at(position_m));
        for (axis, force_n) in output.force_n.into_iter().enumerate() {
            let printed: f32 = row[8 + axis].parse().unwrap();
            assert_eq!(printed.to_bits(), force_n.to_bits(), "tick {n}");
        }
        let touched = state
            .touched()
            .map_or(String::new(), |index| index.to_string());
        assert_eq!(row[12], touched, "tick {n}");
        if seen.last() != Some(&touched) {
            seen.push(touched);
        }
    }
    assert_eq!(report.ticks, u64::from(900 * ratio));
    assert_eq!(report.taps, state.state().counters().taps);
    assert_eq!(seen, ["", "0", "1"]);
}

/// The example of docs/scenes.md.
#[test]
fn the_documented_scene_builds() {
    let docs = include_str!("../../docs/scenes.md");
    let scene = docs.split("```toml\n").nth(1).unwrap();
    let scene = scene.split("```").next().unwrap();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("desk.toml");
    fs::write(&file, scene).unwrap();
    let budget = Budget {
        share: 0.06,
        ..within(Some("cortex-m4f@48MHz"), Some(7000))
    };
    let description = Description::read(&file).unwrap();
    let built = build(
        &description,
        &budget,
        &Request::default(),
        &prompt_compiler,
        &|| (),
    )
    .unwrap();
    println!("{}", built.report);
    assert!(built.bytes.len() <= 7000 && built.report.instructions <= 2880);
    assert_eq!(
        Library::parse(&built.bytes)
            .unwrap()
            .scene()
            .unwrap()
            .surfaces()
            .len(),
        3
    );
}

/// Where nothing limits a scene, it wears the bytes that a library of the same manifest has.
#[test]
fn without_a_budget_a_scene_has_the_textures_of_a_library() {
    let textures = "[defaults]\npreview = 64\n\
        [[texture]]\nname = \"cork\"\nprompt = \"cork\"\n\
        [[texture]]\nname = \"felt\"\nprompt = \"felt\"\nfidelity = 6\n\
        [[texture]]\nname = \"both\"\nblend = { a = \"cork\", b = \"felt\" }\n";
    let wearing = |name: &str| {
        format!(
            "[[surface]]\ntexture = \"{name}\"\nsphere = {{ center_m = [0, 0, 0], radius_m = 0.1 }}\n"
        )
    };
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("list.toml");
    fs::write(&file, textures).unwrap();
    let manifest = Manifest::read(&file).unwrap();
    let request = Request::default();
    let library = Build::new(&manifest, &request).unwrap();
    let library = library.run(&prompt_compiler, &|| ()).unwrap().library;
    let mut whole = Vec::new();
    library.write(&mut whole).unwrap();
    let whole = Library::parse(&whole).unwrap();

    let text = format!("{textures}{}{}", wearing("felt"), wearing("both"));
    let scene = built(folder.path(), &text, &Budget::default()).unwrap();
    // Cork is not worn, and is a part of what is.
    assert_eq!(scene.report.unused, [""; 0]);
    let worn = Library::parse(&scene.bytes).unwrap();
    assert_eq!(worn.index().len(), 2);
    for (index, name) in ["both", "felt"].into_iter().enumerate() {
        let place = whole.index().find(name).unwrap();
        assert_eq!(
            worn.bytes(index).unwrap(),
            whole.bytes(place).unwrap(),
            "{name}"
        );
    }

    // Within a budget, a stated fidelity stays, and the other gives way.
    let roomy = built(folder.path(), &text, &within(None, Some(1 << 20))).unwrap();
    assert!(roomy.bytes.len() < scene.bytes.len(), "no previews");
    let less = within(None, Some(roomy.bytes.len() as u64 - 400));
    let tight = built(folder.path(), &text, &less).unwrap();
    let [both, felt] = &tight.report.textures[..] else {
        panic!("{}", tight.report)
    };
    assert_eq!((felt.fidelity.as_str(), felt.order), ("6", 6));
    assert!(both.error_db > 0.0, "{}", tight.report);
}

/// Textures whose rate does not divide that of the loop are converted to it, unless a rate is requested.
#[test]
fn textures_are_converted_to_the_loop_that_they_cannot_serve() {
    let folder = folder();
    let at = |line: &str| {
        format!(
            "servo_rate_hz = 1500\n{}",
            SCENE.replace("asset = \"hard.asp\"", line)
        )
    };
    let rates = |scene: &str| {
        let built = built(folder.path(), scene, &Budget::default()).unwrap();
        let library = Library::parse(&built.bytes).unwrap();
        [0, 1].map(|index| library.asset(index).unwrap().grid().sample_rate_hz())
    };
    assert_eq!(rates(&at("asset = \"hard.asp\"")), [1500.0; 2]);
    assert_eq!(rates(&at("prompt = \"oak\"\nrate = 500")), [500.0, 1500.0]);
    let refused = told(built(
        folder.path(),
        &at("prompt = \"oak\"\nrate = 1000"),
        &Budget::default(),
    ));
    assert!(
        refused.contains("\"hard\": rate: 1000 Hz does not divide"),
        "{refused}"
    );
}
