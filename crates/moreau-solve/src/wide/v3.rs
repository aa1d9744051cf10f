//! For x86-64 processors of level 3 (AVX2; since about 2013), through pulp, which asks the processor and keeps the promise in a type.

use super::{Four, LANES, Wide, WithWide};
use pulp::{NullaryFnOnce, cast, f64x4, x86};

type Register = <V3 as Wide>::F;

/// Proof that the processor has the registers.
#[derive(Clone, Copy)]
pub(super) struct V3(x86::V3);

impl V3 {
    #[inline(always)]
    pub(super) fn find() -> Option<Self> {
        x86::V3::try_new().map(Self)
    }

    /// Runs `task` in code that is compiled for them.
    #[inline(always)]
    pub(super) fn run<T: WithWide>(self, task: T) -> T::Output {
        self.0.vectorize(Compiled(self, task))
    }
}

struct Compiled<T>(V3, T);

impl<T: WithWide> NullaryFnOnce for Compiled<T> {
    type Output = T::Output;

    #[inline(always)]
    fn call(self) -> T::Output {
        self.1.run(self.0)
    }
}

impl Wide for V3 {
    #[cfg(target_arch = "x86_64")]
    type F = core::arch::x86_64::__m256d;
    #[cfg(target_arch = "x86")]
    type F = core::arch::x86::__m256d;

    #[inline(always)]
    fn load(self, x: &Four) -> Register {
        cast(x.0)
    }

    #[inline(always)]
    fn store(self, x: Register) -> Four {
        Four(cast(x))
    }

    #[inline(always)]
    fn splat(self, x: &f64) -> Register {
        self.0.avx._mm256_broadcast_sd(x)
    }

    #[inline(always)]
    fn add(self, a: Register, b: Register) -> Register {
        cast(self.0.add_f64x4(lanes(a), lanes(b)))
    }

    #[inline(always)]
    fn sub(self, a: Register, b: Register) -> Register {
        cast(self.0.sub_f64x4(lanes(a), lanes(b)))
    }

    #[inline(always)]
    fn mul(self, a: Register, b: Register) -> Register {
        cast(self.0.mul_f64x4(lanes(a), lanes(b)))
    }

    #[inline(always)]
    fn div(self, a: Register, b: Register) -> Register {
        cast(self.0.div_f64x4(lanes(a), lanes(b)))
    }

    #[inline(always)]
    fn more(self, a: Register, b: Register, c: Register) -> Register {
        self.0.fma._mm256_fmadd_pd(b, c, a)
    }

    #[inline(always)]
    fn less(self, a: Register, b: Register, c: Register) -> Register {
        self.0.fma._mm256_fnmadd_pd(b, c, a)
    }

    #[inline(always)]
    fn sqrt(self, a: Register) -> Register {
        self.0.avx._mm256_sqrt_pd(a)
    }

    #[inline(always)]
    fn max(self, a: Register, b: Register) -> Register {
        self.0.avx._mm256_max_pd(a, b)
    }

    #[inline(always)]
    fn min(self, a: Register, b: Register) -> Register {
        self.0.avx._mm256_min_pd(a, b)
    }

    #[inline(always)]
    fn sums(self, rows: [Register; LANES]) -> Register {
        let avx = self.0.avx;
        // [a₀ + a₁, b₀ + b₁, a₂ + a₃, b₂ + b₃] of two rows each.
        let [low, high] = [avx._mm256_hadd_pd(rows[0], rows[1]), avx._mm256_hadd_pd(rows[2], rows[3])];
        // Fronts of the first two rows with backs of the last two, and the other way round.
        let blended = avx._mm256_blend_pd::<0b1100>(low, high);
        let crossed = avx._mm256_permute2f128_pd::<0x21>(low, high);
        self.add(blended, crossed)
    }

    #[inline(always)]
    fn transpose(self, rows: [Register; LANES]) -> [Register; LANES] {
        let avx = self.0.avx;
        let [even, odd] = [avx._mm256_unpacklo_pd(rows[0], rows[1]), avx._mm256_unpackhi_pd(rows[0], rows[1])];
        let [even_2, odd_2] = [avx._mm256_unpacklo_pd(rows[2], rows[3]), avx._mm256_unpackhi_pd(rows[2], rows[3])];
        [
            avx._mm256_permute2f128_pd::<0x20>(even, even_2),
            avx._mm256_permute2f128_pd::<0x20>(odd, odd_2),
            avx._mm256_permute2f128_pd::<0x31>(even, even_2),
            avx._mm256_permute2f128_pd::<0x31>(odd, odd_2),
        ]
    }
}

#[inline(always)]
fn lanes(x: Register) -> f64x4 {
    cast(x)
}
