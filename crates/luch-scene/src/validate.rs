//! What is wrong with a scene, in sentences.
//!
//! A scene without problems keeps the guarantees the renderer stands on: every id points at something, every list has the length
//! its user expects, the numbers of materials, lights, cameras and settings are finite and in their ranges, every placement can be
//! inverted. Triangles with corners that are no numbers are never met.

use crate::{
    Camera, ColorValue, Environment, Filter, Id, Integrator, Light, Material, Opacity, Projection,
    Reflectance, ScalarValue, Scene, Settings, Shape, Surface, Texture, TextureUse,
};
use glam::Vec3;
use luch_image::{Bitmap, Pixels, Rgb};
use luch_mesh::{Attribute, TriangleMesh};

/// Largest number of pixels along a side of the picture.
pub(crate) const LARGEST_SIDE: u32 = 1 << 16;

/// Largest number of pixels of the picture: 72 bytes each make a film of 18 GiB.
const MOST_PIXELS: u64 = 1 << 28;

/// Most scatterings of a path.
const DEEPEST_PATH: u32 = 1 << 20;

impl Scene {
    /// Everything that would keep the scene from being rendered; empty if it is sound.
    pub fn problems(&self) -> Vec<String> {
        let mut found = Problems { scene: self, sentences: Vec::new() };
        found.images();
        found.textures();
        found.materials();
        found.shapes();
        found.instances();
        found.lights();
        found.cameras();
        found.settings(&self.settings);
        found.sentences
    }
}

/// The sentences found so far.
struct Problems<'a> {
    scene: &'a Scene,
    sentences: Vec<String>,
}

impl Problems<'_> {
    fn expect(&mut self, good: bool, sentence: impl FnOnce() -> String) {
        if !good {
            self.sentences.push(sentence());
        }
    }

    fn images(&mut self) {
        for (i, image) in self.scene.images.iter().enumerate() {
            let count = match &image.pixels {
                Pixels::U8(p) => p.len(),
                Pixels::U16(p) => p.len(),
                Pixels::F32(p) => p.len(),
            };
            let expected = image.width as usize * image.height as usize;
            self.expect(count == expected && count > 0, || {
                format!("image {i} is {}×{} but has {count} pixels", image.width, image.height)
            });
        }
    }

    fn textures(&mut self) {
        for (i, texture) in self.scene.textures.iter().enumerate() {
            match texture {
                Texture::Image { image, .. } => self.image(*image, &format!("texture {i}")),
                Texture::Checker { even, odd } => {
                    self.expect(is_light(*even) && is_light(*odd), || {
                        format!("texture {i} has a colour that is negative or not finite")
                    });
                }
            }
        }
    }

    fn image(&mut self, image: Id<Bitmap>, owner: &str) {
        self.expect(image.index() < self.scene.images.len(), || {
            format!("{owner} refers to image {image:?}, which does not exist")
        });
    }

    fn texture(&mut self, used: TextureUse, owner: &str) {
        self.expect(used.texture.index() < self.scene.textures.len(), || {
            format!("{owner} refers to texture {:?}, which does not exist", used.texture)
        });
        self.expect(used.transform.is_finite(), || {
            format!("{owner} has a texture transform that is not finite")
        });
    }

    fn color(&mut self, value: &ColorValue, most: f32, owner: &str, name: &str) {
        self.expect(is_light(value.factor) && value.factor.max_channel() <= most, || {
            let Rgb { r, g, b } = value.factor;
            let range = if most.is_finite() {
                format!("between 0 and {most}")
            } else {
                "finite and not negative".into()
            };
            format!("{owner}: {name} is ({r}, {g}, {b}), expected {range}")
        });
        if let Some(used) = value.texture {
            self.texture(used, owner);
        }
    }

    fn scalar(&mut self, value: &ScalarValue, least: f32, most: f32, owner: &str, name: &str) {
        self.expect((least..=most).contains(&value.factor), || {
            format!("{owner}: {name} is {}, expected {least} to {most}", value.factor)
        });
        if let Some((used, _)) = value.texture {
            self.texture(used, owner);
        }
    }

    fn materials(&mut self) {
        for (i, material) in self.scene.materials.iter().enumerate() {
            let owner = if material.name.is_empty() {
                format!("material {i}")
            } else {
                format!("material {i} \"{}\"", material.name)
            };
            self.surface(&material.surface, i, &owner);
            if let Some(emission) = &material.emission {
                self.color(&emission.radiance, f32::MAX, &owner, "emitted radiance");
            }
            match &material.opacity {
                Opacity::Opaque => {}
                Opacity::Mask { alpha, cutoff } => {
                    self.scalar(alpha, 0.0, 1.0, &owner, "alpha");
                    self.expect(cutoff.is_finite(), || format!("{owner}: alpha cutoff is {cutoff}"));
                }
                Opacity::Blend { alpha } => self.scalar(alpha, 0.0, 1.0, &owner, "alpha"),
            }
            if let Some(map) = &material.normal_map {
                self.texture(map.texture, &owner);
                self.expect(map.scale.is_finite(), || format!("{owner}: normal map scale is {}", map.scale));
            }
        }
    }

    fn surface(&mut self, surface: &Surface, place: usize, owner: &str) {
        match surface {
            Surface::Absorber => {}
            Surface::Diffuse { color } => self.color(color, 1.0, owner, "color"),
            Surface::Conductor { reflectance, roughness, compensated: _ } => {
                self.scalar(roughness, 0.0, 1.0, owner, "roughness");
                match reflectance {
                    Reflectance::Metal(_) => {}
                    Reflectance::Index { eta, k } => self.expect(is_light(*eta) && is_light(*k), || {
                        format!("{owner}: eta and k must be finite and not negative")
                    }),
                    Reflectance::Color(color) => self.color(color, 1.0, owner, "color"),
                }
            }
            Surface::Dielectric { ior, roughness, tint } => {
                self.ior(*ior, owner);
                self.scalar(roughness, 0.0, 1.0, owner, "roughness");
                self.color(tint, 1.0, owner, "tint");
            }
            Surface::Principled(principled) => {
                self.color(&principled.base_color, 1.0, owner, "base color");
                self.color(&principled.specular_color, f32::MAX, owner, "specular color");
                self.scalar(&principled.metallic, 0.0, 1.0, owner, "metallic");
                self.scalar(&principled.roughness, 0.0, 1.0, owner, "roughness");
                self.scalar(&principled.transmission, 0.0, 1.0, owner, "transmission");
                self.scalar(&principled.specular, 0.0, 1.0, owner, "specular");
                self.ior(principled.ior, owner);
            }
            Surface::Phong { diffuse, specular, exponent } => {
                self.color(diffuse, 1.0, owner, "diffuse color");
                self.color(specular, 1.0, owner, "specular color");
                self.scalar(exponent, 0.0, 1e6, owner, "exponent");
                let sum = (diffuse.factor + specular.factor).max_channel();
                self.expect(sum <= 1.0 + 1e-6, || {
                    format!("{owner}: diffuse and specular add up to {sum}, expected at most 1")
                });
            }
            Surface::Glossy { color, glossiness } => {
                self.color(color, 1.0, owner, "color");
                self.scalar(glossiness, 0.0, 1.0, owner, "glossiness");
                self.expect(glossiness.factor > 0.0, || format!("{owner}: glossiness must be more than 0"));
            }
            Surface::Mix { first, second, weight } => {
                self.scalar(weight, 0.0, 1.0, owner, "weight");
                for part in [first, second] {
                    // Parts stand before the mix, so chains of mixes cannot be cyclic.
                    self.expect(part.index() < place, || {
                        format!("{owner} mixes material {part:?}, which does not stand before it")
                    });
                }
            }
        }
    }

    fn ior(&mut self, ior: f32, owner: &str) {
        self.expect((0.1..=10.0).contains(&ior), || format!("{owner}: ior is {ior}, expected 0.1 to 10"));
    }

    fn shapes(&mut self) {
        for (i, shape) in self.scene.shapes.iter().enumerate() {
            match &**shape {
                Shape::Mesh(mesh) => self.mesh(mesh, i),
                Shape::Sphere { radius } | Shape::Disc { radius } => self
                    .expect(radius.is_finite() && *radius > 0.0, || {
                        format!("shape {i} has radius {radius}, expected more than 0")
                    }),
                Shape::Plane => {}
                Shape::Traced(form) => {
                    if let Some(problem) = form.problem() {
                        self.sentences.push(format!("shape {i} has {problem}"));
                    }
                }
            }
        }
    }

    fn mesh(&mut self, mesh: &TriangleMesh, place: usize) {
        let owner = format!("mesh {place}");
        let count = mesh.triangles.len();
        self.expect(indices_fit(&mesh.triangles, mesh.positions.len()), || {
            format!("{owner} has a triangle that refers to a position past the last")
        });
        self.attribute(&mesh.normals, mesh, &owner, "normals");
        self.attribute(&mesh.tangents, mesh, &owner, "tangents");
        self.attribute(&mesh.colors, mesh, &owner, "colors");
        for (set, uvs) in mesh.uv_sets.iter().enumerate() {
            self.attribute(uvs, mesh, &owner, &format!("uv set {set}"));
        }
        self.expect(mesh.slots.is_empty() || mesh.slots.len() == count, || {
            format!("{owner} has {} material slots for {count} triangles", mesh.slots.len())
        });
    }

    fn attribute<T>(&mut self, attribute: &Attribute<T>, mesh: &TriangleMesh, owner: &str, name: &str) {
        if attribute.triangles.is_empty() {
            let good = attribute.values.is_empty() || attribute.values.len() == mesh.positions.len();
            self.expect(good, || {
                format!(
                    "{owner} has {} {name} for {} positions",
                    attribute.values.len(),
                    mesh.positions.len()
                )
            });
        } else {
            let good = attribute.triangles.len() == mesh.triangles.len()
                && indices_fit(&attribute.triangles, attribute.values.len());
            self.expect(good, || format!("{owner} has indices of {name} that do not fit its triangles"));
        }
    }

    fn instances(&mut self) {
        for (i, instance) in self.scene.instances.iter().enumerate() {
            let owner = format!("instance {i}");
            self.expect(instance.shape.index() < self.scene.shapes.len(), || {
                format!("{owner} refers to shape {:?}, which does not exist", instance.shape)
            });
            self.expect(!instance.materials.is_empty(), || format!("{owner} has no material"));
            for material in &instance.materials {
                self.expect(material.index() < self.scene.materials.len(), || {
                    format!("{owner} refers to material {material:?}, which does not exist")
                });
            }
            let determinant = instance.placement.matrix3.determinant();
            self.expect(
                instance.placement.is_finite() && determinant != 0.0 && determinant.is_finite(),
                || format!("{owner} is placed by a matrix that cannot be inverted"),
            );
            self.emitting_shape(i);
        }
    }

    /// Lamps must be forms that light can be drawn from.
    fn emitting_shape(&mut self, place: usize) {
        let instance = &self.scene.instances[place];
        let emits =
            |id: &Id<Material>| self.scene.materials.get(id.index()).is_some_and(|m| m.emission.is_some());
        if !instance.materials.iter().any(emits) {
            return;
        }
        match self.scene.shapes.get(instance.shape.index()).map(|shape| &**shape) {
            Some(Shape::Plane) => self.sentences.push(format!(
                "instance {place} is an emitting plane, whose light would have no bounds; take a disc or a mesh"
            )),
            Some(Shape::Sphere { .. } | Shape::Disc { .. }) => {
                let m = instance.placement.matrix3;
                let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis].map(|axis| axis.length());
                let even = (x - y).abs() <= 1e-4 * x && (x - z).abs() <= 1e-4 * x;
                let square = [m.x_axis.dot(m.y_axis), m.y_axis.dot(m.z_axis), m.z_axis.dot(m.x_axis)];
                let right = square.iter().all(|d| d.abs() <= 1e-4 * x * x);
                self.expect(even && right, || {
                    format!("instance {place} is an emitting sphere or disc that is stretched; take a mesh for it")
                });
            }
            _ => {}
        }
    }

    fn lights(&mut self) {
        for (i, light) in self.scene.lights.iter().enumerate() {
            let (place, direction, strength, angles) = match *light {
                Light::Point { position, intensity } => (position, Vec3::Y, intensity, true),
                Light::Spot { position, direction, intensity, inner_angle, outer_angle } => {
                    let angles = 0.0 <= inner_angle
                        && inner_angle <= outer_angle
                        && outer_angle <= std::f32::consts::PI;
                    (position, direction, intensity, angles)
                }
                Light::Sun { direction, irradiance, angular_radius } => {
                    let angles = (0.0..std::f32::consts::FRAC_PI_2).contains(&angular_radius);
                    (Vec3::ZERO, direction, irradiance, angles)
                }
            };
            self.expect(place.is_finite(), || format!("light {i} is at {place}"));
            self.expect(direction.is_normalized(), || {
                format!("light {i} has direction {direction}, expected length 1")
            });
            self.expect(is_light(strength), || {
                format!("light {i} has a strength that is negative or not finite")
            });
            self.expect(angles, || format!("light {i} has angles out of range"));
        }
        match self.scene.environment {
            None => {}
            Some(Environment::Constant { radiance }) => {
                self.expect(is_light(radiance), || {
                    "the environment's radiance is negative or not finite".into()
                });
            }
            Some(Environment::LatLong { image, scale, rotation }) => {
                self.image(image, "the environment");
                self.expect(is_light(scale), || "the environment's scale is negative or not finite".into());
                let turned = rotation.transpose() * rotation;
                self.expect(turned.abs_diff_eq(glam::Mat3::IDENTITY, 1e-4), || {
                    "the environment's rotation is not a rotation".into()
                });
            }
        }
    }

    fn cameras(&mut self) {
        self.expect(!self.scene.cameras.is_empty(), || "the scene has no camera".into());
        for (i, named) in self.scene.cameras.iter().enumerate() {
            let Camera { position, orientation, projection, lens_radius, focus_distance } = named.camera;
            self.expect(position.is_finite() && orientation.is_finite(), || {
                format!("camera {i} has a place or direction that is not finite")
            });
            let turned = orientation.transpose() * orientation;
            self.expect(turned.abs_diff_eq(glam::Mat3::IDENTITY, 1e-3), || {
                format!("camera {i} has axes that are not at right angles and of length 1")
            });
            match projection {
                Projection::Perspective { field_of_view_y: angle } => self
                    .expect(angle > 0.0 && angle < std::f32::consts::PI, || {
                        format!("camera {i} has a field of view of {angle} rad, expected more than 0 and less than π")
                    }),
                Projection::Orthographic { height } => self.expect(height.is_finite() && height > 0.0, || {
                    format!("camera {i} sees a height of {height}, expected more than 0")
                }),
            }
            self.expect(lens_radius.is_finite() && lens_radius >= 0.0, || {
                format!("camera {i} has lens radius {lens_radius}, expected 0 or more")
            });
            self.expect(focus_distance.is_finite() && focus_distance > 0.0, || {
                format!("camera {i} has focus distance {focus_distance}, expected more than 0")
            });
        }
    }

    fn settings(&mut self, settings: &Settings) {
        for (side, name) in [(settings.width, "width"), (settings.height, "height")] {
            self.expect((1..=LARGEST_SIDE).contains(&side), || {
                format!("picture {name} is {side}, expected 1 to {LARGEST_SIDE}")
            });
        }
        let pixels = u64::from(settings.width) * u64::from(settings.height);
        self.expect(pixels <= MOST_PIXELS, || {
            format!("the picture has {pixels} pixels, expected at most {MOST_PIXELS}")
        });
        if let Integrator::Path { max_depth } | Integrator::PlainPath { max_depth } = settings.integrator {
            self.expect(max_depth <= DEEPEST_PATH, || {
                format!("paths have up to {max_depth} scatterings, expected at most {DEEPEST_PATH}")
            });
        }
        let radius = match settings.filter {
            Filter::Box { radius } | Filter::Tent { radius } | Filter::BlackmanHarris { radius } => radius,
            Filter::Gaussian { radius, deviation } => {
                self.expect(deviation.is_finite() && deviation > 0.0, || {
                    format!("filter deviation is {deviation}, expected more than 0")
                });
                radius
            }
        };
        self.expect(radius > 0.0 && radius <= 64.0, || {
            format!("filter radius is {radius}, expected more than 0, at most 64")
        });
        if let Integrator::Occlusion { distance } = settings.integrator {
            self.expect(distance > 0.0, || format!("occlusion distance is {distance}, expected more than 0"));
        }
    }
}

fn is_light(color: Rgb) -> bool {
    color.is_finite() && color.r >= 0.0 && color.g >= 0.0 && color.b >= 0.0
}

fn indices_fit(triangles: &[[u32; 3]], count: usize) -> bool {
    triangles.iter().flatten().all(|&i| (i as usize) < count)
}
