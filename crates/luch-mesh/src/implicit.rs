//! Surfaces where a function is zero.
