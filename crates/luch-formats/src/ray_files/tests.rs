use super::*;
use proptest::prelude::*;

fn memory(bytes: &[u8]) -> Files {
    Files::memory([("file".into(), bytes.to_vec())])
}

fn path() -> &'static Path {
    Path::new("file")
}

/// Any numbers at all.
fn ray() -> impl Strategy<Value = Ray> {
    let three = || prop::array::uniform3(any::<f32>()).prop_map(Vec3::from_array);
    (three(), three(), any::<f32>(), any::<f32>()).prop_map(|(origin, direction, t_min, t_max)| Ray {
        origin,
        direction,
        t_min,
        t_max,
    })
}

fn bits(ray: &Ray) -> [u32; 8] {
    let (o, d) = (ray.origin, ray.direction);
    [o.x, o.y, o.z, d.x, d.y, d.z, ray.t_min, ray.t_max].map(f32::to_bits)
}

proptest! {
    #[test]
    fn rays_come_back_bit_by_bit(rays in prop::collection::vec(ray(), 0..20)) {
        let bytes = encode_rays(&rays);
        prop_assert_eq!(bytes.len(), 16 + 32 * rays.len());
        let again = read_rays(path(), &memory(&bytes)).unwrap();
        prop_assert_eq!(again.iter().map(bits).collect::<Vec<_>>(), rays.iter().map(bits).collect::<Vec<_>>());
    }

    #[test]
    fn no_bytes_do_harm(mark in 0..3usize, counts in any::<u64>(), small in any::<bool>(), rest in prop::collection::vec(any::<u8>(), 0..100)) {
        let counts = if small { counts & 0x3_0000_0003 } else { counts };
        let mark = [Kind::Mesh, Kind::Rays, Kind::Hits][mark].mark();
        let files = memory(&[mark.as_slice(), &counts.to_le_bytes(), &rest].concat());
        // Memory for more records than the file has would end the test.
        if let Ok(mesh) = read_mesh(path(), &files) {
            prop_assert!(mesh.validate().is_empty());
        }
        let rays = read_rays(path(), &files).map_or(0, |rays| rays.len());
        let hits = read_hits(path(), &files).map_or(0, |hits| hits.len());
        prop_assert!(rays * 32 <= rest.len() && hits * 16 <= rest.len());
    }
}

#[test]
fn the_layout_is_as_described() {
    let ray =
        Ray { origin: Vec3::new(1.0, 2.0, 3.0), t_min: 4.0, direction: Vec3::new(5.0, 6.0, 7.0), t_max: 8.0 };
    let mut expected = b"RAYS0001\x01\0\0\0\0\0\0\0".to_vec();
    expected.extend((1..=8u8).flat_map(|i| f32::from(i).to_le_bytes()));
    assert_eq!(encode_rays(&[ray]), expected);

    let hit = Hit { t: 0.5, u: 0.25, v: 0.125, primitive: 7 };
    let records = [
        RecordedHit::nearest(&ray, Some(&hit)),
        RecordedHit::nearest(&ray, None),
        RecordedHit::any(true),
        RecordedHit::any(false),
    ];
    let bytes = encode_hits(&records);
    assert_eq!(read_hits(path(), &memory(&bytes)).unwrap(), records);
    assert_eq!(
        bytes[16..32],
        [0.5f32.to_bits(), 0.25f32.to_bits(), 0.125f32.to_bits(), 7].map(u32::to_le_bytes).concat()
    );
    assert_eq!(bytes[32..48], [8f32.to_bits(), 0, 0, u32::MAX].map(u32::to_le_bytes).concat());
    assert_eq!([records[2].t, records[3].t], [-1.0, 0.0]);

    let positions = [Vec3::ZERO, Vec3::X, Vec3::Y];
    let bytes = encode_mesh(&positions, &[[0, 1, 2]]).unwrap();
    assert_eq!(bytes[..16], *b"TRIS0001\x03\0\0\0\x01\0\0\0");
    let mesh = read_mesh(path(), &memory(&bytes)).unwrap();
    assert_eq!(
        (mesh.positions.as_slice(), mesh.triangles.as_slice()),
        (positions.as_slice(), [[0, 1, 2]].as_slice())
    );
}

#[test]
fn errors_say_where_and_what() {
    let ray = encode_rays(&[Ray::new(Vec3::ZERO, Vec3::X)]);
    let told = |bytes: &[u8]| read_rays(path(), &memory(bytes)).unwrap_err().to_string();
    assert_eq!(told(b""), "file: byte 0: starts with \"\", expected \"RAYS0001\"");
    assert!(told(b"HITS0001\0\0\0\0\0\0\0\0").contains("starts with \"HITS0001\""));
    assert_eq!(told(&ray[..12]), "file: byte 12: ends inside its header");
    assert_eq!(told(&ray[..47]), "file: byte 8: has 47 bytes; with the counts of its header it must have 48");
    assert!(told(&[ray.as_slice(), &[0]].concat()).contains("has 49 bytes"));
    let many = [b"RAYS0001".as_slice(), &[0xff; 8]].concat();
    assert!(told(&many).contains("it must have 18446744073709551615"));

    let told = |positions: &[Vec3], triangle| {
        let bytes = encode_mesh(positions, &[triangle]).unwrap();
        read_mesh(path(), &memory(&bytes)).unwrap_err().to_string()
    };
    assert_eq!(
        told(&[Vec3::ZERO; 3], [0, 3, 1]),
        "file: byte 52: triangle 0 has the corners [0, 3, 1]; there are 3 vertices"
    );
    assert!(told(&[Vec3::ZERO, Vec3::NAN], [0, 0, 0]).starts_with("file: byte 28: vertex 1 is at [NaN"));
    assert_eq!(read_hits(path(), &Files::memory([])).unwrap_err().to_string(), "file: no such file");
}
