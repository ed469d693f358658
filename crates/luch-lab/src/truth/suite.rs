//! Many cases at once, and what all of them together say.

use super::judge::judge_in;
use super::{Case, Effort, Family, Technique, TruthError, Verdict, Way};
use luch_render::Stop;
use luch_sampling::Sequence;
use luch_sampling::check::{KolmogorovSmirnov, sidak, uniformity};
use rayon::prelude::*;
use serde::Serialize;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Which of the ways and sequences are judged.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// Where sample points come from.
    pub sequences: Vec<Sequence>,
    /// The integrators, where they apply.
    pub techniques: Vec<Technique>,
}

impl Choice {
    /// Everything.
    pub fn all() -> Self {
        Self { sequences: Sequence::ALL.to_vec(), techniques: Technique::ALL.to_vec() }
    }

    /// The ways of a case that are wanted.
    fn ways(&self, case: &Case) -> impl Iterator<Item = Way> {
        let wanted = |way: &Way| way.technique().is_none_or(|one| self.techniques.contains(&one));
        case.ways.iter().copied().filter(wanted)
    }

    /// How many rows these cases have.
    pub fn count(&self, cases: &[Case]) -> usize {
        cases.iter().map(|case| self.ways(case).count() * self.sequences.len()).sum()
    }
}

/// One case by one way with one sequence.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The family of the case.
    pub family: Family,
    /// The name of the case.
    pub case: String,
    /// Which integrator it is.
    pub technique: Option<Technique>,
    /// The integrator, as on the command line.
    pub way: String,
    /// Where sample points came from.
    pub sequence: Sequence,
    /// What was found.
    pub verdict: Verdict,
}

/// Judges cases on the threads of the current pool; rows in the order of cases, ways and sequences. `done` counts them as they are
/// finished. If `stop` comes due, those that are finished come back.
///
/// # Errors
///
/// A scene is unsound, or a film lost samples.
pub fn run(
    cases: &[Case],
    choice: &Choice,
    effort: Effort,
    stop: &Stop,
    done: &AtomicUsize,
) -> Result<Vec<Row>, TruthError> {
    let rows_of = |case: &Case| -> Result<Vec<Row>, TruthError> {
        let ways: Vec<(Way, Sequence)> =
            choice.ways(case).flat_map(|way| choice.sequences.iter().map(move |&one| (way, one))).collect();
        if ways.is_empty() || stop.is_due() {
            return Ok(Vec::new());
        }
        let world = case.world()?;
        let found: Result<Vec<Option<Row>>, TruthError> = ways
            .into_par_iter()
            .with_max_len(1)
            .map(|(way, sequence)| {
                let verdict = match judge_in(&world, case, way, sequence, effort, stop) {
                    Err(TruthError::Stopped(_)) => return Ok(None),
                    other => other?,
                };
                done.fetch_add(1, Ordering::Relaxed);
                Ok(Some(Row {
                    family: case.family,
                    case: case.name.clone(),
                    technique: way.technique(),
                    way: way.name(),
                    sequence,
                    verdict,
                }))
            })
            .collect();
        Ok(found?.into_iter().flatten().collect())
    };
    let found: Result<Vec<Vec<Row>>, TruthError> = cases.par_iter().with_max_len(1).map(rows_of).collect();
    Ok(found?.into_iter().flatten().collect())
}

/// What all rows together say.
///
/// A row is not judged by itself: of a thousand right answers, ten are as far off as one in a hundred is. The smallest probability is
/// held against the level of Šidák ("Rectangular confidence regions for the means of multivariate normal distributions", 1967).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judgement {
    /// How often a right renderer is wrongly rejected.
    pub alpha: f64,
    /// How many rows could have been off by chance.
    pub tests: usize,
    /// What the smallest probability must not be below.
    pub limit: f64,
    /// The row with the smallest probability; `None` without rows.
    pub worst: Option<usize>,
    /// Rows whose probability is below the limit.
    pub rejected: usize,
    /// Rows whose standard error is larger than was demanded.
    pub untold: usize,
    /// Whether the probabilities are spread evenly, as they are if every row is right and says honestly how sure it is. Too even a
    /// spread is as suspicious as too uneven a one: a probability near 1 here means errors that are stated too large. For information.
    pub uniformity: KolmogorovSmirnov,
}

impl Judgement {
    /// Judges rows, wrongly rejecting with probability `alpha` (in (0, 1)).
    pub fn of(rows: &[Row], effort: Effort, alpha: f64) -> Self {
        let chances: Vec<f64> =
            rows.iter().filter(|row| !row.verdict.is_rounding()).map(|row| row.verdict.p_value).collect();
        let limit = sidak(alpha, chances.len() as u32);
        let p_value = |row: &Row| row.verdict.p_value;
        let worst = (0..rows.len()).min_by(|&a, &b| p_value(&rows[a]).total_cmp(&p_value(&rows[b])));
        Self {
            alpha,
            tests: chances.len(),
            limit,
            worst,
            rejected: rows.iter().filter(|row| p_value(row) < limit).count(),
            untold: rows.iter().filter(|row| !row.verdict.tells(effort)).count(),
            uniformity: uniformity(&chances),
        }
    }

    /// Whether no row is farther off than chance allows.
    pub fn is_accepted(&self) -> bool {
        self.rejected == 0
    }
}
