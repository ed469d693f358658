//! All meshes of a scene as one.

use super::MeshFile;
use crate::{LoadError, Loaded, Problem, Warning};
use luch_mesh::{PolygonMesh, TriangleMesh};
use luch_scene::{Instance, Scene, Shape};
use std::collections::BTreeMap;
use std::path::Path;

/// The most triangles of all copies together.
const MOST_TRIANGLES: usize = 1 << 26;

/// Joins what stands in a scene; materials become slots in the order in which they are met.
pub(super) fn join(path: &Path, loaded: Loaded) -> Result<MeshFile, LoadError> {
    let Loaded { scene, mut warnings, .. } = loaded;
    let mut placed = Vec::new();
    let mut slots = Slots::default();
    let (mut triangles, mut others) = (0usize, 0usize);
    for instance in &scene.instances {
        let Some(Shape::Mesh(mesh)) = scene.shapes.get(instance.shape.index()).map(|shape| &**shape) else {
            others += 1;
            continue;
        };
        triangles += mesh.triangles.len();
        if triangles > MOST_TRIANGLES {
            let message = format!("its copies have more than {MOST_TRIANGLES} triangles together");
            return Err(Problem::new(path, message).into());
        }
        let problems = mesh.validate();
        if !problems.is_empty() {
            let problems = problems.iter().map(|problem| Problem::new(path, problem.to_string()));
            return Err(LoadError { problems: problems.collect() });
        }
        placed.push(slots.place(path, &scene, instance, mesh)?);
    }
    if others > 0 {
        let message = format!("{others} exact spheres, discs and planes are no meshes: they are left out");
        warnings.push(Warning::new(path, message));
    }
    // Halves are joined, so that the work does not grow with the square of the number of instances.
    while placed.len() > 1 {
        let mut halves = Vec::with_capacity(placed.len().div_ceil(2));
        let mut all = placed.into_iter();
        while let Some(mut first) = all.next() {
            if let Some(second) = all.next() {
                first.append(&second, 0);
            }
            halves.push(first);
        }
        placed = halves;
    }
    let mut whole = placed.pop().unwrap_or_default();
    if slots.names.len() <= 1 {
        whole.slots.clear();
    }
    Ok(MeshFile { mesh: PolygonMesh::from(&whole), materials: slots.names, libraries: Vec::new(), warnings })
}

/// The slot of each material of the scene.
#[derive(Default)]
struct Slots {
    of_material: BTreeMap<Option<usize>, u16>,
    names: Vec<String>,
}

impl Slots {
    /// A mesh where its instance puts it, with the slots of its materials.
    fn place(
        &mut self,
        path: &Path,
        scene: &Scene,
        instance: &Instance,
        mesh: &TriangleMesh,
    ) -> Result<TriangleMesh, LoadError> {
        let mut placed = mesh.clone();
        placed.transform(&instance.placement);
        if placed.positions.iter().any(|position| !position.is_finite()) {
            return Err(Problem::new(path, "puts a mesh farther out than numbers reach").into());
        }
        let mut known: BTreeMap<u16, u16> = BTreeMap::new();
        let mut slots = Vec::with_capacity(mesh.triangles.len());
        for triangle in 0..mesh.triangles.len() {
            let own = mesh.slot(triangle);
            let slot = match known.get(&own) {
                Some(&slot) => slot,
                None => {
                    let material = instance.material(own).map(|id| id.index());
                    let slot = self.slot(path, scene, material)?;
                    known.insert(own, slot);
                    slot
                }
            };
            slots.push(slot);
        }
        placed.slots = slots;
        Ok(placed)
    }

    fn slot(&mut self, path: &Path, scene: &Scene, material: Option<usize>) -> Result<u16, LoadError> {
        if let Some(&slot) = self.of_material.get(&material) {
            return Ok(slot);
        }
        let slot = u16::try_from(self.names.len())
            .map_err(|_| Problem::new(path, "has more than 65536 materials"))?;
        let name =
            material.and_then(|material| scene.materials.get(material)).map(|material| material.name.clone());
        self.names.push(name.unwrap_or_default());
        self.of_material.insert(material, slot);
        Ok(slot)
    }
}
