//! The tab *Why*: maps, scenes, directions, and the loss while the light moves.

mod diagnosis;
mod directions;
mod error_map;
mod maps;
mod scenes;

use svbrdf_core::loss::Comparison;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;
use svbrdf_files::samples;

use super::*;

/// The built-in pair with the tab open, in a window that shows all of it but the diagnosis, which is folded.
fn opened<'a>() -> Window<'a> {
    let mut window = built_in();
    window.set_size(vec2(1200.0, 1800.0));
    window.run_steps(4);
    tab(&mut window, "Why");
    window.get_by_label("Would something trivial explain it?").click();
    window.run_steps(12);
    window
}

/// The built-in materials, the ground truth first.
fn materials() -> Vec<Material<f32>> {
    let samples = samples::load::<f32>().unwrap();
    [samples.ground_truth].into_iter().chain(samples.predictions).map(|read| read.material).collect()
}

/// The loss of a prediction in one scene, over all texels.
fn loss_in(scene: Scene, prediction: usize) -> f64 {
    let materials = materials();
    let comparison = Comparison::new(&materials[0], &[&materials[prediction]], PRINTED).unwrap();
    let request = svbrdf_core::loss::Request::Listed(vec![scene]);
    comparison.run(&request, &Progress::default()).unwrap().losses[0].estimate.mean
}

fn wait_for_scene_losses(window: &mut Window<'_>) -> Vec<f64> {
    wait(window, "the losses in this scene", |app| app.scene_losses().is_some_and(|(_, current)| current));
    window.state().scene_losses().unwrap().0.to_vec()
}

#[needs(adapter)]
#[test]
fn the_losses_of_the_scene_follow_the_light_while_it_is_dragged() {
    let mut window = opened();
    let before = wait_for_scene_losses(&mut window);
    assert_eq!(before, [1, 2].map(|prediction| loss_in(window.state().parts.model.view.scene, prediction)));
    let rect = pane(&window, GROUND_TRUTH);
    let at = |share: f32| rect.min + rect.size() * vec2(0.2 + 0.6 * share, 0.4);
    let button = |pos, pressed| egui::Event::PointerButton {
        pos,
        button: egui::PointerButton::Primary,
        pressed,
        modifiers: egui::Modifiers::NONE,
    };
    window.event(egui::Event::PointerMoved(at(0.0)));
    window.event(button(at(0.0), true));
    let mut seen = vec![before];
    let (start, mut frames) = (std::time::Instant::now(), 0);
    for step in 0..2000 {
        window.event(egui::Event::PointerMoved(at((step % 500) as f32 / 500.0)));
        window.step();
        frames += 1;
        let latest = window.state().scene_losses().map(|(losses, _)| losses.to_vec());
        seen.extend(latest.filter(|latest| seen.last() != Some(latest)));
        if seen.len() > 10 {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    println!("{} losses in {frames} frames, {:?}", seen.len() - 1, start.elapsed());
    assert!(seen.len() > 10, "{} losses were seen with the button down", seen.len());
    window.event(button(at(0.5), false));
    window.run_steps(2);
    let after = wait_for_scene_losses(&mut window);
    assert_eq!(after[0], loss_in(window.state().parts.model.view.scene, 1));
}

#[needs(adapter)]
#[test]
fn a_folded_section_and_a_hidden_tab_compute_nothing() {
    let mut window = built_in();
    window.set_size(vec2(1200.0, 1800.0));
    let nothing = |window: &Window<'_>| {
        let app = window.state();
        app.diagnosis().is_none()
            && app.attribution().is_none()
            && app.listed_scenes().is_none()
            && app.direction_map().is_none()
    };
    let rest = |window: &mut Window<'_>| {
        for _ in 0..60 {
            window.step();
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
    };
    rest(&mut window);
    assert!(nothing(&window), "the tab of the loss is open");
    tab(&mut window, "Why");
    window.get_by_label("Which map").click();
    window.get_by_label("Would something trivial explain it?").click();
    window.run_steps(4);
    wait(&mut window, "the scenes", |app| app.listed_scenes().is_some());
    wait(&mut window, "the directions", |app| app.direction_map().is_some());
    rest(&mut window);
    assert!(window.state().attribution().is_none(), "its section is folded");
    assert!(window.state().diagnosis().is_none(), "its section is folded");
    window.get_by_label("Which map").click();
    window.run_steps(4);
    wait(&mut window, "the attribution", |app| app.attribution().is_some());
}

/// Results come while a hand is on its way to a control. The diagnosis is folded: how many lines it marks is known afterwards only.
#[needs(adapter)]
#[test]
fn the_controls_of_why_stay_where_they_are_while_results_come() {
    let mut window = opened();
    let controls = |window: &Window<'_>| {
        ["Which map", "Which scenes", "Save scenes...", "Which light or view", "Over views"]
            .map(|name| window.get_by_label(name).rect())
            .to_vec()
    };
    let search = |window: &Window<'_>| window.get_by_label("Find worst scene").rect();
    // What is below the maps over directions and their legends.
    let below = |window: &Window<'_>| window.get_by_label_contains("distant scenes, view fixed at").rect();
    let before = (controls(&window), search(&window), below(&window));
    for prediction in [egui::Key::Num1, egui::Key::Num2] {
        window.key_press(prediction);
        window.step();
        for frame in 0..6000 {
            let now = (controls(&window), search(&window), below(&window));
            assert_eq!(now, before, "{prediction:?}, frame {frame}");
            let state = window.state();
            let listed = state.listed_scenes().is_some_and(|(_, thumbnails)| !thumbnails.is_empty());
            let finest = state.direction_map().is_some_and(|map| map.side == 64);
            if listed && finest && state.attribution().is_some() {
                break;
            }
            assert!(frame < 5999, "waited in vain for the results");
            std::thread::sleep(std::time::Duration::from_millis(20));
            window.step();
        }
    }
    window.get_by_label("Find worst scene").click();
    window.run_steps(2);
    while window.state().worst().is_none() {
        assert_eq!(controls(&window), before.0, "while it searches");
        std::thread::sleep(std::time::Duration::from_millis(20));
        window.step();
    }
    window.run_steps(2);
    assert_eq!((controls(&window), search(&window)), (before.0, before.1), "with the worst scene");
}
