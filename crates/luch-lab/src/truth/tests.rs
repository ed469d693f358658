use super::*;
use luch_render::Stop;
use luch_sampling::Sequence;
use std::sync::atomic::AtomicUsize;

#[test]
fn cases_have_names_of_their_own_sound_scenes_and_somebody_who_finds_them() {
    let cases = cases();
    let names: std::collections::BTreeSet<_> =
        cases.iter().map(|case| (case.family.name(), case.name.clone())).collect();
    assert_eq!(names.len(), cases.len());
    for case in &cases {
        assert_eq!(case.scene.problems().len(), 0, "{} {}", case.family.name(), case.name);
        assert!(!case.ways.is_empty() && case.truth.is_finite() && case.truth >= 0.0, "{}", case.name);
        // What is nought has no relative error.
        assert!(case.truth > 0.0 || case.ways.iter().all(|way| way.kind == Kind::Exact), "{}", case.name);
    }
    for family in Family::ALL {
        assert_eq!(Family::from_name(&family.name().to_lowercase()), Some(family));
        assert!(cases.iter().any(|case| case.family == family) && family.shows().ends_with('.'));
    }
    for technique in Technique::ALL {
        assert_eq!(Technique::from_name(technique.name()), Some(technique));
        assert!(cases.iter().flat_map(|case| &case.ways).any(|way| way.technique() == Some(technique)));
    }
}

fn rows(cases: &[Case], choice: &Choice) -> Vec<Row> {
    let done = AtomicUsize::new(0);
    let rows = run(cases, choice, Effort::default(), &Stop::new(), &done).unwrap();
    assert_eq!([rows.len(), done.into_inner()], [choice.count(cases); 2]);
    rows
}

#[test]
fn a_wrong_truth_is_rejected() {
    let choice = Choice { sequences: vec![Sequence::Sobol], techniques: Technique::ALL.to_vec() };
    let right = Family::F11.cases();
    let judgement = |rows: &[Row]| Judgement::of(rows, Effort::default(), 0.01);
    let found = rows(&right, &choice);
    assert!(judgement(&found).is_accepted() && judgement(&found).untold == 0, "{found:?}");
    assert!(found.iter().all(|row| row.verdict.complaint(Effort::default()).is_none()));
    for factor in [0.97, 1.03] {
        let wrong: Vec<Case> =
            right.iter().map(|case| Case { truth: factor * case.truth, ..case.clone() }).collect();
        let found = rows(&wrong, &choice);
        assert_eq!(judgement(&found).rejected, found.len(), "{found:?}");
        assert!(found.iter().all(|row| row.verdict.complaint(Effort::default()).is_some()));
    }
}

#[test]
fn a_request_to_stop_ends_it_and_keeps_what_is_finished() {
    let stop = Stop::new();
    stop.request();
    let found = run(&Family::F4.cases(), &Choice::all(), Effort::default(), &stop, &Default::default());
    assert_eq!(found.unwrap(), []);
}
