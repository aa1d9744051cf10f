//! A wall of bricks in courses.

use super::site::edges;
use super::{Builder, Piece, Site};
use crate::scene::error::Fault;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A wall of bricks in courses of equal length, numbered course by course from below and from lowest x.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Wall {
    /// Length, in space depth, and height of a brick, m.
    #[schemars(length(min = 2, max = 3))]
    pub size: Vec<f64>,
    /// How many courses.
    pub courses: u64,
    /// How many whole bricks a course has the length of.
    pub bricks: u64,
    /// The gap between neighbours in a course, m; default 0. Courses lie on each other.
    #[serde(default)]
    pub gap: f64,
    /// How courses lie on each other.
    #[serde(default)]
    pub bond: Bond,
}

/// How the courses of a wall lie on each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Bond {
    /// Every second course is moved by half a brick and has a half brick at each end.
    #[default]
    Running,
    /// All courses are alike.
    Stack,
}

impl Wall {
    /// The lengths of the bricks of a course.
    fn lengths(&self, course: u64) -> Vec<f64> {
        let whole = edges(&self.size).0[0];
        if self.bond == Bond::Stack || course.is_multiple_of(2) {
            return vec![whole; self.bricks as usize];
        }
        // Two halves and the gap between them are a brick.
        let half = 0.5 * (whole - self.gap);
        let mut lengths = vec![whole; self.bricks as usize + 1];
        let last = lengths.len() - 1;
        (lengths[0], lengths[last]) = (half, half);
        lengths
    }

    fn course(&self, course: u64) -> Vec<Piece> {
        let ([whole, height], depth) = edges(&self.size);
        let up = (course as f64 + 0.5) * height;
        let bricks = self.bricks as f64;
        let mut left = -0.5 * (bricks * whole + (bricks - 1.0) * self.gap);
        let brick = |length: f64| {
            let x = left + 0.5 * length;
            left += length + self.gap;
            Piece::block([length, height], depth, [x, up])
        };
        self.lengths(course).into_iter().map(brick).collect()
    }
}

impl Builder for Wall {
    fn check(&self, site: &Site<'_>) -> Result<(), Fault> {
        site.size("size", &self.size)?;
        site.whole("courses", self.courses, 1)?;
        site.whole("bricks", self.bricks, 1)?;
        if !(self.gap >= 0.0 && self.gap < self.size[0]) {
            return Err(site.fault("gap", format!("gap is {}", self.gap), "expected 0 or more, in m, and less than a brick's length"));
        }
        Ok(())
    }

    fn count(&self, _: usize) -> u64 {
        let halves = if self.bond == Bond::Running { self.courses / 2 } else { 0 };
        self.courses.saturating_mul(self.bricks).saturating_add(halves)
    }

    fn piece(&self, _: u64) -> &'static str {
        "brick"
    }

    fn pieces(&self, _: &Site<'_>) -> Result<Vec<Piece>, Fault> {
        Ok((0..self.courses).flat_map(|course| self.course(course)).collect())
    }
}
