//! What detection finds: points where two bodies touch or may touch within the step.

/// Who touches whom, and where: equal from step to step as long as the contact lasts, so that impulses can warm-start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize)]
pub struct ContactKey {
    /// The body with the lower index (the antagonist, in the field's words).
    pub a: u32,
    /// The body with the higher index (the candidate).
    pub b: u32,
    /// Which of the pair's points: 0 for balls, the index of the vertex for polygons and boxes on a half-space, for two bodies with
    /// corners which vertices or edges of both make it. The low 32 bits are the pair of shapes'; the 22 above say which segment of a
    /// polyline or triangle of a mesh the point is on, and the highest ten which part of a body that is made of several. Of two such bodies
    /// these are the second one's, and the first one's part is in the ten below.
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
