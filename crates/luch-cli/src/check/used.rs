//! Things that nothing uses, and things that are used but not there.

use luch::scene::{
    ColorValue, Id, Material, Opacity, Principled, Reflectance, ScalarValue, Scene, Shape, Surface,
    TextureUse,
};

/// What is odd about who uses what, in sentences.
pub(crate) fn advice(scene: &Scene) -> Vec<String> {
    let mut found = unused_materials(scene);
    found.extend(unused_shapes(scene));
    found.extend(missing_uvs(scene));
    found
}

fn unused_materials(scene: &Scene) -> Vec<String> {
    let mut used = vec![false; scene.materials.len()];
    let mut open: Vec<Id<Material>> =
        scene.instances.iter().flat_map(|instance| instance.materials.clone()).collect();
    // A mixture uses its parts.
    while let Some(id) = open.pop() {
        if !std::mem::replace(&mut used[id.index()], true)
            && let Surface::Mix { first, second, .. } = &scene.materials[id.index()].surface
        {
            open.extend([*first, *second]);
        }
    }
    let unused = scene.materials.iter().enumerate().filter(|(i, _)| !used[*i]);
    unused
        .map(|(i, material)| format!("material {i} \"{}\" is not used by any object", material.name))
        .collect()
}

fn unused_shapes(scene: &Scene) -> Vec<String> {
    let shown = |i: usize| scene.instances.iter().any(|instance| instance.shape.index() == i);
    (0..scene.shapes.len())
        .filter(|i| !shown(*i))
        .map(|i| format!("shape {i} is not used by any object"))
        .collect()
}

/// Textures look up uvs that the mesh may not have.
fn missing_uvs(scene: &Scene) -> Vec<String> {
    let mut found = Vec::new();
    for instance in &scene.instances {
        let Shape::Mesh(mesh) = &*scene.shapes[instance.shape.index()] else { continue };
        for id in &instance.materials {
            let material = &scene.materials[id.index()];
            let lacks = |used: &TextureUse| {
                mesh.uv_sets.get(usize::from(used.uv_set)).is_none_or(|set| set.is_empty())
            };
            if let Some(used) = texture_uses(material).iter().find(|used| lacks(used)) {
                found.push(format!(
                    "object \"{}\": material \"{}\" has a texture, but the mesh has no uv set {}",
                    instance.name, material.name, used.uv_set
                ));
            }
        }
    }
    found.dedup();
    found
}

/// Every texture that a material lays on.
fn texture_uses(material: &Material) -> Vec<TextureUse> {
    let mut colors: Vec<&ColorValue> = Vec::new();
    let mut scalars: Vec<&ScalarValue> = Vec::new();
    match &material.surface {
        Surface::Absorber => {}
        Surface::Diffuse { color } => colors.push(color),
        Surface::Conductor { reflectance, roughness, compensated: _ } => {
            if let Reflectance::Color(color) = reflectance {
                colors.push(color);
            }
            scalars.push(roughness);
        }
        Surface::Dielectric { roughness, tint, .. } => {
            colors.push(tint);
            scalars.push(roughness);
        }
        Surface::Principled(Principled {
            base_color,
            metallic,
            roughness,
            transmission,
            specular,
            specular_color,
            ..
        }) => {
            colors.extend([base_color, specular_color]);
            scalars.extend([metallic, roughness, transmission, specular]);
        }
        Surface::Phong { diffuse, specular, exponent } => {
            colors.extend([diffuse, specular]);
            scalars.push(exponent);
        }
        Surface::Glossy { color, glossiness } => {
            colors.push(color);
            scalars.push(glossiness);
        }
        Surface::Mix { weight, .. } => scalars.push(weight),
    }
    colors.extend(material.emission.as_ref().map(|emission| &emission.radiance));
    if let Opacity::Mask { alpha, .. } | Opacity::Blend { alpha } = &material.opacity {
        scalars.push(alpha);
    }
    let of_colors = colors.into_iter().filter_map(|color| color.texture);
    let of_scalars = scalars.into_iter().filter_map(|scalar| scalar.texture.map(|(used, _)| used));
    let of_normals = material.normal_map.map(|map| map.texture);
    of_colors.chain(of_scalars).chain(of_normals).collect()
}
