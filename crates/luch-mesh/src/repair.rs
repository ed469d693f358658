//! Putting broken meshes right.
