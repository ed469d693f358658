//! The first picture: a scene that is built in, 64 samples a pixel, a file.
//!
//! `cargo run --release -p luch --example 01_first_picture -- first.png`

use luch::prelude::*;
use std::path::PathBuf;
use std::sync::atomic::AtomicU64;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).map_or_else(|| "first.png".into(), PathBuf::from);

    let scene = luch::scene::preset::cornell_box();
    let view = View::new(&scene.cameras[0].camera, &scene.settings);
    let world = World::build(scene)?;

    let mut film = Film::new(view.width(), view.height());
    render_pass(&world, &view, &PathTracer::default(), &mut film, 0..64, &Stop::new(), &AtomicU64::new(0))?;

    save_image(&path, &film.to_image(), &Default::default(), &Default::default())?;
    Ok(())
}
