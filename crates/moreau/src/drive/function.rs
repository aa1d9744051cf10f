//! Functions of time, with the integrals and slopes that drives need, exact but for rounding.

use schemars::{JsonSchema, Schema};
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use std::f64::consts::{PI, TAU};
use std::fmt;

/// A function of the time t of the run, in s. A bare number is the constant. (Sines come from the system's mathematics library and may
/// differ in their last bit between systems.)
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(transform = or_number)]
pub enum Function {
    /// The same at all times.
    Constant(f64),
    /// From one value to another along a straight line, and constant before and after.
    Ramp(Ramp),
    /// offset + amplitude · sin(2π · frequency · t + phase).
    Sine(Sine),
    /// Straight lines between given points, constant before the first and after the last.
    Table(Table),
}

/// A straight line between two times.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ramp {
    /// The value up to the time `begin`.
    pub from: f64,
    /// The value from the time `end` on.
    pub to: f64,
    /// When it leaves the first value, s.
    pub begin: f64,
    /// When it reaches the second value, s; after `begin`.
    pub end: f64,
}

/// A sine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sine {
    /// The greatest distance from the mean.
    pub amplitude: f64,
    /// Periods in a second, Hz.
    pub frequency: f64,
    /// The phase at t = 0, rad; default 0.
    #[serde(default)]
    pub phase: f64,
    /// The mean; default 0.
    #[serde(default)]
    pub offset: f64,
}

/// Values at times.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Table {
    /// The times, s, each after the one before.
    pub times: Vec<f64>,
    /// The values, as many.
    pub values: Vec<f64>,
}

impl Function {
    /// The value at time `t`.
    pub fn value(&self, t: f64) -> f64 {
        match self {
            Function::Constant(value) => *value,
            Function::Ramp(Ramp { from, to, begin, end }) => on_line([*begin, *from], [*end, *to], t),
            Function::Sine(sine) => sine.offset + sine.amplitude * libm::sin(sine.angle(t)),
            Function::Table(Table { times, values }) => {
                let after = times.partition_point(|&time| time <= t).min(times.len().saturating_sub(1));
                let point = |i: usize| [times.get(i).copied().unwrap_or(0.0), values.get(i).copied().unwrap_or(0.0)];
                on_line(point(after.saturating_sub(1)), point(after), t)
            }
        }
    }

    /// The integral from time `a` to a later time `b`.
    pub fn integral(&self, a: f64, b: f64) -> f64 {
        match self {
            Function::Constant(value) => value * (b - a),
            Function::Ramp(Ramp { begin, end, .. }) => self.trapezoids(&[*begin, *end], a, b),
            // cos x − cos y = 2 sin((x + y)/2) sin((y − x)/2), which keeps its digits over a short step.
            Function::Sine(sine) => {
                let swing = libm::sin(sine.angle(0.5 * (a + b))) * libm::sin(PI * sine.frequency * (b - a));
                sine.offset * (b - a) + sine.amplitude * swing / (PI * sine.frequency)
            }
            Function::Table(Table { times, .. }) => self.trapezoids(times, a, b),
        }
    }

    /// The derivative at time `t`; at a corner, that at `t + aside`.
    pub fn slope(&self, t: f64, aside: f64) -> f64 {
        let t_aside = t + aside;
        match self {
            Function::Constant(_) => 0.0,
            Function::Ramp(Ramp { from, to, begin, end }) => slope_of([*begin, *from], [*end, *to], t_aside),
            Function::Sine(sine) => sine.amplitude * TAU * sine.frequency * libm::cos(sine.angle(t)),
            Function::Table(Table { times, values }) => {
                let after = times.partition_point(|&time| time <= t_aside);
                match (after.checked_sub(1), times.get(after)) {
                    (Some(before), Some(&end)) => slope_of([times[before], values[before]], [end, values[after]], t_aside),
                    _ => 0.0,
                }
            }
        }
    }

    /// The trapezoidal rule between the corners that lie between two times: exact, since the function is straight there.
    fn trapezoids(&self, corners: &[f64], a: f64, b: f64) -> f64 {
        let place = |t: f64| corners.partition_point(|&corner| corner <= t);
        let (mut sum, mut left) = (0.0, a);
        for &right in corners[place(a)..place(b).max(place(a))].iter().chain([&b]) {
            sum += 0.5 * (right - left) * (self.value(left) + self.value(right));
            left = right;
        }
        sum
    }
}

impl Sine {
    fn angle(&self, t: f64) -> f64 {
        TAU * self.frequency * t + self.phase
    }
}

/// The value at time `t` on the line from one point to a later one, of the nearer end beyond it.
fn on_line([begin, from]: [f64; 2], [end, to]: [f64; 2], t: f64) -> f64 {
    if t <= begin {
        from
    } else if t >= end {
        to
    } else {
        from + (to - from) * ((t - begin) / (end - begin))
    }
}

/// The slope of that line at time `t`.
fn slope_of([begin, from]: [f64; 2], [end, to]: [f64; 2], t: f64) -> f64 {
    if t < begin || t >= end { 0.0 } else { (to - from) / (end - begin) }
}

/// The names of functions in scene files.
const NAMES: &[&str] = &["constant", "ramp", "sine", "table"];

impl<'de> Deserialize<'de> for Function {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NumberOrName;
        impl<'de> Visitor<'de> for NumberOrName {
            type Value = Function;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number or a function of time such as { sine = { amplitude = 0.1, frequency = 5.0 } }")
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<Function, E> {
                Ok(Function::Constant(value))
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<Function, E> {
                Ok(Function::Constant(value as f64))
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Function, A::Error> {
                let one = || A::Error::custom("wanted exactly 1 element");
                let name = map.next_key::<String>()?.ok_or_else(one)?;
                let function = match name.as_str() {
                    "constant" => Function::Constant(map.next_value()?),
                    "ramp" => Function::Ramp(map.next_value()?),
                    "sine" => Function::Sine(map.next_value()?),
                    "table" => Function::Table(map.next_value()?),
                    other => return Err(A::Error::unknown_variant(other, NAMES)),
                };
                if map.next_key::<String>()?.is_some() { Err(one()) } else { Ok(function) }
            }
        }
        deserializer.deserialize_any(NumberOrName)
    }
}

/// A number is a function, too.
fn or_number(schema: &mut Schema) {
    if let Some(serde_json::Value::Array(choices)) = schema.get_mut("oneOf") {
        choices.push(serde_json::json!({ "description": "The same at all times.", "type": "number" }));
    }
}

#[cfg(test)]
mod tests;
