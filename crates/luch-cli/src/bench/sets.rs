//! Sets of rays: made from a mesh and a camera, or read from files.

use super::agree::Answers;
use super::geometry::Triangles;
use crate::args::CameraArgs;
use crate::failure::Failure;
use glam::{Vec2, Vec3};
use luch::bvh::{Coherence, Ray, TriangleBvh};
use luch::formats::ray_files::{self, RecordedHit};
use luch::formats::{Files, write_atomically};
use luch::sampling::frame::Frame;
use luch::sampling::{hash, warp};
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// Pixels come in square tiles of this side,
const TILE: u32 = 16;
/// each in square blocks of this side, so that 4, 8 or 16 rays in a row are neighbours.
const BLOCK: u32 = 4;
/// How far every ray may go, as a share of nothing: far beyond any mesh.
const FAR: f32 = 1e30;
/// How far a ray starts off the surface, and how far a shadow ray goes, in diagonals of the mesh.
const OFFSET: f32 = 1e-5;
const SHADOW_LENGTH: f32 = 0.1;
/// Chooses the random numbers.
const SEED: u64 = 1234;

/// What kind of rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SetKind {
    /// A camera's, in tiles.
    Primary,
    /// Cosine-distributed, from what the camera sees.
    Diffuse,
    /// The same in random order.
    Shuffled,
    /// Short ones; asked is only whether anything is in the way.
    Shadow,
}

impl SetKind {
    pub(crate) const ALL: [Self; 4] = [Self::Primary, Self::Diffuse, Self::Shuffled, Self::Shadow];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Primary => "primary",
            Self::Diffuse => "diffuse",
            Self::Shuffled => "shuffled",
            Self::Shadow => "shadow",
        }
    }

    /// The hint that a renderer would give.
    pub(super) fn coherence(self) -> Coherence {
        if self == Self::Primary { Coherence::Coherent } else { Coherence::Incoherent }
    }

    /// The file of this set with this extension.
    fn path(self, prefix: &Path, extension: &str) -> PathBuf {
        let mut path = OsString::from(prefix);
        path.push(format!(".{}.{extension}", self.name()));
        path.into()
    }
}

/// Rays of one kind, and what another program found.
pub(super) struct RaySet {
    pub(super) kind: SetKind,
    pub(super) rays: Vec<Ray>,
    pub(super) reference: Option<Vec<RecordedHit>>,
}

/// Reads the sets at a prefix, with hits where there are any.
pub(super) fn read(prefix: &Path, kinds: &[SetKind]) -> Result<Vec<RaySet>, Failure> {
    let read = |&kind: &SetKind| -> Result<RaySet, Failure> {
        let rays = ray_files::read_rays(&kind.path(prefix, "rays"), &Files::disk())?;
        let hits = kind.path(prefix, "hits");
        let reference = if hits.exists() { Some(ray_files::read_hits(&hits, &Files::disk())?) } else { None };
        match &reference {
            Some(reference) if reference.len() != rays.len() => {
                let (hits, found, expected) = (hits.display(), reference.len(), rays.len());
                Err(Failure::new(format!("{hits}: holds {found} hits for {expected} rays")))
            }
            _ => Ok(RaySet { kind, rays, reference }),
        }
    };
    kinds.iter().map(read).collect()
}

/// Writes a set and its answers for other programs.
pub(super) fn write(prefix: &Path, set: &RaySet, answers: &Answers) -> Result<(), Failure> {
    write_atomically(&set.kind.path(prefix, "rays"), &ray_files::encode_rays(&set.rays))?;
    write_atomically(&set.kind.path(prefix, "hits"), &ray_files::encode_hits(&answers.recorded(&set.rays)))?;
    Ok(())
}

/// Makes the sets from what a camera sees.
pub(super) fn generate(
    triangles: &Triangles,
    tree: &TriangleBvh,
    camera: &CameraArgs,
    kinds: &[SetKind],
) -> Result<Vec<RaySet>, Failure> {
    let bounds = triangles.bounds();
    let diagonal = (bounds.max - bounds.min).length();
    let primary = primary(camera, (bounds.min + bounds.max) / 2.0, diagonal)?;
    let seen = seen(triangles, tree, &primary, diagonal * OFFSET);
    let set = |&kind: &SetKind| {
        let from_surface = |stream: u64, length: f32| -> Vec<Ray> {
            let numbered = seen.iter().zip(0u64..);
            let ray =
                |(place, i): (&Seen, u64)| Ray { t_max: length, ..place.ray(hash::word(SEED + stream, i)) };
            numbered.map(ray).collect()
        };
        let rays = match kind {
            SetKind::Primary => primary.clone(),
            SetKind::Diffuse => from_surface(0, FAR),
            SetKind::Shuffled => shuffled(from_surface(0, FAR)),
            SetKind::Shadow => from_surface(1, diagonal * SHADOW_LENGTH),
        };
        RaySet { kind, rays, reference: None }
    };
    Ok(kinds.iter().map(set).collect())
}

/// One ray through the middle of each pixel of a pinhole camera.
fn primary(camera: &CameraArgs, middle: Vec3, diagonal: f32) -> Result<Vec<Ray>, Failure> {
    let at = camera.at.unwrap_or(middle);
    let eye = camera.eye.unwrap_or(at + Vec3::new(0.5, 0.35, 1.0).normalize() * diagonal * 1.15);
    let nothing = || {
        Failure::usage(
            "the eye must be somewhere else than what it looks at, and not straight above or below it",
        )
    };
    let forward = (at - eye).try_normalize().ok_or_else(nothing)?;
    let right = forward.cross(camera.up.unwrap_or(Vec3::Y)).try_normalize().ok_or_else(nothing)?;
    let up = right.cross(forward);
    let half = Vec2::from_angle((camera.fov.unwrap_or(40.0) / 2.0).to_radians());
    let reach = half.y / half.x;
    let side = u32::from(camera.size.unwrap_or(1024)).next_multiple_of(TILE);

    let through = |x: u32, y: u32| {
        let [x, y] = [x, y].map(|i| (i as f32 + 0.5) / side as f32 * 2.0 - 1.0);
        let direction = (forward + right * (x * reach) - up * (y * reach)).normalize();
        Ray { origin: eye, direction, t_min: 0.0, t_max: FAR }
    };
    let tiles = squares(side, TILE);
    let blocks = tiles.flat_map(|[x, y]| squares(TILE, BLOCK).map(move |[bx, by]| [x + bx, y + by]));
    let pixels = blocks.flat_map(|[x, y]| squares(BLOCK, 1).map(move |[px, py]| [x + px, y + py]));
    Ok(pixels.map(|[x, y]| through(x, y)).collect())
}

/// The corners of the squares of side `step` in a square of side `side`, row by row.
fn squares(side: u32, step: u32) -> impl Iterator<Item = [u32; 2]> {
    let along = move || (0..side).step_by(step as usize);
    along().flat_map(move |y| along().map(move |x| [x, y]))
}

/// A place that the camera sees, a little off the surface, and the normal on the camera's side.
struct Seen {
    place: Vec3,
    normal: Vec3,
}

impl Seen {
    /// A cosine-distributed ray.
    fn ray(&self, random: u64) -> Ray {
        let u = [(random >> 32) as u32, random as u32].map(hash::unit_f32);
        let frame = Frame::from_normal(self.normal);
        let d = warp::cosine_hemisphere(u);
        let direction = frame.tangent * d.x + frame.bitangent * d.y + frame.normal * d.z;
        Ray { origin: self.place, direction: direction.normalize(), t_min: 0.0, t_max: FAR }
    }
}

fn seen(triangles: &Triangles, tree: &TriangleBvh, rays: &[Ray], offset: f32) -> Vec<Seen> {
    let mut hits = vec![None; rays.len()];
    tree.nearest_batch(rays, &mut hits, Coherence::Coherent);
    let place = |(ray, hit): (&Ray, &Option<luch::bvh::Hit>)| {
        let hit = hit.as_ref()?;
        let [a, b, c] = triangles.at(hit.primitive)?;
        let normal = (b - a).cross(c - a).try_normalize()?;
        let normal = if normal.dot(ray.direction) > 0.0 { -normal } else { normal };
        Some(Seen { place: ray.at(hit.t) + normal * offset, normal })
    };
    rays.iter().zip(&hits).filter_map(place).collect()
}

/// In random order (Fisher and Yates).
fn shuffled(mut rays: Vec<Ray>) -> Vec<Ray> {
    for last in (1..rays.len()).rev() {
        let random = hash::word(SEED + 2, last as u64) >> 32;
        let other = (random * (last as u64 + 1)) >> 32;
        rays.swap(last, other as usize);
    }
    rays
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_come_once_and_in_blocks() {
        let camera = CameraArgs {
            eye: Some(Vec3::Z),
            at: Some(Vec3::ZERO),
            up: None,
            fov: Some(90.0),
            size: Some(20),
        };
        let rays = primary(&camera, Vec3::ZERO, 1.0).unwrap();
        let mut pixels: Vec<[u32; 2]> = rays
            .iter()
            .map(|ray| {
                let at = ray.direction / -ray.direction.z;
                [at.x, -at.y].map(|v| ((v + 1.0) * 16.0) as u32)
            })
            .collect();
        assert_eq!(pixels[..5], [[0, 0], [1, 0], [2, 0], [3, 0], [0, 1]]);
        assert_eq!([pixels[16], pixels[256]], [[4, 0], [16, 0]]);
        pixels.sort();
        pixels.dedup();
        assert_eq!((rays.len(), pixels.len()), (1024, 1024));
    }

    #[test]
    fn shuffling_loses_nothing() {
        let rays: Vec<Ray> = (0..1000).map(|i| Ray::new(Vec3::X * i as f32, Vec3::Y)).collect();
        let mut again = shuffled(rays.clone());
        let stayed = rays.iter().zip(&again).filter(|(a, b)| a == b).count();
        assert!(stayed < 10, "{stayed} of 1000; one is expected");
        again.sort_by(|a, b| a.origin.x.total_cmp(&b.origin.x));
        assert_eq!(again, rays);
    }
}
