//! Saving and copying.

use std::io::Write as _;
use std::path::PathBuf;

use eframe::egui;

use crate::error::Error;
use crate::files::atomic;
use crate::picture::export::Provenance;
use crate::viewer::app::App;
use crate::viewer::message::Message;
use crate::viewer::save;
use crate::viewer::save_kind::SaveKind;
use crate::viewer::snapshot::{Size, snapshot};
use crate::viewer::viewport::Viewport;
use crate::viewer::why::ComparedPair;
use crate::viewer::worker::Task;
use crate::why::{SceneReport, worst_first};

impl App {
    /// Starts to save; `size` is the size of a picture of the view.
    pub(super) fn start_saving(
        &mut self,
        ctx: &egui::Context,
        what: SaveKind,
        path: PathBuf,
        size: [u32; 2],
    ) {
        let range = self.range();
        let shown = save::shown(&self.seen, &self.state, range);
        let task = match what {
            SaveKind::Renderings if self.state.difference && self.state.is_error_map() => {
                self.save_error_maps(ctx, path)
            }
            SaveKind::Renderings if self.photograph_scene().is_some() => {
                self.save_against_photograph(ctx, path)
            }
            SaveKind::Renderings => save::renderings(ctx, &self.seen, &self.state, shown, path),
            SaveKind::Strip => save::strip(ctx, &self.seen, &self.state, path),
            SaveKind::Session => self.save_session(ctx, path),
            SaveKind::Scenes => self.save_scenes(ctx, path),
            SaveKind::View => match self.picture(ctx, size) {
                Ok(picture) => {
                    let mut entries = save::provenance(&self.seen, &self.state, shown).entries();
                    entries.extend(self.view_entries());
                    if let Some(text) = self.error_map_text().or_else(|| self.photograph_text()) {
                        Provenance::describe(&mut entries, text);
                    }
                    save::view(ctx, picture, entries, path)
                }
                Err(error) => Task::start(ctx, |_| Err(error)),
            },
        };
        self.stop.cancels(&task.progress());
        self.saving = Some(task);
    }

    /// Puts the view on the clipboard as a picture of the size that it has in the window.
    pub(super) fn copy_picture(&mut self, ctx: &egui::Context) {
        match self.picture(ctx, self.picture_size) {
            Ok(picture) => {
                ctx.copy_image(picture);
                self.report([Message::Copied("the view as a picture")]);
            }
            Err(error) => self.report([Message::Failed(error)]),
        }
    }

    /// Puts a text on the clipboard, and says so.
    pub(super) fn copy_text(&mut self, ctx: &egui::Context, text: String, what: &'static str) {
        ctx.copy_text(text);
        self.report([Message::Copied(what)]);
    }

    /// The panes and the legend, as they are seen, in a picture of this size.
    fn picture(&mut self, ctx: &egui::Context, pixels: [u32; 2]) -> Result<egui::ColorImage, Error> {
        let seen = self.picture_size;
        // A larger picture has larger text.
        let grown = (pixels[0] as f32 / seen[0].max(1) as f32).min(pixels[1] as f32 / seen[1].max(1) as f32);
        let scale = (ctx.pixels_per_point() * grown).clamp(0.5, 8.0);
        let Some(view) = &self.gpu else {
            return Err(Error::Internal("there is no graphics adapter to draw the view".to_owned()));
        };
        let (state, gpu, dark) = (view.state.clone(), view.gpu.clone(), self.settings.dark);
        self.slots.slots.iter().for_each(|slot| slot.loaded.complete_upload(&gpu));
        // Gestures and corner handles stay in the window.
        let viewport = std::mem::replace(&mut self.viewport, Viewport::exact());
        let edits_corners = self.photograph.edits_corners();
        self.photograph.edit_corners(false);
        let picture = snapshot(&state, &gpu, Size { pixels, scale }, dark, |ui| {
            drop(self.content(ui));
        });
        self.viewport = viewport;
        self.photograph.edit_corners(edits_corners);
        picture
    }

    /// How the view is displayed, as (keyword, text).
    fn view_entries(&self) -> [(&'static str, String); 3] {
        let state = &self.state;
        let [x, y] = state.pan;
        [
            ("svbrdf:layout", state.layout.name().to_owned()),
            ("svbrdf:projection", format!("{:?}", state.projection).to_lowercase()),
            ("svbrdf:zoom", format!("{}, pan {x}, {y}", state.zoom)),
        ]
    }

    /// Starts to write the scenes of the loss of the chosen prediction, worst first.
    fn save_scenes(&self, ctx: &egui::Context, path: PathBuf) -> Task<PathBuf> {
        let pair = ComparedPair::of(&self.slots.slots, &self.state);
        let request = self.settings.loss.listed_scenes();
        Task::start(ctx, move |progress| {
            let pair = pair.ok_or(Error::NoPrediction)?;
            atomic::check_place(&path)?;
            let outcome = pair.comparison()?.run(&request, progress)?;
            let name = pair.ground_truth().name();
            let report = SceneReport::new(name, &pair.convention, &outcome, &worst_first(&outcome));
            let text =
                serde_json::to_string_pretty(&report).map_err(|e| Error::Internal(e.to_string()))? + "\n";
            atomic::replace(&path, progress, |file| file.write_all(text.as_bytes()))?;
            Ok(path)
        })
    }

    fn save_session(&self, ctx: &egui::Context, path: PathBuf) -> Task<PathBuf> {
        let session = self.session();
        Task::start(ctx, move |progress| {
            let text = session.text(&path)?;
            atomic::check_place(&path)?;
            atomic::replace(&path, progress, |file| file.write_all(text.as_bytes()))?;
            Ok(path)
        })
    }
}
