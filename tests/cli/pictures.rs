//! The files that `svbrdf render` writes.

use std::path::Path;

use image::imageops::{FilterType, crop_imm};
use image::{Rgb, RgbImage};

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
use svbrdf_files::session::Session;

use super::{assert_has, assert_holds, fail, folder, run_in, succeed, text, text_of};
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
    let session = Session::read(&one).unwrap();
    assert_eq!((session.scene, session.convention.as_str(), session.exposure), (scene, "printed", 2.0));
    let meta = exr::prelude::MetaData::read_from_file(one, false).unwrap();
    let attributes = &meta.headers[0].own_attributes;
    assert_has(&attributes.comments.clone().unwrap().to_string(), &["svbrdf:shows: radiance"]);
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
    assert!(said("svbrdf:sources").is_some() && said("Software").is_some());
}

#[test]
fn a_picture_is_opened_again_and_names_the_file_that_has_changed() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    // Characters that JSON, XML, PDF or attributes of an EXR escape.
    let truth = "g\u{e9}(&\u{1f600}.png";
    std::fs::rename(of("gt.png"), of(truth)).unwrap();
    let scene = "--light -0.4,0.5,0.8 --view 0.2,-0.3,2 --distant --exposure 1.5 --convention guided-2020";
    succeed(folder.path(), &format!("render {truth} a.png {scene} -o files.png"));
    let pixels = |name: &str| image::open(of(name)).unwrap().to_rgb8();
    for (command, name) in [
        ("render", "a2.png"),
        ("render --difference=flip", "b.png"),
        ("render", "c.exr"),
        ("strip", "d.png"),
        ("strip", "e.pdf"),
        ("strip", "f.svg"),
    ] {
        succeed(folder.path(), &format!("{command} {truth} a.png {scene} -o {name}"));
        succeed(folder.path(), &format!("render {name} --show rendering -o again.png"));
        assert!(pixels("again.png") == pixels("files.png"), "{name}");
        succeed(folder.path(), &format!("render {name} -o again.png"));
        assert_eq!(pixels("again.png") == pixels("files.png"), name != "b.png", "{name}");
        let session = Session::read(&of(name)).unwrap();
        assert_eq!(session.materials.len(), 2);
        let bytes = std::fs::read(of("a.png")).unwrap();
        // A file beside a material, which is named like a map of it.
        std::fs::write(of("roughness.png"), &bytes).unwrap();
        assert!(session.changed().is_empty());
        std::fs::write(of("a.png"), [&bytes[..], b"0"].concat()).unwrap();
        let output = run_in(folder.path(), &format!("loss {name} --near 2 --distant 2"));
        let told = text(&output.stderr).to_owned();
        assert_eq!(told.matches("has changed since the picture was saved").count(), 1, "{told}");
        assert_has(&told, &["a.png has changed"]);
        std::fs::write(of("a.png"), bytes).unwrap();
        std::fs::remove_file(of("roughness.png")).unwrap();
        // Beside a prediction, it is a picture of a material, or none.
        assert_has(&fail(folder.path(), &format!("loss {name} a.png"), 1), &[name]);
    }
    std::fs::remove_file(of("a.png")).unwrap();
    assert_has(&fail(folder.path(), "loss c.exr", 1), &["a.png", "the session c.exr names the materials"]);
}

#[test]
fn a_picture_with_a_broken_session_is_refused_with_its_reason() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    succeed(folder.path(), "strip gt.png a.png -o good.svg");
    let good = std::fs::read_to_string(of("good.svg")).unwrap();
    let session = good.lines().find(|line| line.starts_with("svbrdf:session: ")).unwrap();
    for (bad, reason) in [
        (session[..session.len() / 2].to_owned(), "cannot be opened"),
        ("svbrdf:session: ".to_owned(), "cannot be opened"),
        ("svbrdf:session: [3]".to_owned(), "cannot be opened"),
        (session.replace("\"sha256\":[", "\"sha256\":[7,"), "expected"),
        (session.replace("\"sha256\":[", "\"sha256\":{},\"other\":["), "expected"),
        (session.replace("\"svbrdf-session\":1", "\"svbrdf-session\":2"), "newer program"),
        (session.replace("\"kind\":\"near\"", "\"kind\":\"far\""), "near"),
        (session.replace("\"path\":\"a.png\"", "\"path\":\"/dev/zero\""), "/dev/zero"),
    ] {
        assert_ne!(bad, session);
        std::fs::write(of("bad.svg"), good.replace(session, &bad)).unwrap();
        assert_has(&fail(folder.path(), "loss bad.svg", 1), &["bad.svg", reason]);
    }
}

#[test]
fn a_session_has_its_mask_in_every_command() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    let half = |x: u32, _: u32| Rgb([if x < 4 { 255 } else { 0 }; 3]);
    RgbImage::from_fn(8, 8, half).save(of("mask.png")).unwrap();
    succeed(folder.path(), "strip gt.png a.png --mask mask.png -o strip.png");
    let loss = |materials: &str| {
        let table = succeed(folder.path(), &format!("loss {materials} --near 4 --distant 2 --format csv"));
        table.lines().nth(1).and_then(|row| row.split(',').nth(1)).unwrap().to_owned()
    };
    assert_eq!(loss("strip.png"), loss("gt.png a.png --mask mask.png"));
    assert_ne!(loss("strip.png"), loss("gt.png a.png"), "a planted fault: all texels");
    succeed(folder.path(), "render strip.png --show roughness -o roughness.exr");
    let rough = image_of_exr(&of("roughness.exr"));
    assert!(rough.pixels[4..8].iter().all(|rough| *rough == [1.0; 3]) && rough.pixels[0] != [1.0; 3]);
    for command in ["blame", "worst", "diagnose", "rank --robust", "photo gt.png"] {
        let refused = fail(folder.path(), &format!("{command} strip.png"), 64);
        assert_has(&refused, &["over all texels, and not over those of a mask"]);
    }
    assert_has(&fail(folder.path(), "view --dataset . . --mask mask.png", 64), &["leave out --mask"]);
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
fn pictures_are_gray_outside_of_a_mask() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    let half = |x: u32, _: u32| Rgb([if x < 4 { 255 } else { 0 }; 3]);
    RgbImage::from_fn(8, 8, half).save(of("mask.png")).unwrap();
    for mask in ["", "--mask mask.png"] {
        let is_masked = !mask.is_empty();
        succeed(folder.path(), &format!("map gt.png a.png --near 3 --distant 2 -o map.exr {mask}"));
        for (texel, loss) in image_of_exr(&of("map.exr")).pixels.iter().enumerate() {
            assert_eq!(loss[0].is_nan(), is_masked && texel % 8 >= 4, "{texel}, {mask}");
        }
        let columns = "--columns normal,rendering,rendering:";
        succeed(folder.path(), &format!("strip gt.png a.png {columns} -o strip.png {mask}"));
        let strip = image::open(of("strip.png")).unwrap().into_rgb8();
        let gray = strip.pixels().filter(|pixel| pixel.0 == [128; 3]).count();
        assert_eq!(gray > strip.pixels().len() / 20, is_masked, "{gray} of {}", strip.pixels().len());
        succeed(folder.path(), &format!("report gt.png a.png --target-error 10% -o page.html {mask}"));
        let page = std::fs::read_to_string(of("page.html")).unwrap();
        assert_eq!(page.contains("Rendering loss over the mask of 32 texels"), is_masked);
    }
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
fn the_mean_of_a_log_difference_from_a_photograph_is_the_one_that_is_printed() {
    let folder = folder();
    let scene = "--view 0,0,2 --light 0.5,0.5,1";
    succeed(folder.path(), &format!("render gt.png -o photo.exr {scene}"));
    let printed = succeed(folder.path(), &format!("photo photo.exr a.png {scene} -o log.exr --format json"));
    let printed: serde_json::Value = serde_json::from_str(&printed).unwrap();
    let expected = printed["results"][0]["log"].as_f64().unwrap();
    let values = image_of_exr(&folder.path().join("log.exr")).pixels.concat();
    let mean = values.iter().map(|value| f64::from(*value)).sum::<f64>() / values.len() as f64;
    assert!((mean / expected - 1.0).abs() < 1e-6 && expected > 0.0, "{mean}, {expected}");
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

/// The first place where a part stands in a picture.
fn place(picture: &RgbImage, part: &RgbImage) -> Option<[u32; 2]> {
    let (width, height) = part.dimensions();
    let is_at = |[x, y]: &[u32; 2]| {
        let probes = [0, 1, 2].map(|i| [i * (width - 1) / 2, i * (height - 1) / 2]);
        probes.into_iter().all(|[dx, dy]| picture.get_pixel(x + dx, y + dy) == part.get_pixel(dx, dy))
            && crop_imm(picture, *x, *y, width, height).to_image() == *part
    };
    let (right, lower) = (picture.width() - width, picture.height() - height);
    (0..=lower).flat_map(|y| (0..=right).map(move |x| [x, y])).find(is_at)
}

#[test]
fn a_strip_has_the_pixels_that_render_writes() {
    let folder = folder();
    let view = "--view 0.2,-0.3,2 --light -1,0.5,0.8";
    let columns = "normal,diffuse,roughness,specular,rendering,rendering:,normal:";
    succeed(
        folder.path(),
        &format!("strip -o strip.png --columns {columns} {view} --exposure 0.5 --range auto"),
    );
    let open = |name: &str| image::open(folder.path().join(name)).unwrap().into_rgb8();
    let strip = open("strip.png");
    let side = 256;
    let mut found = Vec::new();
    for (column, options, first) in [
        (0, "--show normal".to_owned(), 0),
        (1, "--show diffuse".to_owned(), 0),
        (2, "--show roughness".to_owned(), 0),
        (3, "--show specular".to_owned(), 0),
        (4, format!("{view} --exposure 0.5"), 0),
        (5, format!("{view} --difference --range auto"), 1),
        (6, "--show normal --difference --range auto".to_owned(), 1),
    ] {
        succeed(folder.path(), &format!("render -o one.png {options}"));
        let one = open("one.png");
        for row in first..3 {
            let pane = crop_imm(&one, (row - first) * (side + GAP as u32), 0, side, side).to_image();
            // The normals of the prediction with wrong roughness are right.
            let is_empty = pane.pixels().all(|pixel| pixel == pane.get_pixel(0, 0));
            assert_eq!(is_empty, (column, row) == (6, 2), "column {column}, row {row}");
            let place = place(&strip, &pane).unwrap_or_else(|| panic!("column {column}, row {row}"));
            found.push(((column, row), place));
        }
    }
    // A column is at one place, and so is a row.
    let at = |cell: (u32, u32)| found.iter().find(|(found, _)| *found == cell).unwrap().1;
    let [first, second, third] = [0, 1, 2].map(|row| at((4, row)));
    assert!(first[0] == second[0] && second[0] == third[0] && first[1] + side < second[1]);
    let difference = at((5, 1));
    assert!(difference[1] == second[1] && difference[0] > second[0] + side);
    let label = crop_imm(&strip, 0, first[1], 60, side).to_image();
    assert!(label.pixels().any(|pixel| pixel.0[0] < 100), "the rows have names");
}

#[test]
fn a_strip_frames_crops_and_shows_them_magnified_beside_their_cells() {
    let folder = folder();
    let crops = "--crop 40,60,32,20 --crop 0,200,30,56";
    succeed(folder.path(), &format!("strip -o strip.png --columns diffuse,rendering: {crops}"));
    succeed(folder.path(), "render -o one.png --show diffuse");
    let open = |name: &str| image::open(folder.path().join(name)).unwrap().into_rgb8();
    let [strip, one] = ["strip.png", "one.png"].map(open);
    let (times, orange) = (6, Rgb([230, 159, 0]));
    let inset = crop_imm(&one, 40, 60, 32, 20).to_image();
    let inset = image::imageops::resize(&inset, 32 * times, 20 * times, FilterType::Nearest);
    let [x, y] = place(&strip, &inset).expect("the inset of the ground truth");
    assert_eq!(*strip.get_pixel(x - 1, y - 1), orange, "its frame");
    assert!((0..x - 10).any(|x| *strip.get_pixel(x, y + 60) == orange), "the frame in the cell to its left");
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
