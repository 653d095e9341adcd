//! The texel under the pointer, pins and the rectangle.

use svbrdf_core::picture::quantity::Quantity;
use svbrdf_files::read::{Albedo, ReadOptions};
use svbrdf_files::session::window::Framing;
use svbrdf_files::source::MaterialSource;
use svbrdf_viewer::model::view::state::Projection;

use super::*;

/// Columns and rows of a material whose diffuse map encodes the texel's place.
pub(super) const SIZE: [u32; 2] = [48, 20];

/// A folder with maps of a material; red of the diffuse map counts columns, green counts rows.
pub(super) fn numbered(folder: &Path) -> ViewerOptions {
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
pub(super) fn texel_of([red, green, blue]: [u8; 3]) -> Option<[usize; 2]> {
    // The map is linear, the screen sRGB.
    let shown = |value: usize| (255.0 * crate::pictures::srgb(value as f64 / 255.0)).round() as u8;
    let find = |count: u32, step: usize, seen: u8| {
        (0..count as usize).find(|i| shown(step * i + 4).abs_diff(seen) <= 1)
    };
    let is_background = blue.abs_diff(shown(9)) > 1;
    if is_background { None } else { Some([find(SIZE[0], 5, red)?, find(SIZE[1], 12, green)?]) }
}

pub(super) fn zoom(window: &mut Window<'_>, at: Pos2, notches: f32) {
    hover(window, at);
    window.event(wheel(vec2(0.0, notches), egui::MouseWheelUnit::Line, Modifiers::NONE));
    window.run_steps(3);
}

/// The window on that material, which shows a quantity in one pane, and the folder of its maps.
fn opened<'a>(quantity: Quantity, scale: f32) -> (Window<'a>, egui::Rect, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let mut window = scaled_window(numbered(folder.path()), scale);
    window.state_mut().parts.model.view.display.quantity = quantity;
    window.run_steps(2);
    let rect = numbered_pane(&window);
    (window, rect, folder)
}

fn numbered_pane(window: &Window<'_>) -> egui::Rect {
    let names = window.state().names();
    let role = if names.len() == 1 { "MATERIAL" } else { "GROUND TRUTH" };
    pane(window, &format!("{role}  {}", names[0]))
}

fn held(window: &mut Window<'_>, modifiers: Modifiers) {
    window.event(egui::Event::ModifiersChanged(modifiers));
}

/// Compares the readout with the colour on the screen at many pixels; returns how many lay on the material.
fn check_readout(window: &mut Window<'_>, scale: f32, what: &str) -> usize {
    let rect = numbered_pane(window);
    hover(window, Pos2::ZERO);
    let picture = window.render().unwrap();
    let mut on_material = 0;
    for i in 0..16 {
        for j in 0..9 {
            let share = vec2((i as f32 + 0.37) / 16.0, (j as f32 + 0.53) / 9.0);
            // The middle of a pixel.
            let pixel = ((rect.min + rect.size() * share).to_vec2() * scale).floor();
            let colour = picture.get_pixel(pixel.x as u32, pixel.y as u32).0;
            hover(window, ((pixel + vec2(0.5, 0.5)) / scale).to_pos2());
            let expected = texel_of([colour[0], colour[1], colour[2]]);
            assert_eq!(texel_read(window), expected, "{what}: pixel {pixel:?} has the colour {colour:?}");
            on_material += usize::from(expected.is_some());
        }
    }
    on_material
}

#[needs(adapter)]
fn the_readout_names_the_texel_that_the_screen_shows_at_every_scale_zoom_and_projection() {
    for scale in [1.25, 2.0] {
        let (mut window, _, _folder) = opened(Quantity::Diffuse, scale);
        for projection in [Projection::Flat, Projection::Perspective] {
            window.state_mut().parts.model.view.display.projection = projection;
            window.state_mut().parts.model.view.scene.view = [0.7, -0.9, 2.0];
            window.run_steps(2);
            // Not so far that the numbers of texels are drawn on them.
            for (notches, corner) in [(0.0, [0.5, 0.5]), (5.0, [0.1, 0.15]), (5.0, [0.93, 0.9])] {
                press(&mut window, egui::Key::F);
                let rect = numbered_pane(&window);
                zoom(&mut window, rect.min + rect.size() * vec2(corner[0], corner[1]), notches);
                let what = format!("scale {scale}, {projection:?}, {notches} notches");
                assert!(check_readout(&mut window, scale, &what) > 20, "{what}: little of it is in sight");
            }
        }
    }
}

#[needs(adapter)]
fn numbers_are_drawn_on_texels_of_more_than_48_pixels() {
    let (mut window, rect, _folder) = opened(Quantity::Diffuse, 1.0);
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
    let rough = window.state().materials().nth(2).unwrap();
    let rough = rough.texel(first[1] * rough.width() + first[0]).roughness;
    assert!(has(&window, &format!("{rough:6.3}")));
    // The drawer has taken its room from the pane, and the material is fitted anew.
    let smaller = pane(&window, GROUND_TRUTH);
    let texel = smaller.size().min_elem() / 1.03 / 256.0;
    let from_middle = vec2(first[0] as f32 - 127.5, first[1] as f32 - 127.5);
    hover(&mut window, smaller.center() + texel * from_middle);
    assert_eq!(texel_read(&window), Some(first));
    press(&mut window, egui::Key::I);
    assert!(window.query_by_label("Pinned texels").is_none());
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
    let before = window.state().parts.model.view.scene;
    held(&mut window, Modifiers::ALT);
    window.run_steps(1);
    click(&mut window, Modifiers::ALT);
    held(&mut window, Modifiers::NONE);
    window.run_steps(8);
    window.get_by_label(&format!("1: {column},{row}"));
    assert_eq!(window.state().parts.model.view.scene, before, "it moves no light");
    click(&mut window, Modifiers::NONE);
    assert_ne!(window.state().parts.model.view.scene.light, before.light);
}

#[needs(adapter)]
fn a_rectangle_is_drawn_by_q_anywhere_and_by_shift_on_maps_and_escape_removes_it() {
    let mut window = built_in();
    let rect = pane(&window, GROUND_TRUTH);
    let before = window.state().parts.model.view.clone();
    press(&mut window, egui::Key::Q);
    drag_primary(&mut window, rect, vec2(0.3, 0.3), vec2(0.6, 0.5));
    assert_eq!(window.state().parts.model.view, before, "light and view stay");
    let drawn = |window: &Window<'_>| window.state().parts.model.inspection.region;
    assert!(drawn(&window).is_some());
    press(&mut window, egui::Key::Escape);
    assert_eq!(drawn(&window), None);
    press(&mut window, egui::Key::M);
    let rect = pane(&window, GROUND_TRUTH);
    held(&mut window, Modifiers::SHIFT);
    drag_primary(&mut window, rect, vec2(0.3, 0.3), vec2(0.6, 0.5));
    held(&mut window, Modifiers::NONE);
    assert!(drawn(&window).is_some());
    assert_eq!(window.state().parts.model.view.display.framing, None, "it does not pan");
}
