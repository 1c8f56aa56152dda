//! Colours in linear light, 0..=1 a channel, and their sRGB bytes.

use std::sync::LazyLock;

/// Red, green and blue in linear light.
pub(crate) type Rgb = [f32; 3];

/// The colour of `#rrggbb`.
pub(crate) fn parse(text: &str) -> Option<Rgb> {
    let digits = text.strip_prefix('#').filter(|d| d.len() == 6)?;
    let number = u32::from_str_radix(digits, 16).ok()?;
    Some([16, 8, 0].map(|shift| decoded((number >> shift) as u8)))
}

/// The linear light of an sRGB byte (IEC 61966-2-1).
fn decoded(byte: u8) -> f32 {
    let c = f32::from(byte) / 255.0;
    if c <= 0.04045 {
        c / 12.92
    } else {
        libm::powf((c + 0.055) / 1.055, 2.4)
    }
}

/// Steps of the table from light to bytes.
const STEPS: usize = 4096;

/// The sRGB byte of light, in steps of 1/4096.
static ENCODED: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let byte = |step: usize| {
        let c = (step as f32 + 0.5) / STEPS as f32;
        let s = if c <= 0.003_130_8 {
            12.92 * c
        } else {
            1.055 * libm::powf(c, 1.0 / 2.4) - 0.055
        };
        (255.0 * s + 0.5) as u8
    };
    (0..STEPS).map(byte).collect()
});

/// The sRGB bytes of a colour; light above 1 is white.
pub(crate) fn encoded(color: Rgb) -> [u8; 3] {
    let table = &*ENCODED;
    color.map(|c| table[((c * STEPS as f32).max(0.0) as usize).min(STEPS - 1)])
}

/// A colour between two.
pub(crate) fn mix(a: Rgb, b: Rgb, t: f32) -> Rgb {
    let t = t.clamp(0.0, 1.0);
    [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * t)
}

/// A colour times a brightness.
pub(crate) fn lit(color: Rgb, light: f32) -> Rgb {
    color.map(|c| (c * light).max(0.0))
}

/// Luminance of a colour (ITU-R BT.709).
pub(crate) fn luminance(color: Rgb) -> f32 {
    0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_colour_comes_back_within_a_step_of_the_table() {
        for hex in ["#000000", "#ffffff", "#9a6a3c", "#123456", "#808080"] {
            let back = encoded(parse(hex).unwrap());
            for (byte, text) in back.iter().zip([&hex[1..3], &hex[3..5], &hex[5..7]]) {
                let wanted = i32::from_str_radix(text, 16).unwrap();
                assert!((i32::from(*byte) - wanted).abs() <= 1, "{hex} {back:?}");
            }
        }
        assert!(parse("9a6a3c").is_none() && parse("#9a6a3").is_none());
    }
}
