//! Everything there is to say about a mesh.
