//! Tests that look for the faults of generators.
