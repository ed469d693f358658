//! What a picture is a picture of, in 32 bytes.

use luch_scene::{Camera, Scene};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::io;

/// Raised whenever the same scene and settings would give other samples than before.
const GENERATION: u32 = 2;

/// A digest (BLAKE3) of everything that samples depend on: scene, camera, settings, and the generation of the algorithms.
/// Films of equal fingerprints may be merged. Names and things that nobody uses count as well: it never errs to the careless side.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Fingerprint([u8; 32]);

impl Fingerprint {
    /// The fingerprint of what `camera` sees of `scene` under the scene's settings.
    pub fn of(scene: &Scene, camera: &Camera) -> Self {
        let Scene { shapes, materials, textures, images, instances, lights, environment, cameras, settings } =
            scene;
        let mut writer = HashWriter(blake3::Hasher::new());
        // Other cameras matter only where faces are culled by where cameras are.
        let cameras = if settings.cull_back_faces { cameras.as_slice() } else { &[] };
        let things = (GENERATION, shapes, materials, textures, images, instances, lights, environment);
        let eyes = (cameras, camera, settings);
        let written = postcard::to_io(&things, &mut writer).and_then(|w| postcard::to_io(&eyes, w)).is_ok();
        assert!(written, "plain data is always written to a hash");
        Self(*writer.0.finalize().as_bytes())
    }

    /// Sixty-four hexadecimal digits.
    pub fn to_hex(&self) -> String {
        self.0.iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

impl fmt::Debug for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", &self.to_hex()[..16])
    }
}

impl fmt::Display for Fingerprint {
    /// The first sixteen digits: enough to tell two apart by eye.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", &self.to_hex()[..16])
    }
}

struct HashWriter(blake3::Hasher);

impl io::Write for HashWriter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
