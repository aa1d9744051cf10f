//! Colours: contacts of one colour share no body, so one visit need not wait for what another wrote.

use super::NONE;

/// Contacts are ordered by colour among so many at a time.
const WINDOW: u32 = 1024;

/// Greedy: each contact, in its number's order, takes the first colour that neither of its bodies has; sorted by colour, then
/// number, within windows that stay in the cache. Colours beyond the sixty-third, which only a body with as many contacts needs, are
/// the last one's.
pub(super) fn sort(bodies: usize, pairs: impl ExactSizeIterator<Item = [u32; 2]>, order: &mut [u32]) {
    let mut taken = vec![0; bodies];
    let mut colours = Vec::with_capacity(pairs.len());
    colours.extend(pairs.map(|pair| first_free(&mut taken, pair).min(63)));
    order.sort_unstable_by_key(|&c| (c / WINDOW, colours[c as usize], c));
}

/// The first colour that neither body of `pair` has taken, which they then take; 64 where there is none.
#[inline]
pub(crate) fn first_free(taken: &mut [u64], pair: [u32; 2]) -> u32 {
    let mut used = 0;
    for body in pair.into_iter().filter(|&body| body != NONE) {
        used |= taken[body as usize];
    }
    let colour = used.trailing_ones();
    for body in pair.into_iter().filter(|&body| body != NONE) {
        taken[body as usize] |= 1_u64.checked_shl(colour).unwrap_or(0);
    }
    colour
}
