//! Values with more than one way of writing: spins, orientations, and arrays of a fixed length.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Error, MapAccess, SeqAccess, Visitor, value::MapAccessDeserializer};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;

/// Exactly `N` numbers. (An array read as `[f64; N]` would take more numbers than `N` and drop the rest.)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numbers<const N: usize>(pub [f64; N]);

impl<'de, const N: usize> Deserialize<'de> for Numbers<N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let numbers = Vec::<f64>::deserialize(deserializer)?;
        let found = numbers.len();
        numbers.try_into().map(Self).map_err(|_| D::Error::invalid_length(found, &format!("{N} numbers").as_str()))
    }
}

impl<const N: usize> Serialize for Numbers<N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.as_slice().serialize(serializer)
    }
}

impl<const N: usize> JsonSchema for Numbers<N> {
    fn schema_name() -> Cow<'static, str> {
        format!("Numbers{N}").into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "array", "items": { "type": "number" }, "minItems": N, "maxItems": N })
    }
}

/// A spin or a torque: one number in the plane (counter-clockwise), a vector in the world frame in space.
#[derive(Clone, Debug, PartialEq)]
pub enum Angular {
    /// Of the plane.
    Plane(f64),
    /// Of space.
    Solid(Vec<f64>),
}

impl<'de> Deserialize<'de> for Angular {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct OneOrMany;
        impl<'de> Visitor<'de> for OneOrMany {
            type Value = Angular;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number (in the plane) or an array of 3 numbers (in space)")
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<Angular, E> {
                Ok(Angular::Plane(value))
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<Angular, E> {
                Ok(Angular::Plane(value as f64))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Angular, A::Error> {
                let mut numbers = Vec::new();
                while let Some(number) = seq.next_element()? {
                    numbers.push(number);
                }
                Ok(Angular::Solid(numbers))
            }
        }
        deserializer.deserialize_any(OneOrMany)
    }
}

impl Serialize for Angular {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Angular::Plane(number) => number.serialize(serializer),
            Angular::Solid(numbers) => numbers.serialize(serializer),
        }
    }
}

impl JsonSchema for Angular {
    fn schema_name() -> Cow<'static, str> {
        "Angular".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "One number in the plane (counter-clockwise), a vector in the world frame in space.",
            "anyOf": [
                { "type": "number" },
                { "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 }
            ]
        })
    }
}

/// How a body is turned. Written as an angle in rad (plane), as a quaternion `[x, y, z, w]` (space), or as a table.
#[derive(Clone, Debug, PartialEq)]
pub enum Orientation {
    /// An angle in rad, counter-clockwise; of the plane.
    Angle(f64),
    /// A quaternion x, y, z, w, which is normalised; of space.
    Quaternion(Vec<f64>),
    /// An angle, in space with its axis.
    Turn(Turn),
}

/// A rotation by an angle, in space about an axis: `{ axis = [0, 0, 1], degrees = 30 }`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Turn {
    /// The axis in the world frame, of any length; in the plane it is left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis: Option<Numbers<3>>,
    /// The angle in rad.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angle: Option<f64>,
    /// The angle in degrees, in place of `angle`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub degrees: Option<f64>,
}

impl<'de> Deserialize<'de> for Orientation {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct AnyForm;
        impl<'de> Visitor<'de> for AnyForm {
            type Value = Orientation;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an angle in rad (plane), a quaternion [x, y, z, w] (space), or { axis, angle } or { axis, degrees }")
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<Orientation, E> {
                Ok(Orientation::Angle(value))
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<Orientation, E> {
                Ok(Orientation::Angle(value as f64))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Orientation, A::Error> {
                let mut numbers = Vec::new();
                while let Some(number) = seq.next_element()? {
                    numbers.push(number);
                }
                Ok(Orientation::Quaternion(numbers))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Orientation, A::Error> {
                Turn::deserialize(MapAccessDeserializer::new(map)).map(Orientation::Turn)
            }
        }
        deserializer.deserialize_any(AnyForm)
    }
}

impl Serialize for Orientation {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Orientation::Angle(angle) => angle.serialize(serializer),
            Orientation::Quaternion(quaternion) => quaternion.serialize(serializer),
            Orientation::Turn(turn) => turn.serialize(serializer),
        }
    }
}

impl JsonSchema for Orientation {
    fn schema_name() -> Cow<'static, str> {
        "Orientation".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "An angle in rad (plane), a quaternion [x, y, z, w] (space), or a turn about an axis.",
            "anyOf": [
                { "type": "number" },
                { "type": "array", "items": { "type": "number" }, "minItems": 4, "maxItems": 4 },
                generator.subschema_for::<Turn>()
            ]
        })
    }
}

/// Two or three dimensions, written as the number 2 or 3.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "i64", into = "i64")]
pub enum Dimension {
    /// The plane.
    Two,
    /// Space.
    Three,
}

impl Dimension {
    /// The number of coordinates.
    pub fn number(self) -> usize {
        match self {
            Dimension::Two => 2,
            Dimension::Three => 3,
        }
    }
}

impl TryFrom<i64> for Dimension {
    type Error = String;

    fn try_from(number: i64) -> Result<Self, String> {
        match number {
            2 => Ok(Dimension::Two),
            3 => Ok(Dimension::Three),
            other => Err(format!("dimension {other}, expected 2 or 3")),
        }
    }
}

impl From<Dimension> for i64 {
    fn from(dimension: Dimension) -> i64 {
        if dimension == Dimension::Two { 2 } else { 3 }
    }
}

impl JsonSchema for Dimension {
    fn schema_name() -> Cow<'static, str> {
        "Dimension".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "description": "Two or three dimensions.", "enum": [2, 3] })
    }
}
