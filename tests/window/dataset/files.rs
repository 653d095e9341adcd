//! The files of a data set: they change, cannot be read, are many predictions of one material, or need a registration.

use svbrdf_viewer::dataset::matrix::Matrix;
use svbrdf_viewer::dataset::pictures::{self, MatrixCell};

use super::*;

#[needs(adapter)]
fn a_file_that_was_replaced_is_read_again_with_its_losses_and_one_that_is_gone_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let all = folders(folder.path());
    let mut window = on_dataset(&dataset(all.clone(), None));
    let before = loss(&window, 0, 0).unwrap();
    std::fs::copy(all[2].join("a.png"), all[1].join("a.png")).unwrap();
    std::fs::remove_file(all[2].join("a.png")).unwrap();
    window.key_press_modifiers(Modifiers::COMMAND, egui::Key::R);
    wait(&mut window, "the losses again", |app| {
        loss(app, 0, 0).is_some_and(|now| now != before) && app.names().len() == 2
    });
    assert_eq!(loss(&window, 0, 1), None);
    assert!(has(&window, "2  theirs"));
    // A file that is newer than what is displayed is marked; one that is watched is read again with its losses.
    std::thread::sleep(std::time::Duration::from_millis(1100));
    std::fs::copy(all[2].join("f.png"), all[1].join("a.png")).unwrap();
    see(&mut window, "(newer on disk: Ctrl+R)");
    window.key_press_modifiers(Modifiers::COMMAND, egui::Key::R);
    wait_in(&mut window, "the newer file", |window| !has(window, "newer on disk"));
    let now = loss(&window, 0, 0);
    wait(&mut window, "its loss", |app| loss(app, 0, 0).is_some() && loss(app, 0, 0) == now || now.is_none());
    edit(&mut window, |model| model.settings.watch = true);
    rest(&mut window, 20);
    let before = loss(&window, 0, 0).unwrap();
    std::fs::copy(all[0].join("a.png"), all[1].join("a.png")).unwrap();
    wait(&mut window, "the loss of what was written", |app| {
        loss(app, 0, 0).is_some_and(|now| now != before && now.loss == 0.0)
    });
}

#[needs(adapter)]
fn many_predictions_of_one_material_are_a_list_with_panes_for_the_chosen_and_the_pinned_ones() {
    let folder = tempfile::tempdir().unwrap();
    let files = (0..26).map(|number| match number {
        0 => ("gt".to_owned(), 0),
        _ => (format!("p{:02}", number - 1), 2 + number),
    });
    let mut window = on_files(files.map(|(name, error)| {
        let path = folder.path().join(format!("{name}.png"));
        write(&path, 16, error);
        path
    }));
    wait(&mut window, "the first prediction", |app| app.names() == ["gt", "p00"]);
    wait(&mut window, "all losses", |app| known::ask(app.shown()).count() == 25);
    see(&mut window, "25 predictions");
    // Assistive software is told what is open.
    assert_eq!(window.root().accesskit_node().label().as_deref(), Some("p00 (1 of 25) - svbrdf"));
    // The losses are those of one comparison each, over the same scenes.
    let materials = |window: &Window<'_>| window.materials().cloned().collect::<Vec<_>>();
    let pair = materials(&window);
    let by_seed = |seed| {
        let comparison = Comparison::new(&pair[0], &[&pair[1]], Convention::default()).unwrap();
        let request = Request::Accuracy { target: 0.01, seed };
        comparison.run(&request, &Progress::default()).unwrap().losses[0].estimate.mean
    };
    assert_eq!(loss(&window, 0, 0).unwrap().loss, by_seed(0));
    assert_ne!(loss(&window, 0, 0).unwrap().loss, by_seed(1));
    let losses: Vec<f64> = (0..25).map(|case| loss(&window, case, 0).unwrap().loss).collect();
    assert!(losses.is_sorted(), "{losses:?}");
    // A pinned one stays, beside those that are flipped through; the ground truth is read once.
    let id = |window: &Window<'_>| window.model().materials.all[0].id();
    let first = id(&window);
    edit(&mut window, |model| endpoint::move_over_plane(&mut model.view.scene, Endpoint::Light, [0.4, -0.2]));
    let scene = window.scene();
    window.key_press(egui::Key::K);
    for name in ["p01", "p02"] {
        window.key_press(egui::Key::PageDown);
        wait(&mut window, "the next prediction", |app| app.names() == ["gt", name, "p00"]);
    }
    window.key_press(egui::Key::K);
    window.key_press(egui::Key::PageDown);
    wait(&mut window, "two pinned ones", |app| app.names() == ["gt", "p03", "p00", "p02"]);
    window.key_press(egui::Key::PageUp);
    wait(&mut window, "a pinned one once", |app| app.names() == ["gt", "p02", "p00"]);
    assert_eq!((id(&window), window.scene()), (first, scene));
    // Worst first.
    let list = ListView { order: ListOrder::Loss(0), ..ListView::default() };
    edit(&mut window, |model| model.dataset.list = list);
    let listed = Matrix::ask(window.shown()).unwrap().rows;
    assert_eq!(listed[..3], [24, 23, 22]);
    let session = folder.path().join("many.svbrdf-session.json");
    save(&mut window, SaveKind::Session, &session);
    let mut later = on_session(&session);
    wait(&mut later, "the session", |app| app.names() == ["gt", "p02", "p00"]);
    // The ground truth that all have changes: all losses are of the new one.
    let before = loss(&window, 5, 0);
    std::fs::copy(folder.path().join("p10.png"), folder.path().join("gt.png")).unwrap();
    window.key_press_modifiers(Modifiers::COMMAND, egui::Key::R);
    wait(&mut window, "losses of another ground truth", |app| {
        loss(app, 5, 0) != before && known::ask(app.shown()).count() == 25
    });
    assert!(loss(&window, 10, 0).unwrap().loss == 0.0);
}

/// Panes without a material say why there is none.
#[needs(adapter)]
fn a_ground_truth_that_cannot_be_read_is_told_in_the_panes() {
    let folder = tempfile::tempdir().unwrap();
    let folders = folders(folder.path());
    std::fs::write(folders[0].join("b.png"), "no picture").unwrap();
    let dataset = Some(Box::new(dataset(folders, None)));
    let mut window = window(ViewerOptions { dataset, ..ViewerOptions::default() });
    press(&mut window, egui::Key::Enter);
    press(&mut window, egui::Key::PageDown);
    wait(&mut window, "the problem", |app| !app.parts.model.dataset.missing.is_empty());
    window.run_steps(3);
    let problem = window.model().dataset.missing[0].problem.clone();
    assert!(problem.contains("b.png") && window.names().is_empty(), "{problem}");
    window.get_by_label(&problem);
    assert!(!has(&window, "Open a material with Ctrl+O, or drop files or folders here."));
    press(&mut window, egui::Key::PageDown);
    wait(&mut window, "the next material", |app| app.names().first().is_some_and(|name| name == "c"));
    assert!(!has(&window, &problem));
}

/// Predictions that are the centre of their ground truths are seen on that part, with the loss of `svbrdf rank`.
#[needs(adapter)]
fn predictions_of_a_registered_method_are_seen_on_their_part_of_the_ground_truth() {
    let folder = tempfile::tempdir().unwrap();
    let [gt, whole, crop] = ["gt", "whole", "crop"].map(|name| folder.path().join(name));
    [&gt, &whole, &crop].into_iter().for_each(|folder| std::fs::create_dir(folder).unwrap());
    let noise = |x: u32, y: u32| (x.wrapping_mul(73) ^ y.wrapping_mul(151)).wrapping_mul(2_654_435_761) >> 25;
    for name in ["a", "b", "c"] {
        let written = |folder: &Path, side, from: u32| {
            write_packed(&folder.join(format!("{name}.png")), side, |tile, x, y| {
                let shade = (40 + noise(x + from, y + from)) as u8;
                [[shade, 255 - shade, 200], [shade; 3], [shade; 3], [20; 3]][tile as usize]
            });
        };
        written(&gt, 48, 0);
        written(&whole, 48, 0);
        written(&crop, 32, 8);
    }
    let mut window = built_in();
    drop_files(&mut window, [gt, whole, crop]);
    wait(&mut window, "the data set", |app| app.names() == ["a", "whole", "crop"]);
    wait(&mut window, "all losses", |app| known::ask(app.shown()).count() == 3);
    assert!(window.materials().all(|one| one.size() == [32, 32]));
    let materials: Vec<_> = window.materials().cloned().collect();
    let same =
        |a: &Material<f32>, b: &Material<f32>| (0..32 * 32).all(|texel| a.texel(texel) == b.texel(texel));
    assert!(same(&materials[0], &materials[1]) && same(&materials[0], &materials[2]));
    assert_eq!(loss(&window, 0, 1).unwrap().loss, 0.0);
    // Its cell has the same picture, also of the difference.
    edit(&mut window, |model| model.view.display.difference = true);
    wait_in(&mut window, "the difference of the cell", |window| {
        let of = |column| MatrixCell { case: 0, column };
        pictures::latest(window.shown())
            .is_some_and(|pictures| pictures.range.is_some() && pictures.part(of(2)).is_some())
    });
    // It is declined by a click, and accepted by another.
    tab(&mut window, "Files");
    window.get_by_label_contains("crop: registration ").click();
    wait(&mut window, "no registration", |app| app.names() == ["a", "whole"]);
    assert!(window.materials().all(|one| one.size() == [48, 48]));
    wait(&mut window, "no losses", |app| known::ask(app.shown()).count() == 3);
    assert_eq!(loss(&window, 0, 1), None);
    window.get_by_label_contains("crop: registration ").click();
    wait(&mut window, "the registration", |app| app.names() == ["a", "whole", "crop"]);
    wait(&mut window, "all losses", |app| loss(app, 0, 1).is_some_and(|known| known.loss == 0.0));
    // A session has it, too.
    let session = folder.path().join("crops.svbrdf-session.json");
    save(&mut window, SaveKind::Session, &session);
    let mut later = on_session(&session);
    wait(&mut later, "the session", |app| app.names() == ["a", "whole", "crop"]);
}

/// A method without a prediction has its name in the colour of text: that of its slot has too little contrast.
#[needs(adapter)]
fn the_name_of_an_empty_pane_is_readable() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = on_dataset(&dataset(folders(folder.path()), None));
    press(&mut window, egui::Key::PageDown);
    wait(&mut window, "b", |app| app.names()[0] == "b");
    window.run_steps(3);
    let name = window.get_by_label("2  theirs").rect();
    let picture = pixels(&mut window, name);
    let is_coloured = |pixel: &&image::Rgba<u8>| {
        pixel.0[..3].iter().max().unwrap() - pixel.0[..3].iter().min().unwrap() > 60
    };
    assert_eq!(picture.pixels().filter(is_coloured).count(), 0);
}
