//! Progressive, deterministic light transport
