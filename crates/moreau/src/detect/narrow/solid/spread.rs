//! Which four of many points of a contact are kept.

use crate::detect::narrow::vector::{dot, sub};

/// The numbers of those of `count` points that lie farthest out in the four directions between `s` and `t`, with the deepest among them. `point` gives place
/// and gap. Of points that are as good as each other to `level` (m) the first counts. Where one is farthest out in two directions, so that three would be left of a
/// face, the point that is farthest from those chosen is the fourth.
pub(super) fn spread(count: usize, point: impl Fn(usize) -> ([f64; 3], f64), [s, t]: [[f64; 3]; 2], level: f64) -> [usize; 4] {
    let (at, gap) = (|i: usize| point(i).0, |i: usize| point(i).1);
    let mut chosen = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].map(|[x, y]| {
        let out = |i: usize| x * dot(s, at(i)) + y * dot(t, at(i));
        (1..count).fold(0, |best, i| if out(i) > out(best) + level { i } else { best })
    });
    let apart = |i: usize, j: usize| {
        let way = sub(at(i), at(j));
        dot(way, way).sqrt()
    };
    for k in 1..4 {
        if chosen[..k].contains(&chosen[k]) {
            let far = |i: usize| chosen.iter().map(|&j| apart(i, j)).fold(f64::INFINITY, f64::min);
            chosen[k] = (1..count).fold(0, |best, i| if far(i) > far(best) + level { i } else { best });
        }
    }
    let deepest = (1..count).fold(0, |best, i| if gap(i) < gap(best) - level { i } else { best });
    if chosen.iter().all(|&i| gap(i) > gap(deepest) + level) {
        let nearest = (1..4).fold(0, |best, k| if apart(chosen[k], deepest) < apart(chosen[best], deepest) { k } else { best });
        chosen[nearest] = deepest;
    }
    chosen
}
