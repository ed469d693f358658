//! Names with a meaning, and guesses at names that have none.

use std::cmp::Reverse;

/// Words that are part of the language.
pub(super) const KEYWORDS: [&str; 3] = ["and", "or", "not"];

/// Names with a meaning of their own, unless the caller or the formula gives them another.
pub(crate) const CONSTANTS: [(&str, f64); 7] = [
    ("pi", std::f64::consts::PI),
    ("π", std::f64::consts::PI),
    ("tau", std::f64::consts::TAU),
    ("e", std::f64::consts::E),
    // The golden ratio (1 + √5) / 2.
    ("phi", 1.618_033_988_749_895),
    ("inf", f64::INFINITY),
    ("nan", f64::NAN),
];

/// The candidate most like a name, if it is like it at all: at most a third of its letters differ, or only their case.
pub(super) fn closest<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> Option<String> {
    let short: String = name.chars().take(64).collect();
    let length = short.chars().count();
    let most = (length / 3).max(usize::from(length > 1));
    let ranked = candidates.map(|candidate| {
        let same = candidate.eq_ignore_ascii_case(&short);
        (if same { 0 } else { strsim::damerau_levenshtein(&short, candidate) }, candidate)
    });
    // Of two at the same distance, the one that begins alike: `sinn` is `sin` and not `sign`.
    let alike = |candidate: &str| short.chars().zip(candidate.chars()).take_while(|(a, b)| a == b).count();
    ranked
        .filter(|(distance, _)| *distance <= most)
        .min_by_key(|(distance, candidate)| (*distance, Reverse(alike(candidate))))
        .map(|(_, best)| best.to_owned())
}
