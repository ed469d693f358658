//! A tree over triangles, each kept where its leaf finds it.

use crate::build::{Quality, Reference, build};
use crate::tree::{Stack, Statistics, Tree};
use crate::triangle::{ShearedRay, Triangle, nearest_point};
use crate::{Aabb, Coherence, Crossing, Hit, NearestPoint, Ray, SlabRay};
use glam::Vec3;
use rayon::prelude::*;

/// A tree over the triangles of a mesh.
///
/// Triangles with an index out of range or a corner that is not finite are left out and never hit.
#[derive(Clone, Debug)]
pub struct TriangleBvh {
    tree: Tree,
    /// In leaf order.
    triangles: Vec<Packed>,
}

#[derive(Clone, Copy, Debug)]
struct Packed {
    corners: Triangle,
    primitive: u32,
}

/// A ray prepared for both tests.
struct Prepared {
    slab: SlabRay,
    sheared: ShearedRay,
}

impl Prepared {
    #[inline(always)]
    fn new(ray: &Ray) -> Option<Self> {
        let slab = SlabRay::new(ray)?;
        Some(Self { slab, sheared: ShearedRay::of_valid(ray, slab.t_min, slab.t_max) })
    }
}

impl TriangleBvh {
    /// Builds the tree on as many threads as the rayon pool has; the result is the same for any number of them.
    /// Each triangle names its three corners, counter-clockwise seen from outside; at most 2³² triangles.
    pub fn build(positions: &[Vec3], triangles: &[[u32; 3]], quality: Quality) -> Self {
        let triangles = &triangles[..triangles.len().min(u32::MAX as usize)];
        let reference = |(primitive, corners): (usize, &[u32; 3])| {
            let triangle = Triangle::of_mesh(positions, *corners).filter(Triangle::is_finite)?;
            Reference::new(triangle.bounds(), primitive as u32)
        };
        let mut references: Vec<_> = triangles.par_iter().enumerate().filter_map(reference).collect();
        let tree = build(&mut references, quality);
        let pack = |reference: &Reference| {
            let corners = triangles[reference.primitive as usize].map(|corner| positions[corner as usize]);
            let [a, b, c] = corners;
            Packed { corners: Triangle { a, b, c }, primitive: reference.primitive }
        };
        Self { tree, triangles: references.par_iter().map(pack).collect() }
    }

    /// The box of all triangles, a little too large: see [`Triangle::bounds`].
    pub fn bounds(&self) -> Aabb {
        self.tree.bounds
    }

    /// The size and worth of the tree.
    pub fn statistics(&self) -> Statistics {
        self.tree.statistics(self.triangles.len() * size_of::<Packed>())
    }

    /// The nearest hit from either side; of equally near ones that of the lowest triangle.
    pub fn nearest(&self, ray: &Ray) -> Option<Hit> {
        self.search(ray, f32::INFINITY, &mut Stack::new(), |_| true, |_| true)
    }

    /// The nearest hit from outside: triangles that turn their back are passed through.
    ///
    /// Right only for closed meshes seen from outside and through nothing transparent.
    pub fn nearest_culled(&self, ray: &Ray) -> Option<Hit> {
        self.search(ray, f32::INFINITY, &mut Stack::new(), |hit| hit.front, |_| true)
    }

    /// The nearest hit that `accept` lets count; the ray goes on through the others. `cull_back` as in
    /// [`TriangleBvh::nearest_culled`]. `accept` must be a pure function; it may be asked about any hit, in any order.
    pub fn nearest_where(&self, ray: &Ray, cull_back: bool, accept: impl FnMut(&Hit) -> bool) -> Option<Hit> {
        self.search(ray, f32::INFINITY, &mut Stack::new(), |hit| hit.front || !cull_back, accept)
    }

    /// Whether the ray meets any triangle, from either side.
    pub fn any(&self, ray: &Ray) -> bool {
        self.meets(ray, &mut Stack::new(), |_| true, |_| true)
    }

    /// Whether the ray meets any triangle that `accept` lets count; see [`TriangleBvh::nearest_where`].
    pub fn any_where(&self, ray: &Ray, cull_back: bool, accept: impl FnMut(&Hit) -> bool) -> bool {
        self.meets(ray, &mut Stack::new(), |hit| hit.front || !cull_back, accept)
    }

    /// [`TriangleBvh::nearest`] of each ray, into the place of the same index; on the calling thread. Where the slices
    /// differ in length the rest of the longer one is left alone.
    pub fn nearest_batch(&self, rays: &[Ray], hits: &mut [Option<Hit>], _coherence: Coherence) {
        let mut stack = Stack::new();
        for (ray, hit) in rays.iter().zip(hits) {
            *hit = self.search(ray, f32::INFINITY, &mut stack, |_| true, |_| true);
        }
    }

    /// [`TriangleBvh::any`] of each ray; as [`TriangleBvh::nearest_batch`].
    pub fn any_batch(&self, rays: &[Ray], met: &mut [bool], _coherence: Coherence) {
        let mut stack = Stack::new();
        for (ray, met) in rays.iter().zip(met) {
            *met = self.meets(ray, &mut stack, |_| true, |_| true);
        }
    }

    /// The point of the mesh nearest to `point`, not farther than `max_distance`.
    pub fn nearest_point(&self, point: Vec3, max_distance: f32) -> Option<NearestPoint> {
        if !point.is_finite() || max_distance.is_nan() || max_distance < 0.0 {
            return None;
        }
        let mut best: Option<(f32, NearestPoint)> = None;
        self.tree.walk_near(point, max_distance * max_distance, |places, mut bound| {
            for Packed { corners, primitive } in &self.triangles[places] {
                let found = nearest_point(corners, point).point;
                let own = corners.bounds().distance_squared(point);
                let squared = (found - point).length_squared().max(own);
                let precedes = best.is_none_or(|(least, best)| {
                    squared < least || (squared == least && *primitive < best.primitive)
                });
                if squared <= bound && precedes {
                    bound = squared;
                    let nearest =
                        NearestPoint { point: found, distance: squared.sqrt(), primitive: *primitive };
                    best = Some((squared, nearest));
                }
            }
            bound
        });
        best.map(|(_, nearest)| nearest)
    }

    /// The nearest hit at or before `bound`. The bound only prunes: it changes no hit, as the ray's own `t_max` might.
    #[inline(always)]
    pub(crate) fn search(
        &self,
        ray: &Ray,
        bound: f32,
        stack: &mut Stack,
        faces: impl Fn(&Crossing) -> bool,
        mut accept: impl FnMut(&Hit) -> bool,
    ) -> Option<Hit> {
        let Prepared { slab, sheared } = Prepared::new(ray)?;
        let mut best: Option<Hit> = None;
        let bound = if bound < slab.t_max { bound } else { slab.t_max };
        self.tree.walk(&slab, bound, stack, |places, mut bound| {
            for packed in &self.triangles[places] {
                if let Some(hit) = packed.hit(&slab, &sheared, &faces)
                    && hit.precedes(best.as_ref(), bound)
                    && accept(&hit)
                {
                    bound = hit.t;
                    best = Some(hit);
                }
            }
            bound
        });
        best
    }

    /// Whether there is any accepted hit.
    #[inline(always)]
    pub(crate) fn meets(
        &self,
        ray: &Ray,
        stack: &mut Stack,
        faces: impl Fn(&Crossing) -> bool,
        mut accept: impl FnMut(&Hit) -> bool,
    ) -> bool {
        let Some(Prepared { slab, sheared }) = Prepared::new(ray) else { return false };
        let mut found = false;
        self.tree.walk(&slab, slab.t_max, stack, |places, bound| {
            let mut hits =
                self.triangles[places].iter().filter_map(|packed| packed.hit(&slab, &sheared, &faces));
            found = found || hits.any(|hit| accept(&hit));
            if found { f32::NEG_INFINITY } else { bound }
        });
        found
    }
}

impl Packed {
    /// Rules 1 and 2 of the theorem in [`slab`](crate::slab).
    #[inline(always)]
    fn hit(&self, slab: &SlabRay, sheared: &ShearedRay, faces: impl Fn(&Crossing) -> bool) -> Option<Hit> {
        let hit = sheared.hit(&self.corners).filter(faces)?;
        let t = slab.clamp(&self.corners.bounds(), hit.t)?;
        Some(Hit { t, u: hit.u, v: hit.v, primitive: self.primitive })
    }
}
