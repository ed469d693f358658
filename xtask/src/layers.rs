//! Crates depend downward only: the drawing in ARCHITECTURE.md, kept true.

use std::collections::BTreeSet;
use std::path::Path;

/// The layers, lowest first. Crates of one layer do not see one another.
const LAYERS: [&[&str]; 7] = [
    &["luch-sampling", "luch-bvh", "luch-image", "luch-formula"],
    &["luch-mesh"],
    &["luch-scene"],
    &["luch-formats", "luch-render", "luch-preview"],
    &["luch"],
    &["luch-lab"],
    &["luch-cli"],
];

/// Where an outside crate may be used; anything not named here may be used anywhere.
const ADDRESSES: [(&str, &[&str]); 11] = [
    ("rayon", &["luch-bvh", "luch-render", "luch-mesh", "luch-preview", "luch-lab"]),
    ("clap", &["luch-cli"]),
    ("ctrlc", &["luch-cli"]),
    ("png", &["luch-image"]),
    ("exr", &["luch-image"]),
    ("image", &["luch-image"]),
    ("earcut", &["luch-mesh"]),
    ("tempfile", &["luch-formats"]),
    ("tiny-skia", &["luch-lab"]),
    ("flate2", &["luch-formats", "luch-mesh"]),
    ("roxmltree", &["luch-formats", "luch-mesh"]),
];

/// Fails if any crate depends upward or sideways, or uses a library outside its address.
pub(crate) fn check(root: &Path) -> Result<(), String> {
    let crates = root.join("crates");
    let mut found = BTreeSet::new();
    let entries = std::fs::read_dir(&crates).map_err(|error| format!("{}: {error}", crates.display()))?;
    for entry in entries.flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let manifest = entry.path().join("Cargo.toml");
        let text =
            std::fs::read_to_string(&manifest).map_err(|error| format!("{}: {error}", manifest.display()))?;
        let rank = rank(&name).ok_or(format!("crate {name} has no place in the layers"))?;
        for dependency in dependencies(&text) {
            if let Some(below) = self::rank(&dependency)
                && below >= rank
            {
                return Err(format!("{name} depends on {dependency}, which does not stand below it"));
            }
            if let Some((_, homes)) = ADDRESSES.iter().find(|(library, _)| *library == dependency)
                && !homes.contains(&name.as_str())
            {
                return Err(format!("{name} uses {dependency}, whose place is {}", homes.join(", ")));
            }
        }
        found.insert(name);
    }
    let missing: Vec<_> = LAYERS.iter().copied().flatten().filter(|name| !found.contains(**name)).collect();
    if missing.is_empty() {
        println!("layers: {} crates, all depend downward", found.len());
        Ok(())
    } else {
        Err(format!("crates named in the layers are missing: {missing:?}"))
    }
}

fn rank(name: &str) -> Option<usize> {
    LAYERS.iter().position(|layer| layer.contains(&name))
}

/// Names under `[dependencies]` of a manifest; what tests use is free.
fn dependencies(manifest: &str) -> Vec<String> {
    let lines = manifest.lines().map(str::trim);
    let section =
        lines.skip_while(|line| *line != "[dependencies]").skip(1).take_while(|line| !line.starts_with('['));
    let name = |line: &str| line.split(['.', '=', ' ']).next().unwrap_or_default().to_owned();
    section.filter(|line| !line.is_empty() && !line.starts_with('#')).map(name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dependencies_are_read_from_their_section_alone() {
        let manifest = "[package]\nname = \"x\"\n[dependencies]\n# why\nglam.workspace = true\nexr = { version = \"1\" }\n\n[dev-dependencies]\nrayon.workspace = true\n";
        assert_eq!(dependencies(manifest), ["glam", "exr"]);
    }

    #[test]
    fn the_drawing_puts_leaves_below_engines() {
        assert!(rank("luch-bvh") < rank("luch-mesh"));
        assert!(rank("luch-scene") < rank("luch-render"));
        assert_eq!(rank("luch-formats"), rank("luch-render"));
        assert_eq!(rank("serde"), None);
    }
}
