//! Where a ray meets a primitive, and which of two such places comes first.

/// A ray meets a primitive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Parameter along the ray: the point is `ray.at(t)`. Finite, within the ray's own interval.
    pub t: f32,
    /// Weight of the second corner, or the first coordinate of the shape.
    pub u: f32,
    /// Weight of the third corner; the point is `(1-u-v)·A + u·B + v·C`. On triangles `u ≥ 0`, `v ≥ 0`, `1-u-v ≥ 0`.
    pub v: f32,
    /// Index of the primitive as it was given to the build.
    pub primitive: u32,
}

impl Hit {
    /// Whether this hit comes before the best one so far: nearer, or equally near with the lower index.
    /// Without one, any hit at or before `bound` does.
    pub(crate) fn precedes(&self, best: Option<&Hit>, bound: f32) -> bool {
        match best {
            Some(best) => self.t < best.t || (self.t == best.t && self.primitive < best.primitive),
            None => self.t <= bound,
        }
    }
}

/// A ray crosses a surface: the answer of one leaf test, not yet clamped into a box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Parameter along the ray, within the ray's own interval.
    pub t: f32,
    /// Weight of the second corner, or the first coordinate of the shape.
    pub u: f32,
    /// Weight of the third corner, or the second coordinate of the shape.
    pub v: f32,
    /// Whether the ray comes from outside, against the normal.
    pub front: bool,
}

/// What the caller knows about a batch of rays. A hint: it may change the time a batch takes, never its hits.
///
/// The portable code takes the rays of a batch one after the other and treats both kinds alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Coherence {
    /// Neighbours in the batch go much the same way: camera rays, shadow rays to one small lamp.
    Coherent,
    /// They do not: rays after a diffuse bounce.
    Incoherent,
}
