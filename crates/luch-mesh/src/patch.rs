//! Curves and patches of splines.
