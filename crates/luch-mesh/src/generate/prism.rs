//! Bodies over regular polygons: prisms, pyramids, and the polygon itself.

use glam::{DVec2, DVec3, Vec2};

use super::MAX_DIVISIONS;
use super::assembly::Assembly;
use super::circle::{around, on_circle};
use crate::PolygonMesh;

/// See [`super::Generator::Polygon`].
pub(super) fn polygon(sides: u32, radius: f32) -> PolygonMesh {
    let sides = sides.clamp(3, MAX_DIVISIONS);
    let mut assembly = Assembly::default();
    assembly.end(sides, f64::from(radius), 0.0, true);
    assembly.finish()
}

/// See [`super::Generator::Prism`] and [`super::Generator::Pyramid`]: a radius of zero makes a point.
pub(super) fn prism(sides: u32, bottom_radius: f32, top_radius: f32, height: f32) -> PolygonMesh {
    let sides = sides.clamp(3, MAX_DIVISIONS);
    let (bottom, top, height) = (f64::from(bottom_radius), f64::from(top_radius), f64::from(height));
    let mut assembly = Assembly::default();
    // The sides slope as the middle line of each does.
    let narrowing = (bottom - top) * libm::cos(std::f64::consts::PI / f64::from(sides));
    let slope = DVec2::new(height, narrowing).normalize_or(DVec2::X);
    for side in 0..sides {
        let [from, to] = [side, side + 1].map(|corner| on_circle(corner, sides));
        let middle = around(on_circle(2 * side + 1, 2 * sides), slope.x, slope.y);
        let at = |turn, radius, y| around(turn, radius, y * height);
        let u = |corner: u32| corner as f32 / sides as f32;
        let points = [at(from, bottom, -0.5), at(to, bottom, -0.5), at(to, top, 0.5), at(from, top, 0.5)];
        let uvs =
            [(side, 0.0), (side + 1, 0.0), (side + 1, 1.0), (side, 1.0)].map(|(c, v)| Vec2::new(u(c), v));
        match (bottom == 0.0, top == 0.0) {
            (false, false) => assembly.flat_face(&points, &uvs, middle),
            (false, true) => {
                let tip = Vec2::new((uvs[3].x + uvs[2].x) / 2.0, 1.0);
                assembly.flat_face(&points[..3], &[uvs[0], uvs[1], tip], middle);
            }
            (true, _) => {
                let tip = Vec2::new((uvs[0].x + uvs[1].x) / 2.0, 0.0);
                assembly.flat_face(&points[1..], &[tip, uvs[2], uvs[3]], middle);
            }
        }
    }
    assembly.end(sides, bottom, -0.5 * height, false);
    assembly.end(sides, top, 0.5 * height, true);
    assembly.finish()
}

impl Assembly {
    /// The polygon that closes an end, if it has an area; it carries the inscribed circle of the uv square.
    fn end(&mut self, sides: u32, radius: f64, y: f64, faces_up: bool) {
        if radius == 0.0 {
            return;
        }
        let turns = (0..sides).map(|k| on_circle(if faces_up { k } else { sides - k }, sides));
        let turns: Vec<DVec2> = turns.collect();
        let points: Vec<DVec3> = turns.iter().map(|&turn| around(turn, radius, y)).collect();
        let upward = if faces_up { 1.0 } else { -1.0 };
        let uv = |turn: &DVec2| (DVec2::new(turn.x, turn.y * upward) * 0.5 + 0.5).as_vec2();
        let uvs: Vec<Vec2> = turns.iter().map(uv).collect();
        self.flat_face(&points, &uvs, DVec3::Y * upward);
    }
}
