//! Subdivision surfaces: finer and finer meshes whose limit is smooth, except where creases, corners and borders are.
//!
//! Catmull–Clark for quads, Loop and √3 for triangles, midpoint for a finer cut of the same surface. Edges that do not have
//! exactly two faces count as borders, so meshes that are no manifolds are subdivided like any other. Texture coordinates
//! have a connectivity of their own: their seams are borders there.
//!
//! ```
//! use luch_mesh::subdivide::{Scheme, Settings, subdivide};
//! use luch_mesh::{PolygonMesh, generate};
//!
//! let cube = PolygonMesh::from(&generate::cuboid(glam::Vec3::ONE, [1; 3]));
//! let smooth = subdivide(&cube, &Settings { scheme: Scheme::Loop, levels: 2, ..Settings::default() })?;
//! assert_eq!(smooth.face_count(), 12 * 16);
//! # Ok::<(), luch_mesh::subdivide::SubdivideError>(())
//! ```

mod adaptive;
mod channel;
mod crease;
mod dart;
mod limit;
mod masks;
mod sqrt3;
mod topology;

use glam::DVec3;

use crate::PolygonMesh;
use crate::polygon_mesh::{CornerAttribute, Crease, SharpVertex};
use crate::repair::sound;
pub use adaptive::{MOST_ADAPTIVE_FACES, MOST_ADAPTIVE_LEVELS, subdivide_adaptively};
use channel::Channel;
pub use crease::{crease_all, crease_by_angle};
use masks::{Feature, Rule, feature};
use topology::Topology;

/// How faces are divided and vertices placed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scheme {
    /// A face of n corners becomes n quads (Catmull and Clark 1978).
    #[default]
    CatmullClark,
    /// A triangle becomes four (Loop 1987). Other faces are cut into triangles first.
    Loop,
    /// As Loop if all faces are triangles, else as Catmull–Clark, but nothing moves.
    Midpoint,
    /// A triangle becomes three, turned (Kobbelt 2000). Sharp edges of any sharpness stay for ever; so do seams of uvs, since
    /// turned triangles would lie across them.
    Sqrt3,
}

/// What happens to texture coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UvRule {
    /// They are interpolated linearly in each face.
    Linear,
    /// They are smoothed as positions are, but stay where they are on seams and borders.
    SeamsFixed,
    /// They are smoothed, seams and borders as curves; corners of a single face stay.
    #[default]
    CornersFixed,
    /// They are smoothed, seams and borders as curves.
    Smooth,
}

/// What happens at borders.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Border {
    /// They become smooth curves, cubic B-splines.
    #[default]
    Smooth,
    /// The same, but corners of a single face stay.
    CornersFixed,
}

/// How to subdivide.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Settings {
    /// The scheme.
    pub scheme: Scheme,
    /// How often.
    pub levels: u32,
    /// The rule for texture coordinates.
    pub uvs: UvRule,
    /// The rule for borders.
    pub border: Border,
    /// Move all vertices to where infinitely many levels would bring them. What is still sharp for a finite number of
    /// levels then counts as sharp for ever.
    pub limit: bool,
    /// Give the normals of the limit surface even if the mesh has none; with `limit` it has them anyway.
    pub normals: bool,
}

/// The most faces of a result.
pub const MOST_FACES: u64 = 1 << 25;

/// Why a mesh cannot be subdivided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SubdivideError {
    /// The result would be too large.
    #[error("{levels} levels give more than {MOST_FACES} faces; this mesh allows {allowed}")]
    TooLarge {
        /// The levels asked for.
        levels: u32,
        /// The levels that are possible.
        allowed: u32,
    },
    /// The wish for fineness would make the result too large.
    #[error("that fineness gives more than {MOST_ADAPTIVE_FACES} faces; ask for a coarser one")]
    TooFine,
}

/// Subdivides a mesh. Faces that are none (fewer than three different corners, or not finite) are left out.
///
/// The result is the same on any number of threads. Numbers of faces: Catmull–Clark gives one for each corner and then four
/// times as many; Loop four times, √3 three times those of the triangles. Normals are those of the limit surface, for
/// [`Scheme::Midpoint`] interpolated and for [`Scheme::Sqrt3`] means of facets; they are made if the mesh has some or if they
/// are asked for.
pub fn subdivide(mesh: &PolygonMesh, settings: &Settings) -> Result<PolygonMesh, SubdivideError> {
    let mut mesh = sound(mesh).mesh;
    let is_triangles = (0..mesh.face_count()).all(|face| mesh.face(face).len() == 3);
    if !is_triangles && matches!(settings.scheme, Scheme::Loop | Scheme::Sqrt3) {
        mesh = triangulated(&mesh);
    }
    check_size(&mesh, settings, is_triangles)?;
    let with_normals = settings.limit || settings.normals || !mesh.normals.is_empty();
    if settings.scheme == Scheme::Sqrt3 {
        return Ok(sqrt3::subdivided(mesh, settings, with_normals));
    }
    let rule = match settings.scheme {
        Scheme::CatmullClark => Rule::CatmullClark,
        Scheme::Loop => Rule::Loop,
        Scheme::Midpoint | Scheme::Sqrt3 => Rule::Linear,
    };
    let to_triangles = is_triangles && rule != Rule::CatmullClark || rule == Rule::Loop;
    let mut refiner = Refiner::new(mesh, settings, rule, to_triangles);
    let is_finished_by_limit = rule != Rule::Linear && (settings.limit || with_normals);
    for level in 0..settings.levels {
        let needs_neighbours = level + 1 < settings.levels || is_finished_by_limit || refiner.has_creases;
        refiner.refine(needs_neighbours);
    }
    if is_finished_by_limit {
        refiner.finish_by_limit(settings.limit);
    }
    Ok(refiner.into_mesh())
}

fn triangulated(mesh: &PolygonMesh) -> PolygonMesh {
    let triangulation = mesh.triangulation();
    let mut triangles = PolygonMesh::from(&triangulation.mesh);
    let groups = triangulation.faces.iter().filter_map(|face| mesh.smoothing_groups.get(*face as usize));
    triangles.smoothing_groups = groups.copied().collect();
    triangles.creases.clone_from(&mesh.creases);
    triangles.sharp_vertices.clone_from(&mesh.sharp_vertices);
    triangles
}

fn check_size(mesh: &PolygonMesh, settings: &Settings, is_triangles: bool) -> Result<(), SubdivideError> {
    let faces = mesh.face_count() as u64;
    let (first, factor) = match settings.scheme {
        Scheme::Sqrt3 => (faces * 3, 3),
        Scheme::Midpoint if is_triangles => (faces * 4, 4),
        Scheme::Loop => (faces * 4, 4),
        Scheme::CatmullClark | Scheme::Midpoint => (mesh.corners.len() as u64, 4),
    };
    let mut allowed = 0;
    let mut count = first.max(1);
    while count <= MOST_FACES && allowed < settings.levels {
        allowed += 1;
        count *= factor;
    }
    if allowed < settings.levels {
        return Err(SubdivideError::TooLarge { levels: settings.levels, allowed });
    }
    Ok(())
}

/// The sharpness of edges and vertices of a mesh, written into its topology.
fn sharpen(topology: &mut Topology, creases: &[Crease], sharp: &[SharpVertex], border: Border) {
    for crease in creases {
        let [a, b] = crease.vertices;
        let edge = topology.edges_at(a).iter().copied().find(|&edge| topology.across(edge, a) == b);
        if let Some(edge) = edge {
            let sharpness = &mut topology.edge_sharpness[edge as usize];
            *sharpness = sharpness.max(crease.sharpness);
        }
    }
    for vertex in sharp {
        let sharpness = &mut topology.vertex_sharpness[vertex.vertex as usize];
        *sharpness = sharpness.max(vertex.sharpness);
    }
    if border == Border::CornersFixed {
        for vertex in 0..topology.vertex_count {
            if topology.corners_at(vertex).len() == 1 {
                topology.vertex_sharpness[vertex as usize] = f32::INFINITY;
            }
        }
    }
}

/// A mesh on its way down.
struct Refiner {
    rule: Rule,
    to_triangles: bool,
    topology: Topology,
    /// The corners, if the last level left the rest of the topology out.
    corners: Option<Vec<u32>>,
    places: Vec<DVec3>,
    has_creases: bool,
    uvs: Vec<Channel<glam::DVec2>>,
    colors: Option<Channel<glam::DVec4>>,
    /// For [`Scheme::Midpoint`]; the others compute them.
    normals: Option<Channel<DVec3>>,
    made_normals: CornerAttribute<glam::Vec3>,
    slots: Vec<u16>,
    smoothing_groups: Vec<u32>,
}

impl Refiner {
    fn new(mesh: PolygonMesh, settings: &Settings, rule: Rule, to_triangles: bool) -> Self {
        let mut topology = Topology::new(&mesh.face_ends, mesh.corners.clone(), mesh.positions.len() as u32);
        sharpen(&mut topology, &mesh.creases, &mesh.sharp_vertices, settings.border);
        let (uv_rule, uv_settings) = match settings.uvs {
            UvRule::Linear => (Rule::Linear, settings.uvs),
            other => (rule, other),
        };
        let uv = |uvs| Channel::new(&mesh, &topology, uvs, glam::Vec2::as_dvec2, uv_rule, uv_settings);
        let linear = UvRule::Linear;
        let colors = Channel::new(&mesh, &topology, &mesh.colors, glam::Vec4::as_dvec4, Rule::Linear, linear);
        let normals =
            Channel::new(&mesh, &topology, &mesh.normals, glam::Vec3::as_dvec3, Rule::Linear, linear);
        Self {
            rule,
            to_triangles,
            places: mesh.positions.iter().map(|p| p.as_dvec3()).collect(),
            has_creases: !mesh.creases.is_empty(),
            uvs: mesh.uv_sets.iter().map(uv).collect(),
            colors: (!mesh.colors.is_empty()).then_some(colors),
            normals: (rule == Rule::Linear && !mesh.normals.is_empty()).then_some(normals),
            made_normals: CornerAttribute::default(),
            corners: None,
            topology,
            slots: mesh.slots,
            smoothing_groups: mesh.smoothing_groups,
        }
    }

    fn refine(&mut self, needs_neighbours: bool) {
        let topology = &self.topology;
        for uvs in &mut self.uvs {
            uvs.refine(topology, self.to_triangles, needs_neighbours);
        }
        if let Some(colors) = &mut self.colors {
            colors.refine(topology, self.to_triangles, needs_neighbours);
        }
        if let Some(normals) = &mut self.normals {
            normals.refine(topology, self.to_triangles, needs_neighbours);
        }
        self.slots = children(topology, &self.slots, self.to_triangles);
        self.smoothing_groups = children(topology, &self.smoothing_groups, self.to_triangles);
        self.places = channel::refined_values(topology, &self.places, self.rule, self.to_triangles);
        if needs_neighbours {
            self.topology = channel::refined_topology(topology, self.to_triangles);
        } else {
            self.corners = Some(channel::refined_corners(topology, self.to_triangles));
        }
    }

    /// Sets the normals of the limit surface and, if `moves`, the places.
    fn finish_by_limit(&mut self, moves: bool) {
        let own_count = self.topology.vertex_count;
        // The mask of Catmull–Clark is for quads: one level more gives them, and the vertices of this level come first there.
        let finer = (self.rule == Rule::CatmullClark && !self.topology.is_quads()).then(|| {
            let places = channel::refined_values(&self.topology, &self.places, self.rule, false);
            (self.topology.refined_to_quads(), places)
        });
        let (topology, places) = match &finer {
            Some((topology, places)) => (topology, places),
            None => (&self.topology, &self.places),
        };
        let mut normals = limit::normals(topology, places, self.rule, own_count);
        let moved = moves.then(|| limit::positions(topology, places, self.rule, own_count));
        if finer.is_some() && !normals.corners.is_empty() {
            // Corner c of before is the first of quad c.
            normals.corners = normals.corners.into_iter().step_by(4).collect();
        }
        self.made_normals = normals;
        if let Some(moved) = moved {
            self.places = moved;
        }
    }

    fn into_mesh(self) -> PolygonMesh {
        let topology = self.topology;
        let creases = if self.has_creases { remaining_creases(&topology) } else { Vec::new() };
        let sharp_vertices = if self.corners.is_none() { remaining_sharp(&topology) } else { Vec::new() };
        let face_ends = match self.corners {
            None => (1..=topology.face_count() as u32).map(|face| topology.face_start(face)).collect(),
            Some(ref corners) => {
                let sides = if self.to_triangles { 3 } else { 4 };
                (1..=(corners.len() / sides) as u32).map(|face| face * sides as u32).collect()
            }
        };
        let mut normals = match self.normals {
            Some(normals) => normals.into_attribute(glam::DVec3::as_vec3),
            None => self.made_normals,
        };
        for normal in &mut normals.values {
            *normal = normal.try_normalize().unwrap_or(glam::Vec3::Z);
        }
        PolygonMesh {
            positions: self.places.iter().map(|p| p.as_vec3()).collect(),
            corners: self.corners.unwrap_or(topology.corners),
            face_ends,
            holes: Vec::new(),
            normals,
            uv_sets: self.uvs.into_iter().map(|uvs| uvs.into_attribute(glam::DVec2::as_vec2)).collect(),
            colors: self
                .colors
                .map_or_else(CornerAttribute::default, |c| c.into_attribute(glam::DVec4::as_vec4)),
            slots: self.slots,
            smoothing_groups: self.smoothing_groups,
            creases,
            sharp_vertices,
        }
    }
}

/// For each child of a face what the face has.
fn children<T: Copy>(topology: &Topology, of_faces: &[T], to_triangles: bool) -> Vec<T> {
    if of_faces.is_empty() {
        return Vec::new();
    }
    if to_triangles {
        return of_faces.iter().flat_map(|&value| [value; 4]).collect();
    }
    (0..topology.corners.len() as u32).map(|corner| of_faces[topology.face_of(corner) as usize]).collect()
}

/// What is left of creases; borders need none.
fn remaining_creases(topology: &Topology) -> Vec<Crease> {
    let edges = topology.edge_ends.iter().zip(&topology.edge_sharpness).enumerate();
    let sharp = edges.filter(|(edge, (_, s))| **s > 0.0 && topology.halves_of(*edge as u32).len() == 2);
    sharp.map(|(_, (&vertices, &sharpness))| Crease { vertices, sharpness }).collect()
}

/// What is left of sharp vertices. Fixed corners are found here too: they stay fixed.
fn remaining_sharp(topology: &Topology) -> Vec<SharpVertex> {
    let vertices = topology.vertex_sharpness.iter().enumerate();
    let sharp = vertices.filter(|(_, sharpness)| **sharpness > 0.0);
    sharp.map(|(vertex, &sharpness)| SharpVertex { vertex: vertex as u32, sharpness }).collect()
}

#[cfg(test)]
mod tests;
