//! What can be wrong with a mesh, said before anything indexes out of range.

use crate::{Attribute, TriangleMesh};

/// Which list of a mesh a [`Problem`] is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum List {
    /// `positions` and `triangles`.
    Positions,
    /// `normals`.
    Normals,
    /// The uv set of this number.
    Uvs(usize),
    /// `tangents`.
    Tangents,
    /// `colors`.
    Colors,
}

impl std::fmt::Display for List {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Positions => f.write_str("positions"),
            Self::Normals => f.write_str("normals"),
            Self::Uvs(set) => write!(f, "uv set {set}"),
            Self::Tangents => f.write_str("tangents"),
            Self::Colors => f.write_str("colors"),
        }
    }
}

/// One thing that is wrong with a mesh: the first case and how many there are.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Problem {
    /// Triangles name values that do not exist.
    #[error(
        "triangle {triangle} uses {list} number {index}, but there are only {available} ({count} such corners)"
    )]
    IndexOutOfRange {
        /// The list that is too short.
        list: List,
        /// The first triangle that does so.
        triangle: usize,
        /// The index it gives.
        index: u32,
        /// How many values there are.
        available: usize,
        /// How many corners do so.
        count: usize,
    },
    /// Values run parallel to the positions but are not as many, or an index set is not one entry per triangle.
    #[error("{list}: {found} entries where {expected} are needed")]
    WrongLength {
        /// The list.
        list: List,
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// Values are infinite or not numbers.
    #[error("{list} number {index} is not finite ({count} such values)")]
    NotFinite {
        /// The list.
        list: List,
        /// The first such value.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// `slots` is neither empty nor one entry per triangle.
    #[error("{found} material slots for {triangles} triangles")]
    WrongSlotCount {
        /// How many slots there are.
        found: usize,
        /// How many triangles there are.
        triangles: usize,
    },
}

impl TriangleMesh {
    /// Everything that breaks the promises of the type; empty if all is well.
    ///
    /// A mesh without problems can be given to every function of this crate without a panic.
    pub fn validate(&self) -> Vec<Problem> {
        let mut problems = Vec::new();
        problems.extend(out_of_range(List::Positions, &self.triangles, self.positions.len()));
        problems.extend(not_finite(List::Positions, &self.positions, |v| v.is_finite()));
        self.check_attribute(List::Normals, &self.normals, |v| v.is_finite(), &mut problems);
        for (set, uvs) in self.uv_sets.iter().enumerate() {
            self.check_attribute(List::Uvs(set), uvs, |v| v.is_finite(), &mut problems);
        }
        self.check_attribute(List::Tangents, &self.tangents, |v| v.is_finite(), &mut problems);
        self.check_attribute(List::Colors, &self.colors, |v| v.is_finite(), &mut problems);
        if !self.slots.is_empty() && self.slots.len() != self.triangles.len() {
            let (found, triangles) = (self.slots.len(), self.triangles.len());
            problems.push(Problem::WrongSlotCount { found, triangles });
        }
        problems
    }

    fn check_attribute<T>(
        &self,
        list: List,
        attribute: &Attribute<T>,
        is_finite: impl Fn(&T) -> bool,
        problems: &mut Vec<Problem>,
    ) {
        let (found, expected) = if !attribute.triangles.is_empty() {
            (attribute.triangles.len(), self.triangles.len())
        } else if !attribute.values.is_empty() {
            (attribute.values.len(), self.positions.len())
        } else {
            (0, 0)
        };
        if found != expected {
            problems.push(Problem::WrongLength { list, found, expected });
        }
        problems.extend(out_of_range(list, &attribute.triangles, attribute.values.len()));
        problems.extend(not_finite(list, &attribute.values, is_finite));
    }
}

fn out_of_range(list: List, triangles: &[[u32; 3]], available: usize) -> Option<Problem> {
    let bad = || {
        let corners = triangles.iter().enumerate().flat_map(|(t, c)| c.iter().map(move |&index| (t, index)));
        corners.filter(|&(_, index)| index as usize >= available)
    };
    let (triangle, index) = bad().next()?;
    Some(Problem::IndexOutOfRange { list, triangle, index, available, count: bad().count() })
}

fn not_finite<T>(list: List, values: &[T], is_finite: impl Fn(&T) -> bool) -> Option<Problem> {
    let index = values.iter().position(|v| !is_finite(v))?;
    Some(Problem::NotFinite { list, index, count: values.iter().filter(|v| !is_finite(v)).count() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate;
    use glam::{Vec2, Vec3};

    #[test]
    fn a_sound_mesh_has_no_problems() {
        assert_eq!(generate::cuboid(Vec3::ONE, [1, 1, 1]).validate(), []);
    }

    #[test]
    fn every_kind_of_problem_is_found_and_counted() {
        let mut mesh = generate::cuboid(Vec3::ONE, [1, 1, 1]);
        mesh.triangles[3] = [0, 99, 98];
        mesh.positions[2].x = f32::NAN;
        mesh.normals.triangles.pop();
        mesh.uv_sets.push(Attribute::per_position(vec![Vec2::ZERO; 3]));
        mesh.slots = vec![0; 5];
        let problems = mesh.validate();
        assert_eq!(
            problems,
            [
                Problem::IndexOutOfRange {
                    list: List::Positions,
                    triangle: 3,
                    index: 99,
                    available: 8,
                    count: 2
                },
                Problem::NotFinite { list: List::Positions, index: 2, count: 1 },
                Problem::WrongLength { list: List::Normals, found: 11, expected: 12 },
                Problem::WrongLength { list: List::Uvs(1), found: 3, expected: 8 },
                Problem::WrongSlotCount { found: 5, triangles: 12 },
            ]
        );
        assert_eq!(
            problems[0].to_string(),
            "triangle 3 uses positions number 99, but there are only 8 (2 such corners)"
        );
    }
}
