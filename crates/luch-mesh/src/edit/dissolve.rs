//! Fewer faces of the same form: faces joined across edges, vertices on straight edges left out.

use std::collections::VecDeque;

use super::builder::{Builder, NewCorner, Shade};
use super::geometry::{angle_between, area_vector_of, corner_place, place, unit_normals};
use super::prepared;
use crate::PolygonMesh;
use crate::polygon_mesh::HalfEdges;
use crate::sets::DisjointSets;

/// Joins the two faces at each of the given edges to one. Edges that do not have two faces of opposite direction stay.
///
/// Faces that would close up without a border stay as they are. `edges` are rising, lower end first.
pub fn dissolve_edges(mesh: &PolygonMesh, edges: &[[u32; 2]]) -> PolygonMesh {
    let mesh = &*prepared(mesh);
    let half_edges = HalfEdges::new(mesh);
    let mut sets = DisjointSets::new(mesh.face_count());
    for (one, other) in half_edges.opposites().iter().enumerate() {
        let [from, to] = half_edges.ends(one as u32);
        if let &Some(other) = other
            && edges.binary_search(&[from.min(to), from.max(to)]).is_ok()
        {
            sets.join(half_edges.face(one as u32), half_edges.face(other));
        }
    }
    let groups: Vec<u32> = (0..mesh.face_count() as u32).map(|face| sets.root(face)).collect();
    join_groups(mesh, &half_edges, &groups, &[])
}

/// Takes the marked vertices out: the faces around each become one, and a vertex between two edges leaves one edge.
pub fn dissolve_vertices(mesh: &PolygonMesh, vertices: &[bool]) -> PolygonMesh {
    let mesh = &*prepared(mesh);
    let is_marked = |vertex: u32| vertices.get(vertex as usize).copied().unwrap_or(false);
    let half_edges = HalfEdges::new(mesh);
    // A vertex with two edges only is left out without joining its faces.
    let mut degree = vec![0u32; mesh.positions.len()];
    half_edges.edges().flat_map(|edge| edge.vertices).for_each(|vertex| degree[vertex as usize] += 1);
    let joins = |edge: &crate::edges::Edge| {
        edge.vertices.iter().any(|&vertex| is_marked(vertex) && degree[vertex as usize] > 2)
    };
    let mut sets = DisjointSets::new(mesh.face_count());
    for edge in half_edges.edges().filter(joins) {
        if let &[one, other] = edge.half_edges
            && half_edges.ends(one)[0] != half_edges.ends(other)[0]
        {
            sets.join(half_edges.face(one), half_edges.face(other));
        }
    }
    let groups: Vec<u32> = (0..mesh.face_count() as u32).map(|face| sets.root(face)).collect();
    let dropped: Vec<bool> = (0..mesh.positions.len() as u32).map(is_marked).collect();
    join_groups(mesh, &half_edges, &groups, &dropped)
}

/// Joins the marked faces that lie in one plane, within an angle in radians of the first of them, and leaves out the
/// vertices on straight edges between them. Creases, and edges between different slots or groups, stay.
pub fn dissolve_flat(mesh: &PolygonMesh, faces: &[bool], angle: f64) -> PolygonMesh {
    let mesh = &*prepared(mesh);
    let half_edges = HalfEdges::new(mesh);
    let opposites = half_edges.opposites();
    let normals = unit_normals(mesh);
    let mut creases: Vec<[u32; 2]> = mesh
        .creases
        .iter()
        .map(|c| [c.vertices[0].min(c.vertices[1]), c.vertices[0].max(c.vertices[1])])
        .collect();
    creases.sort_unstable();
    let slot = |face: usize| mesh.slots.get(face).copied().unwrap_or(0);
    let group = |face: usize| mesh.smoothing_groups.get(face).copied().unwrap_or(0);
    let is_free =
        |face: usize| faces.get(face).copied().unwrap_or(false) && normals[face] != glam::DVec3::ZERO;
    const NONE: u32 = u32::MAX;
    let mut groups = vec![NONE; mesh.face_count()];
    for seed in 0..mesh.face_count() {
        if groups[seed] != NONE {
            continue;
        }
        groups[seed] = seed as u32;
        let mut open = VecDeque::from(if is_free(seed) { vec![seed] } else { Vec::new() });
        while let Some(face) = open.pop_front() {
            for corner in mesh.face(face) {
                let Some(other) = opposites[corner] else { continue };
                let neighbour = half_edges.face(other) as usize;
                let [from, to] = half_edges.ends(corner as u32);
                let joins = groups[neighbour] == NONE
                    && is_free(neighbour)
                    && slot(neighbour) == slot(seed)
                    && group(neighbour) == group(seed)
                    && angle_between(normals[seed], normals[neighbour]) <= angle
                    && creases.binary_search(&[from.min(to), from.max(to)]).is_err();
                if joins {
                    groups[neighbour] = seed as u32;
                    open.push_back(neighbour);
                }
            }
        }
    }
    let joined = join_groups(mesh, &half_edges, &groups, &[]);
    let straight = straight_vertices(&joined, angle.max(1e-6));
    let half_edges = HalfEdges::new(&joined);
    let alone: Vec<u32> = (0..joined.face_count() as u32).collect();
    join_groups(&joined, &half_edges, &alone, &straight)
}

/// Vertices between two edges that run on within an angle, and are no crease's end.
fn straight_vertices(mesh: &PolygonMesh, angle: f64) -> Vec<bool> {
    let half_edges = HalfEdges::new(mesh);
    let mut neighbours: Vec<Vec<u32>> = vec![Vec::new(); mesh.positions.len()];
    for edge in half_edges.edges() {
        let [one, other] = edge.vertices;
        for [vertex, neighbour] in [[one, other], [other, one]] {
            let list = &mut neighbours[vertex as usize];
            // Three are as good as more.
            if list.len() < 3 {
                list.push(neighbour);
            }
        }
    }
    let mut straight: Vec<bool> = neighbours
        .iter()
        .enumerate()
        .map(|(vertex, around)| {
            let &[one, other] = around.as_slice() else { return false };
            let here = place(mesh, vertex as u32);
            let (before, after) = (here - place(mesh, one), place(mesh, other) - here);
            before.cross(after).length() <= libm::sin(angle.min(1.5)) * before.length() * after.length()
                && before.dot(after) > 0.0
        })
        .collect();
    mesh.creases
        .iter()
        .flat_map(|crease| crease.vertices)
        .for_each(|vertex| straight[vertex as usize] = false);
    mesh.sharp_vertices.iter().for_each(|sharp| straight[sharp.vertex as usize] = false);
    straight
}

/// Makes one face of each group of faces, without the dropped vertices where these have two edges left.
fn join_groups(mesh: &PolygonMesh, half_edges: &HalfEdges, groups: &[u32], dropped: &[bool]) -> PolygonMesh {
    let opposites = half_edges.opposites();
    let is_inner = |corner: u32| {
        let group = groups[half_edges.face(corner) as usize];
        opposites[corner as usize].filter(|&other| groups[half_edges.face(other) as usize] == group)
    };
    // Edges that stay, at each vertex.
    let mut degree = vec![0u32; mesh.positions.len()];
    for edge in half_edges.edges().filter(|edge| is_inner(edge.half_edges[0]).is_none()) {
        edge.vertices.iter().for_each(|&vertex| degree[vertex as usize] += 1);
    }
    let is_dropped =
        |vertex: u32| dropped.get(vertex as usize).copied().unwrap_or(false) && degree[vertex as usize] == 2;
    let mut members: Vec<Vec<u32>> = vec![Vec::new(); mesh.face_count()];
    for (face, &group) in groups.iter().enumerate() {
        members[group as usize].push(face as u32);
    }
    let mut is_seen = vec![false; mesh.corners.len()];
    let mut builder = Builder::new(mesh);
    for (first, faces) in members.iter().enumerate().filter(|(_, faces)| !faces.is_empty()) {
        let mut loops: Vec<Vec<u32>> = Vec::new();
        for corner in faces.iter().flat_map(|&face| mesh.face(face as usize)) {
            let start = corner as u32;
            if is_seen[corner] || is_inner(start).is_some() {
                continue;
            }
            let (mut border, mut at) = (Vec::new(), start);
            while !is_seen[at as usize] {
                is_seen[at as usize] = true;
                border.push(at);
                // On around the end vertex, through the faces of the group.
                at = half_edges.next(at);
                while let Some(other) = is_inner(at) {
                    at = half_edges.next(other);
                }
            }
            loops.push(border);
        }
        let thinned = |border: &Vec<u32>| {
            let stays = |corner: &&u32| !is_dropped(mesh.corners[**corner as usize]);
            let kept: Vec<u32> = border.iter().filter(stays).copied().collect();
            // Dropping must leave a polygon.
            if kept.len() > 2 { kept } else { border.clone() }
        };
        let mut loops: Vec<Vec<u32>> = loops.iter().map(thinned).collect();
        loops.retain(|border| border.len() > 2);
        if loops.is_empty() || (faces.len() == 1 && dropped.is_empty()) {
            faces.iter().for_each(|&face| builder.copy_face(face as usize));
            continue;
        }
        // The outer border has the largest area.
        let area = |border: &Vec<u32>| {
            area_vector_of(border.iter().map(|&corner| corner_place(mesh, corner as usize))).length_squared()
        };
        let outer =
            (0..loops.len()).rev().max_by(|&one, &other| area(&loops[one]).total_cmp(&area(&loops[other])));
        let outer = loops.remove(outer.unwrap_or(0));
        let borders = std::iter::once(outer).chain(loops).map(|border| {
            border.iter().map(|&corner| NewCorner::like(mesh.corners[corner as usize], corner)).collect()
        });
        builder.face(first, &borders.collect::<Vec<Vec<_>>>(), Shade::Mixed, None);
    }
    builder.finish()
}
