//! What is looked at: a scene or a mesh, with what every view of it needs.

use crate::exact::Exact;
use crate::outline::Outline;
use crate::traced;
use crate::view::wide_affine;
use glam::{Affine3A, Vec3};
use luch_bvh::Aabb;
use luch_mesh::{PolygonMesh, TriangleMesh};
use luch_scene::{Instance, Material, Opacity, Scene, Shape, Sides};
use rayon::prelude::*;
use std::borrow::Cow;
use std::sync::OnceLock;

/// A scene or a mesh, prepared for any number of pictures.
///
/// Nothing has to be sound: triangles that name missing or infinite positions, instances that name missing shapes or have no
/// inverse are passed over.
#[derive(Debug)]
pub struct Subject<'a> {
    pub(crate) forms: Vec<Form<'a>>,
    pub(crate) parts: Vec<Part<'a>>,
    pub(crate) scene: Option<&'a Scene>,
}

/// A shape in its own coordinates.
#[derive(Debug)]
pub(crate) struct Form<'a> {
    pub(crate) kind: FormKind<'a>,
    /// A box around it.
    pub(crate) bounds: Aabb,
    outline: OnceLock<Outline>,
}

#[derive(Debug)]
pub(crate) enum FormKind<'a> {
    Mesh(Box<Mesh<'a>>),
    Exact(Exact),
}

/// Triangles, and the polygons that they were made of if there are any.
#[derive(Debug)]
pub(crate) struct Mesh<'a> {
    pub(crate) triangles: Cow<'a, TriangleMesh>,
    pub(crate) polygons: Option<Polygons<'a>>,
}

#[derive(Debug)]
pub(crate) struct Polygons<'a> {
    pub(crate) mesh: &'a PolygonMesh,
    /// For each triangle its face.
    pub(crate) faces: Vec<u32>,
}

impl Mesh<'_> {
    /// The number by which a triangle is known: that of its face where there are polygons.
    pub(crate) fn face(&self, triangle: u32) -> u32 {
        match &self.polygons {
            Some(polygons) => polygons.faces.get(triangle as usize).copied().unwrap_or(triangle),
            None => triangle,
        }
    }

    /// The corners of a triangle, if all of them exist.
    #[inline]
    pub(crate) fn corners(&self, triangle: u32) -> Option<[Vec3; 3]> {
        let mesh = &*self.triangles;
        let [a, b, c] = *mesh.triangles.get(triangle as usize)?;
        let at = |index: u32| mesh.positions.get(index as usize).copied();
        Some([at(a)?, at(b)?, at(c)?])
    }
}

/// A form put somewhere.
#[derive(Debug)]
pub(crate) struct Part<'a> {
    pub(crate) form: usize,
    /// The instance's number in the scene; 0 for a mesh.
    pub(crate) number: u32,
    /// The instance, unless the subject is a bare mesh.
    pub(crate) instance: Option<&'a Instance>,
    pub(crate) placement: Affine3A,
    /// Whether the placement turns right hands into left ones.
    pub(crate) is_mirrored: bool,
    /// Whether some material of it is not everywhere or not on both sides.
    pub(crate) has_gaps: bool,
}

impl<'a> Subject<'a> {
    /// All instances of a scene.
    pub fn scene(scene: &'a Scene) -> Self {
        let forms = scene.shapes.par_iter().map(|shape| Form::of_shape(shape)).collect();
        let parts = (0..).zip(&scene.instances).filter_map(|(number, instance)| {
            let form = instance.shape.index();
            (form < scene.shapes.len()).then_some(())?;
            Part::new(form, number, instance.placement, Some(instance), scene)
        });
        let parts = parts.collect();
        Self { forms, parts, scene: Some(scene) }
    }

    /// A mesh as it stands.
    pub fn triangles(mesh: &'a TriangleMesh) -> Self {
        Self::bare(Mesh { triangles: Cow::Borrowed(mesh), polygons: None })
    }

    /// A mesh as it stands; its wires are the edges of the polygons, its faces are known by their own numbers.
    pub fn polygons(mesh: &'a PolygonMesh) -> Self {
        let cut = mesh.triangulation();
        let polygons = Some(Polygons { mesh, faces: cut.faces });
        Self::bare(Mesh { triangles: Cow::Owned(cut.mesh), polygons })
    }

    fn bare(mesh: Mesh<'a>) -> Self {
        let part = Part {
            form: 0,
            number: 0,
            instance: None,
            placement: Affine3A::IDENTITY,
            is_mirrored: false,
            has_gaps: false,
        };
        Self { forms: vec![Form::of_mesh(mesh)], parts: vec![part], scene: None }
    }

    /// The smallest box with sides along the world's axes around all that is bounded; empty if nothing is.
    pub fn bounds(&self) -> Aabb {
        let bounds = self.parts.par_iter().map(|part| {
            let form = &self.forms[part.form];
            match &form.kind {
                FormKind::Mesh(mesh) => bounds_of(&mesh.triangles.positions, &part.placement),
                FormKind::Exact(exact) => exact.bounds().transformed(&part.placement),
            }
        });
        bounds.reduce(Aabb::empty, |a, b| a.union(&b))
    }

    /// The material of a part's slot.
    pub(crate) fn material(&self, part: &Part, slot: u16) -> Option<&'a Material> {
        self.scene?.materials.get(part.instance?.material(slot)?.index())
    }
}

/// The box around the finite ones of the points, after they were placed.
fn bounds_of(points: &[Vec3], placement: &Affine3A) -> Aabb {
    let chunks = points.par_chunks(1 << 14).map(|chunk| {
        let placed = chunk.iter().map(|&point| placement.transform_point3(point));
        Aabb::of_points(placed.filter(|point| point.is_finite()))
    });
    chunks.reduce(Aabb::empty, |a, b| a.union(&b))
}

impl<'a> Form<'a> {
    fn of_shape(shape: &'a Shape) -> Self {
        let exact = match shape {
            Shape::Mesh(mesh) => {
                return Self::of_mesh(Mesh { triangles: Cow::Borrowed(mesh), polygons: None });
            }
            Shape::Sphere { radius } => Exact::Sphere { radius: f64::from(*radius) },
            Shape::Disc { radius } => Exact::Disc { radius: f64::from(*radius) },
            Shape::Plane => Exact::Plane,
            Shape::Traced(form) => {
                let triangles = Cow::Owned(traced::triangles(form));
                return Self::of_mesh(Mesh { triangles, polygons: None });
            }
        };
        Self { bounds: exact.bounds(), kind: FormKind::Exact(exact), outline: OnceLock::new() }
    }

    fn of_mesh(mesh: Mesh<'a>) -> Self {
        let bounds = bounds_of(&mesh.triangles.positions, &Affine3A::IDENTITY);
        Self { bounds, kind: FormKind::Mesh(Box::new(mesh)), outline: OnceLock::new() }
    }

    /// Its edges, found when first asked for.
    pub(crate) fn outline(&self) -> &Outline {
        self.outline.get_or_init(|| match &self.kind {
            FormKind::Mesh(mesh) => Outline::of_mesh(mesh),
            FormKind::Exact(exact) => exact.outline(),
        })
    }
}

impl<'a> Part<'a> {
    /// `None` if the placement has no inverse.
    fn new(
        form: usize,
        number: u32,
        placement: Affine3A,
        instance: Option<&'a Instance>,
        scene: &Scene,
    ) -> Option<Self> {
        let determinant = wide_affine(&placement).matrix3.determinant();
        if !placement.is_finite() || !determinant.is_finite() || determinant == 0.0 {
            return None;
        }
        let materials = instance.iter().flat_map(|instance| &instance.materials);
        let has_gaps = materials
            .filter_map(|id| scene.materials.get(id.index()))
            .any(|material| material.sides == Sides::Front || !matches!(material.opacity, Opacity::Opaque));
        Some(Self { form, number, instance, placement, is_mirrored: determinant < 0.0, has_gaps })
    }
}
