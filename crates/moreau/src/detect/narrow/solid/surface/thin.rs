//! Of many points with one normal in one plane, the few that hold a body as well.

use crate::detect::narrow::vector::{cross, dot, sub};
use crate::shape::solid::is_one;

/// A point in the frame of the surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    pub(super) feature: u64,
    pub(super) point: [f64; 3],
    pub(super) normal: [f64; 3],
    pub(super) gap: f64,
}

/// In parts of the level: points nearer to each other than that are one, found from two triangles.
const TOGETHER: f64 = 1e3;

/// Leaves of each group of points with one normal in one plane of the surface at most four: the two that are farthest apart, or nearly, the
/// two farthest out on both sides of the line through these, and the deepest in place of the one nearest to it. They come in the order of
/// their features. Of points that are as good as each other but for `level` (m) that of the lower feature is taken, so that what was
/// chosen for a body at rest stays chosen.
pub(super) fn thin(found: &mut Vec<Found>, level: f64) {
    found.sort_unstable_by_key(|one| one.feature);
    found.dedup_by_key(|one| one.feature);
    // Groups are brought to the front of what is left, one after the other, and what is chosen of each is kept before them.
    let (mut kept, mut begin) = (0, 0);
    while begin < found.len() {
        let end = gather(&mut found[begin..], level) + begin;
        let chosen = choose(&found[begin..end], level);
        for place in chosen.into_iter().flatten() {
            // The places chosen ascend and `kept` never overtakes them.
            found.swap(kept, begin + place);
            kept += 1;
        }
        begin = end;
    }
    found.truncate(kept);
    found.sort_unstable_by_key(|one| one.feature);
}

/// Brings the points of the first one's group to the front, in order; how many there are.
fn gather(found: &mut [Found], level: f64) -> usize {
    let first = found[0];
    let height = |one: &Found| dot(first.normal, one.point) - 0.5 * one.gap;
    let base = height(&first);
    let mut count = 1;
    for i in 1..found.len() {
        if is_one(first.normal, found[i].normal) && (height(&found[i]) - base).abs() <= TOGETHER * level {
            // The rest keeps its order.
            found[count..=i].rotate_right(1);
            count += 1;
        }
    }
    count
}

/// The places, ascending, of at most four points of a group.
fn choose(group: &[Found], level: f64) -> [Option<usize>; 4] {
    let apart = |i: usize, j: usize| {
        let between = sub(group[i].point, group[j].point);
        dot(between, between).sqrt()
    };
    // The first place where a measure is largest but for the level.
    let largest = |measure: &dyn Fn(usize) -> f64| {
        (1..group.len()).fold(0, |best, i| if measure(i) > measure(best) + level { i } else { best })
    };
    let deepest = largest(&|i| -group[i].gap);
    let one = largest(&|i| apart(i, 0));
    let other = largest(&|i| apart(i, one));
    if apart(one, other) <= TOGETHER * level {
        return [Some(deepest), None, None, None];
    }
    let line = sub(group[other].point, group[one].point);
    let across = cross(group[0].normal, line).map(|x| x / apart(one, other));
    let out = |i: usize| dot(across, sub(group[i].point, group[one].point));
    let (left, right) = (largest(&|i| out(i)), largest(&|i| -out(i)));
    let mut chosen = [Some(one), Some(other), None, None];
    if out(left) > TOGETHER * level {
        chosen[2] = Some(left);
    }
    if out(right) < -TOGETHER * level {
        chosen[3] = Some(right);
    }
    if chosen.iter().flatten().all(|&i| group[deepest].gap < group[i].gap - level) {
        let away = |k: usize| chosen[k].map_or(f64::INFINITY, |i| apart(i, deepest));
        let nearest = (1..4).fold(0, |best, k| if away(k) < away(best) { k } else { best });
        chosen[nearest] = Some(deepest);
    }
    chosen.sort_unstable_by_key(|place| place.unwrap_or(usize::MAX));
    chosen
}
