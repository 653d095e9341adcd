//! A panic in a frame: the window closes as at a normal exit, and what it was is reported.

use super::*;

/// A dropped file whose path nobody survives.
#[derive(Debug)]
struct Planted;

impl egui::DroppedFile for Planted {
    fn path(&self) -> &Path {
        panic!("a planted fault")
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        panic!("a planted fault")
    }
}

#[needs(adapter)]
#[test]
fn a_panic_in_a_frame_closes_the_window_draws_no_frame_again_and_stores_no_settings() {
    let stored = |window: &mut Window<'_>| {
        let mut memory = super::materials::Memory::default();
        eframe::App::save(window.state_mut(), &mut memory);
        ["settings", "recent"].map(|key| memory.0.contains_key(key))
    };
    let mut window = built_in();
    assert!(!window.state().has_crashed() && stored(&mut window) == [true, true]);
    window.input_mut().dropped_files.push(Arc::new(Planted));
    window.step();
    assert!(window.state().has_crashed());
    let commands = &window.output().viewport_output[&egui::ViewportId::ROOT].commands;
    assert!(commands.contains(&egui::ViewportCommand::Close), "{commands:?}");
    let exposure = window.state().parts.model.view.exposure_ev;
    window.key_press(egui::Key::E);
    window.step();
    assert_eq!(window.state().parts.model.view.exposure_ev, exposure, "no frame is drawn after it");
    assert_eq!(stored(&mut window), [false, true]);
}
