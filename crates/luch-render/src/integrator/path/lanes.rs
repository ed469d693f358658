//! Sixteen paths scattered side by side by plain surfaces.

use crate::plain::PlainHit;
use crate::purpose;
use crate::roulette::survival;
use crate::surface::{Exit, POSITION_ERROR};
use crate::wave::{Path, SIDE_BY_SIDE};
use glam::Vec3;
use luch_bvh::InstanceHit;
use luch_bvh::simd::Task;
use luch_image::Rgb;
use luch_sampling::lanes::{group_words_16, unit_16};
use luch_sampling::warp::cosine_hemisphere;
use luch_sampling::{Frame, Sampler};
use std::f32::consts::FRAC_1_PI;

/// Paths side by side.
const LANES: usize = SIDE_BY_SIDE;

type Lanes = [f32; LANES];
type Vectors = [Lanes; 3];

/// What is known of paths that arrived at plain surfaces; `[axis][lane]`.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(super) struct Arrivals {
    /// For directions.
    samplers: [Sampler; LANES],
    /// For light.
    light_samplers: [Sampler; LANES],
    corners: [Vectors; 3],
    u: Lanes,
    v: Lanes,
    outward: Lanes,
    extent: Lanes,
    direction: Vectors,
    albedo: Vectors,
    /// Throughput as roulette sees it.
    carried: Vectors,
    pub(super) count: usize,
}

/// How they go on.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(super) struct Departures {
    position: Vectors,
    normal: Vectors,
    near: Vectors,
    direction: Vectors,
    pdf: Lanes,
    /// The factor of those that survive roulette; 0 for those that end.
    factor: Lanes,
    /// 1 where the viewer sees the surface at all.
    seen: Lanes,
    pub(super) light_choice: [u32; LANES],
    light_u: Lanes,
    light_v: Lanes,
}

const NONE: Vectors = [[0.0; LANES]; 3];

impl Arrivals {
    /// Room for paths; `sampler` stands in for those that are missing.
    pub(super) fn new(sampler: Sampler) -> Self {
        let zero = [0.0; LANES];
        Self {
            samplers: [sampler; LANES],
            light_samplers: [sampler; LANES],
            corners: [NONE; 3],
            u: zero,
            v: zero,
            outward: zero,
            extent: zero,
            direction: NONE,
            albedo: NONE,
            carried: NONE,
            count: 0,
        }
    }

    #[inline(always)]
    pub(super) fn push(&mut self, path: &Path, hit: &InstanceHit, plain: &PlainHit, is_first: bool) {
        let lane = self.count;
        self.samplers[lane] = if is_first { path.together } else { path.sampler };
        self.light_samplers[lane] = path.sampler;
        for axis in 0..3 {
            for corner in 0..3 {
                self.corners[corner][axis][lane] = plain.corners[corner][axis];
            }
            self.direction[axis][lane] = path.ray.direction[axis];
        }
        (self.u[lane], self.v[lane]) = (hit.hit.u, hit.hit.v);
        (self.outward[lane], self.extent[lane]) = (plain.outward, plain.extent);
        let carried = path.throughput * path.carried / path.radiance_scale;
        for (channel, (albedo, carried)) in
            plain.albedo.to_array().into_iter().zip(carried.to_array()).enumerate()
        {
            self.albedo[channel][lane] = albedo;
            self.carried[channel][lane] = carried;
        }
        self.count += 1;
    }
}

impl Departures {
    pub(super) fn new() -> Self {
        let zero = [0.0; LANES];
        Self {
            position: NONE,
            normal: NONE,
            near: NONE,
            direction: NONE,
            pdf: zero,
            factor: zero,
            seen: zero,
            light_choice: [0; LANES],
            light_u: zero,
            light_v: zero,
        }
    }

    pub(super) fn is_seen(&self, lane: usize) -> bool {
        self.seen[lane] > 0.0
    }

    pub(super) fn exit(&self, lane: usize) -> Exit {
        let normal = at(&self.normal, lane);
        let (position, near) = (at(&self.position, lane), at(&self.near, lane));
        Exit {
            position,
            geometric_normal: normal,
            normal,
            near,
            far: position + (position - near),
            lifted: false,
        }
    }

    pub(super) fn position(&self, lane: usize) -> Vec3 {
        at(&self.position, lane)
    }

    pub(super) fn normal(&self, lane: usize) -> Vec3 {
        at(&self.normal, lane)
    }

    pub(super) fn near(&self, lane: usize) -> Vec3 {
        at(&self.near, lane)
    }

    pub(super) fn direction(&self, lane: usize) -> Vec3 {
        at(&self.direction, lane)
    }

    pub(super) fn pdf(&self, lane: usize) -> f32 {
        self.pdf[lane]
    }

    pub(super) fn factor(&self, lane: usize) -> f32 {
        self.factor[lane]
    }

    pub(super) fn light_place(&self, lane: usize) -> [f32; 2] {
        [self.light_u[lane], self.light_v[lane]]
    }
}

fn at(vectors: &Vectors, lane: usize) -> Vec3 {
    Vec3::from_array(vectors.map(|axis| axis[lane]))
}

/// Scatters all of them.
pub(super) struct Scatter<'a> {
    pub(super) arrivals: &'a Arrivals,
    pub(super) departures: &'a mut Departures,
    pub(super) bounce: u32,
}

impl Task for Scatter<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { arrivals: a, departures: d, bounce } = self;
        let words = group_words_16(&a.samplers, purpose::scatter(bounce));
        let (across, along, chance) = (unit_16(&words[0]), unit_16(&words[1]), unit_16(&words[3]));
        let words = group_words_16(&a.light_samplers, purpose::light(bounce));
        d.light_choice = words[0];
        d.light_u = unit_16(&words[1]);
        d.light_v = unit_16(&words[2]);
        for l in 0..LANES {
            let corner = |c: usize| Vec3::new(a.corners[c][0][l], a.corners[c][1][l], a.corners[c][2][l]);
            let [p, q, r] = [corner(0), corner(1), corner(2)];
            let position = p * (1.0 - a.u[l] - a.v[l]) + q * a.u[l] + r * a.v[l];
            let outward = (q - p).cross(r - p) * a.outward[l];
            let outgoing = -Vec3::new(a.direction[0][l], a.direction[1][l], a.direction[2][l]);
            let cosine = outgoing.dot(outward);
            // Of unit length, on the side of the viewer.
            let length = outward.dot(outward).sqrt();
            let normal = outward * ((if cosine < 0.0 { -1.0 } else { 1.0 }) / length);
            let near = position + normal * (a.extent[l] * POSITION_ERROR);
            let direction = cosine_hemisphere([across[l], along[l]]);
            let pdf = direction.z * FRAC_1_PI;
            let direction = Frame::from_normal(normal).to_world(direction);
            let most = (a.carried[0][l] * a.albedo[0][l])
                .max(a.carried[1][l] * a.albedo[1][l])
                .max(a.carried[2][l] * a.albedo[2][l]);
            let survival = survival(bounce, most);
            let alive = chance[l] < survival;
            d.factor[l] = if alive { 1.0 / survival } else { 0.0 };
            d.seen[l] = if (cosine != 0.0) & (length > 0.0) { 1.0 } else { 0.0 };
            d.pdf[l] = pdf;
            for axis in 0..3 {
                d.position[axis][l] = position[axis];
                d.normal[axis][l] = normal[axis];
                d.near[axis][l] = near[axis];
                d.direction[axis][l] = direction[axis];
            }
        }
    }
}

/// The value and density of a diffuse reflection.
#[inline(always)]
pub(super) fn reflected(normal: Vec3, incoming: Vec3, albedo: Rgb) -> (Rgb, f32) {
    let pdf = normal.dot(incoming).max(0.0) * FRAC_1_PI;
    (albedo * pdf, pdf)
}
