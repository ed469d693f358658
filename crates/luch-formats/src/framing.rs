//! A camera for scenes that bring none: all of the scene is in the picture.

use glam::{DAffine3, DMat3, DVec3, Vec3};
use luch_mesh::measure::{self, BoundingSphere};
use luch_scene::{Camera, Scene, Shape};

/// Vertical field of view of the camera, radians: a short telephoto lens, which flatters single objects.
const FIELD_OF_VIEW_Y: f32 = 35.0 * std::f32::consts::PI / 180.0;

/// From the middle of the scene to the eye: a little above, to the right of the front.
const TOWARD_EYE: Vec3 = Vec3::new(0.55, 0.45, 1.0);

/// Room around the scene.
const MARGIN: f64 = 1.05;

/// A camera that has the whole bounding ball of `scene` in a picture of the shape its settings ask for, and that ball.
pub fn framing_camera(scene: &Scene) -> (Camera, BoundingSphere) {
    let bounds = bounding_sphere(scene).unwrap_or(BoundingSphere { center: Vec3::ZERO, radius: 1.0 });
    let aspect = f64::from(scene.settings.width.max(1)) / f64::from(scene.settings.height.max(1));
    let half_height = libm::tan(f64::from(FIELD_OF_VIEW_Y) / 2.0);
    let half_angle = libm::atan(half_height.min(half_height * aspect));
    let distance = (f64::from(bounds.radius.max(1e-6)) * MARGIN / libm::sin(half_angle)) as f32;
    let eye = bounds.center + TOWARD_EYE.normalize() * distance;
    (Camera::looking_at(eye, bounds.center, Vec3::Y, FIELD_OF_VIEW_Y), bounds)
}

/// A ball around everything in the scene that has an end; `None` if there is nothing of that kind.
pub fn bounding_sphere(scene: &Scene) -> Option<BoundingSphere> {
    let own: Vec<Option<BoundingSphere>> = scene
        .shapes
        .iter()
        .map(|shape| match &**shape {
            Shape::Mesh(mesh) => measure::bounding_sphere(mesh),
            Shape::Sphere { radius } | Shape::Disc { radius } => {
                Some(BoundingSphere { center: Vec3::ZERO, radius: *radius })
            }
            Shape::Plane => None,
            Shape::Traced(form) => {
                let [low, high] = form.corners();
                Some(BoundingSphere { center: 0.5 * (low + high), radius: 0.5 * (high - low).length() })
            }
        })
        .collect();
    let mut total: Option<Ball> = None;
    for instance in &scene.instances {
        let Some(Some(ball)) = own.get(instance.shape.index()) else { continue };
        let placed = Ball::placed(ball, &instance.placement);
        if placed.is_finite() {
            total = Some(total.map_or(placed, |so_far| so_far.joined(placed)));
        }
    }
    let total = total?;
    let sphere = BoundingSphere { center: total.center.as_vec3(), radius: total.radius as f32 };
    (sphere.center.is_finite() && sphere.radius.is_finite()).then_some(sphere)
}

/// A ball in double precision.
#[derive(Clone, Copy)]
struct Ball {
    center: DVec3,
    radius: f64,
}

impl Ball {
    fn placed(ball: &BoundingSphere, placement: &glam::Affine3A) -> Self {
        let matrix = DMat3::from_cols_array(&placement.matrix3.to_cols_array().map(f64::from));
        let placement = DAffine3::from_mat3_translation(matrix, placement.translation.as_dvec3());
        // The largest stretch is the root of the largest eigenvalue of MᵀM, which its row sums bound (Gershgorin).
        let square = matrix.transpose() * matrix;
        let rows = [square.row(0), square.row(1), square.row(2)];
        let stretch = rows.map(|row| row.abs().element_sum()).into_iter().fold(0.0, f64::max).sqrt();
        let center = placement.transform_point3(ball.center.as_dvec3());
        Self { center, radius: f64::from(ball.radius) * stretch }
    }

    fn is_finite(&self) -> bool {
        self.center.is_finite() && self.radius.is_finite()
    }

    /// The smallest ball around both.
    fn joined(self, other: Self) -> Self {
        let between = other.center - self.center;
        let distance = between.length();
        if distance + other.radius <= self.radius {
            return self;
        }
        if distance + self.radius <= other.radius {
            return other;
        }
        let radius = (distance + self.radius + other.radius) / 2.0;
        let center = self.center + between * ((radius - self.radius) / distance);
        // Rounding must not leave a point outside.
        Self { center, radius: radius * (1.0 + 1e-9) }
    }
}
