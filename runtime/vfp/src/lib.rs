//! Square roots by an ARM FPU. Rust without its standard library has no name for the
//! instruction, and the runtime has no unsafe code; hence a crate of one function, empty on every
//! other processor.
#![no_std]
#![cfg(all(target_arch = "arm", target_abi = "eabihf"))]

/// √x, correctly rounded as IEEE 754 asks, so that it has the bits of every other processor; NaN
/// below zero.
#[inline(always)]
#[must_use]
#[expect(unsafe_code, reason = "an instruction without a name in `core`")]
pub fn sqrt(x: f32) -> f32 {
    let mut bits = x.to_bits();
    // Where an FPU has no doubles, assembly cannot ask the compiler for a register of a float: it
    // borrows one.
    //
    // SAFETY: every FPU of this ABI has the instructions. They touch two core registers, which
    // the compiler gives, and s0, which is put back.
    unsafe {
        core::arch::asm!(
            "vmov {kept}, s0",
            "vmov s0, {bits}",
            "vsqrt.f32 s0, s0",
            "vmov {bits}, s0",
            "vmov s0, {kept}",
            bits = inout(reg) bits,
            kept = out(reg) _,
            options(pure, nomem, nostack, preserves_flags),
        );
    }
    f32::from_bits(bits)
}
