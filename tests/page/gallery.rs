//! The gallery of a ranking: a drag over a picture relights all pictures, each with the pixels of `svbrdf render`.

use std::path::Path;

use serde_json::json;

use svbrdf_core::material::Material;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::content::PictureContent;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::dataset::{self, DatasetReading, DatasetReport, DatasetSettings, Method, Pick, Source};
use svbrdf_files::convention::ChosenConvention;
use svbrdf_files::write::{self, FileKind};
use svbrdf_needs::needs;
use svbrdf_page::{Figures, exposure, material_views, ranking};

use super::browser::Page;
use super::numbers::{decoded, rendered};
use super::pixels::sparse;
use super::{built_in, noise};
use crate::support::surroundings::command;
use crate::support::tolerance::PAGE_PIXELS;

const READY: &str = "!!window.svbrdf?.gallery";
/// Half of the side of the square around the light that is not compared: its handle is drawn there.
const HANDLE: f64 = 8.0;

/// The page of a method over two materials of different sizes, written beside its files.
fn page(folder: &Path, convention: &str, figures: Option<Figures>, materials: [&Material<f32>; 4]) -> String {
    let path = |name: &str| folder.join(name);
    for (name, material) in ["gt/a.exr", "ours/a.exr", "gt/b.exr", "ours/b.exr"].iter().zip(materials) {
        std::fs::create_dir_all(path(name).parent().unwrap()).unwrap();
        write::write(material, &path(name), FileKind::Exr { half: false, preview: false }).unwrap();
    }
    let methods = vec![Method { name: "ours".to_owned(), path: path("ours") }];
    let source = Source::Folders { ground_truths: path("gt"), methods };
    let cases = source.cases().unwrap();
    let convention = ChosenConvention::read(convention).unwrap();
    let settings = DatasetSettings::new(source, convention, 0.1, 0, &cases);
    let (reading, progress) = (DatasetReading::default(), Progress::default());
    let found = dataset::run(&cases, &settings, &reading, None, &progress).unwrap();
    let report = DatasetReport::new(settings, reading, found.results, Pick::Fixed);
    let views = material_views(&report, &cases, figures, &path("page.html"), &progress).unwrap();
    ranking(&report, &views, None).unwrap()
}

/// Four materials in two rows: of 48 x 48 texels, and of 256 x 256, whose every 2nd texel is relit.
fn materials() -> [Material<f32>; 4] {
    let [truth, prediction, _] = built_in().try_into().unwrap();
    [noise(1), noise(2), truth, prediction]
}

#[needs(browser)]
#[test]
fn a_drag_over_a_picture_relights_all_with_the_pixels_of_render() {
    let all = materials();
    let small = [all[0].clone(), all[1].clone(), sparse(&all[2], 2), sparse(&all[3], 2)];
    for convention in ["printed", "materialgan-2020"] {
        let folder = tempfile::tempdir().unwrap();
        let html = page(folder.path(), convention, Some(Figures::All), all.each_ref());
        let mut page = Page::open_until(&html, [1000, 900], READY);
        // A pixel for each texel.
        page.evaluate(
            "svbrdf.gallery.pictures.forEach(({ image, canvas, relit }) => { \
             for (const one of [image, canvas]) one.style.width = `${relit.material.width}px`; })",
        );
        let first = serde_json::from_value::<Scene>(page.evaluate("svbrdf.gallery.scene")).unwrap();
        let [x, y] = page.place("[data-picture='1']");
        page.drag("left", 0, [x, y], [x + 12.0, y - 6.0]);
        let scene = serde_json::from_value::<Scene>(page.evaluate("svbrdf.gallery.scene")).unwrap();
        assert!((scene.light[0] - 0.5).abs() < 0.1 && (scene.light[1] - 0.25).abs() < 0.1, "{scene:?}");
        let drawn = "new Promise(done => { const wait = () => svbrdf.gallery.pictures.every(p => p.key !== '') ? done(true) : \
                     setTimeout(wait, 50); wait(); })";
        assert_eq!(page.evaluate(drawn), json!(true));
        let convention = convention.parse().unwrap();
        for (i, material) in small.iter().enumerate() {
            let exposure = exposure(&all[i - i % 2], &first, &convention);
            let core = rendered(&[material], PictureContent::default(), &scene, &convention, exposure);
            let pixels = decoded(&page.evaluate(&format!(
                "(() => {{ const c = svbrdf.gallery.pictures[{i}].canvas, d = c.getContext('2d').getImageData(0, 0, c.width, c.height); \
                 let text = ''; for (const byte of d.data) text += String.fromCharCode(byte); return btoa(text); }})()"
            )));
            assert_eq!(pixels.len(), 4 * core[0].len());
            let [width, height] = material.size();
            let light =
                [(1.0 + scene.light[0]) * width as f64 / 2.0, (1.0 - scene.light[1]) * height as f64 / 2.0];
            let is_handle = |i: usize| {
                let at = [(i % width) as f64, (i / width) as f64];
                at.iter().zip(light).all(|(a, b)| (a - b).abs() < HANDLE)
            };
            let off = |(i, (page, core)): (usize, (&[u8], &[u8; 3]))| {
                let apart = page.iter().zip(core).map(|(a, b)| a.abs_diff(*b)).max().unwrap();
                (!is_handle(i)).then_some(apart)
            };
            let largest = pixels.chunks_exact(4).zip(&core[0]).enumerate().filter_map(off).max().unwrap();
            assert!(largest <= PAGE_PIXELS, "picture {i}: off by {largest}");
        }
    }
}

#[needs(browser)]
#[test]
fn a_click_follows_the_link_a_drag_does_not_and_the_first_light_comes_back() {
    let (folder, all) = (tempfile::tempdir().unwrap(), materials());
    let html = page(folder.path(), "printed", Some(Figures::All), all.each_ref());
    let mut page = Page::open_until(&html, [1000, 900], READY);
    let shown = "svbrdf.gallery.pictures.map(({ image, canvas }) => [image.hidden, canvas.hidden])";
    let first = page.evaluate("svbrdf.gallery.scene");
    page.evaluate(
        "addEventListener('click', (e) => { window.followed = !e.defaultPrevented; e.preventDefault(); })",
    );
    let at = page.place("[data-picture='0']");
    page.drag("left", 0, at, at);
    assert_eq!(page.evaluate("[window.followed, svbrdf.gallery.scene]"), json!([true, first]));
    page.drag("left", 0, at, [at[0] + 30.0, at[1]]);
    assert_ne!(page.evaluate("svbrdf.gallery.scene"), first);
    assert_eq!(page.evaluate("window.followed"), json!(false));
    page.evaluate("document.querySelector('[data-picture]').closest('a').focus()");
    page.press("Enter", 0);
    assert_eq!(page.evaluate("window.followed"), json!(true), "a key follows the link after a drag");
    let wait = "new Promise(done => setTimeout(done, 500))";
    page.evaluate(wait);
    assert_eq!(page.after_frame(shown), json!(vec![[true, false]; 4]));
    page.evaluate("document.querySelector('#relight button').click()");
    assert_eq!(page.after_frame(shown), json!(vec![[false, true]; 4]));
    assert_eq!(page.evaluate("svbrdf.gallery.scene"), first);
    page.evaluate("document.querySelector('[data-picture]').closest('a').focus()");
    page.press("ArrowLeft", 4);
    assert_eq!(page.evaluate("svbrdf.gallery.scene"), first, "a key of the browser");
    page.press("ArrowLeft", 0);
    let moved = page.evaluate("svbrdf.gallery.scene.light[0]").as_f64().unwrap();
    assert!((moved - (first["light"][0].as_f64().unwrap() - 0.1)).abs() < 1e-9, "{moved}");
    let (requests, complaints) = page.traffic();
    assert!(requests.iter().all(|address| !address.starts_with("http")), "{requests:?}");
    assert!(complaints.is_empty(), "{complaints:?}");
}

/// A program with these words, in a folder.
fn run(folder: &Path, program: &str, words: &str) {
    let status = command(program).args(words.split(' ')).current_dir(folder).status().unwrap();
    assert!(status.success(), "{program} {words}");
}

#[test]
#[ignore = "writes assets/pictures/ranking.jpg: cargo xtask bless report-picture"]
fn write_the_picture_of_the_ranking() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = tempfile::tempdir().unwrap();
    run(folder.path(), "python3", root.join("python/examples/make_materials.py").to_str().unwrap());
    let rank = "rank --dataset gt soft plain sharp --read sharp:roughness=alpha --figures all -o r.html";
    run(folder.path(), env!("CARGO_BIN_EXE_svbrdf"), rank);
    let html = std::fs::read_to_string(folder.path().join("r.html")).unwrap();
    let mut page = Page::open_until(&html, [1100, 860], READY);
    page.evaluate("document.querySelector('.gallery').scrollIntoView()");
    let place = "(() => { const r = svbrdf.gallery.pictures[1].image.getBoundingClientRect(); \
                 return [r.left + r.width / 2, r.top + r.height / 2]; })()";
    let [x, y] = serde_json::from_value(page.evaluate(place)).unwrap();
    page.drag("left", 0, [x, y], [x - 40.0, y - 30.0]);
    page.save_jpeg(&root.join("assets/pictures/ranking.jpg"));
}

#[test]
fn only_pictures_with_a_figure_are_relit() {
    let (folder, all) = (tempfile::tempdir().unwrap(), materials());
    let html = |figures| page(folder.path(), "printed", figures, all.each_ref());
    let [none, worst, every] = [None, Some(Figures::Worst(1)), Some(Figures::All)].map(html);
    let count = |page: &str| page.matches(" data-picture=").count();
    assert_eq!([&none, &worst, &every].map(|page| count(page)), [0, 2, 4]);
    assert!(!none.contains("relight\"") && !none.contains("class Gallery"));
    assert!(worst.contains("the light of all pictures with a link moves"));
    assert!(every.contains("the light of all pictures moves"));
}
