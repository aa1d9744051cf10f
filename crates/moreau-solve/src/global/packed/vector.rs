//! Vectors of registers. Loops, not closures: what is inlined must be compiled for the registers that its caller has.

use crate::wide::{Four, Wide};

#[inline(always)]
pub(super) fn load<W: Wide, const C: usize>(w: W, x: &[Four; C]) -> [W::F; C] {
    let mut out = [w.zero(); C];
    for k in 0..C {
        out[k] = w.load(&x[k]);
    }
    out
}

#[inline(always)]
pub(super) fn store<W: Wide, const C: usize>(w: W, x: [W::F; C]) -> [Four; C] {
    let mut out = [Four::default(); C];
    for k in 0..C {
        out[k] = w.store(x[k]);
    }
    out
}

/// a + s b.
#[inline(always)]
pub(super) fn along<W: Wide, const C: usize>(w: W, a: &[W::F; C], s: W::F, b: &[W::F; C]) -> [W::F; C] {
    let mut out = *a;
    for k in 0..C {
        out[k] = w.more(a[k], s, b[k]);
    }
    out
}

/// a − s b.
#[inline(always)]
pub(super) fn against<W: Wide, const C: usize>(w: W, a: &[W::F; C], s: W::F, b: &[W::F; C]) -> [W::F; C] {
    let mut out = *a;
    for k in 0..C {
        out[k] = w.less(a[k], s, b[k]);
    }
    out
}

/// s a.
#[inline(always)]
pub(super) fn times<W: Wide, const C: usize>(w: W, s: W::F, a: &[W::F; C]) -> [W::F; C] {
    let mut out = *a;
    for k in 0..C {
        out[k] = w.mul(s, a[k]);
    }
    out
}

#[inline(always)]
pub(super) fn plus<W: Wide, const C: usize>(w: W, a: &[W::F; C], b: &[W::F; C]) -> [W::F; C] {
    let mut out = *a;
    for k in 0..C {
        out[k] = w.add(a[k], b[k]);
    }
    out
}

#[inline(always)]
pub(super) fn minus<W: Wide, const C: usize>(w: W, a: &[W::F; C], b: &[W::F; C]) -> [W::F; C] {
    let mut out = *a;
    for k in 0..C {
        out[k] = w.sub(a[k], b[k]);
    }
    out
}

/// s + a · b.
#[inline(always)]
pub(super) fn more_dot<W: Wide, const C: usize>(w: W, mut s: W::F, a: &[W::F; C], b: &[W::F; C]) -> W::F {
    for k in 0..C {
        s = w.more(s, a[k], b[k]);
    }
    s
}

#[inline(always)]
pub(super) fn dot<W: Wide, const C: usize>(w: W, a: &[W::F; C], b: &[W::F; C]) -> W::F {
    let mut sum = w.mul(a[0], b[0]);
    for k in 1..C {
        sum = w.more(sum, a[k], b[k]);
    }
    sum
}

#[inline(always)]
pub(super) fn cross<W: Wide>(w: W, a: &[W::F; 3], b: &[W::F; 3]) -> [W::F; 3] {
    let x = w.less(w.mul(a[1], b[2]), a[2], b[1]);
    let y = w.less(w.mul(a[2], b[0]), a[0], b[2]);
    [x, y, w.less(w.mul(a[0], b[1]), a[1], b[0])]
}

/// v − a × b.
#[inline(always)]
pub(super) fn minus_cross<W: Wide>(w: W, v: &[W::F; 3], a: &[W::F; 3], b: &[W::F; 3]) -> [W::F; 3] {
    let x = w.more(w.less(v[0], a[1], b[2]), a[2], b[1]);
    let y = w.more(w.less(v[1], a[2], b[0]), a[0], b[2]);
    [x, y, w.more(w.less(v[2], a[0], b[1]), a[1], b[0])]
}
