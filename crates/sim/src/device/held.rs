//! Pins that are held at a level, whatever the machine does.

/// Their levels, by pin. There is no memory for them while none is held.
#[derive(Clone, Debug, Default)]
pub(super) struct Held(Vec<Option<i32>>);

impl Held {
    /// The level of a pin that is held.
    pub fn level(&self, pin: usize) -> Option<i32> {
        self.0.get(pin).copied().flatten()
    }

    /// Holds a pin, or lets it go.
    pub fn set(&mut self, pin: usize, level: Option<i32>) {
        if level.is_some() && self.0.len() <= pin {
            self.0.resize(pin + 1, None);
        }
        if let Some(held) = self.0.get_mut(pin) {
            *held = level;
        }
    }
}

impl PartialEq for Held {
    fn eq(&self, other: &Self) -> bool {
        let pins = self.0.len().max(other.0.len());
        (0..pins).all(|pin| self.level(pin) == other.level(pin))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_holds_nothing_is_as_before() {
        let mut held = Held::default();
        held.set(7, None);
        assert_eq!((held.0.capacity(), held.level(7)), (0, None));
        held.set(7, Some(0));
        assert_eq!((held.level(6), held.level(7), held.level(8)), (None, Some(0), None));
        assert_ne!(held, Held::default());
        held.set(7, None);
        assert_eq!(held, Held::default());
    }
}
