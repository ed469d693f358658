//! What speaks against a move: attributes that would be torn, triangles that would turn over, topology that would change.

use super::collapse::Collapser;
use super::fans::Spoke;
use super::start::Freedom;

/// A triangle may turn by this cosine at most.
const LEAST_COSINE: f64 = 0.25;
/// Where two neighbours have more triangles than this about them, nothing moves onto either: looking would take too long.
const MOST_SPOKES: usize = 1 << 10;

impl Collapser {
    /// Whether a vertex may move onto a neighbour. `others` is used to look at fans.
    pub(super) fn allows(
        &self,
        spokes: &[Spoke],
        others: &mut Vec<Spoke>,
        from: u32,
        to: u32,
        freedom: Freedom,
    ) -> bool {
        self.knows_wedges(spokes, to)
            && !self.turns_over(spokes, from, to)
            && self.keeps_topology(spokes, others, from, to, freedom)
    }

    /// Every wedge of the source must know its place at the target: one only.
    fn knows_wedges(&self, spokes: &[Spoke], to: u32) -> bool {
        if self.wedges.is_empty() {
            return true;
        }
        let links = self.links(spokes, to);
        if let [Some(one), Some(other)] = links
            && one[0] == other[0]
            && one[1] != other[1]
        {
            return false;
        }
        spokes.iter().all(|spoke| {
            let [triangle, corner] = spoke.corner_after(0);
            links.iter().flatten().any(|link| link[0] == self.wedges[triangle][corner])
        })
    }

    /// The wedges at both ends of an edge, in each of its triangles; none if there are no attributes.
    pub(super) fn links(&self, spokes: &[Spoke], to: u32) -> [Option<[u32; 2]>; 2] {
        if self.wedges.is_empty() {
            return [None; 2];
        }
        let mut links = spokes.iter().filter_map(|spoke| {
            let end = spoke.ends.iter().position(|&end| end == to)?;
            let at = |steps: usize| {
                let [triangle, corner] = spoke.corner_after(steps);
                self.wedges[triangle][corner]
            };
            Some([at(0), at(end + 1)])
        });
        [links.next(), links.next()]
    }

    fn turns_over(&self, spokes: &[Spoke], from: u32, to: u32) -> bool {
        let [own, goal] = [from, to].map(|v| self.vertices[v as usize].place);
        spokes.iter().any(|spoke| {
            if spoke.ends.contains(&to) {
                return false;
            }
            let [b, c] = spoke.ends.map(|v| self.vertices[v as usize].place);
            let before = (b - own).cross(c - own);
            let after = (b - goal).cross(c - goal);
            let (product, squares) = (before.dot(after), before.length_squared() * after.length_squared());
            // A triangle without area may become any, but not the other way round.
            after.length_squared() == 0.0
                || squares > 0.0
                    && (product <= 0.0 || product * product < LEAST_COSINE * LEAST_COSINE * squares)
        })
    }

    /// The link condition: the only vertices next to both are the tips of the triangles on the edge. `others` is used to look at fans.
    fn keeps_topology(
        &self,
        spokes: &[Spoke],
        others: &mut Vec<Spoke>,
        from: u32,
        to: u32,
        freedom: Freedom,
    ) -> bool {
        let mut tips = [u32::MAX; 2];
        let mut count = 0;
        for spoke in spokes {
            if let Some(end) = spoke.ends.iter().position(|&end| end == to) {
                if count == 2 {
                    return false;
                }
                tips[count] = spoke.ends[1 - end];
                count += 1;
            }
        }
        if count != if freedom == Freedom::Border { 1 } else { 2 } {
            return false;
        }
        let closes_up = spokes.len() == 3 && count == 2;
        if !self.fans.gather_few(&self.triangles, to, others, MOST_SPOKES) {
            // Very many triangles: so the neighbours of the source are asked.
            let ends = spokes.iter().flat_map(|spoke| spoke.ends);
            let mut is_next_to_target = |end: u32| {
                !self.fans.gather_few(&self.triangles, end, others, MOST_SPOKES)
                    || others.iter().any(|spoke| spoke.ends.contains(&to))
            };
            return !closes_up
                && spokes.len() <= MOST_SPOKES
                && !ends.into_iter().any(|end| end != to && !tips.contains(&end) && is_next_to_target(end));
        }
        let mut rest = others.iter().filter(|spoke| !spoke.ends.contains(&from));
        let is_common =
            |end: u32| !tips.contains(&end) && spokes.iter().any(|spoke| spoke.ends.contains(&end));
        if rest.clone().any(|spoke| spoke.ends.iter().any(|&end| is_common(end))) {
            return false;
        }
        // The last triangle of a piece stays; and of a tetrahedron two faces on each other would be left.
        let leaves_some = spokes.len() > count || rest.clone().next().is_some();
        leaves_some && !(closes_up && rest.any(|spoke| tips.iter().all(|tip| spoke.ends.contains(tip))))
    }
}
