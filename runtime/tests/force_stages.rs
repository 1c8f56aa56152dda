//! Stages that make a force by themselves, in both arithmetics, against f64: wall, limiter, passivity, friction, excitation and the
//! bounds of the vibration.

use asperity_runtime::{
    Arithmetic, Config, Fixed, Flags, Float, Limits, MechanicsConfig, Passivity, RenderArithmetic,
    Wall,
    arithmetic::Scalar as _,
    quantity::{Quantity, Vector},
    stage::{
        excitation::Excitation,
        friction::{Bristle, FrictionState},
        limiter::Limiter,
        recursion::{InnerProduct, VIB_LIMIT_M_S2},
    },
};
use asperity_tests::{draw::Draw, force_limits::size};

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[test]
fn a_wall_is_its_spring_less_its_damping_and_never_pulls() {
    fn check<A: RenderArithmetic>() {
        let wall = Wall::<A>::of(500.0, 2.0);
        for (depth_m, outward_m_s, spring, total) in [
            (0.0, -1.0, 0.0, 0.0),
            (0.0, 1.0, 0.0, 0.0),
            (0.002, 0.0, 1.0, 1.0),
            (0.002, 0.25, 1.0, 0.5),
            (0.002, -0.25, 1.0, 1.5),
            (0.002, 0.5, 1.0, 0.0),
            (0.002, 1.0, 1.0, 0.0),
            (0.004, 0.75, 2.0, 0.5),
        ] {
            let forces = wall.step(Quantity::of(depth_m), Quantity::of(outward_m_s));
            let found = [forces.spring.value(), forces.total.value()];
            for (found, wanted) in found.into_iter().zip([spring, total]) {
                assert!(
                    (found - wanted).abs() < 3e-5,
                    "{depth_m} {outward_m_s}: {found}"
                );
            }
        }
        let least = wall.step(Quantity::of(1e-6), Quantity::of(10.0));
        assert_eq!(least.total.value(), 0.0);
        let none = Wall::<A>::NONE.step(Quantity::of(1.0), Quantity::of(-1.0));
        assert_eq!([none.spring.value(), none.total.value()], [0.0; 2]);
    }
    check::<Float>();
    check::<Fixed>();
}

/// A force is shortened, not turned: first to the peak, then on its way from the last one.
#[test]
fn a_limited_force_goes_straight_towards_the_wanted_one() {
    fn check<A: RenderArithmetic>(within: f64) {
        let (peak, step) = (3.0_f64, 0.5_f64);
        let limits = Limits {
            peak_n: 3.0,
            slew_n_s: 500.0,
        };
        let limiter = Limiter::<A>::new(&limits, 1000.0);
        let mut draw = Draw::new(3);
        let mut last = [0.0_f64; 3];
        for n in 0..5000 {
            let reach = if n % 3 == 0 { 8.0 } else { 2.0 };
            let close = n % 4 == 0;
            let random = [0; 3].map(|_| draw.range(-reach, reach));
            let wanted = [0, 1, 2].map(|i| {
                let x = if close {
                    last[i] + 0.1 * random[i]
                } else {
                    random[i]
                };
                f64::from(x as f32)
            });
            let long = |v: [f64; 3]| dot(v, v).sqrt();
            let to = |v: [f64; 3], length: f64| v.map(|x| x * (length / long(v)).min(1.0));
            let target = to(wanted, peak);
            let way = [0, 1, 2].map(|i| target[i] - last[i]);
            let exact = to(way, step);
            let exact = [0, 1, 2].map(|i| last[i] + exact[i]);
            let from = Vector::of(last.map(|x| x as f32));
            let (next, flags) = limiter.step(from, Vector::of(wanted.map(|x| x as f32)));
            let found = next.values();
            for (found, exact) in found.iter().zip(exact) {
                assert!(
                    (f64::from(*found) - exact).abs() < within,
                    "{found} {exact}"
                );
            }
            let unsure = 1e-3;
            if (long(wanted) - peak).abs() > unsure {
                assert_eq!(flags.contains(Flags::PEAK_LIMITED), long(wanted) > peak);
            }
            if (long(way) - step).abs() > unsure {
                assert_eq!(flags.contains(Flags::SLEW_LIMITED), long(way) > step);
            }
            assert!(size(found) <= peak);
            last = found.map(f64::from);
        }
    }
    check::<Float>(2e-5);
    check::<Fixed>(3e-4);
}

#[test]
fn a_force_at_its_limits_is_let_through_as_it_is() {
    fn check<A: RenderArithmetic>(margin: f32) {
        let limits = Limits {
            peak_n: 2.0,
            slew_n_s: 1000.0,
        };
        let limiter = Limiter::<A>::new(&limits, 1000.0);
        let peak = 2.0 - margin;
        let (last, wanted) = ([0.0, 0.0, peak - 0.5], [0.0, 0.0, peak]);
        let (next, flags) = limiter.step(Vector::of(last), Vector::of(wanted));
        assert_eq!((next.values(), flags), (wanted, Flags::default()));
        let (next, flags) = limiter.step(Vector::ZERO, Vector::of([1.0 - margin, 0.0, 0.0]));
        assert_eq!(next.values(), [1.0 - margin, 0.0, 0.0]);
        assert_eq!(flags, Flags::default());
        let over = Vector::of([0.0, 1.0 + 1e-3, 0.0]);
        assert!(
            limiter
                .step(Vector::ZERO, over)
                .1
                .contains(Flags::SLEW_LIMITED)
        );
    }
    check::<Float>(0.0);
    check::<Fixed>(1.0 / 8192.0);
    let limiter = Limiter::<Float>::new(&Config::default().limits, 1000.0);
    for wild in [f32::NAN, f32::INFINITY, 1e16] {
        let (next, flags) = limiter.step(Vector::ZERO, Vector::of([wild, 0.0, 1.0]));
        assert_eq!(
            (next.values(), flags),
            ([0.0; 3], Flags::default()),
            "{wild}"
        );
    }
}

/// K·(T(1 + 2n)/2 + Δ/2V) + B·(1 + Δ/TV) ≤ b + f_c/V and K·Δ/2 ≤ f_c, in f64.
#[test]
fn a_wall_is_lowered_to_the_bound_of_its_device() {
    fn check<A: Arithmetic>(within: f64, within_n_s_m: f64) {
        let mut draw = Draw::new(4);
        for n in 0..2000 {
            let mechanics = MechanicsConfig {
                damping_n_s_m: draw.range(0.0, 1.0) as f32,
                coulomb_n: draw.range(0.0, 0.4) as f32,
                fastest_m_s: draw.range(0.2, 2.0) as f32,
                position_step_m: if n % 4 == 0 {
                    0.0
                } else {
                    draw.range(1e-6, 2e-3) as f32
                },
                delay_ticks: (n % 3) as u32,
            };
            let rate = [1000.0, 2000.0, 4000.0][n % 3];
            let (asked_k, asked_b) = (draw.range(10.0, 1500.0), draw.range(0.0, 1.0));
            let passivity = Passivity::<A>::new(&mechanics, 3.3, rate as f32);
            let wall = passivity.bear(Wall::of(asked_k as f32, asked_b as f32));
            let (v, step) = (
                f64::from(mechanics.fastest_m_s),
                f64::from(mechanics.position_step_m),
            );
            let coulomb = f64::from(mechanics.coulomb_n);
            let budget = f64::from(mechanics.damping_n_s_m) + coulomb / v;
            let delay = f64::from(mechanics.delay_ticks);
            let per_k = (1.0 + 2.0 * delay) / (2.0 * rate) + step / (2.0 * v);
            let per_b = 1.0 + step * rate / v;
            let quantised = if step > 0.0 {
                2.0 * coulomb / step
            } else {
                f64::MAX
            };
            let k = asked_k.min(budget / per_k).min(quantised);
            let b = ((budget - k * per_k) / per_b).clamp(0.0, asked_b);
            let (found_k, found_b) = (wall.stiffness.value(), wall.damping.value());
            // Steps of 0.24 mN/m in fixed point.
            let off = (f64::from(found_k) - k).abs();
            assert!(off < within * k + 3e-4, "{found_k} {k}");
            assert!(
                (f64::from(found_b) - b).abs() < within_n_s_m,
                "{found_b} {b}"
            );
        }
    }
    check::<Float>(1e-5, 1e-5);
    // 1 ns of cost a unit of stiffness.
    check::<Fixed>(1e-5, 1e-4);
}

/// Both arithmetics draw the same numbers; the first of them, from the definition of the generator.
#[test]
fn the_excitation_is_the_same_in_both_arithmetics() {
    let (mut float, mut fixed) = (Excitation::new(7), Excitation::new(7));
    let mut oracle = asperity_tests::oracle::Excitation::new(7);
    for _ in 0..20_000 {
        let exact = oracle.draw();
        let (a, b) = (float.step::<Float>().value(), fixed.step::<Fixed>().value());
        assert!((f64::from(a) - exact).abs() < 1e-6, "{a} {exact}");
        assert!((f64::from(b) - exact).abs() < 1e-6, "{b} {exact}");
    }
    let (mut a, mut b) = (Excitation::new(3), Excitation::new(3));
    for _ in 0..100 {
        assert_eq!(a.next_gaussian(), b.step::<Float>().value());
    }
}

/// d ← min(1, ·)·d in f64, along a line: leak, slip and the force a tick ahead.
#[test]
fn a_bristle_leaks_slips_and_leads_as_its_equation_says() {
    fn check<A: RenderArithmetic>(within_n: f64) {
        let mut config = Config::default().friction;
        for (leak_speed_m_s, delay_ticks, rate_hz) in
            [(5.5e-3, 0, 1000.0), (0.0, 1, 1000.0), (2e-3, 2, 4000.0)]
        {
            config.leak_speed_m_s = leak_speed_m_s;
            let bristle = Bristle::<A>::new(&config, delay_ticks, rate_hz);
            let (k, h) = (
                f64::from(config.stiffness_n_m),
                f64::from(config.dead_zone_m),
            );
            let leak = k * f64::from(leak_speed_m_s) / f64::from(rate_hz);
            let mut state = FrictionState::default();
            let (mut d, mut draw) = (0.0_f64, Draw::new(5));
            for n in 0..3000 {
                let motion = f64::from(draw.range(-2e-4, 2.5e-4) as f32);
                let (load, mu) = (f64::from(0.25 * (n % 7) as f32), 0.5);
                let friction = bristle.step(
                    &mut state,
                    Vector::of([0.0, motion as f32, 1e-4]),
                    Vector::of([0.0, 0.0, 1.0]),
                    Quantity::of(load as f32),
                    Quantity::of((mu * load) as f32),
                );
                d += motion;
                let limit = mu * load;
                let leaked = if load + leak > 0.0 {
                    load / (load + leak)
                } else {
                    0.0
                };
                let reach = limit / k + h;
                let sign = d.signum();
                let kept = (d.abs() * leaked).min(reach);
                let held = k * (kept - h);
                let ahead = k * (1.0 + f64::from(delay_ticks)) * motion * sign;
                let lead = ahead.min((0.5 * held).min(limit - held)).max(-held);
                let exact = -sign * (held + lead);
                let found = f64::from(friction.force().values()[1]);
                assert!((found - exact).abs() < within_n, "{n}: {found} {exact}");
                d = sign * kept;
            }
        }
    }
    check::<Float>(1e-5);
    check::<Fixed>(3e-4);
}

/// |y| up to 10⁴ m/s² is let through to the bit; less than 10⁻¹² is silence; NaN is silence that counts as a clamp.
#[test]
fn samples_of_the_vibration_are_bounded_at_exactly_their_limits() {
    let sample = |x: f32| Float::sample_of(Float::sum_of(x));
    let (most, least) = (VIB_LIMIT_M_S2, Float::SILENCE_M_S2);
    assert_eq!((most, least), (1e4, 1e-12));
    for sign in [1.0_f32, -1.0] {
        for inside in [most, most.next_down(), 1.0, least, least.next_up()] {
            assert_eq!(sample(sign * inside), (sign * inside, false), "{inside}");
        }
        for beyond in [most.next_up(), 1e30, f32::INFINITY] {
            assert_eq!(sample(sign * beyond), (sign * most, true), "{beyond}");
        }
        for silent in [0.0, least.next_down(), f32::MIN_POSITIVE, f32::from_bits(1)] {
            assert_eq!(sample(sign * silent), (0.0, false), "{silent}");
        }
    }
    assert_eq!(sample(f32::NAN), (0.0, true));
    let sample = |x: f32| {
        let (y, clamped) = Fixed::sample_of(Fixed::sum_of(fixed::FixedI32::of(x)));
        (y.value(), clamped)
    };
    for (x, y, clamped) in [
        (1.5, 1.5, false),
        (-2047.5, -2047.5, false),
        (2048.0, 2048.0, true),
        (-2048.0, -2048.0, true),
        (3000.0, 2048.0, true),
        (-3000.0, -2048.0, true),
    ] {
        assert_eq!(sample(x), (y, clamped));
    }
}

#[test]
fn inner_products_run_over_as_many_blocks_as_they_are_told() {
    let c: [[f32; 4]; 3] = [[1.0, 2.0, 3.0, 4.0], [0.5, 0.25, -1.0, 8.0], [7.0; 4]];
    let x: [[f32; 4]; 3] = [[2.0, -1.0, 0.5, 4.0], [16.0, 4.0, 2.0, -0.5], [1.0; 4]];
    for (blocks, exact) in [(0, 0.0), (1, 17.5), (2, 20.5), (3, 48.5)] {
        assert_eq!(
            Float::sample_of(Float::inner_product(blocks, &c, &x)).0,
            exact
        );
        let (c, x) = (
            c.map(|c| c.map(fixed::FixedI32::of)),
            x.map(|x| x.map(fixed::FixedI32::of)),
        );
        assert_eq!(
            Fixed::sample_of(Fixed::inner_product(blocks, &c, &x))
                .0
                .value(),
            exact
        );
    }
}

#[test]
fn a_shortened_force_has_no_part_next_to_nothing() {
    let limiter = Limiter::<Float>::new(&Config::default().limits, 1000.0);
    let (next, _) = limiter.step(Vector::ZERO, Vector::of([100.0, 1e-25, -1e-37]));
    let [x, y, z] = next.values();
    assert!(x > 1.9 && [y, z] == [0.0; 2], "{next:?}");
}
