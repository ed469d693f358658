//! Nodes with meshes: one instance of each of the mesh's shapes, or many by EXT_mesh_gpu_instancing.

use super::Import;
use super::accessor::Form;
use super::hierarchy::placed;
use super::json::Json;
use crate::Problem;
use glam::{Affine3A, DAffine3, DMat4};
use luch_scene::Instance;

const VECTOR_3: Form = Form::vector(3);
const VECTOR_4: Form = Form::vector(4);

impl Import<'_> {
    /// Puts the mesh of a node into the world.
    pub(super) fn place_mesh(
        &mut self,
        node: &Json,
        reference: &Json,
        world: DAffine3,
    ) -> Result<(), Problem> {
        let mesh = reference.reference(&self.document.meshes)?;
        let name = match node.name()? {
            name if name.is_empty() => self.document.meshes.at(mesh).name()?,
            name => name,
        };
        let mut world = world;
        if let Some(skin) = node.get("skin")? {
            world = self.bind_pose(&skin)?.unwrap_or(world);
        }
        match node.extension("EXT_mesh_gpu_instancing")? {
            None => self.place(node, mesh, &name, world),
            Some(instancing) => {
                for placement in self.placements(&instancing)? {
                    self.place(&instancing, mesh, &name, world * placement)?;
                }
                Ok(())
            }
        }
    }

    fn place(&mut self, owner: &Json, mesh: usize, name: &str, world: DAffine3) -> Result<(), Problem> {
        let placement = single_precision(world);
        if !is_invertible(&placement) {
            let message = "an object whose transform cannot be inverted (a scale of 0?) is left out";
            self.notices.add(owner.path(), message);
            return Ok(());
        }
        for part in self.mesh(mesh)?.iter() {
            self.budget.take(1, size_of::<Instance>() + name.len() + 4 * part.materials.len(), owner)?;
            let (name, materials) = (name.to_owned(), part.materials.clone());
            self.scene.instances.push(Instance { name, shape: part.shape, materials, placement });
        }
        Ok(())
    }

    /// The transforms of EXT_mesh_gpu_instancing, relative to the node.
    fn placements(&mut self, json: &Json) -> Result<Vec<DAffine3>, Problem> {
        let attributes = json.need("attributes")?;
        let open = |name: &str, form: Form| -> Result<_, Problem> {
            let Some(reference) = attributes.get(name)? else { return Ok(None) };
            self.document.reader(&reference, &[form]).map(Some)
        };
        let (translations, rotations) = (open("TRANSLATION", VECTOR_3)?, open("ROTATION", VECTOR_4)?);
        let scales = open("SCALE", VECTOR_3)?;
        let counts: Vec<usize> =
            [&translations, &rotations, &scales].into_iter().flatten().map(|r| r.count()).collect();
        let Some(&count) = counts.first() else {
            return Err(attributes.problem("has none of TRANSLATION, ROTATION and SCALE"));
        };
        if counts.iter().any(|&other| other != count) {
            return Err(attributes
                .problem(format!("the attributes have {counts:?} elements, expected the same number")));
        }
        self.budget.take(count, size_of::<DAffine3>(), json)?;
        let placement = |index: usize| {
            let translation = translations.map_or([0.0; 3], |reader| reader.numbers(index));
            let rotation = rotations.map_or([0.0, 0.0, 0.0, 1.0], |reader| reader.numbers(index));
            let scale = scales.map_or([1.0; 3], |reader| reader.numbers(index));
            placed(translation.map(f64::from), rotation.map(f64::from), scale.map(f64::from))
        };
        Ok((0..count).map(placement).collect())
    }

    /// Where a skinned mesh is as it was bound: by its first joint, on which all joints agree in that pose.
    fn bind_pose(&mut self, reference: &Json) -> Result<Option<DAffine3>, Problem> {
        self.notices.add(
            reference.path(),
            "skins are not applied: the mesh is shown in the pose in which it was bound",
        );
        let skin = self.document.skins.at(reference.reference(&self.document.skins)?);
        let joints = skin.list("joints")?;
        if joints.is_empty() {
            return Ok(None);
        }
        let joint = self.hierarchy.world[joints.at(0).reference(&self.document.nodes)?];
        let Some(matrices) = skin.get("inverseBindMatrices")? else { return Ok(Some(joint)) };
        let reader = self.document.reader(&matrices, &[Form { rows: 4, columns: 4 }])?;
        if reader.count() == 0 {
            return Err(matrices.problem("refers to an accessor without elements"));
        }
        let bind = DMat4::from_cols_array(&reader.numbers::<16>(0).map(f64::from));
        let world = joint * DAffine3::from_mat4(bind);
        Ok(is_invertible(&single_precision(world)).then_some(world))
    }
}

fn single_precision(transform: DAffine3) -> Affine3A {
    Affine3A::from_mat3_translation(transform.matrix3.as_mat3(), transform.translation.as_vec3())
}

fn is_invertible(placement: &Affine3A) -> bool {
    let determinant = placement.matrix3.determinant();
    placement.is_finite() && determinant != 0.0 && determinant.is_finite() && placement.inverse().is_finite()
}
