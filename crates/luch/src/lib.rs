//! A renderer, a Monte Carlo laboratory and a mesh workshop: the facade
