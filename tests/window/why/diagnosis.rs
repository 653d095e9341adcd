//! Whether something trivial explains the loss: the lines, the corrected prediction in its pane, and the reading that is offered.

use svbrdf_evaluate::diagnose::{Change, Diagnosis, Hypothesis, Reading, diagnose, floor};
use svbrdf_files::read::NormalY;
use svbrdf_viewer::model::settings::WhySection;

use super::*;
use crate::materials::SIDE as WHOLE;

const SIDE: u32 = 64;

/// A window on a ground truth, a prediction with Y of normals in the other direction, and one whose left half is darker, with all lines.
fn diagnosed<'a>() -> (tempfile::TempDir, Window<'a>) {
    let folder = tempfile::tempdir().unwrap();
    let strip = strip();
    let names = ["truth", "flipped", "darker"];
    let paths = names.map(|name| {
        let path = folder.path().join(format!("{name}.png"));
        write_packed(&path, SIDE, |tile, x, y| {
            let [r, g, b] = strip.get_pixel(tile * WHOLE + x, y).0;
            match (name, tile) {
                ("flipped", 0) => [r, 255 - g, b],
                ("darker", 1) if x < SIDE / 2 => [r, g, b].map(|value| value / 2),
                _ => [r, g, b],
            }
        });
        path
    });
    let mut window = built_in();
    window.set_size(vec2(1200.0, 1800.0));
    let (order, preset) = (Some("ndrs".parse().unwrap()), Some("deschaintre".parse().unwrap()));
    let read = ReadOptions { order, preset, ..ReadOptions::AUTO };
    edit(&mut window, |model| opening::open(model, paths.into(), true, read));
    wait(&mut window, "the materials", |app| app.names() == names);
    tab(&mut window, "Why");
    for section in ["Which map", "Which scenes"] {
        click(&mut window, section);
    }
    unfold(&mut window);
    (folder, window)
}

/// Unfolds the lines without a mark, or folds them.
fn unfold(window: &mut Window<'_>) {
    edit(window, |model| model.settings.sections.toggle(WhySection::Hypotheses));
}

fn wait_for_diagnosis(window: &mut Window<'_>) -> Diagnosis {
    wait(window, "the diagnosis", |app| app.diagnosis().is_some());
    window.diagnosis().unwrap().clone()
}

/// The accessible labels of the lines of the table, from above.
fn lines(window: &Window<'_>) -> Vec<String> {
    let mut nodes: Vec<_> = window.query_all_by_label_contains(" of the loss").collect();
    nodes.sort_by(|a, b| a.rect().top().total_cmp(&b.rect().top()));
    let labels =
        nodes.iter().map(|node| node.accesskit_node()).filter_map(|of| of.label().or_else(|| of.value()));
    // The sentence above them has no colon.
    labels.filter(|label| label.contains(": ")).collect()
}

#[needs(adapter)]
fn the_lines_are_those_of_the_core_with_the_marked_ones_first_and_the_others_folded() {
    let (_folder, mut window) = diagnosed();
    let found = wait_for_diagnosis(&mut window);
    let materials: Vec<Material<f32>> = window.materials().cloned().collect();
    let storages = [0, 1].map(|index: usize| window.model().materials.all[index].read.storage.clone());
    let floor = floor(&materials[0], &storages[0], &PRINTED, 0, &Progress::default()).unwrap().mean;
    let pair = [&materials[0], &materials[1]];
    let expected = diagnose(pair, storages.each_ref(), &PRINTED, floor, 0, &Progress::default()).unwrap();
    assert_eq!(found, expected);
    let hypotheses: Vec<_> = found.marked().map(|finding| finding.hypothesis).collect();
    assert_eq!(hypotheses, [Hypothesis::NormalY]);
    let all = lines(&window);
    assert_eq!(all.len(), found.findings.len(), "{all:?}");
    let share = 100.0 * found.marked().next().unwrap().share;
    assert_eq!(all[0], format!("Normal Y flipped: {share:.1}% of the loss, marked"));
    assert!(all[1..].iter().all(|line| !line.ends_with("marked")), "{all:?}");
    window.get_by_label_contains("Reading the normals with Y down would lower the loss by");
    // Folded, those without a mark are behind one line.
    unfold(&mut window);
    let marked = lines(&window);
    assert_eq!(marked.len(), 1, "{marked:?}");
    assert!(marked[0].starts_with("Normal Y flipped: ") && marked[0].ends_with("marked"), "{marked:?}");
    let others = found.findings.len() - 1;
    click(&mut window, &format!("{others} other explanations: none marked"));
    assert_eq!(lines(&window).len(), 1 + others);
    unfold(&mut window);
    // The other prediction, whose error is none of these: the line that explains most.
    press(&mut window, egui::Key::Num2);
    wait_for_diagnosis(&mut window);
    window.get_by_label_contains("other reading of the files explains 10% of the loss.");
    assert!(!has(&window, "Read with"));
    let found = window.diagnosis().unwrap();
    let shares = found.findings.iter().map(|finding| finding.share);
    let most = 100.0 * shares.fold(f64::NEG_INFINITY, f64::max);
    let first = lines(&window);
    assert!(
        first.len() == 1 && first[0].ends_with(&format!(": {most:.1}% of the loss")),
        "{first:?}, {most}"
    );
}

#[needs(adapter)]
fn a_click_shows_the_corrected_prediction_in_its_pane_and_another_one_the_prediction_itself() {
    let (_folder, mut window) = diagnosed();
    wait_for_diagnosis(&mut window);
    let original = window.materials().nth(1).unwrap().clone();
    let storage = window.model().materials.all[1].read.storage.clone();
    let expected = Reading::NormalY.applied(&original, &storage).unwrap();
    assert_ne!(expected, original, "a planted fault");
    let rect = pane(&window, "1  flipped");
    let before = pixels(&mut window, rect);
    let ways: [fn(&mut Window<'_>); 4] = [
        |window| window.get_by_label_contains("Normal Y flipped: ").click(),
        |window| window.key_press(egui::Key::Escape),
        |window| window.get_all_by_label("Show original").next().unwrap().click(),
        undo,
    ];
    for back in ways {
        window.run_steps(30);
        window.get_by_label_contains("Normal Y flipped: ").click();
        window.run_steps(3);
        let name = "flipped, Y of normals flipped";
        wait(&mut window, name, |app| app.displayed_materials()[1].0 == name);
        assert_eq!(window.displayed_materials()[1].1, expected);
        assert_eq!(window.names()[1], "flipped", "the material itself is unchanged");
        window.get_by_label(&format!("Title 1  {name}"));
        assert!(pixels(&mut window, rect) != before);
        back(&mut window);
        window.run_steps(3);
        assert_eq!(window.view().display.corrected, None);
        assert_eq!(window.displayed_materials()[1].1, original);
        assert!(pixels(&mut window, rect) == before);
    }
    // A correction is of one prediction.
    window.get_by_label_contains("Symmetry ").click();
    window.run_steps(3);
    let corrected = window.view().display.corrected;
    assert!(matches!(corrected, Some(Change::Symmetry(_))), "{corrected:?}");
    press(&mut window, egui::Key::Num2);
    assert_eq!(window.view().display.corrected, None);
}

#[needs(adapter)]
fn one_click_reads_the_file_as_the_finding_says_and_undo_goes_back() {
    let (_folder, mut window) = diagnosed();
    wait_for_diagnosis(&mut window);
    let material = |window: &Window<'_>, index| window.materials().nth(index).unwrap().clone();
    let (truth, wrong) = (material(&window, 0), material(&window, 1));
    for place in ["Why", "Files"] {
        let offer = "Reading the normals with Y down would lower the loss by";
        tab(&mut window, "Why");
        wait_for_diagnosis(&mut window);
        tab(&mut window, place);
        window.get_by_label_contains(offer);
        click(&mut window, "Read with normal y down");
        wait(&mut window, "the file to be read again", |app| {
            !app.is_reading()
                && app.parts.model.materials.all[1].read.record.options.normal_y == Some(NormalY::Down)
        });
        let read = material(&window, 1);
        let far = |a: &Material<f32>, b: &Material<f32>| {
            let pairs = a.planes().normal[1].iter().zip(&b.planes().normal[1]);
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
        };
        assert!(far(&read, &truth) < 0.02 && far(&wrong, &truth) > 0.1, "{place}");
        assert!(!has(&window, "Read with normal y down"), "the file read rightly has no such finding");
        undo(&mut window);
        wait(&mut window, "the file to be read as before", |app| {
            !app.is_reading() && *app.materials().nth(1).unwrap() == wrong
        });
    }
}
