//! Gestures of the mouse in a pane.

use super::*;

#[needs(adapter)]
fn dragging_the_light_puts_it_where_it_goes_and_changes_the_rendering() {
    let mut window = built_in();
    let rect = pane(&window, GROUND_TRUTH);
    let before = pixels(&mut window, rect);
    drag_primary(&mut window, rect, vec2(0.7, 0.3), vec2(0.3, 0.7));
    // From the middle of the pane, in halves of the shorter side of the material.
    let expected = rect.size() * vec2(-0.2, -0.2) * 1.03 * 2.0 / rect.size().min_elem();
    let [x, y, z] = window.scene().light;
    let off = (x as f32 - expected.x).abs().max((y as f32 - expected.y).abs());
    assert!(off < 0.02 && z == 1.2, "the light is at {x}, {y}, {z}, not at {expected:?}");
    assert!(pixels(&mut window, rect) != before, "another rendering");
}

#[needs(adapter)]
fn a_right_drag_moves_the_view_and_a_middle_drag_pans() {
    let mut window = built_in();
    let rect = pane(&window, GROUND_TRUTH);
    let before = window.view().clone();
    drag(&mut window, egui::PointerButton::Secondary, rect, vec2(0.5, 0.5), vec2(0.6, 0.4));
    let moved = window.view().clone();
    assert!(moved.scene.view[0] > 0.1 && moved.scene.view[1] > 0.1, "{:?}", moved.scene);
    assert_eq!(moved.scene.light, before.scene.light);
    drag(&mut window, egui::PointerButton::Middle, rect, vec2(0.5, 0.5), vec2(0.6, 0.4));
    let panned = window.view().clone();
    assert_eq!(panned.scene, moved.scene);
    assert_panned(&window, rect, [0.1, -0.1]);
    // On a map, the left button pans, too.
    press(&mut window, egui::Key::F);
    press(&mut window, egui::Key::M);
    drag_primary(&mut window, rect, vec2(0.5, 0.5), vec2(0.6, 0.4));
    assert_eq!(window.scene(), panned.scene);
    assert_panned(&window, rect, [0.1, -0.1]);
}

#[needs(adapter)]
fn the_wheel_zooms_at_the_pointer_and_with_shift_raises_the_light() {
    let mut window = built_in();
    let at = pane(&window, GROUND_TRUTH).center();
    let turn = |window: &mut Window<'_>, modifiers| {
        window.event(egui::Event::PointerMoved(at));
        window.event(wheel(vec2(0.0, 1.0), egui::MouseWheelUnit::Line, modifiers));
        window.run_steps(4);
        window.scene()
    };
    assert_eq!(turn(&mut window, Modifiers::NONE).light[2], 1.2);
    let fitted = fitted_scale(pane(&window, GROUND_TRUTH), [256, 256]);
    let framing = window.view().display.framing.unwrap();
    assert!(framing.pixels_per_texel > 1.1 * fitted, "{framing:?}, fitted {fitted}");
    let raised = turn(&mut window, Modifiers::SHIFT);
    assert!(raised.light[2] > 1.3, "{raised:?}");
    let raised = turn(&mut window, Modifiers::ALT);
    assert!(raised.view[2] > 2.7, "{raised:?}");
}

#[needs(adapter)]
fn movements_before_the_press_are_no_part_of_a_drag() {
    let mut window = built_in();
    press(&mut window, egui::Key::P);
    let rect = pane(&window, GROUND_TRUTH);
    hover(&mut window, rect.right_bottom());
    let before = window.scene();
    // All within one frame, as where frames are slow.
    let at = rect.center();
    let button = |pressed| pointer(at, egui::PointerButton::Secondary, pressed);
    window.input_mut().events.extend([egui::Event::PointerMoved(at), button(true)]);
    window.run_steps(2);
    hover(&mut window, at + vec2(0.0, 10.0));
    window.event(button(false));
    window.run_steps(2);
    let view = window.scene().view;
    let turned = (view[1] / before.view[2]).asin().abs();
    assert!((0.05..0.12).contains(&turned), "10 points turn the view by 0.08, not by {turned}");
}

#[needs(adapter)]
fn what_a_drag_changes_is_in_the_frame_that_read_it() {
    let mut window = built_in();
    let [rect, other] = [GROUND_TRUTH, PREDICTIONS[0]].map(|title| pane(&window, title));
    let at = |share: f32| rect.min + rect.size() * share;
    hover(&mut window, at(0.7));
    window.event(primary(at(0.7), true));
    window.event(egui::Event::PointerMoved(at(0.6)));
    window.run_steps(8);
    let before = pixels(&mut window, other);
    window.event(egui::Event::PointerMoved(at(0.3)));
    window.step();
    assert!(pixels(&mut window, other) != before, "another pane has the new light after one frame");
}
