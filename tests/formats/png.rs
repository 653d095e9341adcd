//! Every kind of PNG: depths, colour types, interlacing, chunks.

use super::*;
use crate::support::fixtures::{LINEAR, SIDE as SMALL, bytes_at, save_maps};
use crate::support::png::{GRAY, GRAY_ALPHA, PALETTE, Png, RGB, RGBA, zlib};

const SIDES: [usize; 2] = [SMALL as usize; 2];

/// The material of the fixtures with a roughness map of these bytes.
fn with_roughness(bytes: &[u8]) -> Read<f64> {
    with("roughness.png", bytes)
}

fn with(name: &str, bytes: &[u8]) -> Read<f64> {
    let folder = tempdir().unwrap();
    save_maps(folder.path(), "");
    std::fs::write(folder.path().join(name), bytes).unwrap();
    open_as(folder.path(), &LINEAR)
}

fn plain(depth: u8, colour: u8) -> Png<'static> {
    Png { size: SIDES, depth, colour, interlaced: false, chunks: &[] }
}

/// A code of `depth` bits for the texel in column x of row y, another one for each.
fn code(x: usize, y: usize, depth: u8) -> u16 {
    let most = u32::from(u16::MAX >> (16 - depth));
    ((x + SMALL as usize * y + 1) as u32 * most / 16) as u16
}

#[test]
fn every_depth_and_colour_type_opens_interlaced_or_not() {
    let (mut tried, opaque) = (0, |depth: u8| u16::MAX >> (16 - depth));
    for (colour, depths) in [
        (GRAY, &[1, 2, 4, 8, 16][..]),
        (RGB, &[8, 16]),
        (PALETTE, &[1, 2, 4, 8]),
        (GRAY_ALPHA, &[8, 16]),
        (RGBA, &[8, 16]),
    ] {
        for &depth in depths {
            // Entry k of the palette is gray 255 - 3 k.
            let palette = (0..1_u16 << depth.min(6)).flat_map(|k| [(255 - 3 * k) as u8; 3]).collect();
            let chunks = [(*b"PLTE", palette)];
            let index = |x, y| code(x, y, depth.min(6));
            for interlaced in [false, true] {
                let chunks: &[_] = if colour == PALETTE { &chunks } else { &[] };
                let png = Png { interlaced, chunks, ..plain(depth, colour) };
                let alpha = |c| colour == GRAY_ALPHA && c == 1 || c == 3;
                let read = with_roughness(&png.bytes(|x, y, c| match colour {
                    PALETTE => index(x, y),
                    _ if alpha(c) => opaque(depth) / 3,
                    _ => code(x, y, depth),
                }));
                for i in 0..SIDES[0] * SIDES[1] {
                    let (x, y) = (i % SIDES[0], i / SIDES[0]);
                    let expected = match colour {
                        PALETTE => f64::from(255 - 3 * index(x, y)) / 255.0,
                        _ => f64::from(code(x, y, depth)) / f64::from(opaque(depth)),
                    };
                    let got = read.material.texel(i).roughness;
                    assert!((got - expected).abs() < 1e-12, "{png:?}, {x}, {y}: {got}, not {expected}");
                }
                let transparent = colour == GRAY_ALPHA || colour == RGBA;
                assert_eq!(
                    read.notes.iter().any(|n| n.to_string().contains("alpha is ignored")),
                    transparent,
                    "{png:?}"
                );
                tried += 1;
            }
        }
    }
    assert_eq!(tried, 30);
}

#[test]
fn one_transparent_gray_is_still_its_gray_and_opaque_alpha_is_not_said() {
    let opaque = with_roughness(&plain(8, GRAY_ALPHA).bytes(|x, _, c| if c == 1 { 255 } else { x as u16 }));
    assert!(!notes(&opaque).contains("alpha"), "{:?}", opaque.notes);
    let chunks = [(*b"tRNS", vec![0, 5])];
    let read = with_roughness(&Png { chunks: &chunks, ..plain(8, GRAY) }.bytes(|x, _, _| x as u16 + 4));
    assert_eq!(read.material.texel(1).roughness, 5.0 / 255.0);
    assert_notes(&read, &["alpha is ignored"]);
}

/// gAMA of 1, a broken iCCP, EXIF that says to turn the picture.
fn colour_chunks() -> [([u8; 4], Vec<u8>); 3] {
    let exif = b"MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0".to_vec();
    [
        (*b"gAMA", 100_000_u32.to_be_bytes().to_vec()),
        (*b"iCCP", b"name\0\0no profile".to_vec()),
        (*b"eXIf", exif),
    ]
}

#[test]
fn chunks_about_colour_and_orientation_change_nothing_and_are_said_where_they_might_matter() {
    let chunks = colour_chunks();
    let png = Png { chunks: &chunks, ..plain(8, RGB) };
    let file = |map| png.bytes(|x, y, c| bytes_at(map, x as u32, y as u32)[c].into());
    let [data, colour] = [with("roughness.png", &file(2)), with("diffuse.png", &file(1))];
    let mut same =
        with("diffuse.png", &plain(8, RGB).bytes(|x, y, c| bytes_at(1, x as u32, y as u32)[c].into()));
    for read in [&data, &colour] {
        same.material = same.material.renamed(read.material.name());
        assert_eq!(read.material, same.material);
        assert_notes(read, &["EXIF orientation, which is ignored"]);
    }
    let said = |read: &Read<f64>| {
        read.notes.iter().any(|n| n.to_string().contains("gAMA chunk that declares it linear"))
    };
    assert_eq!([said(&data), said(&colour)], [false, true]);
}

#[test]
fn what_chunks_declare_of_light_primaries_and_frames_is_said() {
    let numbers = |all: &[u32]| all.iter().flat_map(|n| n.to_be_bytes()).collect::<Vec<u8>>();
    let wide = numbers(&[31_270, 32_900, 68_000, 32_000, 26_500, 69_000, 15_000, 6_000]);
    let usual = numbers(&[31_270, 32_900, 64_000, 33_000, 30_000, 60_000, 15_000, 6_000]);
    for (name, content, said) in [
        (*b"cICP", vec![1, 8, 0, 1], Some("cICP chunk that declares it linear")),
        (*b"cICP", vec![9, 13, 0, 1], Some("cICP chunk with primaries other")),
        (*b"cICP", vec![1, 13, 0, 1], None),
        (*b"cHRM", wide, Some("cHRM chunk with primaries other")),
        (*b"cHRM", usual, None),
        (*b"acTL", numbers(&[3, 0]), Some("several pages or frames")),
        (*b"acTL", numbers(&[1, 0]), None),
    ] {
        let chunks = [(name, content)];
        let png = Png { chunks: &chunks, ..plain(8, RGB) };
        let read = with("diffuse.png", &png.bytes(|x, y, c| bytes_at(1, x as u32, y as u32)[c].into()));
        let count = |words: &str| notes(&read).matches(words).count();
        let all =
            ["declares it linear", "chunk with primaries", "several pages"].map(count).iter().sum::<usize>();
        assert_eq!(all, usize::from(said.is_some()), "{chunks:?}: {}", notes(&read));
        assert!(said.is_none_or(|said| notes(&read).contains(said)), "{chunks:?}: {}", notes(&read));
    }
}

#[test]
fn a_wrong_checksum_in_an_ancillary_chunk_is_no_reason_to_refuse() {
    let chunks = colour_chunks();
    let png = Png { chunks: &chunks, ..plain(8, GRAY) };
    let whole = png.bytes(|x, y, _| code(x, y, 8));
    let expected = with_roughness(&whole).material;
    let mut start = 8;
    for name in [b"IHDR", b"gAMA", b"iCCP", b"eXIf"] {
        let length = u32::from_be_bytes(whole[start..start + 4].try_into().unwrap()) as usize;
        assert_eq!(&whole[start + 4..start + 8], name);
        let end = start + 12 + length;
        let mut damaged = whole.clone();
        damaged[end - 1] ^= 0x55;
        if name != b"IHDR" {
            assert_eq!(
                with_roughness(&damaged).material.planes(),
                expected.planes(),
                "{}",
                String::from_utf8_lossy(name)
            );
        } else {
            // A critical chunk has to be right.
            let folder = tempdir().unwrap();
            save_maps(folder.path(), "");
            std::fs::write(folder.path().join("roughness.png"), damaged).unwrap();
            assert_refused(folder.path(), &["roughness map: expected a valid PNG"]);
        }
        start = end;
    }
    assert_eq!(certainty(&with_roughness(&whole), What::Roughness), Some(Certainty::Given));
}

#[test]
fn a_profile_that_unpacks_to_more_than_any_profile_is_refused() {
    let file = |bytes: usize| {
        let profile = [b"name\0\0".as_slice(), &zlib(&vec![7; bytes])].concat();
        let chunks = [(*b"iCCP", profile)];
        let png = Png { chunks: &chunks, ..plain(8, RGB) };
        png.bytes(|x, y, c| bytes_at(1, x as u32, y as u32)[c].into())
    };
    let usual = with("diffuse.png", &file(1 << 20));
    assert_notes(&usual, &["ICC profile"]);
    let folder = tempdir().unwrap();
    save_maps(folder.path(), "");
    std::fs::write(folder.path().join("diffuse.png"), file(65 << 20)).unwrap();
    let read = svbrdf_files::read::read::<f32>(folder.path(), &LINEAR, &Default::default());
    let error = read.unwrap_err().to_string();
    assert!(error.contains("at most 64 MiB of profiles"), "{error}");
}
