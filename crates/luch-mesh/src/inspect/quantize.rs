//! What fewer bits would cost.

use glam::{Vec2, Vec3};
use serde::Serialize;

use crate::TriangleMesh;

/// The error of storing values with so many bits for each component.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Precision {
    /// Bits of each component.
    pub bits: u32,
    /// The farthest a value can move: metres for positions, parts of the picture for uvs, radians for normals.
    pub error: f64,
}

/// What fewer bits would cost; empty where the mesh has no such values.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Quantization {
    /// Positions as three whole numbers over the bounds.
    pub positions: Vec<Precision>,
    /// The fewest bits at which positions move by less than a tenth of the shortest edge, up to 24.
    pub position_bits: Option<u32>,
    /// Uvs as two whole numbers over their range.
    pub uvs: Vec<Precision>,
    /// Normals as two whole numbers over an octahedron (Meyer et al., "On floating-point normal vectors", 2010), tried out on
    /// up to 65 536 of them.
    pub normals: Vec<Precision>,
}

/// Tried for all kinds.
const BITS: [u32; 6] = [8, 10, 12, 14, 16, 20];

pub(super) fn quantization(mesh: &TriangleMesh, extent: Vec3, shortest_edge: f64) -> Quantization {
    let half_diagonal = |extent: f64, bits: u32| extent / f64::from((1u32 << bits) - 1) / 2.0;
    let size = extent.as_dvec3().length();
    let list = |size: f64| BITS.map(|bits| Precision { bits, error: half_diagonal(size, bits) }).to_vec();
    let mut quantization = Quantization::default();
    if !mesh.positions.is_empty() && size.is_finite() {
        quantization.positions = list(size);
        quantization.position_bits = (1..=24).find(|&bits| half_diagonal(size, bits) < shortest_edge / 10.0);
    }
    if let Some(uvs) = mesh.uv_sets.first().filter(|uvs| !uvs.is_empty()) {
        let (mut least, mut most) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
        for &uv in &uvs.values {
            (least, most) = (least.min(uv), most.max(uv));
        }
        quantization.uvs = list((most.as_dvec2() - least.as_dvec2()).length());
    }
    let step = mesh.normals.values.len().div_ceil(1 << 16).max(1);
    let tried: Vec<Vec3> =
        mesh.normals.values.iter().step_by(step).filter_map(|normal| normal.try_normalize()).collect();
    if !tried.is_empty() {
        quantization.normals = [6, 8, 10, 12, 16]
            .map(|bits| {
                let errors =
                    tried.iter().map(|&normal| angle_between(normal, through_octahedron(normal, bits)));
                Precision { bits, error: errors.fold(0.0, f64::max) }
            })
            .to_vec();
    }
    quantization
}

fn angle_between(one: Vec3, other: Vec3) -> f64 {
    let (one, other) = (one.as_dvec3(), other.as_dvec3());
    libm::atan2(one.cross(other).length(), one.dot(other))
}

/// A unit vector after it was stored as a rounded point of the unfolded octahedron.
fn through_octahedron(normal: Vec3, bits: u32) -> Vec3 {
    let sign = |number: f32| if number < 0.0 { -1.0 } else { 1.0 };
    let fold =
        |point: Vec2| Vec2::new((1.0 - point.y.abs()) * sign(point.x), (1.0 - point.x.abs()) * sign(point.y));
    let flat = normal / (normal.x.abs() + normal.y.abs() + normal.z.abs());
    let mut point = Vec2::new(flat.x, flat.y);
    if flat.z < 0.0 {
        point = fold(point);
    }
    // An odd number of steps: the middle and the corners are exact.
    let most = ((1u32 << (bits - 1)) - 1) as f32;
    let point = (point * most).round() / most;
    let height = 1.0 - point.x.abs() - point.y.abs();
    let flat = if height < 0.0 { fold(point) } else { point };
    flat.extend(height).normalize()
}
