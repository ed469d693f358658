//! The whole suite agrees; what is wrong on purpose does not.

use super::*;

#[test]
fn every_routine_of_the_renderer_follows_its_density() {
    let suite: Vec<Routine> = suite().into_iter().filter(|routine| is_named(routine, "all")).collect();
    for family in Family::ALL.into_iter().filter(|family| *family != Family::Planted) {
        assert!(suite.iter().any(|routine| routine.family == family), "{family:?}");
    }
    assert!(suite.len() > 180, "{}", suite.len());
    let settings = FitSettings { samples: 1 << 16, ..FitSettings::default() };
    let verdicts = run_all(&suite, settings, &|_| {});
    let level = level(0.01, suite.len());
    let bad: Vec<_> = verdicts.iter().filter(|verdict| !verdict.agrees(level)).collect();
    assert!(bad.is_empty(), "{bad:#?}");
    assert!(evenness(&verdicts).unwrap() > 1e-3, "p-values are not even");
    assert!(verdicts.iter().all(|verdict| verdict.degrees > 0), "some were not tested");
}

#[test]
fn what_is_wrong_on_purpose_is_rejected() {
    let planted: Vec<Routine> = suite().into_iter().filter(|routine| is_named(routine, "planted")).collect();
    assert_eq!(planted.len(), 3);
    for verdict in run_all(&planted, FitSettings::default(), &|_| {}) {
        assert!(!verdict.agrees(level(0.01, 300)), "{verdict:?}");
    }
    let wrong = Routine::choice("wrong", "", vec![0.51, 0.49], |u| Some(usize::from(u >= 0.5)));
    assert!(!wrong.run(FitSettings::default()).agrees(1e-4));
}

#[test]
fn routines_have_names_and_pictures() {
    let suite = suite();
    let mut ids: Vec<String> = suite.iter().map(Routine::id).collect();
    ids.sort();
    ids.dedup();
    assert_eq!(ids.len(), suite.len());
    let settings = FitSettings { samples: 1 << 14, ..FitSettings::default() };
    for id in ["conductor:2", "sky:1", "alias:1"] {
        let routine = suite.iter().find(|routine| is_named(routine, id)).unwrap();
        let sheet = routine.sheet(settings).unwrap();
        assert!(sheet.to_svg().contains("<svg") && sheet.figures.len() > 1, "{id}");
    }
}
