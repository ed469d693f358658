//! The report for people.

use std::fmt;

use super::{Class, Report};

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for problem in &self.problems {
            line(f, "problem", problem)?;
        }
        line(f, "triangles", self.triangles)?;
        let mut positions = format!("{}", self.positions);
        for (count, what) in [(self.duplicate_positions, "duplicate"), (self.unused_positions, "unused")] {
            if count > 0 {
                positions += &format!(", {count} {what}");
            }
        }
        line(f, "positions", positions)?;
        line(f, "edges", self.edges)?;
        line(f, "attributes", self.attributes())?;
        if !self.problems.is_empty() {
            return Ok(());
        }
        let [x, y, z] = [0, 1, 2].map(|axis| f64::from(self.most[axis]) - f64::from(self.least[axis]));
        line(f, "size", format!("{x} × {y} × {z} m"))?;
        line(f, "bounds", format!("{:?} to {:?}", self.least, self.most))?;
        line(f, "area", format!("{} m²", self.area))?;
        let note = if self.closed { "" } else { " (of an open mesh: means little)" };
        line(f, "volume", format!("{} m³{note}", self.volume))?;
        if let Some([x, y, z]) = self.center_of_mass {
            line(f, "centre of mass", format!("{x} {y} {z}"))?;
        }
        let verdict = if self.closed { "yes" } else { "no" };
        line(f, "closed", format!("{verdict}, {}", self.verdict))?;
        line(f, "pieces", self.components)?;
        line(f, "Euler number", self.euler_characteristic)?;
        if let Some(genus) = self.genus {
            line(f, "genus", genus)?;
        }
        if self.boundary_loops > 0 {
            let text = format!(
                "{} with {} edges; the one with most has {}, the longest is {} m",
                self.boundary_loops, self.boundary_edges, self.most_boundary_edges, self.longest_boundary
            );
            line(f, "border loops", text)?;
        }
        let faults = [
            ("pieces facing inward", self.inward_components),
            ("edges of more than two triangles", self.non_manifold_edges),
            ("positions where fans touch", self.non_manifold_positions),
            ("edges with flipped neighbours", self.flipped_edges),
            ("triangles with a repeated position", self.collapsed_triangles),
            ("triangles without area", self.degenerate_triangles),
            ("triangles twice", self.duplicate_triangles),
        ];
        for (what, count) in faults.into_iter().filter(|(_, count)| *count > 0) {
            line(f, "fault", format!("{count} {what}"))?;
        }
        if let Some(found) = &self.self_intersections {
            let at_least = if found.is_lower_bound { "at least " } else { "" };
            let mut text = format!("{at_least}{} triangles", found.triangles);
            if let Some([one, other]) = found.first.first() {
                text += &format!(" (the first are {one} and {other})");
            }
            line(f, "self-intersections", text)?;
        }
        line(f, "edge lengths", format!("{} to {} m", self.shortest_edge, self.longest_edge))?;
        histogram(f, &self.edge_lengths)?;
        line(f, "aspects", "longest side × perimeter / (4√3 area)")?;
        histogram(f, &self.aspects)?;
        let memory = &self.memory;
        let text = format!(
            "{} bytes; {} without sharing, {:.2} times as many",
            memory.shared_bytes, memory.unshared_bytes, memory.saving
        );
        line(f, "memory", text)?;
        self.precisions(f)
    }
}

impl Report {
    fn attributes(&self) -> String {
        let mut all: Vec<String> = Vec::new();
        let mut add = |count: usize, what: &str| {
            if count > 0 {
                all.push(format!("{count} {what}"));
            }
        };
        add(self.normals, "normals");
        for (set, count) in self.uvs.iter().enumerate() {
            add(*count, &format!("uvs of set {set}"));
        }
        add(self.tangents, "tangents");
        add(self.colors, "colours");
        if self.material_slots > 1 {
            add(self.material_slots, "material slots");
        }
        if all.is_empty() { "none".to_owned() } else { all.join(", ") }
    }

    fn precisions(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lists = [
            (&self.quantization.positions, "positions", "m"),
            (&self.quantization.uvs, "uvs", "of the picture"),
            (&self.quantization.normals, "normals", "rad"),
        ];
        for (list, what, unit) in lists {
            let all: Vec<String> =
                list.iter().map(|p| format!("{} bits: {:.2e} {unit}", p.bits, p.error)).collect();
            if !all.is_empty() {
                line(f, &format!("coarser {what}"), all.join(", "))?;
            }
        }
        if let Some(bits) = self.quantization.position_bits {
            line(
                f,
                "enough",
                format!("{bits} bits for positions move them by less than a tenth of the shortest edge"),
            )?;
        }
        Ok(())
    }
}

fn line(f: &mut fmt::Formatter<'_>, name: &str, value: impl fmt::Display) -> fmt::Result {
    writeln!(f, "{:<19} {value}", format!("{name}:"))
}

/// A bar for each class, the longest of thirty signs; runs of more than sixteen classes are left out.
fn histogram(f: &mut fmt::Formatter<'_>, classes: &[Class]) -> fmt::Result {
    let most = classes.iter().map(|class| class.count).max().unwrap_or(0).max(1);
    for class in classes.iter().filter(|class| class.count > 0).take(16) {
        let to = class.to.map_or("∞".to_owned(), |to| format!("{to:.3e}"));
        let bar = "▇".repeat((class.count as u128 * 30).div_ceil(u128::from(most)) as usize);
        writeln!(f, "{:<19} {:.3e} … {to:<9} {:>10} {bar}", "", class.from, class.count)?;
    }
    Ok(())
}
