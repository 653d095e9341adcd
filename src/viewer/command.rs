//! What a person can do, as values: panels and keys return commands, the application carries them out.

use std::path::PathBuf;

use super::loss_settings::LossSettings;
use super::panels::study::Setting;
use super::state::{End, Layout};
use crate::files::read::ReadOptions;
use crate::model::scene::Scene;
use crate::picture::content::Shown;

/// One act. Nothing else changes the model.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Open materials: the first as ground truth where there is none or where `replace` is set, the others as predictions.
    Open {
        paths: Vec<PathBuf>,
        replace: bool,
        read: ReadOptions,
    },
    /// Ask for files or a folder with the system's dialog; what is chosen fills the open window's path field.
    Browse {
        folder: bool,
    },
    ShowOpen(bool),
    OpenBuiltIn,
    Reload,
    /// Read material `slot` again under other assumptions.
    ReadAs {
        slot: usize,
        read: ReadOptions,
    },
    /// Keep what is said about material `slot` in a file beside it.
    Keep {
        slot: usize,
    },
    ClosePrediction(usize),
    MakeGroundTruth(usize),
    SetWatch(bool),
    /// Resize predictions that are opened from now on to the ground truth.
    SetFit(bool),

    SetScene(Scene),
    SetFoot(End, [f64; 2]),
    PutHighlight([f64; 2]),
    ScaleHeight(End, f64),
    ScaleDistance(End, f64),
    Orbit {
        end: End,
        /// Radians about the upright axis y.
        sideways: f64,
        /// Radians towards it.
        upwards: f64,
    },
    ToggleHighlightFollows,
    CopyScene,
    PasteScene(String),

    SetShown(Shown),
    CycleShown(isize),
    SetLayout(Layout),
    CycleLayout,
    ToggleProjection,
    SetExposure(f32),
    StepExposure(f32),
    Normalize,
    ToggleClipping,
    SetWipe(f32),
    SetConvention(&'static str),
    ChoosePrediction(usize),
    SwapSides,

    /// Magnify by a factor about a point of the pane (x right, y up in [-1, 1]).
    Zoom {
        factor: f32,
        at: [f32; 2],
    },
    Pan([f32; 2]),
    Fit,
    OneToOne,
    Reset,
    Undo,
    Redo,

    ComputeLoss,
    CancelLoss,
    SetAutoLoss(bool),
    SetLoss(LossSettings),
    CopyLoss,

    ShowStudy(bool),
    StartStudy,
    CancelStudy,
    /// Set the loss to what was clicked in the study.
    ChooseSetting(Setting),

    ShowSave(bool),
    /// Write the view to this file, as `svbrdf render` does.
    SaveView(PathBuf),
    SetDark(bool),
    ToggleSidePanel,
    SetHelp(bool),
    DismissMessage,
}
