//! Damaged files for every reader: a valid material, or an error of the kind that this damage causes; never a panic.
//!
//! It stands in for cargo-fuzz, which needs a nightly compiler. `SVBRDF_MUTATIONS=40000 cargo test mutations --
//! --nocapture` tries more than the usual number for each reader, and prints how many opened and were refused.

use std::io::Cursor;
use std::path::Path;

use exr::prelude::Compression;
use image::{DynamicImage, ImageFormat};
use rand::rngs::ChaCha8Rng;
use rand::{Rng as _, SeedableRng as _};
use svbrdf::error::Error;
use svbrdf::files::read::{
    Binding, Grid, NonFinite, Order, Read, ReadOptions, Reflectance, read, read_bytes,
};
use svbrdf::progress::Progress;
use tempfile::tempdir;

use crate::scene_files::{GLTF_PBR, STANDARD_SURFACE, glb, gltf_text, mtl};
use crate::support::pictures::{SIDE, compressed, layered, multi_part, npy, npz, packed, stored};
use crate::support::png::{self, Png, crc32};

/// Inputs for each reader in a usual run.
const BUDGET: usize = 400;

fn budget() -> usize {
    std::env::var("SVBRDF_MUTATIONS").ok().and_then(|n| n.parse().ok()).unwrap_or(BUDGET)
}

fn written(write: impl Fn(&Path)) -> Vec<u8> {
    let folder = tempdir().unwrap();
    let path = folder.path().join("m");
    write(&path);
    std::fs::read(path).unwrap()
}

fn encoded(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

/// A damaged copy of `bytes`: truncated, bits flipped, a stretch overwritten with extremes, or a part doubled.
fn damaged(bytes: &[u8], random: &mut ChaCha8Rng) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    let mut below = |limit: usize| random.next_u32() as usize % limit.max(1);
    // Headers decide most: half of the damage goes to them.
    let reach = if below(2) == 0 { bytes.len().min(400) } else { bytes.len() };
    let at = below(reach);
    match below(5) {
        0 => bytes.truncate(at),
        1 => (0..=below(8)).for_each(|_| {
            let place = below(reach);
            bytes[place] ^= 1 << below(8);
        }),
        2 => {
            let extreme = [0x00, 0xff, 0x7f, 0x80][below(4)];
            let end = bytes.len().min(at + 1 + below(8));
            bytes[at..end].fill(extreme);
        }
        3 => {
            let part = bytes[at..bytes.len().min(at + 64)].to_vec();
            bytes.splice(at..at, part);
        }
        _ => {
            let end = bytes.len().min(at + 1 + below(16));
            bytes.drain(at..end);
        }
    }
    bytes
}

const OPTIONS: ReadOptions = ReadOptions { non_finite: Some(NonFinite::Replace), ..ReadOptions::AUTO };

fn in_memory(bytes: &[u8]) -> Result<Read<f32>, Error> {
    read_bytes("damaged", bytes, &OPTIONS)
}

/// Whether a damaged picture can cause this error: it cannot be decoded, or it is no longer a packed or layered
/// material. An error of the picture has to name the file.
fn of_picture(error: &Error) -> bool {
    match error {
        Error::BadImage { path, .. } | Error::NotPacked { path, .. } | Error::NotAMaterial { path, .. } => {
            path == Path::new("damaged")
        }
        // A float that is too large for the material.
        Error::OutOfRange { whose, .. } => whose == "damaged",
        Error::MapSizesDiffer { .. } => true,
        _ => false,
    }
}

/// Whether a damaged file that lists textures can cause this error: also, a texture that it names cannot be read.
fn of_listing(error: &Error) -> bool {
    match error {
        Error::BadImage { .. } | Error::Unreadable { .. } | Error::MapSizesDiffer { .. } => true,
        Error::NotAMaterial { path, .. } | Error::NoTextures { path, .. } => named_damaged(path),
        _ => false,
    }
}

/// Whether a damaged sidecar file can cause this error: it is refused, or its options do not fit the picture.
fn of_sidecar(error: &Error) -> bool {
    match error {
        Error::BadSidecar { path, .. }
        | Error::NotPacked { path, .. }
        | Error::NoSuchExemplar { path, .. } => named_damaged(path),
        Error::BadImage { .. } | Error::NotAMaterial { .. } | Error::MapSizesDiffer { .. } => true,
        _ => false,
    }
}

fn named_damaged(path: &Path) -> bool {
    path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("damaged"))
}

#[test]
fn an_error_of_another_kind_or_file_is_not_accepted() {
    let bad = |path: &str| Error::BadImage { path: path.into(), problem: "p".into(), remedy: "r".into() };
    assert!(of_picture(&bad("damaged")) && !of_picture(&bad("damaged.png")) && !of_picture(&bad("other")));
    let internal = || Error::Internal("damaged".to_owned());
    for is_expected in [of_picture, of_listing, of_sidecar] {
        assert!(!is_expected(&internal()) && !is_expected(&Error::Usage("damaged".to_owned())));
    }
    let absent = Error::unreadable(Path::new("damaged"), std::io::ErrorKind::NotFound.into());
    assert!(!of_picture(&absent) && of_listing(&absent) && !of_sidecar(&absent));
}

#[test]
#[should_panic(expected = "planted: Internal")]
fn a_reader_that_blames_itself_is_not_accepted() {
    let opened = std::cell::Cell::new(false);
    let whole = encoded(&packed("NDRS", 4, |_, v| v), ImageFormat::Png);
    let open = |bytes: &[u8]| match opened.replace(true) {
        false => in_memory(bytes),
        true => Err(Error::Internal("damaged".to_owned())),
    };
    try_all("planted", &whole, damaged, open, of_picture);
}

/// Opens damaged copies of `whole`, each made by `damage`.
fn try_all(
    reader: &str,
    whole: &[u8],
    damage: impl Fn(&[u8], &mut ChaCha8Rng) -> Vec<u8>,
    open: impl Fn(&[u8]) -> Result<Read<f32>, Error>,
    is_expected: impl Fn(&Error) -> bool,
) {
    open(whole).unwrap_or_else(|e| panic!("{reader}: {e}"));
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let (mut opened, mut refused) = (0, 0);
    for _ in 0..budget() {
        match open(&damage(whole, &mut random)) {
            Ok(read) => {
                let planes = read.material.planes();
                let channels = planes.diffuse.iter().chain(&planes.specular).chain([&planes.roughness]);
                assert!(channels.flatten().all(|value| (0.0..=1.0).contains(value)), "{reader}");
                assert!(planes.normal.iter().flatten().all(|n| n.abs() <= 1.0 + 1e-6), "{reader}");
                opened += 1;
            }
            Err(error) => {
                assert!(is_expected(&error), "{reader}: {error:?}");
                refused += 1;
            }
        }
    }
    println!("{reader}: {opened} opened, {refused} refused");
    assert!(refused > 0, "{reader}");
}

#[test]
fn damaged_pictures_never_panic() {
    let eight = packed("NDRS", 4, |_, v| v);
    let [sixteen, float] = [eight.to_rgb16().into(), eight.to_rgb32f().into()];
    for (what, image, format) in [
        ("PNG of 8 bits", &eight, ImageFormat::Png),
        ("PNG of 16 bits", &sixteen, ImageFormat::Png),
        ("JPEG", &eight, ImageFormat::Jpeg),
        ("HDR", &float, ImageFormat::Hdr),
        ("TIFF of 8 bits", &eight, ImageFormat::Tiff),
        ("TIFF of 16 bits", &sixteen, ImageFormat::Tiff),
        ("TIFF of floats", &float, ImageFormat::Tiff),
    ] {
        try_all(what, &encoded(image, format), damaged, in_memory, of_picture);
    }
}

/// An interlaced PNG of a palette of 256 grays.
fn palette() -> Vec<u8> {
    let chunks = [(*b"PLTE", (0..=255).flat_map(|k| [k; 3]).collect()), (*b"gAMA", vec![0, 0, 0xb1, 0x8f])];
    let (size, colour) = ([4 * SIDE, SIDE], png::PALETTE);
    let png = Png { size, depth: 8, colour, interlaced: true, chunks: &chunks };
    png.bytes(|x, y, _| (255.0 * stored(x / SIDE, x % SIDE, y, |v| v)[2]) as u16)
}

#[test]
fn damaged_png_with_right_checksums_never_panics() {
    let signed = |whole: &[u8], random: &mut ChaCha8Rng| {
        let mut bytes = damaged(whole, random);
        sign(&mut bytes);
        bytes
    };
    try_all("PNG of a palette, signed again", &palette(), signed, in_memory, of_picture);
    let eight = encoded(&packed("NDRS", 4, |_, v| v), ImageFormat::Png);
    try_all("PNG of 8 bits, signed again", &eight, signed, in_memory, of_picture);
}

/// Makes the checksum of every chunk of a PNG right, as far as there are chunks.
fn sign(png: &mut [u8]) {
    let mut start = 8;
    while let Some(length) = png.get(start..start + 4) {
        let length = u32::from_be_bytes([length[0], length[1], length[2], length[3]]) as usize;
        let end = start + 8 + length;
        let Some(checksum) = png.get(start + 4..end).map(crc32) else { return };
        let Some(place) = png.get_mut(end..end + 4) else { return };
        place.copy_from_slice(&checksum.to_be_bytes());
        start = end + 4;
    }
}

#[test]
fn damaged_layered_exr_never_panics() {
    try_all("EXR of one part", &written(|path| layered(path, true)), damaged, in_memory, of_picture);
    try_all("EXR of four parts", &written(multi_part), damaged, in_memory, of_picture);
}

#[test]
fn damaged_exr_of_every_compression_never_panics() {
    use Compression::{B44, B44A, DWAA, DWAB, PIZ, PXR24, RLE, Uncompressed, ZIP1, ZIP16};
    let mut sizes = Vec::new();
    for compression in [Uncompressed, RLE, ZIP1, ZIP16, PIZ, PXR24, B44, B44A, DWAA(None), DWAB(None)] {
        let whole = written(|path| compressed(path, compression));
        // What does not shrink is stored as it is, and would not try the decoder.
        assert!(
            !sizes.contains(&whole.len()) && sizes.iter().take(1).all(|size| whole.len() < *size),
            "{sizes:?}"
        );
        sizes.push(whole.len());
        try_all(&format!("EXR, {compression}"), &whole, damaged, in_memory, of_picture);
    }
    println!("{sizes:?} bytes");
}

#[test]
fn damaged_numpy_files_never_panic() {
    let image = packed("NDRS", 4, |_, v| v).to_rgb32f();
    let shape = [u64::from(image.height()), u64::from(image.width()), 3];
    try_all("npy", &npy(shape, image.as_raw()), damaged, in_memory, of_picture);
    try_all("npz", &written(npz), damaged, in_memory, of_picture);
}

#[test]
fn damaged_files_that_name_textures_never_panic() {
    let (folder, _) = mtl::wall("");
    for (name, whole) in [
        ("damaged.gltf", gltf_text()),
        ("damaged.glb", glb(folder.path())),
        ("damaged.mtlx", GLTF_PBR.as_bytes().to_vec()),
        ("damaged.mtl", mtl::PBR.as_bytes().to_vec()),
        ("damaged2.mtlx", STANDARD_SURFACE.as_bytes().to_vec()),
    ] {
        let path = folder.path().join(name);
        try_all(
            name,
            &whole,
            damaged,
            |bytes| {
                std::fs::write(&path, bytes).unwrap();
                read(&path, &OPTIONS, &Progress::default())
            },
            of_listing,
        );
    }
}

#[test]
fn damaged_sidecar_files_never_panic() {
    let folder = tempdir().unwrap();
    let image = packed("NDRS", 4, |_, v| v);
    image.save_with_format(folder.path().join("damaged.png"), ImageFormat::Png).unwrap();
    let gray = packed("R", 1, |_, v| v);
    gray.save_with_format(folder.path().join("damaged_r.png"), ImageFormat::Png).unwrap();
    let path = folder.path().join("damaged.svbrdf.json");
    let whole = br#"{"albedo": "srgb", "dielectric-f0": 0.05, "grid": "4x1", "order": "ndrs", "flip-v": true,
        "exemplar": 0, "maps": {"roughness": "damaged_r.png:g"}, "preset": "gao"}"#;
    try_all(
        "sidecar",
        whole,
        damaged,
        |bytes| {
            std::fs::write(&path, bytes).unwrap();
            read(&path, &ReadOptions::AUTO, &Progress::default())
        },
        of_sidecar,
    );
}

#[test]
fn folders_of_any_names_never_panic() {
    const PARTS: [&str; 16] = [
        "normal",
        "gl",
        "DX",
        "diff",
        "rough",
        "_",
        "-",
        ".",
        " ",
        "ks",
        "shared",
        "0",
        "3",
        "1024",
        "\u{e4}\u{130}",
        "orm",
    ];
    let picture = encoded(&packed("N", 1, |_, v| v), ImageFormat::Png);
    let mut random = ChaCha8Rng::seed_from_u64(9);
    let mut below = |limit: usize| random.next_u32() as usize % limit;
    let (mut opened, mut refused) = (0, 0);
    for _ in 0..budget() {
        let folder = tempdir().unwrap();
        for _ in 0..1 + below(6) {
            let name: String = (0..1 + below(6)).map(|_| PARTS[below(PARTS.len())]).collect();
            std::fs::write(folder.path().join(name + ".png"), &picture).unwrap();
        }
        match read::<f32>(folder.path(), &OPTIONS, &Progress::default()) {
            Ok(_) => opened += 1,
            Err(_) => refused += 1,
        }
    }
    println!("folders: {opened} opened, {refused} refused");
    assert!(opened > 0 && refused > 0);
}

#[test]
fn options_of_any_letters_never_panic() {
    let mut random = ChaCha8Rng::seed_from_u64(13);
    let mut below = |limit: usize| random.next_u32() as usize % limit;
    let letters: Vec<char> = "nndrsbmi4x1:=.-e\u{e4}NaNinf".chars().collect();
    let mut understood = 0;
    for _ in 0..100 * budget() {
        let text: String = (0..below(8)).map(|_| letters[below(letters.len())]).collect();
        if let Ok(order) = text.parse::<Order>() {
            assert_eq!(order.to_string().parse::<Order>().unwrap(), order);
            understood += 1;
        }
        understood += usize::from(text.parse::<Grid>().is_ok_and(|grid| grid.columns > 0 && grid.rows > 0));
        understood +=
            usize::from(text.parse::<Reflectance>().is_ok_and(|f| (0.0..=1.0).contains(&f.value())));
        understood += usize::from(text.parse::<Binding>().is_ok());
    }
    assert!(understood > 0);
}
