//! The pictures of the window in the README and docs.

use image::codecs::jpeg::JpegEncoder;

use svbrdf_viewer::dataset::pictures::MatrixCell;
use svbrdf_viewer::dataset::{losses, pictures, summary};

use super::materials::{SIDE, sample};
use super::*;

/// Size of a picture, in pixels.
const SIZE: Vec2 = vec2(1240.0, 760.0);

/// Quality of the pictures.
const QUALITY: u8 = 76;

/// The built-in pair in a window of the size of a picture.
fn sized<'a>() -> Window<'a> {
    let mut window = built_in();
    window.set_size(SIZE);
    window.run_steps(4);
    window
}

/// Waits for all of the tab *Why* but the diagnosis.
fn wait_for_why(window: &mut Window<'_>) {
    wait(window, "the attribution", |app| app.attribution().is_some());
    wait(window, "the thumbnails", |app| app.listed_scenes().is_some());
}

/// Moves the pointer to where nothing is under it, and writes the window to this file of `assets/pictures/`.
fn write(window: &mut Window<'_>, name: &str) {
    window.event(egui::Event::PointerMoved(egui::pos2(2.0, SIZE.y - 2.0)));
    window.run_steps(12);
    let picture = window.render().unwrap();
    let picture = opaque(window, picture);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/pictures").join(name);
    let file = std::io::BufWriter::new(std::fs::File::create(path).unwrap());
    // At most 250 KB.
    let encoder = JpegEncoder::new_with_quality(file, QUALITY);
    picture.write_with_encoder(encoder).unwrap();
}

#[test]
#[ignore = "writes the pictures in assets/pictures"]
fn the_pictures_of_the_readme() {
    let mut window = sized();
    press(&mut window, egui::Key::D);
    wait(&mut window, "the losses", |app| app.losses().is_some());
    statistics(&mut window);
    write(&mut window, "window.jpg");
    let mut window = sized();
    tab(&mut window, "Why");
    for section in ["Would something trivial explain it?", "Light and view"] {
        click(&mut window, section);
        window.run_steps(8);
    }
    wait_for_why(&mut window);
    window.get_by_label("normal: 80.9% of the loss").click();
    wait(&mut window, "the mixture", |app| app.displayed_materials()[1].0.contains("only its normal"));
    write(&mut window, "why.jpg");
}

/// The built-in ground truth with Y of its normals in the other direction, diagnosed.
#[test]
#[ignore = "writes a picture in assets/pictures"]
fn the_picture_of_a_diagnosis() {
    let folder = tempfile::tempdir().unwrap();
    let [truth, flipped] = ["worn tiles.png", "Y down.png"].map(|name| folder.path().join(name));
    let mut strip = strip();
    strip.save(&truth).unwrap();
    for (x, _, pixel) in strip.enumerate_pixels_mut() {
        pixel.0[1] = if x < SIDE { 255 - pixel.0[1] } else { pixel.0[1] };
    }
    strip.save(&flipped).unwrap();
    let mut window = sized();
    let read = ReadOptions { order: Some("ndrs".parse().unwrap()), ..ReadOptions::AUTO };
    let read = ReadOptions { preset: Some("deschaintre".parse().unwrap()), ..read };
    edit(&mut window, |model| opening::open(model, vec![truth, flipped], true, read));
    wait(&mut window, "the materials", |app| app.names() == ["worn tiles", "Y down"]);
    tab(&mut window, "Why");
    wait(&mut window, "the diagnosis", |app| app.diagnosis().is_some());
    wait_for_why(&mut window);
    write(&mut window, "diagnosis.jpg");
}

/// Nine materials with two methods: the sheet under one light, and the losses of the methods.
#[test]
#[ignore = "writes a picture in assets/pictures"]
fn the_picture_of_a_data_set() {
    let folder = tempfile::tempdir().unwrap();
    let sets = [("gt", 0), ("blurred normals", 1), ("wrong roughness", 2)];
    for (name, number) in &sets {
        let pixels = sample(*number).into_raw();
        std::fs::create_dir(folder.path().join(name)).unwrap();
        for index in 0..9_u32 {
            // Moved, and in other colours.
            let picture = image::RgbImage::from_fn(4 * SIDE, SIDE, |x, y| {
                let [tile, column] = [x / SIDE, (x + 37 * index) % SIDE];
                let at = 3 * (4 * SIDE * ((y + 53 * index) % SIDE) + tile * SIDE + column) as usize;
                let channel = |c: usize| pixels[at + if tile == 1 { (c + index as usize) % 3 } else { c }];
                image::Rgb([channel(0), channel(1), channel(2)])
            });
            picture.save(folder.path().join(name).join(format!("tiles {index}.png"))).unwrap();
        }
    }
    let mut window = sized();
    drop_files(&mut window, sets.each_ref().map(|(name, _)| folder.path().join(name)));
    wait(&mut window, "all losses", |app| losses::ask(app.shown()).count() == 9);
    tab(&mut window, "Methods");
    click(&mut window, "Light and view");
    edit(&mut window, |model| model.dataset.table.cell = Some(142.0));
    wait(&mut window, "the summary", |app| summary::drawn(app.shown()).is_some());
    let cell = MatrixCell { case: 4, column: 2 };
    wait(&mut window, "the cells", |app| {
        pictures::latest(app.shown()).is_some_and(|sheet| sheet.part(cell).is_some())
    });
    rest(&mut window, 40);
    write(&mut window, "dataset.jpg");
}
