//! What of a body looks along the normal of a contact.

/// As many corners as a patch can have; of a face with more, so many are looked at.
pub(super) const MOST: usize = 32;

/// A point of a body's surface that stays while the contact does.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::detect::narrow::solid) struct Corner {
    pub(in crate::detect::narrow::solid) at: [f64; 3],
    /// Which of the body's, less than 2¹⁵.
    pub(in crate::detect::narrow::solid) id: u64,
}

/// A disk of which a patch's corners are points of the rim.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disc {
    pub(super) centre: [f64; 3],
    /// Right-handed and orthonormal, the third one along the axis.
    pub(super) axes: [[f64; 3]; 3],
    pub(super) radius: f64,
}

/// What lies within its corners, in order around it: a face, a line (two) or a vertex (one).
#[derive(Clone, Copy, Debug)]
pub(in crate::detect::narrow::solid) struct Patch {
    corners: [Corner; MOST],
    count: usize,
    /// A normal of its plane, of faces.
    pub(super) normal: Option<[f64; 3]>,
    /// The whole of a face that is a disk.
    pub(super) disc: Option<Disc>,
    /// Of a line along which the body is round: both ends of the body's axis, and the radius around it.
    pub(super) axis: Option<([[f64; 3]; 2], f64)>,
}

impl Patch {
    pub(super) fn new(corners: impl Iterator<Item = Corner>) -> Self {
        let mut patch = Self { corners: [Corner::default(); MOST], count: 0, normal: None, disc: None, axis: None };
        for (place, corner) in patch.corners.iter_mut().zip(corners) {
            *place = corner;
            patch.count += 1;
        }
        patch
    }

    pub(in crate::detect::narrow::solid) fn corners(&self) -> &[Corner] {
        &self.corners[..self.count]
    }
}
