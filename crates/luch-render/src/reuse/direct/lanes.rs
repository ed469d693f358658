//! Sixteen standpoints weigh a candidate side by side.
//!
//! Only diffuse surfaces and metals whose light bounces once: with GGX facets that are alike in all directions around the normal,
//! cosines are all that counts, and no frame is needed.

use super::super::LANES;
use super::Standpoint;
use crate::bsdf::{Bsdf, conductor_reflectance};
use crate::lights::Shone;
use glam::Vec3;
use luch_bvh::simd::Task;
use std::f32::consts::FRAC_1_PI;

type Lanes = [f32; LANES];
type Vectors = [Lanes; 3];

const NONE: Vectors = [[0.0; LANES]; 3];

/// Standpoints side by side; `[axis][lane]`.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(super) struct Group {
    position: Vectors,
    normal: Vectors,
    geometric_normal: Vectors,
    outgoing: Vectors,
    lifted: Lanes,
    /// Diffuse: throughput times albedo. Metal: throughput.
    gain: Vectors,
    /// Width of the facets' distribution; 0 for diffuse surfaces.
    alpha: Lanes,
    eta: Vectors,
    k: Vectors,
    any_metal: bool,
}

/// What candidates bring, `[candidate]`, for all lanes.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(super) struct Bringing {
    pub(super) light: Vectors,
    pub(super) weight: Lanes,
}

impl Group {
    /// `None` if one of them is made of something else.
    pub(super) fn new(standpoints: &[Standpoint]) -> Option<Self> {
        let mut group = Self {
            position: NONE,
            normal: NONE,
            geometric_normal: NONE,
            outgoing: NONE,
            lifted: [0.0; LANES],
            gain: NONE,
            alpha: [0.0; LANES],
            eta: [[1.0; LANES]; 3],
            k: [[1.0; LANES]; 3],
            any_metal: false,
        };
        for (lane, standpoint) in standpoints.iter().enumerate() {
            let exit = &standpoint.exit;
            let gain = match &standpoint.bsdf {
                Bsdf::Diffuse(diffuse) => standpoint.throughput * diffuse.color(),
                Bsdf::Conductor(metal) => {
                    let (alpha, eta, k) = metal.single_bounce()?;
                    group.alpha[lane] = alpha;
                    for channel in 0..3 {
                        group.eta[channel][lane] = eta.to_array()[channel];
                        group.k[channel][lane] = k.to_array()[channel];
                    }
                    group.any_metal = true;
                    standpoint.throughput
                }
                _ => return None,
            };
            for axis in 0..3 {
                group.position[axis][lane] = exit.position[axis];
                group.normal[axis][lane] = exit.normal[axis];
                group.geometric_normal[axis][lane] = exit.geometric_normal[axis];
                group.outgoing[axis][lane] = standpoint.toward_viewer[axis];
                group.gain[axis][lane] = gain.to_array()[axis];
            }
            group.lifted[lane] = f32::from(u8::from(exit.lifted));
        }
        Some(group)
    }
}

/// Weighs one candidate for all lanes.
pub(super) struct Weigh<'a> {
    pub(super) group: &'a Group,
    pub(super) shone: &'a Shone,
    /// With which chance each standpoint would choose the emitter, times the number of standpoints.
    pub(super) own: &'a Lanes,
    /// How often all together would.
    pub(super) all: f32,
    pub(super) bringing: &'a mut Bringing,
}

impl Task for Weigh<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { group: g, shone, own, all, bringing } = self;
        let far = shone.pdf_area == 0.0;
        let mut pdf = [0.0; LANES];
        let mut seen = [0.0; LANES];
        let mut toward = NONE;
        for l in 0..LANES {
            // A point is reached along a way; what is infinitely far lies in a direction.
            let way = match far {
                true => shone.place,
                false => shone.place - Vec3::new(g.position[0][l], g.position[1][l], g.position[2][l]),
            };
            let squared = way.dot(way);
            let inverse = 1.0 / squared.sqrt();
            let direction = way * inverse;
            let cosine = -direction.dot(shone.normal);
            let facing = if shone.two_sided { cosine.abs() } else { cosine };
            let by_area = squared * shone.pdf_area / facing;
            pdf[l] = if far { shone.pdf } else { by_area };
            let honest = (dot(&g.geometric_normal, l, direction) > 0.0) | (g.lifted[l] > 0.0);
            let usable = (pdf[l] > 0.0) & (pdf[l] < f32::INFINITY) & (far | (facing > 0.0)) & honest;
            seen[l] = if usable { 1.0 } else { 0.0 };
            for axis in 0..3 {
                toward[axis][l] = direction[axis];
            }
        }
        // Diffuse first; metals replace it.
        let mut value = NONE;
        let mut scattering = [0.0; LANES];
        for l in 0..LANES {
            let direction = Vec3::new(toward[0][l], toward[1][l], toward[2][l]);
            let cosine = dot(&g.normal, l, direction).max(0.0);
            scattering[l] = cosine * FRAC_1_PI;
            for channel in value.iter_mut() {
                channel[l] = scattering[l];
            }
        }
        if g.any_metal {
            for l in 0..LANES {
                let incoming = Vec3::new(toward[0][l], toward[1][l], toward[2][l]);
                let outgoing = Vec3::new(g.outgoing[0][l], g.outgoing[1][l], g.outgoing[2][l]);
                let normal = Vec3::new(g.normal[0][l], g.normal[1][l], g.normal[2][l]);
                let (cos_in, cos_out) = (incoming.dot(normal), outgoing.dot(normal));
                let half = incoming + outgoing;
                let half = half * (1.0 / half.dot(half).sqrt());
                let alpha2 = g.alpha[l] * g.alpha[l];
                let cos_half = half.dot(normal);
                // sin² by the cross product: 1 − cos² has no digits left for small alpha.
                let across = half.cross(normal);
                let stretched = alpha2 * cos_half * cos_half + across.dot(across);
                let density = FRAC_1_PI * alpha2 / (stretched * stretched);
                let length = |cosine: f32| {
                    let sine2 = 1.0 - cosine * cosine;
                    (cosine * cosine + alpha2 * sine2.max(0.0)).sqrt()
                };
                let (length_in, length_out) = (length(cos_in), length(cos_out));
                let visibility = 2.0 / (cos_in * length_out + cos_out * length_in);
                let single = 0.25 * density * visibility * cos_in;
                let is_metal = g.alpha[l] > 0.0;
                let above = (cos_in > 0.0) & (cos_out > 0.0);
                let pdf = 0.5 * density / (cos_out + length_out);
                scattering[l] = if is_metal { if above { pdf } else { 0.0 } } else { scattering[l] };
                let facet = half.dot(outgoing);
                for (channel, value) in value.iter_mut().enumerate() {
                    let reflectance = conductor_reflectance(facet, g.eta[channel][l], g.k[channel][l]);
                    let metal = if above { reflectance * single } else { 0.0 };
                    value[l] = if is_metal { metal } else { value[l] };
                }
            }
        }
        let radiance = shone.radiance.to_array();
        for l in 0..LANES {
            // The power heuristic of light sampling against scattering; a light without extent has no rival.
            let ratio = scattering[l] / (own[l] * pdf[l]);
            let rivalry = if shone.delta { 0.0 } else { ratio * ratio };
            let scale = 1.0 / ((1.0 + rivalry) * (all * pdf[l]));
            let usable = (seen[l] > 0.0) & (own[l] > 0.0) & (scattering[l] > 0.0) & (scale < f32::INFINITY);
            let mut most = 0.0_f32;
            for channel in 0..3 {
                let light = g.gain[channel][l] * value[channel][l] * radiance[channel] * scale;
                let light = if usable & (light < f32::INFINITY) { light } else { 0.0 };
                bringing.light[channel][l] = light;
                most = if light > most { light } else { most };
            }
            bringing.weight[l] = most;
        }
    }
}

#[inline(always)]
fn dot(vectors: &Vectors, lane: usize, direction: Vec3) -> f32 {
    vectors[0][lane] * direction.x + vectors[1][lane] * direction.y + vectors[2][lane] * direction.z
}

impl Bringing {
    pub(super) const NOTHING: Self = Self { light: NONE, weight: [0.0; LANES] };
}
