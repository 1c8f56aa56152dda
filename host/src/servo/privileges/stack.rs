//! The stack, touched before the loop so that no tick waits for a page.

use std::hint::black_box;

/// Bytes that are touched: half of the thread's stack.
const TOUCHED: usize = 512 * 1024;

/// Writes to every page of the stack that the loop may use.
#[inline(never)]
pub(super) fn touch() {
    let mut pages = [0_u8; TOUCHED];
    for page in pages.chunks_mut(4096) {
        page[0] = black_box(1);
    }
    black_box(&mut pages);
}
