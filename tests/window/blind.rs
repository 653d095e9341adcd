//! A blind comparison in the window.

use super::*;

/// Begins to compare the first prediction with another material.
fn begin(window: &mut Window<'_>, other: &str) {
    ["Menu", "Compare blind", other].into_iter().for_each(|label| click(window, label));
}

/// All that assistive software is told: names and values, those of the window and of tooltips among them.
fn texts(window: &Window<'_>) -> Vec<String> {
    let all = std::iter::once(window.root()).chain(window.query_all_by(|_| true));
    all.flat_map(|node| [node.accesskit_node().label(), node.value()]).flatten().collect()
}

#[needs(adapter)]
fn who_compares_pixels_is_right_in_every_trial_and_no_text_has_a_name_before_the_end() {
    let mut window = built_in();
    wait(&mut window, "the losses", |app| app.losses().is_some());
    begin(&mut window, "2  wrong roughness");
    let mut answers = Vec::new();
    for trial in 1..=20 {
        window.get_by_label(&format!("Trial {trial} of 20: which is X?"));
        let [a, x, b] = ["A", "X", "B"].map(|name| pane(&window, name));
        // Over a pane, and over its title.
        for at in [x.center(), x.center_top() - vec2(0.0, 12.0)] {
            hover(&mut window, at);
            window.run_steps(20);
            let told = texts(&window);
            let names = ["blurred", "rough", "tiles", "ground", "truth", "loss", "texel", "0."];
            let leaks = |text: &&String| names.iter().any(|name| text.to_lowercase().contains(name));
            assert_eq!(told.iter().find(leaks), None);
            assert!(told.iter().any(|text| text == "Compare blind - svbrdf"), "{told:?}");
        }
        let picture = window.render().unwrap();
        let [a, x, b] = [a, x, b].map(|rect| {
            let [x, y, w, h] = [rect.left(), rect.top(), rect.width(), rect.height()].map(|v| v as u32);
            image::imageops::crop_imm(&picture, x, y, w, h).to_image()
        });
        assert!((x == a) != (x == b), "X is A or B");
        answers.push(x == b);
        press(&mut window, if x == a { egui::Key::A } else { egui::Key::B });
    }
    assert!(answers.contains(&true) && answers.contains(&false), "{answers:?}");
    window.get_by_label("20 of 20 right, p < 0.0001; 100%, 95% interval 83.2% to 100.0%");
    let is_there = |names: [&str; 2]| {
        names.iter().zip(["A", "B"]).all(|(name, is)| has(&window, &format!("Pane {is}: {name}")))
    };
    let [first, second] = ["blurred normals", "wrong roughness"];
    assert!(is_there([first, second]) != is_there([second, first]));
    press(&mut window, egui::Key::Escape);
    window.get_by_label(&format!("Pane {GROUND_TRUTH}"));
}

#[needs(adapter)]
fn whatever_was_shown_a_blind_comparison_has_three_panes_and_other_keys_do_nothing() {
    let mut window = built_in();
    edit(&mut window, |model| {
        (model.view.display.difference, model.view.display.layout, model.swapped) =
            (true, Layout::Wipe, true);
        model.view.isolate(Some(svbrdf_core::material::Map::Normal));
    });
    let before = window.model().clone();
    begin(&mut window, "GT  worn tiles");
    for key in [egui::Key::D, egui::Key::X, egui::Key::C, egui::Key::M, egui::Key::Num2, egui::Key::K] {
        press(&mut window, key);
    }
    window.key_down(egui::Key::G);
    window.run_steps(3);
    ["A", "X", "B"].into_iter().for_each(|name| assert!(pane(&window, name).width() > 300.0, "{name}"));
    window.key_up(egui::Key::G);
    click(&mut window, "X is A  (A)");
    press(&mut window, egui::Key::B);
    press(&mut window, egui::Key::Escape);
    see(&mut window, " of 2 right, p = ");
    click(&mut window, "Close  (Esc)");
    assert_eq!((window.view(), window.model().swapped), (&before.view, true));
    // Without an answer there is no result.
    begin(&mut window, "2  wrong roughness");
    press(&mut window, egui::Key::Escape);
    assert!(window.model().blind.is_none());
}
