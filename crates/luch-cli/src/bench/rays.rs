//! `luch bench rays`: trees are built over a mesh, and rays go through them.

use super::agree::Answers;
use super::geometry::Triangles;
use super::report::{Build, Report, Row};
use super::sets::{self, RaySet};
use super::trace::{Kernel, trace};
use crate::args::RaysArgs;
use crate::failure::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::outputs::probe;
use crate::processor_time;
use crate::same_file::refuse_replacing;
use luch::bvh::simd::Level;
use luch::bvh::{Quality, TriangleBvh};
use luch::formats::{ray_files, write_atomically};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Builds are repeated until this much time has gone by, or as often as rays are traced.
const BUILD_TIME: Duration = Duration::from_secs(3);

pub(super) fn run(args: &RaysArgs) -> Result<Outcome, Failure> {
    let pen = Interrupt::install()?.pen();
    let raw = args.write.as_deref().map(mesh_path);
    if let Some(raw) = &raw {
        refuse_replacing(&[raw], &[&args.mesh])?;
        probe(raw)?;
    }
    let triangles = Triangles::load(&args.mesh, &args.parameters)?;
    let choice = &args.choice;
    let trees: Vec<Tree> =
        choice.quality.0.iter().map(|&quality| Tree::build(&triangles, quality, args.repeat)).collect();
    let Some(first) = trees.first() else { return Err(Failure::usage("no quality is chosen")) };
    let sets = match &args.rays {
        Some(prefix) => sets::read(prefix, &choice.sets.0)?,
        None => sets::generate(&triangles, &first.tree, &args.camera, &choice.sets.0)?,
    };

    let mut rounds = Rounds::new(args, &trees, &sets);
    // The first round fetches everything into memory, and its answers are looked at.
    rounds.first();
    if let (Some(prefix), Some(raw)) = (&args.write, &raw) {
        let _held = pen.hold();
        let mesh = ray_files::encode_mesh(&triangles.positions, &triangles.corners)
            .ok_or_else(|| Failure::new("the mesh is too large for a file"))?;
        write_atomically(raw, &mesh)?;
        for (set, answers) in sets.iter().zip(&rounds.answers) {
            sets::write(prefix, set, answers)?;
        }
    }
    for _ in 0..args.repeat {
        rounds.timed();
    }
    let report = Report {
        mesh: &args.mesh,
        triangles: triangles.corners.len(),
        builds: trees.iter().map(|tree| &tree.cost).collect(),
        rows: rounds.rows,
    };
    report.tell(args.json);
    Ok(if report.is_sound() { Outcome::Done } else { Outcome::Unmet })
}

/// The file of triangles at a prefix.
fn mesh_path(prefix: &Path) -> PathBuf {
    let mut path = prefix.as_os_str().to_owned();
    path.push(".tri");
    path.into()
}

/// A tree and what it cost.
struct Tree {
    tree: TriangleBvh,
    cost: Build,
}

impl Tree {
    fn build(triangles: &Triangles, quality: Quality, repeat: u32) -> Self {
        let build = || TriangleBvh::build(&triangles.positions, &triangles.corners, quality);
        let began = Instant::now();
        // The first build fetches memory from the system and is not timed.
        let mut tree = build();
        let mut cost =
            Build { quality, statistics: tree.statistics(), seconds: Vec::new(), processor: Vec::new() };
        for _ in 0..repeat {
            let (started, before) = (Instant::now(), processor_time::of_process());
            tree = build();
            cost.seconds.push(started.elapsed().as_secs_f64());
            let spent = processor_time::since(before, processor_time::of_process());
            cost.processor.extend(spent.map(|time| time.as_secs_f64()));
            if began.elapsed() > BUILD_TIME {
                break;
            }
        }
        Self { tree, cost }
    }
}

/// Everything is traced once in each round, so that what disturbs the machine disturbs all alike.
struct Rounds<'a> {
    trees: &'a [Tree],
    sets: &'a [RaySet],
    levels: Vec<Level>,
    kernels: &'a [Kernel],
    threads: &'a [usize],
    rows: Vec<Row>,
    /// The first answers to each set.
    answers: Vec<Answers>,
}

impl<'a> Rounds<'a> {
    fn new(args: &'a RaysArgs, trees: &'a [Tree], sets: &'a [RaySet]) -> Self {
        let choice = &args.choice;
        let levels = match &choice.level {
            // Above what the processor has, nothing can be measured.
            Some(levels) => levels.0.iter().copied().filter(|level| *level <= Level::available()).collect(),
            None => vec![Level::available()],
        };
        let (kernels, threads) = (&choice.kernel.0, &choice.threads.0);
        Self { trees, sets, levels, kernels, threads, rows: Vec::new(), answers: Vec::new() }
    }

    /// Calls `visit` with every combination and its number.
    fn each(&mut self, mut visit: impl FnMut(&mut Self, usize, &RaySet, &Tree, Row)) {
        let (sets, trees, kernels, threads) = (self.sets, self.trees, self.kernels, self.threads);
        let mut number = 0;
        for set in sets {
            for tree in trees {
                for level in self.levels.clone() {
                    level.limit();
                    for &kernel in kernels {
                        for &threads in threads {
                            let row = Row::new(set, tree.cost.quality, level, kernel, threads);
                            visit(self, number, set, tree, row);
                            number += 1;
                        }
                    }
                }
            }
        }
    }

    fn first(&mut self) {
        let of_a_set = self.trees.len() * self.levels.len() * self.kernels.len() * self.threads.len();
        self.each(|this, number, set, tree, mut row| {
            let traced = trace(&tree.tree, set, row.kernel, row.threads);
            row.hits = traced.answers.hits();
            row.agreement = set.reference.as_ref().map(|reference| traced.answers.compare(reference));
            if number % of_a_set == 0 {
                this.answers.push(traced.answers);
            } else if let Some(first) = this.answers.last() {
                row.other_bits = traced.answers.other_bits(first);
            }
            this.rows.push(row);
        });
    }

    fn timed(&mut self) {
        self.each(|this, number, set, tree, row| {
            let cost = trace(&tree.tree, set, row.kernel, row.threads).cost;
            this.rows[number].add(cost);
        });
    }
}
