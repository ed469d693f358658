//! Words after `luch bench` as values.

use crate::args::Choice;
use crate::bench::{Kernel, SetKind, quality_name};
use glam::Vec3;
use luch::bvh::Quality;
use luch::bvh::simd::Level;

/// Coordinates farther out leave no room for squares and products.
const FARTHEST: f32 = 1e18;

/// Three numbers: `-1.2,1.5,-1.6`.
pub(crate) fn point(text: &str) -> Result<Vec3, String> {
    let numbers: Vec<f32> =
        text.split(',').map(|word| word.trim().parse()).collect::<Result<_, _>>().unwrap_or_default();
    match <[f32; 3]>::try_from(numbers) {
        Ok(numbers) if numbers.iter().all(|number| number.abs() < FARTHEST) => Ok(Vec3::from_array(numbers)),
        _ => Err(format!("`{text}` is no place; write three numbers, such as -1.2,1.5,0")),
    }
}

/// Degrees of a picture's width.
pub(crate) fn field_of_view(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(degrees) if degrees > 0.0 && degrees < 180.0 => Ok(degrees),
        _ => Err(format!("`{text}` is no field of view; write degrees, more than 0 and less than 180")),
    }
}

/// Tree qualities by name.
pub(crate) fn qualities(text: &str) -> Result<Choice<Quality>, String> {
    choice(text, "quality", &Quality::ALL, quality_name)
}

/// Ways of tracing by name.
pub(crate) fn kernels(text: &str) -> Result<Choice<Kernel>, String> {
    choice(text, "kernel", &Kernel::ALL, Kernel::name)
}

/// Sets of vector instructions by name.
pub(crate) fn levels(text: &str) -> Result<Choice<Level>, String> {
    choice(text, "level", &Level::ALL, Level::name)
}

/// Sets of rays by name.
pub(crate) fn sets(text: &str) -> Result<Choice<SetKind>, String> {
    choice(text, "set of rays", &SetKind::ALL, SetKind::name)
}

/// Numbers of threads: `1,2`.
pub(crate) fn thread_counts(text: &str) -> Result<Choice<usize>, String> {
    let count = |word: &str| match word.trim().parse() {
        Ok(count @ 1..=1024) => Ok(count),
        _ => Err(format!("`{word}` is no number of threads; accepted are 1 to 1024")),
    };
    text.split(',').map(count).collect::<Result<_, _>>().map(Choice)
}

/// Some of a family, by their names with commas in between; `all` is all of them.
fn choice<T: Copy + PartialEq>(
    text: &str,
    what: &str,
    all: &[T],
    name: impl Fn(T) -> &'static str,
) -> Result<Choice<T>, String> {
    if text == "all" {
        return Ok(Choice(all.to_vec()));
    }
    let mut chosen = Vec::new();
    for word in text.split(',').map(str::trim) {
        let found = all.iter().copied().find(|&one| name(one) == word).ok_or_else(|| {
            let names = all.iter().map(|&one| name(one)).collect::<Vec<_>>().join(", ");
            format!("`{word}` is no {what}; accepted are {names}, all")
        })?;
        if !chosen.contains(&found) {
            chosen.push(found);
        }
    }
    Ok(Choice(chosen))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_and_choices_are_read() {
        assert_eq!(point("-1.5, 0,2e1"), Ok(Vec3::new(-1.5, 0.0, 20.0)));
        for text in ["", "1,2", "1,2,3,4", "1,2,x", "1,2,inf", "1,2,NaN", "1,2,1e30"] {
            assert!(point(text).is_err(), "{text}");
        }
        assert_eq!(kernels("single,batch,single").unwrap().0, [Kernel::Single, Kernel::Batch]);
        assert_eq!(sets("all").unwrap().0, SetKind::ALL);
        assert!(qualities("good").unwrap_err().contains("accepted are fast, balanced, best, all"));
        assert_eq!(thread_counts("1,2").unwrap().0, [1, 2]);
        assert!(thread_counts("0").is_err() && thread_counts("1,,2").is_err());
        assert!(field_of_view("180").is_err() && field_of_view("nan").is_err());
    }
}
