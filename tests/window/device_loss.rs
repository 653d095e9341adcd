//! Loss of the graphics device: everything goes on in a new window on another device.

use svbrdf_viewer::model::command::DisplayCommand;

use super::*;

/// Of windows so high that the message of the loss covers neither of the panes that are compared, in points.
const SIZE: egui::Vec2 = vec2(1200.0, 1100.0);

/// The application in a window with a device of its own, after the device of the last one was lost.
fn resumed<'a>(last: Window<'a>) -> Window<'a> {
    let mut app = last.into_state();
    let mut window =
        Harness::builder().with_size(SIZE).with_max_steps(16).with_step_dt(1.0 / 30.0).wgpu().build_eframe(
            |cc| {
                app.resume(cc);
                app
            },
        );
    window.set_render_cursor(false);
    window
}

/// Loses the device, as a fault of the driver does.
fn lose(window: &mut Window<'_>) {
    window.state().parts.gpu.as_ref().unwrap().gpu.lose();
    window.step();
    assert!(window.state().loss().is_some() && !window.state().has_crashed());
    let output = window.output();
    assert!(output.shapes.is_empty(), "nothing is drawn on a lost device");
    let commands = &output.viewport_output[&egui::ViewportId::ROOT].commands;
    assert!(commands.contains(&egui::ViewportCommand::Close), "{commands:?}");
}

/// The pixels of the panes of the ground truth and of a difference at rest, with no pointer over them.
fn still(window: &mut Window<'_>) -> [image::RgbaImage; 2] {
    window.event(egui::Event::PointerGone);
    statistics(window);
    window.run_steps(12);
    [GROUND_TRUTH, PREDICTIONS[0]].map(|title| {
        let rect = pane(window, title);
        pixels(window, rect)
    })
}

/// What a person would miss: view with light, pins, materials and messages but that of the loss.
fn state(window: &Window<'_>) -> String {
    let model = &window.state().parts.model;
    let pins = &model.inspection.pins;
    format!("{:?} {pins:?} {:?} {:?}", model.view, window.state().names(), model.settings)
}

#[needs(adapter)]
#[test]
fn a_device_that_is_lost_in_a_drag_again_and_again_loses_nothing_else() {
    const LOSSES: usize = 8;
    let mut window = built_in();
    window.set_size(SIZE);
    press(&mut window, egui::Key::D);
    let rect = pane(&window, GROUND_TRUTH);
    hover(&mut window, rect.center());
    press(&mut window, egui::Key::I);
    assert_eq!(window.state().parts.model.inspection.pins.len(), 1, "a pin");
    for loss in 0..LOSSES {
        let compares_pixels = loss % (LOSSES / 4) == 0;
        let at = rect.center() + vec2(-80.0 + 1.5 * loss as f32, 40.0);
        window.event(egui::Event::PointerMoved(rect.center()));
        window.event(primary(rect.center(), true));
        window.event(egui::Event::PointerMoved(at));
        window.run_steps(3);
        // The crosshair of the pointer is not drawn in a drag, which the new window does not continue.
        let before = compares_pixels.then(|| {
            window.event(primary(at, false));
            still(&mut window)
        });
        let expected = state(&window);
        lose(&mut window);
        window = resumed(window);
        window.event(egui::Event::PointerMoved(at));
        wait(&mut window, "the materials to be sent", |app| {
            let materials = &app.parts.model.materials.all;
            materials.iter().all(|one| app.parts.jobs.uploads.get(one.id()).is_some())
        });
        assert_eq!(state(&window), expected, "loss {loss}");
        if let Some(before) = before {
            assert!(still(&mut window) == before, "loss {loss}: other pixels");
        }
    }
    let messages = window.state().messages();
    assert_eq!(messages.len(), 1, "one line for all of them: {messages:?}");
    assert!(messages[0].starts_with("The graphics device was lost ("), "{messages:?}");
    let moved = window.state().parts.model.view.scene.light;
    window.run_steps(30);
    apply(&mut window, DisplayCommand::Undo);
    assert_ne!(window.state().parts.model.view.scene.light, moved, "undo goes back beyond the losses");
}
