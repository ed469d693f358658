//! Answers, and whether they agree with those of others.

use luch::bvh::{Hit, Ray};
use luch::formats::ray_files::RecordedHit;

/// Distances that differ by more than this share are different.
const TOLERANCE: f64 = 1e-4;
/// Differences that are shown.
const MOST_EXAMPLES: usize = 3;

/// What the rays of a set met.
#[derive(Clone, Debug)]
pub(super) enum Answers {
    Nearest(Vec<Option<Hit>>),
    Any(Vec<bool>),
}

impl Answers {
    /// How many rays met something.
    pub(super) fn hits(&self) -> usize {
        match self {
            Self::Nearest(hits) => hits.iter().flatten().count(),
            Self::Any(met) => met.iter().filter(|met| **met).count(),
        }
    }

    /// How many rays have other bits as their answer.
    pub(super) fn other_bits(&self, other: &Self) -> usize {
        let bits =
            |hit: &Option<Hit>| hit.map(|h| [h.t.to_bits(), h.u.to_bits(), h.v.to_bits(), h.primitive]);
        match (self, other) {
            (Self::Nearest(a), Self::Nearest(b)) => {
                a.iter().zip(b).filter(|(a, b)| bits(a) != bits(b)).count()
            }
            (Self::Any(a), Self::Any(b)) => a.iter().zip(b).filter(|(a, b)| a != b).count(),
            (Self::Nearest(hits), Self::Any(_)) | (Self::Any(_), Self::Nearest(hits)) => hits.len(),
        }
    }

    /// As files hold them.
    pub(super) fn recorded(&self, rays: &[Ray]) -> Vec<RecordedHit> {
        match self {
            Self::Nearest(hits) => {
                rays.iter().zip(hits).map(|(ray, hit)| RecordedHit::nearest(ray, hit.as_ref())).collect()
            }
            Self::Any(met) => met.iter().map(|&met| RecordedHit::any(met)).collect(),
        }
    }

    /// How they agree with another program's.
    pub(super) fn compare(&self, reference: &[RecordedHit]) -> Agreement {
        let mut agreement = Agreement::default();
        for (i, theirs) in reference.iter().enumerate() {
            match self {
                Self::Nearest(hits) => agreement.add_nearest(i, hits[i].as_ref(), theirs),
                Self::Any(met) => agreement.add_any(i, met[i], theirs.t < 0.0),
            }
        }
        agreement
    }
}

/// How two lists of answers agree.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Agreement {
    /// Rays that meet something in one list alone.
    pub(super) hit_or_miss: usize,
    /// Rays that meet another triangle.
    pub(super) primitive: usize,
    /// Rays whose distance differs by more than a ten-thousandth.
    pub(super) distance: usize,
    /// The largest relative difference of a distance.
    pub(super) worst: f64,
    /// The first few that differ in hit, miss or distance, in words.
    pub(super) examples: Vec<String>,
}

impl Agreement {
    fn add_nearest(&mut self, ray: usize, ours: Option<&Hit>, theirs: &RecordedHit) {
        match (ours, theirs.primitive) {
            (None, None) => {}
            (Some(hit), Some(primitive)) => {
                let [a, b] = [hit.t, theirs.t].map(f64::from);
                let difference = (a - b).abs() / b.abs().max(1e-6);
                self.worst = self.worst.max(difference);
                self.primitive += usize::from(hit.primitive != primitive);
                if difference > TOLERANCE || difference.is_nan() {
                    self.distance += 1;
                    let hit = format!("triangle {} at {a}, expected {primitive} at {b}", hit.primitive);
                    self.show(ray, &hit);
                }
            }
            (Some(hit), None) => {
                self.hit_or_miss += 1;
                self.show(ray, &format!("triangle {} at {}, expected nothing", hit.primitive, hit.t));
            }
            (None, Some(primitive)) => {
                self.hit_or_miss += 1;
                self.show(ray, &format!("nothing, expected triangle {primitive} at {}", theirs.t));
            }
        }
    }

    fn add_any(&mut self, ray: usize, ours: bool, theirs: bool) {
        if ours != theirs {
            self.hit_or_miss += 1;
            let name = |met| if met { "something" } else { "nothing" };
            self.show(ray, &format!("{}, expected {}", name(ours), name(theirs)));
        }
    }

    fn show(&mut self, ray: usize, what: &str) {
        if self.examples.len() < MOST_EXAMPLES {
            self.examples.push(format!("ray {ray} meets {what}"));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_counted_and_told() {
        let hit = |t, primitive| Some(Hit { t, u: 0.1, v: 0.2, primitive });
        let record = |t, primitive| RecordedHit { t, u: 0.1, v: 0.2, primitive };
        let ours = Answers::Nearest(vec![hit(1.0, 1), hit(1.0, 2), hit(1.0, 3), None, hit(2.0, 4), None]);
        let reference = [
            record(1.0, Some(1)),
            record(1.000_05, Some(9)),
            record(1.001, Some(3)),
            record(5.0, Some(1)),
            record(1e30, None),
            record(1e30, None),
        ];
        let agreement = ours.compare(&reference);
        assert_eq!([agreement.hit_or_miss, agreement.primitive, agreement.distance], [2, 1, 1]);
        assert_eq!(agreement.examples.len(), 3);
        assert!(agreement.examples[0].starts_with("ray 2 meets triangle 3 at 1, expected 3 at 1.00"));
        assert_eq!(agreement.examples[2], "ray 4 meets triangle 4 at 2, expected nothing");
        assert_eq!(ours.hits(), 4);
        assert_eq!(ours.other_bits(&ours.clone()), 0);

        let ours = Answers::Any(vec![true, false, true]);
        let agreement = ours.compare(&[-1.0, -1.0, 0.0].map(|t| record(t, None)));
        assert_eq!(
            (agreement.hit_or_miss, agreement.examples[0].as_str()),
            (2, "ray 1 meets nothing, expected something")
        );
        assert_eq!(ours.other_bits(&Answers::Any(vec![true, true, true])), 1);
    }

    #[test]
    fn recorded_answers_agree_with_themselves() {
        let ray = Ray::new(glam::Vec3::ZERO, glam::Vec3::X);
        let ours = Answers::Nearest(vec![Some(Hit { t: 0.5, u: 0.0, v: 1.0, primitive: 0 }), None]);
        assert_eq!(ours.compare(&ours.recorded(&[ray, ray])), Agreement::default());
    }
}
