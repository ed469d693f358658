//! √3-subdivision (Kobbelt 2000): a vertex in the middle of every triangle, every old edge turned. Two steps divide each edge
//! into three.
//!
//! Borders, sharp edges and edges where more than two faces meet are not turned. The second step of two divides
//! them into three, by the cubic B-spline with three pieces, and the vertices on them move along with it.

use glam::{DVec3, Vec2, Vec3, Vec4};

use super::channel::Channel;
use super::masks::{Blend, Feature, Rule, face_points, feature};
use super::topology::{Topology, list};
use super::{Settings, UvRule, sharpen};
use crate::PolygonMesh;
use crate::polygon_mesh::{CornerAttribute, Crease};

/// Subdivides a mesh of triangles.
pub(super) fn subdivided(mut mesh: PolygonMesh, settings: &Settings, with_normals: bool) -> PolygonMesh {
    let uv_sets = std::mem::take(&mut mesh.uv_sets);
    let colors = std::mem::take(&mut mesh.colors);
    let mut topology = Topology::new(&mesh.face_ends, mesh.corners.clone(), mesh.positions.len() as u32);
    sharpen(&mut topology, &mesh.creases, &mesh.sharp_vertices, settings.border);
    let has_creases = !mesh.creases.is_empty();
    let linear = |topology: &Topology| (topology.clone(), Rule::Linear, UvRule::Linear);
    let (positions, rule, uv_rule) = linear(&topology);
    let mut uvs: Vec<_> = uv_sets
        .iter()
        .map(|set| Channel::new(&mesh, &positions, set, Vec2::as_dvec2, rule, uv_rule))
        .collect();
    let mut color = Channel::new(&mesh, &positions, &colors, Vec4::as_dvec4, rule, uv_rule);
    // Seams are sharp, and what is sharp stays so.
    let seams = uvs.iter().filter_map(|c| c.own.as_ref()).chain(color.own.as_ref());
    let mut is_sharp: Vec<bool> = topology.edge_sharpness.iter().map(|s| *s > 0.0).collect();
    for own in seams {
        for (half, &edge) in own.corner_edges.iter().enumerate() {
            is_sharp[topology.corner_edges[half] as usize] |= own.edge_sharpness[edge as usize] > 0.0;
        }
    }
    set_sharp(&mut topology, &is_sharp);
    let mut places: Vec<DVec3> = mesh.positions.iter().map(|p| p.as_dvec3()).collect();
    for level in 0..settings.levels {
        let step = Step::new(&topology, level % 2 == 1);
        places = step.values(&topology, &places, true);
        for uv in &mut uvs {
            follow(uv, &topology, &step, level % 2 == 1);
        }
        follow(&mut color, &topology, &step, level % 2 == 1);
        mesh.slots = mesh.slots.iter().flat_map(|slot| [*slot; 3]).collect();
        mesh.smoothing_groups = mesh.smoothing_groups.iter().flat_map(|group| [*group; 3]).collect();
        topology = step.next_topology(&topology);
    }
    if settings.limit {
        places = limit_positions(&topology, &places);
    }
    mesh.positions = places.iter().map(|p| p.as_vec3()).collect();
    mesh.face_ends = (1..=topology.face_count() as u32).map(|face| face * 3).collect();
    mesh.creases.clear();
    if has_creases {
        let edges = topology.edge_ends.iter().zip(&topology.edge_sharpness).enumerate();
        let sharp = edges.filter(|(edge, (_, s))| **s > 0.0 && topology.halves_of(*edge as u32).len() == 2);
        let crease = |(_, (&vertices, _))| Crease { vertices, sharpness: f32::INFINITY };
        mesh.creases = sharp.map(crease).collect();
    }
    mesh.uv_sets = uvs.into_iter().map(|uv| uv.into_attribute(glam::DVec2::as_vec2)).collect();
    mesh.colors = color.into_attribute(glam::DVec4::as_vec4);
    mesh.corners = topology.corners;
    mesh.normals = CornerAttribute::default();
    if with_normals {
        mesh.normals = smooth_normals(&mesh);
    }
    mesh
}

fn smooth_normals(mesh: &PolygonMesh) -> CornerAttribute<Vec3> {
    let mut sums = vec![DVec3::ZERO; mesh.positions.len()];
    for triangle in mesh.corners.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|k| mesh.positions[triangle[k] as usize].as_dvec3());
        let normal = (b - a).cross(c - a);
        triangle.iter().for_each(|&v| sums[v as usize] += normal);
    }
    CornerAttribute::per_position(sums.into_iter().map(crate::normals::unit_or_z).collect())
}

fn set_sharp(topology: &mut Topology, is_sharp: &[bool]) {
    let sharpness = is_sharp.iter().map(|&sharp| if sharp { f32::INFINITY } else { 0.0 });
    topology.edge_sharpness = sharpness.collect();
}

/// Takes a channel one step down. Its edges are cut where those of the positions are.
fn follow<V: Blend>(channel: &mut Channel<V>, positions: &Topology, step: &Step, cuts_edges: bool) {
    if channel.values.is_empty() {
        return;
    }
    let Some(own) = &mut channel.own else {
        channel.values = step.values(positions, &channel.values, false);
        return;
    };
    let mut is_sharp = vec![false; own.edge_ends.len()];
    for (half, &edge) in own.corner_edges.iter().enumerate() {
        is_sharp[edge as usize] |= positions.edge_sharpness[positions.corner_edges[half] as usize] > 0.0;
    }
    set_sharp(own, &is_sharp);
    let own_step = Step::new(own, cuts_edges);
    channel.values = own_step.values(own, &channel.values, false);
    *own = own_step.next_topology(own);
}

/// The triangles of one step, and what stands for each of their corners.
struct Step {
    /// Vertices: those of before, then two on each edge that is cut, first the one nearer to its first end, then the
    /// middles of faces.
    corners: Vec<u32>,
    /// For each edge the number of the first of its two vertices, if it is cut.
    cuts: Vec<Option<u32>>,
    /// For each face the vertex that stands in its middle.
    middles: Vec<u32>,
    vertex_count: u32,
}

impl Step {
    /// The triangles of an odd or, if `cuts_edges`, an even step.
    fn new(topology: &Topology, cuts_edges: bool) -> Self {
        let mut vertex_count = topology.vertex_count;
        let cuts: Vec<Option<u32>> = topology
            .edge_sharpness
            .iter()
            .map(|&sharpness| {
                let cut = (cuts_edges && sharpness > 0.0).then_some(vertex_count);
                vertex_count += if cut.is_some() { 2 } else { 0 };
                cut
            })
            .collect();
        let mut step = Self { corners: Vec::new(), cuts, middles: Vec::new(), vertex_count };
        for face in 0..topology.face_count() as u32 {
            // In a face with one edge that is cut, the vertex across takes the place of the middle.
            let middle = match step.only_cut(topology, topology.face_start(face)) {
                Some(cut) => topology.corners[topology.previous(cut) as usize],
                None => {
                    step.vertex_count += 1;
                    step.vertex_count - 1
                }
            };
            step.middles.push(middle);
        }
        let mut corners = Vec::with_capacity(topology.corners.len() * 3);
        for half in 0..topology.corners.len() as u32 {
            step.triangles_of(topology, half, &mut corners);
        }
        step.corners = corners;
        step
    }

    fn triangles_of(&self, topology: &Topology, half: u32, corners: &mut Vec<u32>) {
        let [a, b] = [half, topology.next(half)].map(|corner| topology.corners[corner as usize]);
        let edge = topology.corner_edges[half as usize];
        let middle = self.middles[topology.face_of(half) as usize];
        if let Some([near, far]) = self.cut_along(topology, half) {
            if middle < topology.vertex_count {
                corners.extend([near, far, middle]);
            } else {
                corners.extend([[a, near, middle], [near, far, middle], [far, b, middle]].as_flattened());
            }
            return;
        }
        match *topology.halves_of(edge) {
            [one, other] if topology.edge_sharpness[edge as usize] <= 0.0 => {
                let across = if one == half { other } else { one };
                corners.extend([a, self.middle_toward(topology, across), self.middle_toward(topology, half)]);
            }
            _ => corners.extend([a, b, middle]),
        }
    }

    /// The two new vertices of a half-edge in its direction.
    fn cut_along(&self, topology: &Topology, half: u32) -> Option<[u32; 2]> {
        let edge = topology.corner_edges[half as usize] as usize;
        let first = self.cuts[edge]?;
        let is_forward = topology.edge_ends[edge][0] == topology.corners[half as usize];
        Some(if is_forward { [first, first + 1] } else { [first + 1, first] })
    }

    /// The half-edge of a face that is its only one to be cut.
    fn only_cut(&self, topology: &Topology, half: u32) -> Option<u32> {
        let start = topology.face_start(topology.face_of(half));
        let mut cut =
            (start..start + 3).filter(|&h| self.cuts[topology.corner_edges[h as usize] as usize].is_some());
        let only = cut.next();
        if cut.next().is_some() { None } else { only }
    }

    /// The vertex of a face that a turned edge runs to.
    fn middle_toward(&self, topology: &Topology, half: u32) -> u32 {
        let cut = self.only_cut(topology, half);
        let Some([near, far]) = cut.and_then(|cut| self.cut_along(topology, cut)) else {
            return self.middles[topology.face_of(half) as usize];
        };
        // The half-edge after the cut one has the farther new vertex, the one before it the nearer.
        if cut.map(|cut| topology.next(cut)) == Some(half) { far } else { near }
    }

    /// The values of the next level; `is_moved` applies the rule for positions.
    fn values<V: Blend>(&self, topology: &Topology, values: &[V], is_moved: bool) -> Vec<V> {
        let cuts_edges = self.cuts.iter().any(Option::is_some);
        let mut all = list(topology.vertex_count as usize, |vertex| {
            if is_moved { moved(topology, values, vertex, cuts_edges) } else { values[vertex as usize] }
        });
        for (edge, _) in self.cuts.iter().enumerate().filter(|(_, cut)| cut.is_some()) {
            let [a, b] = topology.edge_ends[edge];
            for [near, far] in [[a, b], [b, a]] {
                let [own, other] = [near, far].map(|v| values[v as usize]);
                // The curve goes on past the nearer end.
                let beyond = match feature(topology, near, |sharpness| sharpness) {
                    Feature::Crease(ends) if is_moved => ends.into_iter().find(|end| *end != far),
                    _ => None,
                };
                all.push(match beyond {
                    Some(beyond) => (values[beyond as usize] + own * 16.0 + other * 10.0) * (1.0 / 27.0),
                    None => (own * 2.0 + other) * (1.0 / 3.0),
                });
            }
        }
        let middles = face_points(topology, values).into_iter().zip(&self.middles);
        all.extend(middles.filter(|(_, number)| **number >= topology.vertex_count).map(|(value, _)| value));
        all
    }

    /// The next level, with its sharp edges and vertices.
    fn next_topology(&self, topology: &Topology) -> Topology {
        let face_ends: Vec<u32> = (1..=(self.corners.len() / 3) as u32).map(|face| face * 3).collect();
        let mut next = Topology::new(&face_ends, self.corners.clone(), self.vertex_count);
        let mut sharp = self.sharp_edges(topology);
        sharp.iter_mut().for_each(|edge| edge.sort_unstable());
        sharp.sort_unstable();
        for edge in 0..next.edge_ends.len() {
            if sharp.binary_search(&next.edge_ends[edge]).is_ok() {
                next.edge_sharpness[edge] = f32::INFINITY;
            }
        }
        next.vertex_sharpness[..topology.vertex_sharpness.len()].copy_from_slice(&topology.vertex_sharpness);
        next
    }

    /// The sharp edges of the next level, from the new numbers of their ends; edges that are cut become three.
    fn sharp_edges(&self, topology: &Topology) -> Vec<[u32; 2]> {
        let mut sharp = Vec::new();
        for (edge, &[a, b]) in topology.edge_ends.iter().enumerate() {
            match self.cuts[edge] {
                Some(first) => sharp.extend([[a, first], [first, first + 1], [first + 1, b]]),
                None if topology.edge_sharpness[edge] > 0.0 => sharp.push([a, b]),
                None => {}
            }
        }
        sharp
    }
}

fn moved<V: Blend>(topology: &Topology, values: &[V], vertex: u32, cuts_edges: bool) -> V {
    let own = values[vertex as usize];
    let edges = topology.edges_at(vertex);
    match feature(topology, vertex, |sharpness| sharpness) {
        Feature::Crease([a, b]) if cuts_edges => {
            (own * 19.0 + (values[a as usize] + values[b as usize]) * 4.0) * (1.0 / 27.0)
        }
        Feature::Smooth if !edges.is_empty() => {
            let valence = edges.len() as f64;
            let alpha = (4.0 - 2.0 * libm::cos(std::f64::consts::TAU / valence)) / 9.0;
            let sum = edges
                .iter()
                .fold(V::default(), |sum, &edge| sum + values[topology.across(edge, vertex) as usize]);
            own * (1.0 - alpha) + sum * (alpha / valence)
        }
        _ => own,
    }
}

/// The limit of a smooth vertex of valence n (Kobbelt 2000, section 4): it moves to a blend with the mean of its neighbours.
fn limit_positions(topology: &Topology, places: &[DVec3]) -> Vec<DVec3> {
    list(topology.vertex_count as usize, |vertex| {
        let own = places[vertex as usize];
        let edges = topology.edges_at(vertex);
        match feature(topology, vertex, |sharpness| sharpness) {
            Feature::Smooth if !edges.is_empty() => {
                let valence = edges.len() as f64;
                let alpha = (4.0 - 2.0 * libm::cos(std::f64::consts::TAU / valence)) / 9.0;
                let mean = edges.iter().map(|&e| places[topology.across(e, vertex) as usize]).sum::<DVec3>()
                    / valence;
                let weight = 3.0 * alpha / (1.0 + 3.0 * alpha);
                own * (1.0 - weight) + mean * weight
            }
            Feature::Crease([a, b]) => (own * 4.0 + places[a as usize] + places[b as usize]) / 6.0,
            _ => own,
        }
    })
}
