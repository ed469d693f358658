//! Noise at many points: one corner of the cells at a time, so that the loops stay short enough to become vector code.

use super::bulk::{LANES, Register};
use crate::noise::{Axis, Noise, corner};

/// The numbers of all lanes along one axis.
struct Axes {
    low: [u32; LANES],
    t: Register,
    weight: Register,
    slope: Register,
}

impl Axes {
    #[inline(always)]
    fn new(coordinates: &Register, lanes: usize) -> Self {
        let zero = [0.0; LANES];
        let mut axes = Self { low: [0; LANES], t: zero, weight: zero, slope: zero };
        for (lane, &coordinate) in coordinates[..lanes].iter().enumerate() {
            let axis = Axis::new(coordinate);
            axes.low[lane] = axis.low;
            axes.t[lane] = axis.t;
            axes.weight[lane] = axis.weight;
            axes.slope[lane] = axis.slope;
        }
        axes
    }

    #[inline(always)]
    fn at(&self, lane: usize) -> Axis {
        Axis { low: self.low[lane], t: self.t[lane], weight: self.weight[lane], slope: self.slope[lane] }
    }
}

/// Hands over every lane's part of one corner.
#[inline(always)]
fn each_lane<const NUMBER: u32>(axes: &[Axes; 3], lanes: usize, mut take: impl FnMut(usize, Noise)) {
    let [x, y, z] = axes;
    for lane in 0..lanes {
        take(lane, corner::<NUMBER>(x.at(lane), y.at(lane), z.at(lane)));
    }
}

/// The values of noise.
#[inline(always)]
pub(super) fn noise_values(place: [&Register; 3], out: &mut [f64]) {
    let lanes = out.len();
    let axes = place.map(|coordinates| Axes::new(coordinates, lanes));
    each_lane::<0>(&axes, lanes, |lane, part| out[lane] = part.value);
    each_lane::<1>(&axes, lanes, |lane, part| out[lane] += part.value);
    each_lane::<2>(&axes, lanes, |lane, part| out[lane] += part.value);
    each_lane::<3>(&axes, lanes, |lane, part| out[lane] += part.value);
    each_lane::<4>(&axes, lanes, |lane, part| out[lane] += part.value);
    each_lane::<5>(&axes, lanes, |lane, part| out[lane] += part.value);
    each_lane::<6>(&axes, lanes, |lane, part| out[lane] += part.value);
    each_lane::<7>(&axes, lanes, |lane, part| out[lane] += part.value);
}

/// The derivatives of noise.
#[inline(always)]
pub(super) fn noise_slopes(place: [&Register; 3], out: [&mut [f64]; 3]) {
    let [first, second, third] = out;
    let lanes = first.len();
    let axes = place.map(|coordinates| Axes::new(coordinates, lanes));
    each_lane::<0>(&axes, lanes, |lane, part| {
        [first[lane], second[lane], third[lane]] = part.gradient;
    });
    let mut add = |lane: usize, part: Noise| {
        first[lane] += part.gradient[0];
        second[lane] += part.gradient[1];
        third[lane] += part.gradient[2];
    };
    each_lane::<1>(&axes, lanes, &mut add);
    each_lane::<2>(&axes, lanes, &mut add);
    each_lane::<3>(&axes, lanes, &mut add);
    each_lane::<4>(&axes, lanes, &mut add);
    each_lane::<5>(&axes, lanes, &mut add);
    each_lane::<6>(&axes, lanes, &mut add);
    each_lane::<7>(&axes, lanes, &mut add);
}
