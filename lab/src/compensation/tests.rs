//! A single texture on devices that differ by 24 dB, through the renderer and the simulated devices.

use super::*;
use crate::calibration::{HELD, simulate};
use asperity_host::profile::compensation::REFERENCE_M_S2_N;
use asperity_host::profile::response::{BAND_HZ, Response, estimate};
use asperity_host::profile::sweep::Sweep;
use asperity_runtime::{Config, HostTexture, Output, Renderer, Sample, State};
use asperity_sim::device::{Device, DeviceConfig};

const RATE_HZ: f64 = 1000.0;
/// Far below what clips a force anywhere.
const QUIET: f64 = 0.1;

/// Simulated devices whose masses differ by four either way: ±12 dB of acceleration. Friction is
/// left out: in a stroke it is a constant force, which is no part of a spectrum.
fn devices() -> [DeviceConfig; 3] {
    let touch = DeviceConfig::touch().expect("built-in file");
    [0.25, 1.0, 4.0].map(|factor| {
        let mut device = touch.clone();
        device.mechanics.mass_kg = touch.mechanics.mass_kg.map(|kg| factor * kg);
        device.mechanics.coulomb_n = [0.0; 3];
        device.timing.transport_delay_ticks = if factor < 1.0 { 2 } else { 0 };
        device
    })
}

fn filter_of(device: &DeviceConfig) -> Compensation {
    let measured = simulate(device, &Sweep::standard(RATE_HZ, 1.0));
    measured.fit("simulated").expect("a fit").1.filter
}

fn quiet() -> TextureModel {
    let mut texture = asperity::sources::builtin::texture();
    for vertex in &mut texture.grid.vertices {
        vertex.sigma_m_s2 *= QUIET;
    }
    texture
}

fn lowered(texture: &TextureModel) -> Vec<u8> {
    lower::lower(texture, None).expect("a texture").bytes
}

/// A stroke along x at 100 mm/s, 1 mm deep.
fn stroke(bytes: &[u8], seconds: usize) -> Vec<Output> {
    let mut texture = Box::new(HostTexture::new());
    let asset = Asset::parse(bytes).expect("an asset");
    texture.load(&asset, RATE_HZ as f32).expect("it fits");
    let mut config = Config::default();
    // A straight stroke of 60 s is 6 m long.
    config.safety.reach_m = 1.0e4;
    let renderer = Renderer::new(&config).expect("a configuration");
    let mut state = State::new(7);
    let outputs: Vec<Output> = (0..seconds * RATE_HZ as usize)
        .map(|n| {
            let position_m = [1e-4 * n as f32, 0.0, -1e-3];
            renderer.tick(
                &texture,
                &mut state,
                &Sample {
                    position_m,
                    elapsed_ticks: 1,
                },
            )
        })
        .collect();
    assert_eq!(state.counters().peak_limited, 0, "nothing clips a force");
    assert_eq!(
        state.counters().bad_samples,
        0,
        "the stroke stays within reach"
    );
    outputs
}

/// The force along x without its mean, which is friction. The first second is the way there.
fn force_n(outputs: &[Output]) -> Vec<f64> {
    let forces: Vec<f64> = outputs[1000..]
        .iter()
        .map(|o| f64::from(o.force_n[0]))
        .collect();
    let mean = forces.iter().sum::<f64>() / forces.len() as f64;
    forces.iter().map(|force| force - mean).collect()
}

fn accel_m_s2(device: &DeviceConfig, force_n: &[f64]) -> Vec<f64> {
    let mut device = Device::new(device, 0.0, [0.0; 3]);
    let each = force_n.iter().map(|&force_n| {
        let before_m_s = device.velocity_m_s()[0];
        device.command([force_n, 0.0, 0.0]);
        device.advance(1.0 / RATE_HZ, |_, _| [HELD; 3]);
        (device.velocity_m_s()[0] - before_m_s) * RATE_HZ
    });
    each.collect()
}

/// Gain of the band against the reference, dB, from low to high frequencies.
fn levels_db(response: &Response) -> Vec<f64> {
    let band = response
        .points
        .iter()
        .filter(|point| (BAND_HZ.0..=BAND_HZ.1).contains(&point.freq_hz));
    band.map(|point| 20.0 * libm::log10(point.gain_m_s2_n / REFERENCE_M_S2_N))
        .collect()
}

fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |largest, value| {
        if value.abs() > largest {
            value.abs()
        } else {
            largest
        }
    })
}

#[test]
fn one_texture_has_the_same_spectrum_on_devices_that_differ_by_24_db() {
    let bytes = lowered(&quiet());
    // What the texture wants, as a force on the reference. The excitation has the same seed below.
    let wanted = force_n(&stroke(&bytes, 60));
    let mut all = Vec::new();
    for device in devices() {
        let plain = estimate(&wanted, &accel_m_s2(&device, &wanted), RATE_HZ).expect("a response");
        let filtered = asset(&bytes, &filter_of(&device)).expect("a texture in its voice");
        let accel = accel_m_s2(&device, &force_n(&stroke(&filtered, 60)));
        let voiced = estimate(&wanted, &accel, RATE_HZ).expect("a response");
        let (before, after) = (levels_db(&plain), levels_db(&voiced));
        println!(
            "{:.3} kg: {:.1} dB off the reference, {:.2} dB with the filter, coherence {:.3}",
            device.mechanics.mass_kg[0],
            largest(before.iter().copied()),
            largest(after.iter().copied()),
            voiced.worst_coherence
        );
        assert!(largest(after.iter().copied()) < 3.0, "{after:?}");
        all.push((before, after));
    }
    for (one, other) in [(0, 1), (1, 2), (0, 2)] {
        let apart = |a: &[f64], b: &[f64]| largest(a.iter().zip(b).map(|(a, b)| a - b));
        let before = apart(&all[one].0, &all[other].0);
        let after = apart(&all[one].1, &all[other].1);
        println!(
            "devices {one} and {other}: {before:.1} dB apart, {after:.2} dB with their filters"
        );
        assert!(before > 9.0 && after < 3.0, "{before} {after}");
    }
}

/// Largest difference between a model's spectrum times the filter's and the compensated model's
/// spectrum, dB, from 40 to 400 Hz.
fn off_db(before: &TextureModel, after: &TextureModel, filter: &Compensation) -> f64 {
    use asperity::signal::spectrum::{ArmaModel, squared_magnitude};
    let taps: Vec<f64> = filter.taps.iter().map(|&tap| f64::from(tap)).collect();
    let pairs = before.grid.vertices.iter().zip(&after.grid.vertices);
    let each = pairs.flat_map(|(x, y)| {
        let [x, y] =
            [(before, x), (after, y)].map(|(texture, v)| ArmaModel::at_vertex(&texture.grid, v));
        let taps = taps.clone();
        (40..=400).step_by(5).filter_map(move |freq_hz| {
            let freq_hz = f64::from(freq_hz);
            let c = squared_magnitude(&taps, core::f64::consts::TAU * freq_hz / RATE_HZ);
            (x.level_m_s2 > 0.0)
                .then(|| 10.0 * libm::log10(y.power(freq_hz) / (x.power(freq_hz) * c)))
        })
    });
    largest(each)
}

#[test]
fn the_filter_is_in_the_models_whatever_numerator_they_have() {
    let filter = filter_of(&devices()[2]);
    let nyquist = quiet();
    assert_eq!(nyquist.grid.numerator, Numerator::Nyquist);
    let mut none = nyquist.clone();
    none.grid.numerator = Numerator::None;
    // A numerator of a model's own is what a filter leaves behind.
    let own = compensated(&nyquist, &filter_of(&devices()[0])).expect("a texture");
    assert_eq!(own.grid.numerator, Numerator::Lsf);
    for before in [none, nyquist, own] {
        let bytes = asset(&lowered(&before), &filter).expect("an asset");
        let parsed = Asset::parse(&bytes).expect("an asset");
        let after = raise::raise(&parsed);
        assert!(
            off_db(&before, &after, &filter) < 0.1,
            "{} dB",
            off_db(&before, &after, &filter)
        );
        // The poles are those of the texture, to the bit.
        let plain = lowered(&before);
        let plain = Asset::parse(&plain).expect("an asset");
        for (x, y) in before.grid.vertices.iter().zip(&after.grid.vertices) {
            assert_eq!(
                (x.speed_mm_s as f32, x.force_n as f32),
                (y.speed_mm_s as f32, y.force_n as f32)
            );
        }
        for (x, y) in plain.grid().models().zip(parsed.grid().models()) {
            assert!(x.lsf().eq(y.lsf()));
        }
        assert!(after.provenance.notes.contains("compensated"));
    }
}

#[test]
fn no_room_for_the_whole_filter_takes_a_shorter_one() {
    let filter = filter_of(&devices()[0]);
    let mut texture = quiet();
    for _ in 0..3 {
        texture = compensated(&texture, &filter).expect("a texture");
    }
    let order = texture.grid.vertices[0]
        .ma_lsf_rad
        .as_ref()
        .map_or(0, Vec::len);
    assert_eq!(order, 1 + 3 * 7);
    let more = compensated(&texture, &filter).expect("a texture");
    assert_eq!(
        more.grid.vertices[0]
            .ma_lsf_rad
            .as_ref()
            .map_or(0, Vec::len),
        24
    );
    let flat = Compensation {
        rate_hz: 1000.0,
        taps: vec![-0.5],
    };
    let louder = compensated(&quiet(), &flat).expect("a texture");
    let (x, y) = (&quiet().grid.vertices[0], &louder.grid.vertices[0]);
    assert!((y.gain * y.sigma_m_s2 - 0.5 * x.gain * x.sigma_m_s2).abs() < 1e-12);
}

#[test]
fn taps_and_scenes_take_the_filter_too() {
    let filter = Compensation {
        rate_hz: 1000.0,
        taps: vec![2.0, -0.5, 0.25],
    };
    let mut texture = quiet();
    // The filter's own rate, so that it need not be fitted again.
    texture.taps.sample_rate_hz = RATE_HZ;
    let filtered = compensated(&texture, &filter).expect("a texture");
    for (x, y) in texture.taps.traces.iter().zip(&filtered.taps.traces) {
        let (x, y) = (&x.accel_m_s2, &y.accel_m_s2);
        assert_eq!(x.len(), y.len());
        assert_eq!(
            (y[0], y[2]),
            (2.0 * x[0], 2.0 * x[2] - 0.5 * x[1] + 0.25 * x[0])
        );
    }
    let bytes = lowered(&texture);
    let named: [(&str, &[u8]); 1] = [("built in", &bytes)];
    let surfaces = [SceneSurface {
        solid: asperity_formats::Solid::Sphere {
            center_m: [0.0; 3],
            radius_m: 0.02,
        },
        from_m: [-0.1; 3],
        to_m: [0.1; 3],
        texture: 0,
    }];
    let mut out = vec![0; 1 << 20];
    let used = library::encode_scene(&named, &surfaces, &mut out).expect("a scene");
    let voiced = scene(&out[..used], &filter).expect("a scene");
    let parsed = Library::parse(&voiced).expect("a library");
    assert_eq!(parsed.scene().map(|scene| scene.surfaces().len()), Some(1));
    assert_eq!(
        parsed.bytes(0).expect("an asset"),
        asset(&bytes, &filter).expect("an asset")
    );
    assert!(asset(b"no asset", &filter).is_err() && scene(&bytes, &filter).is_err());
}
