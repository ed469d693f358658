//! A tree per mesh, a tree of instances: nearest hits and visibility for batches of rays.

use crate::joined::Joined;
use crate::place::Place;
use crate::traced;
use glam::{Mat3, Vec3};
use luch_bvh::{Aabb, Coherence, InstanceHit, Quality, Ray, SceneTree, TriangleBvh, shape};
use luch_sampling::hash;
use luch_scene::{Instance, Normals, Opacity, Projection, Scene, Shape, Sides};
use rayon::prelude::*;
use std::sync::Arc;

/// Everything of a scene that can be hit.
///
/// Meshes that stand in one place only share one tree in world coordinates; the others are reached through instances.
#[derive(Debug)]
pub struct Geometry {
    tree: SceneTree,
    joined: Joined,
    /// For each instance of the tree past the joined one its place in the scene.
    others: Vec<u32>,
    /// For each instance the inverse transpose of its placement: it takes normals to the world and keeps outside outside.
    normal_maps: Vec<Mat3>,
    bounds: Aabb,
    /// Whether every surface that is hit is there: nothing is decided by chance.
    certain: bool,
}

impl Geometry {
    /// Builds the trees.
    pub(crate) fn build(scene: &Scene) -> Self {
        let closed: Vec<bool> = match scene.settings.cull_back_faces {
            true => scene.shapes.par_iter().map(|shape| is_closed(shape)).collect(),
            false => vec![false; scene.shapes.len()],
        };
        let placed: Vec<_> =
            scene.instances.iter().map(|i| placed(scene, i, closed[i.shape.index()])).collect();
        let joined = Joined::choose(scene, &placed);
        let others: Vec<u32> = (0..scene.instances.len() as u32)
            .filter(|i| joined.instances.binary_search(i).is_err())
            .collect();

        // Geometry 0 is the joined one; the shapes follow, those that nobody refers to any more left empty.
        let mut needed = vec![false; scene.shapes.len()];
        for &other in &others {
            needed[scene.instances[other as usize].shape.index()] = true;
        }
        let empty =
            || luch_bvh::Geometry::Triangles(Arc::new(TriangleBvh::build(&[], &[], Quality::Balanced)));
        let mut geometries = vec![joined.geometry(scene)];
        geometries.par_extend(
            scene
                .shapes
                .par_iter()
                .zip(needed)
                .map(|(shape, needed)| if needed { geometry_of(shape) } else { empty() }),
        );
        let whole = luch_bvh::Instance {
            geometry: 0,
            placement: glam::Affine3A::IDENTITY,
            cull_back: false,
            filtered: false,
        };
        let mut instances = vec![whole];
        instances.extend(others.iter().map(|&other| placed[other as usize]));
        let certain = instances.iter().all(|instance| !instance.filtered);
        let tree = SceneTree::build(geometries, &instances, Quality::Balanced);
        let normal_map = |i: &Instance| Mat3::from(i.placement.matrix3).inverse().transpose();
        let bounds = tree.bounds();
        Self {
            tree,
            joined,
            others,
            normal_maps: scene.instances.iter().map(normal_map).collect(),
            bounds,
            certain,
        }
    }

    /// A box around everything that is bounded.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// Whether rays that differ in their random numbers alone meet the same: no surface is only partly there.
    pub(crate) fn is_certain(&self) -> bool {
        self.certain
    }

    /// Takes normals of an instance to the world.
    pub(crate) fn normal_map(&self, instance: u32) -> &Mat3 {
        &self.normal_maps[instance as usize]
    }

    /// The nearest hit of each ray. `key` gives a random number for each ray, from which surfaces that are partly
    /// there decide whether they stop it.
    pub fn nearest_hits(
        &self,
        scene: &Scene,
        rays: &[Ray],
        hits: &mut [Option<InstanceHit>],
        coherence: Coherence,
        key: impl Fn(usize) -> u64,
    ) {
        let stops =
            |ray: usize, hit: &InstanceHit| self.stops(scene, &rays[ray], &self.in_scene(*hit), || key(ray));
        self.tree.nearest_filtered_batch(rays, hits, coherence, stops);
        for hit in hits.iter_mut().flatten() {
            *hit = self.in_scene(*hit);
        }
    }

    /// Whether something stands in the way of each ray; `key` as in [`Geometry::nearest_hits`].
    pub fn occluded(
        &self,
        scene: &Scene,
        rays: &[Ray],
        occluded: &mut [bool],
        coherence: Coherence,
        key: impl Fn(usize) -> u64,
    ) {
        let stops =
            |ray: usize, hit: &InstanceHit| self.stops(scene, &rays[ray], &self.in_scene(*hit), || key(ray));
        self.tree.any_filtered_batch(rays, occluded, coherence, stops);
    }

    /// The nearest hit of one ray.
    pub fn nearest_hit(&self, scene: &Scene, ray: &Ray, key: u64) -> Option<InstanceHit> {
        let hit = self.tree.nearest_filtered(ray, |hit| self.stops(scene, ray, &self.in_scene(*hit), || key));
        hit.map(|hit| self.in_scene(hit))
    }

    /// A hit of the tree, told by the scene's instances and their primitives.
    fn in_scene(&self, hit: InstanceHit) -> InstanceHit {
        match hit.instance.checked_sub(1) {
            None => self.joined.in_scene(hit),
            Some(other) => InstanceHit { instance: self.others[other as usize], ..hit },
        }
    }

    /// Whether a surface that is not there everywhere stops the ray: a pure function of ray, hit and key.
    fn stops(&self, scene: &Scene, ray: &Ray, hit: &InstanceHit, key: impl Fn() -> u64) -> bool {
        let instance = &scene.instances[hit.instance as usize];
        let local = match *scene.shapes[instance.shape.index()] {
            Shape::Mesh(_) => Vec3::ZERO,
            _ => instance.placement.inverse().transform_point3(ray.at(hit.hit.t)),
        };
        let place = Place::of_hit(scene, hit, local);
        let material = &scene.materials[place.material_id().index()];
        if material.sides == Sides::Front {
            let normal = *self.normal_map(hit.instance) * local_normal(&place);
            if normal.dot(ray.direction) > 0.0 {
                return false;
            }
        }
        let opacity = place.opacity(material);
        if opacity >= 1.0 || opacity <= 0.0 {
            return opacity >= 1.0;
        }
        let id = u64::from(hit.instance) << 32 | u64::from(hit.hit.primitive);
        let chance = hash::combine(hash::combine(key(), id), u64::from(hit.hit.t.to_bits()));
        hash::unit_f32((chance >> 32) as u32) < opacity
    }
}

/// The geometric normal in the shape's coordinates, of any length.
pub(crate) fn local_normal(place: &Place) -> Vec3 {
    match place.shape {
        Shape::Mesh(mesh) => mesh.area_normal(place.primitive),
        Shape::Sphere { .. } => place.local,
        Shape::Disc { .. } | Shape::Plane => Vec3::Y,
        Shape::Traced(form) => traced::normal(form, place),
    }
}

fn geometry_of(shape: &Shape) -> luch_bvh::Geometry {
    match shape {
        Shape::Mesh(mesh) => {
            let tree = TriangleBvh::build(&mesh.positions, &mesh.triangles, Quality::Balanced);
            luch_bvh::Geometry::Triangles(Arc::new(tree))
        }
        Shape::Sphere { radius } => {
            luch_bvh::Geometry::Sphere(shape::Sphere { center: Vec3::ZERO, radius: *radius })
        }
        Shape::Disc { radius } => {
            luch_bvh::Geometry::Disc(shape::Disc { center: Vec3::ZERO, normal: Vec3::Y, radius: *radius })
        }
        Shape::Plane => luch_bvh::Geometry::Plane(shape::Plane { point: Vec3::ZERO, normal: Vec3::Y }),
        Shape::Traced(form) => traced::geometry(form),
    }
}

fn is_closed(shape: &Shape) -> bool {
    match shape {
        Shape::Mesh(mesh) => {
            luch_mesh::measure::closedness(mesh).is_closed() && luch_mesh::measure::volume(mesh) > 0.0
        }
        Shape::Sphere { .. } => true,
        Shape::Disc { .. } | Shape::Plane => false,
        Shape::Traced(form) => form.is_closed(),
    }
}

fn placed(scene: &Scene, instance: &Instance, closed: bool) -> luch_bvh::Instance {
    let materials = || instance.materials.iter().map(|m| &scene.materials[m.index()]);
    let all_front = materials().all(|m| m.sides == Sides::Front);
    let any_front = materials().any(|m| m.sides == Sides::Front);
    let cut_out = materials().any(|m| m.opacity != Opacity::Opaque);
    // Lecture 84: faces seen from behind are skipped where no ray can meet them first anyway.
    let hidden =
        closed && !cut_out && !materials().any(|m| transmits(scene, m)) && no_camera_inside(scene, instance);
    luch_bvh::Instance {
        geometry: instance.shape.index() as u32 + 1,
        placement: instance.placement,
        cull_back: all_front || hidden,
        filtered: cut_out || (any_front && !all_front),
    }
}

/// Whether light comes through the surface, so that rays may start behind it.
fn transmits(scene: &Scene, material: &luch_scene::Material) -> bool {
    use luch_scene::Surface;
    match &material.surface {
        Surface::Dielectric { .. } => true,
        Surface::Principled(p) => p.transmission.factor > 0.0,
        Surface::Mix { first, second, .. } => {
            [first, second].into_iter().any(|part| transmits(scene, &scene.materials[part.index()]))
        }
        Surface::Absorber
        | Surface::Diffuse { .. }
        | Surface::Conductor { .. }
        | Surface::Phong { .. }
        | Surface::Glossy { .. } => false,
    }
}

fn no_camera_inside(scene: &Scene, instance: &Instance) -> bool {
    let bounds = match &*scene.shapes[instance.shape.index()] {
        Shape::Mesh(mesh) => Aabb::of_points(mesh.positions.iter().copied()),
        Shape::Sphere { radius } => Aabb::of_points([Vec3::splat(-radius), Vec3::splat(*radius)]),
        Shape::Disc { .. } | Shape::Plane => return false,
        Shape::Traced(form) => traced::bounds(form),
    };
    let bounds = bounds.transformed(&instance.placement);
    scene.cameras.iter().all(|named| {
        let camera = &named.camera;
        let reach = Vec3::splat(camera.lens_radius);
        let grown = Aabb::of_points([bounds.min - reach, bounds.max + reach]);
        matches!(camera.projection, Projection::Perspective { .. }) && !grown.contains(camera.position)
    })
}

/// Whether corner normals are interpolated, by the scene's settings.
pub(crate) fn is_smooth(scene: &Scene) -> bool {
    scene.settings.normals == Normals::Interpolated
}
