//! A folder of its own and the command in it.

use luch::render::Checkpoint;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// A small scene with a lamp, a wall and a ball: every kind of light path, and quick.
pub(crate) const SCENE: &str = r#"luch 1
settings { size 48 40; samples 4; integrator "path" max-depth=6 }
camera "front" { from 0 1 4; to 0 0.6 0; fov 40 }
camera "side" { from 4 1 0; to 0 0.6 0; fov 40 }
material "clay" { diffuse 0.8 0.5 0.3 }
material "lamp" { emission 9 8 7 }
object "floor" material="clay" { mesh { plane size=6 } }
object "ball" material="clay" { sphere radius=0.5; translate 0 0.5 0 }
object "lamp" material="lamp" { mesh { plane size=1 }; rotate-x 180; translate 0 2.5 0 }
environment 0.1
"#;

pub(crate) struct Workplace {
    folder: TempDir,
}

impl Workplace {
    /// An empty folder.
    pub(crate) fn empty() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    /// A folder with [`SCENE`] as `scene.kdl`.
    pub(crate) fn new() -> Self {
        let place = Self::empty();
        place.write("scene.kdl", SCENE);
        place
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).unwrap();
    }

    /// Names of all files, sorted.
    pub(crate) fn files(&self) -> Vec<String> {
        let names = std::fs::read_dir(self.folder.path()).unwrap();
        let mut names: Vec<String> =
            names.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    fn command(&self, line: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_luch"));
        command.current_dir(self.folder.path()).args(line.split_whitespace()).stdin(Stdio::null());
        command
    }

    pub(crate) fn run(&self, line: &str) -> Said {
        Said::of(self.command(line).output().unwrap())
    }

    /// Runs the command, which must succeed.
    pub(crate) fn done(&self, line: &str) -> Said {
        let said = self.run(line);
        assert_eq!(said.code, Some(0), "luch {line}\n{}{}", said.out, said.err);
        said
    }

    /// Runs the command, which must fail with `code` and say so plainly.
    pub(crate) fn fails(&self, line: &str, code: i32) -> Said {
        let said = self.run(line);
        assert_eq!(said.code, Some(code), "luch {line}\n{}{}", said.out, said.err);
        assert!(said.err.starts_with("error: "), "luch {line}\n{}", said.err);
        said
    }

    pub(crate) fn start(&self, line: &str) -> Child {
        self.command(line).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
    }

    /// Waits until a file is there.
    pub(crate) fn await_file(&self, name: &str) {
        let patience = Instant::now() + Duration::from_secs(20);
        while !self.path(name).exists() {
            assert!(Instant::now() < patience, "{name} does not appear");
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    /// The film in a file: its sums and what samples they are of.
    pub(crate) fn film(&self, name: &str) -> luch::render::Film {
        Checkpoint::decode(&self.bytes(name)).unwrap().film
    }

    pub(crate) fn bytes(&self, name: impl AsRef<Path>) -> Vec<u8> {
        std::fs::read(self.folder.path().join(name)).unwrap()
    }
}

/// What a command left behind.
pub(crate) struct Said {
    pub(crate) code: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
}

impl Said {
    pub(crate) fn of(output: Output) -> Self {
        let text = |bytes| String::from_utf8(bytes).unwrap();
        Self { code: output.status.code(), out: text(output.stdout), err: text(output.stderr) }
    }
}

/// Sends a signal by name.
pub(crate) fn signal(child: &Child, name: &str) {
    let sent = Command::new("kill").arg(format!("-{name}")).arg(child.id().to_string()).status().unwrap();
    assert!(sent.success());
}
