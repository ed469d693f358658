//! The tree of nodes: who is whose child, and where every node is in the world.

use super::document::Document;
use super::json::Json;
use super::notices::Notices;
use crate::Problem;
use glam::{DAffine3, DMat4, DQuat, DVec3};

/// The nodes of a document.
#[derive(Debug)]
pub(super) struct Hierarchy {
    children: Vec<Vec<usize>>,
    parents: Vec<Option<usize>>,
    /// From each node's coordinates to the world's.
    pub(super) world: Vec<DAffine3>,
}

impl Hierarchy {
    /// Checks that the nodes are trees (each has one parent at most, none is its own ancestor) and places them.
    pub(super) fn build(document: &Document, notices: &mut Notices) -> Result<Self, Problem> {
        let nodes = &document.nodes;
        let mut parents: Vec<Option<usize>> = vec![None; nodes.len()];
        let mut children = Vec::with_capacity(nodes.len());
        for (parent, json) in nodes.iter().enumerate() {
            let mut own = Vec::new();
            for reference in json.list("children")?.iter() {
                let child = reference.reference(nodes)?;
                if let Some(other) = parents[child] {
                    let message = format!("node {child} already is a child of node {other}");
                    return Err(reference.problem(message));
                }
                parents[child] = Some(parent);
                own.push(child);
            }
            children.push(own);
        }
        let mut hierarchy = Self { children, parents, world: vec![DAffine3::IDENTITY; nodes.len()] };
        let roots: Vec<usize> = hierarchy.roots().collect();
        let order = hierarchy.depth_first(&roots);
        if order.len() < nodes.len() {
            // With one parent each, whatever no root leads to hangs on a ring.
            let mut reached = vec![false; nodes.len()];
            order.iter().for_each(|&node| reached[node] = true);
            let lost = reached.iter().position(|&reached| !reached).unwrap_or(0);
            return Err(nodes
                .at(lost)
                .problem("the node is among its own ancestors, or below a node that is"));
        }
        for node in order {
            let parent = hierarchy.parents[node].map_or(DAffine3::IDENTITY, |parent| hierarchy.world[parent]);
            hierarchy.world[node] = parent * local_transform(&nodes.at(node), notices)?;
        }
        Ok(hierarchy)
    }

    fn roots(&self) -> impl Iterator<Item = usize> {
        (0..self.parents.len()).filter(|&node| self.parents[node].is_none())
    }

    /// Nodes below `roots`, parents first, in the order of the file.
    fn depth_first(&self, roots: &[usize]) -> Vec<usize> {
        let mut waiting: Vec<usize> = roots.iter().rev().copied().collect();
        let mut order = Vec::new();
        while let Some(node) = waiting.pop() {
            order.push(node);
            waiting.extend(self.children[node].iter().rev());
        }
        order
    }

    /// The nodes of the scene that is shown: the default one, else the first, else all.
    pub(super) fn shown(&self, document: &Document, notices: &mut Notices) -> Result<Vec<usize>, Problem> {
        let scenes = document.root.list("scenes")?;
        let chosen = document.root.get("scene")?;
        let index = chosen.as_ref().map_or(Ok(0), |scene| scene.reference(&scenes))?;
        if scenes.is_empty() {
            return Ok(self.depth_first(&self.roots().collect::<Vec<_>>()));
        }
        if scenes.len() > 1 {
            let message = format!("the file has {} scenes; scene {index} alone is shown", scenes.len());
            notices.add(scenes.path(), message);
        }
        let scene = scenes.at(index);
        scene.name()?;
        let mut is_listed = vec![false; document.nodes.len()];
        let mut roots = Vec::new();
        for reference in scene.list("nodes")?.iter() {
            let node = reference.reference(&document.nodes)?;
            if let Some(parent) = self.parents[node] {
                let message = format!("node {node} is a child of node {parent}; a scene lists roots only");
                return Err(reference.problem(message));
            }
            if std::mem::replace(&mut is_listed[node], true) {
                return Err(reference.problem(format!("node {node} is listed twice")));
            }
            roots.push(node);
        }
        Ok(self.depth_first(&roots))
    }
}

/// From a node's coordinates to its parent's.
fn local_transform(json: &Json, notices: &mut Notices) -> Result<DAffine3, Problem> {
    let Some(matrix) = json.get("matrix")? else {
        let translation = json.numbers_or("translation", [0.0; 3])?;
        let rotation = json.numbers_or("rotation", [0.0, 0.0, 0.0, 1.0])?;
        let scale = json.numbers_or("scale", [1.0; 3])?;
        return Ok(placed(translation, rotation, scale));
    };
    let matrix = DMat4::from_cols_array(&matrix.numbers()?);
    if matrix.row(3) != glam::DVec4::W {
        notices.add(json.path(), "the last row of the matrix is not 0 0 0 1; it is ignored");
    }
    Ok(DAffine3::from_mat4(matrix))
}

/// Scale, then rotation (a quaternion x, y, z, w of any length; no rotation if it has none), then translation.
pub(super) fn placed(translation: [f64; 3], rotation: [f64; 4], scale: [f64; 3]) -> DAffine3 {
    let rotation = DQuat::from_array(rotation);
    let rotation = if rotation.length() > 1e-20 { rotation.normalize() } else { DQuat::IDENTITY };
    DAffine3::from_scale_rotation_translation(DVec3::from(scale), rotation, translation.into())
}
