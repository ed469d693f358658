//! Rays beside Embree's: both trace the very same files of rays, in turn.

use super::table::{Speeds, markdown};
use super::{Options, command, lock, output};
use serde_json::Value;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

const SETS: &str = "primary,diffuse,shuffled,shadow";
const NAMES: [&str; 9] =
    ["ebench", "library", "meshes", "rays", "only", "rounds", "quality", "threads", "repeat"];

/// Who is measured, and how.
struct Bench {
    ebench: PathBuf,
    library: PathBuf,
    luch: PathBuf,
    meshes: PathBuf,
    rays: PathBuf,
    quality: String,
    threads: String,
    repeat: String,
}

pub(super) fn measure(root: &Path, words: &[OsString]) -> Result<(), String> {
    let options = Options::read(words, &NAMES)?;
    if let Some(word) = options.rest.first() {
        return Err(format!("{}: no such option\n{}", word.display(), super::USAGE));
    }
    let bench = Bench {
        ebench: options.path("ebench")?,
        library: options.path("library")?,
        luch: command(root)?,
        meshes: options.path("meshes")?,
        rays: options.path("rays")?,
        quality: options.text("quality", "balanced,best")?.to_owned(),
        threads: options.text("threads", "1")?.to_owned(),
        repeat: options.text("repeat", "3")?.to_owned(),
    };
    let rounds: u32 = options
        .text("rounds", "5")?
        .parse()
        .map_err(|_| "--rounds: accepted are whole numbers, such as 5".to_owned())?;
    let names = match options.text("only", "")? {
        "" => bench.names()?,
        only => only.split(',').map(str::to_owned).collect(),
    };
    let mut speeds = Speeds::default();
    for round in 0..rounds {
        for name in &names {
            let _held = lock()?;
            bench.embree(name, &mut speeds)?;
            bench.luch(name, &mut speeds)?;
            eprintln!("round {round}: {name}");
        }
        speeds.end_round();
    }
    println!("{}", markdown(&speeds));
    Ok(())
}

impl Bench {
    /// All meshes that have rays.
    fn names(&self) -> Result<Vec<String>, String> {
        let entries =
            std::fs::read_dir(&self.meshes).map_err(|error| format!("{}: {error}", self.meshes.display()))?;
        let mut names: Vec<String> = entries
            .flatten()
            .filter_map(|entry| entry.file_name().to_str()?.strip_suffix(".tri").map(str::to_owned))
            .filter(|name| self.rays.join(format!("{name}.primary.rays")).exists())
            .collect();
        names.sort();
        Ok(names)
    }

    fn embree(&self, name: &str, speeds: &mut Speeds) -> Result<(), String> {
        let mut command = Command::new(&self.ebench);
        command.arg("bench").arg(&self.library).arg(self.mesh(name)).arg(self.rays.join(name));
        command.args(["--quality", "medium", "--flags", "robust", "--width", "1,16", "--sets", SETS]);
        command.args(["--threads", &self.threads, "--repeat", &self.repeat]);
        for line in output(&mut command)?.lines() {
            // trace version config mesh quality flags set width threads by-processor …
            let words: Vec<&str> = line.split('\t').collect();
            let ["trace", _, _, _, _, _, set, width, threads, speed, ..] = words[..] else { continue };
            let speed = speed.parse().map_err(|_| format!("ebench: {line}"))?;
            speeds.add(name, set, &format!("Embree {width} {threads}"), speed);
        }
        Ok(())
    }

    fn luch(&self, name: &str, speeds: &mut Speeds) -> Result<(), String> {
        let mut command = Command::new(&self.luch);
        command.args(["bench", "rays"]).arg(self.mesh(name)).arg("--rays").arg(self.rays.join(name));
        command.args(["--quality", &self.quality, "--threads", &self.threads, "--repeat", &self.repeat]);
        command.args(["--kernel", "batch,single", "--json"]);
        for line in output(&mut command)?.lines() {
            let row: Value = serde_json::from_str(line).map_err(|error| format!("{line}: {error}"))?;
            let text = |key: &str| row[key].as_str().unwrap_or_default();
            if text("event") != "trace" {
                continue;
            }
            let mut measured: Vec<f64> = row["mrays_by_processor"]
                .as_array()
                .into_iter()
                .flatten()
                .filter_map(Value::as_f64)
                .collect();
            measured.sort_by(f64::total_cmp);
            let speed = *measured.get(measured.len() / 2).ok_or("luch tells no processor time here")?;
            let who = format!("{} {} t{}", text("quality"), text("kernel"), row["threads"]);
            speeds.add(name, text("set"), &who, speed);
        }
        Ok(())
    }

    fn mesh(&self, name: &str) -> PathBuf {
        self.meshes.join(format!("{name}.tri"))
    }
}
