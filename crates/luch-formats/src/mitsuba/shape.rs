//! Shapes: forms put into the world with their surfaces.

use super::Import;
use super::fields::{POSITIVE, described};
use super::mesh::{Form, MeshKey, Smoothing};
use super::tree::{Plugin, Tag};
use glam::{Affine3A, DAffine3, DMat3, DQuat, DVec3, Vec3};
use luch_scene::{Id, Instance, Material, Shape};

/// Most things that are placed, groups counted as often as they are.
const MOST_INSTANCES: usize = 1 << 22;

/// Groups inside one another.
const DEEPEST: usize = 8;

/// What is put into the world.
struct Placed {
    shape: Id<Shape>,
    /// From the shape to the world.
    placement: DAffine3,
}

impl<'a> Import<'a> {
    /// Adds a shape, placed by what it stands in.
    pub(super) fn shape(&mut self, place: usize, parent: DAffine3) {
        let plugin = &self.document.plugins[place];
        match plugin.kind.as_str() {
            // Groups are shown where an instance refers to them.
            "shapegroup" => return,
            "instance" | "merge" => return self.group(place, parent),
            _ => {}
        }
        let flipped = self.flag(plugin, "flip_normals", false);
        let to_world = parent * self.transform(plugin, "to_world");
        self.ignore(plugin, &["silhouette_sampling_weight", "max_distance"]);
        let determinant = to_world.matrix3.determinant();
        if !(to_world.is_finite() && determinant != 0.0) {
            self.report.add(&plugin.span, "this shape is placed by a matrix that cannot be inverted", None);
            return;
        }
        let emitters = self.parts(plugin, Tag::Emitter);
        let emitter = emitters.first().map(|&(place, _)| place).filter(|&place| self.is_area(place));
        let surfaces = self.parts(plugin, Tag::Bsdf);
        if surfaces.len() > 1 {
            self.warn(&plugin.span, "a shape with several bsdfs has the first on all of it");
        }
        let placed = match plugin.kind.as_str() {
            "obj" | "ply" | "serialized" | "stl" => self.file_shape(plugin, to_world, flipped),
            "rectangle" => self.simple(Form::Rectangle, to_world, flipped),
            "cube" => {
                self.flag(plugin, "face_normals", false);
                self.simple(Form::Cube, to_world, flipped)
            }
            "sphere" => self.sphere(plugin, to_world, flipped, emitter.is_some()),
            "disk" => self.disk(to_world, flipped, emitter.is_some()),
            "cylinder" => self.cylinder(plugin, to_world, flipped),
            _ => {
                self.left_out(&plugin.span, &described(plugin));
                plugin.properties.iter().for_each(|property| property.used.set(true));
                return;
            }
        };
        let material = self.material(surfaces.first().map(|&(place, _)| place), emitter);
        self.finish(plugin);
        let Some(placed) = placed else { return };
        self.put(plugin, placed, material);
    }

    fn put(&mut self, plugin: &'a Plugin, placed: Placed, material: Id<Material>) {
        let m = placed.placement.matrix3;
        let placement = Affine3A::from_mat3_translation(m.as_mat3(), placed.placement.translation.as_vec3());
        let determinant = placement.matrix3.determinant();
        if !(placement.is_finite() && determinant != 0.0 && determinant.is_finite()) {
            self.report.add(&plugin.span, "this shape is placed by a matrix that cannot be inverted", None);
            return;
        }
        if self.scene.instances.len() == MOST_INSTANCES {
            self.report.add(&plugin.span, format!("more than {MOST_INSTANCES} shapes are placed"), None);
        }
        if self.scene.instances.len() >= MOST_INSTANCES {
            return;
        }
        let name = plugin.id.clone().unwrap_or_default();
        self.scene.instances.push(Instance {
            name,
            shape: placed.shape,
            materials: vec![material],
            placement,
        });
    }

    fn is_area(&mut self, place: usize) -> bool {
        let emitter = &self.document.plugins[place];
        if emitter.kind != "area" {
            self.left_out(&emitter.span, &described(emitter));
            emitter.properties.iter().for_each(|property| property.used.set(true));
        }
        emitter.kind == "area"
    }

    /// The shapes of a group, where `instance` or `merge` puts them.
    fn group(&mut self, place: usize, parent: DAffine3) {
        let plugin = &self.document.plugins[place];
        if self.open.contains(&place) || self.open.len() > DEEPEST {
            self.report.add(&plugin.span, "shapes stand inside one another without end", None);
            return;
        }
        let to_world = parent * self.transform(plugin, "to_world");
        self.open.push(place);
        for (member, _) in self.parts(plugin, Tag::Shape) {
            let group = &self.document.plugins[member];
            if plugin.kind == "instance" && group.kind == "shapegroup" {
                for (inner, _) in self.parts(group, Tag::Shape) {
                    if self.scene.instances.len() < MOST_INSTANCES {
                        self.shape(inner, to_world);
                    }
                }
                self.finish(group);
            } else {
                self.shape(member, to_world);
            }
        }
        self.open.pop();
        self.finish(plugin);
    }

    fn simple(&mut self, form: Form, to_world: DAffine3, flipped: bool) -> Option<Placed> {
        let shape = self.mesh(MeshKey::of(form, flipped), None)?;
        Some(Placed { shape, placement: to_world })
    }

    /// A mesh of a file. Where its normals come from the winding, a mirroring turns it inside out, as Mitsuba's loaders do.
    fn file_shape(&mut self, plugin: &'a Plugin, to_world: DAffine3, flipped: bool) -> Option<Placed> {
        let faces = self.flag(plugin, "face_normals", false);
        let angle = self.optional_number(plugin, "max_smooth_angle", 0.0..=180.0);
        let is_obj = plugin.kind == "obj";
        let flips_uv = self.flag(plugin, "flip_tex_coords", is_obj);
        let part = self.whole(plugin, "shape_index", 0..=i64::from(u32::MAX), 0) as u32;
        self.ignore(plugin, &["collapse", "srgb", "vertex_colors"]);
        let Some(name) = self.text(plugin, "filename") else {
            self.report.add(&plugin.span, format!("{} lacks its `filename`", described(plugin)), None);
            return None;
        };
        let span = self.property(plugin, "filename").map_or(&plugin.span, |property| &property.span);
        let path = self.path(name);
        let smoothing = match (faces, angle) {
            (true, _) => Smoothing::Flat,
            (false, Some(angle)) => Smoothing::Creased(angle.to_radians().to_bits()),
            (false, None) => Smoothing::Given,
        };
        let form = Form::File { path, part, is_serialized: plugin.kind == "serialized", smoothing, flips_uv };
        let mirrored = to_world.matrix3.determinant() < 0.0;
        let inside_out =
            mirrored && (smoothing != Smoothing::Given || !self.file_has_normals(&form, span)?);
        let shape = self.mesh(MeshKey::of(form, flipped != inside_out), Some(span))?;
        Some(Placed { shape, placement: to_world })
    }

    /// Mitsuba's pole is +Z and its u begins at +X; ours is +Y, with u from −Z on.
    fn sphere(
        &mut self,
        plugin: &'a Plugin,
        to_world: DAffine3,
        flipped: bool,
        emits: bool,
    ) -> Option<Placed> {
        let center = self.vector(plugin, "center").unwrap_or(Vec3::ZERO).as_dvec3();
        let radius = self.number(plugin, "radius", POSITIVE, 1.0);
        let axes = DMat3::from_cols(DVec3::NEG_Y, DVec3::Z, DVec3::NEG_X);
        let own = DAffine3::from_mat3_translation(axes * f64::from(radius), center);
        let placement = to_world * own;
        let even = keeps_angles(&placement.matrix3);
        if !even {
            self.warn(&plugin.span, "a sphere that is stretched; Mitsuba has it round");
        }
        // A mirrored sphere faces inward there.
        let inward = flipped != (placement.matrix3.determinant() < 0.0);
        if inward || (emits && !even) {
            let shape = self.mesh(MeshKey::of(Form::Sphere, inward), None)?;
            return Some(Placed { shape, placement });
        }
        Some(Placed { shape: self.scene.add_shape(Shape::Sphere { radius: 1.0 }), placement })
    }

    /// In the plane z = 0 there, facing +Z.
    fn disk(&mut self, to_world: DAffine3, flipped: bool, emits: bool) -> Option<Placed> {
        let stretched = !keeps_angles(&to_world.matrix3);
        if emits && stretched {
            return self.simple(Form::Disk, to_world, flipped);
        }
        // Our y to their z, or to −z if it is flipped.
        let turn = DQuat::from_rotation_x(if flipped { -1.0 } else { 1.0 } * std::f64::consts::FRAC_PI_2);
        let shape = self.scene.add_shape(Shape::Disc { radius: 1.0 });
        Some(Placed { shape, placement: to_world * DAffine3::from_quat(turn) })
    }

    /// An open tube from `p0` to `p1`.
    fn cylinder(&mut self, plugin: &'a Plugin, to_world: DAffine3, flipped: bool) -> Option<Placed> {
        let from = self.vector(plugin, "p0").unwrap_or(Vec3::ZERO).as_dvec3();
        let to = self.vector(plugin, "p1").unwrap_or(Vec3::Z).as_dvec3();
        let radius = f64::from(self.number(plugin, "radius", POSITIVE, 1.0));
        let Some(axis) = (to - from).try_normalize() else {
            self.report.add(&plugin.span, "`p0` and `p1` of a cylinder are the same", None);
            return None;
        };
        let turn = DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Z, axis));
        let size = DMat3::from_diagonal(DVec3::new(radius, radius, (to - from).length()));
        let own = DAffine3::from_mat3_translation(turn * size, from);
        self.simple(Form::Tube, to_world * own, flipped)
    }
}

/// True if a map is a rotation and a scale by one factor, perhaps mirrored.
fn keeps_angles(m: &DMat3) -> bool {
    let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis];
    let length = x.length();
    let even = (y.length() - length).abs() <= 1e-4 * length && (z.length() - length).abs() <= 1e-4 * length;
    even && [x.dot(y), y.dot(z), z.dot(x)].iter().all(|cosine| cosine.abs() <= 1e-4 * length * length)
}
