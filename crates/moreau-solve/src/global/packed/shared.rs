//! Arrays that the blocks of one wave write at the same time.
//!
//! Blocks of a wave share no body and no group, but the compiler cannot know: that is what the layout is for. The twin of this file
//! is the impl for slices in `kernel.rs`, which one thread uses; tests hold the two against each other bit by bit. What
//! threads gain by it, and what the safe way of a copy of all bodies for each would cost, is in docs/performance.md.

#![allow(unsafe_code)]

use super::kernel::{Places, Seen};
use std::marker::PhantomData;
use std::ops::Range;

/// A slice of which several threads have parts.
pub(super) struct Shared<'a, T> {
    start: *mut T,
    len: usize,
    life: PhantomData<&'a mut [T]>,
}

impl<T> Clone for Shared<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Shared<'_, T> {}

// SAFETY: it hands out parts of a slice that was borrowed as a whole; who asks for one promises that no other thread has it.
unsafe impl<T: Send> Send for Shared<'_, T> {}
// SAFETY: as above; shared itself it gives nothing but what the unsafe functions give.
unsafe impl<T: Send> Sync for Shared<'_, T> {}

impl<'a, T> Shared<'a, T> {
    pub(super) fn new(slice: &'a mut [T]) -> Self {
        Self { start: slice.as_mut_ptr(), len: slice.len(), life: PhantomData }
    }

    /// One part of it.
    ///
    /// # Safety
    /// Nobody else reads or writes an element of `range` while the part lives.
    pub(super) unsafe fn part(self, range: Range<usize>) -> &'a mut [T] {
        assert!(range.start <= range.end && range.end <= self.len);
        // SAFETY: inside the slice, and the caller's alone.
        unsafe { std::slice::from_raw_parts_mut(self.start.add(range.start), range.len()) }
    }

    /// Its elements one by one, wherever they are.
    ///
    /// # Safety
    /// Nobody else reads or writes an element that is read or written through the result while it lives.
    pub(super) unsafe fn scattered(self) -> Scattered<'a, T> {
        Scattered(self)
    }
}

/// Elements of a slice that are one thread's own.
pub(super) struct Scattered<'a, T>(Shared<'a, T>);

impl<T> Seen<T> for Scattered<'_, T> {
    #[inline(always)]
    fn get(&self, i: usize) -> &T {
        assert!(i < self.0.len);
        // SAFETY: inside the slice; who made this promised that nobody else touches the element.
        unsafe { &*self.0.start.add(i) }
    }
}

impl<T> Places<T> for Scattered<'_, T> {
    #[inline(always)]
    fn set(&mut self, i: usize, value: T) {
        assert!(i < self.0.len);
        // SAFETY: as in `get`, and no reference from `get` outlives the call that it was for.
        unsafe { *self.0.start.add(i) = value };
    }
}
