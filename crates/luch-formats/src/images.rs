//! Pictures that scenes refer to: each file is read once, by whatever files and spellings of its path it is referred to.

use crate::{Files, Problem, Warning};
use luch_image::codec::{self, Format};
use luch_image::{Bitmap, Pixels};
use luch_scene::{Id, Scene};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;

/// Most pixels that all pictures of a scene may have together; 4 GiB with 8 bits a channel.
pub(crate) const MOST_PIXELS: u64 = 1 << 30;

/// The pictures that a scene and all that it imports have read so far; clones are the same store.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pictures(Rc<RefCell<Store>>);

#[derive(Debug, Default)]
struct Store {
    /// By what [`Files::identity`] says.
    known: BTreeMap<PathBuf, Result<Arc<Bitmap>, Problem>>,
    pixels: u64,
}

/// The pictures of one scene.
#[derive(Debug)]
pub(crate) struct Images<'a> {
    files: &'a Files,
    pictures: Pictures,
    known: BTreeMap<PathBuf, Id<Bitmap>>,
}

impl<'a> Images<'a> {
    /// No pictures of this scene yet; `pictures` are those of all scenes.
    pub(crate) fn new(files: &'a Files, pictures: Pictures) -> Self {
        Self { files, pictures, known: BTreeMap::new() }
    }

    /// The picture at `path`, added to `scene` if it is new; `None`, and one warning, if it cannot be had.
    pub(crate) fn load(
        &mut self,
        path: &Path,
        scene: &mut Scene,
        warnings: &mut Vec<Warning>,
    ) -> Option<Id<Bitmap>> {
        let is_new = !self.pictures.0.borrow().known.contains_key(&self.files.identity(path));
        match self.find(path, scene, warnings) {
            Ok(id) => Some(id),
            Err(problem) => {
                if is_new {
                    warnings.push(problem.help("a neutral value takes the place of this picture"));
                }
                None
            }
        }
    }

    /// The picture at `path`, added to `scene` if it is new; the same problem every time if it cannot be had.
    pub(crate) fn find(
        &mut self,
        path: &Path,
        scene: &mut Scene,
        warnings: &mut Vec<Warning>,
    ) -> Result<Id<Bitmap>, Problem> {
        let identity = self.files.identity(path);
        if let Some(&known) = self.known.get(&identity) {
            return Ok(known);
        }
        let before = self.pictures.0.borrow().known.get(&identity).cloned();
        let picture = before.unwrap_or_else(|| {
            let read = self.read(path, warnings);
            self.pictures.0.borrow_mut().known.insert(identity.clone(), read.clone());
            read
        })?;
        let id = scene.add_image(picture);
        self.known.insert(identity, id);
        Ok(id)
    }

    /// The picture in some bytes; `warn` hears what was put right in it.
    pub(crate) fn decode(
        &self,
        bytes: &[u8],
        format: Option<Format>,
        warn: impl FnOnce(String),
    ) -> Result<Arc<Bitmap>, String> {
        let mut image = codec::decode(bytes, format).map_err(|error| error.to_string())?;
        let mut store = self.pictures.0.borrow_mut();
        let pixels = store.pixels + u64::from(image.width) * u64::from(image.height);
        if pixels > MOST_PIXELS {
            return Err(format!("the pictures have more than {MOST_PIXELS} pixels together"));
        }
        store.pixels = pixels;
        let put_right = make_light(&mut image);
        if put_right > 0 {
            warn(format!("{put_right} numbers that are negative or not finite are taken as 0"));
        }
        Ok(Arc::new(image))
    }

    fn read(&self, path: &Path, warnings: &mut Vec<Warning>) -> Result<Arc<Bitmap>, Problem> {
        let bytes = self.files.read(path)?;
        // The content tells; TGA alone has no mark, so there the extension helps.
        let by_name = || path.extension().and_then(|e| e.to_str()).and_then(Format::from_extension);
        let format = Format::from_magic(&bytes).or_else(by_name);
        let warn = |message| warnings.push(Warning::new(path, message));
        self.decode(&bytes, format, warn)
            .map_err(|reason| Problem::new(path, format!("is no picture: {reason}")))
    }
}

/// Takes numbers that no light has for 0, and says how many there were.
fn make_light(image: &mut Bitmap) -> usize {
    let Pixels::F32(pixels) = &mut image.pixels else { return 0 };
    let mut count = 0;
    for number in pixels.as_flattened_mut() {
        if !(number.is_finite() && *number >= 0.0) {
            *number = 0.0;
            count += 1;
        }
    }
    count
}
