//! The figure of a data set: materials in rows, methods in columns.

use std::path::PathBuf;

use svbrdf_core::loss::Request;
use svbrdf_core::material::Material;
use svbrdf_core::progress::Progress;
use svbrdf_core::text::line;
use svbrdf_evaluate::KeptAnswer;
use svbrdf_evaluate::dataset::{
    self, Case, CaseMaterials, DatasetReading, DatasetSettings, MaterialResult, Pick, counted_loss,
};
use svbrdf_evaluate::protocols::MaskSource;
use svbrdf_files::disk::inputs::check_output_of;
use svbrdf_files::export::Destination;
use svbrdf_files::export::strip::{Column, Crop, MethodRow, MethodStrip, Paper};

use crate::cli::args::{ComparisonArgs, refuse};
use crate::cli::job::{Job, NewJob};
use crate::cli::output::{CommandError, exit, stoppable, watched_on};
use crate::cli::rank::cases;

/// A millimetre in points.
const MILLIMETRE: f64 = 72.0 / 25.4;
/// Pixels of an inch in a cell: as printed.
const DPI: f64 = 300.0;

#[derive(Debug)]
pub struct MethodsJob {
    settings: DatasetSettings,
    reading: DatasetReading,
    cases: Vec<Case>,
    results: Option<PathBuf>,
    output: PathBuf,
    destination: Destination,
    strip: MethodStrip,
    height_mm: Option<f64>,
}

/// How the figure looks.
#[derive(Debug)]
pub struct Look {
    pub columns: Vec<Column>,
    pub exposure_ev: Option<f32>,
    pub crops: Vec<Crop>,
    pub paper: Paper,
    pub height_mm: Option<f64>,
}

/// The job of the figure of a data set, which shows one column in each cell; GT may be a table of pairs.
pub fn job(
    (comparison, mask): (&ComparisonArgs, Option<MaskSource>),
    (is_table, chosen): (bool, &[String]),
    look: Look,
    results: Option<PathBuf>,
    output: PathBuf,
) -> NewJob {
    let destination = Destination::of_figure(&output)?;
    let given = &comparison.materials.reading;
    let reason =
        "a figure tells what cannot be read, and `svbrdf rank --dataset --verbose` all that is noticed";
    refuse(given.both.verbose, "verbose", reason)?;
    let Look { columns, exposure_ev, crops, paper, height_mm } = look;
    let [column] = columns.as_slice() else {
        return Err(CommandError::usage(
            "a figure of methods shows one thing in one scene; give one of --columns, such as rendering or rendering:log",
        ));
    };
    let source = cases::source(&comparison.materials, is_table)?;
    let cases = source.cases()?;
    let chosen_convention = comparison.convention.clone().unwrap_or_default();
    let convention = chosen_convention.convention;
    let settings = DatasetSettings::new(source, chosen_convention, Request::over_all_scenes(0), &cases);
    let reading = DatasetReading { mask, ..cases::reading(given, &settings.methods)? };
    let reading = dataset::decided(&cases, reading, &Progress::default())?;
    let cases = if chosen.is_empty() { cases } else { of_names(cases, chosen)? };
    let mut content = column.content;
    if let Some(difference) = &mut content.difference {
        difference.range = Some(difference.range.unwrap_or_else(|| difference.kind.default_range()));
    }
    let scene = column.scene;
    let strip = MethodStrip { content, scene, convention, exposure_ev, crops, paper, dpi: DPI };
    Ok(Box::new(MethodsJob { settings, reading, cases, results, output, destination, strip, height_mm }))
}

/// The cases of these materials, in their order.
fn of_names(cases: Vec<Case>, names: &[String]) -> Result<Vec<Case>, CommandError> {
    let of = |name: &String| {
        let missing = || {
            let known: Vec<&str> = cases.iter().map(|case| case.material.as_str()).collect();
            CommandError::Usage(format!(
                "--materials: there is no material {name}; the names are {}",
                line(&known.join(", "))
            ))
        };
        cases.iter().find(|case| case.material == *name).cloned().ok_or_else(missing)
    };
    names.iter().map(of).collect()
}

/// The most height of a figure on a page, in millimetres.
const PAGE_MM: f64 = 230.0;

/// Reads the materials, looks up or computes the losses where they are asked for, and writes the figure.
impl Job for MethodsJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let predictions = self.cases.iter().flat_map(|case| case.candidates.iter().map(|one| &one.path));
        check_output_of(&self.output, self.cases.iter().map(|case| &case.ground_truth).chain(predictions))?;
        stoppable(|progress| self.write(progress))
    }
}

impl MethodsJob {
    fn write(&self, progress: &Progress) -> Result<(), CommandError> {
        let Self { settings, reading, cases, results, strip, destination, .. } = self;
        let (losses, unkept) = match results {
            None => (Vec::new(), None),
            Some(folder) => {
                let KeptAnswer { answer, notes, unkept } =
                    watched_on(progress, "comparing materials", |progress| {
                        dataset::run(cases, settings, reading, Some(folder), progress)
                    })?;
                notes.iter().for_each(|note| exit::tell(&format!("note: {note}")));
                (answer, unkept)
            }
        };
        let methods = &settings.methods;
        let materials: &Vec<String> = &cases.iter().map(|case| case.material.clone()).collect();
        let row = |index: usize| self.row(&cases[index], losses.get(index));
        let strip = match self.height_mm {
            None => strip,
            Some(most) => {
                let size = |case| Some(self.opened(case).materials.first()?.as_ref().ok()?.size());
                let sizes: Vec<_> = cases.iter().map(size).collect();
                &strip.within(most, (methods, materials), &sizes, results.is_some())?
            }
        };
        let figure =
            watched_on(progress, "rendering", |progress| strip.figure(methods, materials, row, progress))?;
        let height_mm = figure.size[1] / MILLIMETRE;
        if height_mm > PAGE_MM {
            exit::tell(&format!(
                "note: the figure is {height_mm:.0} mm high, more than the {PAGE_MM} mm of a page; give --height-mm, or some of the \
                 {} materials by --materials",
                materials.len()
            ));
        }
        destination.write_figure(&figure, &strip.entries(methods, materials), progress)?;
        unkept.map_or(Ok(()), |problem| Err(CommandError::Failed(problem)))
    }

    fn opened(&self, case: &Case) -> CaseMaterials {
        let of_method = |method: &String| case.candidates.iter().find(|one| one.method == *method);
        let candidates: Vec<_> = self.settings.methods.iter().map(of_method).collect();
        dataset::materials_of(case, &candidates, &self.reading)
    }

    /// A row; what cannot be read is told, and missing in the figure.
    fn row(&self, case: &Case, losses: Option<&MaterialResult>) -> MethodRow {
        let methods = &self.settings.methods;
        let CaseMaterials { materials, mask } = self.opened(case);
        let names = std::iter::once("ground truth").chain(methods.iter().map(String::as_str));
        let known = |(found, name): (Result<Material<f32>, String>, &str)| {
            let tell = |problem| exit::tell(&format!("note: {}, {name}: {problem}", case.material));
            found.map_err(tell).ok()
        };
        let materials = materials.into_iter().zip(names).map(known).collect();
        let text = |losses: &MaterialResult, method: &String| {
            counted_loss(losses, method, Pick::Fixed)
                .map_or_else(String::new, |known| format!("{:.3}", known.loss))
        };
        let texts = losses.map(|losses| {
            std::iter::once(String::new()).chain(methods.iter().map(|method| text(losses, method))).collect()
        });
        MethodRow { materials, mask, texts: texts.unwrap_or_default() }
    }
}
