//! Which map the loss comes from, and one map alone in the panes.

use svbrdf_core::material::Map;
use svbrdf_core::model::convention::{self, Convention};
use svbrdf_evaluate::why::{Attribution, attribute};

use super::*;

fn expected(prediction: usize, convention: &Convention) -> Attribution {
    let materials = materials();
    let request = Request::Accuracy { target: 0.01, seed: 0 };
    attribute(&materials[0], &materials[prediction], convention, &request, &Progress::default()).unwrap()
}

fn wait_for_attribution(window: &mut Window<'_>) -> Attribution {
    wait(window, "the attribution", |app| app.attribution().is_some());
    window.attribution().unwrap().clone()
}

#[needs(adapter)]
fn the_shares_of_the_maps_are_those_of_the_core_for_the_chosen_prediction_and_convention() {
    let mut window = opened();
    let first = expected(1, &convention::PRINTED);
    assert_eq!(wait_for_attribution(&mut window), first);
    for label in ["normal: 80.9%", "diffuse: 19.1%", "specular: 0.0%", "roughness: 0.0%"] {
        window.get_by_label(&format!("{label} of the loss"));
    }
    // The other prediction is there, too, after the chosen one.
    let second = expected(2, &convention::PRINTED);
    assert_ne!(first, second, "a planted fault");
    let other = "roughness of wrong roughness: 60.1% of the loss";
    see(&mut window, other);
    click(&mut window, other);
    let display = &window.view().display;
    assert_eq!((display.prediction, display.isolated), (1, Some(Map::Roughness)), "a click chooses it");
    press(&mut window, egui::Key::Escape);
    assert_eq!(window.attribution(), Some(second.clone()), "it is not computed again");
    window.get_by_label("roughness: 60.1% of the loss");
    window.get_by_label("normal of blurred normals: 80.9% of the loss");
    choose(&mut window, "Convention", "guided-2020");
    assert_eq!(wait_for_attribution(&mut window), expected(2, &"guided-2020".parse().unwrap()));
}

/// Clicks on a map of the chosen prediction once its share is known.
fn isolate(window: &mut Window<'_>, map: &str) {
    wait_for_attribution(window);
    let start = format!("{map}: ");
    let buttons = window.get_all_by_role(Role::Button).filter_map(|node| node.accesskit_node().label());
    let row = buttons.into_iter().find(|label| label.starts_with(&start) && label.ends_with("of the loss"));
    click(window, &row.expect("the row of the map"));
}

/// Waits until the pane of this prediction has this title.
fn wait_for_pane(window: &mut Window<'_>, name: &str) -> egui::Rect {
    wait(window, name, |app| app.displayed_materials().iter().any(|(seen, _)| *seen == name));
    pane(window, &format!("1  {name}"))
}

#[needs(adapter)]
fn a_click_on_a_map_shows_the_mixture_and_its_title_says_so() {
    let mut window = opened();
    let materials = materials();
    let rect = pane(&window, "1  blurred normals");
    let whole = pixels(&mut window, rect);
    window.key_down(egui::Key::G);
    window.run_steps(3);
    let ground_truth = pixels(&mut window, rect);
    window.key_up(egui::Key::G);
    window.run_steps(3);
    assert!(whole != ground_truth);

    // Its roughness is that of the ground truth: alone wrong it changes nothing, alone right neither.
    isolate(&mut window, "roughness");
    let rect = wait_for_pane(&mut window, "blurred normals, only its roughness wrong");
    window.get_by_label("Title 1  blurred normals, only its roughness wrong");
    assert!(pixels(&mut window, rect) == ground_truth, "the pane shows the ground truth");
    click(&mut window, "only it right");
    let rect = wait_for_pane(&mut window, "blurred normals, only its roughness right");
    assert!(pixels(&mut window, rect) == whole, "the pane shows the prediction");

    isolate(&mut window, "normal");
    let rect = wait_for_pane(&mut window, "blurred normals, only its normal right");
    let seen = pixels(&mut window, rect);
    assert!(seen != whole && seen != ground_truth);
    let expected = materials[1].with_maps_of(&materials[0], |map| map == Map::Normal).unwrap();
    let app = window.state();
    assert_eq!(app.displayed_materials()[1].1, expected);
    assert_ne!(expected, materials[1].with_maps_of(&materials[0], |map| map != Map::Normal).unwrap());
    assert_eq!(app.displayed_materials()[0].1, materials[0]);
    assert_eq!(app.names()[1], "blurred normals", "the material itself is unchanged");
}

#[needs(adapter)]
fn differences_and_numbers_are_those_of_the_mixture_that_is_shown() {
    let mut window = opened();
    press(&mut window, egui::Key::D);
    isolate(&mut window, "diffuse");
    wait_for_pane(&mut window, "blurred normals, only its diffuse wrong");
    let found = statistics(&mut window)[0].mean;
    let scene = window.scene();
    let materials = materials();
    let mixture = materials[0].with_maps_of(&materials[1], |map| map == Map::Diffuse).unwrap();
    let comparison = Comparison::new(&materials[0], &[&mixture], PRINTED).unwrap();
    let request = Request::Listed(vec![scene]);
    let expected = comparison.run(&request, &Progress::default()).unwrap().losses[0].estimate.mean;
    assert!((found / expected - 1.0).abs() < 1e-5, "{found}, expected {expected}");
    assert!((found / loss_in(scene, 1) - 1.0).abs() > 0.1, "the prediction has another loss");
    // The losses of the tab stay those of the predictions.
    assert_eq!(wait_for_scene_losses(&mut window)[0], loss_in(scene, 1));
}
