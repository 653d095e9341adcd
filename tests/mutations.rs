//! Damaged files for every reader: a valid material, or an error of the kind that this damage causes; never a panic.
//!
//! The files are those of the tables in tests/materials that are marked as seeds. `SVBRDF_MUTATIONS=40000 cargo test mutations --
//! --nocapture` tries more of each than usual, and prints how many opened and were refused. The target of cargo-fuzz begins with the same.

use std::path::Path;

use image::ImageFormat;
use rand::rngs::ChaCha8Rng;
use rand::{Rng as _, SeedableRng as _};
use rayon::prelude::*;
use tempfile::tempdir;

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::progress::Progress;
use svbrdf_files::Error;
use svbrdf_files::read::{
    Binding, NonFinite, Order, Read, ReadOptions, Reflectance, TileGrid, read, read_bytes,
};

use crate::materials::seeds;
use crate::support::png::crc32;

/// Inputs of each seed in a usual run.
const BUDGET: usize = 400;

fn budget() -> usize {
    std::env::var("SVBRDF_MUTATIONS").ok().and_then(|n| n.parse().ok()).unwrap_or(BUDGET)
}

/// A damaged copy of `bytes`: truncated, bits flipped, a stretch overwritten with extremes, a part doubled or cut.
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

/// A strip whatever it looks like.
const STRIP: ReadOptions =
    ReadOptions { order: Some(Order::NDRS), non_finite: Some(NonFinite::Replace), ..ReadOptions::AUTO };
const ANY: ReadOptions = ReadOptions { non_finite: Some(NonFinite::Replace), ..ReadOptions::AUTO };

/// Whether a damaged file can cause this error: it cannot be decoded or understood, is no material any more, or a picture that it names is
/// none or absent. An error of the file itself has to name it.
fn is_of_damage(error: &Error, own: &Path) -> bool {
    let is_there = |path: &Path| path == own || path.parent() == own.parent();
    match error {
        Error::BadImage { path, .. }
        | Error::NotPacked { path, .. }
        | Error::NotAMaterial { path, .. }
        | Error::MissingMap { path, .. } => is_there(path),
        Error::NoSuchExemplar { .. } | Error::MapSizesDiffer { .. } => true,
        // A picture that the file names now, or a text that is no UTF-8.
        Error::Unreadable { .. } | Error::NotAFile { .. } | Error::Outside { .. } => {
            own.extension().is_some_and(|e| !is_picture(e))
        }
        // A float that is too large for the material.
        Error::Core(CoreError::OutOfRange { whose, .. }) => whose == "damaged",
        _ => false,
    }
}

fn is_picture(extension: &std::ffi::OsStr) -> bool {
    !["gltf", "glb", "mtl", "mtlx"].iter().any(|document| extension == *document)
}

/// Opens damaged copies of `whole`, each made by `damage`; returns how many opened and were refused.
fn try_all(
    what: &str,
    whole: &[u8],
    damage: impl Fn(&[u8], &mut ChaCha8Rng) -> Vec<u8>,
    open: impl Fn(&[u8]) -> Result<Read<f32>, Error>,
    is_expected: impl Fn(&Error) -> bool,
) -> [usize; 2] {
    open(whole).unwrap_or_else(|e| panic!("{what}: {e}"));
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut counts = [0; 2];
    for _ in 0..budget() {
        match open(&damage(whole, &mut random)) {
            Ok(read) => {
                let planes = read.material.planes();
                let channels = planes.diffuse.iter().chain(&planes.specular).chain([&planes.roughness]);
                assert!(channels.flatten().all(|value| (0.0..=1.0).contains(value)), "{what}");
                assert!(planes.normal.iter().flatten().all(|n| n.abs() <= 1.0 + 1e-6), "{what}");
                counts[0] += 1;
            }
            Err(error) => {
                assert!(is_expected(&error), "{what}: {error:?}");
                counts[1] += 1;
            }
        }
    }
    println!("{what}: {} opened, {} refused", counts[0], counts[1]);
    counts
}

/// The seeds with this kind of name, each tried as `options` read it.
fn try_seeds(is: impl Fn(&str) -> bool + Sync) {
    let seeds: Vec<_> =
        seeds().into_iter().filter(|(.., path)| is(&path.extension().unwrap().to_string_lossy())).collect();
    assert!(!seeds.is_empty());
    seeds.par_iter().for_each(|(case, _folder, path)| {
        let whole = std::fs::read(path).unwrap();
        let extension = path.extension().unwrap();
        let named = path.with_file_name("damaged").with_extension(extension);
        let own = if is_picture(extension) && extension != "tga" { Path::new("damaged") } else { &named };
        let options = if case.is_strip() { STRIP } else { ANY };
        let open = |bytes: &[u8]| match own == named && extension != "tga" {
            true => {
                std::fs::write(&named, bytes).unwrap();
                read(&named, &ANY, &Progress::default())
            }
            false => read_bytes(&own.display().to_string(), bytes, &options),
        };
        let counts = try_all(&case.name, &whole, damaged, open, |error| is_of_damage(error, own));
        assert!(counts[1] > 0, "{}", case.name);
    });
}

#[test]
fn damaged_pictures_never_panic() {
    try_seeds(|kind| is_picture(kind.as_ref()) && kind != "exr");
}

#[test]
fn damaged_exr_never_panics() {
    try_seeds(|kind| kind == "exr");
}

#[test]
fn damaged_documents_never_panic() {
    try_seeds(|kind| !is_picture(kind.as_ref()));
}

#[test]
fn damaged_files_beyond_the_tables_never_panic() {
    let in_memory = |bytes: &[u8]| read_bytes("damaged", bytes, &ANY);
    let is_expected = |error: &Error| is_of_damage(error, Path::new("damaged"));
    // Strips of JPEG with halved chroma, by tifffile.
    try_all("TIFF of JPEG", include_bytes!("mutations/jpeg.tif"), damaged, in_memory, is_expected);
    // With checksums that are right again, the damage of a PNG gets past them.
    let whole = std::fs::read(&seeds()[0].2).unwrap();
    let signed = |whole: &[u8], random: &mut ChaCha8Rng| {
        let mut bytes = damaged(whole, random);
        sign(&mut bytes);
        bytes
    };
    let [opened, refused] = try_all(
        "PNG, signed again",
        &whole,
        signed,
        |bytes| read_bytes("damaged", bytes, &STRIP),
        is_expected,
    );
    assert!(opened > 20 && refused > 20, "the damage does not reach both sides: {opened}, {refused}");
    // An EXR that cargo-fuzz has found.
    let found = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/mutations/found/picture/dwa_version");
    assert!(read_bytes::<f32>("damaged", &std::fs::read(found).unwrap(), &STRIP).is_err());
}

/// Makes the checksum of every chunk of a PNG right, as far as there are chunks.
pub fn sign(png: &mut [u8]) {
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
#[ignore = "writes tests/fuzz/seeds"]
fn the_seeds_of_the_fuzz_target() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz/seeds");
    for name in ["any", "maps"] {
        std::fs::create_dir_all(root.join(name)).unwrap();
    }
    for (number, (_, folder, path)) in seeds().into_iter().enumerate() {
        let kinds = ["gltf", "glb", "mtl", "mtlx"];
        let kind = kinds.iter().position(|kind| path.extension().is_some_and(|own| own == *kind));
        let seed = [vec![kind.map_or(0, |kind| kind as u8 + 1)], std::fs::read(&path).unwrap()].concat();
        std::fs::write(root.join("any").join(format!("{number:02}")), seed).unwrap();
        for entry in std::fs::read_dir(folder.path()).unwrap().filter(|_| kind.is_some()) {
            let entry = entry.unwrap();
            std::fs::copy(entry.path(), root.join("maps").join(entry.file_name())).unwrap();
        }
    }
}

#[test]
#[should_panic(expected = "planted: Internal")]
fn a_reader_that_blames_itself_is_not_accepted() {
    let opened = std::cell::Cell::new(false);
    let whole = std::fs::read(&seeds()[0].2).unwrap();
    let open = |bytes: &[u8]| match opened.replace(true) {
        false => read_bytes("damaged", bytes, &STRIP),
        true => Err(Error::Internal("damaged".to_owned())),
    };
    try_all("planted", &whole, damaged, open, |error| is_of_damage(error, Path::new("damaged")));
}

#[test]
fn folders_of_any_names_never_panic() {
    let parts: Vec<&str> =
        "normal|gl|DX|diff|rough|_|-|.| |ks|shared|0|3|1024|\u{e4}\u{130}|orm".split('|').collect();
    let folder = tempdir().unwrap();
    let picture = folder.path().join("picture.png");
    image::RgbImage::from_pixel(4, 4, [128, 128, 255].into())
        .save_with_format(&picture, ImageFormat::Png)
        .unwrap();
    let picture = std::fs::read(picture).unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(9);
    let mut below = |limit: usize| random.next_u32() as usize % limit;
    let (mut opened, mut refused) = (0, 0);
    for _ in 0..budget() {
        let folder = tempdir().unwrap();
        for _ in 0..1 + below(6) {
            let name: String = (0..1 + below(6)).map(|_| parts[below(parts.len())]).collect();
            std::fs::write(folder.path().join(name + ".png"), &picture).unwrap();
        }
        match read::<f32>(folder.path(), &ANY, &Progress::default()) {
            Ok(_) => opened += 1,
            Err(_) => refused += 1,
        }
    }
    assert!(opened > 0 && refused > 0, "{opened} opened, {refused} refused");
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
        understood +=
            usize::from(text.parse::<TileGrid>().is_ok_and(|grid| grid.columns > 0 && grid.rows > 0));
        understood +=
            usize::from(text.parse::<Reflectance>().is_ok_and(|f| (0.0..=1.0).contains(&f.value())));
        understood += usize::from(text.parse::<Binding>().is_ok());
    }
    assert!(understood > 0);
}
