//! HDF5, as far as FCLIB needs it: numbers and texts at paths. Nothing else in this crate knows the library behind it.

use crate::files::{FileError, Place};
use hdf5_pure::{DType, Dataset, DatasetBuilder, Error, FileBuilder, GroupBuilder, LibVer};
use std::cell::Cell;

/// How many bytes the datasets that are read may have in all for each byte of the file, at eight bytes or more an element:
/// compressed ones, and those never written, have more than they take.
pub const EXPANSION_LIMIT: u64 = 64;

/// How many bytes the datasets may have beside [`EXPANSION_LIMIT`], so that small files may hold long zeros: one mebibyte.
pub const EXPANSION_FLOOR: u64 = 1 << 20;

/// The filters that are undone: deflate, shuffle, Fletcher's checksum. The others are other libraries', or can lose digits.
const FILTERS: [u16; 3] = [1, 2, 3];

/// A file that is read.
pub(super) struct Archive {
    file: hdf5_pure::File,
    /// How many bytes may yet be read.
    budget: Cell<u64>,
}

impl Archive {
    pub(super) fn open(bytes: &[u8]) -> Result<Self, FileError> {
        let budget = (bytes.len() as u64).saturating_mul(EXPANSION_LIMIT).saturating_add(EXPANSION_FLOOR);
        let file = hdf5_pure::File::from_bytes(bytes.to_vec());
        let file = file.map_err(|e| FileError::new(Place::Whole, format!("is not a sound HDF5 file: {e}")))?;
        Ok(Self { file, budget: Cell::new(budget) })
    }

    /// Whether the group `group` has a child `name`, group or dataset.
    pub(super) fn has(&self, group: &str, name: &str) -> Result<bool, FileError> {
        let open = || {
            let group = if group.is_empty() { self.file.root() } else { self.file.group(group)? };
            Ok((group.groups()?, group.datasets()?))
        };
        let (groups, datasets) = open().map_err(|e| broken(group, &e))?;
        Ok(groups.iter().chain(&datasets).any(|child| child == name))
    }

    /// The integers at `path`.
    pub(super) fn integers(&self, path: &str) -> Result<Vec<i64>, FileError> {
        let kind = |t: &DType| {
            matches!(t, DType::I8 | DType::I16 | DType::I32 | DType::I64 | DType::U8 | DType::U16 | DType::U32 | DType::U64)
        };
        let dataset = self.dataset(path, kind, "integers")?;
        dataset.read_i64().map_err(|e| broken(path, &e))
    }

    /// The single integer at `path`.
    pub(super) fn integer(&self, path: &str) -> Result<i64, FileError> {
        match self.integers(path)?[..] {
            [value] => Ok(value),
            ref values => Err(error(path, format!("{} numbers; a single one is right", values.len()))),
        }
    }

    /// The single integer ≥ 0 at `path`.
    pub(super) fn count(&self, path: &str) -> Result<usize, FileError> {
        let value = self.integer(path)?;
        usize::try_from(value).map_err(|_| error(path, format!("{value}; it is not negative")))
    }

    /// The integers ≥ 0 at `path`.
    pub(super) fn indices(&self, path: &str) -> Result<Vec<usize>, FileError> {
        let values = self.integers(path)?.into_iter().enumerate();
        let index = |(k, value)| {
            usize::try_from(value).map_err(|_| error(path, format!("number {k} is {value}; indices are not negative")))
        };
        values.map(index).collect()
    }

    /// The finite numbers at `path`.
    pub(super) fn reals(&self, path: &str) -> Result<Vec<f64>, FileError> {
        let dataset = self.dataset(path, |t| matches!(t, DType::F32 | DType::F64), "real numbers")?;
        let values = dataset.read_f64().map_err(|e| broken(path, &e))?;
        match values.iter().position(|x| !x.is_finite()) {
            Some(k) => Err(error(path, format!("number {k} is {}; finite numbers are right", values[k]))),
            None => Ok(values),
        }
    }

    /// The text at `path`. Bytes that are no UTF-8 become replacement characters.
    pub(super) fn text(&self, path: &str) -> Result<String, FileError> {
        let dataset = self.dataset(path, |t| matches!(t, DType::String), "a text of fixed length")?;
        let mut texts = dataset.read_string().map_err(|e| broken(path, &e))?;
        match texts.len() {
            1 => Ok(texts.remove(0)),
            count => Err(error(path, format!("{count} texts; a single one is right"))),
        }
    }

    /// The dataset at `path`, after a look at all that its header claims: kind, shape, filters and sizes.
    fn dataset(&self, path: &str, kind: impl Fn(&DType) -> bool, right: &str) -> Result<Dataset, FileError> {
        let open = || {
            let dataset = self.file.dataset(path)?;
            let (found, shape, size) = (dataset.dtype()?, dataset.shape()?, dataset.element_size()?);
            let chunk = dataset.chunk_shape()?;
            Ok((dataset, found, shape, size, chunk))
        };
        let (dataset, found, shape, size, chunk) = open().map_err(|e| broken(path, &e))?;
        if !kind(&found) {
            return Err(error(path, format!("holds {found}; {right} are right")));
        }
        if shape.len() > 1 {
            return Err(error(path, format!("has {} dimensions; a single one is right", shape.len())));
        }
        if let Some(filter) = dataset.filters().into_iter().find(|id| !FILTERS.contains(id)) {
            return Err(error(path, format!("is written with the filter {filter}; {FILTERS:?} can be undone")));
        }
        // Small integers become large ones when they are read.
        let bytes = |shape: &[u64]| shape.iter().try_fold(size.max(8), |product, &n| product.checked_mul(n));
        let length = shape.first().copied().unwrap_or(1);
        if chunk.as_ref().is_some_and(|chunk| chunk.contains(&0)) {
            return Err(error(path, "has chunks without elements"));
        }
        // A chunk is unpacked whole, however little of it the dataset has.
        let unpacked = chunk.as_deref().map_or(Some(0), bytes);
        let needed = bytes(&[length]).zip(unpacked).map(|(all, chunk)| all.max(chunk));
        let left = self.budget.get();
        match needed.and_then(|needed| left.checked_sub(needed)) {
            Some(rest) => self.budget.set(rest),
            None => {
                return Err(error(path, format!("claims {length} elements of {size} bytes, more than the file can stand for")));
            }
        }
        Ok(dataset)
    }
}

fn error(path: &str, what: impl Into<String>) -> FileError {
    FileError::new(Place::Dataset(path.to_owned()), what)
}

fn broken(path: &str, cause: &Error) -> FileError {
    error(path, format!("cannot be read: {cause}"))
}

/// A group that is written.
pub(super) struct Branch {
    builder: GroupBuilder,
    path: String,
}

impl Branch {
    pub(super) fn new(name: &str) -> Self {
        Self { builder: FileBuilder::new().create_group(name), path: name.to_owned() }
    }

    /// Adds the group `name` with what `fill` writes into it.
    pub(super) fn group(&mut self, name: &str, fill: impl FnOnce(&mut Self) -> Result<(), FileError>) -> Result<(), FileError> {
        let builder = self.builder.create_group(name);
        let mut child = Self { builder, path: format!("{}/{name}", self.path) };
        fill(&mut child)?;
        self.builder.add_group(child.builder.finish());
        Ok(())
    }

    fn dataset(&mut self, name: &str) -> &mut DatasetBuilder {
        self.builder.create_dataset(name)
    }

    /// Integers of 32 bits, as FCLIB has them.
    pub(super) fn integers(&mut self, name: &str, values: impl Iterator<Item = i64>) -> Result<(), FileError> {
        let narrow = |value| {
            i32::try_from(value).map_err(|_| error(&format!("{}/{name}", self.path), format!("{value} needs more than 32 bits")))
        };
        let values = values.map(narrow).collect::<Result<Vec<_>, _>>()?;
        checked(self.dataset(name).with_i32_data(&values), values.len());
        Ok(())
    }

    pub(super) fn indices(&mut self, name: &str, values: &[usize]) -> Result<(), FileError> {
        self.integers(name, values.iter().map(|&value| i64::try_from(value).unwrap_or(i64::MAX)))
    }

    pub(super) fn reals(&mut self, name: &str, values: &[f64]) {
        checked(self.dataset(name).with_f64_data(values), values.len());
    }

    pub(super) fn text(&mut self, name: &str, text: &str) -> Result<(), FileError> {
        let path = format!("{}/{name}", self.path);
        let done = self.dataset(name).with_strings(&[text]).map(|dataset| {
            dataset.with_shape(&[]);
        });
        done.map_err(|e| error(&path, format!("cannot be written: {e}")))
    }
}

/// The longest chunk: of a longer one hdf5-pure stores the length in four bytes where three are enough, which HDF5 2.0 and 2.1 refuse to read.
const LONGEST: usize = (1 << 16) - 1;

/// A list with checksums, which are those of its chunks: equal ones, as few as may be.
fn checked(dataset: &mut DatasetBuilder, length: usize) {
    dataset.with_shape(&[length as u64]);
    if length > 0 {
        let chunk = length.div_ceil(length.div_ceil(LONGEST));
        dataset.with_chunks(&[chunk as u64]).with_fletcher32();
    }
}

/// The bytes of a file with these groups, in the format of HDF5 1.10, the first in which chunks are indexed with checksums.
pub(super) fn bytes(branches: Vec<Branch>) -> Result<Vec<u8>, FileError> {
    let mut file = FileBuilder::new();
    file.with_libver_bounds(LibVer::Earliest, LibVer::V110);
    for branch in branches {
        file.add_group(branch.builder.finish());
    }
    file.finish().map_err(|e| FileError::new(Place::Whole, format!("cannot be written as HDF5: {e}")))
}
