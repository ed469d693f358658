//! The triangles about each vertex, kept up to date while vertices move onto others.

/// What stands in the place of a triangle that has collapsed.
pub(super) const GONE: [u32; 3] = [u32::MAX; 3];
const NONE: u32 = u32::MAX;

/// Corners `3 t + k` about each vertex. A vertex that took over another has the other's list behind its own.
pub(super) struct Fans {
    starts: Vec<u32>,
    corners: Vec<u32>,
    /// The vertex whose list follows.
    next: Vec<u32>,
    /// The last vertex of the chain that begins here.
    last: Vec<u32>,
}

/// A triangle seen from one of its corners.
#[derive(Clone, Copy)]
pub(super) struct Spoke {
    pub(super) corner: u32,
    /// The two other vertices, counter-clockwise.
    pub(super) ends: [u32; 2],
}

impl Spoke {
    #[inline]
    pub(super) fn triangle(self) -> usize {
        self.corner as usize / 3
    }

    /// The corner so many steps further on in the triangle.
    #[inline]
    pub(super) fn corner_after(self, steps: usize) -> [usize; 2] {
        [self.triangle(), (self.corner as usize % 3 + steps) % 3]
    }
}

impl Fans {
    pub(super) fn of(triangles: &[[u32; 3]], count: usize) -> Self {
        // Lists are filled from their ends, so that the counts become the starts.
        let mut starts = vec![0u32; count + 1];
        let flat = triangles.as_flattened();
        flat.iter().for_each(|&v| starts[v as usize] += 1);
        let mut sum = 0;
        for start in &mut starts {
            sum += *start;
            *start = sum;
        }
        let mut corners = vec![0; flat.len()];
        for (corner, &v) in flat.iter().enumerate().rev() {
            let start = &mut starts[v as usize];
            *start -= 1;
            corners[*start as usize] = corner as u32;
        }
        Self { starts, corners, next: vec![NONE; count], last: (0..count as u32).collect() }
    }

    /// Looks at each triangle that is left about a vertex, unless more than `most` have to be; tells whether that was enough.
    #[inline(always)]
    pub(super) fn visit(
        &self,
        triangles: &[[u32; 3]],
        vertex: u32,
        mut most: usize,
        mut look: impl FnMut(Spoke),
    ) -> bool {
        let mut segment = vertex;
        while segment != NONE {
            let range = self.starts[segment as usize] as usize..self.starts[segment as usize + 1] as usize;
            if range.len() > most {
                return false;
            }
            most -= range.len();
            for &corner in &self.corners[range] {
                let [a, b, c] = triangles[corner as usize / 3];
                if a != GONE[0] {
                    let ends = if a == vertex {
                        [b, c]
                    } else if b == vertex {
                        [c, a]
                    } else {
                        [a, b]
                    };
                    look(Spoke { corner, ends });
                }
            }
            segment = self.next[segment as usize];
        }
        true
    }

    /// Puts the triangles that are left about a vertex into a list.
    pub(super) fn gather(&self, triangles: &[[u32; 3]], vertex: u32, spokes: &mut Vec<Spoke>) {
        spokes.clear();
        self.visit(triangles, vertex, usize::MAX, |spoke| spokes.push(spoke));
    }

    /// The same, unless more than `most` have to be looked at; tells whether that was enough.
    pub(super) fn gather_few(
        &self,
        triangles: &[[u32; 3]],
        vertex: u32,
        spokes: &mut Vec<Spoke>,
        most: usize,
    ) -> bool {
        spokes.clear();
        self.visit(triangles, vertex, most, |spoke| spokes.push(spoke))
    }

    /// Hands the list of a vertex that moved to the other.
    pub(super) fn hand_over(&mut self, from: u32, to: u32) {
        self.next[self.last[to as usize] as usize] = from;
        self.last[to as usize] = self.last[from as usize];
    }
}
