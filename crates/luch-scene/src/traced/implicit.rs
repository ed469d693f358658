//! Surfaces where a formula is zero.

use glam::Vec3;
use luch_formula::{Expression, Formula, FormulaError, Tape};
use serde::{Deserialize, Serialize};
use std::sync::{Arc, OnceLock};

/// The surface in a box where a formula of `x`, `y` and `z` is zero; inside it is negative.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Implicit {
    formula: Formula,
    corners: [Vec3; 2],
    closed: bool,
    /// Made of the others on first use; `None` inside for a formula with mistakes.
    #[serde(skip)]
    tape: OnceLock<Option<Arc<Tape>>>,
}

impl PartialEq for Implicit {
    fn eq(&self, other: &Self) -> bool {
        self.formula == other.formula && self.corners == other.corners && self.closed == other.closed
    }
}

impl Implicit {
    /// The surface of a formula, or of an equation `a = b`, between two corners of a box, in metres. A closed one is cut with the box,
    /// whose sides are then part of the surface; otherwise it ends where the box ends.
    ///
    /// # Errors
    /// If the formula has a mistake.
    pub fn new(formula: Formula, corners: [Vec3; 2], closed: bool) -> Result<Self, FormulaError> {
        formula.parse_equation(&["x", "y", "z"])?;
        Ok(Self { formula, corners, closed, tape: OnceLock::new() })
    }

    /// The least and the greatest corner of the box.
    pub fn corners(&self) -> [Vec3; 2] {
        self.corners
    }

    /// The formula as it was written.
    pub fn formula(&self) -> &Formula {
        &self.formula
    }

    /// Whether the sides of the box belong to the surface.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// The formula as a function of x, y and z, cut with the box if it is closed; `None` if it has a mistake.
    pub fn tape(&self) -> Option<&Arc<Tape>> {
        self.tape.get_or_init(|| self.compile()).as_ref()
    }

    fn compile(&self) -> Option<Arc<Tape>> {
        let mut expression = self.formula.parse_equation(&["x", "y", "z"]).ok()?;
        if self.closed {
            expression = expression.intersection(&inside_box(self.corners));
        }
        Tape::new(&expression, &["x", "y", "z"]).ok().map(Arc::new)
    }

    /// Whether a point is inside the body.
    pub fn encloses(&self, point: Vec3) -> bool {
        let inside = |tape: &Arc<Tape>| tape.value(&point.to_array().map(f64::from)) < 0.0;
        self.closed && self.tape().is_some_and(inside)
    }

    /// What is wrong with it, if anything.
    pub fn problem(&self) -> Option<String> {
        let [low, high] = self.corners;
        if !(low.is_finite() && high.is_finite() && low.cmplt(high).all()) {
            return Some(format!("a box from {low} to {high}, expected the first corner below the second"));
        }
        if self.tape().is_none() {
            return Some("a formula that cannot be understood".into());
        }
        None
    }
}

/// Negative inside a box: the farthest out of the six sides.
fn inside_box([low, high]: [Vec3; 2]) -> Expression {
    let sides = ["x", "y", "z"].into_iter().enumerate().flat_map(|(axis, name)| {
        let place = Expression::variable(name);
        let (low, high) = (f64::from(low[axis]), f64::from(high[axis]));
        [Expression::constant(low) - place.clone(), place - Expression::constant(high)]
    });
    Expression::greatest(&sides.collect::<Vec<_>>())
}
