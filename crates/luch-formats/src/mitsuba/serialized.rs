//! Mitsuba's binary meshes (`.serialized`, versions 3 and 4): several to a file, each deflated, their places at the end.

use flate2::bufread::ZlibDecoder;
use glam::{Vec2, Vec3, Vec4};
use luch_mesh::{Attribute, TriangleMesh, normals};
use std::io::Read;

/// The first two bytes of a file and of each mesh.
const MARK: u16 = 0x041c;

const HAS_NORMALS: u32 = 0x0001;
const HAS_UVS: u32 = 0x0002;
const HAS_COLORS: u32 = 0x0008;
const FACE_NORMALS: u32 = 0x0010;
const SINGLE: u32 = 0x1000;
const DOUBLE: u32 = 0x2000;

/// Deflate makes at most about 1032 bytes of one.
const MOST_GROWTH: u64 = 1040;

/// Longest name of a mesh, bytes.
const LONGEST_NAME: usize = 4096;

/// What is wrong, and where in the file if it is known.
#[derive(Debug)]
pub(super) struct Broken {
    pub(super) message: String,
    pub(super) offset: Option<u64>,
}

fn broken(message: impl Into<String>) -> Broken {
    Broken { message: message.into(), offset: None }
}

/// The mesh number `part` of a file; v of its uvs is as in the file.
pub(super) fn decode(bytes: &[u8], part: u32) -> Result<TriangleMesh, Broken> {
    let version = header(bytes, 0)?;
    let (start, end) = place(bytes, version, part)?;
    if start > 0 {
        header(bytes, start)?;
    }
    let deflated = &bytes[start + 4..end];
    let budget = (deflated.len() as u64).saturating_mul(MOST_GROWTH);
    let mut data = Data { decoder: ZlibDecoder::new(deflated), offset: start as u64 + 4 };
    data.mesh(version, budget)
}

fn number<const N: usize>(bytes: &[u8], at: usize) -> Option<[u8; N]> {
    bytes.get(at..at.checked_add(N)?)?.try_into().ok()
}

/// The version in the four bytes at `at`.
fn header(bytes: &[u8], at: usize) -> Result<u16, Broken> {
    let mark = number(bytes, at).map(u16::from_le_bytes);
    let version = number(bytes, at + 2).map(u16::from_le_bytes);
    match (mark, version) {
        (Some(MARK), Some(version @ (3 | 4))) => Ok(version),
        (Some(MARK), Some(version)) => Err(Broken {
            message: format!("is of version {version} of the serialized format, expected 3 or 4"),
            offset: Some(at as u64 + 2),
        }),
        _ => Err(Broken {
            message: "is no serialized mesh: it does not begin with 1c 04".into(),
            offset: Some(at as u64),
        }),
    }
}

/// Where a mesh begins and ends.
fn place(bytes: &[u8], version: u16, part: u32) -> Result<(usize, usize), Broken> {
    let count_at = bytes.len().saturating_sub(4);
    let count = number(bytes, count_at).map(u32::from_le_bytes).unwrap_or(0);
    let size: usize = if version == 3 { 4 } else { 8 };
    let table = (count as usize).checked_mul(size).and_then(|length| count_at.checked_sub(length));
    let Some(table) = table.filter(|table| *table >= 4 && count > 0) else {
        let message = format!("says that it holds {count} meshes, for which it is too short");
        return Err(Broken { message, offset: Some(count_at as u64) });
    };
    if part >= count {
        return Err(broken(format!("holds {count} meshes, so `shape_index` {part} does not exist")));
    }
    let entry = |index: u32| {
        let at = table + index as usize * size;
        let start = match size {
            4 => number(bytes, at).map(|b| u64::from(u32::from_le_bytes(b))),
            _ => number(bytes, at).map(u64::from_le_bytes),
        };
        start.and_then(|start| usize::try_from(start).ok()).filter(|start| *start < table)
    };
    let end = if part + 1 < count { entry(part + 1) } else { Some(table) };
    match (entry(part), end) {
        (Some(start), Some(end)) if start + 4 <= end => Ok((start, end)),
        _ => Err(Broken { message: format!("has a wrong place of mesh {part}"), offset: Some(table as u64) }),
    }
}

/// The inflated bytes of one mesh, taken one after the other.
struct Data<'a> {
    decoder: ZlibDecoder<&'a [u8]>,
    /// Where the deflated bytes begin in the file.
    offset: u64,
}

impl Data<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], Broken> {
        let mut bytes = [0; N];
        self.decoder.read_exact(&mut bytes).map_err(|error| Broken {
            message: format!("the mesh ends too early: {error}"),
            offset: Some(self.offset + self.decoder.total_in()),
        })?;
        Ok(bytes)
    }

    fn count(&mut self) -> Result<u64, Broken> {
        self.take().map(u64::from_le_bytes)
    }

    fn numbers<const N: usize>(&mut self, is_double: bool) -> Result<[f32; N], Broken> {
        let mut all = [0.0; N];
        for number in &mut all {
            *number = if is_double {
                f64::from_le_bytes(self.take()?) as f32
            } else {
                f32::from_le_bytes(self.take()?)
            };
        }
        Ok(all)
    }

    fn list<T, const N: usize>(
        &mut self,
        count: u64,
        is_double: bool,
        make: impl Fn([f32; N]) -> T,
    ) -> Result<Vec<T>, Broken> {
        // Bounded by what the deflated bytes can hold, see `mesh`.
        let mut list = Vec::with_capacity(count as usize);
        for _ in 0..count {
            list.push(make(self.numbers(is_double)?));
        }
        Ok(list)
    }

    fn mesh(&mut self, version: u16, budget: u64) -> Result<TriangleMesh, Broken> {
        let flags = self.take().map(u32::from_le_bytes)?;
        if version == 4 {
            let mut length = 0;
            while self.take::<1>()? != [0] {
                length += 1;
                if length > LONGEST_NAME {
                    return Err(broken(format!("the name of the mesh has over {LONGEST_NAME} bytes")));
                }
            }
        }
        let is_double = match flags & (SINGLE | DOUBLE) {
            SINGLE => false,
            DOUBLE => true,
            _ => return Err(broken(format!("the flags {flags:#x} name no precision (0x1000 or 0x2000)"))),
        };
        let (vertices, triangles) = (self.count()?, self.count()?);
        let per_vertex = [(HAS_NORMALS, 3), (HAS_UVS, 2), (HAS_COLORS, 3)]
            .into_iter()
            .filter(|(flag, _)| flags & flag != 0)
            .map(|(_, count)| count)
            .sum::<u64>()
            + 3;
        let of_vertices = vertices.checked_mul(per_vertex * if is_double { 8 } else { 4 });
        let needed = of_vertices.and_then(|bytes| bytes.checked_add(triangles.checked_mul(12)?));
        if vertices > u64::from(u32::MAX) || needed.is_none_or(|needed| needed > budget) {
            let message = format!(
                "says that it has {vertices} vertices and {triangles} triangles, for which it is too short"
            );
            return Err(broken(message));
        }
        let positions = self.list(vertices, is_double, Vec3::from)?;
        let mut mesh = TriangleMesh::new(positions, Vec::new());
        if flags & HAS_NORMALS != 0 {
            let unit = |n: [f32; 3]| Vec3::from(n).try_normalize().unwrap_or(Vec3::Z);
            mesh.normals = Attribute::per_position(self.list(vertices, is_double, unit)?);
        }
        if flags & HAS_UVS != 0 {
            mesh.uv_sets = vec![Attribute::per_position(self.list(vertices, is_double, Vec2::from)?)];
        }
        if flags & HAS_COLORS != 0 {
            let colors = self.list(vertices, is_double, |[r, g, b]| Vec4::new(r, g, b, 1.0))?;
            mesh.colors = Attribute::per_position(colors);
        }
        for _ in 0..triangles {
            let corners = [self.take(), self.take(), self.take()];
            let [a, b, c] = corners.map(|corner| corner.map(u32::from_le_bytes));
            let corners = [a?, b?, c?];
            if corners.iter().any(|corner| u64::from(*corner) >= vertices) {
                return Err(broken(format!(
                    "a triangle refers to {corners:?}, but there are {vertices} vertices"
                )));
            }
            mesh.triangles.push(corners);
        }
        if flags & FACE_NORMALS != 0 {
            mesh.normals = normals::flat(&mesh);
        }
        Ok(mesh)
    }
}
