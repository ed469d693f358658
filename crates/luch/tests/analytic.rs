//! Scenes with known answers: every integrator that applies, with every sequence, must find them within its own standard error.

mod analytic {
    pub(crate) mod formulas;
    pub(crate) mod fractions;
    pub(crate) mod furnaces;
    pub(crate) mod lamps;
    pub(crate) mod measure;
    pub(crate) mod picture;
    pub(crate) mod placement;
    pub(crate) mod shading;
    pub(crate) mod stage;
    pub(crate) mod transparency;
}
