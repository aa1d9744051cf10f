//! What detection finds: points where two bodies touch or may touch within the step.

/// Who touches whom, and where: equal from step to step as long as the contact lasts, so that impulses can warm-start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ContactKey {
    /// The body with the lower index (the antagonist, in the field's words).
    pub a: u32,
    /// The body with the higher index (the candidate).
    pub b: u32,
    /// Which of the pair's points: 0 for balls, the index of the vertex for polygons and boxes on a half-space, for two bodies with
    /// corners which vertices or edges of both make it. The low 32 bits are the pair of shapes'; the high ones say which part of a body
    /// that is made of several (from bit 54, of the second from bit 44), or which triangle of a mesh (from bit 32), the point is on.
    pub feature: u64,
}

/// One contact point at the predicted configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact<const D: usize> {
    /// Its identity.
    pub key: ContactKey,
    /// The point in the world, half-way between the two surfaces, m.
    pub point: [f64; D],
    /// Unit normal from body `a` to body `b`.
    pub normal: [f64; D],
    /// Distance along the normal, m; negative where the bodies overlap.
    pub gap: f64,
}

/// The bits of a feature for the part of a compound; of two compounds for that of the first.
pub(crate) fn part(index: usize) -> u64 {
    (index as u64) << 54
}

/// The bits of a feature for the part of the second of two compounds.
pub(crate) fn second_part(index: usize) -> u64 {
    (index as u64) << 44
}
