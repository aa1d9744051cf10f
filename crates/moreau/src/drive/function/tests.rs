//! Functions against their definitions: integrals by fine sums of values, slopes by differences.

use super::*;

fn some() -> Vec<Function> {
    let table = Table { times: vec![0.1, 0.4, 0.45, 0.9], values: vec![1.0, -2.0, 3.0, 3.5] };
    vec![
        Function::Constant(-1.5),
        Function::Ramp(Ramp { from: 2.0, to: -1.0, begin: 0.25, end: 0.75 }),
        Function::Sine(Sine { amplitude: 0.7, frequency: 1.5, phase: 0.4, offset: 0.2 }),
        Function::Table(table),
    ]
}

#[test]
fn values_are_those_of_the_definition() {
    let [_, ramp, sine, table] = &some()[..] else { panic!("four functions") };
    assert_eq!([0.0, 0.25, 0.5, 0.75, 2.0].map(|t| ramp.value(t)), [2.0, 2.0, 0.5, -1.0, -1.0]);
    assert_eq!([0.0, 0.1, 0.4, 0.9, 2.0].map(|t| table.value(t)), [1.0, 1.0, -2.0, 3.5, 3.5]);
    assert!((table.value(0.25) + 0.5).abs() < 1e-15, "half-way from 1 to -2");
    assert!((sine.value(0.3) - (0.2 + 0.7 * (3.0 * PI * 0.3 + 0.4).sin())).abs() < 1e-15);
    let one = Function::Table(Table { times: vec![0.5], values: vec![7.0] });
    assert_eq!([0.0, 0.5, 1.0].map(|t| one.value(t)), [7.0; 3]);
}

/// The midpoint rule with 10⁵ intervals is right to 1e-9 for slopes of some tens.
#[test]
fn integrals_are_sums_of_values() {
    for function in some() {
        for (a, b) in [(-0.3, 1.4), (0.3, 0.42), (0.2, 0.2), (0.4, 0.45), (1.0, 2.0), (0.0, 0.1)] {
            let part = (b - a) / 1e5;
            let sum: f64 = (0..100_000).map(|i| part * function.value(a + (f64::from(i) + 0.5) * part)).sum();
            let found = function.integral(a, b);
            assert!((found - sum).abs() < 1e-8, "{function:?} from {a} to {b}: {found}, not {sum}");
        }
    }
}

#[test]
fn slopes_are_differences_of_values_on_the_side_that_is_asked_for() {
    for function in some() {
        for t in [0.05, 0.1, 0.2, 0.25, 0.4, 0.42, 0.45, 0.75, 0.8, 0.9, 1.0] {
            for side in [-1e-6, 1e-6] {
                let difference = (function.value(t + side) - function.value(t)) / side;
                let found = function.slope(t, side);
                assert!((found - difference).abs() < 1e-4, "{function:?} at {t}: {found}, not {difference}");
            }
        }
    }
}
