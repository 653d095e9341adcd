//! One mapping from the pointer to texels: readout, pins and rectangle name what the screen shows, in every layout, zoom and
//! projection.

use std::collections::BTreeSet;

use svbrdf_files::read::Albedo;
use svbrdf_files::source::MaterialSource;

use svbrdf_core::model::convention::Convention;
use svbrdf_viewer::model::inspection;

use super::*;

/// Views that are tried on a screen of each scale.
const VIEWS: usize = 12;
/// Pairs of points that are tried until both show a texel.
const TRIES: usize = 2000;

/// Columns and rows of a material whose diffuse map encodes the texel's place.
const SIZE: [u32; 2] = [48, 20];

/// A folder with maps of a material; red of the diffuse map counts columns, green counts rows.
fn numbered(folder: &Path) -> ViewerOptions {
    let save = |name: &str, at: &dyn Fn(u32, u32) -> [u8; 3]| {
        let picture = image::RgbImage::from_fn(SIZE[0], SIZE[1], |x, y| at(x, y).into());
        picture.save(folder.join(name)).unwrap();
    };
    save("normal.png", &|_, _| [128, 128, 255]);
    save("diffuse.png", &|x, y| [5 * x as u8 + 4, 12 * y as u8 + 4, 9]);
    save("specular.png", &|_, _| [10, 10, 10]);
    save("roughness.png", &|_, _| [100, 100, 100]);
    let read = ReadOptions { albedo: Some(Albedo::Linear), ..ReadOptions::AUTO };
    ViewerOptions {
        ground_truth: Some(MaterialSource::path(folder.to_owned(), read)),
        ..ViewerOptions::default()
    }
}

/// The texel whose colour this is; `None` for the background.
fn texel_of([red, green, blue]: [u8; 3]) -> Option<[usize; 2]> {
    // The map is linear, the screen sRGB.
    let srgb = |value: f64| {
        if value <= 0.003_130_8 { 12.92 * value } else { 1.055 * value.powf(1.0 / 2.4) - 0.055 }
    };
    let shown = |value: usize| (255.0 * srgb(value as f64 / 255.0)).round() as u8;
    let find = |count: u32, step: usize, seen: u8| {
        (0..count as usize).find(|i| shown(step * i + 4).abs_diff(seen) <= 1)
    };
    let is_background = blue.abs_diff(shown(9)) > 1;
    if is_background { None } else { Some([find(SIZE[0], 5, red)?, find(SIZE[1], 12, green)?]) }
}

fn zoom(window: &mut Window<'_>, at: Pos2, notches: f32) {
    hover(window, at);
    window.event(wheel(vec2(0.0, notches), egui::MouseWheelUnit::Line, Modifiers::NONE));
    window.run_steps(3);
}

fn held(window: &mut Window<'_>, modifiers: Modifiers) {
    window.event(egui::Event::ModifiersChanged(modifiers));
}

/// A picture of the window, with nothing under the pointer.
fn picture(window: &mut Window<'_>) -> image::RgbaImage {
    hover(window, Pos2::ZERO);
    window.render().unwrap()
}

/// The texel at a pixel of a picture, where all around it show the same one.
fn shown(picture: &image::RgbaImage, [x, y]: [u32; 2]) -> Option<[usize; 2]> {
    let colour = picture.get_pixel(x, y);
    let around = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| [x, y]));
    let is_one = around.into_iter().all(|[x, y]| picture.get_pixel(x, y) == colour);
    texel_of([colour.0[0], colour.0[1], colour.0[2]]).filter(|_| is_one)
}

/// A pixel of a pane, not on the line of a wipe.
fn place(pane: egui::Rect, scale: f32, random: &mut ChaCha8Rng) -> Option<[u32; 2]> {
    let share = vec2(0.02 + 0.96 * unit(random), 0.02 + 0.7 * unit(random));
    let at = pane.min + pane.size() * share;
    let is_beside = (at.x - pane.center().x).abs() > 12.0;
    is_beside.then_some([at.x * scale, at.y * scale].map(|along| along as u32))
}

fn unit(random: &mut ChaCha8Rng) -> f32 {
    below(random, 10_000) as f32 / 10_000.0
}

fn middle([x, y]: [u32; 2], scale: f32) -> Pos2 {
    egui::pos2(x as f32 + 0.5, y as f32 + 0.5) / scale
}

/// The columns or rows of a region.
fn along(region: Region, axis: usize) -> BTreeSet<usize> {
    (region.first[axis]..=region.last[axis]).collect()
}

/// A view and, for messages, its description.
fn random_view(window: &mut Window<'_>, random: &mut ChaCha8Rng) -> String {
    let display = &mut window.state_mut().parts.model.view.display;
    display.quantity = Quantity::Diffuse;
    display.layout = [Layout::SideBySide, Layout::Wipe, Layout::Single][below(random, 3)];
    display.projection = [Projection::Flat, Projection::Perspective][below(random, 2)];
    display.framing = None;
    let what = format!("{:?}, {:?}", display.layout, display.projection);
    let view = [unit(random) - 0.5, unit(random) - 0.5, 2.0].map(f64::from);
    window.state_mut().parts.model.view.scene.view = view;
    window.state_mut().parts.model.inspection = Inspection::default();
    window.run_steps(3);
    what
}

/// A pane, magnified at random.
fn random_pane(window: &mut Window<'_>, random: &mut ChaCha8Rng) -> egui::Rect {
    let panes: Vec<egui::Rect> =
        window.query_all_by_label_contains("Pane ").map(|node| node.rect()).collect();
    let pane = panes[below(random, panes.len())];
    let at = pane.min + pane.size() * vec2(0.3 + 0.4 * unit(random), 0.45 + 0.1 * unit(random));
    zoom(window, at, below(random, 7) as f32);
    pane
}

/// Whether pixels near this one differ.
fn differs(a: &image::RgbaImage, b: &image::RgbaImage, [x, y]: [u32; 2], reach: u32) -> bool {
    let around = |at: u32, end: u32| at.saturating_sub(reach)..=(at + reach).min(end - 1);
    around(x, a.width()).any(|x| around(y, a.height()).any(|y| a.get_pixel(x, y) != b.get_pixel(x, y)))
}

/// Readout, pin and rectangle at random pixels of a view.
fn check_view(window: &mut Window<'_>, scale: f32, random: &mut ChaCha8Rng) {
    let what = format!("scale {scale}, {}", random_view(window, random));
    let pane = random_pane(window, random);
    let before = picture(window);
    let display = window.view().display.clone();
    for pixel in (0..12).filter_map(|_| place(pane, scale, random)) {
        let colour = before.get_pixel(pixel[0], pixel[1]).0;
        hover(window, middle(pixel, scale));
        let expected = texel_of([colour[0], colour[1], colour[2]]);
        assert_eq!(texel_read(window), expected, "{what}: pixel {pixel:?} has the colour {colour:?}");
    }
    let mut one = || {
        let pixel = place(pane, scale, random)?;
        Some((pixel, shown(&before, pixel)?))
    };
    let pair = (0..TRIES).find_map(|_| Some([one()?, one()?]));
    let [(from, a), (to, b)] = pair.expect("texels are in sight");
    for (pixel, texel) in [(from, a), (to, b)] {
        hover(window, middle(pixel, scale));
        assert_eq!(texel_read(window), Some(texel), "{what}: readout at {pixel:?}");
    }
    press(window, egui::Key::I);
    assert_eq!(window.model().inspection.pins, [b], "{what}: pin");
    window.state_mut().parts.model.inspection.pins.clear();
    press(window, egui::Key::Q);
    let screen = egui::Rect::from_min_size(Pos2::ZERO, vec2(1.0, 1.0));
    drag_primary(window, screen, middle(from, scale).to_vec2(), middle(to, scale).to_vec2());
    let region = window.model().inspection.region.expect("a rectangle was drawn");
    for axis in [0, 1] {
        let ends = BTreeSet::from([region.first[axis], region.last[axis]]);
        assert_eq!(ends, BTreeSet::from([a[axis], b[axis]]), "{what}: {region:?} from {a:?} to {b:?}");
    }
    if display.projection == Projection::Flat {
        let row = from[0].min(to[0])..=from[0].max(to[0]);
        let columns: BTreeSet<usize> =
            row.filter_map(|x| shown(&before, [x, from[1]]).map(|texel| texel[0])).collect();
        assert_eq!(along(region, 0), columns, "{what}: columns from {a:?} to {b:?}");
    }
    // In perspective, texels in front are larger than in the middle.
    let reach = (2.0 * magnification(window)) as u32 + 4;
    let after = picture(window);
    for corner in [from, to] {
        assert!(differs(&before, &after, corner, reach), "{what}: no outline near {corner:?}");
    }
}

#[needs(adapter)]
fn readout_pin_and_rectangle_are_of_the_texels_that_the_screen_shows() {
    let folder = tempfile::tempdir().unwrap();
    let numbered = numbered(folder.path());
    let predictions = numbered.ground_truth.iter().cloned().collect();
    let mut random = ChaCha8Rng::seed_from_u64(46);
    for scale in [1.0, 1.25, 2.0] {
        let predictions = Vec::clone(&predictions);
        let mut window = scaled_window(ViewerOptions { predictions, ..numbered.clone() }, scale);
        (0..VIEWS).for_each(|_| check_view(&mut window, scale, &mut random));
    }
}

#[needs(adapter)]
fn numbers_are_drawn_on_texels_of_more_than_48_pixels() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = window(numbered(folder.path()));
    window.state_mut().parts.model.view.display.quantity = Quantity::Diffuse;
    window.run_steps(2);
    let rect = pane(&window, &format!("MATERIAL  {}", window.names()[0]));
    hover(&mut window, Pos2::ZERO);
    for (side, has_numbers) in [(30.0, false), (44.0, false), (52.0, true), (90.0, true)] {
        let centre = SIZE.map(|side| side as f32 / 2.0);
        window.state_mut().parts.model.view.display.framing =
            Some(Framing { pixels_per_texel: side, centre });
        window.run_steps(3);
        // The middle of the pane is a corner of four texels: most of the one to the right of and below it.
        let texel =
            egui::Rect::from_center_size(rect.center() + vec2(side, side) / 2.0, vec2(side, side) * 0.8);
        let picture = pixels(&mut window, texel);
        let first = picture.get_pixel(0, 0);
        let ink = picture.pixels().filter(|pixel| *pixel != first).count();
        assert_eq!(ink > 40, has_numbers, "{side} pixels: {ink} of them have another colour");
        assert!(has_numbers || ink == 0, "{side} pixels: {ink}");
    }
}

#[needs(adapter)]
fn the_key_pins_a_texel_whose_numbers_are_in_the_drawer_and_again_removes_it() {
    let mut window = built_in();
    let rect = pane(&window, GROUND_TRUTH);
    hover(&mut window, rect.min + rect.size() * vec2(0.3, 0.4));
    let first = texel_read(&window).unwrap();
    press(&mut window, egui::Key::I);
    window.get_by_label(&format!("1: {},{}", first[0], first[1]));
    let rough = window.materials().nth(2).unwrap();
    let rough = rough.texel(first[1] * rough.width() + first[0]).roughness;
    assert!(has(&window, &format!("{rough:6.3}")));
    // The drawer has taken its room from the pane, and the material is fitted anew.
    let smaller = pane(&window, GROUND_TRUTH);
    let from_middle = vec2(first[0] as f32 - 127.5, first[1] as f32 - 127.5);
    hover(&mut window, smaller.center() + fitted_scale(smaller, [256, 256]) * from_middle);
    assert_eq!(texel_read(&window), Some(first));
    press(&mut window, egui::Key::I);
    assert!(window.query_by_label("Pinned texels").is_none());
}

/// The status line, the numbers on texels and pins tell of one texel the same, in every convention and from every side.
#[needs(adapter)]
fn the_status_line_and_a_pin_have_the_same_numbers() {
    let mut window = built_in();
    let mut random = ChaCha8Rng::seed_from_u64(7);
    for named in svbrdf_core::model::named_conventions::all() {
        let Ok(convention) = Convention::try_from(named) else { continue };
        edit(&mut window, |model| model.use_convention(convention.into()));
        let has_log = convention.norm() == PRINTED.norm();
        for _ in 0..6 {
            let texel = [below(&mut random, 256), below(&mut random, 256)];
            let view = [unit(&mut random) - 0.5, unit(&mut random) - 0.5, 1.5].map(f64::from);
            edit(&mut window, |model| {
                model.view.scene.view = view;
                model.view.display.difference = false;
            });
            let displayed = window.state().parts.displayed();
            let (scene, named) = (window.scene(), convention.name);
            let pinned = inspection::rows(window.materials(), texel, &scene, &convention);
            for (index, pin) in pinned.iter().enumerate() {
                let told = svbrdf_viewer::pane::numbers(&displayed, index, false, texel);
                for (told, pin) in told.iter().zip(pin.terms.radiance) {
                    assert!(
                        (told - pin).abs() <= 1e-4 * pin.abs().max(1e-4),
                        "{named} {texel:?}: {told} {pin}"
                    );
                }
                let told = svbrdf_viewer::pane::numbers(&displayed, index, true, texel);
                let Some([_, pin]) = pin.errors.filter(|_| has_log) else { continue };
                assert!(
                    (told[0] - pin).abs() <= 1e-3 * pin.max(1e-3),
                    "{named} {texel:?}: {} {pin}",
                    told[0]
                );
            }
        }
    }
}

#[needs(adapter)]
fn a_click_within_one_frame_pins_and_moves_the_light_as_a_longer_one() {
    let mut window = built_in();
    let rect = pane(&window, GROUND_TRUTH);
    let at = rect.min + rect.size() * vec2(0.3, 0.4);
    hover(&mut window, at);
    let [column, row] = texel_read(&window).unwrap();
    let click = |window: &mut Window<'_>, modifiers| {
        let button = egui::PointerButton::Primary;
        for pressed in [true, false] {
            let event = egui::Event::PointerButton { pos: at, button, pressed, modifiers };
            window.input_mut().events.push(event);
        }
        window.run_steps(3);
    };
    let before = window.scene();
    held(&mut window, Modifiers::ALT);
    window.run_steps(1);
    click(&mut window, Modifiers::ALT);
    held(&mut window, Modifiers::NONE);
    window.run_steps(8);
    window.get_by_label(&format!("1: {column},{row}"));
    assert_eq!(window.scene(), before, "it moves no light");
    click(&mut window, Modifiers::NONE);
    assert_ne!(window.scene().light, before.light);
}

#[needs(adapter)]
fn a_rectangle_is_drawn_by_q_anywhere_and_by_shift_on_maps_and_escape_removes_it() {
    let mut window = built_in();
    let rect = pane(&window, GROUND_TRUTH);
    let before = window.view().clone();
    press(&mut window, egui::Key::Q);
    drag_primary(&mut window, rect, vec2(0.3, 0.3), vec2(0.6, 0.5));
    assert_eq!(*window.view(), before, "light and view stay");
    let drawn = |window: &Window<'_>| window.model().inspection.region;
    assert!(drawn(&window).is_some());
    press(&mut window, egui::Key::Escape);
    assert_eq!(drawn(&window), None);
    press(&mut window, egui::Key::M);
    let rect = pane(&window, GROUND_TRUTH);
    held(&mut window, Modifiers::SHIFT);
    drag_primary(&mut window, rect, vec2(0.3, 0.3), vec2(0.6, 0.5));
    held(&mut window, Modifiers::NONE);
    assert!(drawn(&window).is_some());
    assert_eq!(window.view().display.framing, None, "it does not pan");
}
