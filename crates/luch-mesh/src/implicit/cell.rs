//! One cube between eight samples: how its corners, edges and faces are numbered.
//!
//! Corner `c` lies at x = bit 0, y = bit 1, z = bit 2 of `c`. Edge `4 a + n` runs along axis `a`; bit 0 of `n` is its place along
//! the next axis in the order x, y, z without `a`, bit 1 that along the other. Face `2 a + s` is crossed by axis `a` on side `s`.

/// The corners of a cell.
pub(super) const CORNERS: usize = 8;
/// The edges of a cell.
pub(super) const EDGES: usize = 12;
/// The faces of a cell.
pub(super) const FACES: usize = 6;

/// The two axes other than `axis`, rising.
pub(super) const fn other_axes(axis: usize) -> [usize; 2] {
    match axis {
        0 => [1, 2],
        1 => [0, 2],
        _ => [0, 1],
    }
}

/// The corners where an edge begins and ends, along its axis.
pub(super) const fn edge_corners(edge: usize) -> [usize; 2] {
    let (axis, place) = (edge / 4, edge % 4);
    let [one, other] = other_axes(axis);
    let start = (place & 1) << one | (place >> 1) << other;
    [start, start | 1 << axis]
}

/// The edge between two neighbouring corners.
pub(super) const fn edge_between(a: usize, b: usize) -> usize {
    let axis = (a ^ b).trailing_zeros() as usize;
    let [one, other] = other_axes(axis);
    axis * 4 + (a >> one & 1) + 2 * (a >> other & 1)
}

/// The two faces of an edge, as bits.
pub(super) const fn faces_of_edge(edge: usize) -> u8 {
    let [one, other] = other_axes(edge / 4);
    let place = edge % 4;
    1 << (2 * one + (place & 1)) | 1 << (2 * other + (place >> 1))
}

/// The corners of a face, counter-clockwise seen from outside the cell.
pub(super) const fn face_corners(face: usize) -> [usize; 4] {
    let (axis, side) = (face / 2, face % 2);
    // From axis `a` the axes a + 1, a + 2 (cyclic) turn counter-clockwise, seen from its positive end.
    let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
    let base = side << axis;
    if side == 1 {
        [base, base | u, base | u | v, base | v]
    } else {
        [base, base | v, base | u | v, base | u]
    }
}

/// The middle of an edge, in halves of the cell's side.
pub(super) const fn edge_middle(edge: usize) -> [i32; 3] {
    let [start, end] = edge_corners(edge);
    let mut middle = [0; 3];
    let mut axis = 0;
    while axis < 3 {
        middle[axis] = (start >> axis & 1) as i32 + (end >> axis & 1) as i32;
        axis += 1;
    }
    middle
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_agree_with_each_other() {
        for edge in 0..EDGES {
            let [a, b] = edge_corners(edge);
            assert_eq!(edge_between(a, b), edge);
            assert_eq!(edge_between(b, a), edge);
            let faces: Vec<usize> = (0..FACES)
                .filter(|&face| face_corners(face).contains(&a) && face_corners(face).contains(&b))
                .collect();
            assert_eq!(faces.iter().map(|f| 1u8 << f).sum::<u8>(), faces_of_edge(edge));
        }
        // The first three corners of a face turn so that their normal points outward.
        for face in 0..FACES {
            let at = |corner: usize| glam::Vec3::from([0, 1, 2].map(|axis| (corner >> axis & 1) as f32));
            let [a, b, c, d] = face_corners(face).map(at);
            let mut outward = glam::Vec3::ZERO;
            outward[face / 2] = 2.0 * (face % 2) as f32 - 1.0;
            assert_eq!((b - a).cross(c - a), outward);
            assert_eq!(a + c, b + d);
        }
    }
}
