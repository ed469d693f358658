//! The loop over all triangles: the reference every tree must equal, bit for bit.

use crate::triangle::{ShearedRay, Triangle, cramer};
use crate::{Aabb, Coherence, Crossing, Hit, Ray, SlabRay};
use glam::Vec3;

/// Which test decides whether a ray meets a triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum TriangleTest {
    /// No ray slips through a shared edge: [`ShearedRay`]. What trees use.
    #[default]
    Watertight,
    /// The textbook's: [`cramer`].
    Cramer,
}

/// All triangles of a mesh, tested one after the other; the hit with the least `t` wins.
///
/// Has the queries of [`TriangleBvh`](crate::TriangleBvh), and with [`TriangleTest::Watertight`] the same answers.
#[derive(Clone, Debug)]
pub struct BruteForce {
    triangles: Vec<(u32, Triangle)>,
    bounds: Aabb,
    test: TriangleTest,
}

impl BruteForce {
    /// Takes the triangles as [`TriangleBvh::build`](crate::TriangleBvh::build) does.
    pub fn new(positions: &[Vec3], triangles: &[[u32; 3]], test: TriangleTest) -> Self {
        let kept = |(primitive, corners): (u32, &[u32; 3])| {
            let triangle = Triangle::of_mesh(positions, *corners).filter(Triangle::is_finite)?;
            Some((primitive, triangle))
        };
        let triangles: Vec<_> = (0..u32::MAX).zip(triangles).filter_map(kept).collect();
        let bounds = triangles.iter().fold(Aabb::empty(), |all, (_, triangle)| all.union(&triangle.bounds()));
        Self { triangles, bounds, test }
    }

    /// The box of all triangles.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// The nearest hit from either side; of equally near ones that of the lowest triangle.
    pub fn nearest(&self, ray: &Ray) -> Option<Hit> {
        self.nearest_where(ray, false, |_| true)
    }

    /// The nearest hit from outside.
    pub fn nearest_culled(&self, ray: &Ray) -> Option<Hit> {
        self.nearest_where(ray, true, |_| true)
    }

    /// The nearest hit that `accept` lets count.
    pub fn nearest_where(
        &self,
        ray: &Ray,
        cull_back: bool,
        mut accept: impl FnMut(&Hit) -> bool,
    ) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        for hit in self.hits(ray, cull_back) {
            if best.is_none_or(|best| hit.t < best.t) && accept(&hit) {
                best = Some(hit);
            }
        }
        best
    }

    /// Whether the ray meets any triangle.
    pub fn any(&self, ray: &Ray) -> bool {
        self.hits(ray, false).next().is_some()
    }

    /// Whether the ray meets any triangle that `accept` lets count.
    pub fn any_where(&self, ray: &Ray, cull_back: bool, mut accept: impl FnMut(&Hit) -> bool) -> bool {
        self.hits(ray, cull_back).any(|hit| accept(&hit))
    }

    /// [`BruteForce::nearest`] of each ray.
    pub fn nearest_batch(&self, rays: &[Ray], hits: &mut [Option<Hit>], _coherence: Coherence) {
        for (ray, hit) in rays.iter().zip(hits) {
            *hit = self.nearest(ray);
        }
    }

    /// [`BruteForce::any`] of each ray.
    pub fn any_batch(&self, rays: &[Ray], met: &mut [bool], _coherence: Coherence) {
        for (ray, met) in rays.iter().zip(met) {
            *met = self.any(ray);
        }
    }

    /// Every hit, in the order of the triangles, clamped as the theorem in [`slab`](crate::slab) demands.
    pub fn hits(&self, ray: &Ray, cull_back: bool) -> impl Iterator<Item = Hit> {
        let (ray, test) = (*ray, self.test);
        let prepared = SlabRay::new(&ray).zip(ShearedRay::new(&ray));
        prepared.into_iter().flat_map(move |(slab, sheared)| {
            self.triangles.iter().filter_map(move |(primitive, triangle)| {
                let raw: Option<Crossing> = match test {
                    TriangleTest::Watertight => sheared.hit(triangle),
                    TriangleTest::Cramer => cramer(&ray, triangle),
                };
                let hit = raw.filter(|hit| hit.front || !cull_back)?;
                let t = slab.clamp(&triangle.bounds(), hit.t)?;
                Some(Hit { t, u: hit.u, v: hit.v, primitive: *primitive })
            })
        })
    }
}
