//! The corners of the material in a photograph, dragged by their handles.

use svbrdf_core::picture::quantity::Quantity;
use svbrdf_evaluate::photograph::flash;
use svbrdf_files::photograph::{Corners, SessionPhotograph};
use svbrdf_viewer::model::command::{DisplayCommand, PhotographCommand};
use svbrdf_viewer::model::view::state::Layout;

use super::photograph::{CORNERS, FOV, SIZE, agrees, expected_of, opened, source};
use super::*;

const TITLE: &str = "PHOTOGRAPH  photo.npy  as it was taken";

/// Opens the section of the corners, by which the photograph is shown as it was taken.
fn edit(window: &mut Window<'_>) {
    click(window, "Corners of the material");
    window.run_steps(8);
    window.get_by_label(&format!("Title {TITLE}"));
}

fn handle(window: &Window<'_>, name: &str) -> egui::Rect {
    window.get_by_label(&format!("{name} corner")).rect()
}

fn corners(window: &Window<'_>) -> [[f64; 2]; 4] {
    window.state().photograph_corners().unwrap()
}

/// Points per pixel of the photograph on the screen.
fn scale(window: &Window<'_>) -> f64 {
    let [left, right] = ["Top left", "Top right"].map(|name| handle(window, name).center().x);
    let [[a, _], [b, _], ..] = corners(window);
    f64::from(right - left) / (b - a)
}

/// Drags from a point of the window by `by`, in points.
fn drag_by(window: &mut Window<'_>, from: Pos2, by: Vec2) {
    let screen = egui::Rect::from_min_size(Pos2::ZERO, vec2(1.0, 1.0));
    drag_primary(window, screen, from.to_vec2(), from.to_vec2() + by);
}

fn is_near(found: [[f64; 2]; 4], expected: [[f64; 2]; 4]) -> bool {
    found.as_flattened().iter().zip(expected.as_flattened()).all(|(a, b)| (a - b).abs() < 0.05)
}

#[needs(adapter)]
#[test]
fn a_dragged_handle_moves_its_corner_and_undo_brings_it_back() {
    let (mut window, folder) = opened();
    edit(&mut window);
    let before = handle(&window, "Top left");
    assert!(before.width() >= 24.0 && before.height() >= 24.0, "{before:?}");
    let scale = scale(&window);

    // A press beside the middle of the handle grabs it, and the corner does not jump there.
    let by = vec2(31.0, 22.0);
    drag_by(&mut window, before.center() + vec2(-9.0, 8.0), by);
    let mut expected = CORNERS;
    expected[0] = [20.0 + f64::from(by.x) / scale, 10.0 + f64::from(by.y) / scale];
    let moved = corners(&window);
    assert!(is_near(moved, expected), "{moved:?}, expected {expected:?}");
    assert_eq!(moved[1..], CORNERS[1..], "the others stay");
    let moved_source =
        SessionPhotograph { corners: Some(Corners(moved)), ..source(&folder.path().join("photo.npy")) };
    let core = expected_of(&moved_source, &flash(FOV).unwrap());
    wait(&mut window, "the comparison", |app| {
        app.against_photograph().is_some_and(|all| all[0].factor == core[0].factor)
    });
    assert!(agrees(&window, &core));

    // A press and a move within one frame, as on a slow adapter.
    let at = handle(&window, "Top right").center();
    let by = vec2(-24.0, 18.0);
    let events = [egui::Event::PointerMoved(at), primary(at, true), egui::Event::PointerMoved(at + by)];
    window.input_mut().events.extend(events);
    window.run_steps(3);
    window.event(primary(at + by, false));
    window.run_steps(3);
    let at_once = corners(&window);
    let expected = [276.0 + f64::from(by.x) / scale, 10.0 + f64::from(by.y) / scale];
    assert!(at_once[1].iter().zip(expected).all(|(a, b)| (a - b).abs() < 0.05), "{at_once:?}");
    assert_eq!((at_once[0], &at_once[2..]), (moved[0], &moved[2..]));

    // It stays in the picture.
    let at = handle(&window, "Bottom right").center();
    drag_by(&mut window, at, vec2(400.0, 300.0));
    assert_eq!(corners(&window)[2], SIZE.map(|side| side as f64));
    // The middle of the edge from the top right to the bottom left is as far as the top left corner gets.
    let at = handle(&window, "Top left").center();
    let target = handle(&window, "Bottom right").center();
    drag_by(&mut window, at, target - at);
    assert!(Corners(corners(&window)).check(SIZE).is_ok(), "{:?}", corners(&window));
    assert!(window.state().messages().is_empty(), "{:?}", window.state().messages());

    apply(&mut window, PhotographCommand::SetCorners(Some(Corners(moved))));
    window.run_steps(30);
    let at = handle(&window, "Bottom left").center();
    drag_by(&mut window, at, vec2(20.0, -30.0));
    assert_ne!(corners(&window), moved);
    window.run_steps(30);
    apply(&mut window, DisplayCommand::Undo);
    assert_eq!(corners(&window), moved);
    apply(&mut window, DisplayCommand::Redo);
    assert_ne!(corners(&window), moved);
    // Undo also opens the photograph again.
    window.run_steps(30);
    apply(&mut window, PhotographCommand::Close);
    window.run_steps(30);
    assert!(window.state().photograph_corners().is_none());
    apply(&mut window, DisplayCommand::Undo);
    wait(&mut window, "the photograph", |app| app.against_photograph().is_some());
}

#[needs(adapter)]
#[test]
fn the_whole_photograph_is_shown_in_every_layout_until_the_corners_are_done() {
    let (mut window, _folder) = opened();
    edit(&mut window);
    for layout in Layout::ALL {
        apply(&mut window, DisplayCommand::SetLayout(layout));
        window.run_steps(6);
        let rect = window.get_by_label("Corner pane").rect();
        hover(&mut window, rect.left_top() + vec2(3.0, 3.0));
        window.run_steps(4);
        assert_eq!(texel_read(&window), None, "there are no texels in it");
        let seen = pixels(&mut window, rect);
        let at = |[x, y]: [f64; 2]| {
            let scale = scale(&window);
            let origin = handle(&window, "Top left").center() - rect.min.floor();
            let [dx, dy] = [(x - CORNERS[0][0]) * scale, (y - CORNERS[0][1]) * scale];
            seen.get_pixel((f64::from(origin.x) + dx) as u32, (f64::from(origin.y) + dy) as u32).0
        };
        // The frame is the brightest of the photograph, and the material is darker.
        assert_eq!(at([150.0, 274.0])[..3], [255; 3], "{layout:?}");
        assert_eq!(at([290.0, 140.0])[..3], [255; 3], "{layout:?}");
        assert!(at([148.0, 138.0])[..3] != [255; 3], "{layout:?}");
    }
    press(&mut window, egui::Key::Escape);
    window.run_steps(12);
    assert!(window.query_by_label("Corner pane").is_none());
    assert!(window.query_by_label("Top left corner").is_none());
    assert!(!has(&window, "as it was taken"));
    // A saved picture of the view has the photograph as it is compared.
    assert_eq!(corners(&window), CORNERS, "nothing has moved");

    // From a map, it goes to renderings, which are compared with the photograph.
    press(&mut window, egui::Key::M);
    edit(&mut window);
    assert_eq!(window.state().parts.model.view.display.quantity, Quantity::Rendering);
}
