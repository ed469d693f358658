//! The choice among bounded lights and those at infinity.

use super::tree::{Descent, LightTree};
use super::{ChosenEmitter, Lights, Receiver};
use glam::Vec3;
use luch_bvh::simd::Task;

/// Least share of the samples for lights at infinity where there are bounded ones, and the other way round.
const LEAST: f64 = 0.125;

/// Receivers that go down the tree side by side: each step waits for the one before, but not for those of others.
const TOGETHER: usize = 16;

/// Picks an emitter for a receiver.
pub(super) struct Choose<'a> {
    pub(super) lights: &'a Lights,
    pub(super) receiver: Receiver,
}

impl Task for Choose<'_> {
    type Output = Option<ChosenEmitter>;

    #[inline(always)]
    fn run(self) -> Option<ChosenEmitter> {
        let Self { lights, receiver } = self;
        let mut way = begin(lights, &receiver)?;
        while let Way::Tree { descent, share } = way {
            way = go_on(lights.tree.as_ref()?, descent, share)?;
        }
        way.end()
    }
}

/// Picks emitters for many receivers.
pub(super) struct ChooseMany<'a> {
    pub(super) lights: &'a Lights,
    pub(super) receivers: &'a [Receiver],
    pub(super) chosen: &'a mut [Option<ChosenEmitter>],
}

impl Task for ChooseMany<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { lights, receivers, chosen } = self;
        for (receivers, chosen) in receivers.chunks(TOGETHER).zip(chosen.chunks_mut(TOGETHER)) {
            let mut ways = [None; TOGETHER];
            for (way, receiver) in ways.iter_mut().zip(receivers) {
                *way = begin(lights, receiver);
            }
            let mut open = lights.tree.is_some();
            while open {
                open = false;
                for way in &mut ways {
                    if let (Some(Way::Tree { descent, share }), Some(tree)) = (*way, &lights.tree) {
                        *way = go_on(tree, descent, share);
                        open = true;
                    }
                }
            }
            for (chosen, way) in chosen.iter_mut().zip(ways) {
                *chosen = way.and_then(|way| way.end());
            }
        }
    }
}

/// How far a choice is.
#[derive(Clone, Copy)]
enum Way {
    /// On the way down the tree, which has this share of the choices.
    Tree { descent: Descent, share: f64 },
    /// At the end.
    End { emitter: u32, probability: f64 },
}

impl Way {
    /// On the way, or at the end of it.
    #[inline(always)]
    fn new(descent: Descent, share: f64) -> Self {
        match descent.emitter() {
            None => Way::Tree { descent, share },
            Some(emitter) => Way::End { emitter, probability: descent.probability * share },
        }
    }

    #[inline(always)]
    fn end(self) -> Option<ChosenEmitter> {
        let Way::End { emitter, probability } = self else { return None };
        let probability = probability as f32;
        (probability > 0.0).then_some(ChosenEmitter { emitter, probability })
    }
}

#[inline(always)]
fn begin(lights: &Lights, receiver: &Receiver) -> Option<Way> {
    let Receiver { position, normal, choice } = *receiver;
    let far = lights.distant.irradiance(normal);
    let root = lights.tree.as_ref().map(|tree| (tree, tree.root(position, normal)));
    let near = near_share(root.as_ref().map_or(0.0, |(tree, root)| tree.irradiance(root)), far);
    if choice < near {
        let (tree, root) = root?;
        let descent = tree.start(root, position, normal, (choice / near).min(1f64.next_down()))?;
        Some(Way::new(descent, near))
    } else if far > 0.0 {
        let picked = lights.distant.pick(far, normal, (choice - near) / (1.0 - near))?;
        Some(Way::End { emitter: picked.emitter, probability: picked.probability * (1.0 - near) })
    } else {
        None
    }
}

#[inline(always)]
fn go_on(tree: &LightTree, descent: Descent, share: f64) -> Option<Way> {
    Some(Way::new(tree.step(descent)?, share))
}

/// The chance of an emitter.
pub(super) struct Probability<'a> {
    pub(super) lights: &'a Lights,
    pub(super) emitter: u32,
    pub(super) from: Vec3,
    pub(super) normal: Vec3,
}

impl Task for Probability<'_> {
    type Output = f32;

    #[inline(always)]
    fn run(self) -> f32 {
        let Self { lights, emitter, from, normal } = self;
        let far = lights.distant.irradiance(normal);
        let root = lights.tree.as_ref().map(|tree| (tree, tree.root(from, normal)));
        let near = near_share(root.as_ref().map_or(0.0, |(tree, root)| tree.irradiance(root)), far);
        let in_tree = root.map_or(0.0, |(tree, root)| tree.probability(root, emitter, from, normal));
        let beyond = if far > 0.0 { lights.distant.probability(emitter, far, normal) } else { 0.0 };
        (in_tree * near + beyond * (1.0 - near)) as f32
    }
}

/// Share of the samples for bounded lights, where the two kinds would bring so much irradiance.
#[inline(always)]
fn near_share(near: f64, far: f64) -> f64 {
    if near.is_nan() || near <= 0.0 {
        0.0
    } else if far.is_nan() || far <= 0.0 {
        1.0
    } else {
        // Infinite irradiance is no reason to fail.
        let share = 1.0 / (1.0 + far / near);
        if share.is_nan() { 0.5 } else { share.clamp(LEAST, 1.0 - LEAST) }
    }
}
