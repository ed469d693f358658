//! Everything that can be said about a mesh: counts, measures, faults, quality, memory.
//!
//! ```
//! use luch_mesh::{generate, inspect};
//!
//! let report = inspect::inspect(&generate::torus(2.0, 0.5, 64, 32), &Default::default());
//! assert!(report.closed);
//! assert_eq!(report.genus, Some(1));
//! assert_eq!(report.verdict, "closed (1 piece, genus 1)");
//! ```

mod display;
mod intersections;
mod loops;
mod measures;
mod quantize;
mod topology;

use glam::{DVec3, Vec3};
use rayon::prelude::*;
use serde::Serialize;

use crate::codec::welding::Welder;
use crate::measure::{Closedness, EdgeFault};
use crate::{MemoryStatistics, TriangleMesh};
pub use intersections::SelfIntersections;
pub use measures::Class;
pub use quantize::{Precision, Quantization};
use topology::Topology;

/// What is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Positions that are equal count as one, as most files mean it: they repeat positions at hard edges and seams.
    pub weld: bool,
    /// Look for faces that cross one another: the one question that takes longer than all others together.
    pub self_intersections: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self { weld: true, self_intersections: false }
    }
}

/// All that was found. Lengths are metres; counts of edges and faults are those after welding, if that was asked for.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Report {
    /// What breaks the promises of the type; if there is anything here, the rest is empty but for counts.
    pub problems: Vec<String>,
    /// Positions as they are stored.
    pub positions: usize,
    /// Triangles.
    pub triangles: usize,
    /// Corners of triangles.
    pub corners: usize,
    /// Different edges.
    pub edges: usize,
    /// Positions equal to an earlier one.
    pub duplicate_positions: usize,
    /// Positions that no triangle uses.
    pub unused_positions: usize,
    /// Normals; 0 if there are none.
    pub normals: usize,
    /// Uvs of each set.
    pub uvs: Vec<usize>,
    /// Tangents; 0 if there are none.
    pub tangents: usize,
    /// Colours; 0 if there are none.
    pub colors: usize,
    /// Different material slots in use.
    pub material_slots: usize,
    /// Lower corner of the box around all triangles.
    pub least: [f32; 3],
    /// Upper corner.
    pub most: [f32; 3],
    /// Square metres.
    pub area: f64,
    /// Cubic metres; negative if faces look inward. Means something for closed meshes only.
    pub volume: f64,
    /// Middle of the enclosed mass; none if the mesh is not closed.
    pub center_of_mass: Option<[f64; 3]>,
    /// Tensor of inertia about that middle for a density of 1 kg/m³; none if the mesh is not closed.
    pub inertia: Option<[[f64; 3]; 3]>,
    /// True if every edge has exactly two triangles of opposite direction.
    pub closed: bool,
    /// The verdict in words, with reasons.
    pub verdict: String,
    /// Positions − edges + triangles.
    pub euler_characteristic: i64,
    /// Handles of all pieces; only for closed meshes.
    pub genus: Option<u64>,
    /// Pieces joined by edges.
    pub components: usize,
    /// Closed pieces whose faces look inward: voids, or pieces inside out.
    pub inward_components: usize,
    /// Border edges.
    pub boundary_edges: usize,
    /// Closed runs of border edges.
    pub boundary_loops: usize,
    /// Edges of the loop with most of them.
    pub most_boundary_edges: usize,
    /// Length of the longest loop.
    pub longest_boundary: f64,
    /// Edges of more than two triangles.
    pub non_manifold_edges: usize,
    /// Positions where several fans of triangles touch in a point only.
    pub non_manifold_positions: usize,
    /// Edges whose two triangles are wound against each other: one of them is flipped.
    pub flipped_edges: usize,
    /// Triangles with a repeated position.
    pub collapsed_triangles: usize,
    /// Triangles without area, collapsed ones included.
    pub degenerate_triangles: usize,
    /// Triangles with the same positions as an earlier one.
    pub duplicate_triangles: usize,
    /// Triangles that cross others; none if it was not asked for.
    pub self_intersections: Option<SelfIntersections>,
    /// Shortest side of a triangle.
    pub shortest_edge: f64,
    /// Longest side of a triangle.
    pub longest_edge: f64,
    /// Sides of triangles by length.
    pub edge_lengths: Vec<Class>,
    /// Triangles by aspect: the longest side times the perimeter over 4√3 times the area, 1 for equilateral ones.
    pub aspects: Vec<Class>,
    /// Memory with and without sharing.
    pub memory: Memory,
    /// What fewer bits would cost.
    pub quantization: Quantization,
}

/// Memory of the mesh as it is and as a plain list of triangles that own their corners.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Memory {
    /// Bytes of the shared lists together with all indices.
    pub shared_bytes: usize,
    /// Bytes if each triangle had its own corners and no indices.
    pub unshared_bytes: usize,
    /// How many times smaller the shared form is.
    pub saving: f64,
}

impl From<MemoryStatistics> for Memory {
    fn from(memory: MemoryStatistics) -> Self {
        let MemoryStatistics { shared_bytes, unshared_bytes } = memory;
        Self { shared_bytes, unshared_bytes, saving: memory.saving() }
    }
}

/// Looks at a mesh, on all threads of the current pool; the same report for any number of them.
///
/// Memory besides the mesh: about 40 bytes a triangle. Time is in proportion to the triangles, sorting aside, however hostile
/// the mesh.
pub fn inspect(mesh: &TriangleMesh, options: &Options) -> Report {
    let mut report = Report {
        problems: mesh.validate().iter().map(ToString::to_string).collect(),
        positions: mesh.positions.len(),
        triangles: mesh.triangles.len(),
        corners: 3 * mesh.triangles.len(),
        normals: mesh.normals.values.len(),
        uvs: mesh.uv_sets.iter().map(|uvs| uvs.values.len()).collect(),
        tangents: mesh.tangents.values.len(),
        colors: mesh.colors.values.len(),
        memory: mesh.memory().into(),
        verdict: "unknown: the mesh is broken".to_owned(),
        ..Report::default()
    };
    if report.problems.is_empty() {
        report.material_slots = slot_count(mesh);
        report.look_at(mesh, options);
    }
    report
}

fn slot_count(mesh: &TriangleMesh) -> usize {
    if mesh.slots.is_empty() {
        return usize::from(!mesh.triangles.is_empty());
    }
    let mut is_used = vec![false; usize::from(u16::MAX) + 1];
    mesh.slots.iter().for_each(|&slot| is_used[usize::from(slot)] = true);
    is_used.iter().filter(|is_used| **is_used).count()
}

/// For each position the first that is equal to it.
fn first_equal(positions: &[Vec3]) -> Vec<u32> {
    let mut welder = Welder::default();
    welder.reserve(positions.len());
    // The first position of each number of the welder.
    let mut first: Vec<u32> = Vec::with_capacity(positions.len());
    let targets = positions.iter().enumerate().map(|(i, &position)| {
        let number = welder.number(position) as usize;
        if number == first.len() {
            first.push(i as u32);
        }
        first[number]
    });
    targets.collect()
}

impl Report {
    fn look_at(&mut self, mesh: &TriangleMesh, options: &Options) {
        let count = mesh.positions.len();
        let mut is_used = vec![false; count];
        mesh.triangles.as_flattened().iter().for_each(|&position| is_used[position as usize] = true);
        self.unused_positions = is_used.iter().filter(|is_used| !**is_used).count();
        let (mut least, mut most) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for (position, _) in mesh.positions.iter().zip(&is_used).filter(|(_, is_used)| **is_used) {
            (least, most) = (least.min(*position), most.max(*position));
        }
        drop(is_used);
        if mesh.triangles.is_empty() {
            (least, most) = (Vec3::ZERO, Vec3::ZERO);
        }
        (self.least, self.most) = (least.to_array(), most.to_array());
        // The same middle for all sums: no digits are lost far from the origin.
        let origin = (least.as_dvec3() + most.as_dvec3()) / 2.0;
        let measures = measures::Measures::new(&mesh.positions, &mesh.triangles, origin);
        (self.area, self.volume) = (measures.area, measures.six_volumes / 6.0);
        self.degenerate_triangles = measures.degenerate;
        self.edge_lengths = measures.lengths();
        self.aspects = measures.aspects();
        if !mesh.triangles.is_empty() {
            (self.shortest_edge, self.longest_edge) = (measures.shortest.sqrt(), measures.longest.sqrt());
        }
        let shortest = self.edge_lengths.first().map_or(0.0, |class| class.from);
        self.quantization = quantize::quantization(mesh, most - least, shortest);

        let targets = first_equal(&mesh.positions);
        self.duplicate_positions =
            targets.iter().enumerate().filter(|(i, first)| *i != **first as usize).count();
        let welded: Option<Vec<[u32; 3]>> = (options.weld && self.duplicate_positions > 0)
            .then(|| mesh.triangles.par_iter().map(|t| t.map(|i| targets[i as usize])).collect());
        drop(targets);
        let triangles = welded.as_deref().unwrap_or(&mesh.triangles);
        let is_whole = |[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
        let whole: Option<Vec<[u32; 3]>> = (!triangles.par_iter().all(is_whole))
            .then(|| triangles.par_iter().copied().filter(is_whole).collect());
        let triangles = whole.as_deref().unwrap_or(triangles);
        self.collapsed_triangles = mesh.triangles.len() - triangles.len();
        self.topology(&mesh.positions, triangles, origin);
        if self.closed && measures.six_volumes != 0.0 {
            self.center_of_mass = Some((origin + measures.center()).to_array());
            self.inertia = Some(measures.inertia().to_cols_array_2d());
        }
        if options.self_intersections {
            self.self_intersections = Some(intersections::find(&mesh.positions, triangles));
        }
    }

    fn topology(&mut self, positions: &[Vec3], triangles: &[[u32; 3]], origin: DVec3) {
        let topology = Topology::new(triangles, positions.len());
        let (mut pieces, fans) =
            rayon::join(|| topology.pieces(triangles.len()), || topology.fans(triangles, positions.len()));
        let count = |fault: &Option<EdgeFault>| fault.map_or(0, |fault| fault.count);
        self.edges = topology.edges;
        self.boundary_edges = count(&topology.boundary);
        self.non_manifold_edges = count(&topology.non_manifold);
        self.flipped_edges = count(&topology.inconsistent);
        self.duplicate_triangles = topology.duplicates;
        self.non_manifold_positions = fans.par_iter().filter(|&&fans| fans > 1).count();
        let used = fans.par_iter().filter(|&&fans| fans > 0).count() as i64;
        self.euler_characteristic = used - topology.edges as i64 + triangles.len() as i64;

        // The volume of each piece, at the place of its lowest triangle.
        let mut volumes: Vec<(u32, f64)> = Vec::new();
        let mut numbers: Vec<u32> = vec![u32::MAX; triangles.len()];
        for (t, corners) in triangles.iter().enumerate() {
            let root = pieces.root(t as u32) as usize;
            if numbers[root] == u32::MAX {
                numbers[root] = volumes.len() as u32;
                volumes.push((root as u32, 0.0));
            }
            let [a, b, c] = corners.map(|i| positions[i as usize].as_dvec3() - origin);
            volumes[numbers[root] as usize].1 += a.dot(b.cross(c));
        }
        for &half_edge in &topology.border {
            let root = pieces.root(half_edge / 3) as usize;
            volumes[numbers[root] as usize].1 = 0.0;
        }
        self.components = volumes.len();
        self.inward_components = volumes.iter().filter(|(_, volume)| *volume < 0.0).count();
        let loops = loops::loops(positions, triangles, &topology.border);
        self.boundary_loops = loops.count;
        self.most_boundary_edges = loops.most_edges;
        self.longest_boundary = loops.longest;

        let mut closedness = Closedness {
            boundary: topology.boundary,
            non_manifold: topology.non_manifold,
            inconsistent: topology.inconsistent,
            duplicates: topology.duplicates,
            collapsed: self.collapsed_triangles,
            components: self.components,
            euler_characteristic: self.euler_characteristic,
            ..Closedness::default()
        };
        self.closed = closedness.is_closed();
        if self.closed {
            // χ = 2 (pieces − handles), with positions counted once per fan.
            let fans: i64 = fans.par_iter().map(|&fans| i64::from(fans)).sum();
            let separated = fans - topology.edges as i64 + triangles.len() as i64;
            self.genus = u64::try_from(self.components as i64 - separated / 2).ok();
        }
        closedness.genus = self.genus;
        self.verdict = closedness.to_string();
    }
}

#[cfg(test)]
mod tests;
