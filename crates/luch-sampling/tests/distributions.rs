//! Distributions from tables, drawn and measured.

use luch_sampling::check::{chi_square, square_matches_pdf};
use luch_sampling::{Alias, Domain, Estimate, Piecewise1d, Piecewise2d, Sampler, Sequence};

/// A bumpy table with empty places, the same every time.
fn weights(cells: usize) -> Vec<f32> {
    (0..cells)
        .map(|cell| if cell % 7 == 3 { 0.0 } else { libm::expf(2.0 * libm::sinf(cell as f32 * 0.37)) })
        .collect()
}

#[test]
fn a_picture_is_drawn_by_its_weights() {
    let table = Piecewise2d::new(24, 16, &weights(24 * 16)).unwrap();
    let count = 1 << 19;
    let fit = square_matches_pdf(count, 3, |u| Some(table.sample([u[0], u[1]]).position), |x| table.pdf(x));
    assert!(fit.chi_square.p_value > 0.003 && fit.chi_square.impossible == 0, "{fit:?}");
    // The quadrature looks closer at the borders of cells, where the density jumps.
    assert!((fit.integral - 1.0).abs() < 5e-4, "{fit:?}");
}

#[test]
fn a_line_and_a_table_are_drawn_by_their_weights() {
    let weights = weights(50);
    let (line, alias) = (Piecewise1d::new(&weights).unwrap(), Alias::new(&weights).unwrap());
    let mut counts = [[0u64; 50]; 2];
    let count = 1 << 19;
    for index in 0..count {
        let u = Sampler::at(Sequence::Independent, 9, [0, 0], index).group(Domain::new(0, 0));
        counts[0][line.sample(u[0]).cell] += 1;
        counts[1][alias.sample(u[1]).index] += 1;
    }
    let total: f64 = weights.iter().map(|&weight| f64::from(weight)).sum();
    let expected: Vec<f64> = weights.iter().map(|&w| f64::from(w) / total * count as f64).collect();
    for observed in &counts {
        let test = chi_square(observed, &expected);
        assert!(test.p_value > 0.003 && test.impossible == 0, "{test:?}");
    }
}

/// The mean of f/pdf is the integral of f where f is proportional to the table nowhere in particular.
#[test]
fn weighting_by_the_density_is_unbiased() {
    let table =
        Piecewise2d::new(5, 3, &[1.0, 2.0, 3.0, 1.0, 0.5, 2.0, 2.0, 9.0, 1.0, 1.0, 1.0, 4.0, 1.0, 1.0, 7.0])
            .unwrap();
    let estimate: Estimate = (0..1 << 16)
        .map(|index| Sampler::at(Sequence::Independent, 2, [0, 0], index).group(Domain::new(0, 0)))
        .map(|u| table.sample([u[0], u[1]]))
        .map(|drawn| f64::from(drawn.position[0]) * f64::from(drawn.position[1]) / f64::from(drawn.pdf))
        .collect();
    let z = estimate.z_score(0.25).unwrap();
    assert!(z.abs() < 4.0, "{z} standard errors");
}

/// An environment map of 4096 × 2048 with a sun: the share of the sun and of the rest come out right.
#[test]
fn a_large_map_is_built_and_sampled() {
    let (width, height) = (4096, 2048);
    let mut weights = vec![1.0f32; width * height];
    let sun = 600 * width + 1234;
    weights[sun] = (width * height) as f32;
    let table = Piecewise2d::new(width, height, &weights).unwrap();
    let total = 2.0 * (width * height) as f64 - 1.0;
    assert!((table.integral() / (total / (width * height) as f64) - 1.0).abs() < 1e-12);
    let in_sun: Estimate = (0..1 << 16)
        .map(|index| Sampler::at(Sequence::Independent, 2, [0, 0], index).group(Domain::new(0, 0)))
        .map(|u| f64::from(table.sample([u[0], u[1]]).cell == [1234, 600]))
        .collect();
    let z = in_sun.z_score((width * height) as f64 / total).unwrap();
    assert!(z.abs() < 4.0, "{z} standard errors");
}
