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

use svbrdf_core::material::{Material, Planes};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::progress::Progress;
use svbrdf_files::read::Read;
use svbrdf_files::session::window::SessionDisplay;
use svbrdf_files::source::MaterialSource;
use svbrdf_page::{PageReport, View};

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
