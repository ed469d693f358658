//! Rays in bulk, through luch-bvh.

use luch_bvh::{Coherence, Hit, Quality, Ray, TriangleBvh};
use rayon::prelude::*;

use crate::TriangleMesh;

/// A mesh made ready for rays. The watertight test leaves no cracks between triangles.
pub struct Rays {
    tree: TriangleBvh,
}

/// Rays that are traced together.
const BATCH: usize = 1024;

impl Rays {
    /// Builds the tree.
    pub fn new(mesh: &TriangleMesh) -> Self {
        Self { tree: TriangleBvh::build(&mesh.positions, &mesh.triangles, Quality::Balanced) }
    }

    /// The first hit of each ray, from either side; of equally near triangles the lowest.
    pub fn first_hits(&self, rays: &[Ray]) -> Vec<Option<Hit>> {
        let mut hits = vec![None; rays.len()];
        hits.par_chunks_mut(BATCH).zip(rays.par_chunks(BATCH)).for_each(|(hits, rays)| {
            self.tree.nearest_batch(rays, hits, Coherence::Incoherent);
        });
        hits
    }

    /// Whether each ray meets anything.
    pub fn is_met(&self, rays: &[Ray]) -> Vec<bool> {
        let mut met = vec![false; rays.len()];
        met.par_chunks_mut(BATCH).zip(rays.par_chunks(BATCH)).for_each(|(met, rays)| {
            self.tree.any_batch(rays, met, Coherence::Incoherent);
        });
        met
    }

    /// All hits of each ray, by distance, then by triangle. A ray through an edge or corner hits the triangle on one side of it
    /// only, or both: counts of crossings are exact only where rays pass through the inside of triangles.
    pub fn all_hits(&self, rays: &[Ray]) -> Vec<Vec<Hit>> {
        rays.par_iter().map(|ray| self.hits_of(ray)).collect()
    }

    fn hits_of(&self, ray: &Ray) -> Vec<Hit> {
        let mut hits: Vec<Hit> = Vec::new();
        // Every hit is asked about and none accepted, so the ray goes on to its end; a triangle may be in several leaves.
        self.tree.nearest_where(ray, false, |hit| {
            hits.push(*hit);
            false
        });
        hits.sort_by(|one, other| one.t.total_cmp(&other.t).then(one.primitive.cmp(&other.primitive)));
        hits.dedup_by_key(|hit| hit.primitive);
        hits
    }
}
