//! Ribs, grains and naps by law: where their line lies, how level and friction follow a stroke, and on which solids.

use crate::scenes::{library_of, on_library};
use asperity_formats::{
    Asset, Direction, LsfCode, Numerator, SceneSurface, Solid, Vertex, VertexKind,
};
use asperity_runtime::{
    Config, Fixed, Flags, Float, RenderArithmetic, Renderer, Sample, SceneState, State,
    arithmetic::Scalar as _,
};
use asperity_tests::{
    draw::Draw,
    texture::{HostSlot, Model, Texture, TextureKind, random, random_direction},
};
use std::f64::consts::TAU;

const DEPTH_M: f64 = 2e-3;

/// Bare ribs along y: nothing is felt along them.
const RIBS: Direction = Direction {
    axis: [0.0, 1.0, 0.0],
    power_ratio: 0.0,
    speed_ratio: 1.0,
    mu_forward: 1.0,
    mu_backward: 1.0,
};

/// A texture of the lines and the variances that `model` gives at a speed, of a level that grows with it.
fn texture(
    speeds_mm_s: &[f64],
    direction: Direction,
    model: impl Fn(f64) -> (Vec<u16>, f64),
) -> Texture {
    let columns = speeds_mm_s.len();
    let mut texture = random(1, TextureKind::nyquist(4));
    texture.numerator = Numerator::None;
    texture.traces.clear();
    texture.mu = 0.4;
    texture.coupling.stiffness_n_m = 500.0;
    texture.direction = Some(direction);
    texture.models = (speeds_mm_s.iter())
        .map(|&speed| Model {
            lsf: model(speed).0,
            ma_lsf: Vec::new(),
            gain: 1.0,
        })
        .collect();
    let vertex = |row: usize, column: usize| Vertex {
        speed_mm_s: speeds_mm_s[column] as f32,
        force_n: 4.0 * row as f32,
        sigma_m_s2: (0.01 * speeds_mm_s[column] / model(speeds_mm_s[column]).1.sqrt()) as f32,
        model: column as u8,
        kind: VertexKind::Edge,
    };
    texture.vertices = (0..2)
        .flat_map(|row| (0..columns).map(move |column| vertex(row, column)))
        .collect();
    texture.triangles = (0..columns as u8 - 1)
        .flat_map(|at| {
            let up = at + columns as u8;
            [[at, at + 1, up], [at + 1, up + 1, up]]
        })
        .collect();
    texture
}

/// A grating across which a stroke of v meets a line at v/λ: two poles of radius 0.99.
fn grating(wavelength_mm: f64) -> Texture {
    let steps = (0..14).map(|step| 25.0 * 1.25_f64.powi(step) * wavelength_mm);
    let speeds: Vec<f64> = std::iter::once(0.0).chain(steps).collect();
    texture(&speeds, RIBS, |speed| {
        let radius = 0.99;
        let w = TAU * (speed / wavelength_mm).max(20.0) / 1000.0;
        let (a1, a2) = (-2.0 * radius * w.cos(), radius * radius);
        let cosines = [(1.0 - a1 - a2) / 2.0, (a2 - a1 - 1.0) / 2.0];
        let mut codes = cosines.map(|cos: f64| LsfCode::from_rad(cos.acos()).unwrap().to_bits());
        codes.sort_unstable();
        let one = 1.0 + a2;
        let variance = one / ((1.0 - a2) * (one * one - a1 * a1));
        (codes.to_vec(), variance)
    })
}

/// A texture whose samples are white noise, of a level that grows with speed.
fn white(direction: Direction) -> Texture {
    texture(&[0.0, 60.0, 120.0, 240.0], direction, |_| {
        ((1..=4).map(|k| (65536 * k / 5) as u16).collect(), 1.0)
    })
}

/// A renderer, and a slot that holds a texture.
fn loaded<A: RenderArithmetic>(
    texture: &Texture,
    config: &Config,
) -> (Renderer<A>, Box<HostSlot<A>>) {
    let bytes = texture.encode();
    let mut slot = Box::new(HostSlot::new());
    let asset = Asset::parse(&bytes).unwrap();
    slot.load(&asset, config.servo_rate_hz).unwrap();
    (Renderer::prepare(config).unwrap(), slot)
}

/// Renders a path in the plane z = 0, in contact, and gives vibration and friction of each tick.
fn render<A: RenderArithmetic>(
    texture: &Texture,
    config: &Config,
    path: impl Iterator<Item = [f64; 2]>,
) -> Vec<(f64, f64)> {
    let (renderer, slot) = loaded::<A>(texture, config);
    let mut state = State::new(1);
    path.map(|[x, y]| {
        let sample = Sample::at([x, y, -DEPTH_M].map(|part| part as f32));
        let output = renderer.tick(&slot, &mut state, &Sample::of(&sample));
        assert!(output.flags.contains(Flags::CONTACT));
        (
            output.vib_m_s2.value().into(),
            output.friction_n.value().into(),
        )
    })
    .collect()
}

/// Strokes of 0.4 m to and fro at a speed, mm/s, at an angle from x.
fn strokes(speed_mm_s: f64, degrees: f64, ticks: usize) -> impl Iterator<Item = [f64; 2]> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    (0..ticks).map(move |tick| {
        let way = speed_mm_s * 1e-6 * tick as f64 % 0.8;
        let along = if way < 0.4 { way } else { 0.8 - way } - 0.2;
        [along * cos, along * sin]
    })
}

/// Frequency of the pole of a signal, Hz, by Yule and Walker at order 2.
fn line_hz(y: &[f64]) -> f64 {
    let lag = |k: usize| y.iter().zip(&y[k..]).map(|(a, b)| a * b).sum::<f64>();
    let (r0, r1, r2) = (lag(0), lag(1), lag(2));
    let scale = r0 * r0 - r1 * r1;
    let (a1, a2) = (r1 * (r0 - r2) / scale, (r0 * r2 - r1 * r1) / scale);
    (a1 / (2.0 * (-a2).sqrt())).acos() / TAU * 1000.0
}

fn level_db(y: &[f64]) -> f64 {
    10.0 * (y.iter().map(|y| y * y).sum::<f64>() / y.len() as f64 + 1e-12).log10()
}

/// Across the ribs of gratings of 0.3 to 4 mm the line lies at v·|cos θ|/λ, and none along.
#[test]
fn the_line_of_a_grating_lies_at_the_cosine() {
    let vibration = |texture: &Texture, speed: f64, degrees: f64| -> Vec<f64> {
        let ticks = strokes(speed, degrees, 12_000);
        let rendered = render::<Float>(texture, &Config::default(), ticks);
        rendered.into_iter().skip(500).map(|(y, _)| y).collect()
    };
    for wavelength_mm in [0.3, 0.7, 1.5, 4.0] {
        let ribs = grating(wavelength_mm);
        // The fastest hand.
        let speed = (350.0 * wavelength_mm).min(400.0);
        let across = vibration(&ribs, speed, 0.0);
        for degrees in [0.0, 20.0, -45.0, 60.0, 70.0, 180.0] {
            let exact = speed * f64::cos(f64::to_radians(degrees)).abs() / wavelength_mm;
            if !(40.0..=400.0).contains(&exact) {
                continue;
            }
            let found = line_hz(&vibration(&ribs, speed, degrees));
            let error = found / exact - 1.0;
            assert!(
                error.abs() < 0.03,
                "{wavelength_mm} mm, {degrees}°: {found} Hz, not {exact}"
            );
        }
        let along = vibration(&ribs, speed, 90.0);
        let apart = level_db(&across) - level_db(&along);
        assert!(apart > 25.0, "{wavelength_mm} mm: {apart} dB");
    }
}

/// Round a circle at constant speed the level is that of the angle, and no tick changes it by more than 1 dB.
#[test]
fn the_level_follows_a_circle_without_a_step() {
    for (power_ratio, worst_db) in [(0.5, 0.3), (0.1, 0.7), (0.06, 1.0)] {
        let direction = Direction {
            power_ratio,
            ..RIBS
        };
        // 20 mm of radius at 120 mm/s.
        let (radius_m, rate) = (0.02, 6.0e-3);
        let circle = (0..4000).map(|tick| {
            let (sin, cos) = (rate * f64::from(tick)).sin_cos();
            [radius_m * cos, radius_m * sin]
        });
        let with = |direction: Option<Direction>| -> Vec<f64> {
            let texture = Texture {
                direction,
                ..white(RIBS)
            };
            let ticks = render::<Float>(&texture, &Config::default(), circle.clone());
            ticks.into_iter().map(|(y, _)| y).collect()
        };
        let (found, plain) = (with(Some(direction)), with(None));
        let mut last: Option<f64> = None;
        let mut steepest = 0.0_f64;
        for (tick, (found, plain)) in found.iter().zip(&plain).enumerate().skip(300) {
            // A small sample says little about its factor.
            if plain.abs() < 0.05 {
                continue;
            }
            let db = 20.0 * (found / plain).abs().log10();
            // The velocity of the tick before, and up to ten more ticks of delay: 8 ms in the mean.
            let angle = rate * (tick as f64 - 12.0);
            let (along, across) = (angle.cos().powi(2), angle.sin().powi(2));
            let exact = 10.0 * (across + f64::from(power_ratio) * along).log10();
            assert!(
                (db - exact).abs() < 2.0 * worst_db + 0.5,
                "{tick}: {db} {exact}"
            );
            if let Some(last) = last {
                steepest = steepest.max((db - last).abs());
            }
            last = Some(db);
        }
        println!("{power_ratio}: {steepest} dB");
        assert!(
            steepest < worst_db,
            "{power_ratio}: {steepest} dB in a tick"
        );
    }
}

/// Friction has its own size along the axis, in each sense of a nap; strokes to and fro across are alike.
#[test]
fn friction_has_a_size_in_each_direction() {
    fn check<A: RenderArithmetic>() {
        let nap = Direction {
            power_ratio: 1.0,
            mu_forward: 0.7,
            mu_backward: 1.6,
            ..RIBS
        };
        let texture = Texture {
            direction: Some(nap),
            ..white(RIBS)
        };
        for (degrees, factor) in [
            (0.0, 1.0),
            (180.0, 1.0),
            (90.0, 0.7),
            (-90.0, 1.6),
            (45.0, 0.85),
            (-45.0, 1.3),
            (135.0, 0.85),
        ] {
            // 60 mm/s for half a stroke.
            let ticks = strokes(60.0, degrees, 1300);
            let friction = render::<A>(&texture, &Config::default(), ticks);
            let found = friction[1250].1;
            let load_n = 0.4 * 500.0 * DEPTH_M;
            let exact = factor * load_n;
            assert!(
                (found - exact).abs() < 0.01 * exact,
                "{degrees}: {found} {exact}"
            );
        }
    }
    check::<Float>();
    check::<Fixed>();
}

/// A stroke turns back on one line: the friction that it meets has the same course either way.
#[test]
fn a_reversal_across_ribs_is_symmetric() {
    let ribs = white(RIBS);
    let sine = |sign: f64| {
        (0..3000).map(move |tick| [sign * 0.02 * (TAU * f64::from(tick) / 1000.0).sin(), 0.0])
    };
    let to = render::<Float>(&ribs, &Config::default(), sine(1.0));
    let fro = render::<Float>(&ribs, &Config::default(), sine(-1.0));
    for ((to, fro), tick) in to.iter().zip(&fro).zip(0..) {
        assert!(
            (to.0.abs() - fro.0.abs()).abs() < 1e-4,
            "{tick}: {to:?} {fro:?}"
        );
        assert!((to.1 - fro.1).abs() < 1e-5, "{tick}: {to:?} {fro:?}");
    }
}

/// The axis lies in the world: on the faces of a box and round a sphere it is met at the angle of its projection.
#[test]
fn the_axis_is_projected_on_every_solid() {
    fn check<A: RenderArithmetic>() {
        let ribs = Direction {
            power_ratio: 1.0,
            mu_forward: 2.0,
            mu_backward: 2.0,
            ..RIBS
        };
        let texture = Texture {
            direction: Some(ribs),
            ..white(RIBS)
        };
        let cube = Solid::Box {
            center_m: [0.0; 3],
            half_extents_m: [0.03; 3],
        };
        let ball = Solid::Sphere {
            center_m: [0.0; 3],
            radius_m: 0.03,
        };
        // Inside a face, where the stroke goes, and the factor of μ.
        for (solid, normal, stroke, factor) in [
            (cube, [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], 1.0),
            (cube, [0.0, 0.0, 1.0], [0.0, 1.0, 0.0], 2.0),
            (cube, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], 2.0),
            (cube, [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], 1.0),
            // The axis is normal to this face.
            (cube, [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], 1.5),
            (cube, [0.0, 1.0, 0.0], [0.6, 0.0, 0.8], 1.5),
            (ball, [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], 1.0),
            (ball, [0.0, 0.0, 1.0], [0.0, 1.0, 0.0], 2.0),
            (ball, [0.8, 0.6, 0.0], [0.0, 0.0, 1.0], 1.0),
            (ball, [0.8, 0.6, 0.0], [-0.6, 0.8, 0.0], 2.0),
        ] {
            let config = Config {
                solid,
                ..Config::default()
            };
            let (renderer, slot) = loaded::<A>(&texture, &config);
            let mut state = State::new(1);
            let mut last = [0.0; 2];
            for tick in 0..300 {
                // 50 mm/s, at the place in the end.
                let along = 5e-5 * f64::from(tick - 299);
                let position: [f64; 3] =
                    std::array::from_fn(|k| (0.03 - DEPTH_M) * normal[k] + along * stroke[k]);
                let length = position.iter().map(|x| x * x).sum::<f64>().sqrt();
                let position = if matches!(solid, Solid::Sphere { .. }) {
                    position.map(|x| x * (0.03 - DEPTH_M) / length)
                } else {
                    position
                };
                let sample = Sample::at(position.map(|x| x as f32));
                let output = renderer.tick(&slot, &mut state, &Sample::of(&sample));
                last = [output.friction_n.value(), output.normal_force_n.value()].map(f64::from);
            }
            let found = last[0] / (0.4 * last[1]);
            assert!(
                (found - factor).abs() < 0.03,
                "{solid:?} {normal:?} {stroke:?}: {found}"
            );
        }
    }
    check::<Float>();
    check::<Fixed>();
}

/// Across the pole of a sphere, where the axis is normal to the surface, friction goes over without a step.
#[test]
fn nothing_jumps_at_the_pole_of_a_sphere() {
    let ribs = Direction {
        axis: [0.0, 0.0, 1.0],
        power_ratio: 1.0,
        mu_forward: 1.8,
        mu_backward: 1.8,
        ..RIBS
    };
    let texture = Texture {
        direction: Some(ribs),
        ..white(RIBS)
    };
    let config = Config {
        solid: Solid::Sphere {
            center_m: [0.0; 3],
            radius_m: 0.03,
        },
        ..Config::default()
    };
    let (renderer, slot) = loaded::<Float>(&texture, &config);
    // Over the pole, and past it by half a millimetre.
    for miss in [0.0, 0.0005, 0.003] {
        let mut state = State::new(1);
        let mut last = None;
        for tick in 0..1000 {
            let angle = 2e-3 * f64::from(tick - 500);
            let (sin, cos) = angle.sin_cos();
            let r = 0.03 - DEPTH_M;
            let position = [r * sin, miss, r * cos].map(|x| x as f32);
            let output = renderer.tick(&slot, &mut state, &Sample::at(position));
            if tick > 100 {
                let friction_n = output.friction_n;
                if let Some(last) = last {
                    let step: f32 = friction_n - last;
                    assert!(step.abs() < 0.02, "{miss} {tick}: {step} N");
                }
                last = Some(friction_n);
            }
        }
    }
}

/// In a scene, from ribs to a plain surface and back while in contact.
#[test]
fn ribs_go_over_into_a_plain_surface() {
    let nap = Direction {
        mu_forward: 2.0,
        mu_backward: 2.0,
        power_ratio: 1.0,
        ..RIBS
    };
    let textures = [Some(nap), None].map(|direction| Texture {
        direction,
        ..white(RIBS)
    });
    let half = |texture: u16, from: f32, to: f32| SceneSurface {
        solid: Solid::Plane {
            point_m: [0.0; 3],
            normal: [0.0, 0.0, 1.0],
        },
        from_m: [-1.0, from, -1.0],
        to_m: [1.0, to, 1.0],
        texture,
    };
    let library = library_of(&textures, &[half(0, -1.0, 0.0), half(1, 0.0, 1.0)]);
    on_library::<Float, _>(&library, |scene, renderer| {
        let mut state = SceneState::new(1);
        let friction: Vec<f32> = (0..2000)
            .map(|tick| {
                // 60 mm/s along y.
                let y = 6e-5 * (tick - 1000) as f32;
                let sample = Sample::at([0.0, y, -DEPTH_M as f32]);
                renderer.tick_scene(scene, &mut state, &sample).friction_n
            })
            .collect();
        let plain = 0.4 * 500.0 * DEPTH_M as f32;
        assert!(
            (friction[990] - 2.0 * plain).abs() < 0.01 * plain,
            "{}",
            friction[990]
        );
        assert!(
            (friction[1999] - plain).abs() < 0.01 * plain,
            "{}",
            friction[1999]
        );
        for pair in friction[200..].windows(2) {
            assert!((pair[1] - pair[0]).abs() < 0.25 * plain, "{pair:?}");
        }
    });
}

/// Friction that depends on the direction only takes energy: no closed path in the plane gains any.
#[test]
fn no_closed_path_over_a_nap_gains_energy() {
    let mut draw = Draw::new(17);
    for _ in 0..200 {
        let direction = Direction {
            power_ratio: 1.0,
            ..random_direction(&mut draw)
        };
        let mut texture = white(direction);
        for vertex in &mut texture.vertices {
            vertex.sigma_m_s2 = 0.0;
        }
        let (renderer, slot) = loaded::<Float>(&texture, &Config::default());
        let mut state = State::new(1);
        let (a, b) = (draw.range(1e-4, 0.01), draw.range(1e-4, 0.01));
        let (rate, phase) = (draw.range(2.0, 30.0), draw.range(0.0, TAU));
        let ticks = (6000.0 * TAU / rate / 10.0) as usize;
        let place = |tick: usize| {
            let turn = TAU * 3.0 * tick as f64 / ticks as f64;
            [
                a * turn.sin(),
                b * ((2.0 * turn + phase).sin() - phase.sin()),
            ]
        };
        let (mut work_j, mut force, mut last) = (0.0, [0.0; 2], place(0));
        for tick in 0..=ticks {
            let now = place(tick);
            work_j += force[0] * (now[0] - last[0]) + force[1] * (now[1] - last[1]);
            let sample = Sample::at([now[0] as f32, now[1] as f32, -DEPTH_M as f32]);
            let [x, y, _] = renderer.tick(&slot, &mut state, &sample).force_n;
            (force, last) = ([x.into(), y.into()], now);
        }
        assert!(work_j < 1e-8, "{direction:?}: {work_j} J");
    }
}
