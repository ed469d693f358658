//! First points side by side: what they scatter toward their own viewers.
//!
//! Diffuse surfaces and metals whose light bounces once have loops of their own: with GGX facets that are alike in all directions
//! around the normal, cosines are all that counts, and no frame is needed. All others are asked one by one.

use super::points::{LANES, Lanes, NONE, Points, Vectors, at};
use crate::bsdf::{Bsdf, conductor_reflectance};
use crate::surface::Exit;
use glam::Vec3;
use luch_image::Rgb;
use luch_sampling::Frame;
use std::f32::consts::FRAC_1_PI;

/// A point of a surface that scatters light toward a viewer.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scatterer {
    pub(crate) exit: Exit,
    pub(crate) frame: Frame,
    pub(crate) bsdf: Bsdf,
    /// Toward the viewer, unit length.
    pub(crate) toward_viewer: Vec3,
}

/// Scatterers side by side.
#[derive(Clone, Debug, Default)]
pub(super) struct Scatterers {
    pub(super) points: Points,
    metals: Metals,
    /// Albedo of diffuse lanes.
    color: Vectors,
    /// Those that are neither diffuse nor simple metals.
    others: Vec<(usize, Scatterer)>,
    /// Their lanes.
    apart: u32,
}

/// What metals need besides; `alpha` is 0 where there is none.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
struct Metals {
    outgoing: Vectors,
    alpha: Lanes,
    eta: Vectors,
    k: Vectors,
    any: bool,
}

impl Default for Metals {
    fn default() -> Self {
        Self { outgoing: NONE, alpha: [0.0; LANES], eta: [[1.0; LANES]; 3], k: [[1.0; LANES]; 3], any: false }
    }
}

/// What lanes scatter from directions of their own.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(super) struct Scattered {
    /// f · cos.
    pub(super) value: Vectors,
    /// Density of the direction, per solid angle.
    pub(super) pdf: Lanes,
}

impl Default for Scattered {
    fn default() -> Self {
        Self { value: NONE, pdf: [0.0; LANES] }
    }
}

impl Scatterers {
    pub(super) fn clear(&mut self) {
        self.points.clear();
        self.others.clear();
        self.apart = 0;
        if self.metals.any {
            self.metals = Metals::default();
        }
    }

    pub(super) fn set_diffuse(&mut self, lane: usize, exit: &Exit, depth: u32, albedo: Rgb) {
        self.points.set(lane, exit, depth);
        for (color, albedo) in self.color.iter_mut().zip(albedo.to_array()) {
            color[lane] = albedo;
        }
    }

    pub(super) fn set(&mut self, lane: usize, scatterer: &Scatterer, depth: u32) {
        let Scatterer { exit, bsdf, toward_viewer, .. } = scatterer;
        let simple = if let Bsdf::Conductor(metal) = bsdf { metal.single_bounce() } else { None };
        match (bsdf, simple) {
            (Bsdf::Diffuse(diffuse), _) => self.set_diffuse(lane, exit, depth, diffuse.color()),
            (_, Some((alpha, eta, k))) => {
                self.points.set(lane, exit, depth);
                let metals = &mut self.metals;
                metals.any = true;
                metals.alpha[lane] = alpha;
                for axis in 0..3 {
                    metals.outgoing[axis][lane] = toward_viewer[axis];
                    metals.eta[axis][lane] = eta.to_array()[axis];
                    metals.k[axis][lane] = k.to_array()[axis];
                }
            }
            _ => {
                self.points.set(lane, exit, depth);
                self.others.push((lane, *scatterer));
                self.apart |= 1 << lane;
            }
        }
    }

    /// Whether all are diffuse: value over density is their colour.
    pub(super) fn is_diffuse(&self) -> bool {
        !self.metals.any && self.others.is_empty()
    }

    /// Whether a lane of this depth takes part in connections. Surfaces that must be asked one by one do not: what they gain is
    /// less than what it takes.
    #[inline(always)]
    pub(super) fn connects(&self, lane: usize, depth: u32) -> bool {
        self.points.is_at(lane, depth) & (self.apart >> lane & 1 == 0)
    }

    /// Albedo of a diffuse lane.
    pub(super) fn color(&self) -> &Vectors {
        &self.color
    }

    /// Normal on the side that receives light; zero if light of both sides counts.
    pub(super) fn receiving(&self, lane: usize) -> Vec3 {
        match self.other(lane) {
            Some(other) if other.bsdf.transmits() => Vec3::ZERO,
            _ => self.points.normal(lane),
        }
    }

    /// Where a ray along `direction` starts.
    pub(super) fn start_toward(&self, lane: usize, direction: Vec3) -> Vec3 {
        match self.other(lane) {
            Some(other) => other.exit.start_toward(direction),
            None => self.points.near(lane),
        }
    }

    fn other(&self, lane: usize) -> Option<&Scatterer> {
        self.others.iter().find(|(other, _)| *other == lane).map(|(_, scatterer)| scatterer)
    }

    /// Fills in the densities alone; values are left with what they are. Lanes that are not `wanted` may be told anything.
    #[inline(always)]
    pub(super) fn densities(
        &self,
        toward: &Vectors,
        wanted: impl Fn(usize) -> bool,
        scattered: &mut Scattered,
    ) {
        self.cosines(toward, scattered);
        if !self.is_diffuse() {
            self.replace::<false>(toward, wanted, scattered);
        }
    }

    /// Values and densities. Lanes that are not `wanted` may be told anything.
    #[inline(always)]
    pub(super) fn evaluate(
        &self,
        toward: &Vectors,
        wanted: impl Fn(usize) -> bool,
        scattered: &mut Scattered,
    ) {
        self.cosines(toward, scattered);
        for (value, color) in scattered.value.iter_mut().zip(&self.color) {
            for l in 0..LANES {
                value[l] = color[l] * scattered.pdf[l];
            }
        }
        if !self.is_diffuse() {
            self.replace::<true>(toward, wanted, scattered);
        }
    }

    /// Densities of diffuse surfaces: cos / π where light may pass.
    #[inline(always)]
    fn cosines(&self, toward: &Vectors, scattered: &mut Scattered) {
        for l in 0..LANES {
            let direction = at(toward, l);
            let honest =
                (direction.dot(at(&self.points.geometric_normal, l)) > 0.0) | (self.points.lifted[l] > 0.0);
            let cosine = direction.dot(at(&self.points.normal, l));
            scattered.pdf[l] = if honest & (cosine > 0.0) { cosine * FRAC_1_PI } else { 0.0 };
        }
    }

    /// Puts in what is not diffuse.
    #[inline(always)]
    fn replace<const VALUES: bool>(
        &self,
        toward: &Vectors,
        wanted: impl Fn(usize) -> bool,
        scattered: &mut Scattered,
    ) {
        let metals = &self.metals;
        if metals.any {
            for l in 0..LANES {
                let optics = Optics {
                    alpha: metals.alpha[l],
                    eta: [metals.eta[0][l], metals.eta[1][l], metals.eta[2][l]],
                    k: [metals.k[0][l], metals.k[1][l], metals.k[2][l]],
                };
                let (normal, outgoing) = (at(&self.points.normal, l), at(&metals.outgoing, l));
                let facet = Facet::new(optics.alpha, normal, outgoing, at(toward, l));
                let is_metal = optics.alpha > 0.0;
                // What may not pass is dark already.
                let passes = scattered.pdf[l] > 0.0;
                scattered.pdf[l] = if is_metal & passes { facet.pdf } else { scattered.pdf[l] };
                if VALUES {
                    let value = optics.colored(&facet);
                    for (channel, value) in scattered.value.iter_mut().zip(value) {
                        let metal = if passes { value } else { 0.0 };
                        channel[l] = if is_metal { metal } else { channel[l] };
                    }
                }
            }
        }
        for (lane, other) in self.others.iter().filter(|(lane, _)| wanted(*lane)) {
            let direction = at(toward, *lane);
            let (value, pdf) = other.scatter(direction);
            scattered.pdf[*lane] = pdf;
            for (channel, value) in scattered.value.iter_mut().zip(value.to_array()) {
                channel[*lane] = value;
            }
        }
    }
}

impl Scatterer {
    /// Value and density of light from a direction of the world.
    fn scatter(&self, incoming: Vec3) -> (Rgb, f32) {
        if !self.exit.is_honest(incoming) {
            return (Rgb::BLACK, 0.0);
        }
        let outgoing = self.frame.to_local(self.toward_viewer);
        let scattered = self.bsdf.evaluate(outgoing, self.frame.to_local(incoming));
        (scattered.value, scattered.pdf)
    }

    /// Whether it has a loop of its own: only such surfaces are connected.
    pub(crate) fn is_simple(&self) -> bool {
        matches!(self.bsdf, Bsdf::Diffuse(_)) || self.optics().is_some()
    }

    /// What a metal whose light bounces once needs.
    pub(crate) fn optics(&self) -> Option<Optics> {
        let Bsdf::Conductor(metal) = &self.bsdf else { return None };
        let (alpha, eta, k) = metal.single_bounce()?;
        Some(Optics { alpha, eta: eta.to_array(), k: k.to_array() })
    }
}

/// A metal with GGX facets.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Optics {
    alpha: f32,
    eta: [f32; 3],
    k: [f32; 3],
}

impl Optics {
    /// f · cos for each channel, and the density of the direction; zero below the horizon.
    #[inline(always)]
    pub(super) fn reflected(&self, normal: Vec3, outgoing: Vec3, incoming: Vec3) -> ([f32; 3], f32) {
        let facet = Facet::new(self.alpha, normal, outgoing, incoming);
        (self.colored(&facet), facet.pdf)
    }

    /// What a facet reflects of each channel.
    #[inline(always)]
    fn colored(&self, facet: &Facet) -> [f32; 3] {
        std::array::from_fn(|channel| {
            conductor_reflectance(facet.cosine, self.eta[channel], self.k[channel]) * facet.value
        })
    }
}

/// GGX facets that reflect one direction into another.
struct Facet {
    /// Of the half vector against either direction.
    cosine: f32,
    /// f · cos for a perfect mirror.
    value: f32,
    /// Density of sampling visible normals, per solid angle of the direction.
    pdf: f32,
}

impl Facet {
    #[inline(always)]
    fn new(alpha: f32, normal: Vec3, outgoing: Vec3, incoming: Vec3) -> Self {
        let (cos_in, cos_out) = (incoming.dot(normal), outgoing.dot(normal));
        let half = incoming + outgoing;
        let half = half * (1.0 / half.dot(half).sqrt());
        let alpha2 = alpha * alpha;
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
        let value = 0.25 * density * visibility * cos_in;
        let above = (cos_in > 0.0) & (cos_out > 0.0);
        let pdf = 0.5 * density / (cos_out + length_out);
        Self {
            cosine: half.dot(outgoing),
            value: if above { value } else { 0.0 },
            pdf: if above { pdf } else { 0.0 },
        }
    }
}
