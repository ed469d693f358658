//! Union, intersection and difference of bodies.
