//! The files that `svbrdf render` writes.

use std::path::Path;

use svbrdf_core::image::Image;
use svbrdf_core::loss::Compute as _;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::picture::colour_map::difference_to_display;
use svbrdf_core::picture::tone::to_display;
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render_f32;
use svbrdf_files::export::GAP;
use svbrdf_files::export::strip::HEADER;
use svbrdf_files::samples;

use super::{assert_has, assert_holds, assert_refused, data_set, folder, succeed};
use crate::support::losses::losses;

/// The built-in materials as `render` shows them: side by side.
fn panes(scene: &Scene) -> Vec<Image<f32>> {
    let built_in = samples::load::<f32>().unwrap();
    let all = std::iter::once(built_in.ground_truth).chain(built_in.predictions);
    all.map(|read| render_f32(&read.material, scene, &PRINTED, &Progress::default()).unwrap()).collect()
}

/// What stands at (x, y) of panes side by side; `None` in a gap.
fn pixel_at(panes: &[Image<f32>], mut x: usize, y: usize) -> Option<[f32; 3]> {
    for pane in panes {
        if x < pane.width {
            return Some(pane.pixels[y * pane.width + x]);
        }
        x = x.checked_sub(pane.width + GAP)?;
    }
    None
}

fn width_of(panes: &[Image<f32>]) -> usize {
    panes.iter().map(|pane| pane.width + GAP).sum::<usize>() - GAP
}

#[test]
fn an_exr_holds_the_rendering_to_the_last_bit() {
    let folder = folder();
    succeed(folder.path(), "render -o out.exr --view 0.2,-0.3,2 --light -1,0.5,0.8 --distant --exposure 2");
    let scene = Scene { kind: Kind::Distant, view: [0.2, -0.3, 2.0], light: [-1.0, 0.5, 0.8] };
    let panes = panes(&scene);
    let picture = image_of_exr(&folder.path().join("out.exr"));
    assert_eq!((picture.width, picture.height), (width_of(&panes), panes[0].height));
    for (i, pixel) in picture.pixels.iter().enumerate() {
        let (x, y) = (i % picture.width, i / picture.width);
        assert_eq!(*pixel, pixel_at(&panes, x, y).unwrap_or([0.0; 3]), "{x}, {y}");
    }
}

pub fn image_of_exr(path: &Path) -> Image<f32> {
    let read = exr::prelude::read_first_rgba_layer_from_file(
        path,
        |size, _| Image { width: size.0, height: size.1, pixels: vec![[0.0; 3]; size.area()] },
        |image, at, (r, g, b, _): (f32, f32, f32, f32)| image.pixels[at.1 * image.width + at.0] = [r, g, b],
    );
    read.unwrap().layer_data.channel_data.pixels
}

#[test]
fn an_exr_says_where_it_comes_from_and_is_the_same_in_every_run() {
    let folder = folder();
    for name in ["one.exr", "two.exr"] {
        succeed(folder.path(), &format!("render gt.png -o {name} --light -1,0.5,0.8"));
    }
    let [one, two] = ["one.exr", "two.exr"].map(|name| std::fs::read(folder.path().join(name)).unwrap());
    assert!(one == two, "the same picture shall be the same file");
    let meta = exr::prelude::MetaData::read_from_file(folder.path().join("one.exr"), false).unwrap();
    let attributes = &meta.headers[0].own_attributes;
    let comments = attributes.comments.clone().unwrap().to_string();
    assert_has(&comments, &["svbrdf:light: -1,0.5,0.8", "svbrdf:kind: near", "svbrdf:convention: printed"]);
    assert!(attributes.software_name.clone().unwrap().to_string().starts_with("svbrdf "));
}

#[test]
fn a_png_shows_the_rendering_and_says_where_it_comes_from() {
    let folder = folder();
    succeed(folder.path(), "render -o out.png --exposure -1 --light 0.5,0.5,1");
    let panes = panes(&Scene { kind: Kind::Near, view: [0.0, 0.0, 2.5], light: [0.5, 0.5, 1.0] });
    let file = std::fs::File::open(folder.path().join("out.png")).unwrap();
    let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut bytes).unwrap();
    for (i, pixel) in bytes.chunks(3).enumerate() {
        let (x, y) = (i % width_of(&panes), i / width_of(&panes));
        let expected = pixel_at(&panes, x, y).map_or([128; 3], |rgb| to_display(rgb, -1.0));
        assert_eq!(pixel, expected, "{x}, {y}");
    }
    let chunks = &reader.info().uncompressed_latin1_text;
    let said = |key: &str| chunks.iter().find(|c| c.keyword == key).map(|c| c.text.as_str());
    let keys = ["light", "view", "kind", "exposure", "convention"].map(|key| said(&format!("svbrdf:{key}")));
    assert_eq!(keys, ["0.5,0.5,1", "0,0,2.5", "near", "-1 EV", "printed"].map(Some));
    assert!(said("svbrdf:sources").is_some() && said("Software").is_some());
}

/// The loss of each built-in prediction in one scene, as the core computes it.
fn losses_in(scene: Scene) -> Vec<f64> {
    let built_in = samples::load::<f32>().unwrap();
    let predictions: Vec<_> = built_in.predictions.iter().map(|read| &read.material).collect();
    let ground_truth = &built_in.ground_truth.material;
    let losses = losses(f32::cpu(), ground_truth, &predictions, &[scene], &PRINTED).unwrap();
    losses.into_iter().map(|loss| loss.estimate.mean).collect()
}

#[test]
fn the_mean_of_a_difference_is_the_loss_in_that_scene() {
    let folder = folder();
    succeed(folder.path(), "render --difference -o out.exr --view 0.2,-0.3,2 --light -1,0.5,0.8");
    let scene = Scene { kind: Kind::Near, view: [0.2, -0.3, 2.0], light: [-1.0, 0.5, 0.8] };
    let expected = losses_in(scene);
    let picture = image_of_exr(&folder.path().join("out.exr"));
    let side = picture.height;
    assert_eq!(picture.width, expected.len() * (side + GAP) - GAP);
    for (i, loss) in expected.iter().enumerate() {
        let of_row = |y: usize| &picture.pixels[y * picture.width + i * (side + GAP)..][..side];
        let sum: f64 = (0..side).flat_map(of_row).flatten().map(|x| f64::from(*x)).sum();
        let mean = sum / (3 * side * side) as f64;
        assert!((mean / loss - 1.0).abs() < 1e-5, "{mean}, not {loss}");
        assert!((mean / losses_in(Scene { light: [-1.0, 0.5, 0.81], ..scene })[i] - 1.0).abs() > 1e-5);
    }
}

#[test]
fn a_png_of_a_difference_has_the_colours_of_the_map_and_says_so() {
    let folder = folder();
    succeed(folder.path(), "render --difference -o out.exr");
    succeed(folder.path(), "render --difference -o out.png");
    let floats = image_of_exr(&folder.path().join("out.exr"));
    let (width, side) = (floats.width, floats.height);
    let shown = image::open(folder.path().join("out.png")).unwrap().into_rgb8();
    let mut brighter = 0;
    for (x, y, pixel) in shown.enumerate_pixels().filter(|(x, ..)| (*x as usize) < side) {
        let logarithms = floats.pixels[y as usize * width + x as usize];
        let mean = logarithms.iter().sum::<f32>() / 3.0;
        assert_eq!(pixel.0, difference_to_display(mean, 2.0, false), "{x}, {y}");
        brighter += usize::from(pixel.0 != difference_to_display(mean * 2.0, 2.0, false));
    }
    assert!(brighter > 1000, "an exposed difference has other colours");
    assert_holds(folder.path(), "out.png", &["|ln(prediction + 0.01) - ln(ground truth + 0.01)|"]);
}

/// The pixels of a cell of a picture.
fn crop(picture: &image::RgbImage, [x, y]: [usize; 2], side: usize) -> Vec<[u8; 3]> {
    let cell = image::imageops::crop_imm(picture, x as u32, y as u32, side as u32, side as u32).to_image();
    cell.pixels().map(|pixel| pixel.0).collect()
}

#[test]
fn a_strip_has_the_pixels_that_render_writes() {
    let folder = folder();
    let view = "--view 0.2,-0.3,2 --light -1,0.5,0.8 --exposure 0.5 --range auto";
    succeed(
        folder.path(),
        &format!(
            "strip -o strip.png --columns normal,diffuse,roughness,specular,rendering,rendering:,normal: {view}"
        ),
    );
    let open = |name: &str| image::open(folder.path().join(name)).unwrap().into_rgb8();
    let strip = open("strip.png");
    let side = 256;
    let left = strip.width() as usize - 7 * (side + GAP);
    let scene = "--view 0.2,-0.3,2 --light -1,0.5,0.8 --exposure 0.5";
    for (column, options, first) in [
        (0, "--show normal".to_owned(), 0),
        (1, "--show diffuse".to_owned(), 0),
        (2, "--show roughness".to_owned(), 0),
        (3, "--show specular".to_owned(), 0),
        (4, scene.to_owned(), 0),
        (5, "--view 0.2,-0.3,2 --light -1,0.5,0.8 --difference --range auto".to_owned(), 1),
        (6, "--show normal --difference --range auto".to_owned(), 1),
    ] {
        succeed(folder.path(), &format!("render -o one.png {options}"));
        let one = open("one.png");
        for row in first..3 {
            let cell = crop(&strip, [left + column * (side + GAP), HEADER + row * (side + GAP)], side);
            let pane = crop(&one, [(row - first) * (side + GAP), 0], side);
            assert!(cell == pane, "column {column}, row {row}");
            // The normals of the prediction with wrong roughness are right.
            let is_empty = cell.iter().all(|pixel| *pixel == cell[0]);
            assert_eq!(is_empty, (column, row) == (6, 2), "column {column}, row {row}");
        }
    }
    let label = image::imageops::crop_imm(&strip, 0, HEADER as u32, left as u32 - 1, side as u32).to_image();
    assert!(label.pixels().any(|pixel| pixel.0[0] < 100), "the rows have names");
}

#[test]
fn a_strip_frames_crops_and_shows_them_magnified_beside_their_cells() {
    let folder = folder();
    let [plain, strip] = ["", "--crop 40,60,32,20 --crop 0,200,30,56"].map(|crops| {
        succeed(folder.path(), &format!("strip -o strip.png --columns diffuse,rendering: {crops}"));
        image::open(folder.path().join("strip.png")).unwrap().into_rgb8()
    });
    let at = |picture: &image::RgbImage, x: usize, y: usize| picture.get_pixel(x as u32, y as u32).0;
    let (side, line, orange) = (256, 2, [230, 159, 0]);
    let left = plain.width() as usize - 2 * (side + GAP);
    // The first crop of the last row, which is 6 times as large beside its cell.
    let top = HEADER + 2 * (side + GAP);
    let inset = left + side + GAP;
    assert_eq!([at(&strip, left + 72, top + 60), at(&strip, inset, top)], [orange; 2]);
    for [x, y] in [[0, 0], [100, 50], [191, 119]] {
        let magnified = at(&strip, inset + line + x, top + line + y);
        assert_eq!(magnified, at(&plain, left + 40 + x / 6, top + 60 + y / 6), "{x}, {y}");
    }
    assert_eq!(at(&strip, left + 200, top + 30), at(&plain, left + 200, top + 30));
    assert_holds(folder.path(), "strip.png", &["40,60,32,20 | 0,200,30,56"]);
}

#[test]
fn a_strip_has_a_column_for_each_scene_and_says_what_it_shows() {
    let folder = folder();
    let scenes = r#"{"scenes": [
        {"kind": "near", "view": [0, 0, 2.5], "light": [0.4, 0.5, 1.2]},
        {"kind": "distant", "view": [0, 0, 1], "light": [0.5, 0.5, 0.7]}
    ]}"#;
    std::fs::write(folder.path().join("scenes.json"), scenes).unwrap();
    succeed(folder.path(), "strip gt.png a.png -o two.png --columns normal,rendering --scenes scenes.json");
    succeed(folder.path(), "strip gt.png a.png -o one.png --columns normal,rendering");
    let width = |name: &str| image::open(folder.path().join(name)).unwrap().width() as usize;
    let side = image::open(folder.path().join("gt.png")).unwrap().height() as usize;
    // A column of a small material is as wide as its texts.
    assert!(width("two.png") >= width("one.png") + side + GAP);
    assert_holds(folder.path(), "two.png", &["distant light 0.500, 0.500, 0.700", "svbrdf:columns"]);
    let outside = "columns 0 to 7 and rows 0 to 7";
    let strip = |options: &str| format!("strip gt.png a.png -o strip.png {options}");
    for (args, code, words) in [
        (strip("--crop 0,7,8,2"), 1, "0,7,8,2"),
        (strip("--crop 8,0,1,1"), 1, outside),
        (strip("--crop=-1,0,2,2"), 64, "--crop"),
        (strip("--columns height"), 64, "height"),
        ("strip gt.png a.png -o strip.exr".to_owned(), 64, ".png"),
    ] {
        assert_refused(folder.path(), &[(&args, code, words)]);
    }
}

#[test]
fn a_figure_of_a_data_set_has_a_row_a_material_and_a_column_a_method_with_the_losses_of_rank() {
    let folder = data_set(&[("ours", 3), ("theirs", 60)], 3);
    let at = folder.path();
    std::fs::remove_file(at.join("theirs/m1.png")).unwrap();
    let reading = "--read albedo=linear,roughness=r,normal-y=up,order=ndrs";
    succeed(at, &format!("strip --dataset gt ours theirs {reading} -o plain.png"));
    let size = |name: &str| image::image_dimensions(at.join(name)).unwrap();
    let plain = size("plain.png");
    assert!(plain.0 > 3 * 192 && plain.1 > 3 * 192, "{plain:?}");
    succeed(at, &format!("strip --dataset gt ours theirs {reading} --results kept -o losses.png"));
    let picture = |name: &str| image::open(at.join(name)).unwrap().to_rgb8();
    assert!(size("losses.png") == plain && picture("losses.png") != picture("plain.png"), "no losses");
    // They are in the folder under the keys of rank: it computes none.
    let files = || std::fs::read_dir(at.join("kept")).unwrap().count();
    assert_eq!(files(), 5);
    succeed(at, &format!("rank --dataset gt ours theirs {reading} --results kept"));
    assert_eq!(files(), 5);
    assert_holds(at, "losses.png", &["ground truth | ours | theirs", "m0 | m1 | m2"]);
    // A planted fault: methods that changed places.
    succeed(at, &format!("strip --dataset gt theirs ours {reading} -o swapped.png"));
    assert!(picture("swapped.png") != picture("plain.png"));
    assert_refused(
        at,
        &[
            ("strip --dataset gt ours -o x.png --columns normal,diffuse", 64, "one of --columns"),
            ("strip --dataset gt ours -o x.png --crop 1,1,2,2", 64, "leave out --crop"),
            ("strip gt/m0.png ours/m0.png -o x.png --results kept", 64, "--dataset"),
        ],
    );
}
