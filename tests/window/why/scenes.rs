//! The scenes of the loss, worst first, and the search for the worst of all.

use svbrdf_core::loss::{Comparison, Request};
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::why::{RankedScene, TAIL, worst, worst_first};

use super::*;

fn expected(prediction: usize) -> Vec<RankedScene> {
    let materials = materials();
    let comparison = Comparison::new(&materials[0], &[&materials[prediction]], PRINTED).unwrap();
    worst_first(&comparison.run(&Request::Scenes(SAMPLING), &Progress::default()).unwrap())
}

fn wait_for_scenes(window: &mut Window<'_>) -> Vec<RankedScene> {
    wait(window, "the scenes", |app| app.listed_scenes().is_some());
    window.state().listed_scenes().unwrap().0.to_vec()
}

#[needs(adapter)]
fn the_listed_scenes_and_their_thumbnails_are_those_of_the_core_and_a_click_loads_one() {
    let mut window = opened();
    let listed = wait_for_scenes(&mut window);
    assert_eq!(listed, expected(1));
    assert!(listed.is_sorted_by(|a, b| a.losses[0] >= b.losses[0]) && listed.len() == 192);
    let (_, thumbnails) = window.state().listed_scenes().unwrap();
    assert_eq!(thumbnails.len(), 96);
    let mean = |pixels: &[f32]| pixels.iter().map(|v| f64::from(*v)).sum::<f64>() / pixels.len() as f64;
    for (rank, pixels) in thumbnails.iter().enumerate() {
        let loss = listed[rank].losses[0];
        // 256 texels are 5 or 6 for each of the 48 pixels along a side.
        assert!((mean(pixels) / loss - 1.0).abs() < 0.02, "{rank}: {}, expected {loss}", mean(pixels));
    }
    assert!((mean(&thumbnails[0]) / listed[20].losses[0] - 1.0).abs() > 0.02, "a planted fault");
    click(&mut window, "More scenes");
    window.get_by_label(&format!("Scene 30: {:.4}", listed[29].losses[0]));
    assert!(!has(&window, "Scene 31: "));
    let before = window.state().parts.model.view.scene;
    click(&mut window, &format!("Scene 2: {:.4}", listed[1].losses[0]));
    assert_eq!(window.state().parts.model.view.scene, listed[1].scene);
    let here = wait_for_scene_losses(&mut window)[0];
    assert!((here / listed[1].losses[0] - 1.0).abs() < 1e-6, "{here}, listed {}", listed[1].losses[0]);
    undo(&mut window);
    assert_eq!(window.state().parts.model.view.scene, before);
    press(&mut window, egui::Key::Num2);
    assert_eq!(wait_for_scenes(&mut window), expected(2));
    assert_ne!(expected(2), listed, "a planted fault");
}

#[needs(adapter)]
fn the_search_finds_the_scene_of_the_core_and_shows_it_unless_it_is_cancelled() {
    let mut window = opened();
    // The list does not push the button away under the click.
    wait_for_scenes(&mut window);
    let before = window.state().parts.model.view.scene;
    for cancel in [
        |window: &mut Window<'_>| press(window, egui::Key::Escape),
        |window: &mut Window<'_>| click(window, "Cancel search"),
    ] {
        window.get_by_label("Find worst scene").click();
        window.run_steps(2);
        assert!(window.state().is_searching());
        cancel(&mut window);
        assert!(!window.state().is_searching());
        window.run_steps(10);
        assert_eq!((window.state().worst(), window.state().parts.model.view.scene), (None, before));
        assert!(window.state().messages().is_empty(), "{:?}", window.state().messages());
    }
    window.get_by_label("Find worst scene").click();
    wait(&mut window, "the worst scene", |app| app.worst().is_some());
    let materials = materials();
    let expected = worst(&materials[0], &materials[1], &PRINTED, 0, TAIL, &Progress::default()).unwrap();
    assert_eq!(window.state().worst(), Some(&expected));
    assert_eq!(window.state().parts.model.view.scene, expected.scene);
    window.get_by_label_contains(&format!("{} scenes tried", expected.evaluations));
    let times = expected.loss / expected.mean.mean;
    window.get_by_label(&format!("{:.4}, {times:.1} x the mean", expected.loss));
    let here = wait_for_scene_losses(&mut window)[0];
    assert!((here / expected.loss - 1.0).abs() < 1e-6, "{here}, found {}", expected.loss);
    // That of one prediction is not that of another.
    press(&mut window, egui::Key::Num2);
    assert_eq!(window.state().worst(), None);
}
