//! The cost model of `asperity build`, fitted to the costliest ticks of scenes.

use crate::{
    Result, emulate,
    target::Target,
    toolchain::{Toolchain, host_program},
};
use asperity_session::{PHASE_TICKS, Phase, SCENE_CASES, SceneCase, TOUCHED};

/// Executed instructions of a tick: a sum over what the texture and the scene have.
#[derive(Debug, Clone, Copy)]
struct Cost {
    base: f64,
    pole: f64,
    zero: f64,
    triangle: f64,
    /// Of a plane, a sphere and a box.
    surfaces: [f64; 3],
}

/// Counts on the target and on the host, and prints the table of
/// `compiler/src/scene/cost.rs`.
pub(crate) fn print(target: &Target, toolchain: &Toolchain) -> Result<()> {
    let firmware = toolchain.firmware("costs", &[])?;
    let expected = SCENE_CASES.len() * Phase::ALL.len() * PHASE_TICKS as usize;
    let on_target = emulate::run(target, &firmware, expected)?.instructions;
    let on_host = emulate::run_on_host(&host_program("host-costs")?, expected)?;
    for (processor, counts) in [("cortex-m4f", on_target), ("x86-64", on_host)] {
        fitted(processor, &counts);
    }
    Ok(())
}

fn fitted(processor: &str, counts: &[u64]) {
    let ticks = counts.len() / SCENE_CASES.len();
    let worst: Vec<f64> = counts
        .chunks(ticks)
        .map(|of| of.iter().copied().max().unwrap_or(0) as f64)
        .collect();
    let cost = Cost::fit(&worst);
    println!("// {processor}: costliest tick of {ticks}, and what the model says of it");
    let mut most: f64 = 0.0;
    for (case, measured) in SCENE_CASES.iter().zip(&worst) {
        let model = cost.of(case);
        let above = 100.0 * (model / measured - 1.0);
        most = most.max(above);
        println!(
            "// {:>2} poles, {:>2} zeros, {:>2} triangles, {:?} apart: {measured:>5}, {model:>6.0} (+{above:.1} %)",
            case.poles, case.zeros, case.triangles, case.apart
        );
    }
    let [plane, sphere, cuboid] = cost.surfaces;
    println!(
        "Cost {{\n    processor: {processor:?},\n    base: {:.0}.0,\n    pole: {:.1},\n    zero: {:.1},\n    \
         triangle: {:.1},\n    plane: {plane:.1},\n    sphere: {sphere:.1},\n    cuboid: {cuboid:.1},\n    \
         above_percent: {most:.0}.0,\n}},",
        cost.base.ceil(),
        cost.pole,
        cost.zero,
        cost.triangle
    );
}

impl Cost {
    /// Slopes between the ends of what was counted; the base such that no case costs more
    /// than the model says.
    fn fit(worst: &[f64]) -> Self {
        let at = |poles, zeros, triangles, apart| {
            let wanted = |case: &SceneCase| {
                (case.poles, case.zeros, case.triangles, case.apart)
                    == (poles, zeros, triangles, apart)
            };
            let index = SCENE_CASES.iter().position(wanted);
            index.map_or(f64::NAN, |index| worst[index])
        };
        let alone = |poles, zeros| at(poles, zeros, 56, [0; 3]);
        let middle = alone(10, 0);
        let one = |apart| (at(10, 0, 56, apart) - middle) / 8.0;
        let mut cost = Self {
            base: 0.0,
            pole: tenths((alone(20, 0) - alone(4, 0)) / 16.0),
            zero: tenths((alone(20, 18) - alone(20, 0)) / 18.0),
            triangle: tenths((at(10, 0, 98, [0; 3]) - at(10, 0, 12, [0; 3])) / 86.0),
            surfaces: [one([8, 0, 0]), one([0, 8, 0]), one([0, 0, 8])].map(tenths),
        };
        let missing = SCENE_CASES.iter().zip(worst).map(|(c, w)| w - cost.of(c));
        cost.base = missing.fold(f64::MIN, f64::max).ceil();
        cost
    }

    fn of(&self, case: &SceneCase) -> f64 {
        // What is touched are planes.
        let touched = TOUCHED as f64 * self.surfaces[0];
        let apart = self.surfaces.iter().zip(case.apart);
        self.base
            + self.pole * f64::from(case.poles)
            + self.zero * f64::from(case.zeros)
            + self.triangle * f64::from(case.triangles)
            + touched
            + apart.map(|(cost, n)| cost * f64::from(n)).sum::<f64>()
    }
}

/// As printed.
fn tenths(x: f64) -> f64 {
    (10.0 * x.max(0.0)).ceil() / 10.0
}
