//! Rays, boxes and a tree over anything that has a box
