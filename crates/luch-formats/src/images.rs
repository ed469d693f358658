//! Pictures that scenes refer to: each file is read once.

use crate::{Files, Warning};
use luch_image::codec::{self, Format};
use luch_image::{Bitmap, Pixels};
use luch_scene::{Id, Scene};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Most pixels that all pictures of a scene may have together.
const MOST_PIXELS: u64 = 1 << 29;

/// The pictures read so far.
pub(crate) struct Images<'a> {
    files: &'a Files,
    /// `None` for those that cannot be read: the warning is given once.
    known: BTreeMap<PathBuf, Option<Id<Bitmap>>>,
    pixels: u64,
}

impl<'a> Images<'a> {
    pub(crate) fn new(files: &'a Files) -> Self {
        Self { files, known: BTreeMap::new(), pixels: 0 }
    }

    /// The picture at `path`, added to `scene` if it is new; `None`, and one warning, if it cannot be had.
    pub(crate) fn load(
        &mut self,
        path: &Path,
        scene: &mut Scene,
        warnings: &mut Vec<Warning>,
    ) -> Option<Id<Bitmap>> {
        if let Some(&known) = self.known.get(path) {
            return known;
        }
        let id = match self.read(path, warnings) {
            Ok(image) => Some(scene.add_image(image)),
            Err(problem) => {
                warnings.push(problem.help("a neutral value takes the place of this picture"));
                None
            }
        };
        self.known.insert(path.to_owned(), id);
        id
    }

    fn read(&mut self, path: &Path, warnings: &mut Vec<Warning>) -> Result<Bitmap, Warning> {
        let bytes = self.files.read(path)?;
        // The content tells; TGA alone has no mark, so there the extension helps.
        let by_name = || path.extension().and_then(|e| e.to_str()).and_then(Format::from_extension);
        let format = Format::from_magic(&bytes).or_else(by_name);
        let mut image = codec::decode(&bytes, format)
            .map_err(|error| Warning::new(path, format!("is no picture: {error}")))?;
        self.pixels += u64::from(image.width) * u64::from(image.height);
        if self.pixels > MOST_PIXELS {
            return Err(Warning::new(
                path,
                format!("the pictures have more than {MOST_PIXELS} pixels together"),
            ));
        }
        let put_right = make_light(&mut image);
        if put_right > 0 {
            let message = format!("{put_right} numbers that are negative or not finite are taken as 0");
            warnings.push(Warning::new(path, message));
        }
        Ok(image)
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
