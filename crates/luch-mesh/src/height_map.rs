//! Images of heights as meshes.
