//! Renders every scene of `docs/figures` into the picture beside it.

use crate::run;
use std::path::Path;
use std::process::Command;

pub(crate) fn render(root: &Path) -> Result<(), String> {
    let folder = root.join("docs/figures");
    let entries = std::fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut scenes: Vec<_> = entries
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "kdl"))
        .collect();
    scenes.sort();
    for scene in scenes {
        let picture = scene.with_extension("jpg");
        let mut command = Command::new("cargo");
        command.args(["run", "--release", "--quiet", "--bin", "luch", "--", "render", "--no-checkpoint"]);
        run(command.arg(&scene).arg("-o").arg(&picture).current_dir(root))?;
        println!("{}", picture.display());
    }
    Ok(())
}
