//! The steps of a transform.

use super::literal;
use crate::scene_file::{advice, clip};
use glam::{DMat3, DMat4, DVec3, DVec4};

/// Elements of a transform.
const STEPS: [&str; 5] = ["matrix", "translate", "rotate", "scale", "lookat"];

/// The map of one element called `tag`; `attribute` gives its attributes.
pub(super) fn step(tag: &str, attribute: &mut dyn FnMut(&str) -> Option<String>) -> Result<DMat4, String> {
    match tag {
        "matrix" => matrix(&attribute("value").ok_or("this `matrix` lacks its attribute `value`")?),
        "translate" => Ok(DMat4::from_translation(vector(attribute, 0.0)?)),
        "scale" => {
            let scale = vector(attribute, 1.0)?;
            Ok(DMat4::from_scale(scale))
        }
        "rotate" => {
            let angle = attribute("angle").ok_or("this `rotate` lacks its attribute `angle`")?;
            let angle = literal::number(&angle)?;
            let axis = vector(attribute, 0.0)?;
            let axis = axis.try_normalize().ok_or("this `rotate` has no axis, such as x=\"1\"")?;
            Ok(DMat4::from_axis_angle(axis, (angle % 360.0).to_radians()))
        }
        "lookat" | "lookAt" => look_at(attribute),
        _ => {
            Err(format!("unknown step `{}` of a transform; {}", clip(tag), advice(tag, STEPS, "steps", "`")))
        }
    }
}

/// Nine or sixteen numbers, row by row.
fn matrix(text: &str) -> Result<DMat4, String> {
    let numbers = literal::numbers(text)?;
    let matrix = match numbers.len() {
        9 => {
            let m: [f64; 9] = numbers.try_into().unwrap_or([0.0; 9]);
            DMat4::from_mat3(DMat3::from_cols_array(&m).transpose())
        }
        16 => {
            let m: [f64; 16] = numbers.try_into().unwrap_or([0.0; 16]);
            DMat4::from_cols_array(&m).transpose()
        }
        count => return Err(format!("a matrix has 9 or 16 numbers, here are {count}")),
    };
    let last = matrix.row(3);
    if last.truncate() != DVec3::ZERO || last.w == 0.0 {
        return Err("the last row of a matrix must be 0 0 0 1".to_owned());
    }
    Ok(matrix * (1.0 / last.w))
}

/// `value` with three numbers or one for all, or `x`, `y` and `z`, each `default` if it is missing.
fn vector(attribute: &mut dyn FnMut(&str) -> Option<String>, default: f64) -> Result<DVec3, String> {
    if let Some(text) = attribute("value") {
        return match literal::numbers(&text)?[..] {
            [all] => Ok(DVec3::splat(all)),
            [x, y, z] => Ok(DVec3::new(x, y, z)),
            ref numbers => Err(format!("has {} numbers, expected 3 or 1", numbers.len())),
        };
    }
    let mut component = |name| attribute(name).map_or(Ok(default), |text| literal::number(&text));
    Ok(DVec3::new(component("x")?, component("y")?, component("z")?))
}

/// At `origin`, +Z toward `target`, +X to the left.
fn look_at(attribute: &mut dyn FnMut(&str) -> Option<String>) -> Result<DMat4, String> {
    let mut point = |name: &str| match attribute(name) {
        Some(text) => literal::vector(&text).map(|v| Some(v.as_dvec3())),
        None => Ok(None),
    };
    let origin = point("origin")?.ok_or("this `lookat` lacks its attribute `origin`")?;
    let target = point("target")?.ok_or("this `lookat` lacks its attribute `target`")?;
    let forward =
        (target - origin).try_normalize().ok_or("`origin` and `target` of this `lookat` are the same")?;
    let up = match point("up")? {
        Some(up) if up != DVec3::ZERO => up,
        _ => forward.any_orthogonal_vector(),
    };
    let left = up.cross(forward).try_normalize().ok_or("`up` of this `lookat` is along the view")?;
    let up = forward.cross(left);
    Ok(DMat4::from_cols(left.extend(0.0), up.extend(0.0), forward.extend(0.0), DVec4::from((origin, 1.0))))
}
