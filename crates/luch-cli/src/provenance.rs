//! Where a picture comes from, in words that travel with it.
//!
//! | key | text |
//! |---|---|
//! | `luch:scene` | the scene file as it was named |
//! | `luch:fingerprint` | digest of scene, camera and settings, 64 hexadecimal digits |
//! | `luch:samples` | sample indices of every pixel, `0..64`; if tiles differ, `0..64 *12; 0..68 *3` in the order of the tiles |
//! | `luch:options` | everything that shapes samples and display, as JSON |
//! | `luch:version` | version of the program |
//! | `luch:command` | the command that was given |
//! | `luch:digest` | hash of the bits of the light itself, 32 hexadecimal digits |

use crate::failure::Failure;
use crate::film_file;
use crate::recipe::Recipe;
use luch::formats::Files;
use luch::image::codec::{self, Metadata};
use luch::image::{Image, Rgb};
use luch::render::{Checkpoint, Film, Fingerprint, Provenance, Ranges, TILE};
use luch::sampling::hash;
use std::path::Path;

/// The texts for a picture of `film`.
pub(crate) fn metadata(provenance: &Provenance, fingerprint: &Fingerprint, film: &Film) -> Metadata {
    Metadata::from([
        ("luch:scene", provenance.source.clone()),
        ("luch:fingerprint", fingerprint.to_hex()),
        ("luch:samples", samples_text(film)),
        ("luch:options", provenance.options.clone()),
        ("luch:version", provenance.version.clone()),
        ("luch:command", provenance.command.clone()),
        ("luch:digest", digest(&film.to_image())),
    ])
}

/// A hash of the bits of every channel, row by row: two lanes of 64 bits with different beginnings.
///
/// It tells accidents apart, not forgeries.
pub(crate) fn digest(image: &Image<Rgb>) -> String {
    let mut lanes = [hash::GOLDEN, hash::mix64(hash::GOLDEN)];
    let size = u64::from(image.width()) << 32 | u64::from(image.height());
    let channels = image.pixels().iter().flat_map(|pixel| pixel.to_array()).map(|v| u64::from(v.to_bits()));
    for word in std::iter::once(size).chain(channels) {
        lanes = lanes.map(|lane| hash::combine(lane, word));
    }
    let [a, b] = lanes;
    format!("{a:016x}{b:016x}")
}

/// A set of samples and for how many tiles, in the order of the tiles, it holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct TileRun {
    pub(crate) samples: Ranges,
    pub(crate) tiles: usize,
}

/// Which samples the tiles of a film hold, neighbours with equal sets taken together.
///
/// A film tells each pixel's number of samples; `None` if two different sets have the same number, as only merged films with gaps
/// can have.
pub(crate) fn tile_runs(film: &Film) -> Option<Vec<TileRun>> {
    let sets = film.coverage();
    let counts = film.read(|_, count| count);
    let mut runs: Vec<TileRun> = Vec::new();
    for y in (0..film.height()).step_by(TILE as usize) {
        for x in (0..film.width()).step_by(TILE as usize) {
            let mut fitting = sets.iter().filter(|set| set.samples.count() == *counts.get(x, y));
            let (Some(set), None) = (fitting.next(), fitting.next()) else { return None };
            match runs.last_mut() {
                Some(run) if run.samples == set.samples => run.tiles += 1,
                _ => runs.push(TileRun { samples: set.samples.clone(), tiles: 1 }),
            }
        }
    }
    Some(runs)
}

fn samples_text(film: &Film) -> String {
    match tile_runs(film).as_deref() {
        None => "uneven".to_owned(),
        Some([run]) => run.samples.to_string(),
        Some(runs) => {
            let words: Vec<String> =
                runs.iter().map(|run| format!("{} *{}", run.samples, run.tiles)).collect();
            words.join("; ")
        }
    }
}

/// The sets of samples that [`samples_text`] wrote, for a picture of `tiles` tiles.
fn read_samples(text: &str, tiles: usize) -> Option<Vec<TileRun>> {
    let ranges = |text: &str| {
        let mut ranges = Ranges::default();
        for range in text.split(',').filter(|range| !range.trim().is_empty()) {
            ranges.insert(crate::parse::samples(range.trim()).ok()?);
        }
        Some(ranges)
    };
    let mut runs = Vec::new();
    let mut left = tiles;
    for word in text.split(';') {
        let run = match word.split_once('*') {
            Some((samples, count)) => {
                TileRun { samples: ranges(samples)?, tiles: count.trim().parse().ok()? }
            }
            None => TileRun { samples: ranges(word)?, tiles },
        };
        left = left.checked_sub(run.tiles)?;
        runs.push(run);
    }
    (left == 0).then_some(runs)
}

/// What a picture or film says of itself.
pub(crate) struct Claim {
    pub(crate) scene: String,
    pub(crate) fingerprint: String,
    pub(crate) samples: Vec<TileRun>,
    pub(crate) recipe: Recipe,
    pub(crate) version: String,
    pub(crate) digest: String,
}

impl Claim {
    /// Reads it from a picture's texts or a film.
    pub(crate) fn read(path: &Path) -> Result<Self, Failure> {
        let texts = if film_file::is_film(path) {
            let Checkpoint { fingerprint, provenance, film } = film_file::read(path)?;
            metadata(&provenance, &fingerprint, &film)
        } else {
            let bytes = Files::disk().read(path).map_err(|problem| Failure::new(problem.to_string()))?;
            codec::read_metadata(&bytes)
                .map_err(|error| Failure::new(format!("{}: {error}", path.display())))?
        };
        let text = |key: &str| {
            texts.get(key).map(str::to_owned).ok_or_else(|| {
                let file = path.display();
                Failure::new(format!("{file}: does not say where it comes from: the text `{key}` is missing"))
            })
        };
        let recipe = Recipe::from_json(&text("luch:options")?)?;
        let settings = recipe.settings()?;
        let tiles = settings.width.div_ceil(TILE) as usize * settings.height.div_ceil(TILE) as usize;
        let samples = text("luch:samples")?;
        let samples = read_samples(&samples, tiles).ok_or_else(|| {
            let file = path.display();
            Failure::new(format!(
                "{file}: `luch:samples` does not say which samples each tile holds: `{samples}`"
            ))
        })?;
        Ok(Self {
            scene: text("luch:scene")?,
            fingerprint: text("luch:fingerprint")?,
            samples,
            recipe,
            version: text("luch:version")?,
            digest: text("luch:digest")?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_digest_sees_every_bit_and_place() {
        let image = |values: [f32; 2]| Image::from_pixels(2, 1, values.map(Rgb::gray).to_vec()).unwrap();
        let base = digest(&image([0.25, 0.5]));
        assert_eq!(base.len(), 32);
        assert_eq!(base, digest(&image([0.25, 0.5])));
        for other in [[0.5, 0.25], [0.25, 0.500_000_06], [-0.25, 0.5]] {
            assert_ne!(base, digest(&image(other)));
        }
        let tall = Image::from_pixels(1, 2, [0.25, 0.5].map(Rgb::gray).to_vec()).unwrap();
        assert_ne!(base, digest(&tall));
    }

    #[test]
    fn sets_of_samples_survive_their_text() {
        let mut gapped = Ranges::default();
        gapped.insert(0..4);
        gapped.insert(8..9);
        let runs = read_samples("0..4, 8..9 *2;  *1; 0..4 *3", 6).unwrap();
        assert_eq!(runs[0], TileRun { samples: gapped, tiles: 2 });
        assert!(runs[1].samples.is_empty());
        assert_eq!(read_samples("0..64", 9).unwrap()[0].tiles, 9);
        for text in ["uneven", "0..4 *5", "0..4 *7", "4..0", "0..4 *x", "0..4 *99999999999999999999"] {
            assert!(read_samples(text, 6).is_none(), "{text}");
        }
    }
}
