//! `mesh "name" { … }`: a file or a generator, then what is done to it, line by line.

use super::decoder::Decoder;
use super::fields::{Field, Fields};
use super::transform::TRANSFORMS;
use super::value::Range;
use super::{MeshOperation, MeshOrigin, MeshSource, Named};
use glam::{Vec2, Vec3};
use luch_mesh::generate::{Generator, MAX_DIVISIONS, MAX_SUBDIVISIONS};

/// Where meshes come from.
const ORIGINS: [&str; 8] = ["file", "sphere", "icosphere", "cuboid", "plane", "cylinder", "cone", "torus"];

/// What can be done to a mesh; transforms as well.
const OPERATIONS: [&str; 4] = ["normals", "crease", "weld", "flip"];

/// Most triangles that all generators of a scene may make together.
const MOST_GENERATED: u64 = 1 << 24;

impl Decoder<'_> {
    /// A definition at the top level.
    pub(super) fn named_mesh(&mut self, mut fields: Fields) {
        let name = self.required_name(&mut fields);
        let mesh = self.mesh(fields);
        if let (Some(name), Some(value)) = (name, mesh) {
            self.scene.meshes.push(Named { name: Some(name), value });
        }
    }

    /// A mesh written where it is used: its place in the list.
    pub(super) fn inline_mesh(&mut self, fields: Fields) -> Option<usize> {
        let value = self.mesh(fields)?;
        self.scene.meshes.push(Named { name: None, value });
        Some(self.scene.meshes.len() - 1)
    }

    fn mesh(&mut self, mut fields: Fields) -> Option<MeshSource> {
        let origin = fields.take_one_of(self, &ORIGINS);
        let lacks_origin = origin.is_none();
        let origin = origin.and_then(|field| match field.name {
            "file" => {
                let argument = self.single(field, "the name of a file")?;
                self.text("`file`", &argument).map(MeshOrigin::File)
            }
            _ => self.generator(field).map(MeshOrigin::Generator),
        });
        let names: Vec<&'static str> = OPERATIONS.into_iter().chain(TRANSFORMS).collect();
        let nodes = fields.take_nodes(self, &names);
        let operations = nodes.into_iter().filter_map(|field| self.operation(field)).collect();
        if lacks_origin && fields.nothing_left() {
            let help = super::source::advice("", ORIGINS, "write one of these in its block", "`");
            self.problem(&fields.span, "`mesh` lacks its origin", Some(help));
        }
        let span = fields.span.clone();
        fields.finish(self, "origin or operation");
        Some(MeshSource { span, origin: origin?, operations })
    }

    fn operation(&mut self, field: Field) -> Option<MeshOperation> {
        Some(match field.name {
            "normals" => {
                let argument = self.single(field, "\"flat\" or \"smooth\"")?;
                let words = [("flat", MeshOperation::FlatNormals), ("smooth", MeshOperation::SmoothNormals)];
                self.word("`normals`", &argument, &words)?
            }
            "crease" => {
                let [degrees] = self.numbers(field, Range::between(0.0, 180.0))?;
                MeshOperation::CreasedNormals(degrees.to_radians())
            }
            "weld" => {
                let [distance] = self.numbers(field, Range::NOT_NEGATIVE)?;
                MeshOperation::Weld(distance)
            }
            "flip" => {
                field.fields().finish(self, "option");
                MeshOperation::Flip
            }
            _ => MeshOperation::Transform(self.transform(field)),
        })
    }

    /// `sphere radius=1 segments=64 rings=32` and its like.
    fn generator(&mut self, field: Field) -> Option<Generator> {
        let kind = field.name;
        let mut fields = field.fields();
        let f = &mut fields;
        let generator = match kind {
            "sphere" => Generator::Sphere {
                radius: self.length(f, "radius", 1.0),
                segments: self.pieces(f, "segments", 3, 64),
                rings: self.pieces(f, "rings", 2, 32),
            },
            "icosphere" => Generator::Icosphere {
                radius: self.length(f, "radius", 1.0),
                subdivisions: self.whole_or(f, "subdivisions", 0, u64::from(MAX_SUBDIVISIONS), 3) as u32,
            },
            "cuboid" => Generator::Cuboid { size: self.size(f), divisions: self.divisions(f) },
            "plane" => Generator::Plane {
                size: self.side_lengths::<2>(f).map_or(Vec2::ONE, Vec2::from_array),
                divisions: self.divisions(f),
            },
            "cylinder" => Generator::Cylinder {
                radius: self.length(f, "radius", 1.0),
                height: self.length(f, "height", 2.0),
                segments: self.pieces(f, "segments", 3, 64),
                stacks: self.pieces(f, "stacks", 1, 1),
                capped: self.flag_or(f, "capped", true),
            },
            "cone" => Generator::Cone {
                bottom_radius: self.length(f, "radius", 1.0),
                top_radius: self.number_or(f, "top-radius", Range::NOT_NEGATIVE, 0.0),
                height: self.length(f, "height", 2.0),
                segments: self.pieces(f, "segments", 3, 64),
                stacks: self.pieces(f, "stacks", 1, 1),
                capped: self.flag_or(f, "capped", true),
            },
            _ => Generator::Torus {
                major_radius: self.length(f, "radius", 1.0),
                minor_radius: self.length(f, "tube", 0.25),
                segments: self.pieces(f, "segments", 3, 96),
                sides: self.pieces(f, "sides", 3, 48),
            },
        };
        fields.finish(self, "option");
        self.generated = self.generated.saturating_add(generator.triangle_count());
        if self.generated > MOST_GENERATED {
            let message =
                format!("`{kind}` brings the generated triangles of the scene to {}", self.generated);
            self.problem(&fields.span, message, Some(format!("at most {MOST_GENERATED} are made")));
            return None;
        }
        Some(generator)
    }

    fn length(&mut self, fields: &mut Fields, name: &'static str, default: f32) -> f32 {
        self.number_or(fields, name, Range::POSITIVE, default)
    }

    fn pieces(&mut self, fields: &mut Fields, name: &'static str, least: u64, default: u64) -> u32 {
        self.whole_or(fields, name, least, u64::from(MAX_DIVISIONS), default) as u32
    }

    /// `size 1 2 3`, or one number for a cube.
    fn size(&mut self, fields: &mut Fields) -> Vec3 {
        self.side_lengths::<3>(fields).map_or(Vec3::ONE, Vec3::from_array)
    }

    /// One length for all sides, or one for each.
    fn side_lengths<const N: usize>(&mut self, fields: &mut Fields) -> Option<[f32; N]> {
        let mut inner = fields.take(self, "size")?.fields();
        let arguments = inner.all_arguments();
        let lengths = match arguments.as_slice() {
            [one] => self.number("`size`", one, Range::POSITIVE).map(|side| [side; N]),
            _ => self.array("`size`", &inner.span, &arguments, Range::POSITIVE),
        };
        inner.finish(self, "option");
        lengths
    }

    /// One count for all sides, or one for each.
    fn divisions<const N: usize>(&mut self, fields: &mut Fields) -> [u32; N] {
        let Some(field) = fields.take(self, "divisions") else { return [1; N] };
        let mut inner = field.fields();
        let arguments = inner.all_arguments();
        let most = u64::from(MAX_DIVISIONS);
        let counts: Vec<u32> = arguments
            .iter()
            .filter_map(|argument| self.whole("`divisions`", argument, 1, most))
            .map(|count| count as u32)
            .collect();
        inner.finish(self, "option");
        match (counts.as_slice(), arguments.len()) {
            ([one], 1) => return [*one; N],
            (several, _) => {
                if let Ok(all) = <[u32; N]>::try_from(several) {
                    return all;
                }
            }
        }
        if counts.len() == arguments.len() {
            let message = format!("`divisions` has {} numbers, expected 1 or {N}", counts.len());
            self.problem(&inner.span, message, None);
        }
        [1; N]
    }
}
