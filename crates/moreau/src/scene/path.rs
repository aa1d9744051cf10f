//! Where a value stands in a scene: `bodies[3].shape.ball.radius`.

use std::fmt;

/// One step down from a value to one of its parts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Segment {
    /// A key of a table.
    Key(String),
    /// An index of an array, from 0.
    Index(usize),
}

impl From<&str> for Segment {
    fn from(key: &str) -> Self {
        Segment::Key(key.to_owned())
    }
}

impl From<&String> for Segment {
    fn from(key: &String) -> Self {
        Segment::Key(key.clone())
    }
}

impl From<usize> for Segment {
    fn from(index: usize) -> Self {
        Segment::Index(index)
    }
}

/// The way from the top of a scene to a value.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct KeyPath(pub(super) Vec<Segment>);

impl KeyPath {
    /// The way to a part of this value.
    pub(super) fn then(&self, segment: impl Into<Segment>) -> Self {
        let mut path = self.clone();
        path.0.push(segment.into());
        path
    }

    /// The way to the value that holds this one.
    pub(super) fn parent(&self) -> Self {
        Self(self.0[..self.0.len().saturating_sub(1)].to_vec())
    }
}

impl fmt::Display for KeyPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, segment) in self.0.iter().enumerate() {
            match segment {
                Segment::Index(index) => write!(f, "[{index}]")?,
                Segment::Key(key) => {
                    let dot = if i == 0 { "" } else { "." };
                    let bare = !key.is_empty() && key.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
                    if bare { write!(f, "{dot}{key}")? } else { write!(f, "{dot}{key:?}")? }
                }
            }
        }
        Ok(())
    }
}

/// `key_path!["bodies", 3, "shape"]` is the way to `bodies[3].shape`.
macro_rules! key_path {
    ($($segment:expr),* $(,)?) => {
        $crate::scene::path::KeyPath(vec![$($crate::scene::path::Segment::from($segment)),*])
    };
}
pub(super) use key_path;

#[cfg(test)]
mod tests {
    #[test]
    fn paths_read_as_in_the_file() {
        assert_eq!(key_path!["bodies", 3, "shape", "ball"].to_string(), "bodies[3].shape.ball");
        assert_eq!(key_path!["materials", "soda lime", "density"].to_string(), "materials.\"soda lime\".density");
    }
}
