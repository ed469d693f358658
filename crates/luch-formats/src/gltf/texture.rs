//! Pictures, samplers and texture uses.
//!
//! glTF's uv origin is the upper left corner of the picture, v runs down; ours is the lower left, v runs up. With the flip
//! F: (u, v) ↦ (u, 1 − v) mesh coordinates become F uv, and a transform A of the file becomes F A F. Rotations are
//! counter-clockwise as seen on the picture in both, so F A F rotates by the mathematical sign.

use super::Import;
use super::json::{Json, short};
use super::uri::{self, Target};
use crate::Problem;
use glam::{Affine2, Mat2, Vec2};
use luch_image::{Bitmap, Encoding};
use luch_scene::{Id, Texture, TextureFilter, TextureUse, Wrap};
use std::path::PathBuf;

/// What makes a texture of the scene: the texture of the document and how its numbers are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct TextureKey {
    index: usize,
    is_srgb: bool,
}

/// Where a picture's bytes come from; equal sources are decoded once.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum ImageSource {
    /// A buffer view.
    View(usize),
    /// A file beside the document.
    File(PathBuf),
    /// Data in the text of this image.
    Text(usize),
}

/// The uv sets that a mesh has, and those that a material asked for; bit n stands for set n.
#[derive(Clone, Copy, Debug)]
pub(super) struct UvSets {
    pub(super) there: u32,
    pub(super) asked: u32,
}

impl Import<'_> {
    /// A texture as a material uses it; `None`, with a warning, if it cannot be used.
    pub(super) fn texture_use(
        &mut self,
        info: &Json,
        encoding: Encoding,
        sets: &mut UvSets,
    ) -> Result<Option<TextureUse>, Problem> {
        let index = info.need("index")?.reference(&self.document.textures)?;
        let mut set = info.get("texCoord")?.map_or(Ok(0), |set| set.size())?;
        let mut transform = Affine2::IDENTITY;
        if let Some(extension) = info.extension("KHR_texture_transform")? {
            set = extension.get("texCoord")?.map_or(Ok(set), |set| set.size())?;
            transform = texture_transform(&extension)?;
        }
        let bit = u32::try_from(set).ok().and_then(|set| 1_u32.checked_shl(set)).unwrap_or(0);
        sets.asked |= bit;
        if sets.there & bit == 0 {
            self.notices.add(
                info.path(),
                format!(
                    "uv set {set} is not in a mesh that uses this texture; the factor alone is used there"
                ),
            );
            return Ok(None);
        }
        let texture = self.texture(TextureKey { index, is_srgb: encoding == Encoding::Srgb })?;
        Ok(texture.map(|texture| TextureUse { texture, uv_set: set as u8, transform }))
    }

    fn texture(&mut self, key: TextureKey) -> Result<Option<Id<Texture>>, Problem> {
        if let Some(&known) = self.textures.get(&key) {
            return Ok(known);
        }
        let json = self.document.textures.at(key.index);
        let image = match json.get("source")? {
            Some(source) => {
                let index = source.reference(&self.document.images)?;
                self.image(index)?
            }
            None => {
                self.notices.add(
                    json.path(),
                    "the texture has no \"source\" in PNG or JPEG; the factor alone is used",
                );
                None
            }
        };
        let (wrap, filter) = self.sampler(&json)?;
        let encoding = if key.is_srgb { Encoding::Srgb } else { Encoding::Linear };
        let texture =
            image.map(|image| self.scene.add_texture(Texture::Image { image, encoding, wrap, filter }));
        self.textures.insert(key, texture);
        Ok(texture)
    }

    fn sampler(&mut self, texture: &Json) -> Result<([Wrap; 2], TextureFilter), Problem> {
        let Some(reference) = texture.get("sampler")? else { return Ok(Default::default()) };
        let json = self.document.samplers.at(reference.reference(&self.document.samplers)?);
        let mut wrap = [Wrap::Repeat; 2];
        for (wrap, key) in wrap.iter_mut().zip(["wrapS", "wrapT"]) {
            let Some(code) = json.get(key)? else { continue };
            *wrap = match code.whole()? {
                10497 => Wrap::Repeat,
                33648 => Wrap::Mirror,
                33071 => Wrap::Clamp,
                other => {
                    self.notices.add(
                        code.path(),
                        format!("is {other}, expected 10497, 33071 or 33648; 10497 is taken"),
                    );
                    Wrap::Repeat
                }
            };
        }
        // The minifying filter chooses among mipmaps, which a path tracer replaces by its samples.
        let filter = match json.get("magFilter")? {
            None => TextureFilter::Bilinear,
            Some(code) => match code.whole()? {
                9728 => TextureFilter::Nearest,
                9729 => TextureFilter::Bilinear,
                other => {
                    self.notices
                        .add(code.path(), format!("is {other}, expected 9728 or 9729; 9729 is taken"));
                    TextureFilter::Bilinear
                }
            },
        };
        Ok((wrap, filter))
    }

    fn image(&mut self, index: usize) -> Result<Option<Id<Bitmap>>, Problem> {
        let json = self.document.images.at(index);
        let mut data = None;
        let (source, names) = match (json.get("bufferView")?, json.get("uri")?) {
            (Some(view), _) => {
                let view = view.reference_within(self.document.buffers.views().len(), "/bufferViews")?;
                (ImageSource::View(view), None)
            }
            (None, Some(uri)) => match uri::resolve(&uri, self.document.file) {
                Ok(Target::Data(bytes)) => {
                    data = Some(bytes);
                    (ImageSource::Text(index), None)
                }
                Ok(Target::File(names)) => (ImageSource::File(names[0].clone()), Some(names)),
                Err(problem) => {
                    self.notices.add(uri.path(), format!("{}; the factor alone is used", problem.message));
                    return Ok(None);
                }
            },
            (None, None) => return Err(json.problem("has neither \"uri\" nor \"bufferView\"")),
        };
        if let Some(&known) = self.images.get(&source) {
            return Ok(known);
        }
        let mut decode = |bytes: &[u8]| {
            let picture = self.pictures.decode(bytes, None, |_| ())?;
            Ok(self.scene.add_image(picture))
        };
        let found = match (&source, &names) {
            (ImageSource::View(view), _) => decode(self.document.buffers.bytes(*view, &json)?),
            (_, Some(names)) => {
                let path = uri::existing(names, self.document.files);
                let found = self.pictures.find(path, &mut self.scene, &mut Vec::new());
                found.map_err(|problem| problem.message)
            }
            _ => decode(&data.unwrap_or_default()),
        };
        let image = match found {
            Ok(image) => Some(image),
            Err(reason) => {
                let name = names.map(|[name, _]| format!("\"{}\": ", short(&name.display().to_string())));
                let message = format!("{}{reason}; the factor alone is used", name.unwrap_or_default());
                self.notices.add(json.path(), message);
                None
            }
        };
        self.images.insert(source, image);
        Ok(image)
    }
}

/// KHR_texture_transform as a map of uv with v running up.
fn texture_transform(json: &Json) -> Result<Affine2, Problem> {
    let offset = json.numbers_or("offset", [0.0, 0.0])?.map(|x| x as f32);
    let scale = json.numbers_or("scale", [1.0, 1.0])?.map(|x| x as f32);
    let angle = json.number_or("rotation", 0.0)? as f32;
    let (sin, cos) = (libm::sinf(angle), libm::cosf(angle));
    // With v down, counter-clockwise as seen is (u, v) to (u cos + v sin, v cos - u sin).
    let rotation = Mat2::from_cols(Vec2::new(cos, -sin), Vec2::new(sin, cos));
    let down = Affine2::from_mat2_translation(rotation * Mat2::from_diagonal(scale.into()), offset.into());
    let flip = Affine2::from_mat2_translation(Mat2::from_diagonal(Vec2::new(1.0, -1.0)), Vec2::Y);
    let up = flip * down * flip;
    if up.is_finite() { Ok(up) } else { Err(json.problem("is a transform that is not finite")) }
}

#[cfg(test)]
mod tests {
    use super::texture_transform;
    use crate::gltf::json::Json;
    use glam::Vec2;
    use std::path::Path;

    /// Where the picture is looked up (v up) for a mesh's uv (v up).
    fn look_up(json: &str, uv: [f32; 2]) -> Vec2 {
        let value = serde_json::from_str(json).unwrap();
        texture_transform(&Json::root(&value, Path::new("t"))).unwrap().transform_point2(uv.into())
    }

    #[test]
    fn absent_is_identity() {
        assert_eq!(look_up("{}", [0.25, 0.75]), Vec2::new(0.25, 0.75));
    }

    #[test]
    fn the_example_of_the_extension_takes_the_lower_left_quadrant() {
        // KHR_texture_transform, first example: "only the lower left quadrant of the source image, rotated".
        let json = r#"{ "offset": [0, 1], "rotation": 1.57079632679, "scale": [0.5, 0.5] }"#;
        for uv in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [0.3, 0.6]] {
            let place = look_up(json, uv);
            assert!(
                (-1e-6..=0.5 + 1e-6).contains(&place.x) && (-1e-6..=0.5 + 1e-6).contains(&place.y),
                "{place}"
            );
        }
        // Upper left of the mesh (0, 1) is glTF's origin; it moves to the offset, the lower left of the picture.
        assert!(look_up(json, [0.0, 1.0]).abs_diff_eq(Vec2::new(0.0, 0.0), 1e-6));
        // One step right along the mesh is half a step up the picture.
        assert!(look_up(json, [1.0, 1.0]).abs_diff_eq(Vec2::new(0.0, 0.5), 1e-6));
    }

    #[test]
    fn the_second_example_makes_the_origin_lower_left() {
        let json = r#"{ "offset": [0, 1], "scale": [1, -1] }"#;
        assert_eq!(look_up(json, [0.25, 0.125]), Vec2::new(0.25, 0.875));
    }
}
