//! Nearest point, inside, distance, rays.
