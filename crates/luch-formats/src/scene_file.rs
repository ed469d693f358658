//! A scene as it is written in luch's own format (`docs/scene-format.md`): names and paths where [`luch_scene::Scene`]
//! has ids and data, and the place in the text of everything that may turn out wrong later.
//!
//! Reading a text gives a [`SceneFile`]; [`crate::resolve`] makes a scene of it. Numbers, ranges and spelling are checked
//! here, references there. In the materials of a [`SceneFile`] a texture id counts [`SceneFile::pictures`], and the ids
//! of a mix count [`SceneFile::material_uses`].

mod camera;
mod color;
mod copies;
mod decoder;
mod fields;
mod light;
mod material;
mod mesh;
mod object;
mod settings;
mod source;
mod surface;
mod texture;
mod transform;
mod value;

pub(crate) use decoder::{normal, read};
pub(crate) use source::{Report, Span, advice, clip};

use glam::{Affine3A, Mat3};
use luch_image::{Encoding, Rgb};
use luch_mesh::workshop::Step;
use luch_scene::{Light, Material, NamedCamera, Settings, TextureFilter, Traced, Wrap};

/// A value and where it is written.
#[derive(Clone, Debug)]
pub(crate) struct Spanned<T> {
    pub(crate) value: T,
    pub(crate) span: Span,
}

/// A thing that may be referred to by its name.
#[derive(Clone, Debug)]
pub(crate) struct Named<T> {
    /// `None` for what is written where it is used.
    pub(crate) name: Option<Spanned<String>>,
    pub(crate) value: T,
}

/// All that a scene file and the files it includes say.
#[derive(Clone, Debug, Default)]
pub(crate) struct SceneFile {
    pub(crate) settings: Option<Spanned<Settings>>,
    pub(crate) wishes: crate::Wishes,
    pub(crate) cameras: Vec<Spanned<NamedCamera>>,
    pub(crate) textures: Vec<Named<TextureSource>>,
    /// What values of materials refer to.
    pub(crate) pictures: Vec<Picture>,
    pub(crate) materials: Vec<Named<Material>>,
    /// What mixes and objects refer to.
    pub(crate) material_uses: Vec<MaterialUse>,
    pub(crate) meshes: Vec<Named<MeshSource>>,
    pub(crate) objects: Vec<ObjectSource>,
    pub(crate) lights: Vec<Light>,
    pub(crate) imports: Vec<ImportSource>,
    pub(crate) environment: Option<Spanned<EnvironmentSource>>,
}

/// Where a texture comes from.
#[derive(Clone, Debug)]
pub(crate) enum TextureSource {
    Image(ImageSource),
    Checker { even: Rgb, odd: Rgb },
}

/// A picture file and how it is read.
#[derive(Clone, Debug)]
pub(crate) struct ImageSource {
    pub(crate) path: Spanned<String>,
    /// `None`: as the file says for colours, linear for numbers.
    pub(crate) encoding: Option<Encoding>,
    pub(crate) wrap: [Wrap; 2],
    pub(crate) filter: TextureFilter,
}

/// The texture of a value.
#[derive(Clone, Debug)]
pub(crate) enum Picture {
    Named(Spanned<String>),
    Image(ImageSource),
}

/// The material of an object or a mix.
#[derive(Clone, Debug)]
pub(crate) enum MaterialUse {
    Named(Spanned<String>),
    /// A place in [`SceneFile::materials`].
    Inline(usize),
}

/// A mesh and what is done to it.
#[derive(Clone, Debug)]
pub(crate) struct MeshSource {
    pub(crate) span: Span,
    pub(crate) origin: MeshOrigin,
    pub(crate) operations: Vec<MeshOperation>,
}

/// Where a mesh comes from.
#[derive(Clone, Debug)]
pub(crate) enum MeshOrigin {
    File(Spanned<String>),
    Form(WorkshopStep),
}

/// A verb of the workshop with its arguments.
#[derive(Clone, Debug)]
pub(crate) struct WorkshopStep {
    pub(crate) span: Span,
    pub(crate) step: Step,
}

/// What is done to a mesh, in the order it is written.
#[derive(Clone, Debug)]
pub(crate) enum MeshOperation {
    /// Drops the normals: every triangle is flat.
    FlatNormals,
    /// One normal for each position.
    SmoothNormals,
    /// Normals that are smooth over edges bent by less than this angle, radians.
    CreasedNormals(f32),
    /// Joins positions that are this close, metres.
    Weld(f32),
    /// Turns the surface inside out.
    Flip,
    Transform(Affine3A),
    Workshop(WorkshopStep),
}

/// What an object is made of.
#[derive(Clone, Debug)]
pub(crate) enum ShapeSource {
    Mesh(Spanned<String>),
    /// A place in [`SceneFile::meshes`].
    InlineMesh(usize),
    Sphere {
        radius: f32,
    },
    Disc {
        radius: f32,
    },
    Plane,
    Traced(Traced),
    /// A verb that makes heights, which are traced as they are.
    HeightField(WorkshopStep),
}

/// A shape put into the world.
#[derive(Clone, Debug)]
pub(crate) struct ObjectSource {
    pub(crate) name: String,
    pub(crate) span: Span,
    pub(crate) shape: ShapeSource,
    /// Places in [`SceneFile::material_uses`], one for each slot; empty for clay.
    pub(crate) materials: Vec<usize>,
    /// Of the object and its copies, at least one.
    pub(crate) placements: Vec<Affine3A>,
}

/// Another file put into the world.
#[derive(Clone, Debug)]
pub(crate) struct ImportSource {
    pub(crate) path: Spanned<String>,
    pub(crate) placement: Affine3A,
}

/// What surrounds the scene.
#[derive(Clone, Debug)]
pub(crate) enum EnvironmentSource {
    Constant(Rgb),
    Image {
        path: Spanned<String>,
        scale: Rgb,
        rotation: Mat3,
    },
    /// [`crate::neutral_sky`].
    Neutral {
        scale: Rgb,
        rotation: Mat3,
    },
}
