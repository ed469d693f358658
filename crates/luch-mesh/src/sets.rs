//! Disjoint sets of numbers (union–find), by lowest member: the root of a set does not depend on the order of joins.

#[derive(Clone, Debug)]
pub(crate) struct DisjointSets {
    parents: Vec<u32>,
}

impl DisjointSets {
    /// `count` sets of one number each.
    pub(crate) fn new(count: usize) -> Self {
        Self { parents: (0..count as u32).collect() }
    }

    /// The lowest number of the set of `member`.
    pub(crate) fn root(&mut self, mut member: u32) -> u32 {
        // Path halving keeps the paths short.
        while self.parents[member as usize] != member {
            let grandparent = self.parents[self.parents[member as usize] as usize];
            self.parents[member as usize] = grandparent;
            member = grandparent;
        }
        member
    }

    /// Makes the sets of two numbers one.
    pub(crate) fn join(&mut self, one: u32, other: u32) {
        let (one, other) = (self.root(one), self.root(other));
        self.parents[one.max(other) as usize] = one.min(other);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joined_numbers_share_the_lowest_root() {
        let mut sets = DisjointSets::new(6);
        sets.join(5, 3);
        sets.join(3, 1);
        sets.join(4, 0);
        let roots: Vec<_> = (0..6).map(|i| sets.root(i)).collect();
        assert_eq!(roots, [0, 1, 2, 1, 0, 1]);
    }
}
