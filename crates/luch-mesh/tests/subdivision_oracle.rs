//! Subdivision against a port of OpenSubdiv: the same places, with creases of any sharpness, corners, borders and limits.

use glam::{Vec2, Vec3};
use luch_mesh::polygon_mesh::{Crease, SharpVertex};
use luch_mesh::subdivide::{Scheme, Settings, subdivide};
use luch_mesh::{Generator, PolygonMesh, generate};
use opensubdiv_rs::far::{PrimvarRefiner, TopologyDescriptor, TopologyRefinerFactory, UniformOptions};
use opensubdiv_rs::sdc::{Options, SchemeType, VtxBoundaryInterpolation};

/// Places of the last level and in the limit.
struct Reference {
    places: Vec<[f32; 3]>,
    limit: Vec<[f32; 3]>,
}

fn reference(mesh: &PolygonMesh, scheme: SchemeType, levels: usize) -> Reference {
    let sides: Vec<usize> = (0..mesh.face_count()).map(|face| mesh.face(face).len()).collect();
    let pairs: Vec<[u32; 2]> = mesh.creases.iter().map(|c| c.vertices).collect();
    let weights: Vec<f32> = mesh.creases.iter().map(|c| c.sharpness).collect();
    let corners: Vec<u32> = mesh.sharp_vertices.iter().map(|c| c.vertex).collect();
    let corner_weights: Vec<f32> = mesh.sharp_vertices.iter().map(|c| c.sharpness).collect();
    let descriptor = TopologyDescriptor::new(mesh.positions.len(), &sides, &mesh.corners)
        .with_creases(&pairs, &weights)
        .with_corners(&corners, &corner_weights);
    let options = Options::new().with_vtx_boundary_interpolation(VtxBoundaryInterpolation::EdgeOnly);
    let mut refiner = TopologyRefinerFactory::create(descriptor, scheme, options).expect("a manifold");
    refiner.refine_uniform(UniformOptions::new(levels));
    let primvars = PrimvarRefiner::new(&refiner);
    let mut places: Vec<[f32; 3]> = mesh.positions.iter().map(|p| p.to_array()).collect();
    for level in 1..=levels {
        let mut next = vec![[0.0; 3]; refiner.level(level).num_vertices()];
        primvars.interpolate(level, &places, &mut next);
        places = next;
    }
    let mut limit = vec![[0.0; 3]; places.len()];
    primvars.limit(&places, &mut limit);
    Reference { places, limit }
}

/// The numbers of vertices differ; every place must be in the other list.
fn assert_same(ours: &[Vec3], theirs: &[[f32; 3]], context: &str) {
    assert_eq!(ours.len(), theirs.len(), "{context}");
    let mut theirs: Vec<Vec3> = theirs.iter().map(|p| Vec3::from(*p)).collect();
    theirs.sort_by(|a, b| a.x.total_cmp(&b.x));
    for place in ours {
        // Single precision over some levels.
        let near = 4e-6;
        let first = theirs.partition_point(|p| p.x < place.x - near);
        let mut candidates = theirs[first..].iter().take_while(|p| p.x <= place.x + near);
        assert!(candidates.any(|p| p.distance(*place) < near), "{context}: {place}");
    }
}

fn meshes() -> Vec<PolygonMesh> {
    let cage = |generator: Generator| {
        let mesh = generator.mesh();
        let mut cage = PolygonMesh { positions: mesh.positions, ..PolygonMesh::default() };
        mesh.triangles.iter().for_each(|triangle| {
            cage.add_face(triangle);
        });
        cage
    };
    let mut quads =
        PolygonMesh { positions: generate::plane(Vec2::ONE, [5, 4]).positions, ..Default::default() };
    for z in 0..4 {
        for x in 0..5 {
            let first = z * 6 + x;
            quads.add_face(&[first, first + 6, first + 7, first + 1]);
        }
    }
    for (i, position) in quads.positions.iter_mut().enumerate() {
        position.y = (i * 7 % 5) as f32 * 0.1;
    }
    let mut meshes: Vec<PolygonMesh> = Generator::examples().into_iter().map(cage).collect();
    meshes.push(quads);
    meshes
}

/// Every few edges a crease, of the sharpness given by its turn; every few vertices sharp.
fn sharpened(mesh: &PolygonMesh, sharpness: &[f32], step: usize) -> PolygonMesh {
    let mut mesh = mesh.clone();
    let mut edges: Vec<[u32; 2]> = Vec::new();
    for face in 0..mesh.face_count() {
        let corners = &mesh.corners[mesh.face(face)];
        let next = corners.iter().cycle().skip(1);
        edges.extend(corners.iter().zip(next).map(|(&a, &b)| [a.min(b), a.max(b)]));
    }
    edges.sort_unstable();
    edges.dedup();
    for (i, &vertices) in edges.iter().enumerate().filter(|(i, _)| i % step == 0) {
        mesh.creases.push(Crease { vertices, sharpness: sharpness[i / step % sharpness.len()] });
    }
    for vertex in (3..mesh.positions.len() as u32).step_by(step * 3) {
        mesh.sharp_vertices.push(SharpVertex { vertex, sharpness: 1.3 });
    }
    mesh
}

#[test]
fn places_are_those_of_the_reference() {
    for (number, mesh) in meshes().iter().enumerate() {
        let is_triangles = (0..mesh.face_count()).all(|face| mesh.face(face).len() == 3);
        for (kind, mesh) in [
            ("smooth", mesh.clone()),
            // Ten and more is for ever there.
            ("sharp", sharpened(mesh, &[10.0], 5)),
            ("half sharp", sharpened(mesh, &[0.3, 1.7, 2.5, 1.0], 3)),
        ] {
            for (scheme, theirs) in
                [(Scheme::CatmullClark, SchemeType::Catmark), (Scheme::Loop, SchemeType::Loop)]
            {
                if scheme == Scheme::Loop && !is_triangles || mesh.face_count() > 700 {
                    continue;
                }
                let context = format!("mesh {number} {kind} {scheme:?}");
                let settings = Settings { scheme, levels: 3, ..Settings::default() };
                let ours = subdivide(&mesh, &settings).expect("small enough");
                let reference = reference(&mesh, theirs, 3);
                assert_same(&ours.positions, &reference.places, &context);
                // At darts the reference takes the smooth mask, which is not the limit: see the module's own tests.
                if kind == "smooth" {
                    let ours = subdivide(&mesh, &Settings { limit: true, ..settings }).expect("small enough");
                    assert_same(&ours.positions, &reference.limit, &context);
                }
            }
        }
    }
}
