//! The cost model of `asperity build`, fitted to the costliest ticks of scenes.

use crate::{
    emulate,
    package::Result,
    target::Target,
    toolchain::{Toolchain, host_program_like_firmware},
};
use asperity_session::{PHASE_TICKS, Phase, SCENE_CASES, SceneCase, TOUCHED};
use std::fmt::Write as _;

/// Executed instructions of a tick: a sum over what the texture and the scene have.
#[derive(Debug, Clone, Copy)]
struct Cost {
    base: f64,
    pole: f64,
    zero: f64,
    triangle: f64,
    /// Per friction law.
    law: f64,
    /// Per contact law.
    contact: f64,
    /// Per direction.
    axis: f64,
    /// For a plane, a sphere and a box.
    surfaces: [f64; 3],
}

/// Counts on the target and on the host, and prints `compiler/src/scene/counted.rs`.
pub(crate) fn print(target: &Target, toolchain: &Toolchain) -> Result<()> {
    let firmware = toolchain.firmware("costs", &[])?;
    let expected = SCENE_CASES.len() * Phase::ALL.len() * PHASE_TICKS as usize;
    let on_target = emulate::run(target, &firmware, expected)?.instructions;
    let on_host = emulate::run_on_host(&host_program_like_firmware("host-costs")?, expected)?;
    let counted = [("cortex-m4f", on_target), ("x86-64", on_host)].map(|(processor, counts)| {
        let ticks = counts.len() / SCENE_CASES.len();
        let worst = counts.chunks(ticks).map(|of| of.iter().copied().max());
        (processor, worst.map(Option::unwrap_or_default).collect())
    });
    print!("{}", table(&counted));
    Ok(())
}

/// The file, of each processor's costliest ticks.
fn table(counted: &[(&str, Vec<u64>)]) -> String {
    let mut text = String::from(HEAD);
    let _ = writeln!(
        text,
        "pub(super) static COSTS: [Cost; {}] = [",
        counted.len()
    );
    for (processor, worst) in counted {
        text.push_str(&Cost::fit(worst).entry(processor, worst));
    }
    text.push_str("];\n\n");
    text.push_str(MEASURED);
    let rows = counted.len() * SCENE_CASES.len();
    let _ = writeln!(
        text,
        "pub(super) const MEASURED: [(&str, [usize; 9], u64); {rows}] = ["
    );
    for (processor, worst) in counted {
        for (case, count) in SCENE_CASES.iter().zip(worst) {
            let SceneCase {
                poles,
                zeros,
                triangles,
                laws,
                contacts,
                axes,
                apart: [planes, spheres, boxes],
                ..
            } = case;
            let planes = planes + TOUCHED;
            let _ = writeln!(
                text,
                "    ({processor:?}, [{poles}, {zeros}, {triangles}, {laws}, {contacts}, {axes}, {planes}, {spheres}, {boxes}], {count}),"
            );
        }
    }
    text.push_str("];\n");
    text
}

const HEAD: &str = "\
//! Written by `cargo run --release -p asperity-cortex-m -- costs`.

use super::cost::Cost;

/// Slopes between the ends of what was counted; the base such that no count is above the model.
";
const MEASURED: &str = "\
/// The costliest tick of 12,000, in QEMU: poles, zeros that are mixed and converted, triangles,
/// laws of friction, contact laws, directions, planes, spheres, boxes.
#[cfg(test)]
";

impl Cost {
    /// Slopes between the ends of what was counted; the base such that no case costs more
    /// than the model says.
    fn fit(worst: &[u64]) -> Self {
        let at = |poles, zeros, triangles, [laws, contacts, axes]: [u32; 3], apart| {
            let wanted = |case: &SceneCase| {
                (
                    case.poles,
                    case.zeros,
                    case.triangles,
                    [case.laws, case.contacts, case.axes],
                    case.apart,
                ) == (poles, zeros, triangles, [laws, contacts, axes], apart)
            };
            let index = SCENE_CASES.iter().position(wanted);
            index.map_or(f64::NAN, |index| worst[index] as f64)
        };
        let alone = |poles, zeros| at(poles, zeros, 56, [0; 3], [0; 3]);
        let middle = alone(10, 0);
        let one = |apart| (at(10, 0, 56, [0; 3], apart) - middle) / 8.0;
        let mut cost = Self {
            base: 0.0,
            pole: tenths((alone(20, 0) - alone(4, 0)) / 16.0),
            zero: tenths((alone(20, 18) - alone(20, 0)) / 18.0),
            triangle: tenths(
                (at(10, 0, 98, [0; 3], [0; 3]) - at(10, 0, 12, [0; 3], [0; 3])) / 86.0,
            ),
            law: tenths(at(10, 0, 56, [1, 0, 0], [0; 3]) - middle),
            contact: tenths(at(10, 0, 56, [0, 1, 0], [0; 3]) - middle),
            axis: tenths(at(10, 0, 56, [0, 0, 1], [0; 3]) - middle),
            surfaces: [one([8, 0, 0]), one([0, 8, 0]), one([0, 0, 8])].map(tenths),
        };
        let missing = SCENE_CASES
            .iter()
            .zip(worst)
            .map(|(c, w)| *w as f64 - cost.of(c));
        cost.base = missing.fold(f64::MIN, f64::max).ceil();
        cost
    }

    /// As an entry of the table.
    fn entry(&self, processor: &str, worst: &[u64]) -> String {
        let above = SCENE_CASES.iter().zip(worst);
        let above = above.map(|(case, count)| 100.0 * (self.of(case) / *count as f64 - 1.0));
        let above = above.fold(0.0, f64::max).ceil();
        let Self {
            base,
            pole,
            zero,
            triangle,
            law,
            contact,
            axis,
            surfaces: [plane, sphere, cuboid],
        } = self;
        format!(
            "    Cost {{
        processor: {processor:?},
        base: {base:.1},
        pole: {pole:.1},
        zero: {zero:.1},
        triangle: {triangle:.1},
        law: {law:.1},
        contact: {contact:.1},
        axis: {axis:.1},
        surfaces: [{plane:.1}, {sphere:.1}, {cuboid:.1}],
        above_percent: {above:.1},
    }},\n"
        )
    }

    fn of(&self, case: &SceneCase) -> f64 {
        // What is touched are planes.
        let touched = f64::from(TOUCHED) * self.surfaces[0];
        let apart = self.surfaces.iter().zip(case.apart);
        self.base
            + self.pole * f64::from(case.poles)
            + self.zero * f64::from(case.zeros)
            + self.triangle * f64::from(case.triangles)
            + self.law * f64::from(case.laws)
            + self.contact * f64::from(case.contacts)
            + self.axis * f64::from(case.axes)
            + touched
            + apart.map(|(cost, n)| cost * f64::from(n)).sum::<f64>()
    }
}

/// As printed.
fn tenths(x: f64) -> f64 {
    (10.0 * x.max(0.0)).ceil() / 10.0
}
