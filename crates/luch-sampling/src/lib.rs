//! Monte Carlo without a picture: points, warps, densities, estimates
