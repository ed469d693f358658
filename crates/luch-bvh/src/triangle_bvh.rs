//! A tree over triangles, each kept where its leaf finds it.

use crate::build::{Item, Quality, build_wide, items};
use crate::simd::{Block, Isa, Kernel, Mesh, Stack, any_in_mesh, launch, nearest_in_mesh};
use crate::tree::{Statistics, Tree};
use crate::triangle::{Triangle, TriangleClip, nearest_point};
use crate::{Aabb, Coherence, Hit, NearestPoint, Ray};
use glam::Vec3;
use rayon::prelude::*;

/// A tree over the triangles of a mesh.
///
/// Triangles with an index out of range or a corner that is not finite are left out and never hit.
#[derive(Clone, Debug)]
pub struct TriangleBvh {
    mesh: Mesh,
}

impl TriangleBvh {
    /// Builds the tree on as many threads as the rayon pool has; the result is the same for any number of them.
    /// Each triangle names its three corners, counter-clockwise seen from outside; at most 2³² triangles.
    pub fn build(positions: &[Vec3], triangles: &[[u32; 3]], quality: Quality) -> Self {
        let triangles = &triangles[..triangles.len().min(u32::MAX as usize)];
        let item = |primitive: usize| {
            let triangle = Triangle::of_mesh(positions, triangles[primitive]).filter(Triangle::is_finite)?;
            Item::new(&triangle.bounds(), primitive as u32)
        };
        let corners = |primitive: u32| {
            let [a, b, c] = triangles[primitive as usize].map(|corner| positions[corner as usize]);
            Triangle { a, b, c }
        };
        let wide = build_wide(items(triangles.len(), item), quality, Some(&TriangleClip(corners)));
        let blocks = wide.leaves.par_iter().map(|leaf| Block::new(*leaf, corners)).collect();
        Self { mesh: Mesh::new(Tree::new(wide), blocks) }
    }

    /// The box of all triangles, a little too large: see [`Triangle::bounds`].
    pub fn bounds(&self) -> Aabb {
        self.mesh.tree().bounds()
    }

    /// The size and worth of the tree.
    pub fn statistics(&self) -> Statistics {
        let blocks = self.mesh.blocks();
        self.mesh.tree().statistics(|leaf| blocks[leaf].triangles().count(), size_of_val(blocks))
    }

    /// The nearest hit from either side; of equally near ones that of the lowest triangle.
    pub fn nearest(&self, ray: &Ray) -> Option<Hit> {
        nearest(&self.mesh, ray, false, None)
    }

    /// The nearest hit from outside: triangles that turn their back are passed through.
    ///
    /// Right only for closed meshes seen from outside and through nothing transparent.
    pub fn nearest_culled(&self, ray: &Ray) -> Option<Hit> {
        nearest(&self.mesh, ray, true, None)
    }

    /// The nearest hit that `accept` lets count; the ray goes on through the others. `cull_back` as in
    /// [`TriangleBvh::nearest_culled`]. `accept` must be a pure function; it may be asked about any hit, in any order.
    pub fn nearest_where(
        &self,
        ray: &Ray,
        cull_back: bool,
        mut accept: impl FnMut(&Hit) -> bool,
    ) -> Option<Hit> {
        nearest(&self.mesh, ray, cull_back, Some(&mut accept))
    }

    /// Whether the ray meets any triangle, from either side.
    pub fn any(&self, ray: &Ray) -> bool {
        any(&self.mesh, ray, false, None)
    }

    /// Whether the ray meets any triangle that `accept` lets count; see [`TriangleBvh::nearest_where`].
    pub fn any_where(&self, ray: &Ray, cull_back: bool, mut accept: impl FnMut(&Hit) -> bool) -> bool {
        any(&self.mesh, ray, cull_back, Some(&mut accept))
    }

    /// [`TriangleBvh::nearest`] of each ray, into the place of the same index; on the calling thread. Where the slices
    /// differ in length the rest of the longer one is left alone.
    pub fn nearest_batch(&self, rays: &[Ray], hits: &mut [Option<Hit>], coherence: Coherence) {
        let rays = &rays[..rays.len().min(hits.len())];
        nearest_in_mesh(&self.mesh, rays, coherence, &mut |index, hit| hits[index] = hit);
    }

    /// [`TriangleBvh::any`] of each ray; as [`TriangleBvh::nearest_batch`].
    pub fn any_batch(&self, rays: &[Ray], met: &mut [bool], coherence: Coherence) {
        let rays = &rays[..rays.len().min(met.len())];
        any_in_mesh(&self.mesh, rays, coherence, &mut |index, hit| met[index] = hit.is_some());
    }

    /// The point of the mesh nearest to `point`, not farther than `max_distance`.
    pub fn nearest_point(&self, point: Vec3, max_distance: f32) -> Option<NearestPoint> {
        if !point.is_finite() || max_distance.is_nan() || max_distance < 0.0 {
            return None;
        }
        let mut best: Option<(f32, NearestPoint)> = None;
        self.mesh.tree().walk_near(point, max_distance * max_distance, |leaf, mut bound| {
            for (primitive, corners) in self.mesh.blocks()[leaf].triangles() {
                let found = nearest_point(&corners, point).point;
                let own = corners.bounds().distance_squared(point);
                let squared = (found - point).length_squared().max(own);
                let precedes = best.is_none_or(|(least, best)| {
                    squared < least || (squared == least && primitive < best.primitive)
                });
                if squared <= bound && precedes {
                    bound = squared;
                    let nearest = NearestPoint { point: found, distance: squared.sqrt(), primitive };
                    best = Some((squared, nearest));
                }
            }
            bound
        });
        best.map(|(_, nearest)| nearest)
    }

    /// The packed triangles and their tree.
    pub(crate) fn mesh(&self) -> &Mesh {
        &self.mesh
    }
}

/// What lets a hit count. It is asked through a `dyn`, so that the kernels are compiled once, in this crate; `None` for all.
type Accept<'f> = Option<&'f mut dyn FnMut(&Hit) -> bool>;

#[inline(never)]
fn nearest<'a>(mesh: &'a Mesh, ray: &'a Ray, cull_back: bool, accept: Accept<'a>) -> Option<Hit> {
    launch(Nearest { mesh, ray, cull_back, accept })
}

#[inline(never)]
fn any<'a>(mesh: &'a Mesh, ray: &'a Ray, cull_back: bool, accept: Accept<'a>) -> bool {
    launch(Any { mesh, ray, cull_back, accept })
}

struct Nearest<'a> {
    mesh: &'a Mesh,
    ray: &'a Ray,
    cull_back: bool,
    accept: Accept<'a>,
}

impl Kernel for Nearest<'_> {
    type Output = Option<Hit>;
    #[inline(always)]
    fn run<I: Isa>(self) -> Option<Hit> {
        let Self { mesh, ray, cull_back, mut accept } = self;
        let accept = |hit: &Hit| accept.as_mut().is_none_or(|accept| accept(hit));
        mesh.nearest::<I>(ray, f32::INFINITY, &mut Stack::new(), cull_back, accept)
    }
}

struct Any<'a> {
    mesh: &'a Mesh,
    ray: &'a Ray,
    cull_back: bool,
    accept: Accept<'a>,
}

impl Kernel for Any<'_> {
    type Output = bool;
    #[inline(always)]
    fn run<I: Isa>(self) -> bool {
        let Self { mesh, ray, cull_back, mut accept } = self;
        let accept = |hit: &Hit| accept.as_mut().is_none_or(|accept| accept(hit));
        mesh.any::<I>(ray, &mut Stack::new(), cull_back, accept)
    }
}
