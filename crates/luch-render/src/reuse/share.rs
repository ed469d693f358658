//! Hands out what second points send, for all lanes at once.

use super::glint::Gleam;
use super::points::{LANES, NONE, directions_to};
use super::scatterers::Scattered;
use super::{Bundle, Table};
use luch_bvh::simd::Task;
use luch_image::Rgb;

/// Adds to the radiance of each lane what comes from all second points, by the weights of the table.
pub(super) struct Share<'a> {
    pub(super) bundle: &'a Bundle,
    pub(super) table: &'a Table,
    pub(super) radiance: &'a mut [Rgb],
}

impl Task for Share<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { bundle, table, radiance } = self;
        let firsts = &bundle.firsts;
        let mut sums = NONE;
        if firsts.is_diffuse() && bundle.glints.is_empty() {
            // Value over density is the colour, whatever the direction.
            for (row, tail) in table.iter().zip(&bundle.tails) {
                for (sum, tail) in sums.iter_mut().zip(tail.to_array()) {
                    for k in 0..LANES {
                        sum[k] += row[k] * tail;
                    }
                }
            }
            for (sum, color) in sums.iter_mut().zip(firsts.color()) {
                for k in 0..LANES {
                    sum[k] *= color[k];
                }
            }
        } else {
            let mut scattered = Scattered::default();
            for (j, (row, tail)) in table.iter().zip(&bundle.tails).enumerate() {
                if !bundle.sends(j) {
                    continue;
                }
                let (toward, _) = directions_to(&firsts.points, bundle.seconds.position(j));
                firsts.evaluate(&toward, |k| row[k] > 0.0, &mut scattered);
                let mut sent = NONE;
                for (sent, tail) in sent.iter_mut().zip(tail.to_array()) {
                    for k in 0..LANES {
                        sent[k] = row[k] * tail;
                    }
                }
                if let Some(glint) = bundle.glints.iter().find(|glint| glint.lane == j) {
                    Gleam { glint, toward: &toward, weights: row, sums: &mut sent }.run();
                }
                for channel in 0..3 {
                    for k in 0..LANES {
                        let part = sent[channel][k] * scattered.value[channel][k] / scattered.pdf[k];
                        sums[channel][k] += if scattered.pdf[k] > 0.0 { part } else { 0.0 };
                    }
                }
            }
        }
        for (k, gain) in bundle.gains.iter().enumerate() {
            if firsts.points.is_set(k) {
                radiance[k] += *gain * Rgb::new(sums[0][k], sums[1][k], sums[2][k]);
            }
        }
    }
}
