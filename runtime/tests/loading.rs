//! A texture loads where it just fits. One more of anything than there is room for is refused, named, and changes nothing.

use asperity_formats::{Asset, Coupling, Numerator};
use asperity_runtime::{
    Capacities, Capacity, Fixed, Float, HostCapacities, HostTexture, LoadError, Needs,
    RenderArithmetic, Texture,
};
use asperity_tests::texture::{HostSlot, TextureKind, random};
use std::mem::MaybeUninit;

/// 9 vertices, 8 triangles, orders 5 and 6, 13 taps of 100 samples at 10 kHz.
const KIND: TextureKind = TextureKind {
    ar_order: 5,
    ma_order: 6,
    numerator: Numerator::Lsf,
    lattice: (3, 3),
};
/// At the rate of the taps, which are not converted.
const RATE_HZ: f32 = 10_000.0;

fn bytes() -> Vec<u8> {
    random(1, KIND).encode()
}

fn load<S: Capacity, A: RenderArithmetic>(rate_hz: f32) -> Result<(), LoadError> {
    let bytes = bytes();
    let mut slot = Box::new(Texture::<S, A>::new());
    slot.load(&Asset::parse(&bytes).unwrap(), rate_hz)
}

#[test]
fn a_texture_says_what_it_needs() {
    let bytes = bytes();
    let needs = Needs::of(&Asset::parse(&bytes).unwrap(), RATE_HZ).unwrap();
    let found = (
        needs.vertices,
        needs.triangles,
        needs.ar_order,
        needs.ma_order,
        needs.tap_samples,
    );
    assert_eq!(found, (9, 8, 5, 6, 1300));
    assert_eq!(needs.fit::<HostCapacities>(), Ok(()));
    // Converted traces are the length that the bank has.
    for rate_hz in [1000.0, 4000.0, 20_000.0] {
        let asset = Asset::parse(&bytes).unwrap();
        let needs = Needs::of(&asset, rate_hz).unwrap();
        let mut slot = Box::new(Texture::<Capacities<9, 8, 8, 8, 8192>>::new());
        slot.load(&asset, rate_hz).unwrap();
        assert_eq!(needs.tap_samples, 13 * slot.taps().ticks());
    }
}

#[test]
fn a_texture_loads_where_it_just_fits_and_nowhere_smaller() {
    fn check<A: RenderArithmetic>() {
        assert_eq!(load::<Capacities<9, 8, 8, 8, 1300>, A>(RATE_HZ), Ok(()));
        let short = |field, found, capacity| {
            Err(LoadError::Capacity {
                field,
                found,
                capacity,
            })
        };
        for (loaded, refusal) in [
            (
                load::<Capacities<8, 8, 8, 8, 1300>, A>(RATE_HZ),
                short("vertices", 9, 8),
            ),
            (
                load::<Capacities<9, 4, 8, 8, 1300>, A>(RATE_HZ),
                short("triangles", 8, 4),
            ),
            (
                load::<Capacities<9, 8, 4, 8, 1300>, A>(RATE_HZ),
                short("ar_order", 5, 4),
            ),
            (
                load::<Capacities<9, 8, 8, 4, 1300>, A>(RATE_HZ),
                short("ma_order", 6, 4),
            ),
            (
                load::<Capacities<9, 8, 8, 8, 1299>, A>(RATE_HZ),
                short("tap samples", 1300, 1299),
            ),
        ] {
            assert_eq!(loaded, refusal);
        }
    }
    check::<Float>();
    check::<Fixed>();
}

/// Triangles and lags stand in fours, so a remainder is no room.
#[test]
fn a_capacity_that_is_no_multiple_of_four_counts_as_the_one_below() {
    fn of<S: Capacity>() -> [usize; 5] {
        [
            S::VERTICES,
            S::TRIANGLES,
            S::AR_ORDER,
            S::MA_ORDER,
            S::TAP_SAMPLES,
        ]
    }
    assert_eq!(of::<Capacities<9, 8, 8, 8, 1300>>(), [9, 8, 8, 8, 1300]);
    assert_eq!(of::<Capacities<9, 11, 10, 9, 7>>(), [9, 8, 8, 8, 7]);
    assert_eq!(of::<Capacities<1, 3, 2, 1, 1>>(), [1, 0, 0, 0, 1]);
    assert_eq!(of::<HostCapacities>(), [64, 128, 24, 24, 4096]);
}

#[test]
fn the_servo_loop_runs_at_one_to_twenty_times_the_rate_of_the_models() {
    let mut texture = random(1, KIND);
    texture.traces.truncate(1);
    let bytes = texture.encode();
    let asset = Asset::parse(&bytes).unwrap();
    for ticks in 1..=20_u8 {
        let mut slot = HostSlot::<Float>::new();
        let rate_hz = 1000.0 * f32::from(ticks);
        slot.load(&asset, rate_hz).unwrap();
        assert_eq!(slot.ticks_per_sample(), ticks);
        assert_eq!(slot.servo_rate_hz(), rate_hz);
    }
    for servo_hz in [999.0, 1001.0, 1500.0, 500.0, 21_000.0, 0.0, -1000.0] {
        let refusal = LoadError::Rate {
            model_hz: 1000.0,
            servo_hz,
        };
        assert_eq!(Needs::of(&asset, servo_hz), Err(refusal));
        assert_eq!(
            HostSlot::<Float>::new().load(&asset, servo_hz),
            Err(refusal)
        );
    }
}

/// Observable content of a slot.
fn face<S: Capacity>(slot: &Texture<S>) -> (f32, u8, u8, Coupling, f32, usize, Vec<f32>) {
    let filter = slot.filter_at(100.0, 1.0);
    let mut numbers = vec![filter.level_m_s2, slot.mu_at(50.0)];
    numbers.extend(filter.a.iter().chain(&filter.b));
    (
        slot.servo_rate_hz(),
        slot.ticks_per_sample(),
        slot.cycle_samples(),
        slot.coupling(),
        slot.mu(),
        slot.taps().ticks(),
        numbers,
    )
}

#[test]
fn a_slot_that_refuses_keeps_what_it_had() {
    let kept = random(1, KIND);
    let bytes = kept.encode();
    let mut slot = Box::new(Texture::<Capacities<9, 8, 8, 8, 1300>>::new());
    slot.load(&Asset::parse(&bytes).unwrap(), 2000.0).unwrap();
    let before = face(&slot);
    let larger = random(2, TextureKind::nyquist(20)).encode();
    let larger = Asset::parse(&larger).unwrap();
    assert!(slot.load(&larger, 1000.0).is_err());
    assert!(slot.load_haptic(&[0; 100], 1000.0).is_err());
    assert!(slot.load_haptic(&bytes, 1500.0).is_err());
    assert_eq!(face(&slot), before);
}

#[test]
fn bytes_load_as_their_asset_does() {
    let bytes = bytes();
    let (mut of_asset, mut of_bytes) = (HostTexture::new(), HostTexture::new());
    of_asset
        .load(&Asset::parse(&bytes).unwrap(), 3000.0)
        .unwrap();
    of_bytes.load_haptic(&bytes, 3000.0).unwrap();
    assert_eq!(face(&of_asset), face(&of_bytes));
}

#[test]
fn a_slot_holds_the_wall_and_the_friction_of_its_asset() {
    let texture = random(3, KIND);
    let mut slot = HostTexture::new();
    slot.load(&Asset::parse(&texture.encode()).unwrap(), 1000.0)
        .unwrap();
    assert_eq!(slot.coupling(), texture.coupling);
    assert_eq!(slot.mu(), texture.mu);
    assert_eq!(slot.mu_at(77.0), texture.mu, "without a law");
}

#[test]
fn a_new_slot_and_a_cleared_one_hold_nothing() {
    let empty = face(&HostTexture::new());
    let nothing = Coupling {
        stiffness_n_m: 0.0,
        damping_n_s_m: 0.0,
        vib_s2_m: 0.0,
        effective_mass_kg: 0.0,
        f_max_n: 0.0,
    };
    assert_eq!(
        (empty.0, empty.1, empty.3, empty.4, empty.5),
        (0.0, 1, nothing, 0.0, 0)
    );
    assert!(empty.6.iter().all(|x| *x == 0.0));
    let mut slot = HostTexture::new();
    slot.load(&Asset::parse(&bytes()).unwrap(), 2000.0).unwrap();
    assert_ne!(face(&slot), empty);
    slot.clear();
    assert_eq!(face(&slot), empty);
    let mut memory = MaybeUninit::uninit();
    assert_eq!(face(HostTexture::init(&mut memory)), empty);
    assert_eq!(face(&HostTexture::default()), empty);
}

#[test]
fn an_empty_slot_answers_every_query_with_silence() {
    fn check<A: RenderArithmetic>() {
        let slot = HostSlot::<A>::new();
        for (speed, force) in [(0.0, 0.0), (100.0, 1.0), (f32::NAN, f32::INFINITY)] {
            let weights = slot.weights_at(speed, force).values();
            assert_eq!(weights.iter().sum::<f32>(), 1.0);
            let filter = slot.filter_at(speed, force);
            assert_eq!(filter.level_m_s2, 0.0);
            assert_eq!((filter.a, filter.b), ([0.0; 24], [0.0; 24]));
        }
    }
    check::<Float>();
    check::<Fixed>();
}
