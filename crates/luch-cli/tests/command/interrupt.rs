//! Any moment is a good moment to stop.

use crate::workplace::{Said, Workplace, signal};
use std::time::{Duration, Instant};

/// Enough samples that nothing ends by itself, few enough to be finished afterwards; one thread, so that fast machines are interrupted as well.
const LONG: &str = "render scene.kdl --spp 256 -o a.png --threads 1 --every 1s";

#[test]
fn an_interrupted_rendering_resumes_to_the_same_bits() {
    let place = Workplace::new();
    for name in ["INT", "TERM"] {
        let child = place.start(LONG);
        place.await_file("a.png");
        signal(&child, name);
        let said = Said::of(child.wait_with_output().unwrap());
        assert_eq!(said.code, Some(130), "{}", said.err);
        assert!(said.err.contains("interrupted") && said.err.contains("--resume"), "{}", said.err);
        assert!(!place.film("a.luch").holds(&(0..256)), "it was not interrupted at all");
        assert_eq!(place.files(), ["a.luch", "a.png", "scene.kdl"]);
        place.done("reproduce a.png");
        std::fs::remove_file(place.path("a.png")).unwrap();
    }
    // Twice interrupted, resumed with another number of threads.
    let child = place.start(&format!("{LONG} --resume"));
    place.await_file("a.png");
    signal(&child, "INT");
    child.wait_with_output().unwrap();
    place.done("render scene.kdl --spp 256 -o a.png --threads 3 --resume");
    place.done("render scene.kdl --spp 256 -o whole.png");
    assert_eq!(place.film("a.luch"), place.film("whole.luch"));
}

#[test]
fn a_killed_rendering_resumes_from_its_last_film() {
    let place = Workplace::new();
    let child = place.start(LONG);
    place.await_file("a.luch");
    std::thread::sleep(Duration::from_millis(100));
    signal(&child, "KILL");
    assert_eq!(Said::of(child.wait_with_output().unwrap()).code, None);
    let film = place.film("a.luch");
    assert!(film.mean_samples() >= 1.0 && !film.holds(&(0..256)));
    place.done(&format!("{LONG} --resume"));
    place.done("render scene.kdl --spp 256 -o whole.png");
    assert_eq!(place.film("a.luch"), place.film("whole.luch"));
}

#[test]
fn without_a_goal_it_goes_on_until_it_is_told_to_end() {
    let place = Workplace::empty();
    place.write("scene.kdl", &crate::workplace::SCENE.replace("samples 4; ", ""));
    let child = place.start("render scene.kdl --progress json --no-checkpoint -o a.exr");
    place.await_file("a.exr");
    let asked = Instant::now();
    signal(&child, "INT");
    let said = Said::of(child.wait_with_output().unwrap());
    assert_eq!(said.code, Some(130));
    assert!(said.out.lines().last().unwrap().contains(r#""ending":"interrupted""#));
    assert!(asked.elapsed() < Duration::from_secs(5), "{:?}", asked.elapsed());
    assert_eq!(place.files(), ["a.exr", "scene.kdl"]);
}

#[test]
fn impatience_leaves_no_torn_files() {
    let place = Workplace::new();
    let child = place.start("render scene.kdl --size 512x512 --spp 65536 -o a.exr -o a.png --every 1s");
    place.await_file("a.png");
    signal(&child, "INT");
    std::thread::sleep(Duration::from_millis(20));
    // The work may be over by now.
    let _ = std::process::Command::new("kill").arg("-INT").arg(child.id().to_string()).output();
    assert_eq!(Said::of(child.wait_with_output().unwrap()).code, Some(130));
    assert!(place.film("a.luch").mean_samples() >= 1.0);
    for file in place.files() {
        assert!(["a.exr", "a.luch", "a.png", "scene.kdl"].contains(&file.as_str()), "{file} is left over");
    }
    // The first EXR may not have been begun.
    for name in ["a.png", "a.exr"].into_iter().filter(|name| place.path(name).exists()) {
        luch::image::codec::decode(&place.bytes(name), None).unwrap();
    }
}

#[test]
fn an_interrupted_integral_gives_what_it_has() {
    let place = Workplace::empty();
    let child = place.start("lab integrate exp(x*y) --over x=0..1,y=0..1 --until rel1e-14 --limit 2^32");
    // Long enough to have begun, far from long enough to end.
    std::thread::sleep(Duration::from_secs(2));
    signal(&child, "INT");
    let said = Said::of(child.wait_with_output().unwrap());
    assert_eq!(said.code, Some(130), "{}{}", said.out, said.err);
    assert!(said.out.contains("interrupted") && said.out.contains("±"), "{}", said.out);
}

#[test]
fn judging_ends_when_asked_and_tells_what_was_judged() {
    let place = Workplace::empty();
    let child = place.start("lab truth --sampler all --error 0.05%");
    std::thread::sleep(Duration::from_millis(700));
    let asked = Instant::now();
    signal(&child, "INT");
    let said = Said::of(child.wait_with_output().unwrap());
    assert_eq!(said.code, Some(130), "{}", said.err);
    assert!(said.err.contains("interrupted") && said.err.contains("rows were judged"), "{}", said.err);
    assert!(asked.elapsed() < Duration::from_secs(10), "{:?}", asked.elapsed());
}
