//! One material, looked at alone.

use svbrdf_core::picture::exposure;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_viewer::model::command::DisplayCommand;

use super::materials::strips;
use super::*;

#[needs(adapter)]
#[test]
fn a_material_alone_has_its_maps_and_files_first_and_a_prediction_makes_it_a_comparison() {
    let folder = tempfile::tempdir().unwrap();
    let [path, prediction] = strips(folder.path(), ["brick.png", "p.png"]);
    let options = ViewerOptions { ground_truth: Some(path.clone().into()), ..ViewerOptions::default() };
    let mut window = window(options);
    wait(&mut window, "the material", |app| app.names().len() == 1 && !app.is_reading());
    window.run_steps(4);
    assert!(window.query_by_label_contains("Title MATERIAL  brick").is_some());
    assert!(window.query_by_label("Compute loss").is_none() && window.query_by_label("Tab Loss").is_none());
    window.get_by_label("Open a prediction to compare");
    window.get_by_label("Reload");

    // The light reaches the whole plane, and a highlight does not darken it.
    let model = &window.state().parts.model;
    let [x, y, z] = model.view.scene.light;
    assert!(x == y && z > 2.0, "{:?}", model.view.scene);
    let material = model.materials.ground_truth().unwrap().material().clone();
    let (scene, convention) = (model.view.scene, model.view.convention());
    assert_eq!(model.view.exposure_ev, exposure::by_median(&material, &scene, &convention));

    let [first, last] = ["Map normal", "Map roughness"].map(|name| window.get_by_label(name).rect());
    assert!(first.top() == last.top() && last.right() <= 1200.0, "{last:?} in a window of 1200");
    click(&mut window, "Map roughness");
    assert_eq!(window.state().parts.model.view.display.quantity, Quantity::Roughness);
    click(&mut window, "Map roughness");
    assert_eq!(window.state().parts.model.view.display.quantity, Quantity::Rendering);
    click(&mut window, "Repeat");
    assert!(window.state().parts.model.view.display.tiled);
    apply(&mut window, DisplayCommand::ToggleTiled);
    click(&mut window, "Turntable");
    assert!(window.state().parts.model.animation.turntable);

    drop_files(&mut window, [prediction]);
    wait(&mut window, "the prediction", |app| app.names().len() == 2 && !app.is_reading());
    window.run_steps(4);
    assert!(window.query_by_label_contains("Title GROUND TRUTH  brick").is_some());
    window.get_by_label("Tab Loss");
    assert!(window.query_by_label("Open a prediction to compare").is_none());
}
