//! How fine the triangles are to be.

use super::bezier::Bounds;
use crate::screen::OnScreen;

/// How fine the triangles are to be.
#[derive(Clone, Debug, PartialEq)]
pub enum Fineness {
    /// No point of a triangle is farther than this from the surface point of the same parameters, in metres.
    Tolerance(f64),
    /// Each Bezier piece has so many pieces along u and v.
    Divisions(u32),
    /// Seen from some cameras no triangle is off by more than so many pixels.
    Screen(OnScreen),
}

/// Pieces along u and v.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Divisions {
    pub(super) u: u64,
    pub(super) v: u64,
}

/// The fewest cells whose triangles are all within the tolerance.
///
/// Let a triangle lie in a box of a × b in the parameter plane. At a point p inside, the linear interpolation of S is off
/// by Σ λᵢ (S(vᵢ) − S(p)), where λᵢ are the barycentric coordinates. By Taylor this is at most
/// ½ Σ λᵢ (|Suu| Δuᵢ² + 2 |Suv| |Δuᵢ Δvᵢ| + |Svv| Δvᵢ²). Numbers within an interval of length a have a variance of at
/// most a²/4, so the error is at most (a² |Suu| + 2 a b |Suv| + b² |Svv|) / 8: the bound of Filip, Magedson and Markot,
/// "Surface algorithms using bounds on derivatives" (1986), for triangles of any form.
pub(super) fn divisions(bounds: &Bounds, tolerance: f64) -> Divisions {
    let Bounds { uu, uv, vv, .. } = *bounds;
    let limit = 8.0 * tolerance;
    // The least x with uu x⁻² + 2 uv (x y)⁻¹ + vv y⁻² ≤ limit for a given y.
    let other = |uu: f64, vv: f64, y: f64| {
        let room = limit - vv / (y * y);
        if room <= 0.0 {
            return f64::INFINITY;
        }
        let half = uv / y;
        (half + (half * half + room * uu).sqrt()) / room
    };
    // Starting points: one cell either way, and cells in proportion to the bends; then the other count follows.
    let mut best = [f64::INFINITY; 2];
    let mut consider = |u: f64, v: f64| {
        if u * v < best[0] * best[1] || best[0] * best[1] == f64::INFINITY {
            best = [u, v];
        }
    };
    consider(other(uu, vv, 1.0).ceil().max(1.0), 1.0);
    consider(1.0, other(vv, uu, 1.0).ceil().max(1.0));
    if uu > 0.0 && vv > 0.0 {
        let shape = (uu / vv).sqrt();
        let v = ((uu / (shape * shape) + 2.0 * uv / shape + vv) / limit).sqrt().ceil().max(1.0);
        let v = if other(uu, vv, v).is_finite() { v } else { v + 1.0 };
        consider(other(uu, vv, v).ceil().max(1.0), v);
        let u = ((uu + 2.0 * uv * shape + vv * shape * shape) / limit).sqrt().ceil().max(1.0);
        let u = if other(vv, uu, u).is_finite() { u } else { u + 1.0 };
        consider(u, other(vv, uu, u).ceil().max(1.0));
    } else {
        let both = ((uu + 2.0 * uv + vv) / limit).sqrt().ceil().max(1.0);
        consider(both, both);
    }
    // Counts past any limit saturate in the conversion.
    Divisions { u: best[0] as u64, v: best[1] as u64 }
}
