//! A place on a shape, known by ids and barycentric coordinates, and what the scene says there.

use crate::footprint::Footprint;
use crate::texture::look_up;
use crate::traced;
use glam::{Vec2, Vec3, Vec4};
use luch_bvh::InstanceHit;
use luch_image::Rgb;
use luch_scene::{
    Channel, ColorValue, Id, Instance, Material, Opacity, ScalarValue, Scene, Shape, Texture, TextureUse,
};
use std::f32::consts::PI;

/// A place on an instance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) instance: &'a Instance,
    pub(crate) shape: &'a Shape,
    /// Which triangle.
    pub(crate) primitive: usize,
    /// Weights of the three corners.
    pub(crate) weights: [f32; 3],
    /// Place in the shape's coordinates; for shapes that are not meshes.
    pub(crate) local: Vec3,
    /// What is seen of the textures; `None` to read them as they are.
    pub(crate) footprint: Option<Footprint<'a>>,
}

/// The sum of corner values by weight: lecture points 74 to 77.
pub(crate) fn blend<T>(corners: [T; 3], [a, b, c]: [f32; 3]) -> T
where
    T: std::ops::Mul<f32, Output = T> + std::ops::Add<Output = T>,
{
    let [at_a, at_b, at_c] = corners;
    at_a * a + at_b * b + at_c * c
}

impl<'a> Place<'a> {
    /// The place of a hit; `local` matters only where the shape is no mesh.
    pub(crate) fn of_hit(scene: &'a Scene, hit: &InstanceHit, local: Vec3) -> Self {
        let instance = &scene.instances[hit.instance as usize];
        let (u, v) = (hit.hit.u, hit.hit.v);
        Self {
            scene,
            instance,
            shape: &scene.shapes[instance.shape.index()],
            primitive: hit.hit.primitive as usize,
            weights: [1.0 - u - v, u, v],
            local,
            footprint: None,
        }
    }

    /// The material of the place.
    pub(crate) fn material_id(&self) -> Id<Material> {
        let slot = match self.shape {
            Shape::Mesh(mesh) => mesh.slot(self.primitive),
            _ => 0,
        };
        self.instance.material(slot).expect("a sound scene has a material for every instance")
    }

    /// Texture coordinates; zero where the mesh has none.
    pub(crate) fn uv(&self, set: usize) -> Vec2 {
        match self.shape {
            Shape::Mesh(mesh) => mesh
                .corner_uvs(self.primitive, set)
                .map_or(Vec2::ZERO, |corners| blend(corners, self.weights)),
            Shape::Sphere { radius } => {
                let p = self.local / *radius;
                // u runs eastward from −Z, v from pole to pole.
                Vec2::new(
                    0.5 + libm::atan2f(p.x, p.z) / (2.0 * PI),
                    1.0 - libm::acosf(p.y.clamp(-1.0, 1.0)) / PI,
                )
            }
            Shape::Disc { radius } => {
                Vec2::new(self.local.x, -self.local.z) / (2.0 * radius) + Vec2::splat(0.5)
            }
            Shape::Plane => Vec2::new(self.local.x, -self.local.z),
            Shape::Traced(form) => traced::uv(form, self),
        }
    }

    /// Vertex colour; white where the mesh has none.
    fn vertex_color(&self) -> Vec4 {
        let Shape::Mesh(mesh) = self.shape else { return Vec4::ONE };
        let corners = mesh.colors.corners(self.primitive, mesh.triangles[self.primitive]);
        corners.map_or(Vec4::ONE, |corners| blend(corners, self.weights))
    }

    /// A texture as it is laid on here.
    pub(crate) fn texture(&self, used: &TextureUse) -> [f32; 4] {
        let uv = used.place(self.uv(usize::from(used.uv_set)));
        let texture = &self.scene.textures[used.texture.index()];
        let blend = self.footprint.as_ref().and_then(|footprint| match texture {
            Texture::Image { image, .. } => footprint.blend(self, used, &self.scene.images[image.index()]),
            Texture::Checker { .. } => None,
        });
        look_up(self.scene, texture, uv, blend)
    }

    /// A colour here.
    pub(crate) fn color(&self, value: &ColorValue) -> Rgb {
        let mut color = value.factor;
        if let Some(used) = &value.texture {
            let [r, g, b, _] = self.texture(used);
            color *= Rgb::new(r, g, b);
        }
        if value.vertex_color {
            let c = self.vertex_color();
            color *= Rgb::new(c.x, c.y, c.z);
        }
        color
    }

    /// A number here.
    pub(crate) fn scalar(&self, value: &ScalarValue) -> f32 {
        let mut number = value.factor;
        if let Some((used, channel)) = &value.texture {
            let [r, g, b, a] = self.texture(used);
            number *= match channel {
                Channel::Red => r,
                Channel::Green => g,
                Channel::Blue => b,
                Channel::Alpha => a,
                Channel::Luminance => Rgb::new(r, g, b).luminance(),
            };
        }
        if value.vertex_alpha {
            number *= self.vertex_color().w;
        }
        number
    }

    /// The probability that the surface is there.
    pub(crate) fn opacity(&self, material: &Material) -> f32 {
        match &material.opacity {
            Opacity::Opaque => 1.0,
            Opacity::Mask { alpha, cutoff } => f32::from(u8::from(self.scalar(alpha) >= *cutoff)),
            Opacity::Blend { alpha } => self.scalar(alpha),
        }
    }

    /// Mean radiance of a lamp here: what it emits, times the probability that it is there. Rays to a lamp end before it, so nobody
    /// else asks.
    pub(crate) fn lamp_radiance(&self, material: &Material) -> Rgb {
        let Some(emission) = &material.emission else { return Rgb::BLACK };
        let there = self.opacity(material).clamp(0.0, 1.0);
        self.color(&emission.radiance).map(|v| v.max(0.0)) * there
    }
}
