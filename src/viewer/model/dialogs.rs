//! Dialogs, each with what is typed and chosen in it so far.

use std::path::{Path, PathBuf};

/// The dialogs that are open.
#[derive(Clone, Debug, Default)]
pub struct Dialogs {
    pub open: Option<OpenDialog>,
    pub save: Option<SaveDialog>,
}

impl Dialogs {
    /// Whether a dialog is open: the panes behind it do not move.
    pub fn is_open(&self) -> bool {
        self.open.is_some() || self.save.is_some()
    }
}

/// What went wrong with the path of a dialog, and where its cursor is.
#[derive(Clone, Debug, Default)]
pub struct PathField {
    pub problem: Option<String>,
    /// Whether the field has been given the focus.
    pub focused: bool,
}

impl PathField {
    /// Shows what went wrong, and puts the cursor into the field.
    pub fn fail(&mut self, problem: String) {
        *self = Self { problem: Some(problem), focused: false };
    }
}

/// The dialog that opens materials.
#[derive(Clone, Debug, Default)]
pub struct OpenDialog {
    /// One path a line.
    pub text: String,
    pub opens: Opens,
    /// Whether its materials have been asked for.
    pub submitted: bool,
    /// The number of the opening that reads its materials.
    pub opening: Option<u64>,
    pub field: PathField,
}

/// What the paths are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Opens {
    #[default]
    Comparison,
    Predictions,
    Dataset,
    Photograph,
}

impl OpenDialog {
    /// Shows what went wrong, and puts the cursor into the path field.
    pub fn fail(&mut self, problem: String) {
        self.field.fail(problem);
        (self.submitted, self.opening) = (false, None);
    }

    /// Adds a path as a line of its own.
    pub fn add(&mut self, path: &Path) {
        if !self.text.is_empty() && !self.text.ends_with('\n') {
            self.text.push('\n');
        }
        self.text += &path.display().to_string();
    }

    pub fn paths(&self) -> Vec<PathBuf> {
        self.text.lines().map(str::trim).filter(|line| !line.is_empty()).map(PathBuf::from).collect()
    }
}

/// The dialog that saves.
#[derive(Clone, Debug)]
pub struct SaveDialog {
    pub path: String,
    pub what: SaveKind,
    /// The path of an existing file, once the dialog has said that it exists.
    pub replaces: Option<String>,
    /// Whether the button gets the focus, so that Return presses it.
    pub focus_button: bool,
    pub field: PathField,
}

impl SaveDialog {
    /// `what` is chosen at first.
    pub fn new(what: SaveKind) -> Self {
        let path = what.proposal().to_owned();
        Self { path, what, replaces: None, focus_button: false, field: PathField::default() }
    }

    /// Puts a path into the field. That a file exists, the dialog of the system has asked.
    pub fn fill(&mut self, path: &Path) {
        self.path = path.display().to_string();
        self.replaces = Some(self.path.clone()).filter(|_| path.exists());
        self.field.problem = None;
    }

    /// The file to write; `None` where it exists and the dialog has not said so yet.
    pub fn confirmed(&mut self) -> Option<PathBuf> {
        let path = PathBuf::from(self.path.trim());
        if path.exists() && self.replaces.as_deref() != Some(self.path.trim()) {
            self.replaces = Some(self.path.trim().to_owned());
            self.focus_button = true;
            return None;
        }
        self.field.problem = None;
        Some(path)
    }
}

/// A file that is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SaveRequest {
    pub kind: SaveKind,
    pub path: PathBuf,
}

/// What is saved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SaveKind {
    #[default]
    View,
    Renderings,
    Strip,
    Session,
    Scenes,
    Materials,
}

impl SaveKind {
    /// The kinds of a single comparison.
    pub const ALL: [Self; 5] = [Self::View, Self::Renderings, Self::Strip, Self::Session, Self::Scenes];

    /// The one of a data set beside them.
    pub const OF_DATASET: [Self; 1] = [Self::Materials];

    /// The label of its button.
    pub fn name(self) -> &'static str {
        self.texts()[0]
    }

    /// The name that the dialog proposes.
    pub fn proposal(self) -> &'static str {
        self.texts()[1]
    }

    /// What the file holds.
    pub fn explanation(self) -> &'static str {
        self.texts()[2]
    }

    fn texts(self) -> [&'static str; 3] {
        match self {
            Self::View => [
                "View",
                "svbrdf-view.png",
                "The panes and the legend as they are seen, with light, view, exposure and convention in the file's \
                 metadata.",
            ],
            Self::Renderings => [
                "Renderings",
                "svbrdf-renderings.png",
                "The rendering, map or difference that is selected, of every material side by side, one pixel per texel; \
                 the same as `svbrdf render` writes. PNG as displayed, EXR as linear floats.",
            ],
            Self::Strip => [
                "Strip",
                "svbrdf-strip.png",
                "A labelled figure: a row per material; all maps, the rendering and its difference in columns; a rectangle \
                 (Q) framed and magnified; the same as `svbrdf strip` writes.",
            ],
            Self::Session => [
                "Session",
                "comparison.svbrdf-session.json",
                "Paths of the files (relative to this one), assumptions, scene, display and loss settings. `svbrdf` opens \
                 it, and so does Open; `svbrdf report` makes a page of it.",
            ],
            Self::Scenes => [
                "Scenes",
                "scenes.json",
                "The scenes that the tab Why lists for the chosen prediction, worst first, with their losses. Open takes \
                 them as the scenes of the loss, and so does --scenes of `svbrdf`.",
            ],
            Self::Materials => [
                "List",
                "materials.csv",
                "The materials that are listed, in their order, as CSV: mark, note and the loss of each method.",
            ],
        }
    }
}
