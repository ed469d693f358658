//! Work shared among machines.

use crate::workplace::{SCENE, Workplace};

/// Four films that together are samples 0..16.
fn parts(place: &Workplace) {
    for (name, samples) in [("a", "0..3"), ("b", "3..8"), ("c", "8..15"), ("d", "15..16")] {
        place.done(&format!("render scene.kdl --samples {samples} -o {name}.luch"));
    }
}

#[test]
fn films_join_in_any_order_to_the_film_of_one_run() {
    let place = Workplace::new();
    parts(&place);
    place.done("render scene.kdl --spp 16 -o whole.luch");
    for order in ["a b c d", "d c b a", "c a d b"] {
        let films = order.split(' ').map(|name| format!("{name}.luch")).collect::<Vec<_>>().join(" ");
        place.done(&format!("merge {films} -o merged.luch"));
        assert_eq!(place.film("merged.luch"), place.film("whole.luch"), "{order}");
    }
    place.done("reproduce merged.luch");
}

#[test]
fn what_cannot_be_joined_is_refused_by_name() {
    let place = Workplace::new();
    parts(&place);
    place.done("render scene.kdl --samples 2..4 -o overlap.luch");
    place.done("render scene.kdl --samples 3..8 --seed 1 -o seed.luch");
    place.done("render scene.kdl --samples 3..8 --size 40x48 -o size.luch");
    place.write("other.kdl", &SCENE.replace("0.8 0.5 0.3", "0.8 0.5 0.2"));
    place.done("render other.kdl --samples 3..8 -o other.luch");

    let said = place.fails("merge a.luch c.luch overlap.luch -o x.luch", 1);
    for word in ["a.luch", "overlap.luch", "2..3"] {
        assert!(said.err.contains(word), "{}", said.err);
    }
    for other in ["seed", "size", "other"] {
        let said = place.fails(&format!("merge a.luch {other}.luch -o x.luch"), 1);
        assert!(said.err.contains(&format!("{other}.luch")), "{}", said.err);
    }
    let said = place.fails("merge a.luch c.luch -o x.luch", 1);
    assert!(said.err.contains("3..8"), "{}", said.err);
    assert!(!place.path("x.luch").exists());
    let said = place.done("merge a.luch c.luch -o x.luch --allow-gaps");
    assert!(said.err.contains("3..8"), "{}", said.err);
    place.done("reproduce x.luch");

    // Damage and other files.
    let mut bytes = place.bytes("a.luch");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(place.path("damaged.luch"), bytes).unwrap();
    assert!(place.fails("merge a.luch damaged.luch -o y.luch", 1).err.contains("damaged.luch"));
    assert!(place.fails("merge a.luch scene.kdl -o y.luch", 1).err.contains("LUCHFILM"));
}
