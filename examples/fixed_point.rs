//! A tick in two arithmetics: the same asset in floats and in fixed point.
//!
//! Every stage of the tick is written once over `RenderArithmetic`. A processor without an FPU takes
//! `Fixed`: numbers of 32 bits that carry their binary point in their type. The asset, the seed
//! and the noise are the same, so the forces are, too, but for rounding.

use asperity::{emit::lower::lower, sources::builtin};
use asperity_formats::Asset;
use asperity_runtime::{
    Config, Fixed, Float, HostCapacities, RenderArithmetic, Renderer, Sample, State, Texture,
    arithmetic::Scalar as _,
};
use std::error::Error;

/// A slot with room for every texture of the format; firmware chooses smaller capacities.
type Slot<A> = Texture<HostCapacities, A>;

/// Largest difference along an axis. Floats are within 0.3 mN of a tick in f64
/// (`runtime/tests/oracle_tick.rs`), and fixed point within 0.2 mN where no slew limit holds the
/// force back (`docs/fixed-point.md`).
const BOUND_N: f32 = 0.5e-3;

fn main() -> Result<(), Box<dyn Error>> {
    let bytes = lower(&builtin::texture(), None)?.bytes;
    let samples = stroke();
    let float = forces_n::<Float>(&bytes, &samples)?;
    let fixed = forces_n::<Fixed>(&bytes, &samples)?;

    println!("{:>5} {:>10} {:>10} {:>9}", "ms", "float", "fixed", "apart");
    println!("{:>5} {:>10} {:>10} {:>9}", "", "N", "N", "mN");
    let (mut worst_n, mut largest_n) = (0.0_f32, 0.0_f32);
    for (n, (a, b)) in float.iter().zip(&fixed).enumerate() {
        let apart_n = (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f32::max);
        worst_n = worst_n.max(apart_n);
        largest_n = largest_n.max(length(a));
        if n % 100 == 99 {
            println!(
                "{:>5} {:>10.6} {:>10.6} {:>9.4}",
                n + 1,
                length(a),
                length(b),
                1e3 * apart_n
            );
        }
    }
    println!(
        "\n{} ticks, forces up to {largest_n:.2} N, at most {:.4} mN apart (bound {:.1} mN)",
        float.len(),
        1e3 * worst_n,
        1e3 * BOUND_N
    );
    // Two silent ticks would agree as well.
    assert!(largest_n > 0.5, "nothing was felt: {largest_n} N");
    assert!(worst_n <= BOUND_N, "{worst_n} N apart");
    Ok(())
}

/// The force of every tick in an arithmetic, as floats, N.
fn forces_n<A: RenderArithmetic>(
    bytes: &[u8],
    samples: &[Sample],
) -> Result<Vec<[f32; 3]>, Box<dyn Error>> {
    let config = Config::default();
    // `prepare` is `new` in any arithmetic: it also refuses what lies out of its range.
    let renderer = Renderer::<A>::prepare(&config)?;
    let mut texture = Box::new(Slot::<A>::new());
    texture.load(&Asset::parse(bytes)?, config.servo_rate_hz)?;
    let mut state = State::<A>::new(1);
    let tick = |sample| {
        // `Sample::of` rounds a position in floats. Encoders give the fixed one directly, and
        // converters take the force as it is.
        let output = renderer.tick(&texture, &mut state, &Sample::<A>::of(sample));
        output.force_n.map(|force_n| force_n.value())
    };
    Ok(samples.iter().map(tick).collect())
}

/// A tap at 40 mm/s, then 0.9 s along x at up to 180 mm/s, 1.5 mm deep.
fn stroke() -> Vec<Sample> {
    let down = (0..100).map(|n| [0.0, 0.0, 2.5e-3 - 4.0e-5 * n as f32]);
    let along = (0..900).map(|n| [1.0e-7 * (n * n) as f32, 0.0, -1.5e-3]);
    down.chain(along).map(Sample::at).collect()
}

fn length([x, y, z]: &[f32; 3]) -> f32 {
    (x * x + y * y + z * z).sqrt()
}
