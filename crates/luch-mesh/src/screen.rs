//! How large things look: lengths on the screens of cameras.

use glam::{DAffine3, DMat3, DVec3};

/// A camera, as far as sizes on its screen go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScreenView {
    /// Where the camera is.
    pub eye: DVec3,
    /// What a pixel covers at any distance, in metres; of a parallel projection. Both this and the next are not negative.
    pub pixel: f64,
    /// What a pixel covers more for each metre of distance from the eye.
    pub pixel_per_metre: f64,
    /// Nearer than this nothing is judged, in metres; keeps the work bounded where the camera is inside a surface.
    pub nearest: f64,
}

impl ScreenView {
    /// A camera with an eye.
    ///
    /// `field_of_view` is the vertical angle of view in radians, below half a turn; `rows` those of the picture.
    pub fn perspective(eye: DVec3, field_of_view: f64, rows: u32, nearest: f64) -> Self {
        let pixel_per_metre = 2.0 * libm::tan(field_of_view / 2.0) / f64::from(rows.max(1));
        Self { eye, pixel: 0.0, pixel_per_metre, nearest }
    }

    /// A camera that sees `height` metres with parallel rays.
    pub fn orthographic(height: f64, rows: u32) -> Self {
        Self { eye: DVec3::ZERO, pixel: height / f64::from(rows.max(1)), pixel_per_metre: 0.0, nearest: 0.0 }
    }

    /// The view of something that `placement` puts into the world, in its own coordinates. Lengths are judged by the direction that
    /// is stretched most, distances by the one that is stretched least: a skew placement gives rather too fine.
    ///
    /// `None` if the placement cannot be undone.
    pub fn of_placed(&self, placement: &DAffine3) -> Option<Self> {
        let inverse = placement.inverse();
        let (most, back) = (stretch(placement.matrix3), stretch(inverse.matrix3));
        let sound = most > 0.0 && most.is_finite() && back > 0.0 && back.is_finite() && inverse.is_finite();
        sound.then(|| Self {
            eye: inverse.transform_point3(self.eye),
            pixel: self.pixel / most,
            pixel_per_metre: self.pixel_per_metre / (most * back),
            nearest: self.nearest * back,
        })
    }

    /// What a pixel covers, in metres, at the nearest point of a ball.
    pub fn pixel_at(&self, centre: DVec3, radius: f64) -> f64 {
        let distance = (self.eye.distance(centre) - radius).max(self.nearest);
        self.pixel + self.pixel_per_metre * distance
    }

    /// Whether all numbers are of use.
    pub fn is_sound(&self) -> bool {
        let numbers = [self.pixel, self.pixel_per_metre, self.nearest];
        let some = self.pixel > 0.0 || self.pixel_per_metre > 0.0 && self.nearest > 0.0;
        self.eye.is_finite() && numbers.into_iter().all(|n| n.is_finite() && n >= 0.0) && some
    }
}

/// By how much a map stretches at most: the root of the sum of squares is an upper bound, exact up to √3; the greatest row sum of the
/// product with the transpose is another. The less of both is taken.
fn stretch(matrix: DMat3) -> f64 {
    let gram = matrix.transpose() * matrix;
    let sums = (gram.x_axis.abs() + gram.y_axis.abs() + gram.z_axis.abs()).max_element();
    let trace = gram.x_axis.x + gram.y_axis.y + gram.z_axis.z;
    sums.min(trace).sqrt()
}

/// So many pixels on the screens of some cameras.
#[derive(Clone, Debug, PartialEq)]
pub struct OnScreen {
    /// The cameras; the one that sees most decides.
    pub views: Vec<ScreenView>,
    /// How many pixels.
    pub pixels: f64,
}

impl OnScreen {
    /// The length in metres that nowhere in a ball covers more than the pixels.
    pub fn length(&self, centre: DVec3, radius: f64) -> f64 {
        let pixel = self.views.iter().map(|view| view.pixel_at(centre, radius)).fold(f64::INFINITY, f64::min);
        self.pixels * pixel
    }

    /// Whether all numbers are of use.
    pub fn is_sound(&self) -> bool {
        self.pixels.is_finite() && self.pixels > 0.0 && self.views.iter().all(ScreenView::is_sound)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_follow_distance_and_placement() {
        let view = ScreenView::perspective(DVec3::ZERO, std::f64::consts::FRAC_PI_2, 100, 0.5);
        // 90° over 100 rows: 2 metres at a distance of 1.
        assert!((view.pixel_at(DVec3::NEG_Z * 10.0, 0.0) - 0.2).abs() < 1e-12);
        assert!((view.pixel_at(DVec3::NEG_Z * 10.0, 5.0) - 0.1).abs() < 1e-12);
        assert!((view.pixel_at(DVec3::NEG_Z * 10.0, 50.0) - 0.01).abs() < 1e-12);
        // Something ten times as large as its own coordinates say, at (0, 0, −20).
        let placement =
            DAffine3::from_translation(DVec3::NEG_Z * 20.0) * DAffine3::from_scale(DVec3::splat(10.0));
        let own = view.of_placed(&placement).unwrap();
        assert!((own.pixel_at(DVec3::ZERO, 0.0) - 0.04).abs() < 1e-12);
        let flat = ScreenView::orthographic(50.0, 100);
        assert_eq!(flat.pixel_at(DVec3::ONE, 0.0), 0.5);
        assert!((flat.of_placed(&placement).unwrap().pixel_at(DVec3::ONE, 0.0) - 0.05).abs() < 1e-12);
        assert!(view.of_placed(&DAffine3::from_scale(DVec3::ZERO)).is_none());
        let both = OnScreen { views: vec![view, flat], pixels: 3.0 };
        assert!((both.length(DVec3::NEG_Z * 10.0, 0.0) - 0.6).abs() < 1e-12);
        assert!(both.is_sound() && !OnScreen { views: vec![], pixels: f64::NAN }.is_sound());
    }

    #[test]
    fn skew_placements_are_judged_rather_too_fine() {
        let view = ScreenView::perspective(DVec3::ZERO, 1.0, 100, 0.0);
        let placement = DAffine3::from_scale(DVec3::new(1.0, 3.0, 0.5)) * DAffine3::from_rotation_x(0.7);
        let own = view.of_placed(&placement).unwrap();
        let centre = DVec3::new(4.0, -2.0, 1.0);
        let truth = view.pixel_at(placement.transform_point3(centre), 0.0);
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            let step = axis * own.pixel_at(centre, 0.0);
            assert!(placement.transform_vector3(step).length() <= truth * (1.0 + 1e-9));
        }
    }
}
