//! What is seen of a window: its texts, its pixels, and the files that it writes.

use super::*;

pub fn pane(window: &Window<'_>, title: &str) -> egui::Rect {
    window.get_by_label(&format!("Pane {title}")).rect()
}

pub fn has(window: &Window<'_>, text: &str) -> bool {
    window.query_all_by_label_contains(text).next().is_some()
}

/// Whether the bytes of a file contain a text.
pub fn file_contains(path: &Path, text: &str) -> bool {
    std::fs::read(path).unwrap().windows(text.len()).any(|window| window == text.as_bytes())
}

/// The width of an EXR, and its pixels.
pub fn read_exr(path: &Path) -> (usize, Vec<[f32; 3]>) {
    let read = exr::prelude::read_first_rgba_layer_from_file(
        path,
        |size, _| (size.width(), vec![[0f32; 3]; size.area()]),
        |(width, pixels), at, (r, g, b, _): (f32, f32, f32, f32)| {
            pixels[at.y() * *width + at.x()] = [r, g, b]
        },
    );
    read.unwrap().layer_data.channel_data.pixels
}

/// What the window asks of the system in the next frames.
pub fn commands(window: &mut Window<'_>) -> Vec<egui::OutputCommand> {
    let mut frame = || {
        window.step();
        window.output().platform_output.commands.clone()
    };
    (0..20).flat_map(|_| frame()).collect()
}

/// The statistics of the displayed differences, once they are there.
pub fn statistics(window: &mut Window<'_>) -> Vec<Statistics> {
    wait(window, "the statistics", |app| app.difference_statistics().is_some());
    window.difference_statistics().unwrap().iter().map(|one| one.unwrap()).collect()
}

/// Asserts that magnified texels of the pane `title` have the readout of the `start` of a column, and the colours, of `values`.
pub fn assert_texels(window: &mut Window<'_>, title: &str, start: &str, values: &[f32]) {
    let range = window.difference_range() as f32;
    let rect = pane(window, title);
    let mut reads = Vec::new();
    for share in [vec2(0.12, 0.17), vec2(0.83, 0.31), vec2(0.41, 0.88), vec2(0.62, 0.93)] {
        // The middle of a pixel.
        let at = (rect.min + rect.size() * share).floor() + vec2(0.5, 0.5);
        hover(window, at);
        window.run_steps(2);
        let [x, y] = texel_read(window).unwrap();
        let value = values[y * 256 + x];
        let text = column(window, start);
        let read: f32 = text[start.len()..].trim().parse().unwrap();
        // Four decimals, or three digits of what has more zeros.
        let bound = 5.1e-5_f32.max(0.005 * value.abs());
        assert!((read - value).abs() <= bound, "{title} at {x}, {y}: {text}, not {value}");
        reads.push((at, value));
    }
    hover(window, egui::pos2(600.0, 20.0));
    window.run_steps(2);
    let seen = pixels(window, rect);
    let far = |at: Pos2, value: f32| {
        let [x, y] = [at.x - rect.left().floor(), at.y - rect.top().floor()];
        let (found, expected) =
            (seen.get_pixel(x as u32, y as u32).0, difference_to_display(value, range, false));
        (0..3).map(|c| found[c].abs_diff(expected[c])).max().unwrap()
    };
    assert!(reads.iter().all(|(at, value)| far(*at, *value) <= 3), "{title}: {reads:?}");
    assert!(reads.iter().any(|(at, value)| far(*at, 2.0 * value + 0.1) > 20), "a planted fault");
}

/// The means of the channels.
pub fn means(pixels: &[[f32; 3]]) -> Vec<f32> {
    pixels.iter().map(|rgb| rgb.iter().sum::<f32>() / 3.0).collect()
}

/// Asserts that panes, readout and a saved file have these differences of both predictions; the file in its folder.
pub fn assert_differences(
    window: &mut Window<'_>,
    maps: &[Vec<[f32; 3]>],
    slack: f32,
) -> (tempfile::TempDir, PathBuf) {
    for (slot, title) in PREDICTIONS.into_iter().enumerate() {
        assert_texels(window, title, &format!("{} ", slot + 1), &means(&maps[slot]));
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("difference.exr");
    save(window, SaveKind::Renderings, &path);
    let (width, saved) = read_exr(&path);
    let gap = svbrdf_files::export::GAP;
    assert_eq!((width, saved.len()), (2 * 256 + gap, 256 * (2 * 256 + gap)));
    for (i, rgb) in maps[1].iter().enumerate().step_by(97) {
        let found = saved[i / 256 * width + 256 + gap + i % 256];
        assert!((0..3).all(|c| (found[c] - rgb[c]).abs() <= slack), "{i}: {found:?}, expected {rgb:?}");
    }
    (folder, path)
}

/// The magnification in the status line, in pixels per texel.
pub fn magnification(window: &Window<'_>) -> f64 {
    let field = window.get_by_role_and_label(Role::SpinButton, "Magnification");
    field.accesskit_node().numeric_value().unwrap()
}

/// The text of the status line's column that begins with `start`.
pub fn column(window: &Window<'_>, start: &str) -> String {
    let mut nodes = window.query_all_by_label_contains(start).filter_map(|node| node.value());
    nodes.find(|text| text.starts_with(start)).unwrap_or_else(|| panic!("no column {start:?}"))
}

/// The (column, row) that the status line names; `None` beside the material.
pub fn texel_read(window: &Window<'_>) -> Option<[usize; 2]> {
    let text = column(window, "texel ");
    let (column, row) = text.trim_start_matches("texel ").trim().split_once(',')?;
    Some([column.parse().unwrap(), row.parse().unwrap()])
}

/// Pixels per texel at which a material of this size fits into a pane, but for its margin of 3%.
pub fn fitted_scale(rect: egui::Rect, [width, height]: [usize; 2]) -> f32 {
    (rect.width() / width as f32).min(rect.height() / height as f32) / 1.03
}

/// Asserts that a material of 256 x 256 texels, fitted before, has moved by `by`, in shares of the pane.
pub fn assert_panned(window: &Window<'_>, rect: egui::Rect, by: [f32; 2]) {
    let framing = window.view().display.framing.unwrap();
    let fitted = fitted_scale(rect, [256, 256]);
    assert!((framing.pixels_per_texel / fitted - 1.0).abs() < 0.01, "{framing:?}, fitted {fitted}");
    let moved = [0, 1].map(|axis| (128.0 - framing.centre[axis]) * fitted / rect.size()[axis]);
    assert!((0..2).all(|axis| (moved[axis] - by[axis]).abs() < 0.01), "{moved:?} for {by:?}: {framing:?}");
}

pub fn pixels(window: &mut Window<'_>, rect: egui::Rect) -> image::RgbaImage {
    let picture = window.render().unwrap();
    let [x, y, w, h] = [rect.left(), rect.top(), rect.width(), rect.height()].map(|v| v as u32);
    image::imageops::crop_imm(&picture, x, y, w, h).to_image()
}

/// Pixels over the background of a window: that of the tests is transparent, with premultiplied colours.
pub fn opaque(window: &Window<'_>, pixels: image::RgbaImage) -> image::RgbImage {
    let fill = window.ctx.style_of(egui::Theme::Dark).visuals.panel_fill.to_array();
    let over = |[r, g, b, a]: [u8; 4], c: usize| {
        let rest = 1.0 - f32::from(a) / 255.0;
        (f32::from([r, g, b][c]) + rest * f32::from(fill[c])).min(255.0) as u8
    };
    let pixel = |x, y| image::Rgb([0, 1, 2].map(|c| over(pixels.get_pixel(x, y).0, c)));
    image::RgbImage::from_fn(pixels.width(), pixels.height(), pixel)
}
