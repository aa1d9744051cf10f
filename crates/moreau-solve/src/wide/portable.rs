//! For every processor: lane by lane.

use super::{Four, LANES, Wide};

/// Arithmetic that needs nothing.
#[derive(Clone, Copy)]
pub(super) struct Portable;

#[inline(always)]
fn each(f: impl Fn(usize) -> f64) -> [f64; LANES] {
    std::array::from_fn(f)
}

impl Wide for Portable {
    type F = [f64; LANES];

    #[inline(always)]
    fn load(self, x: &Four) -> Self::F {
        x.0
    }

    #[inline(always)]
    fn store(self, x: Self::F) -> Four {
        Four(x)
    }

    #[inline(always)]
    fn splat(self, x: &f64) -> Self::F {
        [*x; LANES]
    }

    #[inline(always)]
    fn add(self, a: Self::F, b: Self::F) -> Self::F {
        each(|i| a[i] + b[i])
    }

    #[inline(always)]
    fn sub(self, a: Self::F, b: Self::F) -> Self::F {
        each(|i| a[i] - b[i])
    }

    #[inline(always)]
    fn mul(self, a: Self::F, b: Self::F) -> Self::F {
        each(|i| a[i] * b[i])
    }

    #[inline(always)]
    fn div(self, a: Self::F, b: Self::F) -> Self::F {
        each(|i| a[i] / b[i])
    }

    #[inline(always)]
    fn more(self, a: Self::F, b: Self::F, c: Self::F) -> Self::F {
        each(|i| b[i].mul_add(c[i], a[i]))
    }

    #[inline(always)]
    fn less(self, a: Self::F, b: Self::F, c: Self::F) -> Self::F {
        each(|i| (-b[i]).mul_add(c[i], a[i]))
    }

    #[inline(always)]
    fn sqrt(self, a: Self::F) -> Self::F {
        a.map(f64::sqrt)
    }

    // Not `f64::max`, which prefers numbers: the processor's own instruction takes the second.
    #[inline(always)]
    fn max(self, a: Self::F, b: Self::F) -> Self::F {
        each(|i| if a[i] > b[i] { a[i] } else { b[i] })
    }

    #[inline(always)]
    fn min(self, a: Self::F, b: Self::F) -> Self::F {
        each(|i| if a[i] < b[i] { a[i] } else { b[i] })
    }

    #[inline(always)]
    fn sums(self, rows: [Self::F; LANES]) -> Self::F {
        rows.map(|x| (x[0] + x[1]) + (x[2] + x[3]))
    }

    #[inline(always)]
    fn transpose(self, rows: [Self::F; LANES]) -> [Self::F; LANES] {
        std::array::from_fn(|j| each(|i| rows[i][j]))
    }
}
