//! Lines over semihosting, without the weight of formatting.

use cortex_m_semihosting::hio;

/// Writes `name` and `value` in hexadecimal. What cannot be written is lost; the host
/// then misses the line.
pub fn line(name: &str, value: u64) {
    let mut text = [b' '; 40];
    let digits = (0..16)
        .rev()
        .map(|place| b"0123456789abcdef"[(value >> (4 * place)) as usize % 16]);
    let bytes = name.bytes().chain([b' ']).chain(digits).chain([b'\n']);
    let mut len = 0;
    for (slot, byte) in text.iter_mut().zip(bytes) {
        *slot = byte;
        len += 1;
    }
    if let Ok(mut out) = hio::hstdout() {
        let _ = out.write_all(text.get(..len).unwrap_or_default());
    }
}
