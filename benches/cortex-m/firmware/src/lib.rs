//! Shared parts of the firmware programs. Each is a single call of [`firmware!`].
//!
//! Output over semihosting, a line each: `phase HASH` in order of the session, then
//! `state`, `slot`, `stack-load`, `stack-tick` in bytes, hexadecimal all of them.
#![no_std]

pub mod print;
pub mod stack;

use asperity_runtime::{LoadError, Output, RenderArithmetic, Renderer, Sample, State};
use asperity_session::{Case, Phase, SEED, Slot};
use cortex_m_semihosting::debug;

/// First instruction that does not count as the tick's; the plugin knows its name.
#[allow(unsafe_code, reason = "the plugin finds the marker by its symbol")]
#[unsafe(no_mangle)]
#[inline(never)]
pub extern "C" fn mark_begin() {
    cortex_m::asm::nop();
}

/// First instruction after the tick. Its body differs, or the two would be merged.
#[allow(unsafe_code, reason = "the plugin finds the marker by its symbol")]
#[unsafe(no_mangle)]
#[inline(never)]
pub extern "C" fn mark_end() {
    cortex_m::asm::dmb();
}

/// The processor's native arithmetic: floats where it has registers for them.
#[cfg(target_abi = "eabihf")]
pub type Native = asperity_runtime::Float;
/// The processor's native arithmetic: fixed point, where floats are software.
#[cfg(not(target_abi = "eabihf"))]
pub type Native = asperity_runtime::Fixed;

/// The tick of a slot, compiled under a name of its own.
pub type Tick<S, A> = fn(&Renderer<A>, &S, &mut State<A>, &Sample<A>) -> Output<A>;

/// Loads, runs the session, reports, and leaves the emulator.
pub fn run<S: Slot, A: RenderArithmetic>(case: &Case, slot: &mut S, tick: Tick<S, A>) -> ! {
    #[cfg(feature = "flush")]
    flush();
    stack::paint();
    let loaded = load(case, slot);
    let stack_load = stack::depth();
    let (Ok(()), Ok(renderer)) = (loaded, asperity_session::renderer()) else {
        fail("texture-refused");
    };
    let mut state = State::new(SEED);
    stack::paint();
    asperity_session::run(
        &mut state,
        |state, sample| {
            mark_begin();
            let output = tick(&renderer, slot, state, sample);
            mark_end();
            output
        },
        |phase: Phase, hash| print::line(phase.name(), hash),
    );
    let stack_tick = stack::depth();
    for (name, bytes) in [
        ("state", size_of::<State<A>>()),
        ("slot", size_of_val(slot)),
        ("stack-load", stack_load),
        ("stack-tick", stack_tick),
    ] {
        print::line(name, bytes as u64);
    }
    debug::exit(debug::EXIT_SUCCESS);
    loop {
        cortex_m::asm::wfi();
    }
}

/// Denormals are zero from here on.
#[cfg(feature = "flush")]
fn flush() {
    use cortex_m::register::fpscr;

    let mut control = fpscr::read();
    control.set_fz(true);
    #[allow(unsafe_code, reason = "the register is the program's own")]
    // SAFETY: nothing that the compiler assumes of floats is a denormal.
    unsafe {
        fpscr::write(control);
    }
    if core::hint::black_box(f32::MIN_POSITIVE) * 0.5 != 0.0 {
        fail("denormals-not-flushed");
    }
}

/// A function of its own, so that its stack and code can be told from the session's.
#[inline(never)]
fn load<S: Slot>(case: &Case, slot: &mut S) -> Result<(), LoadError> {
    slot.load(case)
}

fn fail(why: &str) -> ! {
    print::line(why, 1);
    debug::exit(debug::EXIT_FAILURE);
    loop {
        cortex_m::asm::wfi();
    }
}

// The C face brings a handler of its own.
#[cfg(not(feature = "c"))]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    fail("panic")
}

/// A firmware program: a case and the type of its slot.
#[macro_export]
macro_rules! firmware {
    ($case:expr, $slot:ident) => {
        use asperity_firmware::Native;
        use asperity_runtime::{Output, Renderer, Sample, State};

        type Slot = asperity_session::$slot<Native>;

        /// The measured tick, under a symbol of its own.
        #[allow(unsafe_code, reason = "the search for panics starts at this symbol")]
        #[unsafe(no_mangle)]
        #[inline(never)]
        fn asperity_tick(
            renderer: &Renderer<Native>,
            slot: &Slot,
            state: &mut State<Native>,
            sample: &Sample<Native>,
        ) -> Output<Native> {
            #[cfg(feature = "can-panic")]
            if sample.elapsed_ticks == 99 {
                panic!();
            }
            renderer.tick(slot, state, sample)
        }

        #[cortex_m_rt::entry]
        fn main() -> ! {
            static mut SLOT: Slot = Slot::new();
            $crate::run(&$case, SLOT, asperity_tick)
        }
    };
}
