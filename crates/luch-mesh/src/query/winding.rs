//! The generalised winding number, with far triangles taken together (Barill et al., "Fast winding numbers for soups and
//! clouds", 2018): to first order each node of the tree is a dipole at the middle of its area.

use std::f64::consts::PI;

use glam::DVec3;
use rayon::prelude::*;

use super::tree::BoxTree;
use crate::TriangleMesh;

/// A node is far if it is farther than so many times its radius.
const FAR: f64 = 3.0;

#[derive(Clone, Copy, Default)]
struct Dipole {
    area: f64,
    /// Σ area · middle, then the middle.
    middle: DVec3,
    /// Σ area · normal.
    moment: DVec3,
    radius: f64,
}

/// For each node of a tree what it is from afar.
pub(super) struct Dipoles {
    nodes: Vec<Dipole>,
}

impl Dipoles {
    pub(super) fn new(mesh: &TriangleMesh, tree: &BoxTree) -> Self {
        let mut nodes = vec![Dipole::default(); tree.node_count()];
        let leaf = |triangles: &[u32]| {
            let mut sum = Dipole::default();
            for &triangle in triangles {
                let [a, b, c] = mesh.corners(triangle as usize).map(|corner| corner.as_dvec3());
                let moment = (b - a).cross(c - a) / 2.0;
                let area = moment.length();
                sum.area += area;
                sum.moment += moment;
                sum.middle += (a + b + c) / 3.0 * area;
            }
            sum
        };
        nodes.par_iter_mut().enumerate().for_each(|(node, dipole)| {
            if let Some(triangles) = tree.leaf(node) {
                *dipole = leaf(triangles);
            }
        });
        for node in (1..nodes.len()).rev().filter(|&node| tree.leaf(node).is_none()) {
            let (one, other) = (nodes[2 * node], nodes[2 * node + 1]);
            nodes[node] = Dipole {
                area: one.area + other.area,
                middle: one.middle + other.middle,
                moment: one.moment + other.moment,
                radius: 0.0,
            };
        }
        nodes.par_iter_mut().enumerate().skip(1).for_each(|(node, dipole)| {
            let bounds = tree.bounds(node);
            if dipole.area > 0.0 {
                dipole.middle /= dipole.area;
                let (low, high) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
                dipole.radius = (dipole.middle - low).abs().max((high - dipole.middle).abs()).length();
            }
        });
        Self { nodes }
    }

    pub(super) fn winding_number(&self, mesh: &TriangleMesh, tree: &BoxTree, point: DVec3) -> f64 {
        if tree.is_empty() || !point.is_finite() {
            return 0.0;
        }
        let mut sum = 0.0;
        let mut stack = [0usize; 64];
        stack[0] = 1;
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let node = stack[height];
            let dipole = &self.nodes[node];
            let away = dipole.middle - point;
            let distance = away.length();
            if dipole.area == 0.0 || tree.bounds(node).is_empty() {
                continue;
            }
            if distance > FAR * dipole.radius {
                sum += away.dot(dipole.moment) / (distance * distance * distance);
            } else if let Some(triangles) = tree.leaf(node) {
                for &triangle in triangles {
                    sum += solid_angle(mesh.corners(triangle as usize).map(|c| c.as_dvec3() - point));
                }
            } else {
                stack[height] = 2 * node + 1;
                stack[height + 1] = 2 * node;
                height += 2;
            }
        }
        sum / (4.0 * PI)
    }
}

/// The signed solid angle of a triangle from the origin (van Oosterom & Strackee 1983).
fn solid_angle([a, b, c]: [DVec3; 3]) -> f64 {
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    let volume = a.dot(b.cross(c));
    let denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    if volume == 0.0 { 0.0 } else { 2.0 * libm::atan2(volume, denominator) }
}
