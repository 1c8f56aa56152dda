//! A scene renders only the surface that is touched. The crossing from one texture to the next
//! makes no larger step than a texture alone.

use crate::support;
use asperity::{
    emit::{
        lower::lower,
        pack::{NamedAsset, encode_scene},
    },
    model::TextureModel,
    passes::reduce::{Fidelity, reduce},
    sources::builtin,
};
use asperity_formats::{Asset, Library, SceneSurface, Solid, limits::MAX_POSITION_M as FAR};
use asperity_runtime::{
    Config, Fixed, Flags, HostCapacities, HostTexture, Output, Renderer, Sample, Scene, SceneError,
    SceneState, State, arithmetic::Scalar as _,
};
use asperity_tests::texture::HostSlot;

type TestScene<'a> = Scene<'a, 8, HostCapacities>;

/// Where one texture ends and the next begins, m.
const BORDER_M: f32 = 0.05;
const DEPTH_M: f32 = 2.0e-3;

/// The built-in texture, and one that is softer, rougher, stickier and of lower order.
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
        solid: Solid::Plane {
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

/// A scene in slots that live as long as the process. A test loads only a few.
fn load(library: &[u8]) -> TestScene<'static> {
    let library = Library::parse(library).unwrap();
    let slots = vec![HostTexture::new(); library.index().len()].leak();
    Scene::load(&library, &Config::default(), slots).unwrap()
}

fn bytes(texture: &TextureModel) -> Vec<u8> {
    lower(texture, None).expect("a valid texture").bytes
}

/// Down to a depth within 0.2 s, then along x at a constant speed, across the border.
fn stroke(speed_mm_s: f32) -> Vec<Sample> {
    let step_m = speed_mm_s * 1e-6;
    let ticks = (0.1 / step_m) as usize;
    let down = (0..200).map(|n| [0.0, 0.0, 2.0e-3 - 4.0e-3 * n as f32 / 199.0]);
    let along = (0..ticks).map(|n| [step_m * n as f32, 0.0, -DEPTH_M]);
    down.chain(along).map(Sample::at).collect()
}

fn run(scene: &TestScene<'_>, seed: u64, samples: &[Sample]) -> Vec<Output> {
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
/// Largest step of a crossing, relative to the larger one of both textures alone.
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
        for seed in 0..200 {
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
                // The same number of ticks, on this texture alone.
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

/// Without vibration a step of wall or friction could not hide. Both follow in 5 ms, so a tick
/// goes at most 1 − e^(−1/5) of the way.
#[test]
fn wall_and_friction_change_little_by_little() {
    let pair = textures().map(|mut texture| {
        for vertex in &mut texture.grid.vertices {
            vertex.sigma_m_s2 = 0.0;
        }
        bytes(&texture)
    });
    let surfaces = [plane(0, -FAR, BORDER_M), plane(1, BORDER_M, FAR)];
    let scene = load(&library(&pair, &surfaces));
    let outputs = run(&scene, 1, &stroke(100.0));
    let border = 200 + (BORDER_M / 1.0e-4) as usize;
    let crossed = &outputs[border - AROUND..border + 2 * AROUND];
    let way_n = step_n(&crossed[0], &crossed[crossed.len() - 1]);
    assert!(way_n > 0.2, "{way_n} N of way");
    let at_once_n = largest_step_n(crossed);
    assert!(
        at_once_n <= 0.25 * way_n,
        "{at_once_n} N of {way_n} N at once"
    );
}

#[test]
#[cfg_attr(
    not(hatt),
    ignore = "no HaTT materials; set ASPERITY_HATT to their folder"
)]
fn a_crossing_between_recorded_materials_is_smooth() {
    let files = asperity_tests::hatt::materials();
    let import = |name: &str| {
        let file = files
            .iter()
            .find(|file| file.to_string_lossy().contains(name))
            .expect("a HaTT material");
        support::hatt(file)
    };
    crossing_is_smooth("HaTT", &[import("Cork"), import("Stone Tile 1")]);
}

/// On one surface, far from all others, a scene gives the bits of that surface alone.
#[test]
fn only_the_touched_surface_is_rendered() {
    let [hard, soft] = textures().map(|t| bytes(&t));
    let scene = load(&library(
        &[hard, soft.clone()],
        &[plane(0, -FAR, -0.02), plane(1, -0.01, FAR)],
    ));
    let config = Config {
        solid: Solid::Plane {
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
    // So do bad samples: the gate holds the last one on the same surface.
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
        solid: Solid::Sphere {
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

/// A ball, a box and a plane that interpenetrate, on both textures.
fn heap() -> TestScene<'static> {
    let pair = textures().map(|t| bytes(&t));
    let anywhere = |solid, texture| SceneSurface {
        solid,
        from_m: [-FAR; 3],
        to_m: [FAR; 3],
        texture,
    };
    let ball = Solid::Sphere {
        center_m: [0.0, 0.0, 0.01],
        radius_m: 0.015,
    };
    let cube = Solid::Box {
        center_m: [0.02, 0.0, 0.0],
        half_extents_m: [0.01; 3],
    };
    let surfaces = [anywhere(ball, 0), anywhere(cube, 1), plane(0, -FAR, 0.03)];
    load(&library(&pair, &surfaces))
}

/// For any samples, also over edges and from solid to solid, the force is finite and within peak
/// and slew.
#[test]
fn every_force_is_within_peak_and_slew() {
    let scene = heap();
    let limits = Config::default().limits;
    let slew_n = limits.slew_n_s / 1000.0;
    let mut random = 1_u64;
    let mut draw = move || {
        random = random
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (random >> 40) as f32 / (1_u64 << 24) as f32
    };
    let mut position_m = [0.0, 0.0, 0.03];
    let samples: Vec<Sample> = (0..20_000)
        .map(|n| {
            for (axis, half_m) in [0.04, 0.02, 0.03].into_iter().enumerate() {
                let moved = position_m[axis] + 1.0e-3 * (draw() - 0.5);
                position_m[axis] = moved.clamp(-half_m, half_m);
            }
            let mut sample = Sample::at(position_m);
            match n % 97 {
                0..3 => sample.position_m[n % 3] = f32::NAN,
                40..44 => sample = Sample::STALE,
                60 => sample.position_m[1] = f32::INFINITY,
                80 => sample.elapsed_ticks = 1 + (n % 7) as u32,
                // A jump, as to another solid.
                90 => position_m = [0.04 * (draw() - 0.5), 0.0, 0.02 * draw()],
                _ => {}
            }
            sample
        })
        .collect();
    let outputs = run(&scene, 3, &samples);
    let size = |v: [f32; 3]| v.iter().map(|x| x * x).sum::<f32>().sqrt();
    for (n, output) in outputs.iter().enumerate() {
        assert!(output.force_n.iter().all(|x| x.is_finite()), "tick {n}");
        assert!(size(output.force_n) <= limits.peak_n * 1.0001, "tick {n}");
    }
    for (n, pair) in outputs.windows(2).enumerate() {
        assert!(step_n(&pair[0], &pair[1]) <= slew_n * 1.0001, "tick {n}");
    }
    let contacts = outputs.iter().filter(|o| o.flags.contains(Flags::CONTACT));
    assert!((4_000..16_000).contains(&contacts.count()));
}

/// From one texture to the next through the air: the new contact is a tap. It is mute until its
/// own model is made, and nothing of the previous texture is heard.
#[test]
fn a_surface_that_is_left_is_not_heard_on_the_next() {
    let pair = textures().map(|t| bytes(&t));
    let scene = load(&library(
        &pair,
        &[plane(0, -FAR, BORDER_M), plane(1, BORDER_M, FAR)],
    ));
    let mut samples = stroke(100.0);
    // Half a second on the first texture, up by 5 mm over 50 ticks, over the border, down.
    samples.truncate(700);
    let x_m = samples[699].position_m[0];
    let hop = (0..200).map(|n| {
        let up = if n < 50 { n } else { 199 - n.max(149) };
        let along_m = x_m + 1.0e-4 * n as f32;
        Sample::at([along_m, 0.0, -DEPTH_M + 1.4e-4 * up as f32])
    });
    let rest: Vec<Sample> = hop.collect();
    let last_m = rest[199].position_m;
    samples.extend(rest);
    samples.extend((0..100).map(|n| Sample::at([last_m[0] + 1.0e-4 * n as f32, 0.0, -DEPTH_M])));
    let outputs = run(&scene, 2, &samples);
    let touching = |n: usize| outputs[n].flags.contains(Flags::CONTACT);
    let left = (700..900).find(|&n| !touching(n)).unwrap();
    let entered = (left..1000).find(|&n| touching(n)).unwrap();
    assert!(samples[entered].position_m[0] > BORDER_M && entered > left + 100);
    assert!(outputs[entered].flags.contains(Flags::TAP_STARTED));
    assert!(outputs[left..entered].iter().all(|o| o.vib_m_s2 == 0.0));
    let heard = (entered..1000)
        .find(|&n| outputs[n].vib_m_s2 != 0.0)
        .unwrap();
    assert!(
        (entered + 5..entered + 12).contains(&heard),
        "{}",
        heard - entered
    );
}

/// Leaving a region sideways, or entering another one far below its surface, is no impact.
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
    let mut slots = vec![HostTexture::new(); 2];
    let named = [NamedAsset {
        name: "a",
        bytes: &pair[0],
    }];
    let plain = asperity::emit::pack::encode(&named).unwrap();
    let mut refused = |bytes: &[u8], room: usize| {
        let library = Library::parse(bytes).unwrap();
        TestScene::load(&library, &config, &mut slots[..room]).expect_err("no scene that fits")
    };
    assert_eq!(refused(&plain, 2), SceneError::NoScene);
    let capacity = |field, found, capacity| SceneError::Capacity {
        field,
        found,
        capacity,
    };
    let wide = library(&pair, &[plane(0, -FAR, FAR); 9]);
    assert_eq!(refused(&wide, 2), capacity("surfaces", 9, 8));
    let two = library(&pair, &[plane(1, -FAR, FAR)]);
    assert_eq!(refused(&two, 1), capacity("textures", 2, 1));
    assert_eq!(refused(&two, 0), capacity("textures", 2, 0));
}

/// Fixed point gives the same surfaces, crossings and taps as floats, within a millinewton.
#[test]
fn a_scene_in_fixed_point_is_that_of_floats() {
    let pair = textures().map(|texture| bytes(&texture));
    let surfaces = [plane(0, -FAR, BORDER_M), plane(1, BORDER_M, FAR)];
    let bytes = library(&pair, &surfaces);
    let samples = stroke(70.0);
    let floats = run(&load(&bytes), 5, &samples);

    let mut slots = [const { HostSlot::<Fixed>::new() }; 2];
    let library = Library::parse(&bytes).unwrap();
    let scene: Scene<'_, 8, HostCapacities, Fixed> =
        Scene::load(&library, &Config::default(), &mut slots).unwrap();
    let renderer = Renderer::<Fixed>::prepare(&Config::default()).unwrap();
    let mut state = SceneState::<Fixed>::new(5);
    let mut worst_n = 0.0_f32;
    for (sample, float) in samples.iter().zip(&floats) {
        let fixed = renderer.tick_scene(&scene, &mut state, &Sample::of(sample));
        assert_eq!(fixed.flags, float.flags);
        for (a, b) in fixed.force_n.iter().zip(float.force_n) {
            worst_n = worst_n.max((a.value() - b).abs());
        }
    }
    assert_eq!(state.touched(), Some(1));
    println!("a scene in fixed point is within {:.3} mN", 1e3 * worst_n);
    assert!(worst_n < 1e-3, "{worst_n} N");
}

#[test]
fn a_surface_out_of_reach_of_fixed_point_is_refused() {
    let pair = textures().map(|texture| bytes(&texture));
    let mut far = plane(0, -FAR, FAR);
    far.solid = Solid::Plane {
        point_m: [0.0, 0.0, -1.5],
        normal: [0.0, 0.0, 1.0],
    };
    let bytes = library(&pair[..1], &[far]);
    let mut slots = [const { HostSlot::<Fixed>::new() }; 1];
    let library = Library::parse(&bytes).unwrap();
    let loaded = Scene::<8, HostCapacities, Fixed>::load(&library, &Config::default(), &mut slots);
    assert!(matches!(
        loaded,
        Err(SceneError::Surface { index: 0, cause }) if cause.field == "solid.point_m"
    ));
}
