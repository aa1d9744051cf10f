//! Tells numbers that zlib would not make smaller from those that it would, without trying: to try costs half of doing it.

/// How many bytes are looked at.
const SAMPLE: usize = 1 << 11;

/// Bits a byte from which on bytes count as noise: what Huffman's code could save is less than a tenth.
const NOISE: f64 = 7.2;

/// Whether the last digits of numbers are most of what `block` has: the entropy of the bytes in its middle says so.
///
/// Positions are noise; indices and whatever is often zero are not. Short blocks never are: there is little to save.
pub(super) fn is_noise(block: &[u8]) -> bool {
    if block.len() < SAMPLE {
        return false;
    }
    let from = (block.len() - SAMPLE) / 2;
    let mut counts = [0_u32; 256];
    for &byte in &block[from..from + SAMPLE] {
        counts[usize::from(byte)] += 1;
    }
    // −Σ p log₂ p with p = count / SAMPLE.
    let logs: f64 = counts.iter().filter(|&&count| count > 0).map(|&count| f64::from(count) * libm::log2(f64::from(count))).sum();
    libm::log2(SAMPLE as f64) - logs / SAMPLE as f64 > NOISE
}

#[cfg(test)]
mod tests {
    use super::is_noise;

    fn bytes(numbers: impl Iterator<Item = f64>) -> Vec<u8> {
        numbers.flat_map(f64::to_le_bytes).collect()
    }

    #[test]
    fn positions_are_noise_and_zeros_repeats_and_indices_are_not() {
        assert!(is_noise(&bytes((0..1000).map(|i| (0.7 * f64::from(i)).sin()))));
        assert!(!is_noise(&bytes((0..1000).map(|i| if i % 3 == 0 { f64::from(i).sin() } else { 0.0 }))));
        assert!(!is_noise(&bytes((0..1000).map(|_| 0.1))));
        assert!(!is_noise(&(0..1000_i64).flat_map(i64::to_le_bytes).collect::<Vec<_>>()));
        assert!(!is_noise(&bytes((0..100).map(|i| f64::from(i).sin()))), "short");
    }
}
