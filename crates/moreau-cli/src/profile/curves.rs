//! Performance profiles (Dolan & Moré 2002): for each method ρ(τ), the part of the problems that it solves at a cost of at most τ
//! times the least cost of any method.

use crate::chart::Curve;
use std::fmt::Write;

/// One kind of cost of all methods on all problems, relative to the least.
pub(super) struct Measure {
    /// What is counted, as file names call it.
    pub(super) what: &'static str,
    pub(super) methods: Vec<String>,
    problems: usize,
    /// The ratios of each method on the problems that it solved, in rising order.
    ratios: Vec<Vec<f64>>,
}

impl Measure {
    /// From the cost of each problem by each method, `None` where it was not solved.
    pub(super) fn new(what: &'static str, methods: Vec<String>, costs: &[Vec<Option<f64>>]) -> Self {
        let mut ratios = vec![Vec::new(); methods.len()];
        for problem in costs {
            let least = problem.iter().flatten().copied().fold(f64::INFINITY, f64::min);
            for (ratios, cost) in ratios.iter_mut().zip(problem) {
                ratios.extend(cost.map(|cost| cost / least));
            }
        }
        ratios.iter_mut().for_each(|ratios| ratios.sort_by(f64::total_cmp));
        Self { what, methods, problems: costs.len(), ratios }
    }

    /// On how many problems a method converged.
    pub(super) fn solved(&self, method: usize) -> usize {
        self.ratios[method].len()
    }

    /// On how many problems no method was better.
    pub(super) fn best_on(&self, method: usize) -> usize {
        self.ratios[method].iter().filter(|&&ratio| ratio <= 1.0).count()
    }

    /// The geometric mean of a method's ratios; `None` where it solved nothing.
    pub(super) fn mean_ratio(&self, method: usize) -> Option<f64> {
        let ratios = &self.ratios[method];
        let logs: f64 = ratios.iter().map(|ratio| ratio.ln()).sum();
        (!ratios.is_empty()).then(|| (logs / ratios.len() as f64).exp())
    }

    /// ρ(τ) of a method.
    fn part(&self, method: usize, tau: f64) -> f64 {
        let within = self.ratios[method].partition_point(|&ratio| ratio <= tau);
        within as f64 / self.problems.max(1) as f64
    }

    /// Where some curve rises, and 1.
    fn steps(&self) -> Vec<f64> {
        let mut steps: Vec<f64> = self.ratios.iter().flatten().copied().chain([1.0]).collect();
        steps.sort_by(f64::total_cmp);
        steps.dedup();
        steps
    }

    /// ρ of all methods wherever one of them changes.
    pub(super) fn csv(&self) -> String {
        let mut text = format!("tau,{}\n", self.methods.join(","));
        for tau in self.steps() {
            let parts: Vec<String> = (0..self.methods.len()).map(|m| self.part(m, tau).to_string()).collect();
            let _ = writeln!(text, "{tau},{}", parts.join(","));
        }
        text
    }

    /// The curves, with their corners; all end at one τ, a little after the last change.
    pub(super) fn curves(&self) -> Vec<Curve> {
        let end = 1.1 * self.steps().last().copied().unwrap_or(1.0).max(1.8);
        let curve = |m: usize| {
            let mut points = vec![(1.0, self.part(m, 1.0))];
            for &tau in self.ratios[m].iter().filter(|&&ratio| ratio > 1.0) {
                let before = points.last().map_or(0.0, |&(_, part)| part);
                points.extend([(tau, before), (tau, self.part(m, tau))]);
            }
            points.push((end, self.part(m, end)));
            points
        };
        self.methods.iter().enumerate().map(|(m, name)| Curve { name: name.clone(), points: curve(m) }).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_count_the_problems_solved_within_a_factor() {
        // The first method is best on one problem, twice as dear on another, and fails on the third; nobody solves the last.
        let costs = [[Some(1.0), Some(4.0)], [Some(6.0), Some(3.0)], [None, Some(5.0)], [None, None]].map(|row| row.to_vec());
        let measure = Measure::new("time", vec!["a".to_owned(), "b".to_owned()], &costs);
        assert_eq!(measure.csv(), "tau,a,b\n1,0.25,0.5\n2,0.5,0.5\n4,0.5,0.75\n");
        assert_eq!([0, 1].map(|m| (measure.solved(m), measure.best_on(m))), [(2, 1), (3, 2)]);
        assert!((measure.mean_ratio(0).unwrap() - 2.0_f64.sqrt()).abs() < 1e-15);
        let curves = measure.curves();
        assert_eq!(curves[0].points, [(1.0, 0.25), (2.0, 0.25), (2.0, 0.5), (4.4, 0.5)]);
        assert_eq!(curves[1].points.last(), Some(&(4.4, 0.75)));
    }

    #[test]
    fn a_method_that_solves_nothing_has_no_ratio() {
        let measure = Measure::new("sweeps", vec!["a".to_owned()], &[vec![None]]);
        assert_eq!((measure.mean_ratio(0), measure.csv().as_str()), (None, "tau,a\n1,0\n"));
        assert_eq!(Measure::new("sweeps", vec!["a".to_owned()], &[]).curves()[0].points.len(), 2);
    }
}
