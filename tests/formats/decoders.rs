//! Formats of games and of the web: TGA, BMP, WebP, DDS, KTX2; and those that are refused by name.

use super::*;
use crate::support::textures::{bc1_block, bc5_block, dds, dds_blocks, dds_dx10, dds_plain, ktx2_uastc};

/// The packed strip of the four maps, linear.
fn strip() -> DynamicImage {
    packed("NDRS", 4, |_, v| v)
}

pub fn put_bytes(folder: &Path, name: &str, bytes: &[u8]) -> std::path::PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, bytes).unwrap();
    path
}

#[test]
fn tga_bmp_and_webp_open_with_the_values_of_png() {
    let folder = tempdir().unwrap();
    for (name, format) in
        [("m.tga", ImageFormat::Tga), ("m.bmp", ImageFormat::Bmp), ("m.webp", ImageFormat::WebP)]
    {
        save(folder.path(), name, &strip(), format);
        let read = open(&folder.path().join(name));
        assert_same(&read, EIGHT_BITS);
        assert_eq!(read.maps[0].depth, "8-bit", "{name}");
    }
}

/// A PFM of RGB, the lowest row first, whose scale tells the order of the bytes.
pub fn pfm(image: &image::Rgb32FImage, scale: &str, order: fn(f32) -> [u8; 4]) -> Vec<u8> {
    let (width, height) = image.dimensions();
    let texels = (0..height).rev().flat_map(|y| (0..width).map(move |x| (x, y)));
    let values = texels.flat_map(|(x, y)| image.get_pixel(x, y).0).flat_map(order);
    format!("PF\n{width} {height}\n{scale}\n").into_bytes().into_iter().chain(values).collect()
}

#[test]
fn pnm_qoi_and_pfm_open_with_the_values_of_png() {
    let folder = tempdir().unwrap();
    let image = strip();
    for (name, format) in [("m.ppm", ImageFormat::Pnm), ("m.qoi", ImageFormat::Qoi)] {
        assert_same(&open(&save(folder.path(), name, &image, format)), EIGHT_BITS);
    }
    let rgb = image.to_rgb32f();
    for bytes in [pfm(&rgb, "-1.0", f32::to_le_bytes), pfm(&rgb, "1", f32::to_be_bytes)] {
        assert_same(&open(&put_bytes(folder.path(), "m.pfm", &bytes)), EIGHT_BITS);
    }
    let cut = std::fs::read(folder.path().join("m.pfm")).unwrap();
    assert_refused(
        &put_bytes(folder.path(), "cut.pfm", &cut[..cut.len() - 4]),
        &["expected the whole image"],
    );
    assert_refused(&put_bytes(folder.path(), "bad.pfm", b"PF\n4 x\n1\n"), &["PFM", "`4 x`"]);
}

#[test]
fn a_gray_map_in_pgm_is_read_and_one_of_another_maximum_refused() {
    let folder = grays(&[("x_basecolor", srgb(0.5)), ("x_roughness", 0.5)]);
    put(folder.path(), "x_normal_gl", bumps);
    let pgm =
        |top: u32| [format!("P5\n{SIDE} {SIDE}\n{top}\n").into_bytes(), vec![255; SIDE * SIDE]].concat();
    put_bytes(folder.path(), "x_metallic.pgm", &pgm(255));
    assert_near(open(folder.path()).material.texel(0).specular, [0.5; 3]);
    put_bytes(folder.path(), "x_metallic.pgm", &pgm(254));
    assert_refused(folder.path(), &["x_metallic.pgm", "at most 254"]);
}

/// The half float of a number of at most 1, cut.
fn half(value: f64) -> [u8; 2] {
    exr::prelude::f16::from_f64(value).to_le_bytes()
}

#[test]
fn dds_of_two_floats_holds_x_and_y_and_dds_of_luminance_is_gray() {
    let folder = grays(&[("x_diffuse", 0.5), ("x_specular", 0.2)]);
    let side = SIDE as u32;
    let texels = || (0..SIDE * SIDE).map(|i| (i % SIDE, i / SIDE));
    let xy: Vec<u8> = texels().flat_map(|(x, y)| [0, 1].map(|c| half(texel(0, x, y)[c]))).flatten().collect();
    // DXGI_FORMAT_R16G16_FLOAT.
    put_bytes(folder.path(), "x_normal_gl.dds", &dds_dx10(side, side, 34, &xy));
    let gray = |alpha: bool| {
        texels().flat_map(move |(x, y)| {
            let code = (255.0 * texel(2, x, y)[0]).round() as u8;
            if alpha { vec![code, 77] } else { vec![code] }
        })
    };
    // A8L8, of luminance and alpha, and A8.
    for (words, pixels) in [
        ([32, 0x2_0001, 0, 16, 0xff, 0, 0, 0xff00], gray(true).collect::<Vec<_>>()),
        ([32, 2, 0, 8, 0, 0, 0, 0xff], gray(false).collect()),
    ] {
        put_bytes(folder.path(), "x_roughness.dds", &dds(side, side, words, &pixels));
        let read = open(folder.path());
        for index in [0, 77, 200] {
            let got = read.material.texel(index);
            let [normal, roughness] = [0, 2].map(|map| texel(map, index % SIDE, index / SIDE));
            assert_near(got.normal.to_array(), normal);
            assert_near([got.roughness], [roughness[0]]);
        }
    }
}

#[test]
fn dds_of_plain_pixels_opens_with_the_values_of_png() {
    let folder = tempdir().unwrap();
    let image = strip().to_rgba8();
    let path = put_bytes(folder.path(), "m.dds", &dds_plain(image.width(), image.height(), image.as_raw()));
    assert_same(&open(&path), EIGHT_BITS);
}

/// A folder of maps of 4 x 4 texels: normal and diffuse as blocks, roughness as PNG.
fn folder_of_blocks() -> tempfile::TempDir {
    let folder = tempdir().unwrap();
    put_bytes(folder.path(), "normal.dds", &dds_blocks(4, 4, b"ATI2", &bc5_block([204, 102])));
    put_bytes(folder.path(), "diffuse.dds", &dds_blocks(4, 4, b"DXT1", &bc1_block([31, 0, 16])));
    save(folder.path(), "roughness.png", &picture(4, 4, |_, _| [0.5; 3]), ImageFormat::Png);
    folder
}

#[test]
fn dds_blocks_decode_to_the_values_that_they_code() {
    let folder = folder_of_blocks();
    let read = open(folder.path());
    let texel = read.material.texel(7);
    let (x, y) = (2.0 * 204.0 / 255.0 - 1.0, 2.0 * 102.0 / 255.0 - 1.0);
    let expected = [x, y, (1.0_f64 - x * x - y * y).sqrt()];
    assert_near(texel.normal.to_array(), expected);
    // 16 of 31 is 132 of 255, which stands for 0.2307 in sRGB.
    assert_near(texel.diffuse, [1.0, 0.0, 0.2307]);
}

#[test]
fn dds_of_a_cube_map_and_of_signed_samples_are_refused_by_name() {
    let folder = tempdir().unwrap();
    let mut cube = dds_plain(4, 4, &[0; 6 * 64]);
    cube[112..116].copy_from_slice(&0xfe00_u32.to_le_bytes());
    assert_refused(&put_bytes(folder.path(), "cube.dds", &cube), &["cube map"]);
    let signed = dds_blocks(4, 4, b"BC5S", &bc5_block([12, 34]));
    assert_refused(&put_bytes(folder.path(), "signed.dds", &signed), &["BC5_SNORM"]);
}

/// The strip in blocks of one colour: as PNG pixels, and as KTX2.
pub fn blocks() -> (DynamicImage, Vec<u8>) {
    let image = strip().to_rgba8();
    let (width, height) = image.dimensions();
    let coarse = image::RgbaImage::from_fn(width, height, |x, y| *image.get_pixel(x / 4 * 4, y / 4 * 4));
    let corners = (0..height / 4).flat_map(|y| (0..width / 4).map(move |x| (4 * x, 4 * y)));
    let colours: Vec<[u8; 4]> = corners.map(|(x, y)| coarse.get_pixel(x, y).0).collect();
    (coarse.into(), ktx2_uastc(width, height, &colours))
}

#[test]
fn ktx2_of_uastc_opens_with_the_values_that_it_codes() {
    let folder = tempdir().unwrap();
    let (image, ktx2) = blocks();
    save(folder.path(), "m.png", &image, ImageFormat::Png);
    let ktx2 = put_bytes(folder.path(), "m.ktx2", &ktx2);
    let options = ReadOptions { order: Some(Order::NDRS), ..ReadOptions::AUTO };
    let [png, ktx2] = [folder.path().join("m.png"), ktx2].map(|path| open_as(&path, &options));
    assert_eq!(png.material, ktx2.material);
    // The comparison can fail.
    let (_, mut damaged) = blocks();
    let last = damaged.len() - 16;
    damaged[last] = 23;
    damaged[last + 1] ^= 0xff;
    let damaged = open_as(&put_bytes(folder.path(), "m.ktx2", &damaged), &options);
    assert_ne!(png.material, damaged.material);
}

/// A KTX2 of ETC1S of 64 x 16 texels: [`etc1s_colour`], written by version 2.50 of the encoder of Basis Universal.
pub const ETC1S: &[u8] = include_bytes!("etc1s.ktx2");

fn etc1s_colour(x: u8, y: u8) -> [u8; 3] {
    match x / 16 {
        0 => [128, 128, 255],
        1 => [40 + 12 * (x % 16), 96, 220 - 10 * y],
        2 => [30 + 10 * y; 3],
        _ => [56; 3],
    }
}

#[test]
fn ktx2_of_etc1s_opens_with_the_values_that_were_encoded() {
    let folder = tempdir().unwrap();
    let options = ReadOptions {
        order: Some(Order::NDRS),
        preset: Some(Preset::Deschaintre),
        albedo: Some(Albedo::Linear),
        ..ReadOptions::AUTO
    };
    let read = open_as(&put_bytes(folder.path(), "m.ktx2", ETC1S), &options);
    assert_eq!(read.material.size(), [16; 2]);
    let worst = |shift: u8| {
        let of = |index: usize| {
            let texel = read.material.texel(index);
            let (x, y) = (index as u8 % 16, index as u8 / 16);
            let expected = [16, 32, 48].map(|tile| etc1s_colour(tile + (x + shift) % 16, y));
            let got = [texel.diffuse, [texel.roughness; 3], texel.specular];
            let differences = got.into_iter().flatten().zip(expected.into_iter().flatten());
            differences.map(|(got, code)| (255.0 * got - f64::from(code)).abs()).fold(0.0, f64::max)
        };
        (0..256).map(of).sum::<f64>() / 256.0
    };
    // Blocks of 4 x 4 texels have four colours on a line.
    assert!(worst(0) < 20.0, "{}", worst(0));
    assert!(worst(8) > 60.0, "the comparison cannot fail: {}", worst(8));
}

#[test]
fn ktx2_that_is_not_of_basis_universal_is_refused_by_its_format() {
    let folder = tempdir().unwrap();
    let (_, mut ktx2) = blocks();
    ktx2[12..16].copy_from_slice(&146_u32.to_le_bytes());
    assert_refused(&put_bytes(folder.path(), "m.ktx2", &ktx2), &["Vulkan format 146"]);
}

#[test]
fn an_archive_of_pictures_is_called_a_zip() {
    let folder = tempdir().unwrap();
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    zip.start_file("rock_albedo.png", zip::write::SimpleFileOptions::default()).unwrap();
    assert_refused(
        &put_bytes(folder.path(), "rock.zip", &zip.finish().unwrap().into_inner()),
        &["rock.zip", "a zip archive", "rock_albedo.png", "unpack it"],
    );
}

#[test]
fn the_map_that_cannot_be_decoded_is_named_with_its_format() {
    let folder = tempdir().unwrap();
    folder_of(NAMES, folder.path(), |_, v| v);
    std::fs::remove_file(folder.path().join("normal.png")).unwrap();
    put_bytes(
        folder.path(),
        "normal.webp",
        b"RIFF\x20\0\0\0WEBPVP8L\x10\0\0\0\x2f\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0",
    );
    assert_refused(folder.path(), &["normal.webp", "normal map", "WebP"]);
}

#[test]
fn formats_that_are_not_read_are_refused_by_name() {
    let folder = tempdir().unwrap();
    for (begins, name) in [
        (b"8BPS\0\x01\0\0\0\0\0\0".as_slice(), "Photoshop"),
        (b"\0\0\0\x20ftypavif\0\0\0\0", "AVIF"),
        (b"\xff\x0a\0\0\0\0\0\0", "JPEG XL"),
        (b"GIF89a\x01\0\x01\0\0\0\0", "GIF"),
        (b"\xff\xd8\xff\xf7\0\x0b\x08\0\0", "JPEG-LS"),
        (b"\x50\0\0\0\0\0\0\0{\"x\":{}}", "safetensors"),
    ] {
        assert_refused(&put_bytes(folder.path(), "m.png", begins), &[name, "TGA"]);
    }
}

#[test]
fn a_map_in_a_format_that_is_not_read_is_an_error_and_named_unless_it_is_there_in_another() {
    let folder = tempdir().unwrap();
    folder_of(["normal.png", "diffuse.png", "roughness.png", "height.png"], folder.path(), |_, v| v);
    let metal = put_bytes(folder.path(), "metalness.psd", b"8BPS\0\x01\0\0\0\0\0\0");
    assert_refused(folder.path(), &["metalness.psd", "Photoshop"]);
    save(folder.path(), "metalness.tga", &picture(SIDE, SIDE, |_, _| [1.0; 3]), ImageFormat::Tga);
    let texel = open(folder.path()).material.texel(3);
    assert_eq!(texel.diffuse, [0.0; 3]);
    std::fs::remove_file(metal).unwrap();
    // A height map is no map of a material, in any format.
    put_bytes(folder.path(), "displacement.psd", b"8BPS");
    assert_eq!(open(folder.path()).material.texel(3), texel);
}
