//! One scene put inside another.

use crate::material_values::values;
use glam::{Affine3A, Mat3};
use luch_scene::{Environment, Id, Light, Scene, Shape, Texture, TextureUse};

/// Most things in one list of a scene, most triangles and most pixels, with all that is imported.
const MOST_THINGS: usize = 1 << 22;
const MOST_TRIANGLES: usize = 1 << 26;
const MOST_PIXELS: u64 = 1 << 29;

/// Where the things of another scene begin in this one's lists.
pub(crate) struct Offsets {
    shapes: u32,
    materials: u32,
    textures: u32,
    images: u32,
}

/// Says in words if `scene` would become too large with `other` in it; `is_known` if [`bring`] was done before.
pub(crate) fn check_size(scene: &Scene, other: &Scene, is_known: bool) -> Result<(), String> {
    let placed = |s: &Scene| s.instances.len().max(s.lights.len()).max(s.cameras.len());
    let owned = |s: &Scene| s.materials.len().max(s.textures.len()).max(s.shapes.len()).max(s.images.len());
    let pixels = |s: &Scene| s.images.iter().map(|i| u64::from(i.width) * u64::from(i.height)).sum::<u64>();
    let triangles = |s: &Scene| {
        s.shapes
            .iter()
            .map(|shape| if let Shape::Mesh(mesh) = shape { mesh.triangles.len() } else { 0 })
            .sum::<usize>()
    };
    if placed(scene) + placed(other) > MOST_THINGS {
        return Err(format!("the scene has more than {MOST_THINGS} objects, lights or cameras"));
    }
    if is_known {
        return Ok(());
    }
    if owned(scene) + owned(other) > MOST_THINGS {
        return Err(format!("the scene has more than {MOST_THINGS} materials, textures, shapes or images"));
    }
    if triangles(scene) + triangles(other) > MOST_TRIANGLES {
        return Err(format!("the scene has more than {MOST_TRIANGLES} triangles"));
    }
    if pixels(scene) + pixels(other) > MOST_PIXELS {
        return Err(format!("the pictures of the scene have more than {MOST_PIXELS} pixels"));
    }
    Ok(())
}

/// Appends the shapes, materials, textures and images of `other`, which [`place`] then refers to.
pub(crate) fn bring(scene: &mut Scene, other: &Scene) -> Offsets {
    let offset = Offsets {
        shapes: scene.shapes.len() as u32,
        materials: scene.materials.len() as u32,
        textures: scene.textures.len() as u32,
        images: scene.images.len() as u32,
    };
    scene.images.extend_from_slice(&other.images);
    scene.shapes.extend_from_slice(&other.shapes);
    for texture in &other.textures {
        let mut texture = texture.clone();
        if let Texture::Image { image, .. } = &mut texture {
            *image = moved(*image, offset.images);
        }
        scene.textures.push(texture);
    }
    append_materials(scene, other, &offset);
    offset
}

/// Appends the instances, lights and cameras of `other`, placed by `placement`, and its environment if there is none.
/// Settings stay as they are.
pub(crate) fn place(scene: &mut Scene, other: &Scene, offset: &Offsets, placement: &Affine3A) {
    for instance in &other.instances {
        let mut instance = instance.clone();
        instance.shape = moved(instance.shape, offset.shapes);
        for material in &mut instance.materials {
            *material = moved(*material, offset.materials);
        }
        instance.placement = *placement * instance.placement;
        scene.instances.push(instance);
    }
    scene.lights.extend(other.lights.iter().map(|light| place_light(*light, placement)));
    for camera in &other.cameras {
        let mut camera = camera.clone();
        camera.camera = camera.camera.placed(placement);
        scene.cameras.push(camera);
    }
    if scene.environment.is_none() {
        scene.environment = other.environment.map(|environment| match environment {
            Environment::Constant { .. } => environment,
            Environment::LatLong { image, scale, rotation } => Environment::LatLong {
                image: moved(image, offset.images),
                scale,
                rotation: rotation_of(placement) * rotation,
            },
        });
    }
}

fn moved<T>(id: Id<T>, by: u32) -> Id<T> {
    Id::new(id.index() as u32 + by)
}

fn append_materials(scene: &mut Scene, other: &Scene, offset: &Offsets) {
    let moved_use = |used: &mut TextureUse| used.texture = moved(used.texture, offset.textures);
    for material in &other.materials {
        let mut material = material.clone();
        if let Some(map) = &mut material.normal_map {
            moved_use(&mut map.texture);
        }
        let all = values(&mut material);
        for color in all.colors {
            color.texture.iter_mut().for_each(moved_use);
        }
        for scalar in all.scalars {
            scalar.texture.iter_mut().for_each(|(used, _)| moved_use(used));
        }
        for part in all.parts {
            *part = moved(*part, offset.materials);
        }
        scene.materials.push(material);
    }
}

/// A lamp carried along; a scale moves it but does not make it stronger.
pub(crate) fn place_light(light: Light, placement: &Affine3A) -> Light {
    let turned = |direction| placement.transform_vector3(direction).try_normalize().unwrap_or(direction);
    match light {
        Light::Point { position, intensity } => {
            Light::Point { position: placement.transform_point3(position), intensity }
        }
        Light::Spot { position, direction, intensity, inner_angle, outer_angle } => Light::Spot {
            position: placement.transform_point3(position),
            direction: turned(direction),
            intensity,
            inner_angle,
            outer_angle,
        },
        Light::Sun { direction, irradiance, angular_radius } => {
            Light::Sun { direction: turned(direction), irradiance, angular_radius }
        }
    }
}

/// The rotation in a placement: its axes made orthonormal, without mirroring.
fn rotation_of(placement: &Affine3A) -> Mat3 {
    let m = placement.matrix3;
    let (Some(x), Some(y)) = (m.x_axis.try_normalize(), m.y_axis.try_normalize()) else {
        return Mat3::IDENTITY;
    };
    let Some(z) = x.cross(y).try_normalize() else { return Mat3::IDENTITY };
    Mat3::from_cols(x.into(), z.cross(x).into(), z.into())
}
