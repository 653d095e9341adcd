//! Commands about the photograph that renderings are compared with.

use std::path::Path;

use crate::error::Error;
use crate::files::session::SessionPhotograph;
use crate::model::scene::Scene;
use crate::model::scene_file;
use crate::photograph::flash;
use crate::picture::difference::Difference;
use crate::picture::quantity::Quantity;
use crate::viewer::app::App;
use crate::viewer::command::{Command, PhotographCommand, PhotographLight};
use crate::viewer::message::Message;
use crate::viewer::panels::photograph_open::PhotographWindow;

impl From<PhotographCommand> for Command {
    fn from(command: PhotographCommand) -> Self {
        Self::Photograph(command)
    }
}

impl App {
    pub(super) fn apply_to_photograph(&mut self, command: PhotographCommand) {
        match command {
            PhotographCommand::ShowOpen(on) => {
                self.photograph_window = on.then(PhotographWindow::default);
            }
            PhotographCommand::Fill(path) => {
                if let Some(window) = &mut self.photograph_window {
                    window.path = path.display().to_string();
                }
            }
            PhotographCommand::Open { photograph, light } => self.open_photograph(photograph, &light),
            PhotographCommand::Close => self.photograph.set(None),
            PhotographCommand::SetTransfer(transfer) => {
                if let Some(source) = self.photograph.source_mut() {
                    source.read.transfer = transfer;
                }
            }
            PhotographCommand::SetFalloff(on) => {
                if let Some(source) = self.photograph.source_mut() {
                    source.falloff = on;
                }
            }
            PhotographCommand::EditCorners(on) => {
                self.photograph.edit_corners(on);
                if on {
                    self.compare_with_photograph();
                }
            }
            PhotographCommand::SetCorners(corners) => {
                if let Some(source) = self.photograph.source_mut() {
                    source.corners = corners.map(|corners| corners.0);
                }
            }
        }
    }

    /// Compares renderings with a photograph, under its light and view.
    fn open_photograph(&mut self, photograph: SessionPhotograph, light: &PhotographLight) {
        let scene = match light {
            PhotographLight::AsNow => Ok(self.state.scene),
            PhotographLight::Flash { fov_degrees } => flash(*fov_degrees),
            PhotographLight::File { path, number } => scene_of(path, *number),
        };
        match (scene, &mut self.photograph_window) {
            (Ok(scene), _) => {
                self.photograph_window = None;
                self.show_photograph(photograph, Some(scene));
            }
            (Err(error), Some(window)) => window.fail(error.to_string()),
            (Err(error), None) => self.report([Message::Failed(error)]),
        }
    }

    /// Compares renderings with a photograph; `None` keeps light and view.
    pub(in crate::viewer) fn show_photograph(&mut self, photograph: SessionPhotograph, scene: Option<Scene>) {
        self.photograph.set(Some(photograph));
        self.state.scene = scene.unwrap_or(self.state.scene);
        self.compare_with_photograph();
    }

    /// Shows what is compared with a photograph: renderings in one scene.
    fn compare_with_photograph(&mut self) {
        self.state.quantity = Quantity::Rendering;
        if self.state.is_error_map() {
            // It averages over scenes of which there is no photograph.
            self.state.differences.choose(Quantity::Rendering, Difference::Log);
        }
    }
}

/// Scene `number` of a file.
fn scene_of(path: &Path, number: usize) -> Result<Scene, Error> {
    let scenes = scene_file::read(path)?;
    let problem =
        format!("it lists {} scenes, counted from 0, and number {number} was asked for", scenes.len());
    scenes.get(number).copied().ok_or_else(|| Error::BadScene { path: path.to_owned(), problem })
}
