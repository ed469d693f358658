//! Cones, truncated cones and cylinders.

use glam::{DVec2, Vec2, Vec3};

use super::MAX_DIVISIONS;
use super::circle::on_circle;
use crate::PolygonMesh;
use crate::polygon_mesh::CornerAttribute;

/// A cone or truncated cone around the y axis from −height/2 to height/2, in `segments` pieces around (at least 3) and
/// `stacks` along the axis.
///
/// The side is smooth, the rims are hard. With `capped` every end that is not a point gets a disc, and the mesh is
/// closed. u runs around from +x over −z, v upward; each disc carries the inscribed circle of the uv square.
/// With both radii zero there is no surface, and the mesh is empty.
pub(super) fn cone(
    bottom_radius: f32,
    top_radius: f32,
    height: f32,
    segments: u32,
    stacks: u32,
    capped: bool,
) -> PolygonMesh {
    if bottom_radius == 0.0 && top_radius == 0.0 {
        return PolygonMesh::default();
    }
    let (segments, stacks) = (segments.clamp(3, MAX_DIVISIONS), stacks.clamp(1, MAX_DIVISIONS));
    let mut cone = Cone { segments, stacks, ..Cone::default() };
    cone.place(bottom_radius, top_radius, height);
    cone.cover_side(bottom_radius - top_radius, height);
    if capped {
        cone.close(0, bottom_radius, -height / 2.0);
        cone.close(stacks, top_radius, height / 2.0);
    }
    let Cone { mut mesh, uvs, .. } = cone;
    mesh.uv_sets.push(uvs);
    mesh
}

#[derive(Default)]
struct Cone {
    segments: u32,
    stacks: u32,
    mesh: PolygonMesh,
    uvs: CornerAttribute<Vec2>,
    /// Where each ring begins in `positions`.
    rings: Vec<u32>,
    /// Whether each ring is a single point.
    points: Vec<bool>,
}

impl Cone {
    fn place(&mut self, bottom_radius: f32, top_radius: f32, height: f32) {
        for stack in 0..=self.stacks {
            let part = stack as f32 / self.stacks as f32;
            let y = (part - 0.5) * height;
            // The ends exactly as given, so that a point is a point.
            let radius = match stack {
                0 => bottom_radius,
                _ if stack == self.stacks => top_radius,
                _ => bottom_radius + (top_radius - bottom_radius) * part,
            };
            self.rings.push(self.mesh.positions.len() as u32);
            self.points.push(radius == 0.0);
            if radius == 0.0 {
                self.mesh.positions.push(Vec3::new(0.0, y, 0.0));
            } else {
                let circle = (0..self.segments).map(|s| on_circle(s, self.segments) * f64::from(radius));
                self.mesh.positions.extend(circle.map(|p| Vec3::new(p.x as f32, y, -p.y as f32)));
            }
        }
    }

    fn at(&self, stack: u32, segment: u32) -> u32 {
        let first = self.rings[stack as usize];
        if self.points[stack as usize] { first } else { first + segment % self.segments }
    }

    fn cover_side(&mut self, narrowing: f32, height: f32) {
        let slope = DVec2::new(f64::from(height), f64::from(narrowing)).normalize_or(DVec2::X);
        let normal =
            |turn: DVec2| Vec3::new((turn.x * slope.x) as f32, slope.y as f32, (-turn.y * slope.x) as f32);
        // One normal on each line from end to end, and one between two lines for the triangles at a point.
        let half_steps = 2 * self.segments;
        self.mesh.normals.values.extend((0..half_steps).map(|s| normal(on_circle(s, half_steps))));
        for stack in 0..=self.stacks {
            let v = stack as f32 / self.stacks as f32;
            let shift = if self.points[stack as usize] { 0.5 } else { 0.0 };
            let u = |segment: u32| (segment as f32 + shift) / self.segments as f32;
            self.uvs.values.extend((0..=self.segments).map(|segment| Vec2::new(u(segment), v)));
        }
        for stack in 0..self.stacks {
            for segment in 0..self.segments {
                self.cover_cell(stack, segment);
            }
        }
    }

    fn cover_cell(&mut self, stack: u32, segment: u32) {
        let cell = [(stack, segment), (stack, segment + 1), (stack + 1, segment + 1), (stack + 1, segment)];
        let [lower_point, upper_point] = [stack, stack + 1].map(|s| self.points[s as usize]);
        // At a point the cell is the triangle that keeps the other side, and the corner there is that of the
        // cell's own segment.
        let kept: &[usize] = match (lower_point, upper_point) {
            (true, _) => &[0, 2, 3],
            (_, true) => &[0, 1, 3],
            _ => &[0, 1, 2, 3],
        };
        for &k in kept {
            let (stack, segment) = cell[k];
            self.mesh.corners.push(self.at(stack, segment));
            self.uvs.corners.push(stack * (self.segments + 1) + segment);
            let between = u32::from(self.points[stack as usize]);
            self.mesh.normals.corners.push((2 * segment + between) % (2 * self.segments));
        }
        self.mesh.face_ends.push(self.mesh.corners.len() as u32);
    }

    /// Puts a disc on the ring `stack` at height `y`.
    fn close(&mut self, stack: u32, radius: f32, y: f32) {
        if radius == 0.0 {
            return;
        }
        let faces_up = stack > 0;
        let center = self.mesh.positions.len() as u32;
        self.mesh.positions.push(Vec3::new(0.0, y, 0.0));
        let normal = self.mesh.normals.values.len() as u32;
        self.mesh.normals.values.push(if faces_up { Vec3::Y } else { Vec3::NEG_Y });
        let middle = self.uvs.values.len() as u32;
        self.uvs.values.push(Vec2::splat(0.5));
        for segment in 0..self.segments {
            let turn = on_circle(segment, self.segments).as_vec2() * 0.5;
            // Upright from outside: the top with −z up, the bottom with +z up.
            let up = if faces_up { turn.y } else { -turn.y };
            self.uvs.values.push(Vec2::new(0.5 + turn.x, 0.5 + up));
        }
        for segment in 0..self.segments {
            let next = (segment + 1) % self.segments;
            let (from, to) = if faces_up { (segment, next) } else { (next, segment) };
            self.mesh.add_face(&[center, self.at(stack, from), self.at(stack, to)]);
            self.uvs.corners.extend([middle, middle + 1 + from, middle + 1 + to]);
            self.mesh.normals.corners.extend([normal; 3]);
        }
    }
}
