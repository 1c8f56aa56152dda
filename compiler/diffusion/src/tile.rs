//! Pictures that repeat: padding lies inside the networks, so their borders are moved about.
//!
//! The UNet pads a latent with zeros at its border. Each step rolls the latent by another random
//! distance, so that no place is at the border for long. The decoder pads as well: it decodes the
//! latent rolled by half its size in neither, one and both directions, and of each the middle is
//! taken.

/// A plane of `size` × `size` moved to the right and down, around its borders; one after the other
/// if there are several.
pub(crate) fn rolled<T: Copy>(planes: &[T], size: usize, down: usize, right: usize) -> Vec<T> {
    let mut moved = Vec::with_capacity(planes.len());
    for plane in planes.chunks_exact(size * size) {
        for y in 0..size {
            let row = &plane[(y + size - down % size) % size * size..][..size];
            let cut = (size - right % size) % size;
            moved.extend_from_slice(&row[cut..]);
            moved.extend_from_slice(&row[..cut]);
        }
    }
    moved
}

/// The four ways in which a latent is decoded: whether it is rolled down, and to the right.
pub(crate) const ROLLS: [(bool, bool); 4] =
    [(false, false), (false, true), (true, false), (true, true)];

/// Weight of a pixel in the decoded picture, rolled by half or not. The two weights add up to 1. The weight is 0 up to
/// an eighth of the size from the border of the decoded picture.
pub(crate) fn weight(pixel: usize, size: usize, is_rolled: bool) -> f32 {
    let place = (pixel as f32 + 0.5) / size as f32;
    let distance = place.min(1.0 - place);
    let plain = ((distance - 0.125) * 4.0).clamp(0.0, 1.0);
    if is_rolled { 1.0 - plain } else { plain }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rolling_back_undoes_rolling() {
        let planes: Vec<usize> = (0..50).collect();
        let moved = rolled(&planes, 5, 1, 3);
        // The first row is the last one, moved to the right by three.
        assert_eq!(moved[..5], [22, 23, 24, 20, 21]);
        assert_eq!(rolled(&moved, 5, 4, 2), planes);
        assert_eq!(rolled(&planes, 5, 0, 0), planes);
        assert_eq!(rolled(&planes, 5, 5, 10), planes);
    }

    /// Claim: each pixel counts once, and none that lies near a border of what was decoded.
    #[test]
    fn weights_add_up_to_one_and_leave_borders_out() {
        let size = 64;
        for pixel in 0..size {
            assert_eq!(weight(pixel, size, false) + weight(pixel, size, true), 1.0);
            let in_rolled = (pixel + size / 2) % size;
            for (place, is_rolled) in [(pixel, false), (in_rolled, true)] {
                if !(size / 8..size - size / 8).contains(&place) {
                    assert_eq!(weight(pixel, size, is_rolled), 0.0, "{pixel}");
                }
            }
        }
    }
}
