//! Equal positions to one number, fast: the heart of reading STL.

use std::hash::BuildHasher;

use glam::Vec3;

/// Positions met so far, each once, in the order of their first coming.
///
/// An open-addressing table of position numbers, at most half full. The start of each search depends on a random key, so
/// that no file can be made to be slow; the numbers given do not depend on it.
pub(crate) struct Welder {
    pub(crate) positions: Vec<Vec3>,
    /// Position numbers, [`EMPTY`] where there is none; a power of two of them.
    table: Vec<u32>,
    key: u64,
}

const EMPTY: u32 = u32::MAX;

impl Default for Welder {
    fn default() -> Self {
        Self { positions: Vec::new(), table: vec![EMPTY; 64], key: std::hash::RandomState::new().hash_one(0) }
    }
}

impl Welder {
    /// Makes room for so many positions.
    pub(crate) fn reserve(&mut self, count: usize) {
        self.positions.reserve(count);
        let size = (2 * count).next_power_of_two();
        if self.positions.is_empty() && size > self.table.len() {
            self.table = vec![EMPTY; size];
        }
    }

    /// The number of a position, which must be finite; 0 and −0 are the same.
    pub(crate) fn number(&mut self, position: Vec3) -> u32 {
        // Adding zero makes −0 and 0 the same.
        let position = position + Vec3::ZERO;
        if 2 * self.positions.len() >= self.table.len() {
            self.grow();
        }
        let mut place = self.start(position);
        loop {
            match self.table[place] {
                EMPTY => {
                    let number = self.positions.len() as u32;
                    self.table[place] = number;
                    self.positions.push(position);
                    return number;
                }
                number if self.positions[number as usize] == position => return number,
                _ => place = (place + 1) & (self.table.len() - 1),
            }
        }
    }

    fn grow(&mut self) {
        self.table = vec![EMPTY; 2 * self.table.len()];
        for number in 0..self.positions.len() {
            let mut place = self.start(self.positions[number]);
            while self.table[place] != EMPTY {
                place = (place + 1) & (self.table.len() - 1);
            }
            self.table[place] = number as u32;
        }
    }

    fn start(&self, position: Vec3) -> usize {
        let [x, y, z] = position.to_array().map(|number| u64::from(number.to_bits()));
        // Folded products of 128 bits mix all bits into all.
        let fold = |a: u64, b: u64| {
            let product = u128::from(a) * u128::from(b);
            (product >> 64) as u64 ^ product as u64
        };
        let first = fold((x << 32 | y) ^ self.key, 0x9e37_79b9_7f4a_7c15);
        fold(first ^ z, self.key | 1) as usize & (self.table.len() - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_the_first_coming() {
        let mut welder = Welder::default();
        let place = |i: u32| Vec3::new((i % 100) as f32, (i / 100 % 100) as f32, -0.0);
        for i in 0..30_000 {
            assert_eq!(welder.number(place(i)), i % 10_000);
        }
        assert_eq!(welder.number(Vec3::new(7.0, 3.0, 0.0)), 307);
        assert_eq!(welder.positions.len(), 10_000);
    }
}
