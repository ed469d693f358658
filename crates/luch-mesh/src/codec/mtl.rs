//! MTL, the material files of Wavefront OBJ, with the physically based keys many programs have added.
//!
//! Sources: Alias|Wavefront, "MTL material format" (1995); the extension of Exocortex ("Extending MTL for PBR").
//! Values are kept as the file has them; nothing is said here of what a renderer should make of them.

mod read;
mod texture;
mod write;

use glam::Vec3;

use super::error::Warning;
pub use read::decode;
pub use texture::{Channel, MtlTexture};
pub use write::encode;

/// The materials of a file, in order, and what was odd.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MtlFile {
    /// The materials.
    pub materials: Vec<MtlMaterial>,
    /// What was left out.
    pub warnings: Vec<Warning>,
}

/// One material; `None` for whatever the file does not say.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MtlMaterial {
    /// `newmtl`.
    pub name: String,
    /// `Ka`.
    pub ambient: Option<Vec3>,
    /// `Kd`.
    pub diffuse: Option<Vec3>,
    /// `Ks`.
    pub specular: Option<Vec3>,
    /// `Ke`.
    pub emission: Option<Vec3>,
    /// `Tf` (also `Kt`): the colour that passes through.
    pub transmission_filter: Option<Vec3>,
    /// `Ns`: exponent of the highlight, usually 0 to 1000.
    pub shininess: Option<f32>,
    /// `Ni`.
    pub index_of_refraction: Option<f32>,
    /// `d`, or else 1 − `Tr`: 1 is solid. `d` wins if a file gives both.
    pub opacity: Option<f32>,
    /// `illum`: 0 to 10.
    pub illumination_model: Option<u32>,
    /// `Pr`.
    pub roughness: Option<f32>,
    /// `Pm`.
    pub metallic: Option<f32>,
    /// `Ps`.
    pub sheen: Option<f32>,
    /// `Pc`.
    pub clearcoat: Option<f32>,
    /// `Pcr`.
    pub clearcoat_roughness: Option<f32>,
    /// `aniso`.
    pub anisotropy: Option<f32>,
    /// `anisor`.
    pub anisotropy_rotation: Option<f32>,
    /// `map_Ka`.
    pub ambient_map: Option<MtlTexture>,
    /// `map_Kd`.
    pub diffuse_map: Option<MtlTexture>,
    /// `map_Ks`.
    pub specular_map: Option<MtlTexture>,
    /// `map_Ke`.
    pub emission_map: Option<MtlTexture>,
    /// `map_Ns`.
    pub shininess_map: Option<MtlTexture>,
    /// `map_d`, or else `map_Tr`.
    pub opacity_map: Option<MtlTexture>,
    /// `bump`, `map_bump`, `map_Bump`: heights.
    pub bump_map: Option<MtlTexture>,
    /// `norm`, `map_Kn`: normals in the tangent frame.
    pub normal_map: Option<MtlTexture>,
    /// `disp`, `map_disp`.
    pub displacement_map: Option<MtlTexture>,
    /// `decal`.
    pub decal_map: Option<MtlTexture>,
    /// `refl`, the last of them.
    pub reflection_map: Option<MtlTexture>,
    /// `map_Pr`.
    pub roughness_map: Option<MtlTexture>,
    /// `map_Pm`.
    pub metallic_map: Option<MtlTexture>,
    /// `map_Ps`.
    pub sheen_map: Option<MtlTexture>,
}

/// One value of a material, to be read or written.
enum Field<'a> {
    Color(&'a mut Option<Vec3>),
    Number(&'a mut Option<f32>),
    Map(&'a mut Option<MtlTexture>),
}

/// The keywords that are written, in order.
const KEYWORDS: [&str; 29] = [
    "Ka", "Kd", "Ks", "Ke", "Tf", "Ns", "Ni", "d", "Pr", "Pm", "Ps", "Pc", "Pcr", "aniso", "anisor",
    "map_Ka", "map_Kd", "map_Ks", "map_Ke", "map_Ns", "map_d", "bump", "norm", "disp", "decal", "refl",
    "map_Pr", "map_Pm", "map_Ps",
];

impl MtlMaterial {
    /// The field of a keyword, which is given in lower case. `illum`, `Tr` and `newmtl` are not among them.
    fn field(&mut self, keyword: &str) -> Option<Field<'_>> {
        Some(match keyword {
            "ka" => Field::Color(&mut self.ambient),
            "kd" => Field::Color(&mut self.diffuse),
            "ks" => Field::Color(&mut self.specular),
            "ke" => Field::Color(&mut self.emission),
            "tf" | "kt" => Field::Color(&mut self.transmission_filter),
            "ns" => Field::Number(&mut self.shininess),
            "ni" => Field::Number(&mut self.index_of_refraction),
            "d" => Field::Number(&mut self.opacity),
            "pr" => Field::Number(&mut self.roughness),
            "pm" => Field::Number(&mut self.metallic),
            "ps" => Field::Number(&mut self.sheen),
            "pc" => Field::Number(&mut self.clearcoat),
            "pcr" => Field::Number(&mut self.clearcoat_roughness),
            "aniso" => Field::Number(&mut self.anisotropy),
            "anisor" => Field::Number(&mut self.anisotropy_rotation),
            "map_ka" => Field::Map(&mut self.ambient_map),
            "map_kd" => Field::Map(&mut self.diffuse_map),
            "map_ks" => Field::Map(&mut self.specular_map),
            "map_ke" => Field::Map(&mut self.emission_map),
            "map_ns" => Field::Map(&mut self.shininess_map),
            "map_d" | "map_tr" => Field::Map(&mut self.opacity_map),
            "bump" | "map_bump" => Field::Map(&mut self.bump_map),
            "norm" | "map_kn" => Field::Map(&mut self.normal_map),
            "disp" | "map_disp" => Field::Map(&mut self.displacement_map),
            "decal" => Field::Map(&mut self.decal_map),
            "refl" | "map_refl" => Field::Map(&mut self.reflection_map),
            "map_pr" => Field::Map(&mut self.roughness_map),
            "map_pm" => Field::Map(&mut self.metallic_map),
            "map_ps" => Field::Map(&mut self.sheen_map),
            _ => return None,
        })
    }
}
