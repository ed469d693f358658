//! Reference vectors as published, and the contract of all members.

use super::counter::{ChaCha, Philox};
use super::pcg::{Pcg32, Pcg64Dxsm};
use super::quality::{Test, Verdict};
use super::shift::{Xorshift128Plus, Xoshiro256PlusPlus};
use super::stream::Source;
use super::twister::{Twister32, Twister64};
use super::*;

fn first<const N: usize>(mut source: impl Source) -> [u64; N] {
    std::array::from_fn(|_| source.next())
}

fn natives<const N: usize>(generator: Generator, seed: u64) -> [u64; N] {
    let mut stream = generator.start(seed);
    std::array::from_fn(|_| stream.next_native())
}

fn nth(generator: Generator, seed: u64, n: usize) -> u64 {
    let mut stream = generator.start(seed);
    (1..n).for_each(|_| _ = stream.next_native());
    stream.next_native()
}

#[test]
fn congruences_give_their_published_numbers() {
    assert_eq!(natives(Generator::Randu, 1), [65_539, 393_225, 1_769_499, 7_077_969, 26_542_323]);
    assert_eq!(
        natives(Generator::AnsiC, 0),
        [12_345, 1_406_932_606, 654_583_775, 1_449_466_924, 229_283_573]
    );
    assert_eq!(natives(Generator::AnsiC, 1), [1_103_527_590, 377_401_575, 662_824_084, 1_147_902_781]);
    assert_eq!(natives(Generator::Msvc, 0), [38, 7_719, 21_238, 2_437, 8_855]);
    // "Random number generators: good ones are hard to find" (1988); the C++ standard, 26.6.5.
    assert_eq!(nth(Generator::Minstd16807, 1, 10_000), 1_043_618_065);
    assert_eq!(nth(Generator::Minstd48271, 1, 10_000), 399_268_537);
    // Numerical Recipes in C, 7.1.
    let quick = [0x3c6e_f35f, 0x4750_2932, 0xd1cc_f6e9, 0xaaf9_5334, 0x6252_e503, 0x9f2e_c686, 0x57fe_6c2d];
    assert_eq!(natives(Generator::Lcg32, 0), quick);
    assert_eq!(
        natives(Generator::Lcg64, 0),
        [1_442_695_040_888_963_407, 1_876_011_003_808_476_466, 11_166_244_414_315_200_793]
    );
    let mut posix = Generator::Drand48.start(0);
    let numbers: [f64; 3] = std::array::from_fn(|_| posix.unit_f64());
    assert_eq!(numbers, [0.170_828_036_106_289_72, 0.749_901_980_484_963_8, 0.096_371_655_623_567_42]);
}

#[test]
fn mersenne_twisters_give_their_reference_vectors() {
    assert_eq!(
        first(Twister32::from_array(&[0x123, 0x234, 0x345, 0x456])),
        [1_067_595_299, 955_945_823, 477_289_528, 4_107_218_783, 4_228_976_476]
    );
    assert_eq!(
        first(Twister64::from_array(&[0x12345, 0x23456, 0x34567, 0x45678])),
        [
            7_266_447_313_870_364_031,
            4_946_485_549_665_804_864,
            16_945_909_448_695_747_420,
            16_394_063_075_524_226_720,
            4_873_882_236_456_199_058
        ]
    );
    assert_eq!(
        natives(Generator::Mt19937, 5489),
        [3_499_211_612, 581_869_302, 3_890_346_734, 3_586_334_585, 545_404_204]
    );
    // The C++ standard, 26.6.5: the ten-thousandth number of the default seeds.
    assert_eq!(nth(Generator::Mt19937, 5489, 10_000), 4_123_659_995);
    assert_eq!(nth(Generator::Mt19937x64, 5489, 10_000), 9_981_545_732_273_789_042);
}

#[test]
fn small_generators_give_their_reference_vectors() {
    assert_eq!(
        first(Xoshiro256PlusPlus { words: [1, 2, 3, 4] }),
        [41_943_041, 58_720_359, 3_588_806_011_781_223, 3_591_011_842_654_386, 9_228_616_714_210_784_205]
    );
    assert_eq!(
        natives(Generator::SplitMix64, 1_234_567),
        [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
            4_593_380_528_125_082_431,
            16_408_922_859_458_223_821
        ]
    );
    // The definition in the paper, worked out with whole numbers.
    assert_eq!(
        first(Xorshift128Plus { words: [1, 2] }),
        [3, 8_388_645, 33_816_707, 70_368_778_527_840, 211_106_267_172_129, 281_552_312_399_723]
    );
    // The demonstration of the PCG library.
    assert_eq!(
        first(Pcg32::new(42, 54)),
        [0xa15c_02b7, 0x7b47_f409, 0xba1d_3330, 0x83d2_f293, 0xbfa4_784b, 0xcbed_606e]
    );
    // NumPy's PCG64DXSM from this state.
    assert_eq!(
        first(Pcg64Dxsm {
            state: 0x0123_4567_89ab_cdef_fedc_ba98_7654_3210,
            increment: 0xdead_beef_cafe_babe_1234_5678_8765_4321,
        }),
        [
            0xa5c2_f459_58c6_44a2,
            0x0314_ab0c_211e_4ba6,
            0xd27d_a36d_9575_9b8f,
            0xe48a_f2f7_a2d4_9d3f,
            0x74a7_2fb7_7e68_330e
        ]
    );
}

#[test]
fn counter_generators_give_their_reference_vectors() {
    // Known answers of the Random123 library.
    assert_eq!(Philox::block([0; 4], [0; 2]), [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]);
    assert_eq!(
        Philox::block([u32::MAX; 4], [u32::MAX; 2]),
        [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]
    );
    assert_eq!(
        Philox::block([0x243f_6a88, 0x85a3_08d3, 0x1319_8a2e, 0x0370_7344], [0xa409_3822, 0x299f_31d0]),
        [0xd16c_fe09, 0x94fd_cceb, 0x5001_e420, 0x2412_6ea1]
    );
    // Key and nonce zero: RFC 8439, A.1, and the eSTREAM vectors.
    assert_eq!(
        first(ChaCha::<10>::new([0; 4])).map(|word| (word as u32).to_le_bytes()),
        [
            [0x76, 0xb8, 0xe0, 0xad],
            [0xa0, 0xf1, 0x3d, 0x90],
            [0x40, 0x5d, 0x6a, 0xe5],
            [0x53, 0x86, 0xbd, 0x28]
        ]
    );
    assert_eq!(
        first(ChaCha::<4>::new([0; 4])).map(|word| (word as u32).to_le_bytes()),
        [
            [0x3e, 0x00, 0xef, 0x2f],
            [0x89, 0x5f, 0x40, 0xd6],
            [0x7f, 0x5b, 0xb8, 0xe8],
            [0x1f, 0x09, 0xa5, 0xa1]
        ]
    );
}

#[test]
fn names_lead_back() {
    for generator in Generator::ALL {
        assert_eq!(Generator::from_name(generator.name()), Some(generator));
        assert!(!generator.description().is_empty());
    }
    assert_eq!(Generator::from_name("rand"), None);
}

#[test]
fn bulk_and_single_numbers_agree() {
    for generator in Generator::ALL {
        let (mut one, mut many, mut raw) = (generator.start(77), generator.start(77), generator.start(77));
        let mut numbers = [0.0; 100];
        many.fill_unit(&mut numbers);
        let mut bytes = [0u8; 60];
        // In two unequal pieces: bits left over must not be lost.
        raw.fill_bytes(&mut bytes[..7]);
        raw.fill_bytes(&mut bytes[7..]);
        let mut position = 0;
        for number in numbers {
            let native = one.next_native();
            assert!((0.0..1.0).contains(&number), "{generator:?}");
            assert!(native >> (generator.bits() - 1) <= 1, "{generator:?}: more bits than it says");
            for bit in 0..generator.bits() {
                if position < 480 {
                    assert_eq!(
                        bytes[position / 8] >> (position % 8) & 1,
                        (native >> bit) as u8 & 1,
                        "{generator:?}"
                    );
                    position += 1;
                }
            }
        }
        let mut again = generator.start(77);
        assert_eq!(again.unit_f64(), numbers[0]);
    }
}

/// What a good generator must pass: everything.
const GOOD: [Generator; 7] = [
    Generator::Pcg32,
    Generator::Pcg64Dxsm,
    Generator::Xoshiro256PlusPlus,
    Generator::SplitMix64,
    Generator::Philox4x32,
    Generator::ChaCha8,
    Generator::ChaCha20,
];

#[test]
fn good_generators_pass_every_test() {
    for generator in GOOD {
        for test in Test::ALL {
            let result = test.run(generator, 2024);
            assert_eq!(result.verdict(), Verdict::Passes, "{generator:?} {test:?} {result:?}");
        }
    }
}

/// The test that each other generator fails.
const FAILS: [(Generator, Test); 11] = [
    (Generator::Randu, Test::Killer),
    (Generator::AnsiC, Test::LowGap),
    (Generator::Msvc, Test::BirthdaySpacings),
    (Generator::Minstd16807, Test::BirthdaySpacings),
    (Generator::Minstd48271, Test::BirthdaySpacings),
    (Generator::Drand48, Test::WideBirthdaySpacings),
    (Generator::Lcg32, Test::LowRank),
    (Generator::Lcg64, Test::LowGap),
    (Generator::Mt19937, Test::LowComplexity),
    (Generator::Mt19937x64, Test::LowComplexity),
    (Generator::Xorshift128Plus, Test::LowRank),
];

#[test]
fn bad_generators_fail_the_test_made_for_them() {
    for (generator, test) in FAILS {
        let result = test.run(generator, 2024);
        assert_eq!(result.verdict(), Verdict::Fails, "{generator:?} {test:?} {result:?}");
    }
    assert_eq!(FAILS.len() + GOOD.len(), Generator::ALL.len());
}
