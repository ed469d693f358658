//! Scenes with known answers: every integrator that applies, with every sequence, must find them within four standard errors,
//! which must be small. One test for each family.

use luch_lab::truth::{Choice, Effort, Family, Judgement, run};
use luch_render::Stop;

fn expect(family: Family) {
    let effort = Effort::default();
    let rows = run(&family.cases(), &Choice::all(), effort, &Stop::new(), &Default::default())
        .expect("sound scenes");
    let complaint = |row: &luch_lab::truth::Row| {
        let what = row.verdict.complaint(effort)?;
        Some(format!("\n  {}, {} with {}: {what}", row.case, row.way, row.sequence.name()))
    };
    let complaints: String = rows.iter().filter_map(complaint).collect();
    assert!(complaints.is_empty(), "{}: {complaints}", family.name());
    assert!(Judgement::of(&rows, effort, 0.01).is_accepted());
}

macro_rules! families {
    ($($name:ident: $family:ident,)*) => {
        $(#[test] fn $name() { expect(Family::$family); })*

        #[test]
        fn no_family_is_forgotten() {
            assert_eq!(Family::ALL.to_vec(), [$(Family::$family),*]);
        }
    };
}

families! {
    f1_an_enclosure_shows_emission_over_one_minus_albedo: F1,
    f2_a_point_light_in_the_middle_of_a_sphere: F2,
    f3_a_sphere_that_glows_in_part_has_the_same_indirect_light_everywhere: F3,
    f4_concentric_spheres: F4,
    f5_parallel_planes_that_reach_far: F5,
    f6_a_convex_body_in_uniform_light_shows_its_albedo_and_a_white_one_vanishes: F6,
    f7_white_concave_bodies_vanish_too: F7,
    f8_what_absorbs_nothing_vanishes: F8,
    f10_sun_point_and_spot: F10,
    f11_a_lambert_plane_under_a_uniform_sky: F11,
    f12_a_lambert_sphere_with_the_sun_behind_the_viewer: F12,
    f14_lamps_over_a_floor: F14,
    f15_lamps_and_skies_seen_in_part: F15,
    what_is_there_in_part_lets_through_and_shines_in_part: Alpha,
    what_has_only_a_front_lets_rays_from_behind_pass: Sides,
    a_mixture_reflects_the_mean_of_its_parts: Mixture,
    vertex_colours_multiply: Color,
    what_is_out_of_focus_is_blurred_by_the_lens: Lens,
    the_glossy_disc_sees_the_lamp_with_the_part_of_its_area_that_points_there: Glossy,
}
