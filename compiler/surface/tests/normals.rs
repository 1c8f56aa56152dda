//! Heights, their normals and both, of a surface whose waves are known.

use asperity_surface::{
    contact::{Contact, Tip},
    map::{Convention, Pictures, Raster, Size},
    stroke::Strokes,
    stylus::Support,
    wave_spectrum::WaveSpectrum,
};

/// Points along a side of a surface of which heights and normals are known, and its waves: periods in x and in y, µm.
const FINE: u32 = 256;
const WAVES: [(f64, f64, f64); 4] = [
    (4.0, 1.0, 40.0),
    (11.0, -7.0, 10.0),
    (23.0, 9.0, 3.5),
    (31.0, -20.0, 1.5),
];
const PITCH_MM: f64 = 0.1;

/// Height, µm, and slopes in x and down the rows.
fn known(x: u32, y: u32) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (in_x, in_y, height) in WAVES {
        let turn = std::f64::consts::TAU / f64::from(FINE);
        let (sin, cos) = (turn * (in_x * f64::from(x) + in_y * f64::from(y))).sin_cos();
        let slope = 1e-3 * height * turn / PITCH_MM * cos;
        let parts = [height * sin, in_x * slope, in_y * slope];
        sum.iter_mut()
            .zip(parts)
            .for_each(|(sum, part)| *sum += part);
    }
    sum
}

fn raster(channels: usize, of: impl Fn(u32, u32) -> Vec<f64>) -> Raster {
    let pixels = (0..FINE * FINE).flat_map(|n| of(n % FINE, n / FINE));
    Raster {
        file: "map".into(),
        width: FINE as usize,
        whole: [FINE as usize; 2],
        channels,
        samples: pixels.map(|part| part as f32).collect(),
        largest: Some(65535),
        aspect: 1.0,
        is_transparent: false,
        notes: Vec::new(),
    }
}

fn normals(green_down: f64) -> Raster {
    raster(3, |x, y| {
        let [_, in_x, down] = known(x, y);
        let length = (1.0 + in_x * in_x + down * down).sqrt();
        let byte = |part: f64| (255.0 * (0.5 + 0.5 * part / length)).round() / 255.0;
        vec![byte(-in_x), byte(-green_down * down), byte(1.0)]
    })
}

/// Claim: heights, their normals in either convention, and both together vibrate within 1 dB in every direction, and the
/// convention follows from the slopes.
#[test]
fn heights_and_normals_agree() {
    let heights = raster(1, |x, y| vec![0.5 + known(x, y)[0] / 250.0]);
    let level = |pictures: &Pictures, depth_mm: Option<f64>, direction_rad: f64| {
        let size = Size {
            width_mm: Some(f64::from(FINE) * PITCH_MM),
            depth_mm,
        };
        let support = Support {
            modulus_mpa: 1000.0,
            loss_factor: 0.1,
            force_n: 1.0,
        };
        let map = pictures.heights(&size).unwrap();
        let followed = Contact::with(&map.field).followed(&Tip::STYLUS, &support);
        let line = WaveSpectrum::of(&followed).along(direction_rad);
        let power = Strokes::over(&line).power(80.0, &support);
        (10.0 * power.iter().sum::<f64>().log10(), map.notes.concat())
    };
    let height = Pictures::of(heights.clone(), None);
    for (green_down, name) in [(1.0, "dx"), (-1.0, "gl")] {
        let normal = Pictures::of(normals(green_down), None);
        let both = Pictures {
            height: Some(heights.clone()),
            ..normal.clone()
        };
        for direction_rad in [0.0, 0.8, 1.6, 2.4] {
            let (truth, _) = level(&height, Some(0.25), direction_rad);
            let (by_normals, notes) = level(&normal, None, direction_rad);
            assert!(notes.contains(&format!("--normal {name}`, for")), "{notes}");
            for (found, what) in [
                (by_normals, "normals"),
                (level(&both, Some(0.25), direction_rad).0, "both"),
                (level(&both, None, direction_rad).0, "both, without a depth"),
            ] {
                assert!(
                    (found - truth).abs() < 1.0,
                    "{what}, {name}: {found} dB, {truth} dB"
                );
            }
        }
    }
    let wrong = Pictures {
        convention: Some(Convention::Gl),
        ..Pictures::of(normals(1.0), None)
    };
    assert!(
        level(&wrong, None, 0.0)
            .1
            .contains("with dx the slopes would belong to a surface")
    );
    // A relief three times as deep as its normals say, and one turned inside out.
    let both = Pictures {
        height: Some(heights),
        ..Pictures::of(normals(1.0), None)
    };
    assert!(
        level(&both, Some(0.75), 0.0)
            .1
            .contains("0.33 times as deep as stated")
    );
    assert!(
        level(&both, Some(-0.25), 0.0)
            .1
            .contains("turned inside out")
    );
}
