//! Room for what is needed now and then: on a chip it is set aside, on a host it is taken when it is needed.

#[cfg(feature = "std")]
type Place<T> = Option<alloc::boxed::Box<T>>;
#[cfg(not(feature = "std"))]
type Place<T> = Option<T>;

/// Room for one thing.
#[derive(Clone, Debug)]
pub(crate) struct Room<T>(Place<T>);

impl<T> Room<T> {
    /// Nothing is there.
    pub const EMPTY: Self = Self(None);

    #[inline(always)]
    pub fn get(&self) -> Option<&T> {
        #[cfg(feature = "std")]
        return self.0.as_deref();
        #[cfg(not(feature = "std"))]
        return self.0.as_ref();
    }

    #[inline(always)]
    pub fn get_mut(&mut self) -> Option<&mut T> {
        #[cfg(feature = "std")]
        return self.0.as_deref_mut();
        #[cfg(not(feature = "std"))]
        return self.0.as_mut();
    }

    /// Puts this there, and nothing if it is nothing.
    pub fn set(&mut self, thing: Option<T>) {
        #[cfg(feature = "std")]
        let thing = thing.map(alloc::boxed::Box::new);
        self.0 = thing;
    }

    pub fn clear(&mut self) {
        self.0 = None;
    }
}
