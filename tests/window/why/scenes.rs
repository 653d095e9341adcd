//! The scenes of the loss, worst first, the search for the worst of all, the error map over them, and the other metrics.

use svbrdf_core::image::Image;
use svbrdf_evaluate::analyses::AnyAnalysis;
use svbrdf_evaluate::report::{AnalysisInput, Cell, Reader};
use svbrdf_evaluate::why::{RankedScene, TAIL, error_maps, worst, worst_first};
use svbrdf_viewer::why::scenes::FindWorst;

use super::*;

fn expected(prediction: usize) -> Vec<RankedScene> {
    let materials = materials();
    let comparison = Comparison::new(&materials[0], &[&materials[prediction]], PRINTED).unwrap();
    worst_first(&comparison.run(&Request::Scenes(SAMPLING), &Progress::default()).unwrap())
}

fn wait_for_scenes(window: &mut Window<'_>) -> Vec<RankedScene> {
    wait(window, "the scenes", |app| app.listed_scenes().is_some());
    window.listed_scenes().unwrap().0.to_vec()
}

#[needs(adapter)]
fn the_listed_scenes_and_their_thumbnails_are_those_of_the_core_and_a_click_loads_one() {
    let mut window = opened();
    let listed = wait_for_scenes(&mut window);
    assert_eq!(listed, expected(1));
    assert!(listed.is_sorted_by(|a, b| a.losses[0] >= b.losses[0]) && listed.len() == 192);
    let (_, thumbnails) = window.listed_scenes().unwrap();
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
    let before = window.scene();
    click(&mut window, &format!("Scene 2: {:.4}", listed[1].losses[0]));
    assert_eq!(window.scene(), listed[1].scene);
    let here = wait_for_scene_losses(&mut window)[0];
    assert!((here / listed[1].losses[0] - 1.0).abs() < 1e-6, "{here}, listed {}", listed[1].losses[0]);
    undo(&mut window);
    assert_eq!(window.scene(), before);
    press(&mut window, egui::Key::Num2);
    assert_eq!(wait_for_scenes(&mut window), expected(2));
    assert_ne!(expected(2), listed, "a planted fault");
}

#[needs(adapter)]
fn the_search_finds_the_scene_of_the_core_and_shows_it_unless_it_is_cancelled() {
    let mut window = opened();
    // The list does not push the button away under the click.
    wait_for_scenes(&mut window);
    let before = window.scene();
    for cancel in [
        |window: &mut Window<'_>| press(window, egui::Key::Escape),
        |window: &mut Window<'_>| click(window, "Cancel search"),
    ] {
        window.get_by_label("Find worst scene").click();
        window.run_steps(2);
        assert!(window.jobs().answers.is_running::<FindWorst>());
        cancel(&mut window);
        assert!(!window.jobs().answers.is_running::<FindWorst>());
        window.run_steps(10);
        assert_eq!((window.worst(), window.scene()), (None, before));
        assert!(window.messages().is_empty(), "{:?}", window.messages());
    }
    window.get_by_label("Find worst scene").click();
    wait(&mut window, "the worst scene", |app| app.worst().is_some());
    let materials = materials();
    let expected = worst(&materials[0], &materials[1], &PRINTED, 0, TAIL, &Progress::default()).unwrap();
    assert_eq!(window.worst(), Some(expected.clone()));
    assert_eq!(window.scene(), expected.scene);
    window.get_by_label_contains(&format!("{} scenes tried", expected.evaluations));
    let times = expected.loss / expected.mean.mean;
    window.get_by_label(&format!("{:.4}, {times:.1} x the mean", expected.loss));
    let here = wait_for_scene_losses(&mut window)[0];
    assert!((here / expected.loss - 1.0).abs() < 1e-6, "{here}, found {}", expected.loss);
    // That of one prediction is not that of another.
    press(&mut window, egui::Key::Num2);
    assert_eq!(window.worst(), None);
}

fn expected_maps() -> Vec<Image<f32>> {
    let materials = materials();
    let predictions: Vec<_> = materials[1..].iter().collect();
    let comparison = Comparison::new(&materials[0], &predictions, PRINTED).unwrap();
    let scenes = SAMPLING.scenes(&PRINTED).unwrap();
    error_maps(&comparison, &scenes, &Progress::default()).unwrap()
}

/// The window with the error map in its panes.
fn with_error_map<'a>() -> Window<'a> {
    let mut window = opened();
    click(&mut window, "Error map");
    statistics(&mut window);
    window
}

#[needs(adapter)]
fn the_error_map_has_the_statistics_of_the_core_and_its_mean_is_the_loss() {
    let mut window = with_error_map();
    let found = statistics(&mut window);
    let losses = losses(&Request::Scenes(SAMPLING));
    for (index, (found, map)) in found.iter().zip(&expected_maps()).enumerate() {
        assert_eq!(Some(*found), Statistics::of(&means(&map.pixels)), "{index}");
        let [loss, other] = [index, 1 - index].map(|index| losses[index].estimate.mean);
        assert!((found.mean / loss - 1.0).abs() < 1e-5, "{}, expected {loss}", found.mean);
        assert!((found.mean / other - 1.0).abs() > 0.1, "a planted fault");
    }
    for title in PREDICTIONS {
        window.get_by_label(&format!("Title {title}: error map"));
    }
    window.get_by_label("over 192 scenes");
    window.get_by_label("mean |ln p - ln g| of 192 scenes");
    // It does not depend on the light.
    let rect = pane(&window, GROUND_TRUTH);
    let before = window.scene();
    drag_primary(&mut window, rect, vec2(0.7, 0.3), vec2(0.2, 0.8));
    assert_ne!(window.scene(), before);
    assert_eq!(statistics(&mut window), found);
    // Another difference is of the scene again.
    edit(&mut window, |model| choose_difference(model, Difference::Log));
    assert_ne!(statistics(&mut window), found);
    window.get_by_label("Title 1  blurred normals: log difference");
}

#[needs(adapter)]
fn panes_readout_and_saved_file_have_the_numbers_of_the_error_map() {
    let mut window = with_error_map();
    press(&mut window, egui::Key::Num0);
    // Few edges of texels are in the middle of a pixel.
    edit(&mut window, |model| display::zoom(model, 4.3, [0.0, 0.0]));
    let maps = expected_maps().into_iter().map(|map| map.pixels).collect::<Vec<_>>();
    let (_folder, path) = assert_differences(&mut window, &maps, 0.0);
    let text = "mean log difference of each texel over 128 near-field and 64 distant scenes, seed 0";
    assert!(file_contains(&path, text));
}

#[needs(adapter)]
fn the_other_metrics_are_those_of_the_core_of_the_chosen_prediction() {
    let mut window = by_scenes();
    window.set_size(vec2(1200.0, 2400.0));
    tab(&mut window, "Why");
    for section in ["Would something trivial explain it?", "Which map", "Which scenes"] {
        click(&mut window, section);
    }
    let (request, materials) = (window.model().settings.loss.listed_scenes(), materials());
    let rows = |prediction: usize| -> Vec<[String; 2]> {
        let metrics = AnyAnalysis::named("metrics").unwrap();
        let (ground_truth, predictions) = (&materials[0], vec![&materials[prediction]]);
        let (paths, convention, request) = (Vec::new(), PRINTED, request.clone());
        let input = AnalysisInput {
            ground_truth,
            predictions,
            storages: Vec::new(),
            paths,
            convention,
            request,
            few_scenes: false,
            mask: None,
        };
        let table = metrics.run(&input, json!({}), &Progress::default()).unwrap().table(Reader::Person);
        table.rows.iter().map(|row| [0, 1].map(|column| Cell::text(&row[column]))).collect()
    };
    assert!(!has(&window, "rmse_roughness"), "it is folded at first");
    click(&mut window, "Other metrics");
    for (prediction, key) in [(1, egui::Key::Num1), (2, egui::Key::Num2)] {
        press(&mut window, key);
        let rows = rows(prediction);
        wait_in(&mut window, "the metrics", |window| has(window, &rows[0][1]));
        for text in rows.iter().flatten() {
            assert!(has(&window, text), "{text} of prediction {prediction} is not shown");
        }
    }
    assert_ne!(rows(1), rows(2), "a planted fault");
}
