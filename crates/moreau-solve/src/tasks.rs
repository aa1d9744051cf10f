//! Loops that threads share. What they compute is cut in halves again and again, at places that depend on the length alone, and put
//! together in the same order: the bits do not depend on how many threads there are.

use rayon::prelude::*;
use std::ops::Range;

/// So many are one task.
const TASK: usize = 1024;

/// out\[i\] = f(i) for every i below n.
pub fn fill<T: Send>(out: &mut Vec<T>, n: usize, f: impl Fn(usize) -> T + Sync + Send) {
    if n <= TASK {
        out.clear();
        out.extend((0..n).map(f));
    } else {
        (0..n).into_par_iter().with_min_len(TASK).map(f).collect_into_vec(out);
    }
}

/// `part` of pieces of `range`, put together by `join`.
pub fn fold<T: Send>(range: Range<usize>, part: &(impl Fn(Range<usize>) -> T + Sync), join: &(impl Fn(T, T) -> T + Sync)) -> T {
    if range.len() <= TASK {
        return part(range);
    }
    let middle = range.start + range.len() / 2;
    let (a, b) = rayon::join(|| fold(range.start..middle, part, join), || fold(middle..range.end, part, join));
    join(a, b)
}

/// Σ f(i) over `range`, of K sums at once.
pub fn sums<const K: usize>(range: Range<usize>, f: &(impl Fn(usize) -> [f64; K] + Sync)) -> [f64; K] {
    let plus = |a: [f64; K], b: [f64; K]| std::array::from_fn(|k| a[k] + b[k]);
    fold(range, &|range: Range<usize>| range.fold([0.0; K], |sum, i| plus(sum, f(i))), &plus)
}

/// K sums Σ f(i, a\[i\], b\[i\]) at once, where f may change what it is given. The slices are of one length; `first` is the index of their first elements.
pub fn sums_mut<A: Send, B: Send, const K: usize>(
    first: usize,
    a: &mut [A],
    b: &mut [B],
    f: &(impl Fn(usize, &mut A, &mut B) -> [f64; K] + Sync),
) -> [f64; K] {
    let plus = |a: [f64; K], b: [f64; K]| std::array::from_fn(|k| a[k] + b[k]);
    if a.len() <= TASK {
        return a.iter_mut().zip(b).zip(first..).fold([0.0; K], |sum, ((a, b), i)| plus(sum, f(i, a, b)));
    }
    let middle = a.len() / 2;
    let ((a, a_end), (b, b_end)) = (a.split_at_mut(middle), b.split_at_mut(middle));
    let (begin, end) = rayon::join(|| sums_mut(first, a, b, f), || sums_mut(first + middle, a_end, b_end, f));
    plus(begin, end)
}

/// f of every element.
pub fn each<T: Send>(all: &mut [T], f: impl Fn(usize, &mut T) + Sync + Send) {
    parts(all, |first, part| part.iter_mut().zip(first..).for_each(|(one, i)| f(i, one)));
}

/// f of every piece; it is told the index of the first element.
pub fn parts<T: Send>(all: &mut [T], f: impl Fn(usize, &mut [T]) + Sync + Send) {
    if all.len() <= TASK {
        f(0, all);
    } else {
        all.par_chunks_mut(TASK).enumerate().for_each(|(part, all)| f(part * TASK, all));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on<T: Send>(threads: usize, f: impl FnOnce() -> T + Send) -> T {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(f)
    }

    #[test]
    fn sums_have_the_same_bits_on_any_number_of_threads() {
        let term = |i: usize| 1.0 / (1.0 + i as f64).powi(2);
        for n in [0, 1, TASK, TASK + 1, 100_000] {
            let all = [1, 2, 3, 8].map(|threads| on(threads, || sums(0..n, &|i| [term(i), i as f64])));
            assert!(all.iter().all(|sums| sums.map(f64::to_bits) == all[0].map(f64::to_bits)));
            assert_eq!(all[0][1], (n * n.saturating_sub(1) / 2) as f64);
            let (mut a, mut b) = (vec![0.0; n], vec![1.0; n]);
            let sums = on(3, || {
                sums_mut(0, &mut a, &mut b, &|i, a, b| {
                    (*a, *b) = (*b, i as f64);
                    [term(i), i as f64]
                })
            });
            assert_eq!(sums.map(f64::to_bits), all[0].map(f64::to_bits));
            assert!(a.iter().all(|&a| a == 1.0) && b.iter().enumerate().all(|(i, &b)| b == i as f64));
        }
    }

    #[test]
    fn every_element_is_made_and_met_once() {
        for n in [0, 1, 5000] {
            let mut all = vec![7; 3];
            fill(&mut all, n, |i| i);
            each(&mut all, |i, x| *x += i);
            assert!(all.len() == n && all.iter().enumerate().all(|(i, &x)| x == 2 * i));
        }
    }
}
