//! Two levels of trees against the loop over instances, and against one flat mesh.

use crate::adversarial::rays;
use crate::meshes::{self, Mesh};
use crate::random::Random;
use glam::{Affine3A, Mat3A, Vec3, vec3};
use luch_bvh::shape::{Disc, Frustum, Parallelogram, Plane, Sphere};
use luch_bvh::{
    Aabb, Coherence, Geometry, Instance, InstanceHit, Quality, Ray, SceneTree, Traced, TracedHit, TriangleBvh,
};
use std::sync::Arc;

pub(crate) fn bits(hit: Option<InstanceHit>) -> Option<[u32; 5]> {
    let bits = |InstanceHit { instance, hit }| {
        [instance, hit.primitive, f32::to_bits(hit.t), f32::to_bits(hit.u), f32::to_bits(hit.v)]
    };
    hit.map(bits)
}

fn triangles(mesh: &Mesh) -> Geometry {
    Geometry::Triangles(Arc::new(TriangleBvh::build(&mesh.positions, &mesh.triangles, Quality::Balanced)))
}

pub(crate) fn geometries() -> Vec<Geometry> {
    vec![
        triangles(&meshes::torus(16, 8)),
        triangles(&meshes::cube()),
        triangles(&meshes::soup(60, 3)),
        Geometry::Sphere(Sphere { center: vec3(0.2, 0.0, 0.0), radius: 0.7 }),
        Geometry::Frustum(Frustum { bottom_radius: 0.6, top_radius: 0.2, height: 1.1, capped: true }),
        Geometry::Frustum(Frustum { bottom_radius: 0.5, top_radius: 0.5, height: 0.8, capped: false }),
        Geometry::Traced(Arc::new(Shells)),
        Geometry::Disc(Disc { center: Vec3::ZERO, normal: vec3(0.2, 1.0, 0.1), radius: 0.8 }),
        Geometry::Parallelogram(Parallelogram {
            corner: -Vec3::ONE * 0.5,
            edge_u: Vec3::X,
            edge_v: vec3(0.3, 0.0, 1.0),
        }),
        Geometry::Plane(Plane { point: vec3(0.0, -3.0, 0.0), normal: vec3(0.05, 1.0, 0.0) }),
    ]
}

/// Spheres inside one another: up to six crossings of a ray.
#[derive(Debug)]
struct Shells;

impl Traced for Shells {
    fn bounds(&self) -> Aabb {
        Sphere { center: Vec3::ZERO, radius: 0.75 }.bounds()
    }

    fn nearest(&self, ray: &Ray) -> Option<TracedHit> {
        let shell = |primitive: u32| Sphere { center: Vec3::ZERO, radius: 0.25 * (primitive + 1) as f32 };
        let crossings = |primitive| {
            shell(primitive)
                .crossings(ray)
                .into_iter()
                .flatten()
                .map(move |crossing| TracedHit { crossing, primitive })
        };
        (0..3).flat_map(crossings).min_by(|one, other| one.crossing.t.total_cmp(&other.crossing.t))
    }
}

/// Mirrored, sheared, flattened to nothing, on top of one another, of geometries that do not exist.
pub(crate) fn instances(count: usize, seed: u64) -> Vec<Instance> {
    let mut random = Random::new(seed);
    let mut list: Vec<Instance> = Vec::new();
    for index in 0..count {
        let scale = vec3(random.signed(), random.signed(), random.signed() * 2.0);
        let turn = Mat3A::from_quat(random.rotation());
        let placement = match random.below(12) {
            0 => Affine3A::IDENTITY,
            1 => Affine3A::from_scale(vec3(1.0, 0.0, 1.0)),
            2 => Affine3A::from_scale(vec3(-1.0, 1.0, 1.0)),
            3 => Affine3A::from_translation(Vec3::NAN),
            4 => Affine3A::from_scale(Vec3::splat(1e-3)),
            // So ill-conditioned that hits are rounded out of the world box: clamping has work to do.
            6 | 7 => {
                let thin =
                    turn * Mat3A::from_diagonal(vec3(1.0, 1e-5, 2.0)) * Mat3A::from_quat(random.rotation());
                Affine3A { matrix3: thin, translation: (random.vector() * 3.0).into() }
            }
            5 if index > 0 => list[random.below(index)].placement,
            _ => Affine3A {
                matrix3: turn * Mat3A::from_diagonal(scale),
                translation: (random.vector() * 3.0).into(),
            },
        };
        let geometry = random.below(8) as u32;
        let geometry = if geometry == 6 && random.unit() < 0.7 { 0 } else { geometry };
        list.push(Instance {
            geometry,
            placement,
            cull_back: random.unit() < 0.3,
            filtered: random.unit() < 0.5,
        });
    }
    list
}

/// Half of the hits: a pure function.
pub(crate) fn filter(hit: &InstanceHit) -> bool {
    (hit.instance ^ hit.hit.primitive ^ hit.hit.t.to_bits()).is_multiple_of(2)
}

/// A tree for each instance alone, and the least `(t, instance)` of their answers.
pub(crate) struct Loop {
    alone: Vec<SceneTree>,
}

impl Loop {
    pub(crate) fn new(instances: &[Instance]) -> Self {
        let alone = |instance: &Instance| SceneTree::build(geometries(), &[*instance], Quality::Fast);
        Self { alone: instances.iter().map(alone).collect() }
    }

    pub(crate) fn nearest(
        &self,
        ray: &Ray,
        mut filter: impl FnMut(&InstanceHit) -> bool,
    ) -> Option<InstanceHit> {
        let mut best: Option<InstanceHit> = None;
        for (instance, tree) in (0..).zip(&self.alone) {
            let found = tree.nearest_filtered(ray, |hit| filter(&InstanceHit { instance, ..*hit }));
            let found = found.map(|hit| InstanceHit { instance, ..hit });
            if let Some(hit) = found
                && best.is_none_or(|best| hit.hit.t < best.hit.t)
            {
                best = found;
            }
        }
        best
    }
}

#[test]
fn as_the_loop_over_instances() {
    let list = instances(120, 51);
    let loops = Loop::new(&list);
    let mut rays = rays(&meshes::torus(16, 8), 25, 52);
    let mut random = Random::new(53);
    rays.extend((0..3_000).map(|_| Ray::new(random.vector() * 6.0, random.vector())));
    for quality in Quality::ALL {
        let tree = SceneTree::build(geometries(), &list, quality);
        let (mut found, mut stopped) = (0, 0);
        let mut hits = vec![None; rays.len()];
        let mut met = vec![false; rays.len()];
        tree.nearest_batch(&rays, &mut hits, Coherence::Incoherent);
        tree.any_batch(&rays, &mut met, Coherence::Incoherent);
        let mut filtered = vec![None; rays.len()];
        let mut met_filtered = vec![false; rays.len()];
        tree.nearest_filtered_batch(&rays, &mut filtered, Coherence::Coherent, |_, hit| filter(hit));
        tree.any_filtered_batch(&rays, &mut met_filtered, Coherence::Coherent, |_, hit| filter(hit));
        for (index, ray) in rays.iter().enumerate() {
            let nearest = bits(loops.nearest(ray, |_| true));
            let through = bits(loops.nearest(ray, filter));
            assert_eq!(bits(tree.nearest(ray)), nearest, "{ray:?}");
            assert_eq!(bits(tree.nearest_filtered(ray, filter)), through, "{ray:?}");
            assert_eq!(
                (tree.any(ray), tree.any_filtered(ray, filter)),
                (nearest.is_some(), through.is_some())
            );
            assert_eq!((bits(hits[index]), bits(filtered[index])), (nearest, through));
            assert_eq!((met[index], met_filtered[index]), (nearest.is_some(), through.is_some()));
            found += usize::from(nearest.is_some());
            stopped += usize::from(nearest != through);
        }
        assert!(found > 1_000 && stopped > 200, "{found} {stopped}");
    }
}

#[test]
fn of_equal_instances_the_first_is_hit() {
    let same = Instance { geometry: 1, placement: Affine3A::IDENTITY, cull_back: false, filtered: false };
    let mut list = vec![Instance { geometry: 9, ..same }];
    list.extend([same; 20]);
    for quality in Quality::ALL {
        let tree = SceneTree::build(geometries(), &list, quality);
        let mut random = Random::new(54);
        for _ in 0..500 {
            let hit = tree.nearest(&Ray::new(random.vector() * 0.9, random.vector())).unwrap();
            assert_eq!(hit.instance, 1);
        }
    }
}

#[test]
fn as_one_flat_mesh_up_to_rounding() {
    let torus = meshes::torus(16, 8);
    let mut list = instances(60, 55);
    list.retain(|instance| {
        let size = instance.placement.matrix3.determinant().abs();
        instance.placement.is_finite() && size > 1e-2
    });
    for instance in &mut list {
        *instance = Instance { geometry: 0, cull_back: false, ..*instance };
    }
    let mut flat = Mesh::new("flat", Vec::new(), Vec::new());
    for instance in &list {
        let first = flat.positions.len() as u32;
        flat.positions.extend(torus.positions.iter().map(|p| instance.placement.transform_point3(*p)));
        flat.triangles.extend(torus.triangles.iter().map(|t| t.map(|corner| corner + first)));
    }
    let tree = SceneTree::build(geometries(), &list, Quality::Balanced);
    let one = TriangleBvh::build(&flat.positions, &flat.triangles, Quality::Balanced);
    let mut random = Random::new(56);
    let (mut hits, mut different) = (0, 0);
    for _ in 0..20_000 {
        let origin = random.vector() * 6.0;
        let ray = Ray::new(origin, (random.vector() * 2.0 - origin).normalize());
        match (tree.nearest(&ray), one.nearest(&ray)) {
            (Some(two_level), Some(flat)) if (two_level.hit.t - flat.t).abs() < 1e-4 => hits += 1,
            (None, None) => {}
            // A rim met in one and missed by rounding in the other.
            _ => different += 1,
        }
    }
    assert!(hits > 5_000 && different < 10, "{hits} {different}");
}

#[test]
fn a_mirrored_copy_keeps_its_outside() {
    for scale in [Vec3::ONE, vec3(-1.0, 1.0, 1.0), vec3(-2.0, -0.5, -1.0)] {
        let instance = Instance {
            geometry: 1,
            placement: Affine3A::from_scale(scale),
            cull_back: true,
            filtered: false,
        };
        let tree = SceneTree::build(geometries(), &[instance], Quality::Balanced);
        let direction = vec3(0.3, -0.2, 0.9);
        assert_eq!(tree.nearest(&Ray::new(Vec3::ZERO, direction)), None);
        assert!(tree.nearest(&Ray::new(direction * -9.0, direction)).is_some());
    }
}

#[test]
fn a_filtered_sphere_is_left_through_its_back() {
    let instance = Instance { geometry: 3, placement: Affine3A::IDENTITY, cull_back: false, filtered: true };
    let tree = SceneTree::build(geometries(), &[instance], Quality::Balanced);
    let ray = Ray::new(vec3(-4.5, 0.0, 0.0), Vec3::X);
    let near = tree.nearest(&ray).unwrap().hit.t;
    assert!((near - 4.0).abs() < 1e-5);
    let far = tree.nearest_filtered(&ray, |hit| hit.hit.t > 4.5).unwrap().hit.t;
    assert!((far - 5.4).abs() < 1e-5);
    assert!(!tree.any_filtered(&ray, |_| false));
}
