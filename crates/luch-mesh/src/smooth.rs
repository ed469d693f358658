//! Smoother surfaces and more even triangles.
