//! Paths as a tree: those that met the same things in the same order share branches.

use super::{luminance, material_name, object_name};
use luch::image::Rgb;
use luch::render::{FollowedPath, PathVertex};
use luch::scene::{Id, Material, Scene};

/// What a branch met.
type Met = Option<(u32, Id<Material>)>;

/// All paths that met the same objects up to here.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// Object and material; `None` beyond the scene, and at the root.
    pub met: Option<(u32, Id<Material>)>,
    /// How many paths came here.
    pub paths: u64,
    /// Part of the pixel's luminance that they come upon here by themselves.
    pub found: f64,
    /// Part that lamps send when asked from here.
    pub asked: f64,
    /// Where they went on to, what matters most first.
    pub children: Vec<Branch>,
}

impl Branch {
    fn new(met: Met) -> Self {
        Self { met, paths: 0, found: 0.0, asked: 0.0, children: Vec::new() }
    }

    /// The tree of some paths; `whole` is the luminance of the pixel.
    pub(super) fn of(paths: &[FollowedPath], whole: f64) -> Self {
        let mut root = Self::new(None);
        let unit = if whole > 0.0 { 1.0 / (whole * paths.len() as f64) } else { 0.0 };
        for path in paths {
            root.paths += 1;
            root.add(&path.vertices, unit);
        }
        root.sort();
        root
    }

    fn add(&mut self, vertices: &[PathVertex], unit: f64) {
        let mut branch = self;
        for vertex in vertices {
            let met = vertex.surface.map(|surface| (surface.instance, surface.material));
            let place = branch.children.iter().position(|child| child.met == met).unwrap_or_else(|| {
                branch.children.push(Branch::new(met));
                branch.children.len() - 1
            });
            branch = &mut branch.children[place];
            let part = |light: Option<Rgb>| {
                light.map_or(0.0, |light| luminance(light.to_array().map(f64::from))) * unit
            };
            branch.paths += 1;
            branch.found += part(vertex.found.map(|found| found.contribution));
            branch.asked += part(vertex.asked.map(|asked| asked.contribution));
        }
    }

    /// Part of the pixel's luminance that is found here and further on.
    pub fn share(&self) -> f64 {
        let mut share = 0.0;
        let mut open = vec![self];
        while let Some(branch) = open.pop() {
            share += branch.found + branch.asked;
            open.extend(&branch.children);
        }
        share
    }

    /// Orders children everywhere; without recursion, since paths may be long.
    fn sort(&mut self) {
        let mut open = vec![self];
        while let Some(branch) = open.pop() {
            branch.children.sort_by_cached_key(|child| {
                // Shares are positive: their bits are in their order.
                (std::cmp::Reverse(child.share().max(0.0).to_bits()), std::cmp::Reverse(child.paths))
            });
            open.extend(&mut branch.children);
        }
    }

    /// The tree in lines: branches with at least `least` of the light, to `depth` objects.
    pub fn to_text(&self, scene: &Scene, depth: usize, least: f64) -> String {
        let mut text = format!("camera  {} paths\n", self.paths);
        self.write(scene, depth, least, &mut String::new(), &mut text);
        text
    }

    fn write(&self, scene: &Scene, depth: usize, least: f64, indent: &mut String, text: &mut String) {
        if depth == 0 {
            return;
        }
        let shown = self.children.iter().take_while(|child| child.share() >= least).count();
        // One of many alike says nothing alone.
        let rest = &self.children[shown..];
        for (place, child) in self.children[..shown].iter().enumerate() {
            let is_last = place + 1 == shown && rest.is_empty();
            *text +=
                &format!("{indent}{} {}\n", if is_last { "└─" } else { "├─" }, child.line(scene, depth == 1));
            let length = indent.len();
            indent.push_str(if is_last { "   " } else { "│  " });
            child.write(scene, depth - 1, least, indent, text);
            indent.truncate(length);
        }
        if !rest.is_empty() {
            let (share, paths) = rest
                .iter()
                .fold((0.0, 0), |(share, paths), child| (share + child.share(), paths + child.paths));
            *text += &format!("{indent}└─ {} more: {paths} paths, {}\n", rest.len(), percent(share));
        }
    }

    fn line(&self, scene: &Scene, is_end: bool) -> String {
        let what = match self.met {
            None => "beyond the scene".to_owned(),
            Some((instance, material)) => {
                let (object, material) = (object_name(scene, instance), material_name(scene, material));
                if object == material { object } else { format!("{object} ({material})") }
            }
        };
        let share = self.share();
        let mut line = format!("{what}  {} paths, {}", self.paths, percent(share));
        let further = share - self.found - self.asked;
        let parts: Vec<String> =
            [("met here", self.found), ("lamps asked", self.asked), ("further on", further)]
                .iter()
                .filter(|(_, part)| *part > 5e-5)
                .map(|(name, part)| format!("{name} {}", percent(*part)))
                .collect();
        if parts.len() > 1 || is_end && !parts.is_empty() {
            line += &format!(": {}", parts.join(", "));
        }
        line
    }
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}
