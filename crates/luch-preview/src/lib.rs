//! A quick look: z-buffer and wireframe, without light transport.
//!
//! A [`Subject`] is a scene or a mesh, [`draw`] turns it into a [`Picture`]: colours, depths, instance and face numbers. Cameras
//! are the renderer's, and every pixel is where the renderer has it, so outlines agree with the ray-traced picture.
//! [`frame_all`] and [`StandardView`] find cameras, [`contact_sheet`] shows several at once, [`to_terminal`] makes text of it.
//!
//! ```
//! use luch_mesh::generate;
//! use luch_preview::{Hidden, Lines, NOTHING, Size, StandardView, Style, Subject, draw, frame_all};
//!
//! // A torus, shaded, with its edges over it.
//! let mesh = generate::torus(1.0, 0.4, 48, 24);
//! let subject = Subject::triangles(&mesh);
//! let size = Size { width: 320, height: 180 };
//! let camera = frame_all(&subject.bounds(), StandardView::ThreeQuarter.direction(), 0.6, 16.0 / 9.0);
//! let lines = Lines { hidden: Hidden::Removed, width: 1.0, ..Lines::default() };
//! let picture = draw(&subject, &camera, size, &Style { lines: Some(lines), ..Style::default() })?;
//!
//! // The corner of the picture shows nothing, much of the rest a triangle.
//! assert_eq!(*picture.faces.get(0, 0), NOTHING);
//! let covered = picture.faces.pixels().iter().filter(|&&face| face != NOTHING).count();
//! assert!(covered > 10_000);
//! # Ok::<(), luch_preview::PreviewError>(())
//! ```

mod base_color;
mod cameras;
mod clip;
mod draw;
mod error;
mod exact;
mod lines;
mod outline;
mod raster;
mod shade;
mod sheet;
mod style;
mod subject;
mod surface;
mod terminal;
mod texture;
mod traced;
mod view;
mod visibility;

pub use cameras::{StandardView, frame_all, frame_all_parallel};
pub use draw::{NOTHING, Picture, draw};
pub use error::{LARGEST_SIDE, MOST_SAMPLES, PreviewError};
pub use sheet::contact_sheet;
pub use style::{Antialiasing, Dots, EdgeSet, Fill, Hidden, Lines, Marks, Style};
pub use subject::Subject;
pub use terminal::{Depth as TerminalDepth, to_kitty, to_terminal};
pub use view::Size;

/// The README's example, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExample;
