//! Members of the family with many parameters each.

use super::{
    Bsdf, Conductor, ConductorFresnel, Dielectric, Diffuse, Glossy, Phong, Principled, PrincipledParameters,
};
use luch_image::Rgb;

const RED: Rgb = Rgb::new(0.8, 0.2, 0.1);
const BLUE: Rgb = Rgb::new(0.1, 0.3, 0.9);

/// All of them.
pub(super) fn examples() -> Vec<(&'static str, Bsdf)> {
    let mut all = vec![
        ("absorber", Bsdf::Absorber),
        ("diffuse white", Bsdf::Diffuse(Diffuse::new(Rgb::WHITE))),
        ("diffuse red", Bsdf::Diffuse(Diffuse::new(RED))),
        ("diffuse black", Bsdf::Diffuse(Diffuse::new(Rgb::BLACK))),
    ];
    all.extend(conductors());
    all.extend(dielectrics());
    all.extend(principled());
    all.extend(lobes());
    all
}

fn conductors() -> Vec<(&'static str, Bsdf)> {
    let white = ConductorFresnel::from_color(Rgb::WHITE);
    let gold = ConductorFresnel::from_index(Rgb::new(0.18, 0.54, 1.33), Rgb::new(3.43, 2.23, 1.88));
    let blue = ConductorFresnel::from_color(BLUE);
    let single = |fresnel, roughness| Bsdf::Conductor(Conductor::new(fresnel, roughness).uncompensated());
    [
        ("conductor white, roughness 0", white, 0.0),
        ("conductor white, roughness 0.05", white, 0.05),
        ("conductor white, roughness 0.2", white, 0.2),
        ("conductor white, roughness 0.5", white, 0.5),
        ("conductor white, roughness 0.8", white, 0.8),
        ("conductor white, roughness 1", white, 1.0),
        ("conductor gold, roughness 0", gold, 0.0),
        ("conductor gold, roughness 0.3", gold, 0.3),
        ("conductor gold, roughness 1", gold, 1.0),
        ("conductor blue, roughness 0.6", blue, 0.6),
    ]
    .into_iter()
    .map(|(name, fresnel, roughness)| (name, Bsdf::Conductor(Conductor::new(fresnel, roughness))))
    .chain([
        ("conductor gold, roughness 0.3, one bounce", single(gold, 0.3)),
        ("conductor blue, roughness 1, one bounce", single(blue, 1.0)),
    ])
    .collect()
}

fn dielectrics() -> Vec<(&'static str, Bsdf)> {
    [
        ("dielectric 1.5, roughness 0", 1.5, 0.0, Rgb::WHITE),
        ("dielectric 1.5, roughness 0.1", 1.5, 0.1, Rgb::WHITE),
        ("dielectric 1.5, roughness 0.3", 1.5, 0.3, Rgb::WHITE),
        ("dielectric 1.5, roughness 0.6", 1.5, 0.6, Rgb::WHITE),
        ("dielectric 1.5, roughness 1", 1.5, 1.0, Rgb::WHITE),
        ("dielectric 1.33, roughness 0", 1.33, 0.0, Rgb::WHITE),
        ("dielectric 1.33, roughness 0.5", 1.33, 0.5, Rgb::WHITE),
        ("dielectric 2.4, roughness 0.4", 2.4, 0.4, Rgb::WHITE),
        ("dielectric 0.75, roughness 0", 0.75, 0.0, Rgb::WHITE),
        ("dielectric 0.75, roughness 0.5", 0.75, 0.5, Rgb::WHITE),
        ("dielectric 1, roughness 0.5", 1.0, 0.5, Rgb::WHITE),
        ("dielectric 1.5 red, roughness 0", 1.5, 0.0, RED),
        ("dielectric 1.5 red, roughness 0.5", 1.5, 0.5, RED),
    ]
    .into_iter()
    .map(|(name, ior, roughness, tint)| (name, Bsdf::Dielectric(Dielectric::new(ior, roughness, tint))))
    .collect()
}

fn principled() -> Vec<(&'static str, Bsdf)> {
    let plain = PrincipledParameters::default();
    let red = PrincipledParameters { base_color: RED, ..plain };
    [
        ("principled white, roughness 0", PrincipledParameters { roughness: 0.0, ..plain }),
        ("principled white, roughness 0.1", PrincipledParameters { roughness: 0.1, ..plain }),
        ("principled white, roughness 0.5", plain),
        ("principled white, roughness 1", PrincipledParameters { roughness: 1.0, ..plain }),
        ("principled white, ior 2.5", PrincipledParameters { ior: 2.5, roughness: 0.4, ..plain }),
        ("principled white metal", PrincipledParameters { metallic: 1.0, ..plain }),
        (
            "principled white metal, roughness 0",
            PrincipledParameters { metallic: 1.0, roughness: 0.0, ..plain },
        ),
        ("principled white half metal", PrincipledParameters { metallic: 0.5, roughness: 0.7, ..plain }),
        ("principled red, roughness 0.3", PrincipledParameters { roughness: 0.3, ..red }),
        ("principled red metal", PrincipledParameters { metallic: 1.0, roughness: 0.6, ..red }),
        (
            "principled red, blue specular",
            PrincipledParameters { specular_color: BLUE, specular: 0.7, ..red },
        ),
        ("principled red, no specular", PrincipledParameters { specular: 0.0, ..red }),
        ("principled black", PrincipledParameters { base_color: Rgb::BLACK, ..plain }),
        (
            "principled glass, roughness 0",
            PrincipledParameters { transmission: 1.0, roughness: 0.0, ..plain },
        ),
        ("principled glass, roughness 0.5", PrincipledParameters { transmission: 1.0, ..plain }),
        ("principled half glass", PrincipledParameters { transmission: 0.5, roughness: 0.4, ..plain }),
        (
            "principled red half glass, roughness 0",
            PrincipledParameters { transmission: 0.5, roughness: 0.0, ..red },
        ),
        (
            "principled white thin, roughness 0",
            PrincipledParameters { transmission: 1.0, thin_walled: true, roughness: 0.0, ..plain },
        ),
        ("principled white thin", PrincipledParameters { transmission: 1.0, thin_walled: true, ..plain }),
        (
            "principled white half thin",
            PrincipledParameters { transmission: 0.5, thin_walled: true, roughness: 0.8, ..plain },
        ),
        (
            "principled everything",
            PrincipledParameters { metallic: 0.3, transmission: 0.6, specular_color: BLUE, ..red },
        ),
    ]
    .into_iter()
    .map(|(name, parameters)| (name, Bsdf::Principled(Principled::new(parameters))))
    .collect()
}

fn lobes() -> Vec<(&'static str, Bsdf)> {
    let gray = Rgb::gray(0.4);
    vec![
        ("phong 1", Bsdf::Phong(Phong::new(Rgb::BLACK, Rgb::WHITE, 1.0))),
        ("phong 0", Bsdf::Phong(Phong::new(RED * 0.5, gray, 0.0))),
        ("phong 10", Bsdf::Phong(Phong::new(RED * 0.5, gray, 10.0))),
        ("phong 77", Bsdf::Phong(Phong::new(Rgb::BLACK, Rgb::WHITE, 77.0))),
        ("phong 1000", Bsdf::Phong(Phong::new(BLUE * 0.5, gray, 1000.0))),
        ("phong 1000000", Bsdf::Phong(Phong::new(Rgb::BLACK, Rgb::WHITE, 1e6))),
        ("glossy 1", Bsdf::Glossy(Glossy::new(Rgb::WHITE, 1.0))),
        ("glossy 0.99", Bsdf::Glossy(Glossy::new(RED, 0.99))),
        ("glossy 0.9", Bsdf::Glossy(Glossy::new(Rgb::WHITE, 0.9))),
        ("glossy 0.5", Bsdf::Glossy(Glossy::new(BLUE, 0.5))),
        ("glossy 0.1", Bsdf::Glossy(Glossy::new(Rgb::WHITE, 0.1))),
    ]
}
