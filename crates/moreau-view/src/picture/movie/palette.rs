//! The few colours that stand for all colours of a movie.

/// Bits of each component by which colours are told apart.
const BITS: usize = 6;
const BINS: usize = 1 << (3 * BITS);

/// How often colours occur.
#[derive(Debug)]
pub(super) struct Census {
    /// Number of pixels and sums of their components, for each bin of similar colours.
    bins: Vec<(u64, [u64; 3])>,
}

/// Pixels of one bin: how many, and their mean colour.
#[derive(Debug, Clone, Copy)]
struct Group {
    count: f64,
    mean: [f64; 3],
}

/// Colours, and for each bin the nearest of them.
#[derive(Debug)]
pub(super) struct Palette {
    pub colours: Vec<[u8; 3]>,
    /// Index plus one, as far as it is known.
    nearest: Vec<u16>,
}

impl Census {
    pub(super) fn new() -> Self {
        Self { bins: vec![(0, [0; 3]); BINS] }
    }

    pub(super) fn count(&mut self, colours: &[[u8; 3]]) {
        for colour in colours {
            let (count, sums) = &mut self.bins[bin(*colour)];
            *count += 1;
            (0..3).for_each(|i| sums[i] += u64::from(colour[i]));
        }
    }

    /// At most so many colours: boxes of colours are cut in two, always the one with the greatest spread, at the mean.
    pub(super) fn palette(&self, most: usize) -> Palette {
        let group = |&(count, sums): &(u64, [u64; 3])| Group { count: count as f64, mean: sums.map(|s| s as f64 / count as f64) };
        let mut boxes = vec![Cut::new(self.bins.iter().filter(|b| b.0 > 0).map(group).collect())];
        while boxes.len() < most {
            let Some(widest) = (0..boxes.len()).max_by(|&a, &b| boxes[a].spread.total_cmp(&boxes[b].spread)) else { break };
            if boxes[widest].spread <= 0.0 {
                break;
            }
            let Cut { groups, axis, mean, .. } = boxes.swap_remove(widest);
            let (low, high): (Vec<_>, Vec<_>) = groups.into_iter().partition(|g| g.mean[axis] < mean[axis]);
            boxes.extend([Cut::new(low), Cut::new(high)]);
        }
        Palette { colours: boxes.iter().map(|b| b.mean.map(|x| x.round() as u8)).collect(), nearest: vec![0; BINS] }
    }
}

/// A box of colours that may be cut.
struct Cut {
    groups: Vec<Group>,
    mean: [f64; 3],
    /// The component that spreads most, and how much.
    axis: usize,
    spread: f64,
}

impl Cut {
    fn new(groups: Vec<Group>) -> Self {
        let sum = |of: &dyn Fn(&Group) -> f64| groups.iter().map(|g| g.count * of(g)).sum::<f64>();
        let count = sum(&|_| 1.0).max(1.0);
        let mean = [0, 1, 2].map(|i| sum(&|g| g.mean[i]) / count);
        let spreads = [0, 1, 2].map(|i| sum(&|g| (g.mean[i] - mean[i]).powi(2)));
        let axis = if spreads[1] >= spreads[0].max(spreads[2]) { 1 } else { 2 * usize::from(spreads[2] > spreads[0]) };
        // A box that rounding cannot part is left whole.
        let parts = groups.iter().any(|g| g.mean[axis] < mean[axis]) && groups.iter().any(|g| g.mean[axis] >= mean[axis]);
        Self { spread: if parts { spreads[axis] } else { 0.0 }, groups, mean, axis }
    }
}

impl Palette {
    /// Index of the nearest colour.
    pub(super) fn nearest(&mut self, colour: [u8; 3]) -> u8 {
        let bin = bin(colour);
        if self.nearest[bin] == 0 {
            let distance = |c: &[u8; 3]| (0..3).map(|i| (i32::from(c[i]) - i32::from(colour[i])).pow(2)).sum::<i32>();
            let index = (0..self.colours.len()).min_by_key(|&i| distance(&self.colours[i])).unwrap_or(0);
            self.nearest[bin] = index as u16 + 1;
        }
        (self.nearest[bin] - 1) as u8
    }
}

fn bin(colour: [u8; 3]) -> usize {
    colour.iter().fold(0, |bin, &x| (bin << BITS) | usize::from(x) >> (8 - BITS))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_are_kept_and_many_are_near_one_of_the_palette() {
        let mut census = Census::new();
        census.count(&[[255; 3], [0, 114, 178], [213, 94, 0]]);
        let mut palette = census.palette(255);
        for colour in [[255; 3], [0, 114, 178], [213, 94, 0]] {
            let index = palette.nearest(colour);
            assert_eq!(palette.colours[usize::from(index)], colour);
        }

        let ramp: Vec<[u8; 3]> = (0..=255).flat_map(|i| [[i, 0, 0], [0, i, 0], [0, i, i]]).collect();
        let mut census = Census::new();
        census.count(&ramp);
        let mut palette = census.palette(255);
        assert!(palette.colours.len() <= 255);
        for colour in ramp {
            let index = palette.nearest(colour);
            let near = palette.colours[usize::from(index)];
            assert!((0..3).all(|i| near[i].abs_diff(colour[i]) <= 6), "{colour:?} became {near:?}");
        }
    }
}
