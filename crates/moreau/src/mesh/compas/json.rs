//! A JSON document with the way to each value, for messages.

use crate::mesh::{LARGEST, MeshError, Place};
use serde_json::Value;

/// A value and where it is.
#[derive(Clone, Debug)]
pub(super) struct At<'a> {
    pub(super) value: &'a Value,
    way: String,
    file: &'a str,
}

/// The fields of an object with their keys.
pub(super) type Fields<'a> = Vec<(String, At<'a>)>;

impl<'a> At<'a> {
    pub(super) fn top(value: &'a Value, file: &'a str) -> Self {
        Self { value, way: String::new(), file }.unwrapped()
    }

    fn then(&self, step: &str, value: &'a Value) -> Self {
        let way = if self.way.is_empty() { step.to_owned() } else { format!("{}.{step}", self.way) };
        Self { value, way, file: self.file }.unwrapped()
    }

    /// The data of an object that says its type: `{ dtype, data }`, `{ dtype, value }` or `{ datatype, data }`.
    fn unwrapped(mut self) -> Self {
        let typed = |value: &Value| value.get("dtype").or_else(|| value.get("datatype")).is_some();
        while typed(self.value) {
            let Some(inner) = self.value.get("data").or_else(|| self.value.get("value")) else { break };
            self.value = inner;
        }
        self
    }

    pub(super) fn fault(&self, message: impl Into<String>, hint: &str) -> MeshError {
        let (message, way) = (message.into(), &self.way);
        MeshError::read(self.file, Place::File, if way.is_empty() { message } else { format!("{way}: {message}") }, hint)
    }

    /// A field that is there and not null.
    pub(super) fn get(&self, key: &str) -> Option<Self> {
        self.value.get(key).filter(|value| !value.is_null()).map(|value| self.then(key, value))
    }

    pub(super) fn need(&self, key: &str) -> Result<Self, MeshError> {
        self.get(key).ok_or_else(|| self.fault(format!("no `{key}`"), "expected an object with that key"))
    }

    pub(super) fn items(&self) -> Result<Vec<Self>, MeshError> {
        let array = self.value.as_array().ok_or_else(|| self.fault("no list", "expected one"))?;
        Ok(array.iter().enumerate().map(|(i, value)| self.then(&i.to_string(), value)).collect())
    }

    /// All fields, those whose keys are numbers in their order, then the others in theirs.
    pub(super) fn fields(&self) -> Result<Fields<'a>, MeshError> {
        let object = self.value.as_object().ok_or_else(|| self.fault("no object", "expected one with keys"))?;
        let mut fields: Fields<'a> = object.iter().map(|(key, value)| (bare(key), self.then(key, value))).collect();
        fields.sort_by_cached_key(|(key, _)| (key.parse::<i64>().map_or((1, 0), |number| (0, number)), key.clone()));
        Ok(fields)
    }

    pub(super) fn number(&self) -> Result<f64, MeshError> {
        let number = self.value.as_f64().filter(|x| x.abs() < LARGEST);
        number.ok_or_else(|| self.fault("not a number", "expected one below 1e60 in size"))
    }

    pub(super) fn numbers<const N: usize>(&self) -> Result<[f64; N], MeshError> {
        let numbers = self.items()?.iter().map(Self::number).collect::<Result<Vec<_>, _>>()?;
        let count = numbers.len();
        numbers.try_into().map_err(|_| self.fault(format!("{count} numbers"), &format!("expected {N}")))
    }

    pub(super) fn text(&self) -> Option<&'a str> {
        self.value.as_str()
    }

    /// A string or whole number as a key.
    pub(super) fn key(&self) -> Result<String, MeshError> {
        let number = self.value.as_i64().map(|number| number.to_string());
        let key = number.or_else(|| self.text().map(bare));
        key.ok_or_else(|| self.fault("not a key", "expected a whole number or a string"))
    }

    /// Whether a flag is set: true, or a number that is not zero.
    pub(super) fn is_set(&self) -> bool {
        self.value.as_bool().unwrap_or(self.value.as_f64().is_some_and(|x| x != 0.0))
    }
}

impl At<'_> {
    /// The keys of an object whose values are flags that are set.
    pub(super) fn flags(&self) -> Vec<String> {
        let is_set = |value: &Value| value.as_bool().unwrap_or(value.as_f64().is_some_and(|x| x != 0.0));
        let object = self.value.as_object().into_iter().flatten();
        object.filter(|(_, value)| is_set(value)).map(|(key, _)| key.clone()).collect()
    }
}

/// A key without the quotes that its writer may have put around it.
fn bare(key: &str) -> String {
    key.trim_matches('\'').to_owned()
}
