use super::*;

fn image(width: u32, height: u32, f: impl Fn(u32, u32) -> Rgb) -> Image<Rgb> {
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| f(x, y)).collect();
    Image::from_pixels(width, height, pixels).unwrap()
}

#[test]
fn equal_pictures_have_no_distance() {
    let a = image(20, 20, |x, y| Rgb::new(x as f32, y as f32 * 0.1, 0.5));
    let result = compare(&a, &a).unwrap();
    assert_eq!([result.mse, result.mae, result.relative_mse], [0.0; 3]);
    assert_eq!(result.psnr, f64::INFINITY);
    assert!((result.ssim.unwrap() - 1.0).abs() < 1e-12);
    assert_eq!(result.largest, Some(Place { x: 0, y: 0, difference: 0.0 }));
    assert_eq!((result.mean_a[0], result.mean_b[2]), (9.5, 0.5));
}

#[test]
fn known_distances() {
    // One of four pixels differs by 0.5 in one channel of three, from a reference of 0.5.
    let b = image(2, 2, |_, _| Rgb::gray(0.5));
    let a = image(2, 2, |x, y| if (x, y) == (1, 0) { Rgb::new(0.5, 1.0, 0.5) } else { Rgb::gray(0.5) });
    let result = compare(&a, &b).unwrap();
    assert_eq!(result.mse, 0.25 / 12.0);
    assert_eq!(result.rmse, (0.25f64 / 12.0).sqrt());
    assert_eq!(result.mae, 0.5 / 12.0);
    assert!((result.relative_mse - 0.25 / 0.26 / 12.0).abs() < 1e-15);
    assert_eq!(result.relative_mse_trimmed, result.relative_mse);
    // Half of full light is stored as 0.735356983052449.
    let shown = 1.0 - 0.735_356_983_052_449;
    assert!((result.psnr + 10.0 * libm::log10(shown * shown / 12.0)).abs() < 1e-5);
    assert_eq!(result.largest, Some(Place { x: 1, y: 0, difference: 0.5 }));
    assert_eq!((result.mean_a, result.mean_b), ([0.5, 0.625, 0.5], [0.5; 3]));
    assert_eq!(result.ssim, None);
}

#[test]
fn one_firefly_in_a_thousand_is_trimmed() {
    let b = image(50, 40, |_, _| Rgb::gray(1.0));
    let a = image(50, 40, |x, y| match (x, y) {
        (7, 9) => Rgb::gray(1e4),
        (8, 9) => Rgb::gray(1e3),
        (0, 0) => Rgb::gray(2.0),
        _ => Rgb::gray(1.0),
    });
    let result = compare(&a, &b).unwrap();
    // 2000 pixels: the worst two go, one error of 1 / 1.01 stays.
    assert!((result.relative_mse_trimmed - 1.0 / 1.01 / 1998.0).abs() < 1e-12);
    assert!(result.relative_mse > 1e4);
}

#[test]
fn pixels_that_are_no_number_are_counted_and_left_out() {
    let b = image(3, 1, |_, _| Rgb::gray(1.0));
    let a = image(3, 1, |x, _| {
        [Rgb::gray(2.0), Rgb::new(f32::NAN, 1.0, 1.0), Rgb::gray(f32::INFINITY)][x as usize]
    });
    let result = compare(&a, &b).unwrap();
    assert_eq!((result.non_finite, result.mse, result.mean_a), (2, 1.0, [2.0; 3]));
    let nothing = compare(&a.map(|_| Rgb::gray(f32::NAN)), &b).unwrap();
    assert_eq!((nothing.non_finite, nothing.mse, nothing.largest), (3, 0.0, None));
}

#[test]
fn sizes_must_agree() {
    let error = compare(&image(2, 3, |_, _| Rgb::BLACK), &image(3, 2, |_, _| Rgb::BLACK)).unwrap_err();
    assert_eq!(error, SizeMismatch { a: [2, 3], b: [3, 2] });
    assert!(error.to_string().contains("2×3 and 3×2"));
}

/// For two flat pictures the structure term is 1 and the luminance term is known.
#[test]
fn similarity_of_flat_pictures() {
    let flat = |byte: u8| image(16, 12, |_, _| Rgb::gray(srgb::decode_u8(byte)));
    let (x, y) = (51.0 / 255.0, 204.0 / 255.0);
    let expected = (2.0 * x * y + 1e-4) / (x * x + y * y + 1e-4);
    let got = ssim(&flat(51), &flat(204)).unwrap().unwrap();
    assert!((got - expected).abs() < 1e-5, "{got} {expected}");
}

#[test]
fn similarity_falls_with_noise_and_turns_with_contrast() {
    let stripes = |offset: u32| image(32, 32, move |x, _| Rgb::gray(((x + offset) / 2 % 2) as f32));
    let opposite = ssim(&stripes(0), &stripes(2)).unwrap().unwrap();
    assert!(opposite < -0.5, "opposite stripes: {opposite}");
    let hash = |x: u32, y: u32| {
        (x.wrapping_mul(2_654_435_761) ^ y.wrapping_mul(40_503)).wrapping_mul(69_069) >> 16 & 0xff
    };
    let noisy =
        |strength: f32| image(32, 32, move |x, y| Rgb::gray(0.4 + strength * hash(x, y) as f32 / 255.0));
    let clean = noisy(0.0);
    let values = [0.05, 0.1, 0.3].map(|strength| ssim(&noisy(strength), &clean).unwrap().unwrap());
    assert!(1.0 > values[0] && values[0] > values[1] && values[1] > values[2], "{values:?}");
}

#[test]
fn difference_pictures() {
    let a = image(2, 1, |x, _| Rgb::new(1.0, 0.0, x as f32));
    let b = image(2, 1, |_, _| Rgb::new(0.5, 0.25, 0.0));
    assert_eq!(*difference(&a, &b).unwrap().get(1, 0), Rgb::new(0.5, -0.25, 1.0));
    assert_eq!(*absolute_difference(&a, &b).unwrap().get(0, 0), Rgb::new(0.5, 0.25, 0.0));
    assert_eq!(*false_difference(&a, &b, 0.25).unwrap().get(0, 0), Rgb::WHITE);
    assert_eq!(*false_difference(&a, &a, 0.25).unwrap().get(0, 0), Rgb::BLACK);
}

#[test]
fn false_colors_get_brighter_all_the_way() {
    let luminances: Vec<f32> = (0..=1000).map(|i| false_color(i as f32 / 1000.0).luminance()).collect();
    assert!(luminances.is_sorted_by(|a, b| a < b));
    assert_eq!(false_color(f32::NAN), Rgb::new(0.0, 1.0, 0.0));
    assert_eq!((false_color(-1.0), false_color(9.0)), (Rgb::BLACK, Rgb::WHITE));
}
