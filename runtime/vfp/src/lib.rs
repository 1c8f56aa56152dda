//! Square roots by an ARM FPU. Rust without its standard library has no name for the
//! instruction, and the runtime has no unsafe code; hence a crate of one function, empty on every
//! other processor.
#![no_std]
#![cfg(all(target_arch = "arm", target_abi = "eabihf"))]

/// √a and √b, correctly rounded as IEEE 754 asks, so that they have the bits of every other
/// processor; NaN below zero.
#[inline(always)]
#[must_use]
#[expect(unsafe_code, reason = "an instruction without a name in `core`")]
pub fn sqrt_pair([a, b]: [f32; 2]) -> [f32; 2] {
    let (mut a, mut b) = (a.to_bits(), b.to_bits());
    // Where an FPU has no doubles, assembly cannot ask the compiler for registers of floats: it
    // borrows two.
    //
    // SAFETY: every FPU of this ABI has the instructions. They touch four core registers, which
    // the compiler gives, and s0 and s1, which are put back.
    unsafe {
        core::arch::asm!(
            "vmov {kept_a}, {kept_b}, s0, s1",
            "vmov s0, s1, {a}, {b}",
            "vsqrt.f32 s0, s0",
            "vsqrt.f32 s1, s1",
            "vmov {a}, {b}, s0, s1",
            "vmov s0, s1, {kept_a}, {kept_b}",
            a = inout(reg) a,
            b = inout(reg) b,
            kept_a = out(reg) _,
            kept_b = out(reg) _,
            options(pure, nomem, nostack, preserves_flags),
        );
    }
    [f32::from_bits(a), f32::from_bits(b)]
}
