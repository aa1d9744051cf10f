//! Four numbers at a time: what the packed kernels are written in.
//!
//! A kernel is written once, over [`Wide`], and compiled twice: for processors with 256-bit registers ([`v3`]), found when the
//! program runs, and portably. Both do the same operations in the same order on each lane, and fuse a product with a sum where the
//! kernel says so and nowhere else, so both give the same bits. (Where a processor has no fused operation the portable ones are slow:
//! that is x86 before 2013.)

mod portable;
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
mod v3;

use portable::Portable;

/// How many contacts a kernel visits at a time.
pub(crate) const LANES: usize = 4;

/// One number for each of four contacts, or four of one body: aligned, so that a register is loaded at once.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(32))]
pub(crate) struct Four(pub [f64; LANES]);

/// Which kernels may be used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(
    feature = "schema",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum Kernels {
    /// The widest that the processor has.
    #[default]
    Auto,
    /// Packed ones, compiled for every processor: the same bits as the widest.
    Portable,
    /// None: contact by contact, in the order that the settings ask for.
    Plain,
}

/// Arithmetic on four lanes.
pub(crate) trait Wide: Copy {
    /// Four lanes.
    type F: Copy;

    fn load(self, x: &Four) -> Self::F;
    fn store(self, x: Self::F) -> Four;
    /// Nothing in all lanes.
    #[inline(always)]
    fn zero(self) -> Self::F {
        self.splat(&0.0)
    }
    /// One number in all lanes.
    fn splat(self, x: &f64) -> Self::F;
    fn add(self, a: Self::F, b: Self::F) -> Self::F;
    fn sub(self, a: Self::F, b: Self::F) -> Self::F;
    fn mul(self, a: Self::F, b: Self::F) -> Self::F;
    fn div(self, a: Self::F, b: Self::F) -> Self::F;
    /// a + b c, rounded once.
    fn more(self, a: Self::F, b: Self::F, c: Self::F) -> Self::F;
    /// a − b c, rounded once.
    fn less(self, a: Self::F, b: Self::F, c: Self::F) -> Self::F;
    fn sqrt(self, a: Self::F) -> Self::F;
    /// a where a > b, else b: also where one is no number, so NaN passes through the second.
    fn max(self, a: Self::F, b: Self::F) -> Self::F;
    /// a where a < b, else b.
    fn min(self, a: Self::F, b: Self::F) -> Self::F;
    /// Lane i is the sum of row i, (x₀ + x₁) + (x₂ + x₃).
    fn sums(self, rows: [Self::F; LANES]) -> Self::F;
    /// Lane j of row i becomes lane i of row j.
    fn transpose(self, rows: [Self::F; LANES]) -> [Self::F; LANES];
}

/// What runs with some [`Wide`].
pub(crate) trait WithWide {
    /// Its result.
    type Output;
    /// Runs; to be inlined, with all that it calls, or else it is compiled without the wide registers.
    fn run<W: Wide>(self, wide: W) -> Self::Output;
}

/// Runs `task` with the widest arithmetic that `kernels` allow and the processor has.
#[inline(always)]
pub(crate) fn with_wide<T: WithWide>(kernels: Kernels, task: T) -> T::Output {
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    if kernels == Kernels::Auto
        && let Some(wide) = v3::V3::find()
    {
        return wide.run(task);
    }
    let _ = kernels;
    task.run(Portable)
}

/// Σ of the lanes, (x₀ + x₁) + (x₂ + x₃).
pub(crate) fn total(x: &Four) -> f64 {
    (x.0[0] + x.0[1]) + (x.0[2] + x.0[3])
}

#[cfg(test)]
mod tests {
    use super::*;

    struct All(Four, Four);

    impl WithWide for All {
        type Output = Vec<Four>;

        #[inline(always)]
        fn run<W: Wide>(self, w: W) -> Vec<Four> {
            let (a, b) = (w.load(&self.0), w.load(&self.1));
            let mixed = [a, b, w.add(a, b), w.splat(&self.1.0[2])];
            let mut out = vec![
                w.sub(a, b),
                w.more(a, a, b),
                w.less(a, b, b),
                w.mul(a, b),
                w.div(a, b),
                w.sqrt(w.mul(a, a)),
                w.max(a, b),
                w.min(a, b),
                w.sums(mixed),
            ];
            out.extend(w.transpose(mixed));
            out.into_iter().map(|x| w.store(x)).collect()
        }
    }

    #[test]
    fn wide_and_portable_give_the_same_bits() {
        let bits = |four: Vec<Four>| four.iter().flat_map(|x| x.0.map(f64::to_bits)).collect::<Vec<_>>();
        let values = [1.5, -0.25, 3e-7, -0.0, 0.0, 7.125, f64::INFINITY, 1e300];
        for (i, &x) in values.iter().enumerate() {
            let a = Four([x, values[(i + 3) % 8], -x, 0.3]);
            let b = Four([values[(i + 1) % 8], 0.1, x, -0.7]);
            let [wide, portable] = [Kernels::Auto, Kernels::Portable].map(|kernels| bits(with_wide(kernels, All(a, b))));
            // What an invalid operation makes is no number, of whichever sign.
            for (wide, portable) in wide.into_iter().zip(portable) {
                assert!(wide == portable || f64::from_bits(wide).is_nan() && f64::from_bits(portable).is_nan());
            }
        }
    }

    #[test]
    fn what_is_no_number_passes_the_maximum() {
        let [a, b] = [Four([0.0; 4]), Four([f64::NAN, -1.0, 1.0, 0.0])];
        for kernels in [Kernels::Auto, Kernels::Portable] {
            let max = with_wide(kernels, All(a, b))[6].0;
            assert!(max[0].is_nan());
            assert_eq!(max[1..], [0.0, 1.0, 0.0]);
        }
    }
}
