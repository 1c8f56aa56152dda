//! The search for the triangle of a query: of many weights the largest wins, by more than the bits of an index, and its index is
//! told.

use asperity_runtime::{
    Fixed, Float, WeightSearch,
    quantity::{
        Four, Quantity, Raw,
        unit::{Coordinate, Slope, Weight},
    },
};
use asperity_tests::draw::Draw;

const BITS: u32 = 127;

/// The index of the largest of these weights, in fours numbered from 0 on, through bits and back.
fn best<A: WeightSearch>(weights: &[[f32; 4]]) -> (u32, bool) {
    let mut best = A::WORST;
    for (four, index) in weights.iter().zip((0..).step_by(4)) {
        best = A::better(best, Four::<A, Weight>::of(*four), BITS, index);
        let mut bits = [0; 4];
        A::keep(best, &mut bits);
        assert_eq!(A::kept(&bits), best);
        best = A::kept(&bits);
    }
    (A::index(best, BITS), A::is_inside(best))
}

#[test]
fn the_largest_of_many_weights_wins_and_says_where_it_was() {
    fn check<A: WeightSearch>() {
        let mut draw = Draw::new(1);
        for n in 0..3000 {
            let fours = 1 + n % 32;
            // Half of the searches find no triangle that contains the query.
            let most = if n % 2 == 0 { 0.3 } else { -0.01 };
            let mut weights: Vec<[f32; 4]> = (0..fours)
                .map(|_| [0; 4].map(|_| draw.range(-200.0, most - 0.005) as f32))
                .collect();
            let place = draw.below(4 * fours);
            weights[place / 4][place % 4] = most as f32;
            let (index, inside) = best::<A>(&weights);
            assert_eq!(index as usize, place, "{weights:?}");
            assert_eq!(inside, most > 0.0);
        }
    }
    check::<Float>();
    check::<Fixed>();
}

#[test]
fn a_point_on_a_border_is_inside_and_one_beyond_it_is_not() {
    fn inside<A: WeightSearch>(weight: f32) -> bool {
        let places = [0, 1, 2, 3].map(|lane| {
            let mut four = [-1.0; 4];
            four[lane] = weight;
            best::<A>(&[[-2.0; 4], four]).1
        });
        assert!(places == [places[0]; 4], "{weight}: {places:?}");
        places[0]
    }
    for weight in [0.25, 1e-6, 0.0, -0.0, -1e-40, -1e-8, -1.0e-7] {
        assert!(inside::<Float>(weight), "{weight}");
    }
    for weight in [-1.3e-7, -1e-6, -1e-3, -1.0] {
        assert!(!inside::<Float>(weight), "{weight}");
    }
    for weight in [0.25, 0.0] {
        assert!(inside::<Fixed>(weight), "{weight}");
    }
    // The last seven of twenty bits hold an index.
    for weight in [-2e-4, -1e-3, -1.0] {
        assert!(!inside::<Fixed>(weight), "{weight}");
    }
    assert!(!Float::is_inside(Float::WORST) && !Fixed::is_inside(Fixed::WORST));
}

/// A block of lanes without a triangle never wins, wherever the query is.
#[test]
fn no_triangle_is_worse_than_every_triangle() {
    fn check<A: WeightSearch>() {
        for speed in [0.0, 500.0, 1000.0] {
            let far = Quantity::<A, Coordinate>::of(speed) - Quantity::<A, Coordinate>(A::FAR_OFF);
            let weight = f64::from(far.value()) * f64::from(Quantity::<A, Slope>(A::STEEP).value());
            assert!(weight < -1e5, "{weight}");
        }
        assert_eq!(
            best::<A>(&[[-256.0; 4], [-255.0, -256.0, -256.0, -256.0]]).0,
            4
        );
    }
    check::<Float>();
    check::<Fixed>();
}

#[test]
fn numbers_go_to_the_nearest_strip() {
    fn check<A: WeightSearch>() {
        for step in 0..=3200_u32 {
            let x = step as f32 / 100.0 + 1.0 / 1024.0;
            let number: Raw<A, Weight> = Quantity::<A, Weight>::of(x).0;
            let nearest = A::nearest::<fixed::types::extra::U20>(number);
            assert_eq!(nearest, (f64::from(x)).round() as u32, "{x}");
        }
    }
    check::<Float>();
    check::<Fixed>();
}
