//! A delay of whole ticks.

/// A ring buffer that returns each value `ticks` calls after it was put in.
#[derive(Debug, Clone)]
pub struct Delay<T> {
    ring: Vec<T>,
    next: usize,
}

impl<T: Copy> Delay<T> {
    /// A delay of `ticks` that is full of `initial`. Nothing else here allocates.
    #[must_use]
    pub fn new(ticks: usize, initial: T) -> Self {
        Self {
            ring: vec![initial; ticks],
            next: 0,
        }
    }

    /// Puts a value in and takes the oldest one out.
    pub fn push(&mut self, value: T) -> T {
        let Some(slot) = self.ring.get_mut(self.next) else {
            return value;
        };
        let due = std::mem::replace(slot, value);
        self.next = (self.next + 1) % self.ring.len();
        due
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_goes_in_comes_out_exactly_so_many_ticks_later() {
        for ticks in [0, 1, 2, 7, 100] {
            let mut delay = Delay::new(ticks, -1_i64);
            for n in 0..1000_i64 {
                let expected = if n < ticks as i64 {
                    -1
                } else {
                    n - ticks as i64
                };
                assert_eq!(delay.push(n), expected);
            }
        }
    }
}
