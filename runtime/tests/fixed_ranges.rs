//! Ranges of configurations and textures in fixed point, and the errors beyond them.

use crate::config_ranges::{ball, cuboid, on, plane, refusal, with};
use asperity_formats::Asset;
use asperity_runtime::{Arithmetic, Config, Fixed, LoadError, RenderArithmetic, Renderer};
use asperity_tests::texture::{HostSlot, Texture, TextureKind, random};

/// A field: its name, how it is set, what is taken and what is not, at 1 kHz.
type Case = (&'static str, fn(&mut Config, f32), [f32; 2], [f32; 2]);

/// Fixed point holds less, and says what it does not hold. Floats take all of it.
#[test]
fn fixed_point_has_ranges_of_its_own() {
    let rated = |rate_hz: f32, set: fn(&mut Config, f32), x: f32| {
        let mut config = with(set, x);
        config.servo_rate_hz = rate_hz;
        config
    };
    let cases: [Case; 5] = [
        // Least and most that are taken, and what is refused beyond either, at 1 kHz.
        (
            "limits.peak_n",
            |c, x| c.limits.peak_n = x,
            [1e-3, 1000.0],
            [1e-3_f32.next_down(), 1000.0_f32.next_up()],
        ),
        (
            "limits.slew_n_s",
            |c, x| c.limits.slew_n_s = x,
            [0.1, 1e9],
            [0.0998, 0.01],
        ),
        (
            "velocity_cutoff_hz",
            |c, x| c.velocity_cutoff_hz = x,
            [1.0, 450.0],
            [0.999, 0.2],
        ),
        (
            "normal_cutoff_hz",
            |c, x| c.normal_cutoff_hz = x,
            [1.0, 450.0],
            [0.999, 0.2],
        ),
        (
            "velocity_cutoff_hz",
            |c, x| {
                c.velocity_cutoff_hz = x;
                c.normal_cutoff_hz = x;
            },
            [1.0, 450.0],
            [0.999, 0.2],
        ),
    ];
    for (field, set, taken, refused) in cases {
        for x in taken {
            assert_eq!(refusal::<Fixed>(&with(set, x)), None, "{field} = {x}");
        }
        for x in refused {
            let config = with(set, x);
            assert_eq!(refusal::<Fixed>(&config), Some((field, x)));
            assert_eq!(config.check(), Ok(()), "floats take it");
            assert_eq!(Renderer::new(&config).err(), None);
        }
    }
    // What is least grows with the rate.
    for (set, least, less) in [
        (
            (|c: &mut Config, x| c.limits.slew_n_s = x) as fn(&mut Config, f32),
            0.4,
            0.398,
        ),
        (|c, x| c.velocity_cutoff_hz = x, 4.0, 3.99),
        (|c, x| c.normal_cutoff_hz = x, 4.0, 3.99),
    ] {
        assert_eq!(refusal::<Fixed>(&rated(4000.0, set, least)), None);
        assert!(refusal::<Fixed>(&rated(4000.0, set, less)).is_some());
    }
}

#[test]
fn fixed_point_takes_solids_within_a_metre() {
    let more = 1.0_f32.next_up();
    let up = [0.0, 0.0, 1.0];
    for axis in 0..3 {
        for far in [1.0_f32, -1.0] {
            let (mut inside, mut outside) = ([0.5; 3], [0.5; 3]);
            (inside[axis], outside[axis]) = (far, more * far);
            for (solid, field, fits) in [
                (plane(inside, up), "", true),
                (plane(outside, up), "solid.point_m", false),
                (ball(inside, 0.1), "", true),
                (ball(outside, 0.1), "solid.sphere", false),
                (cuboid(inside, [0.1; 3]), "", true),
                (cuboid(outside, [0.1; 3]), "solid.box", false),
            ] {
                let wanted = (!fits).then_some((field, more * far));
                assert_eq!(refusal::<Fixed>(&on(solid)), wanted, "{solid:?}");
                assert_eq!(Renderer::new(&on(solid)).err(), None);
            }
        }
        let (mut inside, mut outside) = ([0.5; 3], [0.5; 3]);
        (inside[axis], outside[axis]) = (1.0, more);
        assert_eq!(refusal::<Fixed>(&on(cuboid([0.0; 3], inside))), None);
        let refused = refusal::<Fixed>(&on(cuboid([0.0; 3], outside)));
        assert_eq!(refused, Some(("solid.box", more)));
    }
    assert_eq!(refusal::<Fixed>(&on(ball([0.0; 3], 1.0))), None);
    let refused = refusal::<Fixed>(&on(ball([0.0; 3], more)));
    assert_eq!(refused, Some(("solid.sphere", more)));
    // The normal of a plane is a direction, and may be of any length.
    assert_eq!(refusal::<Fixed>(&on(plane([0.0; 3], [3.0; 3]))), None);
}

fn load<A: RenderArithmetic + Arithmetic>(texture: &Texture) -> Result<(), LoadError> {
    let bytes = texture.encode();
    let mut slot = Box::new(HostSlot::<A>::new());
    slot.load(&Asset::parse(&bytes).unwrap(), 1000.0)
}

/// A texture whose grid reaches to a speed and a force, and whose loudest vertex is this loud.
fn reaching(max_speed_mm_s: f32, max_force_n: f32, loudest_m_s2: f32) -> Texture {
    let kind = TextureKind {
        lattice: (3, 3),
        ..TextureKind::nyquist(4)
    };
    let mut texture = random(1, kind);
    for (at, vertex) in texture.vertices.iter_mut().enumerate() {
        vertex.speed_mm_s = max_speed_mm_s * (at % 3) as f32 / 2.0;
        vertex.force_n = max_force_n * (at / 3) as f32 / 2.0;
        vertex.sigma_m_s2 = 0.0;
    }
    texture.vertices[4].sigma_m_s2 = loudest_m_s2;
    texture
}

#[test]
fn fixed_point_takes_grids_and_levels_that_it_holds() {
    let (speed, force, level) = (
        "grid.max_speed_mm_s",
        "grid.max_force_n",
        "grid gain·sigma_m_s2",
    );
    for (texture, refused) in [
        (reaching(1000.0, 4.0, 1.0), None),
        (reaching(1000.0_f32.next_up(), 4.0, 1.0), Some(speed)),
        (reaching(1.0, 4.0, 1.0), None),
        (reaching(1.0_f32.next_down(), 4.0, 1.0), Some(speed)),
        (reaching(250.0, 0.01, 1.0), None),
        (reaching(250.0, 0.01_f32.next_down(), 1.0), Some(force)),
        (reaching(250.0, 1000.0, 1.0), None),
        (reaching(250.0, 4.0, 500.0), None),
        (reaching(250.0, 4.0, 500.25), Some(level)),
        (reaching(250.0, 4.0, 0.0), None),
    ] {
        let named = |error: LoadError| match error {
            LoadError::Range { field, .. } => field,
            other => panic!("{other}"),
        };
        assert_eq!(load::<Fixed>(&texture).err().map(named), refused);
        assert_eq!(load::<asperity_runtime::Float>(&texture), Ok(()));
    }
    let loud = load::<Fixed>(&reaching(250.0, 4.0, 501.0));
    let told = LoadError::Range {
        field: level,
        value: 501.0,
        least: 0.0,
        most: 500.0,
    };
    assert_eq!(loud, Err(told));
}

/// It is the product of gain and σ that counts.
#[test]
fn the_gain_of_a_model_makes_its_vertices_louder() {
    let kind = TextureKind {
        ar_order: 4,
        ma_order: 4,
        numerator: asperity_formats::Numerator::Lsf,
        lattice: (3, 3),
    };
    let mut texture = random(1, kind);
    for (vertex, model) in texture.vertices.iter_mut().zip(&mut texture.models) {
        (vertex.sigma_m_s2, model.gain) = (0.25, 1.0);
    }
    texture.models[4].gain = 2000.0;
    assert_eq!(load::<Fixed>(&texture), Ok(()));
    texture.models[4].gain = 2001.0;
    assert!(load::<Fixed>(&texture).is_err());
}
