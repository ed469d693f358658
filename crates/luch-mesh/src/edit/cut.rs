//! Cutting by a plane, with caps; slicing into layers.

mod cap;
mod fragments;

use glam::DVec3;

use super::builder::Builder;
use super::error::check_size;
use super::geometry::extent;
use super::{EditError, append, prepared};
use crate::PolygonMesh;
use cap::PlaneEdges;
use fragments::Fragments;

/// All points x with normal · x = distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// The unit normal; it points to the upper side.
    pub normal: DVec3,
    /// The distance from the origin along the normal, in metres.
    pub distance: f64,
}

impl Plane {
    /// The plane at right angles to a direction of any length, through a point; `None` for a direction of no length.
    pub fn through(point: DVec3, direction: DVec3) -> Option<Self> {
        let normal = direction.try_normalize()?;
        let distance = normal.dot(point);
        distance.is_finite().then_some(Self { normal, distance })
    }

    /// The map that reflects at the plane.
    pub fn reflection(&self) -> glam::DAffine3 {
        let across = |axis: DVec3| axis - self.normal * (2.0 * self.normal.dot(axis));
        let matrix3 = glam::DMat3::from_cols(across(DVec3::X), across(DVec3::Y), across(DVec3::Z));
        glam::DAffine3 { matrix3, translation: self.normal * (2.0 * self.distance) }
    }

    /// The height of a point above the plane.
    pub fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.distance
    }
}

/// What stays of a mesh that is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Both parts.
    Both,
    /// What the plane's normal points to.
    Above,
    /// The rest.
    Below,
}

/// How a mesh is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// The plane.
    pub plane: Plane,
    /// What stays.
    pub keep: Side,
    /// Closes what the plane has opened. Both parts are then bodies of their own.
    pub cap: bool,
    /// The material slot of the caps; those of the faces around if there is none.
    pub cap_slot: Option<u16>,
}

/// Cuts the marked faces by a plane; others stay whole and stay.
///
/// Vertices within a millionth of the mesh's size count as on the plane, and edges are cut at one point for all their faces, so
/// parts fit together. A face that lies in the plane goes with the body it bounds. Faces that are not flat, or that the plane
/// meets in several places, become triangles first. Values at the cut are those of the place; caps have uvs in metres along
/// the plane. Caps may have holes. With caps a closed body gives closed bodies, if all its faces are marked;
/// a part that touches itself along an edge in the plane has four faces there.
pub fn cut(mesh: &PolygonMesh, faces: &[bool], cut: &Cut) -> Result<PolygonMesh, EditError> {
    if cut.keep == Side::Both && cut.cap {
        let above = self::cut(mesh, faces, &Cut { keep: Side::Above, ..*cut })?;
        let below = self::cut(mesh, faces, &Cut { keep: Side::Below, ..*cut })?;
        return append(&below, &above, 0);
    }
    let mesh = &*prepared(mesh);
    // At most every edge is cut, and each face falls into as many parts as it has corners.
    check_size(mesh.corners.len() as u64 * 2, mesh.corners.len() as u64 * 4)?;
    let mut builder = Builder::new(mesh);
    let fragments = Fragments::new(mesh, faces, &cut.plane, &mut builder);
    let mut edges = PlaneEdges::default();
    fragments.for_each(|fragment| {
        let is_kept = match cut.keep {
            Side::Both => true,
            Side::Above => fragment.is_whole || fragment.is_above,
            Side::Below => fragment.is_whole || !fragment.is_above,
        };
        if cut.cap {
            edges.add(fragment, is_kept, |vertex| fragments.is_on_plane(vertex));
        }
        if is_kept {
            fragment.build(&mut builder);
        }
    });
    if cut.cap {
        let outward = if cut.keep == Side::Above { -cut.plane.normal } else { cut.plane.normal };
        edges.build_caps(&mut builder, outward, cut.cap_slot);
    }
    Ok(builder.finish())
}

/// Cuts a mesh into layers of equal height along a direction, each closed by caps if it was closed.
///
/// The layers follow one another in the result, lowest first.
pub fn slice(
    mesh: &PolygonMesh,
    direction: DVec3,
    layers: u32,
    cap_slot: Option<u16>,
) -> Result<PolygonMesh, EditError> {
    let normal = direction.try_normalize().ok_or(EditError::NoDirection("axis"))?;
    let all = vec![true; mesh.positions.len()];
    let Some([low, high]) = extent(mesh, &all, normal) else { return Ok(mesh.clone()) };
    let mut rest = prepared(mesh).into_owned();
    let mut sliced = PolygonMesh::default();
    for layer in 1..layers {
        let distance = low + (high - low) * f64::from(layer) / f64::from(layers);
        let plane = Plane { normal, distance };
        let all = vec![true; rest.face_count()];
        let part = |keep| cut(&rest, &all, &Cut { plane, keep, cap: true, cap_slot });
        let (below, above) = (part(Side::Below)?, part(Side::Above)?);
        sliced = append(&sliced, &below, 0)?;
        rest = above;
    }
    append(&sliced, &rest, 0)
}
