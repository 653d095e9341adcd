//! Commands: what can be done in the window, as values. Input, panels and dialogs return them; the model carries them out.
//!
//! One enum per part of the application, so that the compiler asks for every arm.

use std::path::PathBuf;

pub mod dataset;
pub mod effect;

pub use dataset::DatasetCommand;

use svbrdf_core::loss::LossSettings;
use svbrdf_core::material::Map;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_evaluate::diagnose::Change;
use svbrdf_files::convention::ChosenConvention;
use svbrdf_files::read::{ReadOptions, Transfer};

use super::inspection::Region;
use super::settings::Tab;
use super::settings::save_kind::SaveRequest;
use super::settings::why::WhySection;
use super::view::state::{AutoExposure, Layout};
use svbrdf_core::model::scene::Endpoint;
use svbrdf_files::source::MaterialSource;

/// One act. Nothing else changes the model.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    Materials(MaterialsCommand),
    Scene(SceneCommand),
    Display(DisplayCommand),
    Loss(LossCommand),
    Window(WindowCommand),
    Inspection(InspectionCommand),
    Why(WhyCommand),
    Photograph(PhotographCommand),
    Dataset(DatasetCommand),
}

/// Files and materials.
#[derive(Clone, Debug, PartialEq)]
pub enum MaterialsCommand {
    /// Opens materials: the first as ground truth where there is none or where `replace` is set, the others as
    /// predictions.
    Open {
        paths: Vec<PathBuf>,
        replace: bool,
        read: ReadOptions,
    },
    /// Opens a prediction that was refused or closed.
    OpenAgain(Box<MaterialSource>),
    /// Lets files name others by absolute paths from now on, and opens these, which were refused for that.
    AllowOutside {
        paths: Vec<PathBuf>,
        read: ReadOptions,
    },
    OpenBuiltIn,
    /// Cancels the opening of this number.
    CancelReading(u64),
    /// Opens the recent comparison in this place.
    Reopen(usize),
    /// Reads all files again.
    Reload,
    /// Reads the material at this index again under other assumptions.
    ReadAs {
        index: usize,
        read: ReadOptions,
    },
    /// Saves the assumptions specified for the material at this index in a sidecar file.
    SaveAssumptions {
        index: usize,
    },
    /// Closes the prediction at this index.
    Close(usize),
    /// Makes the material at this index the ground truth.
    MakeGroundTruth(usize),
    /// Whether files that change on disk are read again.
    SetWatch(bool),
}

/// Light, view and convention.
#[derive(Clone, Debug, PartialEq)]
pub enum SceneCommand {
    Set(Scene),
    /// Shows a scene that was picked from a list, and exposes for it where the exposure is automatic.
    Choose(Scene),
    /// Makes the scene near-field or distant; light and view keep their directions and distances.
    SetKind(Kind),
    /// Moves an endpoint so that its projection onto the plane is at (x, y).
    MoveOverPlane(Endpoint, [f64; 2]),
    /// Moves the light so that its mirror highlight is at (x, y) of the plane.
    PutHighlight([f64; 2]),
    ScaleHeight(Endpoint, f64),
    ScaleDistance(Endpoint, f64),
    Orbit {
        endpoint: Endpoint,
        /// Radians about the upright axis y.
        sideways: f64,
        /// Radians towards it.
        upwards: f64,
    },
    ToggleHighlightFollows,
    SetConvention(ChosenConvention),
    /// Puts the scene on the clipboard as a scene file.
    Copy,
    /// Takes the scene of this text of the clipboard.
    Paste(String),
}

/// What the panes show, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DisplayCommand {
    SetQuantity(Quantity),
    CycleQuantity(isize),
    /// Whether panes show the difference or the value.
    ShowDifference(bool),
    /// Chooses a difference of the quantity.
    SetDifference(Difference),
    /// Chooses the error map as the difference of renderings.
    ChooseErrorMap,
    /// Sets the difference that has the last colour; `None` makes it automatic.
    SetRange(Option<f64>),
    SetLayout(Layout),
    CycleLayout,
    ToggleProjection,
    SetExposure(f32),
    StepExposure(f32),
    /// Whether the exposure is automatic; it is computed at once.
    AutoExposure(AutoExposure),
    ToggleClipping,
    /// Shows roughness in false colours, or not.
    ToggleFalseColour,
    SetWipe(f32),
    ChoosePrediction(usize),
    /// Shows the chosen prediction with this map alone wrong, or right; `None` shows the prediction itself.
    Isolate(Option<Map>),
    /// Shows the chosen prediction with a change that a diagnosis found; `None` shows the prediction itself.
    Correct(Option<Change>),
    /// Whether the isolated map is the only right one, and not the only wrong one.
    SetOnlyRight(bool),
    /// Chooses the prediction this many places on, around the end.
    StepPrediction(isize),
    /// Ground truth and chosen prediction change places.
    Swap,
    /// Magnifies by a factor about a point of the pane (x right, y up in [-1, 1]).
    Zoom {
        factor: f32,
        at: [f32; 2],
    },
    Pan([f32; 2]),
    Fit,
    OneToOne,
    /// Shows a texel in this many pixels.
    SetMagnification(f32),
    Reset,
    Undo,
    Redo,
}

/// The loss.
#[derive(Clone, Debug, PartialEq)]
pub enum LossCommand {
    Compute,
    Cancel,
    /// Whether the loss is computed again after every change.
    SetAuto(bool),
    SetSettings(LossSettings),
    /// Puts the losses on the clipboard as text.
    Copy,
    /// Whether it is asked if the order of the predictions, or of the methods, survives other questions.
    AskOrder(bool),
    /// Removes the scenes of the file that was opened.
    RemoveFileScenes,
}

/// What the file dialog of the system is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BrowseFor {
    Files,
    Folders,
    /// A file to save.
    Saving,
}

/// The window itself and its dialogs.
#[derive(Clone, Debug, PartialEq)]
pub enum WindowCommand {
    ShowOpen(bool),
    /// Asks with the system's dialog; the choice goes into the path field of the dialog that is open.
    Browse(BrowseFor),
    ShowSave(bool),
    /// Shows the dialog that saves the scenes of the loss.
    SaveScenes,
    /// Writes to a file.
    Save(SaveRequest),
    /// Cancels what is being written.
    CancelSaving,
    /// Puts the view on the clipboard as a picture.
    CopyPicture,
    SetDark(bool),
    /// Sets the size of text and controls: 1 is the size of the system.
    SetScale(f32),
    ToggleSidePanel,
    ChooseTab(Tab),
    ShowHelp(bool),
    /// Dismisses the message of this number.
    DismissMessage(usize),
    DismissMessages,
}

/// Texels that are looked at closely.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InspectionCommand {
    /// Pins the texel (column, row), or removes its pin.
    TogglePin([usize; 2]),
    /// Pins the texel under the pointer, or removes its pin; without one, the texel last under it.
    TogglePinHere,
    ClearPins,
    /// Whether the next left-drag draws a rectangle.
    Arm(bool),
    SetRegion(Option<Region>),
}

/// The questions of the tab *Why*.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WhyCommand {
    /// Unfolds or folds a section.
    ShowSection(WhySection, bool),
    /// Lists this many scenes, the worst first.
    ListScenes(usize),
    /// Searches the worst scene of the chosen prediction, and shows it.
    FindWorst,
    CancelSearch,
}

/// The photograph that renderings are compared with.
#[derive(Clone, Debug, PartialEq)]
pub enum PhotographCommand {
    /// Compares renderings with the photograph at this path, under the light and view of the window; or with the first of those that a
    /// folder or a JSON file lists, under its own.
    Open(PathBuf),
    /// Compares with the one of this number of those that are listed, under its light and view.
    Choose(usize),
    /// Compares with the ground truth again.
    Close,
    /// `None`: by the file.
    SetTransfer(Option<Transfer>),
    /// Whether the falloff of the light is divided out.
    SetFalloff(bool),
}

macro_rules! from_parts {
    ($($part:ident: $command:ty,)*) => {
        $(impl From<$command> for Command {
            fn from(command: $command) -> Self {
                Self::$part(command)
            }
        })*
    };
}

from_parts! {
    Materials: MaterialsCommand,
    Scene: SceneCommand,
    Display: DisplayCommand,
    Loss: LossCommand,
    Window: WindowCommand,
    Inspection: InspectionCommand,
    Why: WhyCommand,
    Photograph: PhotographCommand,
    Dataset: DatasetCommand,
}
