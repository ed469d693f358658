//! Outlines in the plane, and the bodies that are made of them.
//!
//! An [`Outline`] is a region of the plane: a border and its holes. Outlines come from [`shapes`], from SVG path data
//! ([`svg_path`]), from the glyphs of a font ([`text`]), or from a short [`notation`] that knows all of these.
//! [`Extrusion`], [`Lathe`] and [`Sweep`] make bodies of them, [`flat`] a surface, [`Loft`] a body between two.
//!
//! Outlines lie in the xy plane of their own: x to the right, y up. Where a body stands along +Y, an outline's x is x
//! and its y is −z, as on a map that lies on the ground with north away from the reader.
//!
//! ```
//! use luch_mesh::measure;
//! use luch_mesh::outline::{Extrusion, notation};
//!
//! // A square nut: 2 × 2 with a round hole of radius ½, 1 high.
//! let outlines = notation::outlines("rectangle 2 2; circle 0.5 64", 0.001)?;
//! let nut = Extrusion { height: 1.0, ..Extrusion::default() }.of(&outlines)?.triangulate();
//! assert_eq!(measure::closedness(&nut).to_string(), "closed (1 piece, genus 1)");
//! assert!((measure::volume(&nut) - (4.0 - std::f64::consts::PI / 4.0)).abs() < 0.002);
//! # Ok::<(), luch_mesh::outline::OutlineError>(())
//! ```

mod crossing;
mod error;
mod extrude;
mod flatten;
mod frames;
mod glyphs;
mod lathe;
mod loft;
mod nesting;
pub mod notation;
mod offset;
mod path_scanner;
mod shading;
pub mod shapes;
mod skin;
mod svg_path;
mod sweep;

use glam::DVec2;

use crate::PolygonMesh;
pub use error::OutlineError;
pub use extrude::{Extrusion, Stand};
pub use flatten::bezier_chain;
pub use glyphs::{Alignment, TextLayout, text};
pub use lathe::Lathe;
pub use loft::Loft;
pub use nesting::{FillRule, nested};
pub use svg_path::{SubPath, svg_path};
pub use sweep::Sweep;

/// The most points of one outline, holes included: more could not be cut into triangles in reasonable time.
pub const MAX_OUTLINE_POINTS: usize = 1 << 14;
/// The most points of outlines that are used together.
pub const MAX_POINTS: usize = 1 << 16;
/// The most faces of a body.
pub const MAX_FACES: u64 = 1 << 26;

/// A region of the plane. The first point of a border is not repeated at its end.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outline {
    /// The outer border, counter-clockwise.
    pub outer: Vec<DVec2>,
    /// The borders of the holes, clockwise.
    pub holes: Vec<Vec<DVec2>>,
}

impl Outline {
    /// The outer border and the holes.
    pub fn loops(&self) -> impl Iterator<Item = &Vec<DVec2>> {
        std::iter::once(&self.outer).chain(&self.holes)
    }

    /// How many points it has.
    pub fn point_count(&self) -> usize {
        self.loops().map(Vec::len).sum()
    }

    /// Its area.
    pub fn area(&self) -> f64 {
        self.loops().map(|points| signed_area(points)).sum()
    }

    /// The length of all borders.
    pub fn perimeter(&self) -> f64 {
        self.loops().map(|points| edges(points).map(|[a, b]| a.distance(b)).sum::<f64>()).sum()
    }

    /// The centre of its area; `None` if it has none.
    pub fn centroid(&self) -> Option<DVec2> {
        let mut moment = DVec2::ZERO;
        for [a, b] in self.loops().flat_map(|points| edges(points)) {
            moment += (a + b) * a.perp_dot(b);
        }
        let centroid = moment / (6.0 * self.area());
        centroid.is_finite().then_some(centroid)
    }
}

/// The area within a border, positive if it runs counter-clockwise.
pub fn signed_area(points: &[DVec2]) -> f64 {
    let Some(&origin) = points.first() else { return 0.0 };
    edges(points).map(|[a, b]| (a - origin).perp_dot(b - origin)).sum::<f64>() / 2.0
}

/// The outlines as flat faces that look up: holes are holes of the faces.
pub fn flat(outlines: &[Outline], stand: Stand) -> Result<PolygonMesh, OutlineError> {
    check(outlines)?;
    let mut skin = skin::Skin::default();
    let map = skin::PlaneMap::of(outlines);
    for outline in outlines {
        let loops: Vec<Vec<u32>> = outline
            .loops()
            .map(|points| points.iter().map(|&p| skin.position(stand.place(p.extend(0.0)))).collect())
            .collect();
        skin.cap(&loops, outline, &map, false);
    }
    Ok(skin.finish(0.0))
}

/// The edges of a border.
fn edges(points: &[DVec2]) -> impl Iterator<Item = [DVec2; 2]> {
    let count = points.len();
    (0..count).map(move |k| [points[k], points[(k + 1) % count]])
}

/// Refuses outlines that no body can be made of.
fn check(outlines: &[Outline]) -> Result<(), OutlineError> {
    if outlines.is_empty() {
        return Err(OutlineError::Empty);
    }
    let mut total = 0;
    for outline in outlines {
        for points in outline.loops() {
            if points.len() < 3 {
                return Err(OutlineError::TooFewPoints { count: points.len() });
            }
            if let Some(point) = points.iter().find(|p| !is_usable(**p)) {
                return Err(OutlineError::NotFinite { point: *point });
            }
        }
        let count = outline.point_count();
        if count > MAX_OUTLINE_POINTS {
            return Err(OutlineError::TooManyPoints { count, most: MAX_OUTLINE_POINTS });
        }
        total += count;
    }
    if total > MAX_POINTS {
        return Err(OutlineError::TooManyPoints { count: total, most: MAX_POINTS });
    }
    Ok(())
}

/// Coordinates beyond this are refused: squares of them must stay finite.
const MAX_COORDINATE: f64 = 1e15;

fn is_usable(point: DVec2) -> bool {
    point.abs().max_element() <= MAX_COORDINATE && !point.is_nan()
}

/// Refuses bodies of too many faces.
fn check_faces(faces: u64) -> Result<(), OutlineError> {
    if faces > MAX_FACES { Err(OutlineError::TooManyFaces { faces }) } else { Ok(()) }
}

/// Refuses a measure that is not above zero, or so large that positions would not be finite.
fn check_positive(name: &'static str, found: f64) -> Result<(), OutlineError> {
    if found > 0.0 && found <= MAX_COORDINATE {
        return Ok(());
    }
    Err(OutlineError::OutOfRange { name, found, expected: "above 0, and no more than 1e15" })
}
