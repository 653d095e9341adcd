//! Bad material files: one clear error each, and never a panic.

mod claims;

use std::fs;
use std::path::{Path, PathBuf};

use image::{DynamicImage, GrayImage, RgbImage};
use tempfile::tempdir;

use svbrdf_core::material::Material;
use svbrdf_core::progress::Progress;
use svbrdf_files::read::{ReadOptions, read, read_bytes};

use crate::support::fixtures::{bytes_at, flat, map, png_bytes, save, save_maps, strip};
use crate::support::png::crc32;

/// A kind of bad input: what makes it (in an empty folder) and returns what to open, and the words that the message must contain, split by
/// ` .. `: file, map, what was expected, what was found, what to do.
type Bad = (fn(&Path) -> PathBuf, &'static str);

/// Bytes of a file `x.png`, and the words of the message.
type BadBytes = (Vec<u8>, &'static str);

fn assert_refused(path: &Path, words: &str) {
    let message = match read::<f32>(path, &ReadOptions::default(), &Progress::default()) {
        Ok(_) => panic!("it was read without an error: {words}"),
        Err(error) => error.to_string(),
    };
    println!("{message}");
    for word in words.split(" .. ") {
        assert!(message.contains(word), "`{word}` is not in: {message}");
    }
}

fn assert_all_refused(table: &[Bad]) {
    for (make, words) in table {
        let folder = tempdir().unwrap();
        assert_refused(&make(folder.path()), words);
    }
}

fn assert_bytes_refused(table: &[BadBytes]) {
    let folder = tempdir().unwrap();
    let path = folder.path().join("x.png");
    for (bytes, words) in table {
        fs::write(&path, bytes).unwrap();
        assert_refused(&path, &format!("x.png .. {words}"));
    }
}

/// The maps of the fixtures, of which one is another picture.
fn with(folder: &Path, name: &str, image: &DynamicImage) -> PathBuf {
    save_maps(folder, "");
    save(folder, name, image);
    folder.to_owned()
}

#[test]
fn paths_that_lead_to_no_material_are_refused() {
    assert_all_refused(&[
        (|f| f.join("absent.png"), "cannot read .. absent.png .. no file, folder or prefix .. check"),
        (|f| f.join("no/such/gt"), "cannot read .. no/such .. check"),
        (|f| save(f, "a.png", &strip(0)).join("gt"), "cannot read .. a.png .. check"),
        (|f| f.to_owned(), "not a material .. normal map .. found no files .. add"),
        (
            |f| {
                fs::write(f.join("readme.txt"), "x").unwrap();
                save(f, "photo.png", &flat(4, 4, [1; 3])).with_file_name("")
            },
            "a packed picture .. rgh .. found photo.png, whose name names no map, and readme.txt",
        ),
        (
            |f| {
                (0..40).for_each(|i| fs::write(f.join(format!("{i:02}.txt")), "x").unwrap());
                f.to_owned()
            },
            "11.txt and 28 more",
        ),
        (|f| save(f, "gt.png", &strip(0)).with_extension(""), "normal map .. found gt.png"),
    ]);
}

#[test]
fn wrong_sets_of_maps_are_refused() {
    assert_all_refused(&[
        (
            |f| {
                save_maps(f, "gt_");
                fs::rename(f.join("gt_roughness.png"), f.join("gt_roughness.txt")).unwrap();
                f.join("gt")
            },
            "gt is not a material .. one picture for the roughness map .. rgh .. gt_roughness.txt .. add",
        ),
        (|f| with(f, "dif.png", &map(1)), "diffuse map .. found dif.png and diffuse.png .. prefix"),
        (|f| with(f, "specular.png", &flat(5, 6, [9; 3])), "normals.png is 4 x 4 .. specular.png is 5 x 6"),
        (|f| with(f, "normals.png", &GrayImage::new(4, 4).into()), "a normal map in RGB .. one in gray"),
        (
            |f| save(f, "three.png", &flat(12, 4, [200; 3])),
            "normal | diffuse | roughness | specular .. 12 x 4",
        ),
        (|f| save(f, "odd.png", &flat(17, 4, [200; 3])), "4 or more times as wide as high .. 17 x 4"),
        (|f| save(f, "up.png", &flat(4, 16, [200; 3])), "up.png .. found 4 x 16"),
        (
            |f| {
                save_maps(f, "");
                fs::write(f.join("roughness.png"), &png_bytes(&map(2))[..50]).unwrap();
                f.to_owned()
            },
            "roughness.png .. roughness map: expected the whole image .. end of the file",
        ),
    ]);
}

#[test]
fn files_that_are_no_whole_image_are_refused() {
    let whole = png_bytes(&strip(0));
    let mut damaged = whole.clone();
    damaged[45] ^= 0xff;
    assert_bytes_refused(&[
        (Vec::new(), "cannot decode .. expected an image, found an empty file; copy"),
        (b"not an image at all".into(), "expected PNG, TIFF .. no known image"),
        (b"\xff\xd8\xff\xe0 and so on".into(), "expected the whole image .. end of the file .. again"),
        (b"\xff\xd8\xff\xd9".into(), "expected a valid JPEG .. again"),
        (whole[..whole.len() * 2 / 3].into(), "expected the whole image .. end of the file .. again"),
        (damaged, "cannot decode .. expected a valid PNG .. again"),
    ]);
}

#[test]
fn damaged_strips_give_an_error_or_a_valid_material() {
    let texels = RgbImage::from_fn(4, 1, |x, _| bytes_at(x as usize, 0, 0).into());
    let small = png_bytes(&texels.into());
    let (mut opened, mut refused) = (0, 0);
    let mut check = |bytes: &[u8]| match read_bytes::<f32>("damaged", bytes, &ReadOptions::default()) {
        Ok(read) => {
            assert_valid(&read.material);
            opened += 1;
        }
        Err(error) => {
            assert!(error.to_string().contains("damaged"), "{error}");
            refused += 1;
        }
    };
    for length in 0..small.len() {
        check(&small[..length]);
    }
    for position in 0..small.len() {
        for bit in 0..8 {
            let mut bytes = small.clone();
            bytes[position] ^= 1 << bit;
            check(&bytes);
            // With checksums that are right again, the damage gets past them.
            sign(&mut bytes);
            check(&bytes);
        }
    }
    println!("{opened} opened, {refused} refused");
    assert!(opened > 100 && refused > 100, "the damage does not reach both sides: {opened}, {refused}");
}

fn assert_valid(material: &Material<f32>) {
    for index in 0..material.width() * material.height() {
        let texel = material.texel(index);
        assert!((texel.normal.length_squared() - 1.0).abs() < 1e-5, "{texel:?}");
        let values = texel.diffuse.into_iter().chain(texel.specular).chain([texel.roughness]);
        assert!(values.into_iter().all(|x| (0.0..=1.0).contains(&x)), "{texel:?}");
    }
}

/// Makes the checksum of every chunk of a PNG right.
fn sign(png: &mut [u8]) {
    let mut start = 8;
    while let Some(length) = png.get(start..start + 4) {
        let length = u32::from_be_bytes(length.try_into().unwrap()) as usize;
        let end = start + 8 + length;
        let Some(checked) = png.get(start + 4..end) else { return };
        let checksum = crc32(checked).to_be_bytes();
        let Some(place) = png.get_mut(end..end + 4) else { return };
        place.copy_from_slice(&checksum);
        start = end + 4;
    }
}
