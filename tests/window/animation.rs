//! Animation of light and view.

use super::*;

#[needs(adapter)]
#[test]
fn the_turntable_turns_the_view_until_space_pauses_it() {
    let mut window = built_in();
    let before = window.state().parts.model.view.scene;
    more(&mut window);
    let place = window.get_by_label("Turntable").rect();
    click(&mut window, "Turntable");
    assert_eq!(window.get_by_label("Turntable").rect(), place, "a second click stops it");
    let first = window.state().parts.model.view.scene;
    window.run_steps(4);
    let second = window.state().parts.model.view.scene;
    assert!(first.view != before.view && second.view != first.view, "{first:?}, {second:?}");
    assert_eq!(second.view[2], before.view[2], "the height stays");
    assert_eq!(second.light, before.light, "the light stays");
    press(&mut window, egui::Key::Space);
    let paused = window.state().parts.model.view.scene;
    window.run_steps(6);
    assert_eq!(window.state().parts.model.view.scene, paused);
    click(&mut window, "Resume");
    assert!(window.state().parts.model.view.scene.view != paused.view);
    click(&mut window, "Turntable");
    let stopped = window.state().parts.model.view.scene;
    window.run_steps(4);
    assert_eq!(window.state().parts.model.view.scene, stopped);
}
