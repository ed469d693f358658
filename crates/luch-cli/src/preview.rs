//! `luch preview`: a quick look.

use crate::args::{HiddenLines, PreviewArgs, TerminalColors};
use crate::failure::{Failure, Outcome};
use crate::parse::Size;
use crate::{mesh, terminal};
use luch::formats::{Files, SceneFormat, save_image};
use luch::image::tone::Tone;
use luch::image::{Image, Rgb};
use luch::preview::{
    Antialiasing, Dots, EdgeSet, Hidden, Lines, Marks, StandardView, Style, Subject, TerminalDepth,
    contact_sheet, draw, frame_all, to_kitty, to_terminal,
};
use luch::scene::{Camera, Normals, Scene};
use std::io::Write;
use std::path::Path;

/// Vertical field of view of cameras that bring everything into view, radians.
const FIELD_OF_VIEW: f32 = 0.6;

pub(crate) fn run(args: &PreviewArgs) -> Result<Outcome, Failure> {
    let path = Path::new(&args.input);
    let is_scene = path.exists() && SceneFormat::from_path(path).is_some();
    let image = if is_scene {
        let scene = args.parameters.load(path, &Files::disk())?.scene;
        let settings = &scene.settings;
        let own = luch::preview::Size { width: settings.width, height: settings.height };
        let subject = Subject::scene(&scene);
        picture(&subject, Some(&scene), size(args, own), args)?
    } else {
        let mesh = mesh::read_or_run(&args.input)?;
        let subject = Subject::polygons(&mesh);
        picture(&subject, None, size(args, luch::preview::Size { width: 1280, height: 720 }), args)?
    };
    for output in &args.output {
        save_image(output, &image, &Tone::default(), &Default::default())?;
    }
    if args.output.is_empty() {
        show(&image, args)?;
    }
    Ok(Outcome::Done)
}

fn size(args: &PreviewArgs, own: luch::preview::Size) -> luch::preview::Size {
    match args.size {
        Some(Size { width, height }) => luch::preview::Size { width, height },
        None => own,
    }
}

fn picture(
    subject: &Subject,
    scene: Option<&Scene>,
    size: luch::preview::Size,
    args: &PreviewArgs,
) -> Result<Image<Rgb>, Failure> {
    let style = style(args)?;
    let aspect = size.width as f32 / size.height.max(1) as f32;
    let from = |view: StandardView| frame_all(&subject.bounds(), view.direction(), FIELD_OF_VIEW, aspect);
    if args.sheet {
        let cameras = StandardView::ALL.map(from);
        let tile = luch::preview::Size { width: (size.width / 3).max(1), height: (size.height / 3).max(1) };
        return Ok(contact_sheet(subject, &cameras, tile, 3, &style)?);
    }
    let camera = match (args.view, scene) {
        (None, Some(scene)) => scene_camera(scene, args)?.unwrap_or_else(|| from(StandardView::ThreeQuarter)),
        (view, _) => from(view.unwrap_or(StandardView::ThreeQuarter)),
    };
    Ok(draw(subject, &camera, size, &style)?.color)
}

/// The camera that is asked for, or the first.
fn scene_camera(scene: &Scene, args: &PreviewArgs) -> Result<Option<Camera>, Failure> {
    let Some(name) = &args.camera else {
        return Ok(scene.cameras.first().map(|named| named.camera));
    };
    let known = || scene.cameras.iter().map(|named| named.name.as_str()).collect::<Vec<_>>().join(", ");
    let found = scene.cameras.iter().find(|named| named.name == *name);
    let missing = || Failure::usage(format!("there is no camera `{name}`; there are: {}", known()));
    Ok(Some(found.ok_or_else(missing)?.camera))
}

fn style(args: &PreviewArgs) -> Result<Style, Failure> {
    let edges = match args.features {
        Some(crease_angle) => EdgeSet::Features { crease_angle },
        None => EdgeSet::All,
    };
    let hidden = args.wireframe.map(|hidden| match hidden {
        HiddenLines::Removed => Hidden::Removed,
        HiddenLines::Faint => Hidden::Faint,
        HiddenLines::Shown => Hidden::Shown,
    });
    let hidden = hidden.or(args.features.map(|_| Hidden::Removed));
    let bright = args.fill == luch::preview::Fill::Nothing;
    let color = if bright { Rgb::gray(0.8) } else { Rgb::BLACK };
    Ok(Style {
        fill: args.fill,
        normals: if args.flat { Normals::Flat } else { Normals::Interpolated },
        lines: hidden.map(|hidden| Lines { edges, hidden, width: args.line_width, color }),
        marks: args.marks.then(Marks::default),
        dots: args.vertices.then(Dots::default),
        antialiasing: match args.antialias {
            1 => Antialiasing::None,
            4 => Antialiasing::Four,
            16 => Antialiasing::Sixteen,
            other => return Err(Failure::usage(format!("--antialias {other}: accepted are 1, 4 and 16"))),
        },
        ..Style::default()
    })
}

fn show(image: &Image<Rgb>, args: &PreviewArgs) -> Result<(), Failure> {
    let columns = args.columns.unwrap_or(80);
    let depth = match args.terminal {
        TerminalColors::TrueColor => TerminalDepth::TrueColor,
        TerminalColors::Palette => TerminalDepth::Palette,
        TerminalColors::Letters => TerminalDepth::Letters,
        TerminalColors::Kitty => {
            let mut out = std::io::stdout().lock();
            return Ok(out.write_all(&to_kitty(image)?).and_then(|()| out.flush())?);
        }
    };
    terminal::say(to_terminal(image, columns, depth).trim_end_matches('\n'));
    Ok(())
}
