//! The pictures of the window in the README.

use std::path::Path;

use image::codecs::png::{CompressionType, FilterType, PngEncoder};

use super::*;

/// Size of a picture, in pixels.
const SIZE: Vec2 = vec2(1240.0, 760.0);

/// The built-in pair with the tab *Why* open and room for it.
fn opened<'a>() -> Window<'a> {
    let mut window = built_in();
    window.set_size(SIZE);
    window.run_steps(4);
    tab(&mut window, "Why");
    window.get_by_label("Light and view").click();
    window.run_steps(12);
    wait(&mut window, "the attribution", |app| app.attribution().is_some());
    wait(&mut window, "the thumbnails", |app| app.listed_scenes().is_some());
    wait(&mut window, "the directions", |app| app.direction_map().is_some_and(|map| map.side == 64));
    window
}

/// Moves the pointer to where nothing is under it, and writes the window to this file of `assets/`.
fn write(window: &mut Window<'_>, name: &str) {
    window.event(egui::Event::PointerMoved(egui::pos2(2.0, SIZE.y - 2.0)));
    window.run_steps(12);
    let fill = window.ctx.style_of(egui::Theme::Dark).visuals.panel_fill;
    let mut picture = window.render().unwrap();
    // The tests' window is transparent where the real one has its background: premultiplied colours over that.
    for pixel in picture.pixels_mut() {
        let rest = 1.0 - f32::from(pixel.0[3]) / 255.0;
        for c in 0..3 {
            pixel.0[c] = (f32::from(pixel.0[c]) + rest * f32::from(fill.to_array()[c])).min(255.0) as u8;
        }
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets").join(name);
    let file = std::io::BufWriter::new(std::fs::File::create(path).unwrap());
    let encoder = PngEncoder::new_with_quality(file, CompressionType::Best, FilterType::Adaptive);
    image::DynamicImage::from(picture).to_rgb8().write_with_encoder(encoder).unwrap();
}

#[test]
#[ignore = "writes assets/why.png and assets/where.png"]
fn the_pictures_of_the_readme() {
    let mut window = opened();
    window.get_by_label_contains("normal: ").click();
    wait(&mut window, "the mixture", |app| app.seen()[1].0.contains("only its normal"));
    write(&mut window, "why.png");

    let mut window = opened();
    window.get_by_label("Error map").click();
    window.run_steps(3);
    wait(&mut window, "the error map", |app| app.difference_statistics().is_some());
    for section in ["Which map", "Which scenes"] {
        window.get_by_label(section).click();
        window.run_steps(12);
    }
    write(&mut window, "where.png");
}
