//! A scene renders the surface that the stylus touches: the nearest, or the one it is deepest in.

use asperity_formats::{Library, SceneSurface, Solid, library::encode_scene};
use asperity_runtime::{
    Capacities, Config, Fixed, Flags, Float, HostCapacities, LoadError, Output, RenderArithmetic,
    Renderer, Sample, Scene, SceneError, SceneState, State, Texture, arithmetic::Scalar as _,
    scene::HYSTERESIS_M,
};
use asperity_tests::{
    texture::{HostSlot, TextureKind, random},
    trajectory::strokes,
};
use std::mem::MaybeUninit;

const FAR: f32 = 10_000.0;

/// Surfaces anywhere, of two textures in turn.
pub(crate) fn anywhere(solids: &[Solid]) -> Vec<SceneSurface> {
    let place = |(index, &solid): (usize, &Solid)| SceneSurface {
        solid,
        from_m: [-FAR; 3],
        to_m: [FAR; 3],
        texture: (index % 2) as u16,
    };
    solids.iter().enumerate().map(place).collect()
}

pub(crate) fn level(z_m: f32) -> Solid {
    Solid::Plane {
        point_m: [0.0, 0.0, z_m],
        normal: [0.0, 0.0, 1.0],
    }
}

fn ball(center_m: [f32; 3], radius_m: f32) -> Solid {
    Solid::Sphere { center_m, radius_m }
}

/// A library of two textures, the second one twice as stiff.
fn library(surfaces: &[SceneSurface]) -> Vec<u8> {
    let textures = [(200.0, 1), (400.0, 2)].map(|(stiffness_n_m, seed)| {
        let kind = TextureKind {
            lattice: (3, 3),
            ..TextureKind::nyquist(8)
        };
        let mut texture = random(seed, kind);
        texture.coupling.stiffness_n_m = stiffness_n_m;
        texture
    });
    library_of(&textures, surfaces)
}

pub(crate) fn library_of(
    textures: &[asperity_tests::texture::Texture],
    surfaces: &[SceneSurface],
) -> Vec<u8> {
    let bytes: Vec<_> = textures.iter().map(|texture| texture.encode()).collect();
    let names = ["a", "b", "c", "d"].into_iter();
    let named: Vec<(&str, &[u8])> = names.zip(bytes.iter().map(Vec::as_slice)).collect();
    let mut out = vec![0; 1 << 17];
    let len = encode_scene(&named, surfaces, &mut out).unwrap();
    out.truncate(len);
    out
}

pub(crate) fn on_scene<A: RenderArithmetic, R>(
    surfaces: &[SceneSurface],
    play: impl FnOnce(&Scene<'_, 8, HostCapacities, A>, &Renderer<A>) -> R,
) -> R {
    on_library(&library(surfaces), play)
}

pub(crate) fn on_library<A: RenderArithmetic, R>(
    library: &[u8],
    play: impl FnOnce(&Scene<'_, 8, HostCapacities, A>, &Renderer<A>) -> R,
) -> R {
    let library = Library::parse(library).unwrap();
    let mut slots = vec![HostSlot::<A>::new(); library.index().len()];
    let config = Config::default();
    let scene = Scene::load(&library, &config, &mut slots).unwrap();
    play(&scene, &Renderer::prepare(&config).unwrap())
}

/// Returns the touched surface after a sample at each position in turn, for a single stylus.
fn touched<A: RenderArithmetic>(
    surfaces: &[SceneSurface],
    positions: &[[f32; 3]],
) -> Vec<Option<usize>> {
    on_scene::<A, _>(surfaces, |scene, renderer| {
        let mut state = SceneState::new(1);
        let mut touched = |position: &[f32; 3]| {
            let sample = Sample::of(&Sample::at(*position));
            let output = renderer.tick_scene(scene, &mut state, &sample);
            let contact = output.flags.contains(Flags::CONTACT);
            assert_eq!(state.touched().is_some(), contact, "{position:?}");
            assert_eq!(output.depth_m.value() > 0.0, contact, "{position:?}");
            state.touched()
        };
        positions.iter().map(&mut touched).collect()
    })
}

fn in_both(surfaces: &[SceneSurface], positions: &[[f32; 3]], expected: &[Option<usize>]) {
    assert_eq!(touched::<Float>(surfaces, positions), expected, "floats");
    assert_eq!(
        touched::<Fixed>(surfaces, positions),
        expected,
        "fixed point"
    );
}

#[test]
fn of_several_surfaces_the_deepest_is_touched_from_whichever_side() {
    let balls = [
        ball([-0.02, 0.0, 0.0], 0.02),
        ball([0.0, 0.0, 0.0], 0.01),
        ball([0.03, 0.0, 0.0], 0.025),
    ];
    for (x_m, expected) in [
        (-0.03, Some(0)),
        (-0.006, Some(0)),
        (-0.004, Some(1)),
        (0.004, Some(1)),
        (0.008, Some(2)),
        (0.05, Some(2)),
        (0.06, None),
        (-0.05, None),
    ] {
        in_both(&anywhere(&balls), &[[x_m, 0.0, 0.0]], &[expected]);
    }
}

/// A contact moves on only to a surface that is deeper by more than two counts.
#[test]
fn a_contact_is_kept_until_another_surface_is_deeper_by_the_hysteresis() {
    let (left, right) = ([1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]);
    let wall = |normal, x_m| Solid::Plane {
        point_m: [x_m, 0.0, 0.0],
        normal,
    };
    // At x the stylus is 10 mm − x deep in the first, 10 mm + x in the second.
    let surfaces = anywhere(&[wall(left, 0.01), wall(right, -0.01)]);
    let inside = 0.45 * HYSTERESIS_M;
    let beyond = 0.55 * HYSTERESIS_M;
    let path = [-1e-3, inside, beyond, -inside, -beyond, inside].map(|x| [x, 0.0, 0.0]);
    let expected = [0, 0, 1, 1, 0, 0].map(Some);
    in_both(&surfaces, &path, &expected);
}

/// So does a stylus that leaves the region of what it touches.
#[test]
fn a_contact_is_kept_as_far_outside_its_region_as_the_hysteresis() {
    for axis in 0..3 {
        for towards in [1.0_f32, -1.0] {
            let mut surface = anywhere(&[ball([0.0; 3], 0.05)])[0];
            (surface.from_m[axis], surface.to_m[axis]) = (-0.01, 0.01);
            let at = |m: f32| {
                let mut position = [0.001; 3];
                position[axis] = towards * m;
                position
            };
            let (inside, outside) = (0.01 + 0.9 * HYSTERESIS_M, 0.01 + 1.1 * HYSTERESIS_M);
            let path = [0.0099, inside, outside, inside, 0.0101, 0.0099].map(at);
            let expected = [Some(0), Some(0), None, None, None, Some(0)];
            in_both(&[surface], &path, &expected);
        }
    }
}

/// A surface that is left is no longer the touched one, and keeps no other from being entered.
#[test]
fn a_stylus_in_the_air_holds_on_to_nothing() {
    let surfaces = anywhere(&[
        ball([0.0, 0.0, -0.02], 0.02),
        ball([0.05, 0.0, -0.02], 0.02),
    ]);
    let path = [
        [0.0, 0.0, -1e-3],
        [0.0, 0.0, 1e-3],
        [0.024, 0.0, 0.0],
        [0.026, 0.0, 0.0],
        [0.05, 0.0, -1e-3],
        [0.05, 0.0, 0.5],
    ];
    in_both(
        &surfaces,
        &path,
        &[Some(0), None, None, None, Some(1), None],
    );
}

#[test]
fn bad_samples_stay_on_the_surface_and_unusable_places_choose_none() {
    let surfaces = anywhere(&[ball([0.0; 3], 0.02), ball([0.1, 0.0, 0.0], 0.02)]);
    on_scene::<Float, _>(&surfaces, |scene, renderer| {
        let mut state = SceneState::new(1);
        let deep = Sample::at([0.0, 0.0, 0.015]);
        renderer.tick_scene(scene, &mut state, &deep);
        assert_eq!(state.touched(), Some(0));
        let there = [0.1, 0.0, 0.015];
        for bad in [
            Sample {
                position_m: there,
                elapsed_ticks: 0,
            },
            Sample::at([f32::NAN, 0.0, 0.015]),
        ] {
            renderer.tick_scene(scene, &mut state, &bad);
            assert_eq!(state.touched(), Some(0), "held");
        }
        renderer.tick_scene(scene, &mut state, &Sample::at(there));
        assert_eq!(state.touched(), Some(1));
    });
}

/// Nowhere is far from every surface, on whichever side of the origin the stylus is.
#[test]
fn where_no_surface_is_there_is_no_force_at_any_height() {
    let mut surface = anywhere(&[level(0.0)])[0];
    (surface.from_m, surface.to_m) = ([0.5; 3], [0.6; 3]);
    for z_m in [-0.9, -0.5, -1e-3, 0.0, 1e-3, 0.4, 0.9] {
        in_both(&[surface], &[[0.0, 0.0, z_m]; 2], &[None; 2]);
    }
    on_scene::<Float, _>(&[surface], |scene, renderer| {
        for z_m in [-9.9e3, 9.9e3] {
            let mut state = SceneState::new(1);
            let sample = Sample::at([0.0, 0.0, z_m]);
            let output = renderer.tick_scene(scene, &mut state, &sample);
            assert_eq!((output.force_n, state.touched()), ([0.0; 3], None));
        }
    });
}

#[test]
fn each_surface_has_its_own_texture() {
    let surfaces = anywhere(&[ball([0.0; 3], 0.02), ball([0.1, 0.0, 0.0], 0.02)]);
    let spring_n = |center_m: f32| {
        on_scene::<Float, _>(&surfaces, |scene, renderer| {
            let mut state = SceneState::new(1);
            let sample = Sample::at([center_m, 0.0, 0.019]);
            let settle = (0..200).map(|_| renderer.tick_scene(scene, &mut state, &sample));
            settle.last().unwrap().normal_force_n
        })
    };
    assert!((spring_n(0.0) - 0.2).abs() < 1e-4);
    assert!((spring_n(0.1) - 0.4).abs() < 1e-4);
}

/// The bits of a scene of one surface are those of that solid by itself.
#[test]
fn one_surface_is_rendered_like_the_solid_of_a_configuration() {
    fn check<A: RenderArithmetic>() {
        let solid = ball([0.0, 0.0, -0.05], 0.05);
        let samples: Vec<_> = strokes(4, 3000).into_iter().map(Sample::at).collect();
        let found: Vec<Output<A>> = on_scene(&anywhere(&[solid]), |scene, renderer| {
            let mut state = SceneState::new(5);
            let tick = |s| renderer.tick_scene(scene, &mut state, &Sample::of(s));
            let outputs = samples.iter().map(tick).collect();
            let counters = state.state().counters();
            assert_eq!(counters.ticks, 3000);
            assert!(counters.taps > 0);
            outputs
        });
        let config = Config {
            solid,
            ..Config::default()
        };
        let bytes = library(&anywhere(&[solid]));
        let asset = Library::parse(&bytes).unwrap();
        let asset = asset.asset(0).unwrap();
        let mut slot = Box::new(HostSlot::<A>::new());
        slot.load(&asset, 1000.0).unwrap();
        let renderer = Renderer::<A>::prepare(&config).unwrap();
        let mut state = State::new(5);
        for (sample, found) in samples.iter().zip(found) {
            let wanted = renderer.tick(&slot, &mut state, &Sample::of(sample));
            assert_eq!(found, wanted, "{sample:?}");
        }
    }
    check::<Float>();
    check::<Fixed>();
}

type Small<'a, const N: usize> = Scene<'a, N, HostCapacities>;

#[test]
fn a_scene_needs_room_for_its_surfaces_and_its_textures() {
    let surfaces = anywhere(&[level(0.0), level(-0.1), level(-0.2)]);
    let bytes = library(&surfaces);
    let library = Library::parse(&bytes).unwrap();
    let config = Config::default();
    let slots = |count| vec![HostSlot::<Float>::new(); count];
    assert!(Small::<3>::load(&library, &config, &mut slots(2)).is_ok());
    assert!(Small::<3>::load(&library, &config, &mut slots(3)).is_ok());
    let short = |field, found, capacity| SceneError::Capacity {
        field,
        found,
        capacity,
    };
    let refused = Small::<2>::load(&library, &config, &mut slots(2)).err();
    assert_eq!(refused, Some(short("surfaces", 3, 2)));
    for room in [0, 1] {
        let refused = Small::<3>::load(&library, &config, &mut slots(room)).err();
        assert_eq!(refused, Some(short("textures", 2, room)));
    }
    let mut memory = MaybeUninit::uninit();
    let refused = Small::<2>::load_in(&mut memory, &library, &config, &mut slots(2)).err();
    assert_eq!(refused, Some(short("surfaces", 3, 2)));
}

#[test]
fn a_scene_says_which_texture_or_surface_it_refuses() {
    let config = Config::default();
    let bytes = library(&anywhere(&[level(0.0)]));
    let parsed = Library::parse(&bytes).unwrap();
    let mut slots = [
        Texture::<Capacities<9, 8, 4, 0, 1300>>::new(),
        Texture::<Capacities<9, 8, 4, 0, 1300>>::new(),
    ];
    let refused = Scene::<4, _, _>::load(&parsed, &config, &mut slots).err();
    let cause = LoadError::Capacity {
        field: "ar_order",
        found: 8,
        capacity: 4,
    };
    assert_eq!(refused, Some(SceneError::Texture { index: 0, cause }));

    let bytes = library(&anywhere(&[level(0.0), level(1.5)]));
    let parsed = Library::parse(&bytes).unwrap();
    let mut slots = vec![HostSlot::<Fixed>::new(), HostSlot::<Fixed>::new()];
    match Scene::<4, HostCapacities, Fixed>::load(&parsed, &config, &mut slots) {
        Err(SceneError::Surface { index: 1, cause }) => assert_eq!(cause.field, "solid.point_m"),
        other => panic!("{:?}", other.err()),
    }
    let mut slots = vec![HostSlot::<Float>::new(), HostSlot::<Float>::new()];
    assert!(Small::<4>::load(&parsed, &config, &mut slots).is_ok());
}

#[test]
fn a_library_without_surfaces_is_no_scene() {
    let texture = random(1, TextureKind::nyquist(4)).encode();
    let mut out = vec![0; 1 << 17];
    let named: [(&str, &[u8]); 1] = [("a", &texture)];
    let len = asperity_formats::library::encode_library(&named, &mut out).unwrap();
    let parsed = Library::parse(&out[..len]).unwrap();
    let mut slots = [HostSlot::<Float>::new()];
    let refused = Small::<4>::load(&parsed, &Config::default(), &mut slots).err();
    assert_eq!(refused, Some(SceneError::NoScene));
}

#[test]
fn a_scene_made_in_place_renders_the_same() {
    let surfaces = anywhere(&[level(0.0), ball([0.0; 3], 0.003)]);
    let bytes = library(&surfaces);
    let parsed = Library::parse(&bytes).unwrap();
    let config = Config::default();
    let mut slots = vec![HostSlot::<Float>::new(), HostSlot::<Float>::new()];
    let mut memory = MaybeUninit::uninit();
    let scene: &mut Small<'_, 8> =
        Scene::load_in(&mut memory, &parsed, &config, &mut slots).unwrap();
    let mut state_memory = MaybeUninit::uninit();
    let state: &mut SceneState = SceneState::init(&mut state_memory, 3);
    let renderer = Renderer::new(&config).unwrap();
    let samples: Vec<_> = strokes(8, 1000).into_iter().map(Sample::at).collect();
    let ours: Vec<_> = samples
        .iter()
        .map(|s| renderer.tick_scene(scene, state, s))
        .collect();
    let theirs: Vec<_> = on_scene::<Float, _>(&surfaces, |scene, renderer| {
        let mut state = SceneState::new(3);
        samples
            .iter()
            .map(|s| renderer.tick_scene(scene, &mut state, s))
            .collect()
    });
    assert_eq!(ours, theirs);
    assert!(ours.iter().any(|o| o.vib_m_s2 != 0.0));
}

#[test]
fn a_scene_on_loaded_textures_goes_on_where_the_last_one_stopped() {
    let surfaces = anywhere(&[level(0.0), ball([0.0; 3], 0.003)]);
    let bytes = library(&surfaces);
    let parsed = Library::parse(&bytes).unwrap();
    let config = Config::default();
    let renderer = Renderer::new(&config).unwrap();
    let mut slots = vec![HostSlot::<Float>::new(), HostSlot::<Float>::new()];
    Small::<8>::load(&parsed, &config, &mut slots).unwrap();
    let samples: Vec<_> = strokes(8, 1000).into_iter().map(Sample::at).collect();
    let mut state = SceneState::new(3);
    let mut ours = Vec::new();
    for some in samples.chunks(70) {
        let scene = Small::<8>::on_loaded(&surfaces, &slots).unwrap();
        let outputs = some
            .iter()
            .map(|s| renderer.tick_scene(&scene, &mut state, s));
        ours.extend(outputs);
    }
    let theirs: Vec<_> = on_scene::<Float, _>(&surfaces, |scene, renderer| {
        let mut state = SceneState::new(3);
        let ticks = samples.iter();
        ticks
            .map(|s| renderer.tick_scene(scene, &mut state, s))
            .collect()
    });
    assert_eq!(ours, theirs);

    let refused = |surfaces: &[SceneSurface], textures| {
        Small::<2>::on_loaded(surfaces, textures)
            .err()
            .map(|error| error.to_string())
    };
    let no_scene = Some(SceneError::NoScene.to_string());
    assert_eq!(refused(&[], &slots), no_scene);
    let textures = refused(&surfaces, &slots[..1]).unwrap();
    assert_eq!(textures, "textures: the scene has 2, there is room for 1");
    let many = anywhere(&[level(0.0); 3]);
    let many = refused(&many, &slots).unwrap();
    assert_eq!(many, "surfaces: the scene has 3, there is room for 2");
}
