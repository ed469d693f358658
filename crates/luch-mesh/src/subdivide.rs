//! Subdivision surfaces.
