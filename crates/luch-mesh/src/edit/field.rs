//! Formulas of the place: for selections and displacements.

use glam::DVec3;
use luch_formula::{Formula, FormulaError, Tape};

/// A formula in x, y and z, compiled.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    tape: Tape,
}

const VARIABLES: [&str; 3] = ["x", "y", "z"];

impl Field {
    /// Reads a formula such as `0.1*sin(5x) + z`; see the language of `luch-formula`.
    ///
    /// # Errors
    /// What is wrong in the text, and where.
    pub fn parse(text: &str) -> Result<Self, FormulaError> {
        let expression = Formula::new(text).parse(&VARIABLES)?;
        // An expression that was read with these names needs no others.
        let tape = Tape::new(&expression, &VARIABLES).expect("all variables are among the inputs");
        Ok(Self { tape })
    }

    /// The values at places, in bulk.
    pub fn values(&self, places: &[DVec3]) -> Vec<f64> {
        let [x, y, z] = [0, 1, 2].map(|axis| places.iter().map(|place| place[axis]).collect::<Vec<f64>>());
        let mut values = vec![0.0; places.len()];
        self.tape.evaluate(&[&x, &y, &z], &mut values);
        values
    }
}
