//! Changing polygons by hand: selections, topology, deformations.
