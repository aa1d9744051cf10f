//! Bodies of several parts: what each part finds by itself.

use super::outlines::{assert_steady, contacts};
use super::*;
use crate::shape::plane::{Capsule, Compound, Polyline};
use crate::space::{Plane, placed};
use proptest::prelude::*;

fn turned(angle: f64) -> [f64; 2] {
    [angle.cos(), angle.sin()]
}

/// A disk, a box and a capsule, and where the parts' coordinates have their origin in the body's frame.
fn thing() -> Compound {
    let parts = vec![
        (Disk { radius: 0.4 }.into(), at([-0.8, 0.1], UP)),
        (Polygon::rectangle(1.0, 0.6).unwrap().into(), at([0.2, 0.3], turned(0.3))),
        (Capsule::new(0.2, 0.9).unwrap().into(), at([0.9, -0.2], turned(1.1))),
    ];
    Compound::new(parts).unwrap().0
}

#[test]
fn a_dumb_bell_lies_on_its_two_disks() {
    let bell = Compound::new([-1.0, 1.0].map(|x| (Disk { radius: 0.5 }.into(), at([x, 0.0], UP))).to_vec()).unwrap().0;
    let found = touch(bell.clone(), at([0.0, 0.5], UP), HalfPlane, at([0.0; 2], UP), 0.0);
    near(&found, &[(0, [-1.0, 0.0], [0.0, -1.0], 0.0), (1 << 54, [1.0, 0.0], [0.0, -1.0], 0.0)]);
    // Of two compounds the first one's part is in the bits below.
    let found = contacts(&bell.clone().into(), &at([0.0; 2], UP), &bell.clone().into(), &at([2.0, 1.0], UP), 1e-9);
    near(&found, &[((1 << 44), [1.0, 0.5], [0.0, 1.0], 0.0)]);
    assert_steady(&bell.clone().into(), &at([0.0; 2], UP), &bell.into(), &at([0.0, 1.0], UP), &[0, (1 << 54) | (1 << 44)]);
}

#[test]
fn a_compound_that_is_nowhere_touches_nothing() {
    let nowhere = at([f64::NAN; 2], UP);
    let others: [PlaneShape; 5] = [
        thing().into(),
        Disk { radius: 1.0 }.into(),
        rectangle().into(),
        HalfPlane.into(),
        Capsule::new(1.0, 1.0).unwrap().into(),
    ];
    assert!(others.iter().all(|other| contacts(&thing().into(), &nowhere, other, &at([0.0; 2], UP), 1.0).is_empty()));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_compound_finds_what_its_parts_find(way in 0.0..6.3, far in 0.0..3.0, turn in 0.0..6.3, reach in 0.0..0.5) {
        let ground = Polyline::new(&[[-4.0, -0.3], [-1.0, 0.1], [0.5, -0.2], [4.0, 0.2]], false).unwrap();
        let others: [PlaneShape; 6] = [
            Disk { radius: 0.7 }.into(),
            rectangle().into(),
            Capsule::new(0.3, 1.0).unwrap().into(),
            HalfPlane.into(),
            ground.into(),
            thing().into(),
        ];
        let (pose, place) = (at([0.3, -0.2], turned(0.4)), at([0.3 + far * f64::cos(way), far * f64::sin(way) - 0.2], turned(turn)));
        for other in others {
            let found = contacts(&thing().into(), &pose, &other, &place, reach);
            let reversed = contacts(&other, &place, &thing().into(), &pose, reach);
            let mut expected = Vec::new();
            for (number, part) in (0..).zip(thing().parts()) {
                let spot = placed::<Plane, 2, 3>(&pose, &part.pose);
                match &other {
                    PlaneShape::Compound(second) => for (last, theirs) in (0..).zip(second.parts()) {
                        let all = contacts(&part.shape, &spot, &theirs.shape, &placed::<Plane, 2, 3>(&place, &theirs.pose), reach);
                        expected.extend(all.into_iter().map(|(f, p, n, g)| ((last << 54) | (number << 44) | f, p, n, g)));
                    },
                    _ => {
                        let all = contacts(&part.shape, &spot, &other, &place, reach);
                        expected.extend(all.into_iter().map(|(f, p, n, g)| ((number << 54) | f, p, n, g)));
                    }
                }
            }
            expected.sort_by_key(|contact| contact.0);
            prop_assert_eq!(&found, &expected);
            prop_assert_eq!(found.len(), reversed.len());
            if other.name() != "compound" {
                let turned: Vec<Found> = reversed.iter().map(|(f, p, n, g)| (*f, *p, n.map(|x| -x), *g)).collect();
                prop_assert_eq!(&found, &turned);
            }
        }
    }
}
