//! Masks: the texels outside are gray, and not in the loss, the parts of it, and the statistics.

use image::{Luma, imageops};

use svbrdf_core::image::mean_of_channels;
use svbrdf_evaluate::protocols::MaskSource;
use svbrdf_evaluate::why::error_maps;
use svbrdf_viewer::why::maps::Attribute;

use super::materials::{SIDE, sample};
use super::*;

/// The texels that the mask keeps: the left three eighths, but for a hole.
fn is_kept(texel: usize) -> bool {
    let (x, y) = (texel % SIDE as usize, texel / SIDE as usize);
    x < 96 && !(30..50).contains(&y)
}

/// The mean over the kept texels of the log differences in these scenes, of the whole materials.
fn expected(scenes: &[Scene]) -> f64 {
    let materials = materials();
    let comparison = Comparison::new(&materials[0], &[&materials[2]], PRINTED).unwrap();
    let map = &error_maps(&comparison, scenes, &Progress::default()).unwrap()[0];
    let texels = map.pixels.iter().enumerate().filter(|(texel, _)| is_kept(*texel));
    let values: Vec<f64> = texels.map(|(_, value)| f64::from(mean_of_channels(value))).collect();
    values.iter().sum::<f64>() / values.len() as f64
}

/// Whether the roughness of these texels is that outside of a mask.
fn are_gray(window: &Window<'_>, is_outside: fn(usize) -> bool) -> bool {
    let rough = |one: &Material<f32>| one.planes().roughness.clone();
    let is_gray = |(texel, rough): (usize, f32)| !is_outside(texel) || rough == 1.0;
    window.materials().all(|one| rough(one).into_iter().enumerate().all(is_gray))
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-5 * b
}

/// What `ask` answers, once it does.
fn found<T>(window: &mut Window<'_>, ask: impl Fn(&App) -> Option<T>) -> T {
    let answer = std::cell::Cell::new(None);
    wait(window, "an answer", |app| {
        let found = ask(app);
        let is_there = found.is_some();
        answer.set(found.or_else(|| answer.take()));
        is_there
    });
    answer.into_inner().unwrap()
}

/// Checks loss, parts, statistics and texels of a window on the masked pair.
fn check(window: &mut Window<'_>) {
    wait(window, "the loss", |app| app.losses().is_some());
    let loss = window.losses().unwrap()[0].estimate.mean;
    let request = window.model().settings.loss.request();
    let right = expected(&request.scenes(&PRINTED).unwrap().unwrap());
    assert!(near(loss, right), "{loss}, {right}");
    assert!(!near(losses(&request)[1].estimate.mean, right), "a planted fault: all texels are counted");
    let (pair, seed) = (window.pair().unwrap(), window.model().settings.loss.seed);
    let asked = Attribute { pair, seed };
    let parts = found(window, |app| Some(app.jobs().answers.get(&asked).ready()?.loss.mean));
    assert!((parts - right).abs() < 0.1 * right, "{parts}, {right}");
    let here = expected(&[window.scene()]);
    let drawn = found(window, |app| app.scene_losses().filter(|(_, is_current)| *is_current));
    assert!(near(drawn.0[0], here));
    edit(window, |model| choose_difference(model, Difference::Log));
    edit(window, |model| model.view.display.difference = true);
    wait(window, "the statistics", |app| app.difference_statistics().is_some());
    let mean = window.difference_statistics().unwrap()[0].as_ref().unwrap().mean;
    assert!(near(mean, here), "{mean}, {here}");
    assert!(are_gray(window, |texel| !is_kept(texel)));
    edit(window, |model| model.view.display.difference = false);
}

#[needs(adapter)]
fn the_texels_outside_of_a_mask_are_gray_and_not_counted() {
    let folder = tempfile::tempdir().unwrap();
    let [truth, prediction, mask] = ["gt.png", "p.png", "mask.png"].map(|name| folder.path().join(name));
    sample(0).save(&truth).unwrap();
    sample(2).save(&prediction).unwrap();
    let kept = |x, y| Luma([if is_kept((y * SIDE + x) as usize) { 255 } else { 0_u8 }]);
    image::GrayImage::from_fn(SIDE, SIDE, kept).save(&mask).unwrap();
    let source = Some(MaskSource::File(mask.clone()));
    let mut first = window(ViewerOptions { mask: source, ..options_of([truth.clone(), prediction]) });
    wait(&mut first, "the materials", |app| !app.is_reading());
    click(&mut first, "Scenes");
    check(&mut first);
    let [session, picture] = ["a.svbrdf-session.json", "a.png"].map(|name| folder.path().join(name));
    save(&mut first, SaveKind::Session, &session);
    save(&mut first, SaveKind::Renderings, &picture);
    check(&mut on_session(&session));
    check(&mut on_session(&picture));

    imageops::flip_horizontal(&image::open(&mask).unwrap()).save(&mask).unwrap();
    edit(&mut first, opening::reload);
    wait(&mut first, "the materials in the other mask", |app| !app.is_reading());
    assert!(are_gray(&first, |texel| texel % (SIDE as usize) < 160));
    edit(&mut first, |model| opening::make_ground_truth(model, 1));
    wait(&mut first, "the other ground truth", |app| !app.is_reading() && app.names() == ["p", "gt"]);
    wait(&mut first, "its loss", |app| app.losses().is_some());
    open(&mut first, [truth]);
    wait(&mut first, "the whole material", |app| !app.is_reading() && app.names() == ["gt"]);
    assert!(!are_gray(&first, |texel| texel < 160), "another comparison has no mask");
}
