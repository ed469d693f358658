//! What a pixel covers of a texture, and the smaller copies that are read for it.

use crate::geometry::local_normal;
use crate::place::Place;
use crate::traced;
use glam::{Mat3, Vec2, Vec3};
use luch_image::{Bitmap, Encoding, Pyramid};
use luch_scene::{
    ColorValue, Minification, Reflectance, ScalarValue, Scene, Shape, Surface, Texture, TextureUse,
};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::f32::consts::PI;

/// The part of a ray's width that a pixel of the texture may have: pixels half as wide as those of the picture are lost in its
/// own filter.
const SHARE: f32 = 0.5;

/// Smaller copies of the pictures that surfaces are coloured with.
#[derive(Debug, Default)]
pub(crate) struct Pyramids {
    /// By texture its place in the list.
    places: Vec<Option<u32>>,
    list: Vec<Pyramid>,
}

impl Pyramids {
    /// Those that the scene asks for. Lamps, cut-outs and normal maps are read as they are and need none.
    pub(crate) fn build(scene: &Scene) -> Self {
        if scene.settings.texture_filter == Minification::None {
            return Self::default();
        }
        let mut known: BTreeMap<(usize, bool), u32> = BTreeMap::new();
        let mut sources: Vec<(&Bitmap, Encoding)> = Vec::new();
        let mut places = vec![None; scene.textures.len()];
        for used in scene.materials.iter().flat_map(|material| textures_of(&material.surface)) {
            let place = used.texture.index();
            let Texture::Image { image, encoding, .. } = scene.textures[place] else { continue };
            places[place] =
                Some(*known.entry((image.index(), encoding == Encoding::Srgb)).or_insert_with(|| {
                    sources.push((&scene.images[image.index()], encoding));
                    sources.len() as u32 - 1
                }));
        }
        let list = sources.par_iter().map(|(image, encoding)| Pyramid::new(image, *encoding)).collect();
        Self { places, list }
    }

    /// Smaller copies of the picture of a texture.
    fn of(&self, used: &TextureUse) -> &[Bitmap] {
        let place = self.places.get(used.texture.index()).copied().flatten();
        place.map_or(&[], |place| self.list[place as usize].levels())
    }
}

/// The textures that a surface scatters by.
fn textures_of(surface: &Surface) -> Vec<&TextureUse> {
    let (colors, scalars): (Vec<&ColorValue>, Vec<&ScalarValue>) = match surface {
        Surface::Absorber => Default::default(),
        Surface::Diffuse { color } => (vec![color], vec![]),
        Surface::Conductor { reflectance: Reflectance::Color(color), roughness, .. } => {
            (vec![color], vec![roughness])
        }
        Surface::Conductor { roughness, .. } => (vec![], vec![roughness]),
        Surface::Dielectric { roughness, tint, .. } => (vec![tint], vec![roughness]),
        Surface::Principled(p) => (
            vec![&p.base_color, &p.specular_color],
            vec![&p.metallic, &p.roughness, &p.transmission, &p.specular],
        ),
        Surface::Phong { diffuse, specular, exponent } => (vec![diffuse, specular], vec![exponent]),
        Surface::Glossy { color, glossiness } => (vec![color], vec![glossiness]),
        Surface::Mix { weight, .. } => (vec![], vec![weight]),
    };
    let of_scalars = scalars.into_iter().filter_map(|value| value.texture.as_ref().map(|(used, _)| used));
    colors.into_iter().filter_map(|value| value.texture.as_ref()).chain(of_scalars).collect()
}

/// What a ray covers of a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Footprint<'a> {
    pub(crate) pyramids: &'a Pyramids,
    /// Of the ray; unit length.
    pub(crate) direction: Vec3,
    /// Diameter of the ray, metres.
    pub(crate) width: f32,
}

/// Between which copies a texture is read: `part` of the second. Level 0 is the picture itself.
pub(crate) struct Blend<'a> {
    pub(crate) first: Option<&'a Bitmap>,
    pub(crate) second: &'a Bitmap,
    pub(crate) part: f32,
}

impl<'a> Footprint<'a> {
    /// The copies to read for a texture at a place; `None` where the texture is coarser than the footprint.
    pub(crate) fn blend(&self, place: &Place, used: &TextureUse, image: &Bitmap) -> Option<Blend<'a>> {
        let levels = self.pyramids.of(used);
        if levels.is_empty() || self.width <= 0.0 {
            return None;
        }
        let size = Vec2::new(image.width as f32, image.height as f32);
        let [a, b] = texture_steps(place, used, self.axes(place)?)?.map(|step| step * size);
        // The smaller singular value of the matrix of both columns.
        let sum = a.length_squared() + b.length_squared();
        let (unlike, skew) = (a.length_squared() - b.length_squared(), 2.0 * a.dot(b));
        let difference = (unlike * unlike + skew * skew).sqrt();
        let determinant = a.perp_dot(b);
        let narrow = (2.0 * determinant * determinant / (sum + difference)).sqrt();
        let pixels = narrow * SHARE;
        // Where the surface is seen edge on nothing is known; then the picture itself is read.
        if pixels.is_nan() || pixels <= 1.0 {
            return None;
        }
        let level = libm::log2f(pixels).min(levels.len() as f32);
        let whole = level.floor();
        let (first, part) = (whole as usize, level - whole);
        let last = levels.len() - 1;
        Some(Blend {
            first: first.checked_sub(1).map(|first| &levels[first.min(last)]),
            second: &levels[first.min(last)],
            part,
        })
    }

    /// The half axes of the ellipse on the surface, times two: across the ray, and along it where it is slanting.
    fn axes(&self, place: &Place) -> Option<[Vec3; 2]> {
        let linear = Mat3::from(place.instance.placement.matrix3);
        let normal = match place.shape {
            Shape::Mesh(mesh) => {
                let [a, b, c] = mesh.corners(place.primitive);
                (linear * (b - a)).cross(linear * (c - a))
            }
            _ => linear.inverse().transpose() * local_normal(place),
        };
        let normal = normal.try_normalize()?;
        let cosine = normal.dot(self.direction);
        let slant = self.direction - normal * cosine;
        let along = slant.try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
        // At the edge of what is visible the ellipse has no end; a million is as good.
        Some([normal.cross(along) * self.width, along * (self.width / cosine.abs().max(1e-6))])
    }
}

/// By how much texture coordinates change with two steps along the surface, in the world.
fn texture_steps(place: &Place, used: &TextureUse, steps: [Vec3; 2]) -> Option<[Vec2; 2]> {
    let linear = Mat3::from(place.instance.placement.matrix3);
    let turn = used.transform.matrix2;
    if let Shape::Mesh(mesh) = place.shape {
        let [a, b, c] = mesh.corners(place.primitive);
        let [ua, ub, uc] = mesh.corner_uvs(place.primitive, usize::from(used.uv_set))?;
        let (first, second) = (linear * (b - a), linear * (c - a));
        let normal = first.cross(second);
        let area = normal.length_squared();
        let (du, dv) = (turn * (ub - ua), turn * (uc - ua));
        let change = |step: Vec3| {
            du * (step.cross(second).dot(normal) / area) + dv * (first.cross(step).dot(normal) / area)
        };
        return (area > 0.0).then(|| steps.map(change));
    }
    let inverse = linear.inverse();
    let p = place.local;
    let change = |step: Vec3| match place.shape {
        Shape::Sphere { .. } => {
            // Derivatives of longitude and latitude.
            let ring = p.x * p.x + p.z * p.z;
            let turned = (p.z * step.x - p.x * step.z) / (2.0 * PI * ring);
            Vec2::new(turned, step.y / (ring.sqrt() * PI))
        }
        Shape::Disc { radius } => Vec2::new(step.x, -step.z) / (2.0 * radius),
        Shape::Plane | Shape::Mesh(_) => Vec2::new(step.x, -step.z),
        Shape::Traced(form) => traced::uv_step(form, place, step),
    };
    Some(steps.map(|step| turn * change(inverse * step)))
}
