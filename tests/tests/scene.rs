//! A scene renders the surface that is touched and no other, and the way from one texture to
//! the next has no step that a texture alone would not have.

use asperity::{
    builtin, hatt,
    library::{NamedAsset, encode_scene},
    lower::lower,
    model::TextureModel,
    reduce::{Fidelity, reduce},
};
use asperity_formats::{Asset, Library, SceneSurface, Shape, limits::MAX_POSITION_M as FAR};
use asperity_runtime::{
    Config, Flags, HostTexture, Output, Renderer, Sample, Scene, SceneError, SceneState, State,
    Surface,
};

type HostScene = Scene<8, 3, 64, 128, 24, 24, 4096>;

/// Where one texture ends and the next begins, m.
const BORDER_M: f32 = 0.05;
const DEPTH_M: f32 = 2.0e-3;

/// The built-in texture; one that is softer, rougher, of lower order and stickier.
fn textures() -> [TextureModel; 2] {
    let hard = builtin::texture();
    let mut soft = reduce(&hard, Fidelity::Order(4)).texture;
    for vertex in &mut soft.grid.vertices {
        vertex.sigma_m_s2 *= 2.0;
    }
    soft.wall.stiffness_n_m *= 0.7;
    soft.friction.mu += 0.4;
    [hard, soft]
}

fn plane(texture: u16, from_x_m: f32, to_x_m: f32) -> SceneSurface {
    SceneSurface {
        shape: Shape::Plane {
            point_m: [0.0; 3],
            normal: [0.0, 0.0, 1.0],
        },
        from_m: [from_x_m, -FAR, -FAR],
        to_m: [to_x_m, FAR, FAR],
        texture,
    }
}

fn library(textures: &[Vec<u8>], surfaces: &[SceneSurface]) -> Vec<u8> {
    let names = ["a", "b", "c"];
    let named: Vec<NamedAsset<'_>> = names
        .iter()
        .zip(textures)
        .map(|(name, bytes)| NamedAsset { name, bytes })
        .collect();
    encode_scene(&named, surfaces).expect("a valid scene")
}

fn load(library: &[u8]) -> Box<HostScene> {
    let mut scene = Box::new(HostScene::new());
    let library = Library::parse(library).unwrap();
    scene.load(&library, &Config::default()).unwrap();
    scene
}

fn bytes(texture: &TextureModel) -> Vec<u8> {
    lower(texture, None).expect("a valid texture").bytes
}

/// Down to a depth within 0.2 s, then along x at a speed, through the border.
fn stroke(speed_mm_s: f32) -> Vec<Sample> {
    let step_m = speed_mm_s * 1e-6;
    let ticks = (0.1 / step_m) as usize;
    let down = (0..200).map(|n| [0.0, 0.0, 2.0e-3 - 4.0e-3 * n as f32 / 199.0]);
    let along = (0..ticks).map(|n| [step_m * n as f32, 0.0, -DEPTH_M]);
    down.chain(along).map(Sample::at).collect()
}

fn run(scene: &HostScene, seed: u64, samples: &[Sample]) -> Vec<Output> {
    let renderer = Renderer::new(&Config::default()).unwrap();
    let mut state = SceneState::new(seed);
    let tick = |sample| renderer.tick_scene(scene, &mut state, sample);
    samples.iter().map(tick).collect()
}

fn step_n(a: &Output, b: &Output) -> f32 {
    let squared = |axis: usize| (b.force_n[axis] - a.force_n[axis]).powi(2);
    (squared(0) + squared(1) + squared(2)).sqrt()
}

/// Largest step of the force from the tick `from` on, N.
fn largest_step_n(outputs: &[Output]) -> f32 {
    let steps = outputs.windows(2).map(|pair| step_n(&pair[0], &pair[1]));
    steps.fold(0.0, f32::max)
}

/// Ticks before and after the border that count as the crossing.
const AROUND: usize = 30;
/// A crossing's largest step over the larger of both textures alone.
const ALLOWED: f32 = 1.1;

fn crossing_is_smooth(name: &str, pair: &[Vec<u8>; 2]) {
    let across = load(&library(
        pair,
        &[plane(0, -FAR, BORDER_M), plane(1, BORDER_M, FAR)],
    ));
    let alone = [0, 1].map(|texture| load(&library(pair, &[plane(texture, -FAR, FAR)])));
    for speed_mm_s in [50.0, 200.0] {
        let samples = stroke(speed_mm_s);
        let border = 200 + (BORDER_M / (speed_mm_s * 1e-6)) as usize;
        let steady = samples.len() - border;
        let (mut crossing_n, mut alone_n) = (0.0_f32, 0.0_f32);
        for seed in 0..40 {
            let outputs = run(&across, seed, &samples);
            let crossed = &outputs[border - AROUND..border + AROUND];
            crossing_n = crossing_n.max(largest_step_n(crossed));
            assert!(
                crossed
                    .iter()
                    .all(|o| !o.flags.contains(Flags::SLEW_LIMITED)),
                "{name}: the limiter had to step in"
            );
            for scene in &alone {
                let outputs = run(scene, seed, &samples);
                // As many ticks, steady on the texture.
                let part = &outputs[outputs.len() - steady..][..2 * AROUND];
                alone_n = alone_n.max(largest_step_n(part));
            }
        }
        println!("{name} {speed_mm_s} mm/s: {crossing_n:.4} N across, {alone_n:.4} N alone");
        assert!(
            crossing_n <= ALLOWED * alone_n,
            "{name} {speed_mm_s} mm/s: {crossing_n} N across, {alone_n} N alone"
        );
    }
}

#[test]
fn a_crossing_has_no_larger_step_than_its_textures() {
    let [hard, soft] = textures().map(|t| bytes(&t));
    crossing_is_smooth("down", &[hard.clone(), soft.clone()]);
    crossing_is_smooth("up", &[soft, hard]);
}

#[test]
fn a_crossing_between_recorded_materials_is_smooth() {
    let files = asperity_tests::hatt::materials("crossing");
    if files.is_empty() {
        return;
    }
    let import = |name: &str| {
        let file = files
            .iter()
            .find(|file| file.to_string_lossy().contains(name))
            .expect("a HaTT material");
        hatt::import(file, None).expect("an import").bytes
    };
    crossing_is_smooth("HaTT", &[import("Cork"), import("Stone Tile 1")]);
}

/// On one surface far from all others a scene gives the very bits of that surface alone.
#[test]
fn only_the_touched_surface_is_rendered() {
    let [hard, soft] = textures().map(|t| bytes(&t));
    let scene = load(&library(
        &[hard, soft.clone()],
        &[plane(0, -FAR, -0.02), plane(1, -0.01, FAR)],
    ));
    let config = Config {
        surface: Surface::Plane {
            point_m: [0.0; 3],
            normal: [0.0, 0.0, 1.0],
        },
        ..Config::default()
    };
    let renderer = Renderer::new(&config).unwrap();
    let mut slot = Box::new(HostTexture::new());
    slot.load(&Asset::parse(&soft).unwrap(), config.servo_rate_hz)
        .unwrap();
    let mut state = State::new(7);
    let mut samples = stroke(80.0);
    // Bad samples too: the gate holds the last one on the same surface.
    for n in [300, 301, 500, 501, 502, 503] {
        samples[n] = Sample::STALE;
    }
    samples[700] = Sample::at([-0.05, f32::NAN, 0.0]);
    let outputs = run(&scene, 7, &samples);
    for (n, (sample, output)) in samples.iter().zip(&outputs).enumerate() {
        assert_eq!(
            *output,
            renderer.tick(&slot, &mut state, sample),
            "tick {n}"
        );
    }
    assert!(outputs.iter().any(|o| o.vib_m_s2 != 0.0));
}

/// A stylus that trembles at a border stays on one texture.
#[test]
fn noise_at_a_border_changes_nothing() {
    let pair = textures().map(|t| bytes(&t));
    let scene = load(&library(
        &pair,
        &[plane(0, -FAR, BORDER_M), plane(1, BORDER_M, FAR)],
    ));
    let renderer = Renderer::new(&Config::default()).unwrap();
    let mut state = SceneState::new(1);
    let mut touched = Vec::new();
    for n in 0..400 {
        let tremble_m = if n % 2 == 0 { 5.0e-5 } else { -5.0e-5 };
        let position_m = [BORDER_M + tremble_m, 0.0, -1.0e-3];
        renderer.tick_scene(&scene, &mut state, &Sample::at(position_m));
        touched.push(state.touched());
    }
    assert!(touched.iter().all(|at| *at == touched[0]), "{touched:?}");
    assert!(touched[0].is_some());
}

#[test]
fn the_deepest_surface_is_touched_and_none_outside_every_region() {
    let pair = textures().map(|t| bytes(&t));
    let ball = |x_m: f32, texture| SceneSurface {
        shape: Shape::Sphere {
            center_m: [x_m, 0.0, 0.0],
            radius_m: 0.02,
        },
        from_m: [-0.05; 3],
        to_m: [0.05; 3],
        texture,
    };
    let scene = load(&library(&pair, &[ball(-0.015, 0), ball(0.015, 1)]));
    let renderer = Renderer::new(&Config::default()).unwrap();
    for (position_m, expected) in [
        ([-0.002, 0.0, 0.0], Some(0)),
        ([0.002, 0.0, 0.0], Some(1)),
        ([0.0, 0.03, 0.0], None),
        ([0.06, 0.0, 0.0], None),
    ] {
        let mut state = SceneState::new(1);
        let output = renderer.tick_scene(&scene, &mut state, &Sample::at(position_m));
        assert_eq!(state.touched(), expected, "{position_m:?}");
        assert_eq!(output.flags.contains(Flags::CONTACT), expected.is_some());
    }
}

/// Leaving a region sideways, and crossing into another at once deep, is no impact.
#[test]
fn a_crossing_is_no_tap() {
    let pair = textures().map(|t| bytes(&t));
    let scene = load(&library(
        &pair,
        &[plane(0, -FAR, BORDER_M), plane(1, BORDER_M + 0.005, FAR)],
    ));
    let outputs = run(&scene, 1, &stroke(100.0));
    let down = 210;
    assert!(
        outputs[..down]
            .iter()
            .any(|o| o.flags.contains(Flags::TAP_STARTED))
    );
    assert!(
        !outputs[down..]
            .iter()
            .any(|o| o.flags.contains(Flags::TAP_STARTED))
    );
    assert!(
        outputs[down..]
            .iter()
            .any(|o| !o.flags.contains(Flags::CONTACT))
    );
}

#[test]
fn what_is_no_scene_or_does_not_fit_is_refused() {
    let pair = textures().map(|t| bytes(&t));
    let config = Config::default();
    let mut scene = Box::new(HostScene::new());
    let named = [NamedAsset {
        name: "a",
        bytes: &pair[0],
    }];
    let plain = asperity::library::encode(&named).unwrap();
    let refused = scene.load(&Library::parse(&plain).unwrap(), &config);
    assert_eq!(refused, Err(SceneError::NoScene));
    let wide = library(&pair, &[plane(0, -FAR, FAR); 9]);
    let refused = scene.load(&Library::parse(&wide).unwrap(), &config);
    assert!(matches!(
        refused,
        Err(SceneError::Capacity {
            field: "surfaces",
            found: 9,
            capacity: 8
        })
    ));
    assert!(scene.is_empty());
    let outputs = run(&scene, 1, &stroke(100.0));
    assert!(outputs.iter().all(|o| o.force_n == [0.0; 3]));
}
