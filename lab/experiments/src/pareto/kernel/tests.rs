//! Every kernel against the f64 oracle, at rest and in time.

use super::super::noise::gaussian;
use super::Kernel;
use asperity::{
    model::{
        ModelGrid, Numerator,
        mixture::{BarycentricPoint, Field},
    },
    passes::reduce::order::Fits,
    signal::{
        lsf,
        spectrum::{self, ArmaModel},
    },
    sources::builtin,
};
use asperity_kernels::design::{Design, Order, Shape, Structure, variants};
use rand_core::SeedableRng as _;
use rand_xoshiro::Xoshiro256PlusPlus;

/// The built-in texture with a numerator of its own, whose zeros are made from its poles.
fn arma() -> ModelGrid {
    let mut grid = builtin::texture().grid;
    grid.numerator = Numerator::Lsf;
    for vertex in &mut grid.vertices {
        let zeros = vertex.lsf_rad.iter().step_by(2).map(|w| 0.9 * w + 0.2);
        vertex.ma_lsf_rad = Some(zeros.collect());
        vertex.gain = 0.7;
    }
    grid
}

fn places(grid: &ModelGrid, count: usize) -> Vec<BarycentricPoint> {
    let field = Field::new(grid);
    (0..count)
        .map(|n| {
            let phase = n as f64 / count as f64;
            let speed_mm_s = 150.0 * (3.0 * phase).sin().abs() + 20.0;
            field.locate(speed_mm_s, 0.5 + phase).expect("inside")
        })
        .collect()
}

fn noise(count: usize) -> Vec<f64> {
    gaussian(&mut Xoshiro256PlusPlus::seed_from_u64(3), count)
}

#[test]
fn the_oracle_settles_on_the_exact_mixture() {
    for grid in [builtin::texture().grid, arma()] {
        let field = Field::new(&grid);
        let mut oracle = Kernel::new(&Design::ORACLE, &grid).unwrap();
        for place in places(&grid, 20) {
            oracle.settle(&place);
            let exact = field.model(&place);
            let distance_db = spectrum::log_spectral_distance_db(&exact, &oracle.model());
            assert!(distance_db < 1e-9, "{distance_db} dB");
        }
    }
}

#[test]
fn every_structure_renders_the_same_samples_where_parameters_stand_still() {
    for grid in [builtin::texture().grid, arma()] {
        let place = places(&grid, 7)[3];
        let epsilon = noise(400);
        let still = vec![place; epsilon.len()];
        let render = |structure| {
            let design = Design {
                structure,
                ..Design::ORACLE
            };
            let mut kernel = Kernel::new(&design, &grid).unwrap();
            kernel.settle(&place);
            kernel.render(&still, &epsilon)
        };
        let direct = render(Structure::Direct);
        for structure in [
            Structure::DirectLsp,
            Structure::Lattice,
            Structure::NormalisedLattice,
        ] {
            for (n, (x, y)) in direct.iter().zip(render(structure)).enumerate() {
                assert!((x - y).abs() < 1e-8, "{structure:?}, sample {n}: {x}, {y}");
            }
        }
    }
}

#[test]
fn every_shape_is_exact_at_a_vertex() {
    let grid = arma();
    for shape in Shape::ALL {
        let design = Design {
            shape,
            ..Design::ORACLE
        };
        let mut kernel = Kernel::new(&design, &grid).unwrap();
        for (index, vertex) in grid.vertices.iter().enumerate() {
            kernel.settle(&BarycentricPoint {
                vertices: [index; 3],
                weights: [0.2, 0.3, 0.5],
            });
            let exact = ArmaModel::at_vertex(&grid, vertex);
            let distance_db = spectrum::log_spectral_distance_db(&exact, &kernel.model());
            assert!(distance_db < 1e-3, "{shape:?}: {distance_db} dB");
        }
    }
}

#[test]
fn every_variant_renders_the_reference_texture() {
    let full = builtin::texture().grid;
    for variant in variants() {
        let numerator = match variant.design.order {
            Order::AllPole(_) => Numerator::None,
            _ => Numerator::Nyquist,
        };
        let fits = Fits::new(&full, numerator).unwrap();
        let grid = match variant.design.order {
            Order::AllPole(order) | Order::WithZero(order) => {
                fits.at(order.min(fits.largest())).unwrap()
            }
            Order::Full | Order::Auto => full.clone(),
        };
        let mut kernel = Kernel::new(&variant.design, &grid).unwrap();
        let places = places(&grid, 2000);
        kernel.settle(&places[0]);
        let rendered = kernel.render(&places, &noise(places.len()));
        let rms = (rendered.iter().map(|y| y * y).sum::<f64>() / 2000.0).sqrt();
        assert!(rms > 0.01 && rms < 100.0, "{}: {rms}", variant.name);
    }
}

#[test]
fn smoothing_closes_two_thirds_of_a_step_in_its_time_constant() {
    let grid = builtin::texture().grid;
    let at = |speed_mm_s| Field::new(&grid).locate(speed_mm_s, 1.0).unwrap();
    let (slow, fast) = (at(40.0), at(200.0));
    for update_ticks in [1, 5] {
        let design = Design {
            update_ticks,
            ..Design::ORACLE
        };
        let mut smoothed = Kernel::new(&design, &grid).unwrap();
        smoothed.settle(&slow);
        // Five ticks of 1 ms.
        smoothed.render(&[fast; 5], &[0.0; 5]);
        let covered = |model: &ArmaModel, index: usize| {
            let value = |model: &ArmaModel| lsf::from_polynomial(&model.a).unwrap()[index].cos();
            let ends = [slow, fast].map(|place| value(&Field::new(&grid).model(&place)));
            (value(model) - ends[0]) / (ends[1] - ends[0])
        };
        let found = covered(&smoothed.model(), 2);
        assert!((found - (1.0 - (-1.0_f64).exp())).abs() < 1e-6, "{found}");
    }
}
