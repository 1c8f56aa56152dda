//! Convex weights, finite and stable filters and the mixture of the oracle, on the built-in
//! texture and HaTT materials: at every vertex, every midpoint of an edge, a thousand
//! single-precision points on every edge, along the border, and at random queries.
//!
//! At full size 10⁷ random queries are spread over all materials.

use crate::support;
use asperity_formats::Asset;
use asperity_runtime::{Config, HostTexture, Renderer, Sample, State};
use asperity_tests::{
    draw::Draw,
    hatt,
    oracle::Texture,
    size::{Size, sized},
    stability::largest_reflection,
};
use rayon::prelude::*;

/// Random queries over all materials.
fn random_queries() -> usize {
    sized("random queries", 75_000, 10_000_000)
}

struct Checked {
    slot: Box<HostTexture>,
    oracle: Texture,
    order: usize,
    loudest: f64,
    queries: usize,
    reflection: f64,
    level_error: f64,
}

impl Checked {
    fn new(bytes: &[u8]) -> Self {
        let asset = Asset::parse(bytes).unwrap();
        let mut slot = Box::new(HostTexture::new());
        slot.load(&asset, asset.grid().sample_rate_hz()).unwrap();
        let oracle = Texture::new(&asset);
        let loudest = oracle
            .vertices
            .iter()
            .map(|v| v.level_m_s2)
            .fold(0.0, f64::max);
        Self {
            slot,
            oracle,
            order: asset.grid().ar_order(),
            loudest,
            queries: 0,
            reflection: 0.0,
            level_error: 0.0,
        }
    }

    /// Checks that the weights are convex and the filter is finite and stable.
    fn query(&mut self, speed: f32, force: f32) {
        let query = self.slot.weights_at(speed, force);
        let sum: f32 = query.values().iter().sum();
        let filter = self.slot.filter_at(speed, force);
        let reflection = largest_reflection(&filter.a[..self.order]);
        assert!(
            query.values().iter().all(|w| (0.0..=1.0).contains(w))
                && (sum - 1.0).abs() < 1e-6
                && reflection < 1.0
                && filter.b.iter().all(|b| b.is_finite())
                && (0.0..f32::MAX).contains(&filter.level_m_s2),
            "({speed}, {force}): {query:?} {filter:?}"
        );
        self.queries += 1;
        self.reflection = self.reflection.max(reflection);
    }

    /// Checks the mixture against the oracle, too. Two triangles at one point must agree.
    fn query_exactly(&mut self, speed: f32, force: f32) {
        self.query(speed, force);
        let exact = self.oracle.model(speed.into(), force.into()).level_m_s2;
        let found = f64::from(self.slot.filter_at(speed, force).level_m_s2);
        self.level_error = self.level_error.max((found - exact).abs() / self.loudest);
    }

    fn places(&mut self) {
        let (points_an_edge, points_a_side) = Size::asked().of((15, 700), (1000, 20_000));
        let at = |v: usize, oracle: &Texture| {
            let vertex = &oracle.vertices[v];
            (vertex.speed_mm_s, vertex.force_n)
        };
        for v in 0..self.oracle.vertices.len() {
            let (speed, force) = at(v, &self.oracle);
            self.query_exactly(speed as f32, force as f32);
        }
        for [a, b, c] in self.oracle.triangles.clone() {
            for (p, q) in [(a, b), (b, c), (c, a)] {
                let (p, q) = (at(p, &self.oracle), at(q, &self.oracle));
                let mix = |t: f64| {
                    (
                        (p.0 + t * (q.0 - p.0)) as f32,
                        (p.1 + t * (q.1 - p.1)) as f32,
                    )
                };
                let (speed, force) = mix(0.5);
                self.query_exactly(speed, force);
                for step in 0..=points_an_edge {
                    let (speed, force) = mix(f64::from(step) / f64::from(points_an_edge));
                    self.query(speed, force);
                }
            }
        }
        let (width, height) = (self.oracle.max_speed_mm_s, self.oracle.max_force_n);
        for step in 0..=points_a_side {
            let share = f64::from(step) / f64::from(points_a_side);
            let (speed, force) = ((share * width) as f32, (share * height) as f32);
            let (right, top) = (width as f32, height as f32);
            for (speed, force) in [(speed, 0.0), (speed, top), (0.0, force), (right, force)] {
                self.query(speed, force);
            }
        }
        let odd = [
            0.0,
            -0.0,
            -1.0,
            f32::NAN,
            f32::INFINITY,
            f32::NEG_INFINITY,
            1e30,
            f32::MAX,
        ];
        for speed in odd {
            for force in odd {
                self.query(speed, force);
            }
        }
    }

    fn random(&mut self, count: usize, seed: u64) {
        let mut draw = Draw::new(seed);
        let (width, height) = (self.oracle.max_speed_mm_s, self.oracle.max_force_n);
        for n in 0..count {
            let speed = draw.range(-0.05 * width, 1.1 * width) as f32;
            let force = draw.range(-0.05 * height, 1.1 * height) as f32;
            if n % 100 == 0 {
                self.query_exactly(speed, force);
            } else {
                self.query(speed, force);
            }
        }
    }

    fn verdict(&self, name: &str) {
        println!(
            "{name}: {} queries, largest reflection {:.6}, level within {:.1e} of the loudest",
            self.queries, self.reflection, self.level_error
        );
        assert!(self.level_error < 1e-4, "{name}: {}", self.level_error);
    }
}

/// Good samples after every kind of bad ones, at zero speed and zero force: the force is finite,
/// and that of the wall after the ramp.
fn rest_and_recover(bytes: &[u8]) {
    let asset = Asset::parse(bytes).unwrap();
    let rate = asset.grid().sample_rate_hz();
    let mut slot = Box::new(HostTexture::new());
    slot.load(&asset, rate).unwrap();
    let renderer = Renderer::new(&Config {
        servo_rate_hz: rate,
        ..Config::default()
    })
    .unwrap();
    let depth_m = 1.0 / asset.coupling().stiffness_n_m;
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30] {
        let mut state = State::new(1);
        // On the surface the force is zero, at rest the speed. Then come one to five bad samples.
        for z in [0.0, -f32::MIN_POSITIVE, -depth_m] {
            for _ in 0..200 {
                let output = renderer.tick(&slot, &mut state, &Sample::at([0.0, 0.0, z]));
                assert!(output.force_n.iter().all(|f| f.is_finite()), "{output:?}");
            }
        }
        for count in [1, 2, 5] {
            for _ in 0..count {
                let output = renderer.tick(&slot, &mut state, &Sample::at([0.0, bad, 0.0]));
                assert!(output.force_n.iter().all(|f| f.is_finite()), "{output:?}");
            }
            let mut output = renderer.tick(&slot, &mut state, &Sample::at([0.0, 0.0, -depth_m]));
            assert!(
                output.depth_m > 0.0,
                "the next good sample counts: {output:?}"
            );
            for _ in 0..200 {
                output = renderer.tick(&slot, &mut state, &Sample::at([0.0, 0.0, -depth_m]));
            }
            assert!(
                (output.force_n[2] - 1.0).abs() < 1e-3,
                "after {bad}: {output:?}"
            );
        }
    }
}

#[test]
fn the_builtin_texture() {
    let bytes = support::builtin();
    let mut checked = Checked::new(&bytes);
    checked.places();
    checked.random(random_queries() / 20, 1);
    checked.verdict("builtin");
    rest_and_recover(&bytes);
}

#[test]
#[cfg_attr(
    not(hatt),
    ignore = "no HaTT materials; set ASPERITY_HATT to their folder"
)]
fn every_hatt_material() {
    let (files, random) = (hatt::materials(), random_queries());
    let queries: usize = files
        .par_iter()
        .map(|file| {
            let bytes = support::hatt(file);
            let mut checked = Checked::new(&bytes);
            checked.places();
            checked.random(random / files.len() + 1, 2);
            checked.verdict(&file.file_stem().unwrap_or_default().to_string_lossy());
            rest_and_recover(&bytes);
            checked.queries
        })
        .sum();
    println!("{} materials, {queries} queries", files.len());
}

/// A point on an edge for which the reference renderer never returns.
#[test]
#[cfg_attr(
    not(hatt),
    ignore = "no HaTT materials; set ASPERITY_HATT to their folder"
)]
fn the_point_of_bubble_envelope_that_hangs_the_reference() {
    let files = hatt::materials();
    let file = files
        .iter()
        .find(|f| f.ends_with("Models_Bubble Envelope.xml"))
        .expect("Bubble Envelope among the materials");
    let mut checked = Checked::new(&support::hatt(file));
    for step in -1000_i32..=1000 {
        let nudge = |x: f32| f32::from_bits(x.to_bits().wrapping_add_signed(step));
        checked.query_exactly(231.348_95, nudge(2.541_543));
        checked.query_exactly(nudge(231.348_95), 2.541_543);
    }
    checked.verdict("Bubble Envelope");
}
