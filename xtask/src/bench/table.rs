//! Speeds of several programs in several rounds, and their ratios.

use std::fmt::Write;

/// Millions of rays a second, in rounds.
#[derive(Default)]
pub(super) struct Speeds {
    rows: Vec<Row>,
    round: usize,
}

/// One set of rays of one mesh.
struct Row {
    mesh: String,
    set: String,
    columns: Vec<Column>,
}

/// One program's speeds, one for each round.
struct Column {
    who: String,
    speeds: Vec<f64>,
}

impl Speeds {
    /// Notes what `who` did in this round.
    pub(super) fn add(&mut self, mesh: &str, set: &str, who: &str, speed: f64) {
        let place = self.rows.iter().position(|row| row.mesh == mesh && row.set == set);
        let row = match place {
            Some(place) => &mut self.rows[place],
            None => {
                self.rows.push(Row { mesh: mesh.into(), set: set.into(), columns: Vec::new() });
                let last = self.rows.len() - 1;
                &mut self.rows[last]
            }
        };
        match row.columns.iter_mut().find(|column| column.who == who) {
            Some(column) => column.speeds.push(speed),
            None => row.columns.push(Column { who: who.into(), speeds: vec![speed] }),
        }
    }

    /// A round is over: all that follows was measured at another time.
    pub(super) fn end_round(&mut self) {
        self.round += 1;
    }
}

/// Medians of all rounds, and for our ways the median, least and most of the ratios to Embree's within each round: single rays, and
/// packets of 16.
pub(super) fn markdown(speeds: &Speeds) -> String {
    let mut text = format!(
        "Millions of rays a second by processor time of a thread, medians of {} rounds.\n",
        speeds.round
    );
    text.push_str("Behind ours in brackets: the median, least and most of its ratios to Embree's single rays, then to its packets of 16.\n\n");
    let mut heads: Vec<&str> = Vec::new();
    for column in speeds.rows.iter().flat_map(|row| &row.columns) {
        if !heads.contains(&column.who.as_str()) {
            heads.push(&column.who);
        }
    }
    // Writing to a text cannot fail.
    let _ = writeln!(text, "| mesh | set | {} |\n|---|---{}|", heads.join(" | "), "|---".repeat(heads.len()));
    for row in &speeds.rows {
        let cells: Vec<String> = heads.iter().map(|who| row.cell(who)).collect();
        let _ = writeln!(text, "| {} | {} | {} |", row.mesh, row.set, cells.join(" | "));
    }
    text
}

impl Row {
    fn cell(&self, who: &str) -> String {
        let Some(column) = self.columns.iter().find(|column| column.who == who) else { return String::new() };
        let own = format!("{:.2}", median(&column.speeds));
        if who.starts_with("Embree") {
            return own;
        }
        // Threads against as many threads.
        let threads = who.rsplit(' ').next().unwrap_or_default();
        let to = |width: &str| {
            let theirs =
                self.columns.iter().find(|column| column.who == format!("Embree {width} {threads}"))?;
            let ratios: Vec<f64> = column.speeds.iter().zip(&theirs.speeds).map(|(a, b)| a / b).collect();
            let least = ratios.iter().copied().fold(f64::INFINITY, f64::min);
            let most = ratios.iter().copied().fold(0.0, f64::max);
            Some(format!("{:.2}x, {least:.2}-{most:.2}", median(&ratios)))
        };
        let ratios: Vec<String> = ["w1", "w16"].into_iter().filter_map(to).collect();
        format!("{own} ({})", ratios.join("; "))
    }
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratios_are_taken_within_a_round() {
        let mut speeds = Speeds::default();
        for (single, packet, own) in [(1.0, 2.0, 2.0), (2.0, 4.0, 8.0), (4.0, 4.0, 12.0)] {
            speeds.add("bunny", "diffuse", "Embree w1 t1", single);
            speeds.add("bunny", "diffuse", "Embree w16 t1", packet);
            speeds.add("bunny", "diffuse", "best batch t1", own);
            speeds.end_round();
        }
        let table = markdown(&speeds);
        assert!(table.contains("medians of 3 rounds"), "{table}");
        let row = "| bunny | diffuse | 2.00 | 4.00 | 8.00 (3.00x, 2.00-4.00; 2.00x, 1.00-3.00) |";
        assert!(table.contains(row), "{table}");
    }
}
