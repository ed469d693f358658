//! A closed body under a sheet.

use glam::{DVec2, Vec2, Vec3};

use super::{HeightError, HeightField};
use crate::edges::{Edges, corner_at, half_edge_ends};
use crate::sets::DisjointSets;
use crate::{Attribute, TriangleMesh, patch};

/// The body between a sheet over the field and a floor at height `base`, with upright walls at its border and around holes.
///
/// `sheet` comes from [`super::sheet()`] or [`super::reduced`]. The rim is sharp. Where two parts of the sheet touch in a
/// point only, each gets a wall of its own.
///
/// # Errors
/// If the floor is not below the lowest point.
pub fn solid(field: &HeightField, sheet: &TriangleMesh, base: f32) -> Result<TriangleMesh, HeightError> {
    field.check()?;
    let lowest = sheet.positions.iter().map(|p| p.y).fold(f32::INFINITY, f32::min);
    if !base.is_finite() || base >= lowest {
        return Err(HeightError::Base { base, lowest });
    }
    let count = sheet.positions.len();
    let fans = Fans::new(sheet);
    let edges = Edges::new(&sheet.triangles, count);
    let rim: Vec<[u32; 2]> = edges
        .iter(&sheet.triangles)
        .filter(|edge| edge.half_edges.len() == 1)
        .map(|edge| half_edge_ends(&sheet.triangles, edge.half_edges[0]))
        .collect();
    let floor = rim_floor(field, sheet, &rim)
        .filter(|_| !fans.is_pinched())
        .unwrap_or_else(|| sheet.triangles.clone());

    // Upper positions by fan, then the floor's.
    let mut mesh = TriangleMesh {
        positions: fans.positions.iter().map(|&p| sheet.positions[p as usize]).collect(),
        triangles: fans.triangles.clone(),
        ..TriangleMesh::default()
    };
    let mut normals = sheet.normals.values.clone();
    let mut uvs = sheet.uv_sets.first().map(|set| set.values.clone()).unwrap_or_default();
    let mut normal_triangles = sheet.triangles.clone();
    let mut uv_triangles = sheet.triangles.clone();
    let below = mesh.positions.len() as u32;
    mesh.positions.extend_from_within(..);
    mesh.positions[below as usize..].iter_mut().for_each(|p| p.y = base);
    let down = normals.len() as u32;
    normals.push(Vec3::NEG_Y);
    // The floor faces down, its picture mirrored so that it reads from below.
    let floor_uvs = uvs.len() as u32;
    uvs.extend_from_within(..);
    uvs[floor_uvs as usize..].iter_mut().for_each(|uv| uv.x = 1.0 - uv.x);
    let pinched = fans.is_pinched();
    for (t, triangle) in floor.iter().enumerate() {
        // Without pinches fans are positions; with them the floor repeats the sheet.
        let [a, b, c] = if pinched { fans.triangles[t] } else { triangle.map(|p| fans.first_of[p as usize]) };
        mesh.triangles.push([a, c, b].map(|v| v + below));
        normal_triangles.push([down; 3]);
        let [a, b, c] = *triangle;
        uv_triangles.push([a, c, b].map(|v| v + floor_uvs));
    }
    // Walls: the rim's half-edges run with the sheet on their left, so outward is to their right.
    for (edge, upper) in rim.iter().zip(fans.rim(sheet, &edges)) {
        let [from, to] = edge.map(|p| sheet.positions[p as usize]);
        let along = Vec2::new(to.x - from.x, to.z - from.z).normalize_or_zero();
        let normal = normals.len() as u32;
        normals.push(Vec3::new(-along.y, 0.0, along.x));
        let [a, b] = upper;
        mesh.triangles.extend([[a, a + below, b + below], [a, b + below, b]]);
        normal_triangles.extend([[normal; 3]; 2]);
        // Each wall piece a picture of its own: metres along and up.
        let first = uvs.len() as u32;
        let length = Vec2::new(to.x - from.x, to.z - from.z).length();
        uvs.extend([
            Vec2::new(0.0, from.y - base),
            Vec2::ZERO,
            Vec2::new(length, 0.0),
            Vec2::new(length, to.y - base),
        ]);
        uv_triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    mesh.normals = Attribute::indexed(normals, normal_triangles);
    mesh.uv_sets = vec![Attribute::indexed(uvs, uv_triangles)];
    // The floor may need only the rim.
    Ok(crate::clean::remove_unused_positions(&mesh).mesh)
}

/// The sheet's positions, once for each fan of triangles.
struct Fans {
    /// The sheet's position of each.
    positions: Vec<u32>,
    triangles: Vec<[u32; 3]>,
    /// The first fan at each position.
    first_of: Vec<u32>,
}

impl Fans {
    fn new(sheet: &TriangleMesh) -> Self {
        let triangles = &sheet.triangles;
        let mut sets = DisjointSets::new(triangles.len() * 3);
        for edge in Edges::new(triangles, sheet.positions.len()).iter(triangles) {
            if let &[one, other] = edge.half_edges {
                for vertex in edge.vertices {
                    sets.join(corner_at(triangles, one, vertex), corner_at(triangles, other, vertex));
                }
            }
        }
        const UNSEEN: u32 = u32::MAX;
        let mut number_of = vec![UNSEEN; triangles.len() * 3];
        let mut first_of = vec![UNSEEN; sheet.positions.len()];
        let mut positions = Vec::new();
        let mut fans = Vec::with_capacity(triangles.len());
        for (t, corners) in triangles.iter().enumerate() {
            fans.push(std::array::from_fn(|k| {
                let root = sets.root((t * 3 + k) as u32) as usize;
                if number_of[root] == UNSEEN {
                    number_of[root] = positions.len() as u32;
                    let first = &mut first_of[corners[k] as usize];
                    *first = (*first).min(positions.len() as u32);
                    positions.push(corners[k]);
                }
                number_of[root]
            }));
        }
        Self { positions, triangles: fans, first_of }
    }

    fn is_pinched(&self) -> bool {
        let used = self.first_of.iter().filter(|first| **first != u32::MAX).count();
        self.positions.len() > used
    }

    /// The ends of the rim's half-edges as fans.
    fn rim<'a>(&'a self, sheet: &'a TriangleMesh, edges: &'a Edges) -> impl Iterator<Item = [u32; 2]> + 'a {
        let half_edges = edges.iter(&sheet.triangles).filter(|edge| edge.half_edges.len() == 1);
        half_edges.map(|edge| half_edge_ends(&self.triangles, edge.half_edges[0]))
    }
}

/// Triangles that need the rim's vertices only; `None` if the rim touches itself.
fn rim_floor(field: &HeightField, sheet: &TriangleMesh, rim: &[[u32; 2]]) -> Option<Vec<[u32; 3]>> {
    let mut number_of = vec![u32::MAX; sheet.positions.len()];
    let (mut points, mut corners) = (Vec::new(), Vec::new());
    let last = DVec2::new(f64::from(field.width - 1), f64::from(field.height - 1));
    let mut segments = Vec::with_capacity(rim.len());
    for edge in rim {
        segments.push(edge.map(|p| {
            let number = &mut number_of[p as usize];
            if *number == u32::MAX {
                *number = points.len() as u32;
                corners.push(p);
                // Whole numbers of cells, counted from the lower left.
                let place = sheet.positions[p as usize];
                let share = DVec2::new(f64::from(place.x), f64::from(-place.z)) / field.size.as_dvec2() + 0.5;
                points.push((share * last).round());
            }
            *number
        }));
    }
    let triangles = patch::region_triangles(&points, &segments, field.height as usize)?;
    Some(triangles.iter().map(|triangle| triangle.map(|p| corners[p as usize])).collect())
}
