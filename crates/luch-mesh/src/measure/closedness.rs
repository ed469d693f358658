//! Closed or open, and why: border edges, edges of more than two triangles, winding, pieces, genus.

use std::fmt;

use crate::TriangleMesh;
use crate::edges::{Edges, corner_at, half_edge_ends};
use crate::sets::DisjointSets;

/// Edges with the same fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EdgeFault {
    /// How many edges have it.
    pub count: usize,
    /// The end positions of the first.
    pub first: [u32; 2],
}

/// What the edges of a mesh say about the surface.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Closedness {
    /// Edges of only one triangle: the surface has a border there.
    pub boundary: Option<EdgeFault>,
    /// Edges of more than two triangles.
    pub non_manifold: Option<EdgeFault>,
    /// Edges whose two triangles run along them in the same direction: one of them is inside out.
    pub inconsistent: Option<EdgeFault>,
    /// Triangles with the same three positions as an earlier one.
    pub duplicates: usize,
    /// Triangles with a repeated position. They are left out of everything else.
    pub collapsed: usize,
    /// Positions where several fans of triangles touch in a point only.
    pub pinched: usize,
    /// Pieces joined by edges.
    pub components: usize,
    /// Positions used − edges + triangles.
    pub euler_characteristic: i64,
    /// Number of handles of all pieces together; only for closed surfaces.
    pub genus: Option<u64>,
}

impl Closedness {
    /// True if the surface encloses a body: every edge has exactly two triangles of opposite direction, and there is
    /// at least one triangle.
    pub fn is_closed(&self) -> bool {
        let sound = self.boundary.is_none() && self.non_manifold.is_none() && self.inconsistent.is_none();
        sound && self.components > 0
    }
}

impl fmt::Display for Closedness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_closed() {
            let pieces = if self.components == 1 { "piece" } else { "pieces" };
            write!(f, "closed ({} {pieces}", self.components)?;
            if let Some(genus) = self.genus {
                write!(f, ", genus {genus}")?;
            }
            return f.write_str(")");
        }
        let faults = [
            (&self.boundary, "border edges"),
            (&self.non_manifold, "edges with more than two triangles"),
            (&self.inconsistent, "edges with triangles of opposed winding"),
        ];
        let mut reasons = Vec::new();
        if self.components == 0 {
            reasons.push("there are no triangles".to_owned());
        }
        for (fault, name) in faults {
            if let Some(EdgeFault { count, first: [a, b] }) = fault {
                reasons.push(format!("{count} {name} (the first joins positions {a} and {b})"));
            }
        }
        if self.duplicates > 0 {
            reasons.push(format!("{} triangles twice", self.duplicates));
        }
        let verdict = if self.boundary.is_some() || self.components == 0 { "open" } else { "not closed" };
        write!(f, "{verdict}: {}", reasons.join(", "))
    }
}

/// Examines the edges of a mesh. Positions count as the same only by index: weld first if the file repeats them.
pub fn closedness(mesh: &TriangleMesh) -> Closedness {
    let mut report = Closedness::default();
    let whole =
        |corners: &[u32; 3]| corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0];
    let kept: Vec<[u32; 3]>;
    let triangles = if mesh.triangles.iter().all(whole) {
        &mesh.triangles
    } else {
        kept = mesh.triangles.iter().copied().filter(whole).collect();
        report.collapsed = mesh.triangles.len() - kept.len();
        &kept
    };
    let edges = Edges::new(triangles, mesh.positions.len());
    let mut pieces = DisjointSets::new(triangles.len());
    let mut fans = DisjointSets::new(triangles.len() * 3);
    for edge in edges.iter(triangles) {
        let first_use = edge.half_edges[0];
        match *edge.half_edges {
            [_] => note(&mut report.boundary, edge.vertices),
            [one, other] => {
                if half_edge_ends(triangles, one)[0] == half_edge_ends(triangles, other)[0] {
                    note(&mut report.inconsistent, edge.vertices);
                }
                for vertex in edge.vertices {
                    fans.join(corner_at(triangles, one, vertex), corner_at(triangles, other, vertex));
                }
            }
            _ => note(&mut report.non_manifold, edge.vertices),
        }
        for &half_edge in &edge.half_edges[1..] {
            pieces.join(first_use / 3, half_edge / 3);
        }
    }
    report.duplicates = duplicate_count(triangles);
    report.components = (0..triangles.len() as u32).filter(|&t| pieces.root(t) == t).count();

    // Count positions used, and fans per position.
    let mut fans_at = vec![0u32; mesh.positions.len()];
    for corner in 0..triangles.len() as u32 * 3 {
        if fans.root(corner) == corner {
            fans_at[triangles[corner as usize / 3][corner as usize % 3] as usize] += 1;
        }
    }
    let used = fans_at.iter().filter(|&&n| n > 0).count() as i64;
    report.euler_characteristic = used - edges.len() as i64 + triangles.len() as i64;
    if report.non_manifold.is_none() {
        report.pinched = fans_at.iter().filter(|&&n| n > 1).count();
    }
    if report.is_closed() {
        // χ = 2 (pieces − handles), with positions counted once per fan.
        let fan_count = fans_at.iter().map(|&n| i64::from(n)).sum::<i64>();
        let separated = fan_count - edges.len() as i64 + triangles.len() as i64;
        report.genus = u64::try_from(report.components as i64 - separated / 2).ok();
    }
    report
}

fn note(fault: &mut Option<EdgeFault>, vertices: [u32; 2]) {
    fault.get_or_insert(EdgeFault { count: 0, first: vertices }).count += 1;
}

fn duplicate_count(triangles: &[[u32; 3]]) -> usize {
    let sorted = |corners: &[u32; 3]| {
        let mut corners = *corners;
        corners.sort_unstable();
        corners
    };
    let mut keys: Vec<[u32; 3]> = triangles.iter().map(sorted).collect();
    keys.sort_unstable();
    keys.windows(2).filter(|pair| pair[0] == pair[1]).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate;
    use glam::Vec3;

    #[test]
    fn a_box_without_lid_says_where() {
        let mut mesh = generate::cuboid(Vec3::ONE, [1, 1, 1]);
        assert_eq!(closedness(&mesh).to_string(), "closed (1 piece, genus 0)");
        mesh.triangles.pop();
        let report = closedness(&mesh);
        assert_eq!(report.boundary.unwrap().count, 3);
        assert!(
            report.to_string().starts_with("open: 3 border edges (the first joins positions"),
            "{report}"
        );
    }

    #[test]
    fn one_triangle_inside_out_is_three_edges() {
        let mut mesh = generate::cuboid(Vec3::ONE, [1, 1, 1]);
        mesh.triangles[5].swap(0, 1);
        let report = closedness(&mesh);
        assert_eq!(report.inconsistent.unwrap().count, 3);
        assert!(!report.is_closed() && report.boundary.is_none());
    }

    #[test]
    fn a_face_twice_is_no_manifold() {
        let mut mesh = generate::cuboid(Vec3::ONE, [1, 1, 1]);
        mesh.triangles.push(mesh.triangles[0]);
        mesh.triangles.push([4, 4, 1]);
        let report = closedness(&mesh);
        assert_eq!((report.duplicates, report.non_manifold.unwrap().count, report.collapsed), (1, 3, 1));
    }

    #[test]
    fn two_tetrahedra_touching_in_a_point_are_two_pieces() {
        let tetrahedron = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let other = tetrahedron.map(|t| t.map(|i| if i == 3 { 3 } else { i + 4 }));
        let mesh = TriangleMesh::new(vec![Vec3::ZERO; 7], [tetrahedron, other].concat());
        let report = closedness(&mesh);
        assert!(report.is_closed());
        assert_eq!((report.components, report.pinched, report.genus), (2, 1, Some(0)));
        assert_eq!(report.euler_characteristic, 3);
    }

    #[test]
    fn nothing_is_not_closed() {
        assert_eq!(closedness(&TriangleMesh::default()).to_string(), "open: there are no triangles");
    }
}
