//! The flat lamps of a glowing mesh: triangles, and parallelograms where two of them make one.

use crate::emitter::FlatLamp;
use glam::{Mat3, Vec3};
use luch_mesh::TriangleMesh;
use luch_scene::{Emission, Id, Material, Scene};

/// With no more triangles each is compared with all; otherwise only with the next, which is where exporters put the other half.
const FEW: usize = 64;

/// The lamps of an instance of a mesh.
pub(crate) struct MeshLamps {
    pub(crate) lamps: Vec<FlatLamp>,
    /// For each triangle its lamp.
    pub(crate) places: Vec<Option<u32>>,
}

/// A triangle that shines.
struct Glowing {
    triangle: u32,
    corners: [Vec3; 3],
    lamp: FlatLamp,
}

/// Finds the lamps, at most `most`; `emission` tells what the triangles of a slot emit.
pub(crate) fn mesh_lamps(
    scene: &Scene,
    mesh: &TriangleMesh,
    index: u32,
    most: usize,
    emission: impl Fn(u16) -> Option<(Id<Material>, Emission)>,
) -> MeshLamps {
    let placement = &scene.instances[index as usize].placement;
    let normal_map = Mat3::from(placement.matrix3).inverse().transpose();
    let glowing = (0..mesh.triangles.len()).filter_map(|triangle| {
        let (material, emission) = emission(mesh.slot(triangle))?;
        let corners = mesh.corners(triangle).map(|corner| placement.transform_point3(corner));
        let outward = normal_map * mesh.area_normal(triangle);
        let triangle = triangle as u32;
        let lamp = FlatLamp::triangle(scene, corners, outward, index, triangle, material, &emission)?;
        Some(Glowing { triangle, corners, lamp })
    });
    let glowing: Vec<Glowing> = glowing.take(most).collect();
    let mut places = vec![None; mesh.triangles.len()];
    let mut lamps = Vec::with_capacity(glowing.len());
    for (i, first) in glowing.iter().enumerate() {
        if places[first.triangle as usize].is_some() {
            continue;
        }
        let reach = if glowing.len() <= FEW { glowing.len() } else { glowing.len().min(i + 2) };
        let pair = glowing[i + 1..reach]
            .iter()
            .filter(|second| places[second.triangle as usize].is_none())
            .find_map(|second| {
                Some((second.triangle, first.lamp.joined(first.corners, &second.lamp, second.corners)?))
            });
        let lamp = lamps.len() as u32;
        places[first.triangle as usize] = Some(lamp);
        match pair {
            Some((second, joined)) => {
                places[second as usize] = Some(lamp);
                lamps.push(joined);
            }
            None => lamps.push(first.lamp),
        }
    }
    MeshLamps { lamps, places }
}
