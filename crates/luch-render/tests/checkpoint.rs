//! What the film file promises: every bit back, every damage noticed.

#![expect(
    clippy::single_range_in_vec_init,
    reason = "samples are given as lists of ranges, some of which have one"
)]

mod checkpoint {
    pub(crate) mod bytes;
}

use checkpoint::bytes::{Header, seal, split};
use luch_image::Rgb;
use luch_render::{
    CameraSample, Checkpoint, CheckpointError, Film, Fingerprint, Integrator, Provenance, Stop, Stopped,
    View, World, render_pass,
};
use luch_sampling::Domain;
use luch_scene::Scene;
use luch_scene::preset::cornell_box;
use proptest::prelude::*;
use std::sync::atomic::AtomicU64;

/// Every kind of number, and an end after some batches.
struct Noise {
    batches: AtomicU64,
}

impl Integrator for Noise {
    fn radiance(
        &self,
        _: &World,
        samples: &[CameraSample],
        radiance: &mut [Rgb],
        _: &Stop,
    ) -> Result<(), Stopped> {
        if self.batches.fetch_sub(1, std::sync::atomic::Ordering::Relaxed) == 0 {
            return Err(Stopped);
        }
        for (sample, radiance) in samples.iter().zip(radiance) {
            let [a, b, c, _] = sample.sampler.group_words(Domain::new(0, 7));
            *radiance = Rgb::new(f32::from_bits(a), f32::from_bits(b), c as f32 * 1e-9 - 2.0);
        }
        Ok(())
    }
}

fn provenance() -> Provenance {
    Provenance {
        source: "scenes/cornell.kdl".into(),
        command: "render cornell.kdl --samples 16".into(),
        version: "0.1.0".into(),
        options: "{\"seed\":7}".into(),
    }
}

/// A film of noise; `batches` of it at most, so that tiles may differ.
fn checkpoint(
    width: u32,
    height: u32,
    ranges: &[std::ops::Range<u64>],
    batches: u64,
    seed: u64,
) -> Checkpoint {
    let mut scene = cornell_box();
    (scene.settings.width, scene.settings.height, scene.settings.seed) = (width, height, seed);
    let camera = scene.cameras[0].camera;
    let view = View::new(&camera, &scene.settings);
    let fingerprint = Fingerprint::of(&scene, &camera);
    let mut empty = Scene::default();
    empty.add_camera(camera);
    let world = World::build(empty).unwrap();
    let noise = Noise { batches: batches.into() };
    let mut film = Film::new(width, height);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    for range in ranges {
        let pass = pool.install(|| {
            let count = AtomicU64::new(0);
            render_pass(&world, &view, &noise, &mut film, range.clone(), &Stop::new(), &count)
        });
        if pass.is_err() {
            break;
        }
    }
    Checkpoint { fingerprint, provenance: provenance(), film }
}

/// All that can be read from a film: nothing of it may panic.
fn read_all(film: &Film) {
    let _ =
        (film.total_samples(), film.min_samples(), film.losses(), film.error(), film.gaps(), film.coverage());
    let _ = (film.to_image(), film.standard_error(), film.sample_counts(), film.holds(&(0..u64::MAX)));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn every_bit_comes_back(
        (width, height) in (1u32..80, 1u32..70),
        first in (0u64..9, 0u64..9),
        second in (20u64..40, 0u64..5),
        batches in 0u64..12,
        seed in any::<u64>(),
    ) {
        let ranges = [first.0..first.0 + first.1, second.0..second.0 + second.1];
        let original = checkpoint(width, height, &ranges, batches, seed);
        let bytes = original.encode();
        prop_assert_eq!(&bytes, &original.encode());
        let decoded = Checkpoint::decode(&bytes).unwrap();
        prop_assert_eq!(&decoded, &original);
        prop_assert_eq!(decoded.encode(), bytes);
    }
}

#[test]
fn the_same_film_by_another_way_is_the_same_file() {
    let straight = checkpoint(40, 35, &[0..12], 99, 3);
    let detour = checkpoint(40, 35, &[8..12, 2..5, 0..12], 99, 3);
    assert_eq!(straight.encode(), detour.encode());
}

#[test]
fn a_cut_file_is_noticed_at_every_length() {
    let bytes = checkpoint(5, 3, &[0..3], 99, 1).encode();
    for length in 0..bytes.len() {
        let error = Checkpoint::decode(&bytes[..length]).unwrap_err();
        match error {
            CheckpointError::Foreign => assert!(length < 8, "{length}"),
            CheckpointError::Damaged { offset, .. } => {
                assert!(offset <= length as u64, "{offset} of {length}")
            }
            other => panic!("{length}: {other}"),
        }
    }
    let longer = [bytes.as_slice(), &[0]].concat();
    assert!(matches!(Checkpoint::decode(&longer), Err(CheckpointError::Damaged { .. })));
}

#[test]
fn every_changed_byte_is_noticed() {
    let bytes = checkpoint(5, 3, &[0..3], 99, 1).encode();
    for place in 0..bytes.len() {
        for change in [1, 0x80, 0xff] {
            let mut changed = bytes.clone();
            changed[place] ^= change;
            let Err(error) = Checkpoint::decode(&changed) else { panic!("byte {place} may change") };
            let expected = match place {
                0..8 => matches!(error, CheckpointError::Foreign),
                8..12 => matches!(error, CheckpointError::Version(_)),
                _ => matches!(error, CheckpointError::Damaged { .. }),
            };
            assert!(expected, "byte {place}: {error}");
        }
    }
}

#[test]
fn other_files_and_versions_are_named() {
    assert_eq!(Checkpoint::decode(b""), Err(CheckpointError::Foreign));
    assert_eq!(Checkpoint::decode(b"\x89PNG\r\n\x1a\n and so on"), Err(CheckpointError::Foreign));
    let mut bytes = checkpoint(5, 3, &[0..3], 99, 1).encode();
    bytes[8] = 2;
    let error = Checkpoint::decode(&bytes).unwrap_err();
    assert_eq!(error, CheckpointError::Version(2));
    assert!(error.to_string().contains("version 2") && error.to_string().contains("reads version 1"));
}

#[test]
fn lying_headers_are_refused_within_the_memory_of_the_file() {
    let original = checkpoint(40, 35, &[0..4], 99, 1);
    let file = split(&original.encode());
    assert_eq!(seal(&file.header, &file.sums), original.encode(), "the test's own writer");
    let refused = |lie: &dyn Fn(&mut Header)| {
        let mut header = file.header.clone();
        lie(&mut header);
        let bytes = seal(&header, &file.sums);
        let Err(error) = Checkpoint::decode(&bytes) else { panic!("a lie is believed") };
        assert!(matches!(error, CheckpointError::Damaged { .. }), "{error}");
        error.to_string()
    };
    for side in [0, 65537, u32::MAX] {
        assert!(refused(&|h| h.width = side).contains(&side.to_string()));
        assert!(refused(&|h| h.height = side).contains(&side.to_string()));
    }
    // As large as can be said: 300 GB that a file of some kilobytes cannot hold.
    assert!(refused(&|h| (h.width, h.height) = (65536, 65536)).contains("cannot hold"));
    refused(&|h| h.width = 41);
    refused(&|h| h.height = 34);
    for exponent in [-61, 21, 127, -128] {
        assert!(refused(&|h| h.exponent = exponent).contains(&format!("2^{exponent}")));
    }
    refused(&|h| h.tiles.truncate(3));
    refused(&|h| h.tiles.push(h.tiles[0].clone()));
    let backward = std::ops::Range { start: 5, end: 2 };
    for lie in
        [vec![3..3], vec![backward], vec![0..4, 4..8], vec![0..4, 2..8], vec![9..12, 0..4], vec![0..u64::MAX]]
    {
        refused(&|h| h.tiles[1].samples = lie.clone());
    }
    refused(&|h| h.tiles[0].losses = [u64::MAX, u64::MAX]);
    refused(&|h| h.tiles[0].losses = [3 * 4 * 1024, 1]);
    let full = |h: &mut Header| h.tiles[0].losses = [3 * 4 * 1024, 0];
    let mut header = file.header.clone();
    full(&mut header);
    assert!(Checkpoint::decode(&seal(&header, &file.sums)).is_ok(), "all samples may be lost");
}

#[test]
fn lying_sums_are_refused() {
    let file = split(&checkpoint(40, 35, &[0..4], 99, 1).encode());
    let decode = |sums: &[u8]| Checkpoint::decode(&seal(&file.header, sums));
    assert!(decode(&file.sums).is_ok());
    assert!(decode(&[]).is_err());
    assert!(decode(&file.sums[..file.sums.len() / 2]).is_err());
    assert!(decode(&vec![0; file.sums.len()]).is_err());
    // One pixel more or less than there is.
    let plain = checkpoint::bytes::unpack(&file.sums);
    assert_eq!(plain.len(), 40 * 35 * 72);
    for length in [plain.len() - 72, plain.len() - 1, plain.len() + 1, plain.len() + 72] {
        let mut other = plain.clone();
        other.resize(length, 0);
        assert!(decode(&checkpoint::bytes::pack(&other)).is_err(), "{length}");
    }
    // Any words are sums: whatever they are, they are read without harm.
    let extremes = vec![0xff_u8; plain.len()].into_iter().map(|byte| byte >> 1).collect::<Vec<_>>();
    read_all(&decode(&checkpoint::bytes::pack(&extremes)).unwrap().film);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]
    #[test]
    fn resealed_nonsense_does_no_harm(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
        of_header in any::<bool>(),
    ) {
        let file = split(&checkpoint(6, 5, &[0..3, 5..6], 99, 1).encode());
        let (mut header, mut sums) = (file.header.to_bytes(), file.sums);
        for (place, value) in changes {
            let bytes = if of_header { &mut header } else { &mut sums };
            let place = place.index(bytes.len());
            bytes[place] = value;
        }
        let bytes = checkpoint::bytes::seal_bytes(&header, &sums);
        if let Ok(mut read) = Checkpoint::decode(&bytes) {
            read_all(&read.film);
            let _ = read.merge(&read.clone());
            prop_assert_eq!(&Checkpoint::decode(&read.encode()).unwrap(), &read);
        }
    }

    #[test]
    fn any_bytes_do_no_harm(mut bytes in prop::collection::vec(any::<u8>(), 0..200), magic in any::<bool>()) {
        if magic {
            bytes.splice(0..0, *b"LUCHFILM\x01\0\0\0");
        }
        prop_assert!(Checkpoint::decode(&bytes).is_err());
    }
}

#[test]
fn films_of_other_pictures_are_not_merged() {
    let mut film = checkpoint(8, 8, &[0..4], 99, 1);
    let before = film.clone();
    let other = checkpoint(8, 8, &[4..8], 99, 2);
    let error = film.merge(&other).unwrap_err();
    assert_eq!(error, CheckpointError::OtherScene(film.fingerprint, other.fingerprint));
    assert_eq!(film, before);
    assert!(error.to_string().contains(&film.fingerprint.to_string()));
    assert!(matches!(film.merge(&before), Err(CheckpointError::Merge(_))));
    assert_eq!(film, before);
    film.merge(&checkpoint(8, 8, &[4..8], 99, 1)).unwrap();
    assert_eq!(film.film, checkpoint(8, 8, &[0..8], 99, 1).film);
}

#[test]
fn a_fingerprint_sees_every_change_that_matters() {
    let scene = cornell_box();
    let of = |scene: &Scene| Fingerprint::of(scene, &scene.cameras[0].camera);
    let changes: [fn(&mut Scene); 8] = [
        |s| s.settings.seed = 1,
        |s| s.settings.width = 255,
        |s| s.settings.sequence = luch_sampling::Sequence::Halton,
        |s| s.settings.filter = luch_scene::Filter::Box { radius: 0.5 },
        |s| s.cameras[0].camera.position.x += 1e-6,
        |s| s.materials[0].surface = luch_scene::Surface::Absorber,
        |s| s.instances.swap(0, 1),
        |s| s.environment = Some(luch_scene::Environment::Constant { radiance: Rgb::BLACK }),
    ];
    let mut seen = vec![of(&scene)];
    assert_eq!(seen[0], of(&scene.clone()));
    for change in changes {
        let mut changed = scene.clone();
        change(&mut changed);
        assert!(!seen.contains(&of(&changed)));
        seen.push(of(&changed));
    }
    // A camera that nobody looks through changes nothing.
    let mut changed = scene.clone();
    changed.add_camera(scene.cameras[0].camera);
    assert_eq!(of(&changed), seen[0]);
    assert_eq!(seen[0].to_hex().len(), 64);
}
