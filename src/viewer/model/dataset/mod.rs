//! Data set: methods over many materials, one of which is in the window.

pub mod list;
pub mod session;

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use svbrdf_core::loss::Request;
use svbrdf_evaluate::dataset::{CandidateFile, Case, DatasetReading, DatasetSettings, Source};
use svbrdf_evaluate::registration::Registration;
use svbrdf_files::convention::ChosenConvention;
use svbrdf_files::session::dataset::SessionMark;
use svbrdf_files::source::{MaterialSource, Place};

use crate::error::Error;
use crate::model::dataset::list::ListView;
use crate::model::material::read::Rules;

/// The most predictions of one ground truth that have a pane each; more are a list.
pub const MOST_PANES: usize = 24;
/// The most predictions of the list that are pinned beside the chosen one.
const MOST_PINNED: usize = 8;

/// A data set as it was opened: names are matched, pixels are read when they are needed.
#[derive(Clone, Debug, PartialEq)]
pub struct OpenDataset {
    /// But for the convention, which is that of the window.
    pub settings: DatasetSettings,
    pub reading: DatasetReading,
    pub cases: Vec<Case>,
    /// The folder of losses that are known, to which new ones are added.
    pub results: Option<PathBuf>,
    /// The registrations that a person has declined, by the name of the method, each with the line of its decision.
    pub declined: BTreeMap<String, (Registration, Option<String>)>,
}

impl OpenDataset {
    /// Matches the materials of `source`, whose losses are those of the `request`.
    ///
    /// # Errors
    /// Those of [`Source::cases`].
    pub fn new(
        source: Source,
        reading: DatasetReading,
        request: Request,
        results: Option<PathBuf>,
    ) -> Result<Self, Error> {
        let cases = source.cases()?;
        let settings = DatasetSettings::new(source, ChosenConvention::default(), request, &cases);
        Ok(Self { settings, reading, cases, results, declined: BTreeMap::new() })
    }

    /// The predictions of one ground truth as a list of them, where they are too many to be seen at once and all are files that are
    /// read alike; `all` begins with the ground truth.
    pub fn of_many(all: &[MaterialSource], rules: &Rules) -> Option<Self> {
        let [truth, predictions @ ..] = all else { return None };
        let first = predictions.first()?;
        let is_file = |one: &MaterialSource| matches!(one.place, Place::Path(_)) && !one.fit;
        let are_alike = all.iter().all(is_file) && predictions.iter().all(|one| one.options == first.options);
        if predictions.len() <= MOST_PANES || !are_alike || rules.fit || rules.mask.is_some() {
            return None;
        }
        let named = predictions.iter().map(|one| (one.name.clone(), one.location().to_owned()));
        let source = Source::predictions(truth.location().to_owned(), named.collect());
        let reading = DatasetReading {
            ground_truths: truth.options,
            predictions: first.options,
            strict: rules.strict,
            ..DatasetReading::default()
        };
        Self::new(source, reading, Request::over_all_scenes(0), None).ok()
    }

    /// Whether its materials are predictions of one ground truth.
    pub fn is_of_predictions(&self) -> bool {
        matches!(self.settings.source, Source::Predictions { .. })
    }

    /// The slot of a prediction, which gives its number and its colour: that of its method, or its place among the predictions of one
    /// material; 0 of a ground truth.
    pub fn slot(&self, case: usize, column: usize) -> usize {
        if self.is_of_predictions() && column > 0 { case + 1 } else { column }
    }

    /// What a row of its list is.
    pub fn noun(&self) -> &'static str {
        if self.is_of_predictions() { "prediction" } else { "material" }
    }

    pub fn methods(&self) -> &[String] {
        &self.settings.methods
    }

    /// How the predictions of the method in a column are registered.
    pub fn registration(&self, column: usize) -> Option<Registration> {
        self.reading.registrations.get(self.methods().get(column.checked_sub(1)?)?).copied()
    }

    /// The name of a material.
    pub fn name(&self, case: usize) -> &str {
        self.cases.get(case).map_or("", |case| &case.material)
    }

    /// The ground truth of a material, in column 0, or its prediction by a method, from column 1 on.
    ///
    /// # Errors
    /// Why there is none.
    pub fn source(&self, case: usize, column: usize) -> Result<MaterialSource, String> {
        let case = self.cases.get(case).ok_or("there is no such material")?;
        let Some(method) = column.checked_sub(1) else {
            let read = self.reading.ground_truths;
            let name = (!self.is_of_predictions()).then(|| case.material.clone());
            return Ok(MaterialSource { name, ..MaterialSource::path(case.ground_truth.clone(), read) });
        };
        let method = self.methods().get(method).ok_or("there is no such method")?;
        let CandidateFile { path, missing, .. } =
            case.candidates.iter().find(|one| one.method == *method).ok_or("not in the table")?;
        match missing {
            Some(problem) => Err(problem.clone()),
            None => {
                let read = *self.reading.of_method(method);
                let name = if self.is_of_predictions() { &case.material } else { method };
                Ok(MaterialSource { name: Some(name.clone()), ..MaterialSource::path(path.clone(), read) })
            }
        }
    }
}

/// The data set of the window, and what is shown of it.
#[derive(Clone, Debug, Default)]
pub struct DatasetState {
    /// `None` where a single comparison is open.
    pub open: Option<Arc<OpenDataset>>,
    /// The material that was asked for.
    pub wanted: usize,
    /// Those that are read ahead.
    pub ahead: Vec<usize>,
    /// The material that is in the window; `None` before the first.
    pub shown: Option<usize>,
    /// Whether that is read again.
    pub is_stale: bool,
    /// How often the files of each material were read again.
    pub versions: Arc<Vec<u64>>,
    /// The materials of rows in sight that have files which were written since.
    pub newer: BTreeSet<usize>,
    /// What the last frame had in sight.
    pub in_sight: InSight,
    /// What of it is not in the window.
    pub missing: Vec<Missing>,
    /// The method that was chosen last, which may have no prediction of the material in the window.
    pub method: Option<String>,
    pub list: ListView,
    /// Whether the search of the list is to have the focus.
    pub finds: bool,
    /// Marks and notes, by the name of a material.
    pub marks: BTreeMap<String, SessionMark>,
    pub table: TableState,
}

/// The materials in sight, as a worker looks at them.
#[derive(Clone, Debug, Default)]
pub struct InSight(Arc<Mutex<Vec<usize>>>);

impl InSight {
    pub fn get(&self) -> Vec<usize> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    pub fn set(&self, cases: &[usize]) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = cases.to_vec();
    }
}

/// A ground truth, or a prediction of it, that is not there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Missing {
    /// As that of a material in the window.
    pub slot: usize,
    pub name: String,
    pub problem: String,
}

/// The table of the data set.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TableState {
    /// Whether it has pictures, and takes the place of the panes.
    pub has_pictures: bool,
    /// Side of a picture, in points; `None` fits all columns into the window.
    pub cell: Option<f32>,
}

/// Least and greatest side of a picture, in points.
const CELL: std::ops::RangeInclusive<f32> = 32.0..=384.0;

impl From<OpenDataset> for DatasetState {
    /// A data set that has just been opened.
    fn from(open: OpenDataset) -> Self {
        let versions = Arc::new(vec![0; open.cases.len()]);
        let table = TableState { has_pictures: true, ..TableState::default() };
        Self { open: Some(Arc::new(open)), versions, table, ..Self::default() }
    }
}

impl DatasetState {
    /// Shows a material, and reads others ahead.
    pub fn show(&mut self, case: usize, ahead: Vec<usize>) {
        if self.open.as_ref().is_some_and(|open| case < open.cases.len()) {
            (self.wanted, self.ahead) = (case, ahead);
        }
    }

    /// How often the files of a material were read again.
    pub fn version(&self, case: usize) -> u64 {
        self.versions.get(case).copied().unwrap_or_default()
    }

    /// Reads the files of a material again, with its losses.
    pub fn read_again(&mut self, case: usize) {
        // It may be the ground truth of all.
        let has_all = self.open.as_ref().is_some_and(|open| open.is_of_predictions());
        let versions = Arc::make_mut(&mut self.versions).iter_mut().enumerate();
        versions.filter(|(of, _)| has_all || *of == case).for_each(|(_, version)| *version += 1);
        self.newer.retain(|of| !has_all && *of != case);
        self.is_stale |= has_all || self.wanted == case;
    }

    /// Compares the predictions of a method in the registration that the maps have decided, or declines it.
    pub fn register(&mut self, method: &str, is_accepted: bool) {
        let Some(mut open) = self.open.as_deref().cloned() else { return };
        let DatasetReading { registrations, decisions, .. } = &mut open.reading;
        if let Some((way, line)) = open.declined.remove(method).filter(|_| is_accepted) {
            registrations.insert(method.to_owned(), way);
            decisions.splice(0..0, line);
        } else if let Some(way) = registrations.remove(method) {
            let begin = format!("{method}: {way} of ");
            let line = decisions.iter().position(|line| line.starts_with(&begin));
            let line = line.map(|line| decisions.remove(line));
            open.declined.insert(method.to_owned(), (way, line));
        }
        (self.open, self.is_stale) = (Some(Arc::new(open)), true);
    }

    /// Puts the table with pictures in the place of the panes, or the panes in its.
    pub fn show_table(&mut self, has_pictures: bool) {
        self.table.has_pictures = has_pictures && self.open.is_some();
    }

    /// Sets the side of a picture of the table, in points, and returns it within its range.
    pub fn set_cell(&mut self, cell: f32) -> f32 {
        *self.table.cell.insert(cell.clamp(*CELL.start(), *CELL.end()))
    }

    /// Marks the material in the window, or removes its mark.
    pub fn toggle_mark(&mut self) {
        let before = self.pinned();
        self.change_mark(|mark| mark.is_marked ^= true);
        self.is_stale |= self.pinned() != before;
    }

    /// Changes the mark of the material in the window; one without anything is removed.
    pub fn change_mark(&mut self, change: impl FnOnce(&mut SessionMark)) {
        let Some(name) = self.name().map(str::to_owned) else { return };
        change(self.marks.entry(name).or_default());
        self.marks.retain(|_, mark| mark.is_marked || !mark.note.is_empty());
    }

    /// The name of the material that was asked for.
    pub fn name(&self) -> Option<&str> {
        self.open.as_ref().map(|open| open.name(self.wanted))
    }

    /// Whether the material that was asked for is still being read.
    pub fn is_waiting(&self) -> bool {
        self.open.is_some() && (self.is_stale || self.shown != Some(self.wanted))
    }

    /// The predictions of the list that have a pane beside the chosen one: those that are marked.
    pub fn pinned(&self) -> Vec<usize> {
        let Some(open) = self.open.as_ref().filter(|open| open.is_of_predictions()) else {
            return Vec::new();
        };
        let is_marked = |case: &usize| self.mark(open.name(*case)).is_some_and(|mark| mark.is_marked);
        (0..open.cases.len()).filter(is_marked).take(MOST_PINNED).collect()
    }

    /// The material and the method of a slot of the window.
    pub fn place(&self, slot: usize) -> Option<(usize, usize)> {
        let (open, slot) = (self.open.as_ref()?, slot.checked_sub(1)?);
        Some(if open.is_of_predictions() { (slot, 0) } else { (self.shown?, slot) })
    }

    pub fn mark(&self, name: &str) -> Option<&SessionMark> {
        self.marks.get(name)
    }
}
