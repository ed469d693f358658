//! Fewer triangles, even triangles, smooth positions.

use crate::repair::drop_slivers;
use crate::simplify::{self, cluster, simplify};
use crate::smooth::{self, Remesh, Weights, remesh, smooth};
use crate::workshop::{Action, Arguments, Keeps, Kind, Parameter, Verb, WorkshopError};
use crate::{PolygonMesh, measure};

pub(super) const DECIMATE: Verb = Verb {
    name: "decimate",
    summary: "Collapse edges, cheapest first, until few triangles are left",
    parameters: &[
        Parameter::new("ratio", Kind::FRACTION, "0.5", "the part of the triangles to keep"),
        Parameter::optional(
            "faces",
            Kind::Count { least: 0, most: u64::MAX },
            "how many triangles to keep, instead of a ratio",
        ),
        Parameter::optional(
            "error",
            Kind::NOT_NEGATIVE,
            "how far the surface may move, in metres; alone, as many triangles go as it allows",
        ),
        Parameter::new("borders", Kind::Flag, "false", "borders stay exactly as they are"),
    ],
    example: "--ratio 0.5",
    action: Action::Change { keeps: Keeps { closed: true, uvs: true, ..Keeps::NOTHING }, run: decimate },
};

pub(super) const DROP_SLIVERS: Verb = Verb {
    name: "drop-slivers",
    summary: "Take away triangles that are hardly there: needles are drawn together, caps turned",
    parameters: &[Parameter::optional(
        "height",
        Kind::POSITIVE,
        "the height below which a triangle is a sliver, in metres; a hundred-thousandth of the size if it is not given",
    )],
    example: "--height 0.001",
    action: Action::Change {
        keeps: Keeps { closed: true, uvs: true, ..Keeps::NOTHING },
        run: without_slivers,
    },
};

pub(super) const CLUSTER: Verb = Verb {
    name: "cluster",
    summary: "Merge all vertices in each cell of a grid: the fast way to few triangles",
    parameters: &[Parameter::new(
        "cells",
        Kind::Count { least: 1, most: simplify::MOST_CELLS as u64 },
        "64",
        "cells along the longest side",
    )],
    example: "--cells 8",
    action: Action::Change { keeps: Keeps::NOTHING, run: merge_cells },
};

pub(super) const SMOOTH: Verb = Verb {
    name: "smooth",
    summary: "Move vertices toward the mean of their neighbours",
    parameters: &[
        Parameter::new(
            "method",
            Kind::Choice(&["taubin", "laplace"]),
            "taubin",
            "with or without keeping the volume",
        ),
        Parameter::new("iterations", Kind::Count { least: 0, most: 65_536 }, "10", "how often"),
        Parameter::new("factor", Kind::FRACTION, "0.5", "how far toward the mean"),
        Parameter::new("weights", Kind::Choice(&["uniform", "cotangent"]), "uniform", "how neighbours count"),
        Parameter::new("borders", Kind::Flag, "false", "borders are smoothed too"),
    ],
    example: "--iterations 2",
    action: Action::Change { keeps: Keeps::ALL, run: smoothed },
};

pub(super) const REMESH: Verb = Verb {
    name: "remesh",
    summary: "New triangles with edges of one length on the same surface, without attributes",
    parameters: &[
        Parameter::required("length", Kind::POSITIVE, "the length of edges, in metres"),
        Parameter::new(
            "iterations",
            Kind::Count { least: 1, most: 100 },
            "5",
            "how often all steps are done",
        ),
        Parameter::new("angle", Kind::Angle, "40", "edges bent by more than this stay"),
    ],
    example: "--length 0.3 --iterations 2",
    action: Action::Change { keeps: Keeps { closed: true, ..Keeps::NOTHING }, run: remeshed },
};

fn decimate(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let mesh = mesh.triangulate();
    let error = arguments.number_if_given("error");
    let ratio = (mesh.triangles.len() as f64 * arguments.number("ratio")) as usize;
    let triangles = match (arguments.count_if_given("faces"), error) {
        (Some(faces), _) => usize::try_from(faces).unwrap_or(usize::MAX),
        (None, Some(_)) => 0,
        (None, None) => ratio,
    };
    let settings = simplify::Settings {
        triangles,
        error: error.unwrap_or(f64::INFINITY),
        keeps_borders: arguments.flag("borders"),
    };
    Ok(PolygonMesh::from(&simplify(&mesh, &settings).mesh))
}

fn without_slivers(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let triangles = mesh.triangulate();
    let bounds = measure::bounds(&triangles);
    let usual = f64::from((bounds.max - bounds.min).max_element()) * 1e-5;
    let height = arguments.number_if_given("height").unwrap_or(usual);
    let dropped = drop_slivers(&triangles, height);
    // Faces of more corners stay where nothing is to be done.
    Ok(if dropped.changes == 0 { mesh } else { PolygonMesh::from(&dropped.mesh) })
}

fn merge_cells(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    Ok(PolygonMesh::from(&cluster(&mesh.triangulate(), arguments.count("cells")).mesh))
}

fn smoothed(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let factor = arguments.number("factor");
    let settings = smooth::Settings {
        iterations: arguments.count("iterations"),
        factor,
        // Pass band 0.1: 1 / λ − 1 / μ = 0.1 with μ = −back (Taubin 1995).
        back: if arguments.choice("method") == "taubin" { factor / (1.0 - 0.1 * factor) } else { 0.0 },
        weights: if arguments.choice("weights") == "cotangent" {
            Weights::Cotangent
        } else {
            Weights::Uniform
        },
        keeps_borders: !arguments.flag("borders"),
    };
    Ok(smooth(&mesh, &settings))
}

fn remeshed(mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let settings = Remesh {
        length: arguments.number("length"),
        iterations: arguments.count("iterations"),
        feature_angle: arguments.number("angle"),
    };
    let even = remesh(&mesh.triangulate(), &settings);
    Ok(PolygonMesh::from(&even.map_err(|error| WorkshopError::of("length", error.to_string()))?))
}
