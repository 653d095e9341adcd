//! The tab *Why*: maps, scenes, and the loss while the light moves.

mod diagnosis;
mod maps;
mod scenes;

use svbrdf_core::loss::{Sampling, Texels};
use svbrdf_core::model::sampler::Sampler;

use super::*;

/// The scenes of the loss to 1% that are listed and averaged.
const SAMPLING: Sampling =
    Sampling { near: 128, distant: 64, seed: 0, sampler: Sampler::Sobol, texels: Texels::All };

/// The built-in pair with the tab open, in a window that shows all of it but the diagnosis, which is folded.
fn opened<'a>() -> Window<'a> {
    let mut window = built_in();
    window.set_size(vec2(1200.0, 1800.0));
    window.run_steps(4);
    tab(&mut window, "Why");
    click(&mut window, "Would something trivial explain it?");
    window.run_steps(8);
    window
}

fn wait_for_scene_losses(window: &mut Window<'_>) -> Vec<f64> {
    wait(window, "the losses in this scene", |app| app.scene_losses().is_some_and(|(_, current)| current));
    window.scene_losses().unwrap().0.to_vec()
}

#[needs(adapter)]
fn the_losses_of_the_scene_follow_the_light_while_it_is_dragged() {
    let mut window = opened();
    let before = wait_for_scene_losses(&mut window);
    assert_eq!(before, [1, 2].map(|prediction| loss_in(window.scene(), prediction)));
    assert!(before.iter().all(|loss| has(&window, &format!("{loss:.4}"))), "{before:?}");
    let rect = pane(&window, GROUND_TRUTH);
    let at = |share: f32| rect.min + rect.size() * vec2(0.2 + 0.6 * share, 0.4);
    window.event(egui::Event::PointerMoved(at(0.0)));
    window.event(primary(at(0.0), true));
    let mut seen = vec![before];
    for step in 0..2000 {
        window.event(egui::Event::PointerMoved(at((step % 500) as f32 / 500.0)));
        window.step();
        let latest = window.scene_losses().map(|(losses, _)| losses.to_vec());
        seen.extend(latest.filter(|latest| seen.last() != Some(latest)));
        if seen.len() > 10 {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    assert!(seen.len() > 10, "{} losses were seen with the button down", seen.len());
    window.event(primary(at(0.5), false));
    window.run_steps(2);
    let after = wait_for_scene_losses(&mut window);
    assert_eq!(after[0], loss_in(window.scene(), 1));
}

#[needs(adapter)]
fn a_folded_section_and_a_hidden_tab_compute_nothing() {
    let mut window = built_in();
    window.set_size(vec2(1200.0, 1800.0));
    let nothing = |window: &Window<'_>| {
        let app = window.state();
        app.diagnosis().is_none() && app.attribution().is_none() && app.listed_scenes().is_none()
    };
    rest(&mut window, 60);
    assert!(nothing(&window), "the tab of the loss is open");
    tab(&mut window, "Why");
    click(&mut window, "Which map");
    click(&mut window, "Would something trivial explain it?");
    wait(&mut window, "the scenes", |app| app.listed_scenes().is_some());
    rest(&mut window, 60);
    assert!(window.attribution().is_none(), "its section is folded");
    assert!(window.diagnosis().is_none(), "its section is folded");
    click(&mut window, "Which map");
    wait(&mut window, "the attribution", |app| app.attribution().is_some());
}

/// Results come while a hand is on its way to a control. The diagnosis is folded: how many lines it marks is known afterwards only.
#[needs(adapter)]
fn the_controls_of_why_stay_where_they_are_while_results_come() {
    let mut window = opened();
    let controls = |window: &Window<'_>| {
        ["Which map", "Which scenes", "Save scenes...", "Other metrics"]
            .map(|name| window.get_by_label(name).rect())
            .to_vec()
    };
    let search = |window: &Window<'_>| window.get_by_label("Find worst scene").rect();
    let before = (controls(&window), search(&window));
    for prediction in [egui::Key::Num1, egui::Key::Num2] {
        window.key_press(prediction);
        wait_in(&mut window, "the results", |window| {
            assert_eq!((controls(window), search(window)), before, "{prediction:?}");
            let listed = window.listed_scenes().is_some_and(|(_, thumbnails)| !thumbnails.is_empty());
            listed && window.attribution().is_some()
        });
    }
    window.get_by_label("Find worst scene").click();
    window.run_steps(2);
    wait_in(&mut window, "the worst scene", |window| {
        assert_eq!(controls(window), before.0, "while it searches");
        window.worst().is_some()
    });
    window.run_steps(2);
    assert_eq!((controls(&window), search(&window)), before, "with the worst scene");
}
