//! Cost per tick of every design of the experiments, for the chart of speed against accuracy.

use crate::{emulate, package::Result, target::Target, toolchain::Toolchain};
use asperity_kernels::{
    design::{Variant, variants},
    workload::{Orders, TICKS, Workload, kernel_of},
};

/// Runs every design that the orders of a texture suffice for, checks that the target's last
/// samples are the host's, and prints `factor,name,instructions`.
pub(crate) fn print(target: &Target, toolchain: &Toolchain, orders: Orders) -> Result<()> {
    let variables = [
        ("ASPERITY_POLES", orders.poles),
        ("ASPERITY_ZEROS", orders.zeros),
    ];
    let firmware = toolchain.firmware_with("designs", &["designs"], &variables)?;
    let expected = on_host(orders);
    let run = emulate::run(target, &firmware, 2 * expected.len())?;
    let printed = run.lines.iter().map(|(_, bits)| *bits);
    if let Some(((variant, host), found)) = expected.iter().zip(printed).find(|((_, a), b)| a != b)
    {
        let name = &variant.name;
        return Err(
            format!("{name}: the target renders {found:016x}, the host {host:016x}").into(),
        );
    }
    println!("factor,name,instructions");
    for ((variant, _), counts) in expected.iter().zip(run.instructions.chunks(2)) {
        // The counts of n and of 2n ticks: everything but the ticks cancels.
        let a_tick = counts[1].saturating_sub(counts[0]) as f64 / TICKS as f64;
        println!("{},\"{}\",{a_tick:.1}", variant.factor.name(), variant.name);
    }
    Ok(())
}

/// Every design that runs, and the bits of its last sample.
fn on_host(orders: Orders) -> Vec<(Variant, u64)> {
    let workload = Workload::default();
    let mut all = Vec::new();
    for variant in variants() {
        let kernel = orders
            .reduced(variant.design.order)
            .and_then(|orders| kernel_of(&variant.design, orders));
        match kernel {
            Some(mut kernel) => {
                let last = workload.run(kernel.as_mut(), 2 * TICKS);
                all.push((variant, last.to_bits()));
            }
            None => eprintln!(
                "{}: not counted, these orders alone do not make its kernel",
                variant.name
            ),
        }
    }
    all
}
