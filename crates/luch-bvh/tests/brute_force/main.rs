//! The one promise of this crate: a tree answers as the plain loop over all primitives does, bit for bit.

mod adversarial;
mod boxes;
mod bundles;
mod cramer;
mod files;
mod instances;
mod meshes;
mod random;
mod slabs;
mod splits;
mod triangles;
mod watertight;
