//! Damaged files for every reader: a valid material, or an error of the kind that this damage causes; never a panic.
//!
//! It stands in for cargo-fuzz, which needs a nightly compiler. `SVBRDF_MUTATIONS=40000 cargo test mutations --
//! --nocapture` tries more than the usual number for each reader, and prints how many opened and were refused.

mod listings;
mod names;
mod pictures;
mod seeds;

use std::io::Cursor;
use std::path::Path;

use image::{DynamicImage, ImageFormat};
use rand::rngs::ChaCha8Rng;
use rand::{Rng as _, SeedableRng as _};
use tempfile::tempdir;

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::progress::Progress;
use svbrdf_files::Error;
use svbrdf_files::read::{NonFinite, Order, Read, ReadOptions, read, read_bytes};

use crate::support::pictures::packed;

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

/// A strip whatever it looks like.
const STRIP: ReadOptions =
    ReadOptions { order: Some(Order::NDRS), non_finite: Some(NonFinite::Replace), ..ReadOptions::AUTO };

fn in_memory(bytes: &[u8]) -> Result<Read<f32>, Error> {
    read_bytes("damaged", bytes, &OPTIONS)
}

/// Whether a damaged picture can cause this error: it cannot be decoded, or it is no longer a packed or layered
/// material. An error of the picture has to name the file.
fn of_picture(error: &Error) -> bool {
    match error {
        Error::BadImage { path, .. }
        | Error::NotPacked { path, .. }
        | Error::NotAMaterial { path, .. }
        | Error::MissingMap { path, .. } => path == Path::new("damaged"),
        // A float that is too large for the material.
        Error::Core(CoreError::OutOfRange { whose, .. }) => whose == "damaged",
        Error::MapSizesDiffer { .. } => true,
        _ => false,
    }
}

/// Whether a damaged file that lists textures can cause this error: also, a texture that it names cannot be read, or is not
/// the map that it is named as.
fn of_listing(error: &Error) -> bool {
    match error {
        Error::BadImage { .. }
        | Error::Unreadable { .. }
        | Error::NotAFile { .. }
        | Error::MapSizesDiffer { .. } => true,
        Error::NotAMaterial { path, .. } | Error::MissingMap { path, .. } => {
            named_damaged(path) || path.extension().is_some_and(|e| e == "png")
        }
        _ => false,
    }
}

/// Whether a damaged sidecar file can cause this error: it is refused, or its options do not fit the picture.
fn of_sidecar(error: &Error) -> bool {
    match error {
        Error::BadSidecar { path, .. }
        | Error::NotPacked { path, .. }
        | Error::NoSuchExemplar { path, .. } => named_damaged(path),
        // No UTF-8.
        Error::Unreadable { path, source } => {
            named_damaged(path) && source.kind() == std::io::ErrorKind::InvalidData
        }
        Error::BadImage { .. }
        | Error::NotAMaterial { .. }
        | Error::MissingMap { .. }
        | Error::MapSizesDiffer { .. } => true,
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
        assert!(!is_expected(&internal()) && !is_expected(&Error::NoSuchBuiltIn { number: 9, count: 7 }));
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
