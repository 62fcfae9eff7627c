//! Where on an axis a switch or mark is on, and how far away that changes.

/// Odometers at which a switch or mark is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Zone {
    /// The lowest.
    pub first: i32,
    /// The highest.
    pub last: i32,
    /// After how many pulses it comes again; 0: never.
    pub every: u32,
}

impl Zone {
    /// Whether it is on at `odometer`, and the nearest odometers below and above where it is not as here.
    pub fn look(&self, odometer: i32) -> (bool, i64, i64) {
        let (first, width) = (i64::from(self.first), i64::from(self.last) - i64::from(self.first) + 1);
        let (odometer, every) = (i64::from(odometer), i64::from(self.every));
        if every == 0 {
            let last = i64::from(self.last);
            return match odometer {
                _ if odometer < first => (false, i64::MIN, first),
                _ if odometer <= last => (true, first - 1, last + 1),
                _ => (false, last, i64::MAX),
            };
        }
        let into = (odometer - first).rem_euclid(every);
        let start = odometer - into;
        if into < width {
            (true, start - 1, start + width)
        } else {
            (false, start + width - 1, start + every)
        }
    }
}
