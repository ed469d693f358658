//! Each mesh: closed or not, and what it lacks.

use luch::mesh::{TriangleMesh, clean, measure, weld};
use luch::scene::{Id, Material, Scene, Shape, Surface};
use serde::Serialize;

/// One mesh.
#[derive(Debug, Serialize)]
pub(crate) struct MeshReport {
    /// Place among the scene's shapes.
    pub(crate) shape: usize,
    /// The first object that shows it; empty if it has no name.
    pub(crate) object: String,
    pub(crate) triangles: usize,
    pub(crate) positions: usize,
    pub(crate) bytes: u64,
    pub(crate) is_closed: bool,
    /// Closed, or why not, after equal positions have been joined.
    pub(crate) closedness: String,
    /// Triangles without area.
    pub(crate) degenerate: usize,
    pub(crate) has_normals: bool,
    pub(crate) uv_sets: usize,
}

impl MeshReport {
    fn of(shape: usize, object: &str, mesh: &TriangleMesh) -> Self {
        // Files repeat positions at hard edges and seams; only where equal ones are joined is an edge an edge.
        let welded = weld::weld_exact(mesh).mesh;
        let closedness = measure::closedness(&welded);
        Self {
            shape,
            object: object.to_owned(),
            triangles: mesh.triangles.len(),
            positions: mesh.positions.len(),
            bytes: mesh.memory().shared_bytes as u64,
            is_closed: closedness.is_closed(),
            closedness: closedness.to_string(),
            degenerate: clean::remove_degenerate(mesh).removed,
            has_normals: !mesh.normals.is_empty(),
            uv_sets: mesh.uv_sets.len(),
        }
    }

    /// For people.
    pub(crate) fn line(&self) -> String {
        let mut words = vec![format!("{} \"{}\": {} triangles", self.shape, self.object, self.triangles)];
        words.push(self.closedness.clone());
        if self.degenerate > 0 {
            words.push(format!("{} triangles without area", self.degenerate));
        }
        if !self.has_normals {
            words.push("no normals (flat)".to_owned());
        }
        if self.uv_sets == 0 {
            words.push("no uvs".to_owned());
        }
        words.join("; ")
    }
}

/// Glass has an inside: on an open mesh light never comes out of it, or goes in where it did not come out.
pub(crate) fn open_glass(scene: &Scene, meshes: &[MeshReport]) -> Vec<String> {
    let is_glass =
        |id: &Id<Material>| matches!(scene.materials[id.index()].surface, Surface::Dielectric { .. });
    let mut found = Vec::new();
    for mesh in meshes.iter().filter(|mesh| !mesh.is_closed) {
        let instances = scene.instances.iter().filter(|instance| instance.shape.index() == mesh.shape);
        let materials =
            instances.flat_map(|instance| instance.materials.iter().map(move |id| (instance, id)));
        for (instance, id) in materials.filter(|(_, id)| is_glass(id)).take(1) {
            found.push(format!(
                "object \"{}\": material \"{}\" is glass, but the mesh is no closed body ({}); refraction wants an inside: \
                 `luch mesh repair` or `solidify` makes one",
                instance.name,
                scene.materials[id.index()].name,
                mesh.closedness
            ));
        }
    }
    found
}

/// Every mesh of a scene.
pub(crate) fn examine(scene: &Scene) -> Vec<MeshReport> {
    let meshes = scene.shapes.iter().enumerate().filter_map(|(i, shape)| match &**shape {
        Shape::Mesh(mesh) => Some((i, mesh)),
        _ => None,
    });
    meshes
        .map(|(i, mesh)| {
            let shown = scene.instances.iter().find(|instance| instance.shape.index() == i);
            MeshReport::of(i, shown.map_or("", |instance| &instance.name), mesh)
        })
        .collect()
}
