//! Any valid parts are read back as they were written, by the crate and by a reader that was
//! written from `SPEC.md`.

use crate::common;
use crate::common::{Parts, full, lattice, small, spec_reader};
use asperity_formats::{
    Adhesion, Asset, ContactParts, Coupling, Direction, Drag, EncodeError, FormatError, Imprint,
    LawPoint, Numerator, Relaxation, SpringPoint, Vertex, VertexKind,
};
use proptest::{collection::vec, prelude::*};

/// Strictly ascending codes, at least `gap` apart and `gap` away from both ends.
fn ascending(order: usize, gap: u16) -> impl Strategy<Value = Vec<u16>> {
    vec(1_u32..1000, order + 1).prop_map(move |steps| {
        let room = 65536 - u32::from(gap) * steps.len() as u32;
        let sum: u32 = steps.iter().sum();
        let mut at = 0;
        steps[..order]
            .iter()
            .map(|step| {
                at += u32::from(gap) + room * step / sum;
                at.min(65535) as u16
            })
            .collect()
    })
}

fn axis(max: f32) -> impl Strategy<Value = Vec<f32>> {
    vec(0.05_f32..1.0, 1..7).prop_map(move |steps| {
        let sum: f32 = steps.iter().sum();
        let mut at = 0.0;
        std::iter::once(0.0)
            .chain(steps.iter().map(|step| {
                at += step / sum * max;
                at
            }))
            .collect()
    })
}

fn name() -> impl Strategy<Value = String> {
    "[A-Za-zµ€😀 0-9]{1,16}"
}

fn models() -> impl Strategy<Value = (Numerator, Vec<common::Model>)> {
    (1_usize..=24, 1_usize..=24, 0..3).prop_flat_map(|(ar, ma, numerator)| {
        let (numerator, ma) = match numerator {
            0 => (Numerator::None, 0),
            1 => (Numerator::Nyquist, 0),
            _ => (Numerator::Lsf, ma),
        };
        let gain = if numerator == Numerator::Lsf {
            (0.0_f32..1e4).boxed()
        } else {
            Just(1.0).boxed()
        };
        vec((ascending(ar, 100), ascending(ma, 1), gain), 1..20)
            .prop_map(move |models| (numerator, models))
    })
}

fn grid() -> impl Strategy<Value = Parts> {
    (
        models(),
        axis(300.0),
        axis(5.0),
        vec((0.0_f32..1e4, any::<u8>(), any::<bool>()), 49),
    )
        .prop_map(|((numerator, models), speeds, forces, draws)| {
            let mut draws = draws.into_iter();
            let mut vertices = Vec::new();
            for &force_n in &forces {
                for &speed_mm_s in &speeds {
                    let (sigma_m_s2, model, interior) = draws.next().expect("49 vertices at most");
                    vertices.push(Vertex {
                        speed_mm_s,
                        force_n,
                        sigma_m_s2,
                        model: model % models.len() as u8,
                        kind: if interior {
                            VertexKind::Interior
                        } else {
                            VertexKind::Edge
                        },
                    });
                }
            }
            Parts {
                numerator,
                models,
                vertices,
                triangles: lattice(speeds.len(), forces.len()),
                ..small()
            }
        })
}

fn traces() -> impl Strategy<Value = Vec<(f32, Vec<f32>)>> {
    (1_usize..40, 0_usize..=16).prop_flat_map(|(samples, count)| {
        vec((0.01_f32..1.0, vec(-1e3_f32..1e3, samples)), count).prop_map(|mut traces| {
            let mut speed = 0.0;
            for trace in &mut traces {
                speed += trace.0;
                trace.0 = speed;
            }
            traces
        })
    })
}

/// No law, or 2 to 8 points of ascending speeds.
fn law() -> impl Strategy<Value = Vec<(u16, u16)>> {
    let speeds = proptest::collection::btree_set(any::<u16>(), 2..=8);
    let points = (speeds, vec(any::<u16>(), 8))
        .prop_map(|(speeds, factors)| speeds.into_iter().zip(factors).collect());
    proptest::option::of(points).prop_map(Option::unwrap_or_default)
}

/// No contact law, or one whose parts are there or not.
fn contact() -> impl Strategy<Value = Option<(ContactParts<'static>, Vec<SpringPoint>)>> {
    let number = 0.0_f32..1.0;
    let steps = vec((1_u16..9000, 0.0_f64..=1.0), 0..=6);
    let law = (vec(number, 11), any::<[bool; 4]>(), steps).prop_map(|(x, there, steps)| {
        let part = |part: usize, value: f32| if there[part] { value + 0.01 } else { 0.0 };
        let numbers = ContactParts {
            damping_s_m: x[0],
            relaxation: Relaxation {
                stiffness_n_m: part(0, x[1]),
                time_s: part(0, x[2]),
            },
            imprint: Imprint {
                yield_m: part(1, x[3] * 0.04) * f32::from(there[1]),
                share: part(1, x[4] * 0.9),
                heal: part(1, x[5] * 0.9),
                recovery_s: part(1, x[6]),
            },
            drag: Drag {
                viscous_n_s_m2: part(2, x[7]),
                plough_n_m: x[8],
            },
            adhesion: Adhesion {
                pull_n: part(3, x[9]),
                stiffness_n_m: part(3, x[10]),
            },
            spring: &[],
        };
        let mut last = SpringPoint::default();
        let spring = (steps.into_iter())
            .map(|(deeper, slope)| {
                last.depth_code += deeper;
                last.shape_code += (slope * f64::from(deeper)) as u16;
                last
            })
            .collect();
        (numbers, spring)
    });
    proptest::option::of(law)
}

/// No direction, or any; μ times a ratio is 10 at most.
fn direction() -> impl Strategy<Value = Option<Direction>> {
    let axis = (-1.0_f32..1.0, -1.0_f32..1.0, 0.1_f32..1.0);
    let ratios = (
        0.0_f32..=2.0,
        0.125_f32..=2.0,
        0.0625_f32..=1.0,
        0.0625_f32..=1.0,
    );
    let direction = (axis, ratios).prop_map(|((x, y, z), ratios)| {
        let length = (x * x + y * y + z * z).sqrt();
        Direction {
            axis: [x, y, z].map(|part| part / length),
            power_ratio: ratios.0,
            speed_ratio: ratios.1,
            mu_forward: ratios.2,
            mu_backward: ratios.3,
        }
    });
    proptest::option::of(direction)
}

prop_compose! {
    fn parts()(
        grid in grid(), name in name(), traces in traces(),
        rates in (100.0_f32..2e5, 100.0_f32..2e5), mu in 0.0_f32..10.0,
        anchors in vec((name(), 0.0_f32..10.0, 0.0_f32..=1.0), 0..=16), law in law(), more in (contact(), direction()),
        surface in (1e-3_f32..1e5, 0.0_f32..1e3, 0.0_f32..1e3, 0.0_f32..100.0, 1e-3_f32..1e4),
        metadata in any::<(bool, u64, u32, bool)>(), png in vec(any::<u8>(), 0..50), preview in any::<bool>(),
    ) -> Parts {
        let mut parts = grid;
        parts.name = name;
        parts.traces = traces;
        (parts.grid_rate_hz, parts.tap_rate_hz) = rates;
        parts.mu = mu;
        parts.anchors = anchors;
        // μ times a factor is 10 at most.
        let highest = (10.0 / f64::from(mu) * 8192.0).floor().clamp(0.0, 65535.0) as u16;
        parts.law = law
            .into_iter()
            .map(|(speed_code, factor_code)| LawPoint {
                speed_code,
                factor_code: factor_code.min(highest),
            })
            .collect();
        parts.coupling = Coupling {
            stiffness_n_m: surface.0,
            damping_n_s_m: surface.1,
            vib_s2_m: surface.2,
            effective_mass_kg: surface.3,
            f_max_n: surface.4,
        };
        (parts.contact, parts.direction) = more;
        let (present, seed, source_crc32, prompt) = metadata;
        parts.provenance = parts.provenance.filter(|_| present).map(|mut provenance| {
            provenance.seed = seed;
            provenance.source_crc32 = source_crc32;
            provenance.prompt = provenance.prompt.filter(|_| prompt);
            provenance
        });
        parts.preview_png = parts.preview_png
            .map(|magic| [magic, png].concat())
            .filter(|_| preview);
        parts
    }
}

/// An asset as the crate reads it, in the types of the plain reader.
fn as_plain(bytes: &[u8]) -> spec_reader::Plain {
    let asset = Asset::parse(bytes).expect("a valid asset");
    let (grid, taps, surface) = (asset.grid(), asset.taps(), asset.coupling());
    let lsf = |code: asperity_formats::LsfCode| code.to_rad();
    spec_reader::Plain {
        name: asset.name().into(),
        grid_rate_hz: grid.sample_rate_hz(),
        numerator: match grid.numerator() {
            Numerator::None => 0,
            Numerator::Nyquist => 1,
            Numerator::Lsf => 2,
        },
        models: grid
            .models()
            .map(|m| {
                (
                    m.lsf().map(lsf).collect(),
                    m.ma_lsf().map(lsf).collect(),
                    m.gain.into(),
                )
            })
            .collect(),
        vertices: grid
            .vertices()
            .map(|v| {
                let kind = u8::from(v.kind == VertexKind::Edge);
                (v.speed_mm_s, v.force_n, v.sigma_m_s2.into(), v.model, kind)
            })
            .collect(),
        triangles: grid.triangles().collect(),
        tap_rate_hz: taps.sample_rate_hz(),
        traces: taps
            .traces()
            .map(|t| (t.speed_m_s, t.accel_m_s2().map(f64::from).collect()))
            .collect(),
        mu: asset.friction().mu(),
        anchors: asset
            .friction()
            .anchors()
            .map(|a| (a.name.into(), a.mu, a.weight))
            .collect(),
        law: asset.friction().law().map_or(vec![], |law| {
            law.points()
                .map(|p| (p.speed_mm_s().into(), p.factor().into()))
                .collect()
        }),
        coupling: [
            surface.stiffness_n_m,
            surface.damping_n_s_m,
            surface.vib_s2_m,
            surface.effective_mass_kg,
            surface.f_max_n,
        ],
        contact: asset.contact().map(|law| {
            let (relaxation, imprint) = (law.relaxation, law.imprint);
            let numbers = [
                law.damping_s_m,
                relaxation.stiffness_n_m,
                relaxation.time_s,
                imprint.yield_m,
                imprint.share,
                imprint.heal,
                imprint.recovery_s,
                law.drag.viscous_n_s_m2,
                law.drag.plough_n_m,
                law.adhesion.pull_n,
                law.adhesion.stiffness_n_m,
            ];
            let spring = law.points().map(|p| (p.depth_m(), p.shape_m()));
            (numbers, spring.collect())
        }),
        direction: asset.direction().map(|direction| {
            let [x, y, z] = direction.axis;
            let (power, speed) = (direction.power_ratio, direction.speed_ratio);
            [
                x,
                y,
                z,
                power,
                speed,
                direction.mu_forward,
                direction.mu_backward,
            ]
        }),
        provenance: asset.provenance().map(|p| spec_reader::PlainProvenance {
            generator: p.generator.into(),
            source: p.source.into(),
            source_crc32: p.source_crc32.into(),
            prompt: p.prompt.map(Into::into),
            seed: p.seed,
            fidelity: p.fidelity.into(),
            taps_synthetic: p.taps_synthetic,
            lsf_error_db: p.lsf_error_db,
            notes: p.notes.into(),
        }),
        preview_png: asset.preview_png().map(Into::into),
    }
}

/// Both readers agree to the last bit, up to the rounding of the f32 tap samples.
fn assert_same(mut ours: spec_reader::Plain, mut plain: spec_reader::Plain) {
    for (ours, plain) in ours.traces.iter_mut().zip(&mut plain.traces) {
        assert_eq!(ours.0, plain.0);
        assert_eq!(ours.1.len(), plain.1.len());
        for (a, b) in ours.1.drain(..).zip(plain.1.drain(..)) {
            assert!(
                (a - b).abs() <= b.abs() * 3e-7,
                "tap sample {a} against {b}"
            );
        }
    }
    assert_eq!(ours, plain);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_valid_parts_are_read_back(parts in parts()) {
        let bytes = parts.encode();
        let plain = spec_reader::read(&bytes);
        assert_same(as_plain(&bytes), plain.clone());

        prop_assert_eq!(&plain.name, &parts.name);
        prop_assert_eq!(&plain.triangles, &parts.triangles);
        prop_assert_eq!(&plain.anchors, &parts.anchors);
        prop_assert_eq!(plain.mu, parts.mu);
        let law: Vec<_> = parts.law.iter()
            .map(|p| (f64::from(p.speed_mm_s()), f64::from(p.factor()))).collect();
        prop_assert_eq!(&plain.law, &law);
        prop_assert_eq!(plain.contact.is_some(), parts.contact.is_some());
        if let (Some((numbers, spring)), Some((parts, points))) = (&plain.contact, &parts.contact) {
            prop_assert_eq!(numbers[2], parts.relaxation.time_s);
            prop_assert_eq!(numbers[10], parts.adhesion.stiffness_n_m);
            let points: Vec<_> = points.iter().map(|p| (p.depth_m(), p.shape_m())).collect();
            prop_assert_eq!(spring, &points);
        }
        prop_assert_eq!(plain.direction.map(|numbers| numbers[4]), parts.direction.map(|d| d.speed_ratio));
        prop_assert_eq!(&plain.preview_png, &parts.preview_png);
        prop_assert_eq!(plain.provenance.map(|p| p.seed), parts.provenance.map(|p| p.seed));
        for (read, (ar, ma, gain)) in plain.models.iter().zip(&parts.models) {
            let bits = |lsf: &[f64]| -> Vec<u16> {
                lsf.iter().map(|w| (w / std::f64::consts::PI * 65536.0).round() as u16).collect()
            };
            prop_assert_eq!(&bits(&read.0), ar);
            prop_assert_eq!(&bits(&read.1), ma);
            // Half a unit in the last place of binary16 (eleven bits), or half its smallest step.
            let gain = f64::from(*gain);
            prop_assert!((read.2 - gain).abs() <= gain * 2.0_f64.powi(-11) + 2.0_f64.powi(-25));
        }
        for (read, vertex) in plain.vertices.iter().zip(&parts.vertices) {
            prop_assert_eq!((read.0, read.1, read.3), (vertex.speed_mm_s, vertex.force_n, vertex.model));
            let sigma = f64::from(vertex.sigma_m_s2);
            prop_assert!((read.2 - sigma).abs() <= sigma * 2.0_f64.powi(-11) + 2.0_f64.powi(-25));
        }
        prop_assert_eq!(plain.traces.len(), parts.traces.len());
        for (read, (speed_m_s, trace)) in plain.traces.iter().zip(&parts.traces) {
            prop_assert_eq!(read.0, *speed_m_s);
            let peak = trace.iter().fold(0.0_f64, |peak, a| peak.max(f64::from(a.abs())));
            for (a, b) in read.1.iter().zip(trace) {
                // Half a code, plus rounding in f32.
                prop_assert!((a - f64::from(*b)).abs() <= peak / 2047.0 * 0.501);
            }
        }
    }

    #[test]
    fn the_same_parts_give_the_same_bytes(parts in parts()) {
        let room = parts.encode().len();
        prop_assert_eq!(parts.encode(), parts.encode_into(room).expect("room for every byte"));
    }
}

#[test]
fn every_smaller_buffer_is_a_typed_error() {
    let parts = small();
    let len = parts.encode().len();
    for room in 0..len {
        let error = parts.encode_into(room).expect_err("too small a buffer");
        assert!(
            matches!(error, EncodeError::BufferTooSmall { needed, available }
                if needed > available && available == room)
                || error == EncodeError::Metadata,
            "room {room}: {error}"
        );
    }
}

#[test]
fn a_full_texture_takes_4_kib_at_most() {
    let bytes = full().encode();
    let asset = Asset::parse(&bytes).expect("a valid asset");
    assert_eq!(asset.grid().models().len(), 18);
    assert_eq!(asset.taps().traces().len(), 13);
    assert!(asset.haptic_len() <= 4096, "{} bytes", asset.haptic_len());
    println!(
        "18 models of 21 LSFs, 56 vertices, 84 triangles, 13 taps of 100: {} haptic bytes",
        asset.haptic_len()
    );
}

#[test]
fn lists_that_do_not_match_are_named() {
    let mut parts = small();
    parts.models[1].0.pop();
    assert_eq!(
        parts.encode_into(4096),
        Err(EncodeError::Count {
            field: "grid.model.lsf",
            index: 1,
            found: 1,
            expected: 2
        })
    );
    let mut parts = small();
    parts.traces[1].1.pop();
    assert_eq!(
        parts.encode_into(4096),
        Err(EncodeError::Count {
            field: "taps.trace",
            index: 1,
            found: 2,
            expected: 3
        })
    );
    let mut parts = small();
    parts.models = vec![parts.models[0].clone(); 256];
    assert_eq!(
        parts.encode_into(1 << 16),
        Err(EncodeError::Count {
            field: "grid.models",
            index: 0,
            found: 256,
            expected: 255
        })
    );
}

/// Quantisation would turn it into silence without a warning.
#[test]
fn a_tap_sample_that_is_no_number_is_refused() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut parts = small();
        parts.traces[1].1[2] = bad;
        let error = parts.encode_into(4096).expect_err("no number");
        assert!(
            matches!(
                error,
                EncodeError::Rejected(FormatError::Invalid {
                    field: "taps.trace.samples",
                    index: 5,
                    ..
                })
            ),
            "{bad}: {error}"
        );
    }
}
