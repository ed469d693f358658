//! Faces that algorithms can rely on.

use crate::PolygonMesh;
use crate::polygon_mesh::CornerAttribute;

/// A mesh whose faces have at least three corners, all different, with indices in range and finite positions, and no
/// holes; and where they come from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sound {
    /// The mesh. Positions are those of before.
    pub mesh: PolygonMesh,
    /// For each face the face it comes from.
    pub faces: Vec<u32>,
    /// How many faces gave none.
    pub dropped_faces: usize,
}

/// Makes all faces sound: corners that repeat the one before are left out, faces with holes or that pass through a
/// vertex twice become triangles, faces with fewer than three corners or without finite positions are dropped. Attributes whose lists
/// do not fit are dropped; so are creases and sharp vertices that name no position or have no sharpness.
pub fn sound(mesh: &PolygonMesh) -> Sound {
    let positions = mesh.positions.len();
    let is_usable = |vertex: u32| mesh.positions.get(vertex as usize).is_some_and(|p| p.is_finite());
    let mut triangulation = None;
    let mut result = Sound::default();
    // Corners of before, face by face.
    let mut kept: Vec<u32> = Vec::with_capacity(mesh.corners.len());
    let mut ends: Vec<u32> = Vec::with_capacity(mesh.face_count());
    let mut seen: Vec<u32> = Vec::new();
    for face in 0..mesh.face_count() {
        let corners = mesh.face(face);
        let before = ends.len();
        if mesh.corners[corners.clone()].iter().all(|&vertex| is_usable(vertex)) {
            let start = kept.len();
            for corner in corners.clone() {
                let vertex = mesh.corners[corner];
                if kept.len() == start || mesh.corners[kept[kept.len() - 1] as usize] != vertex {
                    kept.push(corner as u32);
                }
            }
            let vertex_at = |place: usize, kept: &[u32]| mesh.corners[kept[place] as usize];
            while kept.len() > start + 1 && vertex_at(kept.len() - 1, &kept) == vertex_at(start, &kept) {
                kept.pop();
            }
            seen.clear();
            seen.extend(kept[start..].iter().map(|&corner| mesh.corners[corner as usize]));
            seen.sort_unstable();
            let has_holes = mesh.holes.binary_search_by_key(&(face as u32), |hole| hole.face).is_ok();
            if has_holes || seen.windows(2).any(|pair| pair[0] == pair[1]) {
                kept.truncate(start);
                let triangulation = triangulation.get_or_insert_with(|| mesh.triangulation());
                let first = triangulation.faces.partition_point(|&from| (from as usize) < face);
                let last = triangulation.faces.partition_point(|&from| (from as usize) <= face);
                for triangle in &triangulation.mesh.triangles[first..last] {
                    let [a, b, c] = *triangle;
                    if a != b && b != c && c != a {
                        let corner_of =
                            |vertex| corners.clone().find(|&corner| mesh.corners[corner] == vertex);
                        kept.extend(
                            triangle.iter().filter_map(|&v| corner_of(v)).map(|corner| corner as u32),
                        );
                        ends.push(kept.len() as u32);
                    }
                }
            } else if kept.len() < start + 3 {
                kept.truncate(start);
            } else {
                ends.push(kept.len() as u32);
            }
        }
        result.dropped_faces += usize::from(before == ends.len());
        result.faces.resize(ends.len(), face as u32);
    }
    let of_face =
        |list: &[u32]| if list.len() == mesh.face_count() { pick(list, &result.faces) } else { Vec::new() };
    let slots =
        if mesh.slots.len() == mesh.face_count() { pick(&mesh.slots, &result.faces) } else { Vec::new() };
    result.mesh = PolygonMesh {
        positions: mesh.positions.clone(),
        normals: picked(&mesh.normals, mesh, &kept),
        uv_sets: mesh
            .uv_sets
            .iter()
            .map(|uvs| picked(uvs, mesh, &kept))
            .filter(|uvs| !uvs.is_empty())
            .collect(),
        colors: picked(&mesh.colors, mesh, &kept),
        corners: pick(&mesh.corners, &kept),
        face_ends: ends,
        holes: Vec::new(),
        slots,
        smoothing_groups: of_face(&mesh.smoothing_groups),
        creases: mesh.creases.clone(),
        sharp_vertices: mesh.sharp_vertices.clone(),
    };
    let exists = |vertex: u32| (vertex as usize) < positions;
    result.mesh.creases.retain(|c| c.vertices.into_iter().all(exists) && c.sharpness > 0.0);
    result.mesh.sharp_vertices.retain(|s| exists(s.vertex) && s.sharpness > 0.0);
    result
}

fn pick<T: Copy>(list: &[T], places: &[u32]) -> Vec<T> {
    places.iter().map(|&place| list[place as usize]).collect()
}

fn picked<T: Copy>(attribute: &CornerAttribute<T>, mesh: &PolygonMesh, kept: &[u32]) -> CornerAttribute<T> {
    if attribute.corners.is_empty() {
        let fits = attribute.values.len() == mesh.positions.len();
        return if fits { attribute.clone() } else { CornerAttribute::default() };
    }
    let exists = |index: &u32| (*index as usize) < attribute.values.len();
    if attribute.corners.len() != mesh.corners.len() || !attribute.corners.iter().all(exists) {
        return CornerAttribute::default();
    }
    CornerAttribute::indexed(attribute.values.clone(), pick(&attribute.corners, kept))
}
