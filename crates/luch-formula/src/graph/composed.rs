//! Functions of the language that are made of others.

use super::{Graph, Id};
use crate::operation::{Binary, Operation, Unary};
use std::f64::consts::PI;

/// Octaves of noise that are ever worth adding: the sixteenth changes the fifth digit.
pub(crate) const MOST_OCTAVES: u32 = 16;

impl Graph {
    /// The square root of the sum of squares.
    pub(crate) fn length(&mut self, ids: &[Id]) -> Id {
        if let [only] = ids {
            return self.unary(Unary::Absolute, *only);
        }
        let two = self.constant(2.0);
        let squares: Vec<Id> = ids.iter().map(|&id| self.binary(Binary::Power, id, two)).collect();
        let sum = squares[1..].iter().fold(squares[0], |sum, &square| self.binary(Binary::Add, sum, square));
        self.unary(Unary::SquareRoot, sum)
    }

    pub(crate) fn clamp(&mut self, x: Id, low: Id, high: Id) -> Id {
        let at_least = self.binary(Binary::Maximum, x, low);
        self.binary(Binary::Minimum, at_least, high)
    }

    pub(crate) fn mix(&mut self, a: Id, b: Id, t: Id) -> Id {
        let span = self.binary(Binary::Subtract, b, a);
        let part = self.binary(Binary::Multiply, span, t);
        self.binary(Binary::Add, a, part)
    }

    /// 0 before the first edge, 1 after the second, 3t² − 2t³ between.
    pub(crate) fn smoothstep(&mut self, first: Id, second: Id, x: Id) -> Id {
        let [zero, one, two, three] = [0.0, 1.0, 2.0, 3.0].map(|value| self.constant(value));
        let from = self.binary(Binary::Subtract, x, first);
        let span = self.binary(Binary::Subtract, second, first);
        let ratio = self.binary(Binary::Divide, from, span);
        let t = self.clamp(ratio, zero, one);
        let square = self.binary(Binary::Power, t, two);
        let twice = self.binary(Binary::Multiply, two, t);
        let rest = self.binary(Binary::Subtract, three, twice);
        self.binary(Binary::Multiply, square, rest)
    }

    pub(crate) fn noise(&mut self, place: [Id; 3]) -> Id {
        let [x, y, z] = place;
        self.operation(Operation::Noise { x, y, z })
    }

    /// Octaves of noise, each twice as fine and half as high as the one before, moved so that their whole points do not meet.
    pub(crate) fn fractal_noise(&mut self, place: [Id; 3], octaves: u32) -> Id {
        let mut sum = self.noise(place);
        let mut scale = 1.0;
        for octave in 1..octaves {
            scale *= 2.0;
            let moved = place.map(|coordinate| {
                let scale = self.constant(scale);
                let offset = self.constant(f64::from(octave) * 17.3125);
                let scaled = self.binary(Binary::Multiply, scale, coordinate);
                self.binary(Binary::Add, scaled, offset)
            });
            let noise = self.noise(moved);
            let height = self.constant(1.0 / scale);
            let part = self.binary(Binary::Multiply, height, noise);
            sum = self.binary(Binary::Add, sum, part);
        }
        sum
    }

    /// The density of the normal distribution with mean 0 and deviation 1.
    pub(crate) fn normal_density(&mut self, x: Id) -> Id {
        let two = self.constant(2.0);
        let half = self.constant(-0.5);
        let height = self.constant(1.0 / (2.0 * PI).sqrt());
        let square = self.binary(Binary::Power, x, two);
        let exponent = self.binary(Binary::Multiply, half, square);
        let bell = self.unary(Unary::Exp, exponent);
        self.binary(Binary::Multiply, height, bell)
    }
}
