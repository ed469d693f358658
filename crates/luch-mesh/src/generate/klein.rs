//! The Klein bottle in two of its forms.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::MAX_DIVISIONS;
use super::circle::around;
use super::grid::{Grid, Join, Sample};
use crate::PolygonMesh;

/// How the Klein bottle lies in space; it must cross itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum KleinForm {
    /// A bottle whose neck goes through its side to its bottom. `size` is its height.
    Bottle,
    /// A figure eight that turns by half while it goes around. `size` is the diameter of the circle it goes along.
    FigureEight,
}

/// See [`super::Generator::KleinBottle`].
pub(super) fn klein_bottle(form: KleinForm, size: f32, segments: u32, sides: u32) -> PolygonMesh {
    let (segments, sides) = (segments.clamp(3, MAX_DIVISIONS), sides.clamp(3, MAX_DIVISIONS));
    let size = f64::from(size);
    let place = |along: f64, section: f64| match form {
        KleinForm::Bottle => bottle(along, section) * size,
        KleinForm::FigureEight => figure_eight(along, section) * size,
    };
    let grid =
        Grid { columns: segments, rows: sides, join: Join::Reversed, rows_joined: true, poles: [false; 2] };
    grid.mesh(|column, row| {
        let along = f64::from(column) / f64::from(segments) * TAU;
        // Half a step off: a mirrored grid falls on itself, and the crossing of the eight has no vertex twice.
        let section = (f64::from(row) + 0.5) / f64::from(sides) * TAU;
        // Central differences are good to ten digits.
        let step = 1e-5;
        let across = place(along + step, section) - place(along - step, section);
        let up = place(along, section + step) - place(along, section - step);
        let normal = across.cross(up).normalize_or(DVec3::Y);
        Sample { position: place(along, section), normal }
    })
}

/// Around a circle of diameter 1 goes the curve (sin v, sin 2 v), turned by half the angle.
fn figure_eight(along: f64, section: f64) -> DVec3 {
    let half = DVec2::new(libm::cos(along / 2.0), libm::sin(along / 2.0));
    let eight = DVec2::new(libm::sin(section), libm::sin(2.0 * section)) * 0.2;
    let turned = half.rotate(eight);
    around(DVec2::new(libm::cos(along), libm::sin(along)), 0.5 + turned.x, turned.y)
}

/// Circles about a pear-shaped curve with a cusp at the bottom (Franzoni 2012, "The Klein bottle: variations on a
/// theme", section 4), its height 1.
fn bottle(along: f64, section: f64) -> DVec3 {
    // Past the ends it goes on from the other end, mirrored.
    let (along, section) = match along {
        _ if along < 0.0 => (along + TAU, -section),
        _ if along > TAU => (along - TAU, -section),
        _ => (along, section),
    };
    let (length, width, radius, swelling) = (20.0, 8.0, 5.5, 0.4);
    let fall = 1.0 - libm::cos(along);
    let middle = DVec2::new(width * libm::sin(along) * fall, length * (fall - 1.0));
    // The derivative, over 2 sin(along / 2), which is not zero at the cusp.
    let tangent =
        DVec2::new(width * libm::sin(1.5 * along), length * libm::cos(along / 2.0)).normalize_or(DVec2::Y);
    let radius = radius - swelling * (along - PI) * (along * (TAU - along)).max(0.0).sqrt();
    let flat = middle + DVec2::new(-tangent.y, tangent.x) * (radius * libm::sin(section));
    DVec3::new(flat.x, flat.y, radius * libm::cos(section)) / (2.0 * length)
}
