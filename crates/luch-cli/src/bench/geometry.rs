//! The triangles that are traced.

use crate::args::ParameterArgs;
use crate::failure::Failure;
use glam::Vec3;
use luch::bvh::Aabb;
use luch::formats::{Files, ray_files};
use luch::scene::{Scene, Shape};
use std::path::Path;

/// All triangles in world coordinates.
pub(super) struct Triangles {
    pub(super) positions: Vec<Vec3>,
    pub(super) corners: Vec<[u32; 3]>,
}

impl Triangles {
    /// What a `.tri` file or any scene or mesh holds.
    pub(super) fn load(path: &Path, parameters: &ParameterArgs) -> Result<Self, Failure> {
        let is_raw = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("tri"));
        let triangles = if is_raw {
            let mesh = ray_files::read_mesh(path, &Files::disk())?;
            Self { positions: mesh.positions, corners: mesh.triangles }
        } else {
            Self::of_scene(&parameters.load(path, &Files::disk())?.scene)
                .ok_or_else(|| Failure::new(format!("{}: has too many vertices", path.display())))?
        };
        if triangles.bounds().is_empty() {
            return Err(Failure::new(format!("{}: holds no triangles", path.display())));
        }
        Ok(triangles)
    }

    /// The meshes of a scene where its instances put them; `None` if their vertices are 2³² or more.
    fn of_scene(scene: &Scene) -> Option<Self> {
        let mut all = Self { positions: Vec::new(), corners: Vec::new() };
        for instance in &scene.instances {
            let Shape::Mesh(mesh) = &*scene.shapes[instance.shape.index()] else { continue };
            let first = u32::try_from(all.positions.len()).ok()?;
            u32::try_from(all.positions.len() + mesh.positions.len()).ok()?;
            all.positions.extend(mesh.positions.iter().map(|p| instance.placement.transform_point3(*p)));
            all.corners.extend(mesh.triangles.iter().map(|corners| corners.map(|corner| first + corner)));
        }
        Some(all)
    }

    /// The places of a triangle's corners.
    pub(super) fn at(&self, triangle: u32) -> Option<[Vec3; 3]> {
        let corners = self.corners.get(triangle as usize)?;
        Some(corners.map(|corner| self.positions[corner as usize]))
    }

    /// The box of all corners that are used.
    pub(super) fn bounds(&self) -> Aabb {
        let used = self.corners.as_flattened().iter().map(|&corner| self.positions[corner as usize]);
        used.fold(Aabb::empty(), |bounds, position| bounds.union(&Aabb { min: position, max: position }))
    }
}
