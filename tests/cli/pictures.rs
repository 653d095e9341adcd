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
use svbrdf_files::samples;

use super::{assert_has, assert_holds, data_set, folder, succeed, text_of};
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
fn an_exr_holds_the_rendering_to_the_last_bit_says_where_it_comes_from_and_is_the_same_in_every_run() {
    let folder = folder();
    let [one, two] = ["one.exr", "two.exr"].map(|name| {
        let scene = "--view 0.2,-0.3,2 --light -1,0.5,0.8 --distant --exposure 2";
        succeed(folder.path(), &format!("render -o {name} {scene}"));
        folder.path().join(name)
    });
    let scene = Scene { kind: Kind::Distant, view: [0.2, -0.3, 2.0], light: [-1.0, 0.5, 0.8] };
    let panes = panes(&scene);
    let picture = image_of_exr(&one);
    assert_eq!((picture.width, picture.height), (width_of(&panes), panes[0].height));
    for (i, pixel) in picture.pixels.iter().enumerate() {
        let (x, y) = (i % picture.width, i / picture.width);
        assert_eq!(*pixel, pixel_at(&panes, x, y).unwrap_or([0.0; 3]), "{x}, {y}");
    }
    assert!(std::fs::read(&one).unwrap() == std::fs::read(two).unwrap());
    let meta = exr::prelude::MetaData::read_from_file(one, false).unwrap();
    let attributes = &meta.headers[0].own_attributes;
    let comments = attributes.comments.clone().unwrap().to_string();
    assert_has(
        &comments,
        &["svbrdf:light: -1,0.5,0.8", "svbrdf:kind: distant", "svbrdf:convention: printed"],
    );
    assert!(attributes.software_name.clone().unwrap().to_string().starts_with("svbrdf "));
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
    let scene = "--view 0.2,-0.3,2 --light -1,0.5,0.8 --exposure 0.5";
    let mut places = Vec::new();
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
            let pane = crop(&one, [(row - first) * (side + GAP), 0], side);
            // The normals of the prediction with wrong roughness are right.
            let is_empty = pane.iter().all(|pixel| *pixel == pane[0]);
            assert_eq!(is_empty, (column, row) == (6, 2), "column {column}, row {row}");
            // Equal ones, such as the diffuse maps, are found in their order.
            let is_free = |place: &[usize; 2]| !places.contains(&(*place, (column, row)));
            let found = placed(&strip, &pane, side).into_iter().filter(is_free);
            let found: Vec<[usize; 2]> = found.collect();
            assert!(!found.is_empty(), "column {column}, row {row}");
            places.extend(found.into_iter().map(|place| (place, (column, row))));
        }
    }
    // A column is at one place, and so is a row.
    let rendering = |row: usize| places.iter().find(|(_, cell)| *cell == (4, row)).unwrap().0;
    let [first, second, third] = [0, 1, 2].map(rendering);
    assert!(first[0] == second[0] && second[0] == third[0] && first[1] + side < second[1]);
    let difference = places.iter().find(|(_, cell)| *cell == (5, 1)).unwrap().0;
    assert!(difference[1] == second[1] && difference[0] > second[0] + side);
    let label = image::imageops::crop_imm(&strip, 0, first[1] as u32, 60, side as u32).to_image();
    assert!(label.pixels().any(|pixel| pixel.0[0] < 100), "the rows have names");
}

/// The places of a square of pixels in a picture.
fn placed(picture: &image::RgbImage, square: &[[u8; 3]], side: usize) -> Vec<[usize; 2]> {
    let at = |x: usize, y: usize| picture.get_pixel(x as u32, y as u32).0;
    let [right, lower] = [picture.width() as usize - side, picture.height() as usize - side];
    let is_at = |[x, y]: &[usize; 2]| {
        let probes = [0, side / 2, side - 1].into_iter().flat_map(|i| [[i, i], [i, side - 1 - i]]);
        probes.into_iter().all(|[dx, dy]| at(x + dx, y + dy) == square[dy * side + dx])
            && crop(picture, [*x, *y], side) == square
    };
    let all = (0..=lower).flat_map(|y| (0..=right).map(move |x| [x, y]));
    all.filter(is_at).collect()
}

#[test]
fn a_strip_frames_crops_and_shows_them_magnified_beside_their_cells() {
    let folder = folder();
    succeed(
        folder.path(),
        "strip -o strip.png --columns diffuse,rendering: --crop 40,60,32,20 --crop 0,200,30,56",
    );
    succeed(folder.path(), "render -o one.png --show diffuse");
    let open = |name: &str| image::open(folder.path().join(name)).unwrap().into_rgb8();
    let [strip, one] = ["strip.png", "one.png"].map(open);
    let (times, orange) = (6, image::Rgb([230, 159, 0]));
    let inset = image::imageops::crop_imm(&one, 40, 60, 32, 20).to_image();
    let [width, height] = [32 * times, 20 * times];
    let inset = image::imageops::resize(&inset, width, height, image::imageops::FilterType::Nearest);
    let is_at = |x: u32, y: u32| {
        [[0, 0], [100, 50], [191, 119]]
            .into_iter()
            .all(|[dx, dy]| strip.get_pixel(x + dx, y + dy) == inset.get_pixel(dx, dy))
            && *image::imageops::crop_imm(&strip, x, y, width, height).to_image() == *inset
    };
    let all = (0..strip.height() - height).flat_map(|y| (0..strip.width() - width).map(move |x| (x, y)));
    let (x, y) = all.into_iter().find(|(x, y)| is_at(*x, *y)).expect("the inset of the ground truth");
    assert_eq!(*strip.get_pixel(x - 1, y - 1), orange, "its frame");
    let is_orange = |y: u32| (0..x - 10).any(|x| *strip.get_pixel(x, y) == orange);
    assert!(is_orange(y + 60), "the frame in the cell to its left");
    assert_holds(folder.path(), "strip.png", &["40,60,32,20 | 0,200,30,56"]);
}

/// The number after a word in a text.
fn number_after(text: &str, word: &str) -> f64 {
    let rest = text.split(word).nth(1).unwrap_or_else(|| panic!("no {word}")).trim_start();
    let end = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
    rest[..end].parse().unwrap()
}

#[test]
fn a_figure_of_a_paper_has_its_width_and_its_text_in_points() {
    let folder = folder();
    let args = "strip gt.png a.png --columns normal,rendering: --text-pt 6.5";
    for millimetres in [88.0, 180.0] {
        for name in ["figure.svg", "figure.pdf"] {
            succeed(folder.path(), &format!("{args} --width-mm {millimetres} -o {name}"));
        }
        let svg = text_of(folder.path(), "figure.svg");
        assert_eq!(number_after(&svg, "width=\""), millimetres);
        let texts: Vec<&str> = svg.lines().filter(|line| line.starts_with("<text ")).collect();
        let text =
            |words: &str| *texts.iter().find(|line| line.contains(&format!(">{words}</text>"))).unwrap();
        assert_eq!(number_after(text("normal"), "font-size=\""), 6.5);
        let points = 72.0 / 25.4 * millimetres;
        for line in &texts {
            let end = number_after(line, " x=\"") + number_after(line, "textLength=\"");
            assert!(line.contains("middle") || line.contains("end\"") || end <= points + 0.01, "{line}");
        }
        let pdf = std::fs::read(folder.path().join("figure.pdf")).unwrap();
        let pdf: String = pdf.into_iter().map(char::from).collect();
        assert!(pdf.starts_with("%PDF-1.7") && pdf.contains("/BaseFont /SVBRDF+Ubuntu-Light"));
        assert!(pdf.contains("/F 6.5 Tf") && pdf.contains("/FontFile2") && pdf.contains("/ToUnicode"));
        let width: f64 =
            pdf.split("/MediaBox [0 0 ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
        assert!((width - points).abs() < 0.01, "{width}");
    }
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
    let height = |name: &str| image::open(folder.path().join(name)).unwrap().height();
    // Scenes stand above their columns where they differ.
    assert!(height("two.png") != height("one.png"));
    assert_holds(folder.path(), "two.png", &["distant light 0.5, 0.5, 0.7", "svbrdf:columns"]);
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
    assert_eq!(plain.0, 1040, "88 mm at 300 pixels an inch");
    succeed(at, &format!("strip --dataset gt ours theirs {reading} --results kept -o losses.png"));
    let picture = |name: &str| image::open(at.join(name)).unwrap().to_rgb8();
    assert!(size("losses.png").1 > plain.1 && picture("losses.png") != picture("plain.png"), "no losses");
    // They are in the folder under the keys of rank: it computes none.
    let files = || std::fs::read_dir(at.join("kept")).unwrap().count();
    assert_eq!(files(), 5);
    succeed(at, &format!("rank --dataset gt ours theirs {reading} --results kept"));
    assert_eq!(files(), 5);
    assert_holds(at, "losses.png", &["ground truth | ours | theirs", "m0 | m1 | m2"]);
    // A planted fault: methods that changed places.
    succeed(at, &format!("strip --dataset gt theirs ours {reading} -o swapped.png"));
    assert!(picture("swapped.png") != picture("plain.png"));
}
