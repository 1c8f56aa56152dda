use asperity_formats::Asset;
use asperity_runtime::{arithmetic::Scalar as _, *};
static BYTES: &[u8] = include_bytes!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../tests/tests/assets/builtin-v1.asp"
));
#[test]
fn t() {
    let config = Config::default();
    let asset = Asset::parse(BYTES).unwrap();
    let mut a = Box::new(Texture::<64, 128, 24, 24, 4096, Fixed>::new());
    a.load(&asset, 1000.0).unwrap();
    let mut b = Box::new(HostTexture::new());
    b.load(&asset, 1000.0).unwrap();
    let ra = Renderer::<Fixed>::prepare(&config).unwrap();
    let rb = Renderer::new(&config).unwrap();
    let (mut sa, mut sb) = (State::new(1), State::new(1));
    let mut worst = [0.0f32; 7];
    for n in 0..3000 {
        let x = 0.12e-3 * n as f32;
        let z = if n % 500 < 60 {
            2e-3
        } else {
            -2.4e-3 + 1e-3 * (n as f32 * 0.02).sin()
        };
        let s = Sample::at([0.8 * x, -0.6 * x, z]);
        let oa = ra.tick(&a, &mut sa, &Sample::of(&s));
        let ob = rb.tick(&b, &mut sb, &s);
        for i in 0..3 {
            worst[i] = worst[i].max((oa.force_n[i].value() - ob.force_n[i]).abs());
        }
        let d = |x: f32, y: f32| (x - y).abs();
        worst[3] = worst[3].max(d(oa.vib_m_s2.value(), ob.vib_m_s2));
        worst[4] = worst[4].max(d(oa.tap_n.value(), ob.tap_n));
        worst[5] = worst[5].max(d(oa.friction_n.value(), ob.friction_n));
        worst[6] = worst[6].max(d(oa.speed_mm_s.value(), ob.speed_mm_s));
        if n % 97 == 0 {
            println!(
                "{n} {:?} {:?} y {} {} tap {} {} fr {} {} v {} {} {:?} {:?}",
                oa.force_n.map(|x| x.value()),
                ob.force_n,
                oa.vib_m_s2,
                ob.vib_m_s2,
                oa.tap_n,
                ob.tap_n,
                oa.friction_n,
                ob.friction_n,
                oa.speed_mm_s,
                ob.speed_mm_s,
                oa.flags,
                ob.flags
            );
        }
    }
    println!("{worst:?}");
    for k in 0..8 {
        let mut config = Config::default();
        config.limits.peak_n = [3.3, 100.0][k % 2];
        config.limits.slew_n_s = [0.1, 1e5][k / 2 % 2];
        config.surface = [
            Surface::Sphere {
                center_m: [0.0, 0.0, -0.01],
                radius_m: 0.01,
            },
            Surface::Box {
                center_m: [0.0; 3],
                half_extents_m: [0.004, 0.005, 0.006],
            },
            Surface::Plane {
                point_m: [0.001, 0.002, -0.003],
                normal: [1e-3, 2e-3, -1e-4],
            },
            Config::default().surface,
        ][k / 2];
        config.vibration_axis = [VibrationAxis::Tangent, VibrationAxis::Binormal][k % 2];
        let ra = Renderer::<Fixed>::prepare(&config).unwrap();
        let mut sa = State::new(1);
        let mut r = 12345u64;
        for n in 0..20000 {
            let mut p = || {
                r = r
                    .wrapping_mul(6364136223846793005)
                    .wrapping_add(1442695040888963407);
                ((r >> 33) as f32 / (1u64 << 31) as f32) * 2.0 - 1.0
            };
            let s = Sample::at([p(), p(), p()]);
            let _ = n;
            ra.tick(&a, &mut sa, &Sample::of(&s));
        }
    }
}
