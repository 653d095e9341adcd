//! Views of the materials of a ranking: pictures of all, and figures of some, in files beside the page.

use std::collections::{BTreeMap, BTreeSet};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::parallel;
use svbrdf_core::progress::Progress;
use svbrdf_files::Error;

use super::content::{PageReport, View};
use super::pictures::{self, exposure};
use super::ranking::MaterialView;
use svbrdf_evaluate::dataset::{
    Case, CaseMaterials, DatasetReport, MaterialResult, counted_loss, counted_sample, materials_of,
};
use svbrdf_files::disk::atomic::replace;
use svbrdf_files::disk::own;
use svbrdf_files::disk::paths::plain;
use svbrdf_files::session::window::SessionDisplay;

/// Light and view of pictures and figures.
const SCENE: Scene = Scene { kind: Kind::Near, view: [0.0, 0.0, 2.5], light: [0.4, 0.5, 1.2] };
/// Width of a picture, in pixels: of two for one of the page, and where there are many.
const PICTURE: [u32; 2] = [320, 160];
/// Most pictures of the larger width: a page has some 15 kB for each.
const LARGE: usize = 600;
/// Longest side of the maps that they are rendered from.
const RENDERED: usize = 512;
/// What is written as `%..` in an address.
const ENCODED: &AsciiSet = &NON_ALPHANUMERIC.remove(b'-').remove(b'_').remove(b'.');
/// Most bytes of a figure.
const FIGURE: usize = 2_000_000;

/// The materials of a ranking that have a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Figures {
    All,
    /// As many, those of the largest mean loss of all methods.
    Worst(usize),
}

impl FromStr for Figures {
    type Err = CoreError;

    fn from_str(text: &str) -> Result<Self, CoreError> {
        let count = text.strip_prefix("worst:").and_then(|count| count.parse().ok());
        match count.filter(|count| *count > 0) {
            Some(count) => Ok(Self::Worst(count)),
            None if text == "all" => Ok(Self::All),
            None => Err(CoreError::unknown_name(
                "choice of figures",
                text,
                "all, or worst:N with N from 1 on, such as worst:20",
            )),
        }
    }
}

/// Reads the materials of `cases` again, renders pictures and writes the figures of `figures` into a folder beside the `page`,
/// which is named after it. A material that cannot be read any more has neither. A material is one step of `progress`.
///
/// # Errors
/// [`Cancelled`](Error::is_cancelled), [`Error::Unwritable`].
pub fn material_views(
    report: &DatasetReport,
    cases: &[Case],
    figures: Option<Figures>,
    page: &Path,
    progress: &Progress,
) -> Result<Vec<MaterialView>, Error> {
    let look = (&report.settings.convention.convention, report.reading.mask.is_some());
    let chosen = figures.map_or_else(BTreeSet::new, |figures| chosen(report, figures));
    let folder = folder(page);
    if !chosen.is_empty() {
        own::folder(&folder)?;
    }
    let cases: BTreeMap<usize, &Case> = cases.iter().map(|case| (case.index, case)).collect();
    progress.begin(report.results.len() as u64);
    let count = report.results.len() * (1 + report.methods.len());
    let width = PICTURE[usize::from(count > LARGE)];
    let one = |index: usize| {
        let result = &report.results[index];
        let materials = cases.get(&result.index).and_then(|case| opened(report, result, case));
        let view = materials.map_or(Ok(MaterialView::default()), |materials| {
            let figure = chosen.contains(&result.index).then(|| folder.join(file_name(result)));
            view(&materials, look, width, figure.as_deref(), progress)
        })?;
        progress.step()?;
        Ok::<_, Error>(view)
    };
    parallel::try_map(report.results.len(), one)
}

/// The folder of the figures of a page.
fn folder(page: &Path) -> PathBuf {
    let mut name = page.file_stem().unwrap_or_default().to_owned();
    name.push("-figures");
    page.with_file_name(name)
}

/// The file of the figure of a material: its place in the data set, and of its name what every file system and address takes.
fn file_name(result: &MaterialResult) -> String {
    format!("{:04}-{}.html", result.index + 1, plain(&result.material))
}

/// The indices of the materials that have a figure.
fn chosen(report: &DatasetReport, figures: Figures) -> BTreeSet<usize> {
    let mean = |result: &MaterialResult| {
        let methods = report.methods.iter();
        let losses = methods.filter_map(|summary| counted_loss(result, &summary.method, report.pick));
        let losses: Vec<f64> = losses.map(|known| known.loss).collect();
        (!losses.is_empty()).then(|| (losses.iter().sum::<f64>() / losses.len() as f64, result.index))
    };
    let mut known: Vec<(f64, usize)> = report.results.iter().filter_map(mean).collect();
    known.sort_by(|a, b| b.0.total_cmp(&a.0));
    let count = match figures {
        Figures::All => known.len(),
        Figures::Worst(count) => count,
    };
    known.into_iter().take(count).map(|(_, index)| index).collect()
}

/// The ground truth, then for each method the prediction that counts, under the name of the method, where it can be read; `None` where
/// the ground truth cannot be read.
fn opened(
    report: &DatasetReport,
    result: &MaterialResult,
    case: &Case,
) -> Option<Vec<Option<Material<f32>>>> {
    let candidate = |method: &String| {
        let sample = counted_sample(result, method, report.pick)?;
        case.candidates.iter().find(|one| one.method == *method && one.sample == sample)
    };
    let methods: Vec<&String> = report.methods.iter().map(|summary| &summary.method).collect();
    let candidates: Vec<_> = methods.iter().map(|method| candidate(method)).collect();
    let CaseMaterials { materials, mask } = materials_of(case, &candidates, &report.reading);
    let names = std::iter::once(&result.material).chain(methods);
    let named = |(one, name): (Result<Material<f32>, String>, &String)| {
        let one = one.ok()?.renamed(name);
        Some(match &mask {
            Some(mask) => one.gray_outside(mask),
            None => one,
        })
    };
    let materials: Vec<_> = materials.into_iter().zip(names).map(named).collect();
    materials[0].is_some().then_some(materials)
}

/// The pictures of a material, under a convention, which may be gray outside of a mask; its figure is written to the file of `figure`.
fn view(
    all: &[Option<Material<f32>>],
    look: (&Convention, bool),
    width: u32,
    figure: Option<&Path>,
    progress: &Progress,
) -> Result<MaterialView, Error> {
    let materials: Vec<&Material<f32>> = all.iter().flatten().collect();
    let small = pictures::reduced(&materials, RENDERED)?;
    let drawn = look.0.drawn();
    let exposure_ev = exposure(&small[0], &SCENE, &drawn);
    let mut small = small.iter();
    let picture = |one: &Option<Material<f32>>| {
        let Some(small) = one.as_ref().and_then(|_| small.next()) else { return Ok(None) };
        pictures::thumbnail(small, &SCENE, &drawn, exposure_ev, width, &progress.part()).map(Some)
    };
    let pictures = all.iter().map(picture).collect::<Result<Vec<_>, Error>>()?;
    let figure = figure.map(|path| write_figure(path, &materials, look, exposure_ev, progress));
    Ok(MaterialView { pictures, figure: figure.transpose()? })
}

/// Writes the figure of `materials`; its address.
fn write_figure(
    path: &Path,
    materials: &[&Material<f32>],
    (convention, is_masked): (&Convention, bool),
    exposure_ev: f32,
    progress: &Progress,
) -> Result<String, Error> {
    let report = PageReport {
        materials,
        is_masked,
        convention: *convention,
        view: View { scene: SCENE, exposure_ev, display: SessionDisplay::default() },
        findings: None,
        readings: Vec::new(),
        command: None,
        max_bytes: FIGURE,
    };
    let page = report.page(&progress.part())?;
    // A link there is refused, since whoever made it did not mean this file.
    own::check(path)?;
    replace(path, progress, |file| file.write_all(page.html.as_bytes()))?;
    Ok(address(path))
}

/// The address of a figure, relative to the page beside its folder.
fn address(path: &Path) -> String {
    let part = |name: Option<&std::ffi::OsStr>| {
        utf8_percent_encode(&name.unwrap_or_default().to_string_lossy(), ENCODED).to_string()
    };
    let folder = path.parent().and_then(Path::file_name);
    format!("{}/{}", part(folder), part(path.file_name()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_all_or_the_worst() {
        assert_eq!("all".parse::<Figures>().unwrap(), Figures::All);
        assert_eq!("worst:20".parse::<Figures>().unwrap(), Figures::Worst(20));
        for wrong in ["", "worst", "worst:0", "worst:-1", "best:3"] {
            assert!(wrong.parse::<Figures>().unwrap_err().to_string().contains("worst:20"), "{wrong}");
        }
    }

    #[test]
    fn names_of_files_and_addresses_are_plain() {
        let result = MaterialResult {
            index: 6,
            material: "../wood/\"oak\" é<".to_owned(),
            seed: 0,
            reading: Vec::new(),
            floor: None,
            predictions: Vec::new(),
        };
        assert_eq!(file_name(&result), "0007-___wood__oak____.html");
        let folder = folder(Path::new("out/a page.html"));
        assert_eq!(folder, Path::new("out/a page-figures"));
        assert_eq!(address(&folder.join("0001-x.html")), "a%20page-figures/0001-x.html");
    }
}
