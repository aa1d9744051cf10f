//! Named arrays on points or cells.

/// The numbers of an array, all components of the first tuple, then of the second, and so on.
///
/// A slice of `[f64; 3]` becomes one of these by `as_flattened()`, without a copy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Values<'a> {
    /// Double precision: what the engine computes with.
    F64(&'a [f64]),
    /// Single precision: half the file, enough for pictures.
    F32(&'a [f32]),
    /// Integers: materials, statuses.
    I32(&'a [i32]),
    /// Integers that may be large: identities.
    I64(&'a [i64]),
    /// Flags and small codes.
    U8(&'a [u8]),
}

impl Values<'_> {
    /// How many numbers there are (tuples × components).
    pub fn len(&self) -> usize {
        match self {
            Self::F64(v) => v.len(),
            Self::F32(v) => v.len(),
            Self::I32(v) => v.len(),
            Self::I64(v) => v.len(),
            Self::U8(v) => v.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Lets [`Array::scalars`] take a slice of any of the kinds.
macro_rules! from_slices {
    ($($kind:ident($number:ty)),*) => {$(
        impl<'a> From<&'a [$number]> for Values<'a> {
            fn from(values: &'a [$number]) -> Self {
                Self::$kind(values)
            }
        }
        impl<'a> From<&'a Vec<$number>> for Values<'a> {
            fn from(values: &'a Vec<$number>) -> Self {
                Self::$kind(values)
            }
        }
        impl<'a, const N: usize> From<&'a [$number; N]> for Values<'a> {
            fn from(values: &'a [$number; N]) -> Self {
                Self::$kind(values)
            }
        }
    )*};
}
from_slices!(F64(f64), F32(f32), I32(i32), I64(i64), U8(u8));

/// A named array with `components` numbers for each point or cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Array<'a> {
    /// The name that ParaView shows; any text without control characters, unique within its table.
    pub name: &'a str,
    /// Numbers a tuple: 1 for a scalar, 3 for a vector, 9 for a tensor row by row.
    pub components: usize,
    /// The numbers.
    pub values: Values<'a>,
}

impl<'a> Array<'a> {
    /// One number a point or cell.
    pub fn scalars(name: &'a str, values: impl Into<Values<'a>>) -> Self {
        Self { name, components: 1, values: values.into() }
    }

    /// One vector a point or cell.
    pub fn vectors(name: &'a str, values: &'a [[f64; 3]]) -> Self {
        Self { name, components: 3, values: Values::F64(values.as_flattened()) }
    }
}
