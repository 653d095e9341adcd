//! The HTML report: its shaders and, in a real browser, its pixels, numbers and controls.

mod browser;
mod controls;
mod hostile;
mod numbers;
mod pictures;
mod ranking;
mod readable;
#[cfg(feature = "viewer")]
mod shaders;

use svbrdf_core::loss::Request;
use svbrdf_core::material::{Mask, Material, Planes};
use svbrdf_core::model::convention::{Convention, PRINTED};
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::report::AnalysisInput;
use svbrdf_files::read::Read;
use svbrdf_files::session::window::SessionDisplay;
use svbrdf_files::source::MaterialSource;
use svbrdf_page::{Findings, PageReport, View};

#[cfg(target_os = "linux")]
#[test]
fn ci_has_a_browser() {
    let is_needed = std::env::var_os("CI").is_some();
    assert!(
        svbrdf_needs::has!(browser) || !is_needed,
        "CI must have Debian's chromium, which ./test installs"
    );
}

/// The built-in ground truth and predictions.
fn built_in() -> Vec<Material<f32>> {
    let read = |number| -> Read<f32> { MaterialSource::built_in(number).read(&Progress::default()).unwrap() };
    (0..svbrdf_files::samples::COUNT).map(|number| read(number).material).collect()
}

/// A material of noise in 32-bit floats, from polished to rough, with steep normals and dark colours.
fn noise(seed: u32) -> Material<f32> {
    const SIDE: u32 = 48;
    let random = |channel: u32, i: u32| {
        let hash = (i * 16 + channel + seed * 7919).wrapping_mul(2_654_435_761);
        let hash = (hash ^ hash >> 15).wrapping_mul(2_246_822_519);
        ((hash ^ hash >> 13) >> 8) as f32 / (1 << 24) as f32
    };
    let plane = |channel: u32, of: fn(f32) -> f32| (0..SIDE * SIDE).map(|i| of(random(channel, i))).collect();
    let planes = Planes {
        normal: [plane(0, |x| 1.6 * x - 0.8), plane(1, |x| 1.6 * x - 0.8), plane(2, |x| 0.2 + x)],
        diffuse: [3, 4, 5].map(|channel| plane(channel, |x| x * x * x)),
        specular: [6, 7, 8].map(|channel| plane(channel, |x| x * x)),
        roughness: plane(9, |x| 0.05 + 0.95 * x),
    };
    Material::new(format!("noise {seed}"), SIDE as usize, SIDE as usize, planes).unwrap()
}

/// The page with the figure of these materials alone.
fn figure(materials: &[Material<f32>], convention: Convention) -> String {
    html(&report(&materials.iter().collect::<Vec<_>>(), convention))
}

fn html(report: &PageReport<'_>) -> String {
    report.page(&Progress::default()).unwrap().html
}

/// The report of a figure alone.
fn report<'a>(materials: &'a [&Material<f32>], convention: Convention) -> PageReport<'a> {
    PageReport {
        materials,
        is_masked: false,
        convention,
        view: View {
            scene: Scene { kind: Kind::Near, view: [0.0, 0.0, 2.5], light: [0.4, 0.5, 1.2] },
            exposure_ev: 0.0,
            display: SessionDisplay::default(),
        },
        findings: None,
        readings: Vec::new(),
        command: None,
        max_bytes: 10_000_000,
    }
}

/// What a page finds about a prediction, over the texels of a mask.
fn findings([truth, prediction]: [&Material<f32>; 2], mask: Option<Mask>) -> Findings {
    let input = AnalysisInput {
        ground_truth: truth,
        predictions: vec![prediction],
        storages: Vec::new(),
        paths: Vec::new(),
        convention: PRINTED,
        request: Request::Accuracy { target: 0.05, seed: 0 },
        few_scenes: false,
        mask,
    };
    Findings::new(&input, &Progress::default()).unwrap()
}

#[test]
fn texels_outside_of_a_mask_are_gray_and_do_not_count() {
    let truth = noise(1);
    let size = truth.size();
    let left: Vec<bool> = (0..size[0] * size[1]).map(|texel| texel % size[0] < 24).collect();
    let mut planes = truth.planes().clone();
    planes.roughness.iter_mut().zip(&left).filter(|(_, left)| !**left).for_each(|(r, _)| *r = 1.0 - *r);
    let right_of_it = Material::new("wrong on the right", size[0], size[1], planes).unwrap();
    let [left, right, all] = [left.clone(), left.iter().map(|left| !left).collect(), vec![true; left.len()]]
        .map(|kept| findings([&truth, &right_of_it], Mask::new(size, kept)));
    let loss = |found: &Findings| found.loss.outcome.losses[0].estimate.mean;
    let blamed = |found: &Findings| {
        let blame = serde_json::to_value(&found.blame).unwrap();
        blame["attributions"][0]["maps"][3]["shapley"]["mean"].as_f64().unwrap()
    };
    assert_eq!([loss(&left), blamed(&left)], [0.0; 2]);
    assert!(left.worst.iter().all(|scene| scene.losses == [0.0]), "{:?}", left.worst);
    for of in [loss, blamed] {
        let ratio = of(&right) / of(&all);
        assert!((1.8..2.2).contains(&ratio), "{ratio}");
    }
    let materials = [&truth, &right_of_it];
    let page = PageReport { findings: Some(right), is_masked: true, ..report(&materials, PRINTED) };
    let html = html(&page);
    for said in [
        "Rendering loss over the mask of 1152 texels",
        "48 x 48 texels, 1152 in the mask",
        "Gray: outside of the mask",
        "on all texels of the mask",
    ] {
        assert!(html.contains(said), "{said}");
    }
}

#[test]
fn maps_are_halved_until_the_file_fits() {
    let materials = [1, 2].map(|seed| noise(seed).resized([192, 192]).unwrap());
    let materials: Vec<&Material<f32>> = materials.iter().collect();
    let page = PageReport { max_bytes: 900_000, ..report(&materials, Convention::default()) };
    let page = page.page(&Progress::default()).unwrap();
    assert!(page.html.len() <= 900_000, "{}", page.html.len());
    assert_eq!(page.reduced_to, Some([96, 96]));
    assert!(page.html.contains("reduced to 96 &times; 96 texels"));
}
