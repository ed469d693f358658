//! Pictures of scenes must not change: the meshes of the seven oldest generators are the same, bit for bit.

use glam::{Vec2, Vec3};
use luch_mesh::{Generator, TriangleMesh};

/// FNV-1a over everything that a renderer sees, in the order in which it sees it.
fn digest(mesh: &TriangleMesh) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut add = |word: u32| {
        for byte in word.to_le_bytes() {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    };
    mesh.positions.iter().flat_map(|p| p.to_array()).for_each(|x| add(x.to_bits()));
    mesh.triangles.iter().flatten().for_each(|i| add(*i));
    mesh.normals.values.iter().flat_map(|n| n.to_array()).for_each(|x| add(x.to_bits()));
    mesh.normals.triangles.iter().flatten().for_each(|i| add(*i));
    for uvs in &mesh.uv_sets {
        uvs.values.iter().flat_map(|uv| uv.to_array()).for_each(|x| add(x.to_bits()));
        uvs.triangles.iter().flatten().for_each(|i| add(*i));
    }
    hash
}

#[test]
fn the_oldest_generators_give_the_same_bits() {
    let cone = |bottom_radius, top_radius, capped| Generator::Cone {
        bottom_radius,
        top_radius,
        height: 1.5,
        segments: 12,
        stacks: 2,
        capped,
    };
    let cases = [
        (Generator::Sphere { radius: 1.5, segments: 12, rings: 6 }, 0x21f6_2b85_d38f_4eb2_u64),
        (Generator::Sphere { radius: 0.3, segments: 3, rings: 2 }, 0x71bf_1f14_a231_6bcf_u64),
        (Generator::Icosphere { radius: 0.5, subdivisions: 0 }, 0x8fed_d168_9755_87e2_u64),
        (Generator::Icosphere { radius: 2.0, subdivisions: 2 }, 0xa42b_157b_c5f6_fbb9_u64),
        (
            Generator::Cuboid { size: Vec3::new(1.0, 2.0, 3.0), divisions: [1, 1, 1] },
            0x297c_bf4c_de28_24a3_u64,
        ),
        (
            Generator::Cuboid { size: Vec3::new(3.0, 0.5, 1.0), divisions: [3, 1, 2] },
            0x8760_780f_c9c2_0198_u64,
        ),
        (Generator::Plane { size: Vec2::new(2.0, 3.0), divisions: [4, 2] }, 0xf032_1a36_9fe4_6d96_u64),
        (
            Generator::Cylinder { radius: 1.0, height: 2.0, segments: 12, stacks: 3, capped: true },
            0x9fdb_cba9_31f3_ff13_u64,
        ),
        (
            Generator::Cylinder { radius: 0.25, height: 1.0, segments: 3, stacks: 1, capped: false },
            0x136e_009c_30ef_630d_u64,
        ),
        (cone(1.0, 0.0, true), 0x9992_0f24_73dd_95d5_u64),
        (cone(1.0, 0.5, true), 0xe810_8a2a_9964_78a6_u64),
        (cone(0.0, 1.0, true), 0xe093_da98_2a9b_921e_u64),
        (cone(1.0, 0.0, false), 0x17b7_ab8b_111f_0161_u64),
        (
            Generator::Torus { major_radius: 2.0, minor_radius: 0.5, segments: 16, sides: 8 },
            0xf119_25c7_eee0_5bbc_u64,
        ),
    ];
    for (generator, expected) in cases {
        let finer = generator.refined(3);
        let found = digest(&generator.mesh()) ^ digest(&finer.mesh()).rotate_left(17);
        assert_eq!(found, expected, "{generator:?}");
    }
}
