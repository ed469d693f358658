//! Patches from files and by verbs.

use luch_mesh::patch::{Fineness, PatchModel, bpt, car, shapes, text};
use luch_mesh::workshop::{Files, Pipeline, WorkshopError};
use luch_mesh::{PolygonMesh, measure};

struct OneFile(Vec<u8>);

impl Files for OneFile {
    fn bytes(&mut self, _: &str) -> Result<Vec<u8>, String> {
        Ok(self.0.clone())
    }

    fn mesh(&mut self, _: &str) -> Result<PolygonMesh, String> {
        Err("no mesh".into())
    }
}

fn run(line: &str, file: &[u8]) -> Result<PolygonMesh, WorkshopError> {
    Pipeline::parse(line)?.run(&mut OneFile(file.to_vec()))
}

/// `LUCH_RENEW=1 cargo test -p luch-mesh --test patches` writes the file anew.
#[test]
fn the_car_in_the_scenes_is_the_one_made_here() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/meshes/car-body.bpt");
    let text = bpt::encode(&car::car_body().unwrap()).unwrap();
    assert!(text.len() < 100_000, "{} bytes", text.len());
    if std::env::var_os("LUCH_RENEW").is_some() {
        std::fs::create_dir_all(concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/meshes")).unwrap();
        std::fs::write(path, &text).unwrap();
    }
    let file = std::fs::read(path).unwrap();
    assert!(file == text.as_bytes(), "the file differs: write it anew with LUCH_RENEW=1");
    assert_eq!(bpt::decode(&file).unwrap(), car::car_body().unwrap());
}

#[test]
fn patches_of_a_file_become_a_closed_mesh() {
    let text = bpt::encode(&car::car_body().unwrap()).unwrap();
    for line in ["patches car.bpt", "patches car.bpt --tolerance 0.02", "patches car.bpt --divisions 2"] {
        let mesh = run(line, text.as_bytes()).unwrap().triangulate();
        assert_eq!(measure::closedness(&mesh).to_string(), "closed (5 pieces, genus 4)", "{line}");
    }
    // Half the tolerance takes about twice the triangles: cells shrink with its root both ways.
    let model = bpt::decode(text.as_bytes()).unwrap();
    let count = |tolerance| model.tessellate(Fineness::Tolerance(tolerance)).unwrap().triangles.len() as f64;
    let ratio = count(5e-4) / count(1e-3);
    assert!((1.7..2.3).contains(&ratio), "{ratio}");
}

#[test]
fn rational_patches_come_from_text() {
    let model = PatchModel::from(shapes::torus(1.0, 0.25).unwrap());
    let mesh = run("patches a.patches --tolerance 0.01", text::encode(&model).as_bytes()).unwrap();
    assert_eq!(measure::closedness(&mesh.triangulate()).to_string(), "closed (1 piece, genus 1)");
}

#[test]
fn what_is_wrong_is_said() {
    for (line, file, message) in [
        (
            "patches a.bpt",
            &b"1\n3 3\n0 0 zero"[..],
            "`file`: patches: line 3, column 5: found “zero”, expected a coordinate",
        ),
        ("patches a.bpt --tolerance 0", b"0", "a number above 0"),
        ("patches a.bpt --tolerance 1 --divisions 1", b"0", "beside the wish for fineness"),
        ("bezier-patch 1,2,3", b"", "at least two rows of 4 points"),
        ("nurbs-sphere --tolerance 1e-30", b"", "triangles, the most is"),
        ("nurbs-sphere --radius 1e30", b"", "farther away"),
    ] {
        let error = run(line, file).unwrap_err().to_string();
        assert!(error.contains(message), "{line}: {error}");
    }
    assert_eq!(run("patches a.bpt", b"0").unwrap().face_count(), 0);
}
