//! The 256 colours of xterm: after the first 16, which users choose, a cube of 6 × 6 × 6 and 24 greys.

/// Bytes of the cube's six steps.
const STEPS: [u8; 6] = [0, 95, 135, 175, 215, 255];

/// The number of the fixed colour nearest to an sRGB colour.
pub(super) fn nearest(color: [u8; 3]) -> u8 {
    let steps = color.map(|byte| {
        let distance = |step: &usize| byte.abs_diff(STEPS[*step]);
        (0..STEPS.len()).min_by_key(distance).unwrap_or(0)
    });
    let [red, green, blue] = steps;
    let in_cube = 16 + 36 * red + 6 * green + blue;
    let mean = color.iter().map(|&byte| u32::from(byte)).sum::<u32>() / 3;
    // Greys are 8, 18, … 238.
    let shade = (mean.saturating_sub(3) / 10).min(23);
    let gray = [(8 + 10 * shade) as u8; 3];
    let distance = |other: [u8; 3]| -> u32 {
        color.iter().zip(other).map(|(&one, other)| u32::from(one.abs_diff(other)).pow(2)).sum()
    };
    let is_gray = distance(gray) < distance(steps.map(|step| STEPS[step]));
    if is_gray { (232 + shade) as u8 } else { in_cube as u8 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn color_of(number: u8) -> [u8; 3] {
        match number {
            232.. => [8 + 10 * (number - 232); 3],
            _ => [36, 6, 1].map(|unit| STEPS[usize::from((number - 16) / unit % 6)]),
        }
    }

    #[test]
    fn every_fixed_color_is_its_own_nearest() {
        for number in 16..=255 {
            assert_eq!(color_of(nearest(color_of(number))), color_of(number), "{number}");
        }
    }

    #[test]
    fn no_fixed_color_is_nearer() {
        for red in (0..=255).step_by(17) {
            for green in (0..=255).step_by(15) {
                for blue in (0..=255).step_by(51) {
                    let color = [red, green, blue].map(|byte: u16| byte as u8);
                    let distance = |number: u8| -> u32 {
                        let other = color_of(number);
                        color.iter().zip(other).map(|(&a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
                    };
                    let best = (16..=255).map(distance).min().unwrap();
                    assert_eq!(distance(nearest(color)), best, "{color:?}");
                }
            }
        }
    }
}
