//! Every field of a configuration takes its least and its most, and a hair beyond either is refused by name.

use asperity_formats::Solid;
use asperity_runtime::{Config, ConfigError, Float, RenderArithmetic, Renderer, VibrationAxis};
use std::mem::MaybeUninit;

/// A field: its name, how it is set, and the numbers it takes.
type Range = (&'static str, fn(&mut Config, f32), f32, f32);

const TINY: f32 = f32::MIN_POSITIVE;

/// The ranges at 1 kHz.
const RANGES: [Range; 15] = [
    (
        "servo_rate_hz",
        |c, x| (c.servo_rate_hz, c.normal_cutoff_hz) = (x, 20.0),
        100.0,
        20_000.0,
    ),
    (
        "velocity_cutoff_hz",
        |c, x| c.velocity_cutoff_hz = x,
        0.1,
        450.0,
    ),
    (
        "normal_cutoff_hz",
        |c, x| c.normal_cutoff_hz = x,
        0.1,
        450.0,
    ),
    ("limits.peak_n", |c, x| c.limits.peak_n = x, TINY, 1e4),
    ("limits.slew_n_s", |c, x| c.limits.slew_n_s = x, TINY, 1e9),
    (
        "tap.min_speed_m_s",
        |c, x| c.tap.min_speed_m_s = x,
        0.0,
        100.0,
    ),
    ("tap.rearm_m", |c, x| c.tap.rearm_m = x, 0.0, 0.1),
    (
        "friction.stiffness_n_m",
        |c, x| c.friction.stiffness_n_m = x,
        TINY,
        1e5,
    ),
    (
        "friction.dead_zone_m",
        |c, x| c.friction.dead_zone_m = x,
        0.0,
        0.01,
    ),
    (
        "friction.leak_speed_m_s",
        |c, x| c.friction.leak_speed_m_s = x,
        0.0,
        1.0,
    ),
    (
        "mechanics.damping_n_s_m",
        |c, x| c.mechanics.damping_n_s_m = x,
        0.0,
        1000.0,
    ),
    (
        "mechanics.coulomb_n",
        |c, x| c.mechanics.coulomb_n = x,
        0.0,
        1000.0,
    ),
    (
        "mechanics.fastest_m_s",
        |c, x| c.mechanics.fastest_m_s = x,
        0.01,
        100.0,
    ),
    (
        "mechanics.position_step_m",
        |c, x| c.mechanics.position_step_m = x,
        0.0,
        0.01,
    ),
    (
        "parameter_time_constant_s",
        |c, x| c.parameter_time_constant_s = x,
        0.0,
        0.04,
    ),
];

pub(crate) fn refusal<A: RenderArithmetic>(config: &Config) -> Option<(&'static str, f32)> {
    let made = Renderer::<A>::prepare(config).err();
    let mut memory = MaybeUninit::uninit();
    let made_in_place = Renderer::<A>::prepare_in(&mut memory, config).err();
    let field = |e: &ConfigError| (e.field, e.value.to_bits());
    assert_eq!(made.as_ref().map(field), made_in_place.as_ref().map(field));
    made.map(|e| (e.field, e.value))
}

pub(crate) fn with(set: fn(&mut Config, f32), value: f32) -> Config {
    let mut config = Config::default();
    set(&mut config, value);
    config
}

#[test]
fn every_field_takes_its_least_and_its_most_and_nothing_beyond() {
    assert_eq!(Renderer::new(&Config::default()).err(), None);
    for (field, set, least, most) in RANGES {
        for inside in [least, most] {
            assert_eq!(with(set, inside).check(), Ok(()), "{field} = {inside}");
        }
        let below = if least == 0.0 {
            -TINY
        } else {
            least.next_down()
        };
        for outside in [below, most.next_up(), f32::INFINITY, f32::NEG_INFINITY] {
            let config = with(set, outside);
            assert_eq!(refusal::<Float>(&config), Some((field, outside)));
        }
        let nan = with(set, f32::NAN).check().err().map(|e| e.field);
        assert_eq!(nan, Some(field), "NaN");
    }
    let ramp = |ramp_s: f32| {
        let mut config = Config::default();
        config.safety.ramp_s = ramp_s;
        config.check().err().map(|e| e.field)
    };
    assert_eq!([0.0, 10.0].map(ramp), [None; 2]);
    assert_eq!(
        [-TINY, 10.0_f32.next_up()].map(ramp),
        [Some("safety.ramp_s"); 2]
    );
}

#[test]
fn the_reach_is_a_millimetre_to_ten_kilometres_and_a_metre_in_fixed_point() {
    let reach = |reach_m: f32| {
        let mut config = Config::default();
        config.safety.reach_m = reach_m;
        let field = |refused: Option<(&'static str, f32)>| refused.map(|refused| refused.0);
        (
            field(refusal::<Float>(&config)),
            field(refusal::<asperity_runtime::Fixed>(&config)),
        )
    };
    let refused = Some("safety.reach_m");
    assert_eq!(Config::default().safety.reach_m, 1.0);
    assert_eq!([0.001, 1.0].map(reach), [(None, None); 2]);
    assert_eq!(
        [1.0_f32.next_up(), 10_000.0].map(reach),
        [(None, refused); 2]
    );
    assert_eq!(
        [0.001_f32.next_down(), 10_000.0_f32.next_up(), f32::NAN].map(reach),
        [(refused, refused); 3]
    );
}

#[test]
fn whole_numbers_have_a_most() {
    let mut config = Config::default();
    (config.mechanics.delay_ticks, config.safety.hold_ticks) = (100, 2);
    assert_eq!(config.check(), Ok(()));
    config.safety.hold_ticks = 3;
    assert_eq!(refusal::<Float>(&config), Some(("safety.hold_ticks", 3.0)));
    config.mechanics.delay_ticks = 101;
    assert_eq!(
        refusal::<Float>(&config),
        Some(("mechanics.delay_ticks", 101.0))
    );
}

/// Cut-offs end at a share of the servo rate, not at a number.
#[test]
fn cut_offs_may_be_as_high_as_the_servo_rate_allows() {
    let mut config = Config {
        servo_rate_hz: 4000.0,
        velocity_cutoff_hz: 1800.0,
        normal_cutoff_hz: 1800.0,
        ..Config::default()
    };
    assert_eq!(config.check(), Ok(()));
    config.normal_cutoff_hz = 1801.0;
    assert_eq!(
        config.check().err().map(|e| e.field),
        Some("normal_cutoff_hz")
    );
}

pub(crate) fn on(solid: Solid) -> Config {
    Config {
        solid,
        ..Config::default()
    }
}

pub(crate) fn plane(point_m: [f32; 3], normal: [f32; 3]) -> Solid {
    Solid::Plane { point_m, normal }
}

pub(crate) fn ball(center_m: [f32; 3], radius_m: f32) -> Solid {
    Solid::Sphere { center_m, radius_m }
}

pub(crate) fn cuboid(center_m: [f32; 3], half_extents_m: [f32; 3]) -> Solid {
    Solid::Box {
        center_m,
        half_extents_m,
    }
}

#[test]
fn solids_are_within_ten_kilometres_and_larger_than_a_micrometre() {
    let (far, farther, up) = (1e4_f32, 1e4_f32.next_up(), [0.0, 0.0, 1.0]);
    let (small, smaller) = (1e-6_f32.next_up(), 1e-6);
    for axis in 0..3 {
        let at = |x: f32| {
            let mut v = [0.0; 3];
            v[axis] = x;
            v
        };
        let sized = |x: f32| {
            let mut v = [1.0; 3];
            v[axis] = x;
            v
        };
        for (solid, refused) in [
            (plane(at(far), up), None),
            (plane(at(-far), up), None),
            (plane(at(farther), up), Some(("solid.point_m", farther))),
            (plane(at(-farther), up), Some(("solid.point_m", -farther))),
            (plane([0.0; 3], at(far)), None),
            (
                plane([0.0; 3], at(farther)),
                Some(("solid.normal", farther)),
            ),
            (ball(at(far), 1.0), None),
            (ball(at(farther), 1.0), Some(("solid.center_m", farther))),
            (cuboid(at(far), [1.0; 3]), None),
            (
                cuboid(at(farther), [1.0; 3]),
                Some(("solid.center_m", farther)),
            ),
            (cuboid([0.0; 3], sized(small)), None),
            (
                cuboid([0.0; 3], sized(smaller)),
                Some(("solid.half_extents_m", smaller)),
            ),
            (cuboid([0.0; 3], sized(far)), None),
            (
                cuboid([0.0; 3], sized(farther)),
                Some(("solid.half_extents_m", farther)),
            ),
            (ball([0.0; 3], small), None),
            (ball([0.0; 3], smaller), Some(("solid.radius_m", smaller))),
            (ball([0.0; 3], -1.0), Some(("solid.radius_m", -1.0))),
            (ball([0.0; 3], far), None),
            (ball([0.0; 3], farther), Some(("solid.radius_m", farther))),
        ] {
            let found = on(solid).check().err().map(|e| (e.field, e.value));
            assert_eq!(found, refused, "{solid:?}");
        }
        for (solid, field) in [
            (plane(at(f32::NAN), up), "solid.point_m"),
            (plane([0.0; 3], at(f32::NAN)), "solid.normal"),
            (plane([0.0; 3], at(0.9e-6)), "solid.normal length"),
            (
                plane([0.0; 3], sized(far).map(|x| x * 0.9e4)),
                "solid.normal",
            ),
            (ball(at(f32::NAN), 1.0), "solid.center_m"),
            (ball([0.0; 3], f32::NAN), "solid.radius_m"),
            (cuboid(at(f32::NAN), [1.0; 3]), "solid.center_m"),
            (cuboid([0.0; 3], sized(f32::NAN)), "solid.half_extents_m"),
        ] {
            let found = on(solid).check().err().map(|e| e.field);
            assert_eq!(found, Some(field), "{solid:?}");
        }
    }
    let slanted = on(plane([0.0; 3], [8e3, 8e3, 0.0]));
    assert_eq!(
        slanted.check().err().map(|e| e.field),
        Some("solid.normal length")
    );
    assert_eq!(on(plane([0.0; 3], [1.1e-6, 0.0, 0.0])).check(), Ok(()));
}

/// Only a plane's normal is changed, to unit length.
#[test]
fn a_renderer_keeps_its_configuration() {
    let mut config = on(plane([0.1, 0.2, 0.3], [0.0, -3.0, 4.0]));
    config.vibration_axis = VibrationAxis::Binormal;
    let expected = Config {
        solid: plane([0.1, 0.2, 0.3], [0.0, -0.6, 0.8]),
        ..config.clone()
    };
    assert_eq!(*Renderer::new(&config).unwrap().config(), expected);
    let mut memory = MaybeUninit::uninit();
    let made: &mut Renderer = Renderer::prepare_in(&mut memory, &config).unwrap();
    assert_eq!(*made.config(), expected);
    for solid in [ball([0.1; 3], 0.2), cuboid([0.1; 3], [0.2; 3])] {
        let config = on(solid);
        assert_eq!(*Renderer::new(&config).unwrap().config(), config);
    }
}
