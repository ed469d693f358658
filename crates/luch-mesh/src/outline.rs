//! Outlines in the plane, with holes, and the bodies made of them.
