//! Land made by chance: hills, ridges, or midpoints displaced.

use glam::DVec2;
use serde::{Deserialize, Serialize};

use super::noise::{Noise, chance};
use super::{HeightError, HeightField, MAX_POINTS};

/// What the land is like.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Landform {
    /// Round hills: octaves of gradient noise added up (fractional Brownian motion).
    #[default]
    Hills,
    /// Sharp ridges with smooth valleys: octaves folded at zero, each weighed by the one before (Musgrave's ridged
    /// multifractal, "Texturing and Modeling", 1994).
    Ridges,
    /// Midpoints displaced at random, squares and diamonds in turn (Fournier, Fussell and Carpenter 1982; Miller 1986).
    Plasma,
}

/// A wish for land.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Terrain {
    /// What it is like.
    pub landform: Landform,
    /// Other numbers, other land.
    pub seed: u64,
    /// Points along x.
    pub columns: u32,
    /// Points along z.
    pub rows: u32,
    /// Length of the longer side, in metres.
    pub size: f32,
    /// Heights lie within minus and plus this, in metres; ridges between 0 and this.
    pub relief: f64,
    /// Hills or ridges along the longer side.
    pub features: f64,
    /// How many sizes of hills, each half as large as the one before; plasma has as many as its grid.
    pub octaves: u32,
    /// Height of each size as a part of that before: 0.5 is usual, 0 is smooth.
    pub roughness: f64,
}

impl Default for Terrain {
    fn default() -> Self {
        Self {
            landform: Landform::Hills,
            seed: 0,
            columns: 129,
            rows: 129,
            size: 1.0,
            relief: 0.2,
            features: 3.0,
            octaves: 8,
            roughness: 0.5,
        }
    }
}

/// Land by chance: the same wish gives the same land everywhere.
///
/// # Errors
/// If there are too few or too many points, or a number is out of range.
pub fn terrain(wish: &Terrain) -> Result<HeightField, HeightError> {
    let Terrain { columns, rows, relief, features, roughness, .. } = *wish;
    let within = |what, value: f64, least: f64, most: f64, expected| {
        if (least..=most).contains(&value) {
            Ok(())
        } else {
            Err(HeightError::Number { what, value, expected })
        }
    };
    within("the relief", relief, -1e18, 1e18, "a length up to 1e18")?;
    within("the number of features", features, 0.0, 1e6, "0 to 1e6")?;
    within("the roughness", roughness, 0.0, 1.0, "0 to 1")?;
    // Checks the counts before any work is done.
    if columns < 2 || rows < 2 || u64::from(columns) * u64::from(rows) > MAX_POINTS {
        return Err(HeightError::Size { width: columns, height: rows });
    }
    let heights = match wish.landform {
        Landform::Hills | Landform::Ridges => by_noise(wish),
        Landform::Plasma => plasma(wish)?,
    };
    let heights = heights.into_iter().map(|height| (height * relief) as f32).collect();
    HeightField::new(columns, rows, heights, HeightField::fitting_size(columns, rows, wish.size))
}

fn by_noise(wish: &Terrain) -> Vec<f64> {
    let noise = Noise::new(wish.seed);
    let longer = f64::from(wish.columns.max(wish.rows) - 1);
    // Past thirty octaves the cells are smaller than the rounding of places.
    let octaves = wish.octaves.clamp(1, 30);
    let mut heights = Vec::with_capacity(wish.columns as usize * wish.rows as usize);
    for row in 0..wish.rows {
        for column in 0..wish.columns {
            let mut place = DVec2::new(f64::from(column), f64::from(row)) * (wish.features / longer);
            let (mut sum, mut sizes, mut size, mut weight) = (0.0, 0.0, 1.0, 1.0);
            for _ in 0..octaves {
                let value = noise.at(place);
                sum += size
                    * match wish.landform {
                        Landform::Ridges => {
                            let fold = (1.0 - value.abs()) * (1.0 - value.abs()) * weight;
                            weight = (2.0 * fold).min(1.0);
                            fold
                        }
                        Landform::Hills | Landform::Plasma => value,
                    };
                sizes += size;
                size *= wish.roughness;
                // Off the grid of the octave before, so that their zeros do not meet.
                place = place * 2.0 + DVec2::new(17.3, 5.9);
            }
            heights.push(sum / sizes);
        }
    }
    heights
}

/// Heights from −1 to 1 on the smallest square grid of 2ᵏ + 1 points that holds the field.
fn plasma(wish: &Terrain) -> Result<Vec<f64>, HeightError> {
    let cells = (wish.columns.max(wish.rows) - 1).next_power_of_two() as usize;
    let side = cells + 1;
    if (side * side) as u64 > 4 * MAX_POINTS {
        return Err(HeightError::Size { width: side as u32, height: side as u32 });
    }
    let mut grid = vec![0.0f64; side * side];
    let random = |x: usize, y: usize| chance(wish.seed, x as u64, y as u64);
    for [x, y] in [[0, 0], [cells, 0], [0, cells], [cells, cells]] {
        grid[y * side + x] = random(x, y);
    }
    let (mut step, mut size) = (cells, wish.roughness);
    let mut most = 1.0;
    while step > 1 {
        let half = step / 2;
        // Middles of squares, then middles of their sides: those at the border have three neighbours.
        for y in (half..side).step_by(step) {
            for x in (half..side).step_by(step) {
                let around =
                    [[x - half, y - half], [x + half, y - half], [x - half, y + half], [x + half, y + half]];
                let mean = around.iter().map(|[x, y]| grid[y * side + x]).sum::<f64>() / 4.0;
                grid[y * side + x] = mean + size * random(x, y);
            }
        }
        for y in (0..side).step_by(half) {
            let start = if (y / half).is_multiple_of(2) { half } else { 0 };
            for x in (start..side).step_by(step) {
                let around = [
                    (x >= half).then(|| y * side + x - half),
                    (x + half < side).then(|| y * side + x + half),
                    (y >= half).then(|| (y - half) * side + x),
                    (y + half < side).then(|| (y + half) * side + x),
                ];
                let known = around.iter().flatten();
                let mean = known.clone().map(|&k| grid[k]).sum::<f64>() / known.count() as f64;
                grid[y * side + x] = mean + size * random(x, y);
            }
        }
        most += 2.0 * size;
        size *= wish.roughness;
        step = half;
    }
    let rows = (0..wish.rows as usize).map(|row| &grid[row * side..row * side + wish.columns as usize]);
    Ok(rows.flatten().map(|height| height / most).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn land_depends_on_its_seed_and_stays_within_its_relief() {
        for landform in [Landform::Hills, Landform::Ridges, Landform::Plasma] {
            let wish = Terrain { landform, columns: 70, rows: 40, relief: 3.0, ..Terrain::default() };
            let land = terrain(&wish).unwrap();
            assert_eq!((land.width, land.height, land.size.x), (70, 40, 1.0));
            let [low, high] = land.range().unwrap();
            assert!(low >= -3.0 && high <= 3.0 && high - low > 0.3, "{landform:?} {low} {high}");
            assert!(landform != Landform::Ridges || low >= 0.0);
            assert_eq!(land, terrain(&wish).unwrap());
            assert_ne!(land.heights, terrain(&Terrain { seed: 1, ..wish }).unwrap().heights);
            // Rough land is rougher than smooth land: mean step between neighbours against the range.
            let roughness = |roughness: f64| {
                let land = terrain(&Terrain { roughness, ..wish }).unwrap();
                let steps: f32 = land.heights.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
                steps / land.range().map(|[low, high]| high - low).unwrap()
            };
            assert!(roughness(0.8) > 1.5 * roughness(0.3), "{landform:?}");
        }
    }

    #[test]
    fn senseless_wishes_are_refused() {
        let wish = Terrain::default();
        for bad in [
            Terrain { columns: 1, ..wish },
            Terrain { rows: u32::MAX, ..wish },
            Terrain { columns: 1 << 24, rows: 2, landform: Landform::Plasma, ..wish },
            Terrain { relief: f64::NAN, ..wish },
            Terrain { features: f64::INFINITY, ..wish },
            Terrain { roughness: -0.1, ..wish },
            Terrain { size: 0.0, ..wish },
        ] {
            assert!(terrain(&bad).is_err(), "{bad:?}");
        }
        assert!(terrain(&Terrain { octaves: u32::MAX, columns: 3, rows: 3, ..wish }).is_ok());
    }
}
