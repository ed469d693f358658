//! One scene put inside another.

use crate::images::MOST_PIXELS;
use crate::material_values::values;
use glam::{Affine3A, Mat3};
use luch_scene::{Environment, Id, Light, Scene, Shape, Texture, TextureUse};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Most things in one list of a scene, most and most triangles, with all that is imported.
const MOST_THINGS: usize = 1 << 22;
const MOST_TRIANGLES: usize = 1 << 26;

/// Where the things of another scene are in this one's lists: each shape and picture, and the first material and texture.
pub(crate) struct Places {
    shapes: Vec<u32>,
    images: Vec<u32>,
    materials: u32,
    textures: u32,
}

/// Says in words if `scene` would become too large with `other` in it; `is_known` if [`bring`] was done before.
pub(crate) fn check_size(scene: &Scene, other: &Scene, is_known: bool) -> Result<(), String> {
    let placed = |s: &Scene| s.instances.len().max(s.lights.len()).max(s.cameras.len());
    let owned = |s: &Scene| s.materials.len().max(s.textures.len()).max(s.shapes.len()).max(s.images.len());
    let pixels = |s: &Scene| s.images.iter().map(|i| u64::from(i.width) * u64::from(i.height)).sum::<u64>();
    let triangles = |s: &Scene| {
        s.shapes
            .iter()
            .map(|shape| if let Shape::Mesh(mesh) = &**shape { mesh.triangles.len() } else { 0 })
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
pub(crate) fn bring(scene: &mut Scene, other: &Scene) -> Places {
    let places = Places {
        shapes: share(&mut scene.shapes, &other.shapes),
        images: share(&mut scene.images, &other.images),
        materials: scene.materials.len() as u32,
        textures: scene.textures.len() as u32,
    };
    for texture in &other.textures {
        let mut texture = texture.clone();
        if let Texture::Image { image, .. } = &mut texture {
            *image = Id::new(places.images[image.index()]);
        }
        scene.textures.push(texture);
    }
    append_materials(scene, other, &places);
    places
}

/// Appends the instances, lights and cameras of `other`, placed by `placement`, and its environment if there is none.
/// Settings stay as they are.
pub(crate) fn place(scene: &mut Scene, other: &Scene, places: &Places, placement: &Affine3A) {
    for instance in &other.instances {
        let mut instance = instance.clone();
        instance.shape = Id::new(places.shapes[instance.shape.index()]);
        for material in &mut instance.materials {
            *material = moved(*material, places.materials);
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
                image: Id::new(places.images[image.index()]),
                scale,
                rotation: rotation_of(placement) * rotation,
            },
        });
    }
}

/// Appends what the list does not hold yet, and tells the places of all.
fn share<T>(list: &mut Vec<Arc<T>>, more: &[Arc<T>]) -> Vec<u32> {
    let mut known: BTreeMap<*const T, u32> =
        (0..).zip(&*list).map(|(i, old)| (Arc::as_ptr(old), i)).collect();
    let place_of = |thing: &Arc<T>| {
        *known.entry(Arc::as_ptr(thing)).or_insert_with(|| {
            list.push(Arc::clone(thing));
            list.len() as u32 - 1
        })
    };
    more.iter().map(place_of).collect()
}

fn moved<T>(id: Id<T>, by: u32) -> Id<T> {
    Id::new(id.index() as u32 + by)
}

fn append_materials(scene: &mut Scene, other: &Scene, places: &Places) {
    let moved_use = |used: &mut TextureUse| used.texture = moved(used.texture, places.textures);
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
            *part = moved(*part, places.materials);
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
