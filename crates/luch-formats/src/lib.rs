//! Scene, mesh and image files to values and back
