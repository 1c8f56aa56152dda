//! Every design of the experiments, one after the other: n ticks, then 2n. Prints the bits of the
//! last sample of each.
#![no_std]
#![no_main]

use asperity_firmware::{mark_begin, mark_end, print};
use asperity_kernels::{
    design::variants,
    workload::{Orders, TICKS, Workload, kernel_of},
};
use core::mem::MaybeUninit;
use cortex_m_semihosting::debug;
use embedded_alloc::LlffHeap;

#[global_allocator]
static HEAP: LlffHeap = LlffHeap::empty();
const HEAP_BYTES: usize = 2 << 20;

/// Returns the texture's orders, from the command that builds this.
fn orders() -> Option<Orders> {
    Some(Orders {
        poles: env!("ASPERITY_POLES", "set by `cortex-m designs`")
            .parse()
            .ok()?,
        zeros: env!("ASPERITY_ZEROS", "set by `cortex-m designs`")
            .parse()
            .ok()?,
        nyquist: false,
    })
}

fn run(orders: Orders) {
    let workload = Workload::default();
    for variant in variants() {
        let kernel = orders
            .reduced(variant.design.order)
            .and_then(|orders| kernel_of(&variant.design, orders));
        let Some(mut kernel) = kernel else { continue };
        let mut last = 0.0;
        for ticks in [TICKS, 2 * TICKS] {
            mark_begin();
            last = workload.run(kernel.as_mut(), ticks);
            mark_end();
        }
        print::line("last", last.to_bits());
    }
}

#[cortex_m_rt::entry]
fn main() -> ! {
    static mut MEMORY: [MaybeUninit<u8>; HEAP_BYTES] = [MaybeUninit::uninit(); HEAP_BYTES];
    #[allow(unsafe_code, reason = "an allocator is given its memory once")]
    // SAFETY: called once, before anything allocates, with memory that nothing else uses.
    unsafe {
        HEAP.init(MEMORY.as_mut_ptr() as usize, HEAP_BYTES);
    }
    match orders() {
        Some(orders) => {
            run(orders);
            debug::exit(debug::EXIT_SUCCESS);
        }
        None => debug::exit(debug::EXIT_FAILURE),
    }
    loop {
        cortex_m::asm::wfi();
    }
}
