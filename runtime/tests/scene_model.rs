//! A scene against a model of its crossings: a stylus drawn over plates at several heights, some of them over each other,
//! with gaps between them, and with bad samples. The model says which plate is touched, and when a tap starts. And whatever is
//! crossed, a vibration that has ended fades at its own pace.

use crate::scenes::{library_of, on_library};
use asperity_formats::{SceneSurface, Solid};
use asperity_runtime::{
    Fixed, Flags, Float, RenderArithmetic, Sample, SceneState, arithmetic::Scalar as _,
};
use asperity_tests::{
    draw::Draw,
    texture::{Texture, TextureKind, random},
};

/// Lengths are in units of 0.05 mm: the hysteresis is between 2 and 3 of them, and the distance that arms the detector is 10.
const UNIT_M: f32 = 0.05e-3;
const HYSTERESIS: f64 = 2.4;
const ARMS: f64 = 10.0;

/// A level plate, where it can be touched along x. Edges and levels lie between the places of the stylus.
#[derive(Debug, Clone, Copy)]
struct Plate {
    level: f64,
    from: f64,
    to: f64,
    texture: u16,
}

impl Plate {
    fn drawn(draw: &mut Draw, textures: usize) -> Self {
        let from = draw.below(60) as f64 - 30.5;
        Self {
            level: 2.0 * draw.below(12) as f64 - 12.5,
            from,
            to: from + 1.0 + draw.below(40) as f64,
            texture: draw.below(textures) as u16,
        }
    }

    fn surface(&self) -> SceneSurface {
        let m = |units: f64| units as f32 * UNIT_M;
        SceneSurface {
            solid: Solid::Plane {
                point_m: [0.0, 0.0, m(self.level)],
                normal: [0.0, 0.0, 1.0],
            },
            from_m: [m(self.from), -1.0, -1.0],
            to_m: [m(self.to), 1.0, 1.0],
            texture: self.texture,
        }
    }

    /// Signed distance of a place, infinite beyond the edges and a margin.
    fn distance(&self, [x, z]: [f64; 2], margin: f64) -> f64 {
        let within = x >= self.from - margin && x <= self.to + margin;
        if within {
            z - self.level
        } else {
            f64::INFINITY
        }
    }
}

/// A place of the stylus, x and z; `None` is a bad sample.
type StylusPosition = Option<[f64; 2]>;

/// A walk that hovers, descends, strokes and leaves, at up to 0.2 m/s.
fn walk(draw: &mut Draw, ticks: usize) -> Vec<StylusPosition> {
    let (mut x, mut z) = (0_i32, 20_i32);
    let (mut along, mut down) = (0, 0);
    let mut bad = 0;
    let mut places = Vec::new();
    while places.len() < ticks {
        if draw.below(8) == 0 {
            along = draw.below(13) as i32 - 6;
            down = [-4, -4, -3, -1, 0, 0, 2, 4][draw.below(8)];
        }
        if draw.below(50) == 0 {
            bad = [1, 2, 3, 5][draw.below(4)];
        }
        x = (x + along).clamp(-45, 45);
        z = (z + down).clamp(-20, 25);
        let place = [f64::from(x), f64::from(z)];
        places.push(if bad > 0 { None } else { Some(place) });
        bad = 0.max(bad - 1);
    }
    places
}

/// Reference model of a scene.
struct Model<'p> {
    plates: &'p [Plate],
    at: Option<usize>,
    last: [f64; 2],
    /// The last eight heights; older ones are not known where the stylus was over nothing.
    heights: Vec<f64>,
    armed: bool,
    bad: u32,
}

impl Model<'_> {
    fn new(plates: &[Plate]) -> Model<'_> {
        Model {
            plates,
            at: None,
            last: [0.0; 2],
            heights: Vec::new(),
            armed: false,
            bad: u32::MAX,
        }
    }

    fn distance(&self, place: [f64; 2]) -> f64 {
        let at = self.at.map(|at| &self.plates[at]);
        at.map_or(f64::INFINITY, |plate| place[1] - plate.level)
    }

    /// The plate that is touched, and whether a tap starts; `None` where its speed is too near the slowest to tell.
    fn tick(&mut self, place: StylusPosition) -> (Option<usize>, Option<bool>) {
        if let Some(place) = place {
            let at = self.nearest(place);
            if at != self.at {
                let from_nothing = self.at.is_none();
                self.at = at;
                // What was inside before is not entered by an impact.
                self.armed &= self.distance(self.last) > 0.0;
                if from_nothing {
                    self.heights.clear();
                }
            }
            self.last = place;
            if self.bad > 2 {
                self.armed = false;
                self.heights = vec![place[1]; 8];
            }
            self.bad = 0;
        } else {
            self.bad = self.bad.saturating_add(1);
        }
        self.heights.insert(0, self.last[1]);
        self.heights.truncate(8);
        let distance = self.distance(self.last);
        let mut taps = Some(false);
        if distance < 0.0 {
            if self.armed {
                taps = self.is_fast();
            }
            self.armed = false;
        } else if distance > ARMS {
            self.armed = true;
        }
        (self.at.filter(|_| distance < 0.0), taps)
    }

    /// Returns true if the least-squares slope of eight heights, one a millisecond, is above 10
    /// mm/s downwards; `None` for fewer heights or a slope too close to call.
    fn is_fast(&self) -> Option<bool> {
        if self.heights.len() < 8 {
            return None;
        }
        let sum = |(age, z): (usize, &f64)| z * (2.0 * age as f64 - 7.0);
        let speed = self.heights.iter().enumerate().map(sum).sum::<f64>() / 84.0;
        // 0.05 m/s a unit.
        let over = 0.05 * speed - 0.01;
        (over.abs() > 1e-4).then_some(over > 0.0)
    }

    /// The deepest or the nearest plate; the one in contact as if it were deeper, and wider.
    fn nearest(&self, place: [f64; 2]) -> Option<usize> {
        let kept = self.at.map(|at| {
            let distance = self.plates[at].distance(place, HYSTERESIS);
            let favour = if distance < 0.0 { HYSTERESIS } else { 0.0 };
            (at, distance - favour)
        });
        let all = self.plates.iter().enumerate();
        let all = all.map(|(index, plate)| (index, plate.distance(place, 0.0)));
        let of_all = kept.into_iter().chain(all).filter(|(_, d)| d.is_finite());
        // Of equals the first.
        of_all
            .reduce(|a, b| if b.1 < a.1 { b } else { a })
            .map(|(index, _)| index)
    }
}

fn sample<A: RenderArithmetic>(place: StylusPosition) -> Sample<A> {
    Sample::of(&place.map_or(Sample::STALE, |[x, z]| {
        Sample::at([x as f32 * UNIT_M, 0.0, z as f32 * UNIT_M])
    }))
}

/// Textures of which only the first is heard, as loud as given, and the last has another clock.
fn textures(sigma_m_s2: f32) -> [Texture; 4] {
    // Textures of the same bytes are the same texture.
    [
        (1, 1000.0, sigma_m_s2),
        (2, 1000.0, 0.0),
        (3, 1000.0, 0.0),
        (4, 500.0, 0.0),
    ]
    .map(|(seed, rate_hz, sigma_m_s2)| {
        let mut texture = random(seed, TextureKind::nyquist(8));
        texture.sample_rate_hz = rate_hz;
        texture.coupling.stiffness_n_m = 500.0;
        for vertex in &mut texture.vertices {
            vertex.sigma_m_s2 = sigma_m_s2;
        }
        texture
    })
}

#[test]
fn a_scene_touches_and_taps_what_its_model_says() {
    fn check<A: RenderArithmetic>() -> [usize; 4] {
        let mut seen = [0; 4];
        for seed in 0..400 {
            let mut draw = Draw::new(seed);
            let count = 1 + draw.below(5);
            let plates: Vec<_> = (0..count).map(|_| Plate::drawn(&mut draw, 2)).collect();
            let places = walk(&mut draw, 400);
            let surfaces: Vec<_> = plates.iter().map(Plate::surface).collect();
            let library = library_of(&textures(0.1), &surfaces);
            on_library::<A, _>(&library, |scene, renderer| {
                let mut state = SceneState::new(1);
                let mut model = Model::new(&plates);
                for (n, &place) in places.iter().enumerate() {
                    let (before, armed) = (model.at, model.armed);
                    let wanted = model.tick(place);
                    let output = renderer.tick_scene(scene, &mut state, &sample(place));
                    let taps = output.flags.contains(Flags::TAP_STARTED);
                    let found = (state.touched(), wanted.1.map(|_| taps));
                    let path = &places[n.saturating_sub(10)..=n];
                    assert_eq!(
                        found, wanted,
                        "seed {seed}, tick {n}: {plates:#?}\nplaces until then: {path:?}"
                    );
                    let crossed = before.is_some() && model.at.is_some() && before != model.at;
                    seen[0] += usize::from(taps);
                    seen[1] += usize::from(crossed && armed && taps);
                    seen[2] += usize::from(crossed && armed && wanted.0.is_some() && !taps);
                    seen[3] += usize::from(crossed && wanted.0.is_some());
                }
            });
        }
        seen
    }
    for seen in [check::<Float>(), check::<Fixed>()] {
        // Taps, taps in the tick of a crossing, crossings of an armed stylus that are none, crossings in contact.
        assert!(seen.iter().all(|count| *count > 10), "{seen:?}");
    }
}

/// The residue of a loud texture falls by a quarter per tick, however many silent ones are crossed
/// meanwhile.
#[test]
fn a_vibration_that_has_ended_fades_at_its_own_pace_over_every_border() {
    const ALONE: usize = 300;
    /// Units a tick: 0.1 m/s.
    const SPEED: f64 = 2.0;
    fn check<A: RenderArithmetic>(step: f32) {
        let mut begun_loud = 0;
        for seed in 0..200 {
            let mut draw = Draw::new(seed);
            let mut edge = SPEED * ALONE as f64 - 0.5;
            let plate = |from, to, texture| Plate {
                level: 0.0,
                from,
                to,
                texture,
            };
            let mut plates = vec![plate(-10.0, edge, 0)];
            // On the first of them there is time for a model, which ends the old vibration.
            for ticks in [12, 0, 0, 0, 0].map(|least| least + 3 + draw.below(12)) {
                let to = edge + SPEED * ticks as f64;
                plates.push(plate(edge, to, 1 + draw.below(3) as u16));
                edge = to;
            }
            let surfaces: Vec<_> = plates.iter().map(Plate::surface).collect();
            let library = library_of(&textures(0.5), &surfaces);
            let heard: Vec<f32> = on_library::<A, _>(&library, |scene, renderer| {
                let mut state = SceneState::new(seed);
                let ticks = (edge / SPEED) as usize;
                (0..ticks)
                    .map(|n| {
                        let place = sample(Some([SPEED * n as f64, -20.0]));
                        let output = renderer.tick_scene(scene, &mut state, &place);
                        output.vib_m_s2.value()
                    })
                    .collect()
            });
            let fades = |n: &usize| (heard[*n] - 0.75 * heard[n - 1]).abs() <= step;
            let begun = (ALONE..ALONE + 15).find(|n| (*n..n + 5).all(|n| fades(&n)));
            let begun = begun.unwrap_or_else(|| panic!("seed {seed}: it goes on: {plates:#?}"));
            let broken = (begun..heard.len()).find(|n| !fades(n));
            assert_eq!(
                broken,
                None,
                "seed {seed}: {plates:#?}\n{:?}",
                &heard[begun..]
            );
            begun_loud += usize::from(heard[begun - 1].abs() > 0.02);
        }
        assert!(begun_loud > 100, "{begun_loud}");
    }
    check::<Float>(1e-7);
    check::<Fixed>(3e-5);
}
