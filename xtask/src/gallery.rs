//! Renders every scene of `scenes/` into `target/gallery`, and the picture of the README.

use crate::run;
use std::path::Path;
use std::process::Command;

/// The scene on the front page.
const FRONT: &str = "lecture.kdl";

pub(crate) fn render(root: &Path) -> Result<(), String> {
    let gallery = root.join("target/gallery");
    std::fs::create_dir_all(&gallery).map_err(|error| format!("{}: {error}", gallery.display()))?;
    let mut scenes: Vec<_> = std::fs::read_dir(root.join("scenes"))
        .map_err(|error| format!("scenes: {error}"))?
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "kdl"))
        .collect();
    scenes.sort();
    for scene in scenes {
        let front = scene.file_name().is_some_and(|name| name == FRONT);
        let picture = match front {
            true => root.join("docs/lecture.jpg"),
            false => gallery.join(scene.file_stem().unwrap_or_default()).with_extension("png"),
        };
        let samples = if front { "128" } else { "64" };
        let mut command = Command::new("cargo");
        command.args(["run", "--release", "--quiet", "--bin", "luch", "--", "render"]).arg(&scene);
        command.args(["--no-checkpoint", "--spp", samples, "-o"]).arg(&picture);
        run(command.current_dir(root))?;
        println!("{}", picture.display());
    }
    Ok(())
}
