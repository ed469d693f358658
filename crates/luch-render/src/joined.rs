//! Meshes that stand in one place only, as one mesh in world coordinates: most scenes then need one tree, not two levels of them.

use glam::{Affine3A, Vec3};
use luch_bvh::{InstanceHit, Quality, TriangleBvh};
use luch_scene::{Scene, Shape};
use std::sync::Arc;

/// Which instances were joined, and where their triangles begin.
#[derive(Debug)]
pub(crate) struct Joined {
    /// In increasing order.
    pub(crate) instances: Vec<u32>,
    /// For each of them its first triangle in the joined mesh.
    first_triangles: Vec<u32>,
}

impl Joined {
    /// Joins the meshes that one instance alone refers to and that need no questions asked of each hit.
    pub(crate) fn choose(scene: &Scene, placed: &[luch_bvh::Instance]) -> Self {
        let mut users = vec![0u32; scene.shapes.len()];
        for instance in &scene.instances {
            users[instance.shape.index()] += 1;
        }
        let (mut instances, mut first_triangles) = (Vec::new(), Vec::new());
        let (mut count, mut positions) = (0u32, 0u32);
        for (i, (instance, placed)) in scene.instances.iter().zip(placed).enumerate() {
            let Shape::Mesh(mesh) = &*scene.shapes[instance.shape.index()] else { continue };
            let alone = users[instance.shape.index()] == 1 && !placed.filtered && !placed.cull_back;
            let after =
                |so_far: u32, more: usize| u32::try_from(more).ok().and_then(|more| so_far.checked_add(more));
            let ends = after(count, mesh.triangles.len()).zip(after(positions, mesh.positions.len()));
            if let (true, Some((end, last))) = (alone, ends) {
                instances.push(i as u32);
                first_triangles.push(count);
                (count, positions) = (end, last);
            }
        }
        Self { instances, first_triangles }
    }

    /// The tree over the joined triangles.
    pub(crate) fn geometry(&self, scene: &Scene) -> luch_bvh::Geometry {
        let build = |positions: &[Vec3], triangles: &[[u32; 3]]| {
            luch_bvh::Geometry::Triangles(Arc::new(TriangleBvh::build(
                positions,
                triangles,
                Quality::Balanced,
            )))
        };
        // A mesh that stands where it was made needs no copy.
        if let [only] = self.instances[..]
            && let instance = &scene.instances[only as usize]
            && instance.placement == Affine3A::IDENTITY
            && let Shape::Mesh(mesh) = &*scene.shapes[instance.shape.index()]
        {
            return build(&mesh.positions, &mesh.triangles);
        }
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        for &instance in &self.instances {
            let instance = &scene.instances[instance as usize];
            let Shape::Mesh(mesh) = &*scene.shapes[instance.shape.index()] else { continue };
            let first = positions.len() as u32;
            positions.extend(mesh.positions.iter().map(|&p| instance.placement.transform_point3(p)));
            triangles.extend(mesh.triangles.iter().map(|t| t.map(|corner| corner + first)));
        }
        build(&positions, &triangles)
    }

    /// A hit of the joined mesh, told by the scene's instance and its own triangle.
    pub(crate) fn in_scene(&self, mut hit: InstanceHit) -> InstanceHit {
        let place = self.first_triangles.partition_point(|first| *first <= hit.hit.primitive) - 1;
        hit.instance = self.instances[place];
        hit.hit.primitive -= self.first_triangles[place];
        hit
    }
}
