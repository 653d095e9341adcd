//! Windows of every size at every scale of text and controls: none crashes.

use super::*;

/// Scales of text and controls.
const SCALES: [f32; 6] = [0.75, 1.0, 1.5, 2.0, 3.0, 4.0];
/// Sizes in pixels that every state is shown at, each at the least and the greatest scale.
const SMALL: [[f32; 2]; 4] = [[10.0, 10.0], [10.0, 900.0], [1400.0, 10.0], [640.0, 420.0]];
/// Random sizes of every state.
const RANDOM: usize = 4;

/// Shows the window at a size in pixels and a scale.
fn resize(window: &mut Window<'_>, [width, height]: [f32; 2], scale: f32) {
    window.ctx.set_zoom_factor(scale);
    // In its first frame a new scale comes with the old size.
    window.step();
    let size = vec2(width, height) / scale;
    window.set_size(size);
    window.run_steps(3);
    let found = window.ctx.content_rect().size();
    assert!((found - size).length() < 1.0, "{found:?}, expected {size:?}");
}

/// Shows the window at all sizes and scales of the test.
fn check(window: &mut Window<'_>, state: &str) {
    let mut random = ChaCha8Rng::seed_from_u64(17);
    let mut side = || {
        let most = [90, 1300][below(&mut random, 2)];
        10.0 + below(&mut random, most) as f32
    };
    let random = SCALES[..RANDOM].iter().map(|scale| ([side(), side()], *scale));
    let small = SMALL.into_iter().flat_map(|size| [(size, SCALES[0]), (size, SCALES[SCALES.len() - 1])]);
    let all = small.chain(random.collect::<Vec<_>>());
    for (number, (size, scale)) in all.enumerate() {
        resize(window, size, scale);
        assert!(!window.state().has_crashed(), "{state}: {size:?} pixels at a scale of {scale}");
        if number % 4 == 0 {
            window.render().unwrap();
        }
    }
    resize(window, [1200.0, 800.0], 1.0);
    assert!(window.names().len() > 1, "{state}: its materials are still there");
}

#[needs(adapter)]
fn panes_are_drawn_at_every_size_and_scale() {
    let mut window = built_in();
    check(&mut window, "a start");
    let inspection = &mut window.state_mut().parts.model.inspection;
    inspection.pins = vec![[0, 0], [255, 255]];
    inspection.region = Some(Region { first: [100, 20], last: [180, 90] });
    window.run_steps(4);
    for layout in [Layout::SideBySide, Layout::Wipe, Layout::Single] {
        for projection in [Projection::Flat, Projection::Perspective] {
            let display = &mut window.state_mut().parts.model.view.display;
            (display.layout, display.projection) = (layout, projection);
            display.difference = projection == Projection::Perspective;
            check(&mut window, &format!("{layout:?}, {projection:?}"));
        }
    }
    window.state_mut().parts.model.settings.side_panel = false;
    check(&mut window, "no panel");
}

#[needs(adapter)]
fn the_last_button_of_the_bar_is_there_in_every_width() {
    let mut window = built_in();
    for width in [500.0, 640.0, 700.0, 760.0, 900.0, 1060.0] {
        resize(&mut window, [width, 500.0], 1.0);
        click(&mut window, "Help");
        assert!(window.model().help, "{width} points");
        press(&mut window, egui::Key::Escape);
        assert!(!window.model().help);
    }
}

#[needs(adapter)]
fn tabs_are_drawn_at_every_size_and_scale() {
    let mut window = built_in();
    wait(&mut window, "the loss", |app| app.losses().is_some());
    for tab in [Tab::Loss, Tab::Files, Tab::Why] {
        window.state_mut().parts.model.settings.tab = tab;
        window.run_steps(4);
        if tab == Tab::Why {
            wait(&mut window, "the scenes", |app| app.listed_scenes().is_some());
        }
        // Narrow windows have no side panel until it is asked for.
        resize(&mut window, [700.0, 500.0], 1.0);
        if !window.model().side_panel() {
            press(&mut window, egui::Key::B);
        }
        check(&mut window, &format!("{tab:?}"));
    }
}

#[needs(adapter)]
fn dialogs_messages_and_photographs_are_drawn_at_every_size_and_scale() {
    let mut window = built_in();
    for opened in ["Open", "Save", "Menu", "Help"] {
        click(&mut window, opened);
        check(&mut window, opened);
        press(&mut window, egui::Key::Escape);
    }
    for number in 0..4 {
        let path = format!("no/such/{}/material {number}.png", "folder".repeat(20));
        drop_files(&mut window, [path.into()]);
        window.run_steps(2);
    }
    wait(&mut window, "the messages", |app| !app.is_reading() && app.messages().len() > 1);
    check(&mut window, "messages");
    let (mut window, _folder) = super::photograph::opened();
    check(&mut window, "a photograph");
}

#[needs(adapter)]
fn ctrl_and_plus_keep_the_scale_within_its_range_and_ctrl_0_magnifies() {
    let mut window = built_in();
    for (key, expected) in [(egui::Key::Plus, 4.0), (egui::Key::Minus, 0.75)] {
        for _ in 0..60 {
            window.key_press_modifiers(Modifiers::COMMAND, key);
            window.step();
        }
        window.run_steps(3);
        assert_eq!([window.ctx.zoom_factor(), window.model().settings.ui_scale], [expected; 2]);
    }
    press_with(&mut window, Modifiers::COMMAND, egui::Key::Num0);
    assert_eq!(window.model().settings.ui_scale, 0.75);
    assert_eq!(window.view().display.framing.unwrap().pixels_per_texel, 1.0);
}
