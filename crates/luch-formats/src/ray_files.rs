//! Raw files of triangles, rays and hits, so that different programs can trace the very same rays.
//!
//! All numbers are little-endian and follow one another without gaps; nothing may stand after the last record.
//!
//! | file | first 8 bytes | then | then |
//! |---|---|---|---|
//! | `.tri` | `TRIS0001` | u32 vertices, u32 triangles | vertices of f32 x, y, z; triangles of three u32 corners |
//! | `.rays` | `RAYS0001` | u64 count | rays of f32 origin x, y, z, `t_min`, direction x, y, z, `t_max` |
//! | `.hits` | `HITS0001` | u64 count | hits of f32 t, u, v and u32 primitive, `0xffffffff` for a miss |
//!
//! Hits of shadow rays have t = −1 where something is in the way and 0 where nothing is, and no primitive.
//!
//! ```
//! use luch_formats::{Files, ray_files};
//! use luch_bvh::Ray;
//! use glam::Vec3;
//! use std::path::Path;
//!
//! let rays = [Ray::new(Vec3::ZERO, Vec3::X)];
//! let files = Files::memory([("one.rays".into(), ray_files::encode_rays(&rays))]);
//! assert_eq!(ray_files::read_rays(Path::new("one.rays"), &files)?, rays);
//! # Ok::<(), luch_formats::LoadError>(())
//! ```

mod records;
#[cfg(test)]
mod tests;

use crate::{Files, LoadError, Place, Problem};
use glam::Vec3;
use luch_bvh::{Hit, Ray};
use luch_mesh::TriangleMesh;
use records::{Kind, f32_at, records, u32_at};
use std::path::Path;

/// The primitive of a ray that meets nothing.
const NONE: u32 = u32::MAX;

/// One line of a file of hits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecordedHit {
    /// Parameter along the ray; the ray's own end where nothing is met. Of shadow rays −1 (in the shade) or 0.
    pub t: f32,
    /// Weight of the triangle's second corner.
    pub u: f32,
    /// Weight of the triangle's third corner.
    pub v: f32,
    /// What is met.
    pub primitive: Option<u32>,
}

impl RecordedHit {
    /// What a ray meets.
    pub fn nearest(ray: &Ray, hit: Option<&Hit>) -> Self {
        match hit {
            Some(hit) => Self { t: hit.t, u: hit.u, v: hit.v, primitive: Some(hit.primitive) },
            None => Self { t: ray.t_max, u: 0.0, v: 0.0, primitive: None },
        }
    }

    /// Whether a shadow ray meets anything.
    pub fn any(is_met: bool) -> Self {
        Self { t: if is_met { -1.0 } else { 0.0 }, u: 0.0, v: 0.0, primitive: None }
    }
}

/// Reads a `.tri` file: positions and triangles, nothing else.
///
/// # Errors
/// If the file cannot be read, is no such file or not of the size its header claims, or if a position is not finite or a corner
/// is no vertex.
pub fn read_mesh(path: &Path, files: &Files) -> Result<TriangleMesh, LoadError> {
    let bytes = files.read(path)?;
    let start = records::start(path, &bytes, Kind::Mesh)?;
    let (vertices, triangles) = (u64::from(u32_at(&bytes, 8)), u64::from(u32_at(&bytes, 12)));
    // At most 2³² records of 12 bytes each: no overflow.
    records::check_size(path, &bytes, start as u64 + 12 * vertices + 12 * triangles)?;
    let middle = start + 12 * vertices as usize;
    let positions: Vec<Vec3> = records::<12>(&bytes[start..middle])
        .map(|r| Vec3::from_array([0, 4, 8].map(|at| f32_at(r, at))))
        .collect();
    if let Some(number) = positions.iter().position(|position| !position.is_finite()) {
        let message = format!("vertex {number} is at {}, which is not finite", positions[number]);
        return Err(Problem::new(path, message).at(Place::Byte((start + 12 * number) as u64)).into());
    }
    let triangles: Vec<[u32; 3]> =
        records::<12>(&bytes[middle..]).map(|r| [0, 4, 8].map(|at| u32_at(r, at))).collect();
    let is_sound = |triangle: &[u32; 3]| triangle.iter().all(|&corner| u64::from(corner) < vertices);
    if let Some(number) = triangles.iter().position(|triangle| !is_sound(triangle)) {
        let message = format!(
            "triangle {number} has the corners {:?}; there are {vertices} vertices",
            triangles[number]
        );
        return Err(Problem::new(path, message).at(Place::Byte((middle + 12 * number) as u64)).into());
    }
    Ok(TriangleMesh { positions, triangles, ..TriangleMesh::default() })
}

/// Reads a `.rays` file. Rays may hold any numbers: what is no ray meets nothing.
///
/// # Errors
/// If the file cannot be read, is no such file or not of the size its header claims.
pub fn read_rays(path: &Path, files: &Files) -> Result<Vec<Ray>, LoadError> {
    let bytes = files.read(path)?;
    let rays = records::counted::<32>(path, &bytes, Kind::Rays)?.map(|r| Ray {
        origin: Vec3::new(f32_at(r, 0), f32_at(r, 4), f32_at(r, 8)),
        t_min: f32_at(r, 12),
        direction: Vec3::new(f32_at(r, 16), f32_at(r, 20), f32_at(r, 24)),
        t_max: f32_at(r, 28),
    });
    Ok(rays.collect())
}

/// Reads a `.hits` file.
///
/// # Errors
/// If the file cannot be read, is no such file or not of the size its header claims.
pub fn read_hits(path: &Path, files: &Files) -> Result<Vec<RecordedHit>, LoadError> {
    let bytes = files.read(path)?;
    let hits = records::counted::<16>(path, &bytes, Kind::Hits)?.map(|r| RecordedHit {
        t: f32_at(r, 0),
        u: f32_at(r, 4),
        v: f32_at(r, 8),
        primitive: Some(u32_at(r, 12)).filter(|&primitive| primitive != NONE),
    });
    Ok(hits.collect())
}

/// The bytes of a `.tri` file; `None` if there are 2³² or more vertices or triangles.
pub fn encode_mesh(positions: &[Vec3], triangles: &[[u32; 3]]) -> Option<Vec<u8>> {
    let counts = [u32::try_from(positions.len()).ok()?, u32::try_from(triangles.len()).ok()?];
    let mut bytes = Kind::Mesh.mark().to_vec();
    bytes.reserve(8 + 12 * (positions.len() + triangles.len()));
    bytes.extend(counts.iter().flat_map(|count| count.to_le_bytes()));
    bytes.extend(positions.iter().flat_map(Vec3::to_array).flat_map(f32::to_le_bytes));
    bytes.extend(triangles.as_flattened().iter().flat_map(|corner| corner.to_le_bytes()));
    Some(bytes)
}

/// The bytes of a `.rays` file.
pub fn encode_rays(rays: &[Ray]) -> Vec<u8> {
    records::encode(Kind::Rays, rays, |ray| {
        let (o, d) = (ray.origin, ray.direction);
        [o.x, o.y, o.z, ray.t_min, d.x, d.y, d.z, ray.t_max].map(f32::to_le_bytes)
    })
}

/// The bytes of a `.hits` file.
pub fn encode_hits(hits: &[RecordedHit]) -> Vec<u8> {
    records::encode(Kind::Hits, hits, |hit| {
        let [t, u, v] = [hit.t, hit.u, hit.v].map(f32::to_le_bytes);
        [t, u, v, hit.primitive.unwrap_or(NONE).to_le_bytes()]
    })
}
