//! Fewer triangles.
