//! Height maps.

use luch_image::codec::Format;
use luch_image::{Bitmap, Encoding};

use super::{Action, Arguments, Keeps, Kind, Parameter, Verb, WorkshopError};
use crate::PolygonMesh;
use crate::height_map::{
    self, Channel, Displacement, HeightError, HeightField, Landform, Reduction, Terrain, ascii_grid,
};

const CHANNEL: Parameter = Parameter::new(
    "channel",
    Kind::Choice(&["luminance", "red", "green", "blue", "alpha"]),
    "luminance",
    "what of a pixel counts",
);
const SRGB: Parameter =
    Parameter::optional("srgb", Kind::Flag, "undo the sRGB curve; stored numbers are heights otherwise");
const BLUR: Parameter = Parameter::new(
    "blur",
    Kind::Number { least: 0.0, most: 1000.0 },
    "0",
    "standard deviation of a Gaussian blur, in points",
);
const SOLID: Parameter = Parameter::optional(
    "solid",
    Kind::POSITIVE,
    "make a closed body with walls and a floor so far below the lowest point, in metres",
);
const ERROR: Parameter = Parameter::optional(
    "error",
    Kind::NOT_NEGATIVE,
    "use as few triangles as keep every height within this, in metres",
);
const TRIANGLES: Parameter = Parameter::optional(
    "triangles",
    Kind::Count { least: 2, most: 1 << 26 },
    "use at most so many triangles for the surface",
);

/// The verbs of this group.
pub(super) const VERBS: &[Verb] = &[
    Verb {
        name: "height-map",
        summary: "A surface from an image of heights (PNG, EXR, PFM, HDR, …) or an ESRI ASCII grid, a vertex for each pixel",
        parameters: &[
            Parameter::required(
                "file",
                Kind::File,
                "the image or .asc grid; what is not finite or has no data is a hole",
            ),
            Parameter::optional(
                "size",
                Kind::POSITIVE,
                "length of the longer side in metres; 1 for images, the file's own for grids",
            ),
            Parameter::optional(
                "scale",
                Kind::NUMBER,
                "metres for white, 0.1 if not given; for grids a factor, 1 if not given",
            ),
            Parameter::new("offset", Kind::NUMBER, "0", "added to all heights, in metres"),
            CHANNEL,
            SRGB,
            Parameter::optional("invert", Kind::Flag, "turn upside down: the lowest becomes the highest"),
            Parameter::optional(
                "crop",
                Kind::Numbers,
                "column,row,width,height of the part to take, in points from the upper left",
            ),
            Parameter::optional(
                "cells",
                Kind::Flag,
                "make each pixel a cell between four vertices instead of a vertex",
            ),
            Parameter::optional("fill", Kind::NUMBER, "height for holes, in metres"),
            BLUR,
            SOLID,
            ERROR,
            TRIANGLES,
        ],
        example: "heights.png --scale 0.2 --solid 0.05",
        action: Action::Make { closed: true, run: height_map },
    },
    Verb {
        name: "terrain",
        summary: "Land by chance: hills, ridges or displaced midpoints",
        parameters: &[
            Parameter::new(
                "seed",
                Kind::Count { least: 0, most: u64::MAX },
                "0",
                "another number, another land",
            ),
            Parameter::new(
                "form",
                Kind::Choice(&["hills", "ridges", "plasma"]),
                "hills",
                "what the land is like",
            ),
            Parameter::new("columns", Kind::Count { least: 2, most: 8192 }, "129", "points along x"),
            Parameter::new("rows", Kind::Count { least: 2, most: 8192 }, "129", "points along z"),
            Parameter::new("size", Kind::POSITIVE, "1", "length of the longer side, in metres"),
            Parameter::new(
                "relief",
                Kind::NUMBER,
                "0.2",
                "heights lie within minus and plus this, in metres",
            ),
            Parameter::new(
                "features",
                Kind::Number { least: 0.0, most: 1e6 },
                "3",
                "hills or ridges along the longer side",
            ),
            Parameter::new(
                "octaves",
                Kind::Count { least: 1, most: 30 },
                "8",
                "how many sizes of hills, each half of that before",
            ),
            Parameter::new(
                "roughness",
                Kind::FRACTION,
                "0.5",
                "height of each size as a part of that before",
            ),
            BLUR,
            SOLID,
            ERROR,
            TRIANGLES,
        ],
        example: "--seed 4 --columns 17 --rows 13 --solid 0.1",
        action: Action::Make { closed: true, run: terrain },
    },
    Verb {
        name: "displace-by-image",
        summary: "Move vertices along their normals by an image, read at their uvs",
        parameters: &[
            Parameter::required("file", Kind::File, "the image"),
            Parameter::new("scale", Kind::NUMBER, "0.1", "how far white moves against black, in metres"),
            Parameter::new("middle", Kind::NUMBER, "0.5", "the value that moves nothing"),
            CHANNEL,
            SRGB,
        ],
        example: "waves.png --scale 0.05",
        action: Action::Change { keeps: Keeps::ALL, run: displace },
    },
];

fn refused(error: HeightError) -> WorkshopError {
    WorkshopError::new(error.to_string())
}

fn channel(arguments: &Arguments) -> Channel {
    match arguments.choice("channel") {
        "red" => Channel::Red,
        "green" => Channel::Green,
        "blue" => Channel::Blue,
        "alpha" => Channel::Alpha,
        _ => Channel::Luminance,
    }
}

fn encoding(arguments: &Arguments) -> Encoding {
    if arguments.flag("srgb") { Encoding::Srgb } else { Encoding::Linear }
}

fn image(bytes: &[u8]) -> Result<Bitmap, WorkshopError> {
    luch_image::codec::decode(bytes, None).map_err(|error| WorkshopError::of("file", error.to_string()))
}

fn height_map(arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    covered(&imaged(arguments)?, arguments)
}

fn terrain(arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    covered(&grown(arguments)?, arguments)
}

/// The field that a verb of this group makes before it becomes triangles.
pub(super) fn field(verb: &Verb, arguments: &Arguments) -> Result<HeightField, WorkshopError> {
    match verb.name {
        "height-map" => imaged(arguments),
        "terrain" => grown(arguments),
        other => {
            Err(WorkshopError::new(format!("`{other}` makes no height field; `height-map` and `terrain` do")))
        }
    }
}

fn imaged(arguments: &Arguments) -> Result<HeightField, WorkshopError> {
    let bytes = arguments.file("file").unwrap_or_default();
    let given_size = arguments.number_if_given("size").map(|size| size as f32);
    let given_scale = arguments.number_if_given("scale");
    // Images have marks; a grid begins with a name, after white space perhaps.
    let is_grid = Format::from_magic(bytes).is_none()
        && bytes.trim_ascii_start().first().is_some_and(|byte| byte.is_ascii_alphabetic());
    let (mut field, scale) = if is_grid {
        let grid = ascii_grid::decode(bytes).map_err(|error| WorkshopError::of("file", error.to_string()))?;
        (grid.field, given_scale.unwrap_or(1.0))
    } else {
        let bitmap = image(bytes)?;
        let size = HeightField::fitting_size(bitmap.width, bitmap.height, 1.0);
        let field = height_map::from_bitmap(&bitmap, channel(arguments), encoding(arguments), size);
        (field.map_err(refused)?, given_scale.unwrap_or(0.1))
    };
    if let Some(size) = given_size {
        field.size *= size / field.size.max_element();
        field.check().map_err(|error| WorkshopError::of("size", error.to_string()))?;
    }
    match *arguments.numbers("crop") {
        [] => {}
        [column, row, width, height] => {
            // Conversions from float to integer saturate; what does not fit is refused there.
            let part = [column, row, width, height].map(|number| number as u32);
            let [column, row, width, height] = part;
            let cropped = field.cropped(column, row, width, height);
            field = cropped.map_err(|error| WorkshopError::of("crop", error.to_string()))?;
        }
        _ => return Err(WorkshopError::of("crop", "expected four numbers: column,row,width,height")),
    }
    if arguments.flag("invert") {
        field = field.inverted();
    }
    field = field.scaled(scale, arguments.number("offset"));
    if let Some(height) = arguments.number_if_given("fill") {
        field = field.filled(height as f32);
    }
    if arguments.flag("cells") {
        field = field.cells().map_err(refused)?;
    }
    blurred(field, arguments)
}

fn grown(arguments: &Arguments) -> Result<HeightField, WorkshopError> {
    let landform = match arguments.choice("form") {
        "ridges" => Landform::Ridges,
        "plasma" => Landform::Plasma,
        _ => Landform::Hills,
    };
    let wish = Terrain {
        landform,
        seed: arguments.count_if_given("seed").unwrap_or(0),
        columns: arguments.count("columns"),
        rows: arguments.count("rows"),
        size: arguments.length("size"),
        relief: arguments.number("relief"),
        features: arguments.number("features"),
        octaves: arguments.count("octaves"),
        roughness: arguments.number("roughness"),
    };
    blurred(height_map::terrain(&wish).map_err(refused)?, arguments)
}

fn blurred(field: HeightField, arguments: &Arguments) -> Result<HeightField, WorkshopError> {
    let blurred = field.blurred(arguments.number("blur"));
    blurred.map_err(|error| WorkshopError::of("blur", error.to_string()))
}

/// What both makers of fields end with: reduction, body.
fn covered(field: &HeightField, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let (error, most_triangles) = (arguments.number_if_given("error"), arguments.count_if_given("triangles"));
    let sheet = if error.is_some() || most_triangles.is_some() {
        height_map::reduced(field, &Reduction { error: error.unwrap_or(0.0), most_triangles })
    } else {
        height_map::sheet(field)
    };
    if sheet.triangles.is_empty() {
        return Err(WorkshopError::new("nothing but holes is left"));
    }
    let Some(thickness) = arguments.number_if_given("solid") else { return Ok(PolygonMesh::from(&sheet)) };
    let lowest = sheet.positions.iter().map(|p| p.y).fold(f32::INFINITY, f32::min);
    let base = (f64::from(lowest) - thickness) as f32;
    let body = height_map::solid(field, &sheet, base);
    body.map(|body| PolygonMesh::from(&body)).map_err(|error| WorkshopError::of("solid", error.to_string()))
}

fn displace(mut mesh: PolygonMesh, arguments: &Arguments) -> Result<PolygonMesh, WorkshopError> {
    let bitmap = image(arguments.file("file").unwrap_or_default())?;
    if mesh.uv_sets.is_empty() && !mesh.positions.is_empty() {
        return Err(WorkshopError::new("the mesh has no uvs: unwrap it first"));
    }
    let displacement = Displacement {
        scale: arguments.number("scale"),
        middle: arguments.number("middle"),
        channel: channel(arguments),
        encoding: encoding(arguments),
    };
    height_map::displace(&mut mesh, &bitmap, &displacement);
    Ok(mesh)
}
