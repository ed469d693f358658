//! One object, many places: `array` and `scatter`.

use glam::{Affine3A, Vec3};
use luch_formats::{Files, load_with};
use luch_scene::Scene;
use std::path::Path;

fn load(object: &str) -> Result<Scene, String> {
    let text = format!("luch 1\nobject \"o\" {{ {object} }}\nenvironment 1\n");
    let files = Files::memory([("s.kdl".into(), text.into())]);
    load_with(Path::new("s.kdl"), &files).map(|loaded| loaded.scene).map_err(|error| error.to_string())
}

fn places(object: &str) -> Vec<Affine3A> {
    load(object).unwrap().instances.iter().map(|instance| instance.placement).collect()
}

#[test]
fn an_array_steps_and_arrays_multiply() {
    let row = places("sphere; array 1000 { translate 0.1 0 0 }");
    assert_eq!(row.len(), 1000);
    for (k, place) in row.iter().enumerate() {
        // One rounding of the step, one of the product; a thousand sums in single precision would be off by far more.
        let expected = (f64::from(0.1_f32) * k as f64) as f32;
        assert_eq!(place.translation, glam::Vec3A::new(expected, 0.0, 0.0));
    }
    let grid =
        places("sphere; scale 2; array 3 { translate 1 0 0 }; array 2 { translate 0 0 5 }; translate 0 7 0");
    let expected =
        [(0, 0), (1, 0), (2, 0), (0, 5), (1, 5), (2, 5)].map(|(x, z)| Vec3::new(x as f32, 7.0, z as f32));
    assert_eq!(grid.iter().map(|place| Vec3::from(place.translation)).collect::<Vec<_>>(), expected);
    assert!(grid.iter().all(|place| place.matrix3 == glam::Mat3A::from_diagonal(Vec3::splat(2.0))));
    let ring = places("sphere; translate 1 0 0; array 4 { rotate-y 90 }");
    for (place, expected) in ring.iter().zip([Vec3::X, Vec3::NEG_Z, Vec3::NEG_X, Vec3::Z]) {
        assert!(place.transform_point3(Vec3::ZERO).abs_diff_eq(expected, 1e-6), "{place:?}");
    }
}

#[test]
fn copies_share_their_shape_and_materials() {
    let scene =
        load("mesh { icosphere subdivisions=2 }; material { diffuse 0.2 }; array 50 { translate 3 0 0 }")
            .unwrap();
    assert_eq!((scene.shapes.len(), scene.materials.len(), scene.instances.len()), (1, 1, 50));
    assert!(scene.instances.iter().all(|instance| instance.name == "o" && instance.shape.index() == 0));
}

#[test]
fn scattered_copies_fill_their_box_evenly_and_repeat() {
    const COUNT: usize = 10_000;
    let text = "sphere; scatter 10000 { size 20 0 4; turn 360; scale 0.5 1.5; seed 3 }; translate 100 1 0";
    let all = places(text);
    assert_eq!(all, places(text), "a pure function of the text");
    assert_ne!(all, places(&text.replace("seed 3", "seed 4")));
    assert_eq!(all.len(), COUNT);
    let inside = |place: &Affine3A| {
        let at = Vec3::from(place.translation) - Vec3::new(100.0, 1.0, 0.0);
        at.x.abs() <= 10.0 + 1e-4 && at.y == 0.0 && at.z.abs() <= 2.0
    };
    assert!(all.iter().all(inside));
    // Means of uniform numbers: x over 20 m has deviation 20/√12, scales over 1 have 1/√12; judged by 4 standard errors.
    let mean = |of: &dyn Fn(&Affine3A) -> f64| all.iter().map(of).sum::<f64>() / COUNT as f64;
    let error = |width: f64| 4.0 * width / (12.0 * COUNT as f64).sqrt();
    assert!((mean(&|place| f64::from(place.translation.x)) - 100.0).abs() < error(20.0));
    assert!(mean(&|place| f64::from(place.translation.z)).abs() < error(4.0));
    let scale = |place: &Affine3A| f64::from(place.matrix3.x_axis.length());
    assert!((mean(&scale) - 1.0).abs() < error(1.0));
    assert!(all.iter().all(|place| (0.499..=1.501).contains(&scale(place))));
    // The cosine of an even angle has mean 0 and variance 1/2.
    let cosine = |place: &Affine3A| f64::from(place.matrix3.x_axis.x) / scale(place);
    assert!(mean(&cosine).abs() < 4.0 * (0.5 / COUNT as f64).sqrt());
}

#[test]
fn what_is_wrong_is_told_at_its_place() {
    for (object, expected) in [
        ("sphere; array { translate 1 0 0 }", "s.kdl:2:22: `array` lacks the number of copies"),
        ("sphere; array 3", "s.kdl:2:22: `array` does not say where the next copy stands"),
        ("sphere; array 3 { translte 1 0 0 }", "s.kdl:2:32: unknown transform `translte` in `array`"),
        (
            "sphere; array 0 { translate 1 0 0 }",
            "s.kdl:2:28: `array` is `0`, expected a whole number from 1 to 4194304",
        ),
        ("sphere; scatter 3", "s.kdl:2:22: `scatter` lacks the `size` of its box"),
        ("sphere; scatter 3 { size -1 0 0 }", "s.kdl:2:39: `size` is `-1`"),
        (
            "sphere; scatter 3 { size 1 0 0; scale 2 1 }",
            "the least `scale` is 2, which is more than the most, 1",
        ),
        (
            "sphere; array 3000 { translate 1 0 0 }; array 3000 { translate 0 0 1 }",
            "s.kdl:2:60: with these copies the scene has more than 4194304 objects",
        ),
        ("sphere; array 2000 { scale 2 }", "leave the range of numbers"),
        ("sphere; material { emission 1 }; array 2 { scale 1 2 1 }", "cannot be stretched"),
        ("sphere array=3", "s.kdl:2:21: unknown option `array` in `sphere`"),
        // Closes the block and opens another object.
        ("sphere }; object \"p\" array=3 { sphere", "`array` stands in the block of"),
    ] {
        let error = load(object).unwrap_err();
        assert!(error.contains(expected), "{object}:\n{error}\nexpected {expected}");
    }
}
