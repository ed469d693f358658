//! A car made of patches: an example of many patches with smooth joints.
//!
//! The body is one bicubic B-spline surface with equal knots: rings of points around, one behind the other. The first and
//! last rings are chosen so that the surface closes in a point with a flat nose and tail. The wheels are rings too. Points are
//! whole multiples of 36 mm. A B-spline with equal knots has Bezier points that are its points in whole parts of 36, so
//! those are whole millimetres: the patches join with equal tangents and curvatures to the last digit, in a short file.

use glam::{DVec2, DVec3};

use super::{ControlPoint, Knots, PatchError, PatchModel, Surface};

/// The millimetres of one unit.
const UNIT: f64 = 0.036;

/// A cross-section of the body, in whole units: the left half from the middle of the floor to the middle of the roof.
struct Section {
    z: f64,
    /// Half widths at floor, sill, belt, shoulder, roof.
    widths: [f64; 5],
    /// Heights of floor, sill, belt, shoulder, roof.
    heights: [f64; 5],
}

/// From tail to nose.
const SECTIONS: [Section; 13] = [
    Section { z: -54.0, widths: [11.0, 15.0, 17.0, 15.0, 8.0], heights: [9.0, 10.0, 17.0, 22.0, 24.0] },
    Section { z: -52.0, widths: [16.0, 22.0, 23.0, 21.0, 14.0], heights: [7.0, 9.0, 18.0, 25.0, 27.0] },
    Section { z: -46.0, widths: [17.0, 24.0, 25.0, 22.0, 15.0], heights: [6.0, 8.0, 18.0, 26.0, 28.0] },
    Section { z: -37.0, widths: [17.0, 24.0, 25.0, 22.0, 15.0], heights: [5.0, 7.0, 18.0, 26.0, 29.0] },
    Section { z: -28.0, widths: [17.0, 24.0, 25.0, 21.0, 14.0], heights: [5.0, 7.0, 18.0, 27.0, 36.0] },
    Section { z: -17.0, widths: [17.0, 24.0, 25.0, 21.0, 14.0], heights: [5.0, 7.0, 18.0, 28.0, 42.0] },
    Section { z: -6.0, widths: [17.0, 24.0, 25.0, 21.0, 14.0], heights: [5.0, 7.0, 18.0, 28.0, 43.0] },
    Section { z: 5.0, widths: [17.0, 24.0, 25.0, 21.0, 14.0], heights: [5.0, 7.0, 18.0, 28.0, 42.0] },
    Section { z: 14.0, widths: [17.0, 24.0, 25.0, 22.0, 15.0], heights: [5.0, 7.0, 18.0, 26.0, 34.0] },
    Section { z: 23.0, widths: [17.0, 24.0, 25.0, 22.0, 15.0], heights: [5.0, 7.0, 18.0, 25.0, 27.0] },
    Section { z: 36.0, widths: [17.0, 24.0, 25.0, 21.0, 14.0], heights: [5.0, 7.0, 17.0, 23.0, 25.0] },
    Section { z: 48.0, widths: [16.0, 22.0, 23.0, 19.0, 12.0], heights: [6.0, 8.0, 16.0, 20.0, 21.0] },
    Section { z: 51.0, widths: [10.0, 14.0, 16.0, 13.0, 7.0], heights: [8.0, 9.0, 14.0, 17.0, 18.0] },
];

impl Section {
    /// Twelve points around, counter-clockwise seen from the nose.
    fn ring(&self) -> [DVec3; 12] {
        let half = |k: usize, side: f64| DVec3::new(side * self.widths[k], self.heights[k], self.z);
        let middle = |k: usize| DVec3::new(0.0, self.heights[k], self.z);
        [
            middle(0),
            half(0, 1.0),
            half(1, 1.0),
            half(2, 1.0),
            half(3, 1.0),
            half(4, 1.0),
            middle(4),
            half(4, -1.0),
            half(3, -1.0),
            half(2, -1.0),
            half(1, -1.0),
            half(0, -1.0),
        ]
    }
}

/// A body of about four metres along z, its nose toward +z, with four wheels that stand on y = 0. Every part is closed.
///
/// # Errors
/// None in fact; the type is that of the functions beneath.
pub fn car_body() -> Result<PatchModel, PatchError> {
    let mut rings: Vec<Vec<DVec3>> = SECTIONS.iter().map(|section| section.ring().to_vec()).collect();
    let tail = closing_ring(&rings[0], &rings[1]);
    let nose = closing_ring(&rings[SECTIONS.len() - 1], &rings[SECTIONS.len() - 2]);
    rings.insert(0, tail);
    rings.push(nose);
    let mut surfaces = vec![closed_rings(&rings)?];
    for z in [-32.0, 34.0] {
        for side in [-1.0, 1.0] {
            surfaces.push(wheel(DVec3::new(side * 21.0, 9.0, z))?);
        }
    }
    let pieces = surfaces.iter().flat_map(Surface::bezier_pieces).map(|piece| in_millimetres(&piece));
    Ok(PatchModel::from_iter(pieces.collect::<Result<Vec<_>, _>>()?))
}

/// The ring before `first` that makes the surface begin in a point: a uniform cubic begins at (p₀ + 4 p₁ + p₂) / 6, which
/// has to be one point `c` for all three rings around. With all rings flat across z, so is the surface there.
fn closing_ring(first: &[DVec3], second: &[DVec3]) -> Vec<DVec3> {
    let sum = |ring: &[DVec3]| ring.iter().sum::<DVec3>();
    // The middle of both rings, in whole units.
    let centre = ((sum(first) + sum(second)) / (2.0 * first.len() as f64)).round();
    let ends = first.iter().zip(second);
    ends.map(|(near, far)| {
        let flat = 6.0 * centre - 4.0 * *near - *far;
        DVec3::new(flat.x, flat.y, far.z)
    })
    .collect()
}

/// A tyre around the x axis through `centre`: closed both ways.
fn wheel(centre: DVec3) -> Result<Surface, PatchError> {
    // Around the tyre: half width and radius. Around the axle: eight points at unit radius, times twelve.
    let profile = [(3.0, 9.0), (4.0, 8.0), (3.0, 3.0), (-3.0, 3.0), (-4.0, 8.0), (-3.0, 9.0)];
    let around = [
        (4.0, 0.0),
        (3.0, 3.0),
        (0.0, 4.0),
        (-3.0, 3.0),
        (-4.0, 0.0),
        (-3.0, -3.0),
        (0.0, -4.0),
        (3.0, -3.0),
    ];
    let ring = |&(x, radius): &(f64, f64)| {
        let place = |&(y, z): &(f64, f64)| {
            let spoke = (DVec2::new(y, z) * radius / 4.0).round();
            centre + DVec3::new(x, spoke.x, spoke.y)
        };
        around.iter().map(place).collect::<Vec<_>>()
    };
    let mut rings: Vec<Vec<DVec3>> = profile.iter().map(ring).collect();
    rings.extend_from_within(..3);
    closed_rings(&rings)
}

/// A bicubic surface with equal knots over rings of points, closed around.
fn closed_rings(rings: &[Vec<DVec3>]) -> Result<Surface, PatchError> {
    let equal = |points: usize| Knots::new(3, (0..points + 4).map(|k| k as f64).collect());
    let around = rings[0].len() + 3;
    let points = rings.iter().flat_map(|ring| ring.iter().cycle().take(around));
    let points: Vec<_> = points.map(|p| ControlPoint::new(*p * UNIT)).collect();
    Surface::new([equal(around)?, equal(rings.len())?], &points)
}

/// The piece with the rounding of its computation taken away: its points are whole millimetres.
fn in_millimetres(piece: &Surface) -> Result<Surface, PatchError> {
    let points = piece.points().map(|point| {
        let place = (point.position * 1000.0).round() / 1000.0;
        // Adding zero makes −0 and 0 one.
        ControlPoint::new(place + DVec3::ZERO)
    });
    Surface::new(piece.knots().clone(), &points.collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure;
    use crate::patch::{Fineness, Side};

    #[test]
    fn rounding_to_millimetres_changes_nothing() {
        let rings: Vec<_> = SECTIONS.iter().map(|section| section.ring().to_vec()).collect();
        for piece in closed_rings(&rings).unwrap().bezier_pieces() {
            let rounded = in_millimetres(&piece).unwrap();
            assert!(
                piece.points().zip(rounded.points()).all(|(a, b)| a.position.distance(b.position) < 1e-12)
            );
        }
    }

    /// Across every side that two patches share the tangent planes are the same.
    #[test]
    fn the_body_is_smooth_over_all_joints() {
        let model = car_body().unwrap();
        let mut joints = 0;
        for (k, one) in model.patches.iter().enumerate() {
            for other in &model.patches[k + 1..] {
                for (near, far, at, across) in [
                    (Side::Right, Side::Left, [1.0, 0.0], [0.0, 0.0]),
                    (Side::Top, Side::Bottom, [0.0, 1.0], [0.0, 0.0]),
                ] {
                    for (first, second) in [(one, other), (other, one)] {
                        if first.surface.side(near) != second.surface.side(far) {
                            continue;
                        }
                        joints += 1;
                        for step in 0..=4 {
                            let t = f64::from(step) / 4.0;
                            let along =
                                |at: [f64; 2]| if near == Side::Right { [at[0], t] } else { [t, at[1]] };
                            let ([u, v], [s, w]) = (along(at), along(across));
                            let normals =
                                [first.surface.normal(u, v), second.surface.normal(s, w)].map(Option::unwrap);
                            assert!(normals[0].distance(normals[1]) < 1e-9);
                        }
                    }
                }
            }
        }
        // Twelve around and twelve along the body, but for the two points; eight by six on each wheel.
        assert_eq!(joints, 12 * 12 + 12 * 11 + 4 * 2 * 48);
    }

    #[test]
    fn all_five_parts_are_closed() {
        let mesh = car_body().unwrap().tessellate(Fineness::Tolerance(0.01)).unwrap();
        assert_eq!(measure::closedness(&mesh).to_string(), "closed (5 pieces, genus 4)");
        let bounds = mesh.bounds();
        assert!((3.5..4.2).contains(&(bounds.max.z - bounds.min.z)) && bounds.min.y.abs() < 0.05);
        assert!(measure::volume(&mesh) > 3.0);
    }
}
