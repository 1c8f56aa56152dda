//! Just enough of Thumb to see where control can go.

/// Control flow of an instruction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Flow {
    /// On to the next, or back to the caller.
    Plain,
    /// To an address (a branch or a call).
    To(u32),
    /// To an address in a register or in memory.
    Unknown,
    /// A permanently undefined instruction.
    Trap,
}

/// The instruction of `halfwords` at `address`, and its length in bytes.
pub(crate) fn decode(address: u32, first: u16, second: u16) -> (Flow, u32) {
    if first >> 11 >= 0b11101 {
        (wide(address, first, second), 4)
    } else {
        (narrow(address, first), 2)
    }
}

fn narrow(address: u32, h: u16) -> Flow {
    let bits = u32::from(h);
    let register = h >> 3 & 15;
    match h {
        _ if h & 0xff00 == 0xde00 => Flow::Trap,
        _ if h & 0xff00 == 0xdf00 => Flow::Plain,
        _ if h & 0xf000 == 0xd000 => branch(address, bits & 0xff, 8),
        _ if h & 0xf800 == 0xe000 => branch(address, bits & 0x7ff, 11),
        // cbz, cbnz: forwards only.
        _ if h & 0xf500 == 0xb100 => {
            Flow::To(address + 4 + (bits >> 3 & 0x40) + (bits >> 2 & 0x3e))
        }
        // bx lr returns; blx and bx of others go anywhere.
        _ if h & 0xff00 == 0x4700 && h & 0x80 == 0 && register == 14 => Flow::Plain,
        _ if h & 0xff00 == 0x4700 => Flow::Unknown,
        // mov pc and add pc.
        _ if h & 0xff87 == 0x4687 || h & 0xff87 == 0x4487 => Flow::Unknown,
        _ => Flow::Plain,
    }
}

fn wide(address: u32, first: u16, second: u16) -> Flow {
    let (a, b) = (u32::from(first), u32::from(second));
    if first & 0xfff0 == 0xf7f0 && second & 0xf000 == 0xa000 {
        return Flow::Trap;
    }
    if first & 0xf800 == 0xf000 && second & 0x8000 != 0 {
        let (sign, j1, j2) = (a >> 10 & 1, b >> 13 & 1, b >> 11 & 1);
        // bl and b.w.
        if second & 0x1000 != 0 {
            let (i1, i2) = (1 ^ j1 ^ sign, 1 ^ j2 ^ sign);
            let offset = sign << 23 | i1 << 22 | i2 << 21 | (a & 0x3ff) << 11 | b & 0x7ff;
            return branch(address, offset, 24);
        }
        // A condition, or else a barrier or a special register.
        if a >> 6 & 15 < 14 {
            let offset = sign << 19 | j2 << 18 | j1 << 17 | (a & 0x3f) << 11 | b & 0x7ff;
            return branch(address, offset, 20);
        }
        return Flow::Plain;
    }
    // ldr pc; from the stack it is a return.
    let loads_pc = first & 0xff70 == 0xf850 && second >> 12 == 15;
    if loads_pc && (first, second) != (0xf85d, 0xfb04) {
        return Flow::Unknown;
    }
    Flow::Plain
}

/// A branch by `offset` halfwords, a signed number of `bits` bits.
fn branch(address: u32, offset: u32, bits: u32) -> Flow {
    let shift = 32 - bits;
    let signed = ((offset << shift) as i32 >> shift) * 2;
    Flow::To(address.wrapping_add(4).wrapping_add_signed(signed))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Encodings as the architecture manual gives them.
    #[test]
    fn branches_go_where_the_manual_says() {
        let at = 0x1000;
        for (first, second, flow) in [
            (0xf000, 0xf800, Flow::To(0x1004)), // bl to the next
            (0xf7ff, 0xfffe, Flow::To(0x1000)), // bl to itself
            (0xf000, 0xb802, Flow::To(0x1008)), // b.w
            (0xf43f, 0xaffe, Flow::To(0x1000)), // beq.w to itself
            (0xe7fe, 0, Flow::To(0x1000)),      // b to itself
            (0xd0fe, 0, Flow::To(0x1000)),      // beq to itself
            (0xb108, 0, Flow::To(0x1006)),      // cbz r0
            (0x4770, 0, Flow::Plain),           // bx lr
            (0xbd10, 0, Flow::Plain),           // pop {r4, pc}
            (0xf85d, 0xfb04, Flow::Plain),      // ldr pc, [sp], #4
            (0x4780, 0, Flow::Unknown),         // blx r0
            (0x4718, 0, Flow::Unknown),         // bx r3
            (0xf8d0, 0xf000, Flow::Unknown),    // ldr pc, [r0]
            (0xf3bf, 0x8f5f, Flow::Plain),      // dmb
            (0xde00, 0, Flow::Trap),            // udf
        ] {
            assert_eq!(
                decode(at, first, second).0,
                flow,
                "{first:04x} {second:04x}"
            );
        }
    }
}
