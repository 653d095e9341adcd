//! Saving and copying of the view.

use std::path::PathBuf;

use eframe::egui;

use super::App;
use crate::error::Error;
use crate::image::Image;
use crate::picture::export::Provenance;
use crate::viewer::jobs::saving;
use crate::viewer::jobs::work::job::Job;
use crate::viewer::model::message::Message;
use crate::viewer::model::settings::save_kind::SaveKind;

impl App {
    /// Starts to save; `size` is the size of a picture of the view.
    pub(super) fn save_file(&mut self, ctx: &egui::Context, kind: SaveKind, path: PathBuf, size: [u32; 2]) {
        let picture = (kind == SaveKind::View).then(|| self.picture(ctx, size));
        let (displayed, view) = (self.displayed(), &self.model.view);
        let job = match (kind, picture) {
            (SaveKind::View, Some(Ok(picture))) => self.save_view(picture, path),
            (SaveKind::View, picture) => {
                let missing = || Error::Internal("there is no picture of the view".to_owned());
                let error = picture.and_then(Result::err).unwrap_or_else(missing);
                Job::start(&self.jobs.waker, |_| Err(error))
            }
            (SaveKind::Renderings, _) if view.display.difference && view.is_error_map() => {
                saving::error_maps(displayed, path)
            }
            (SaveKind::Renderings, _) if displayed.photograph().is_some() => {
                saving::against_photograph(displayed, path)
            }
            (SaveKind::Renderings, _) => saving::renderings(displayed, path),
            (SaveKind::Strip, _) => saving::strip(displayed, path),
            (SaveKind::Session, _) => saving::session(displayed, path),
            (SaveKind::Scenes, _) => saving::scenes(displayed, path),
        };
        self.stop.cancels(&job.progress());
        self.jobs.saving = Some(job);
    }

    fn save_view(&self, picture: egui::ColorImage, path: PathBuf) -> Job<PathBuf> {
        let displayed = self.displayed();
        let mut entries = saving::provenance(displayed, saving::shown(displayed)).entries();
        entries.extend(self.view_entries());
        if let Some(text) = displayed.error_map_text().or_else(|| displayed.photograph_text()) {
            Provenance::describe(&mut entries, text);
        }
        let pixels = picture.pixels.iter().map(|pixel| [pixel.r(), pixel.g(), pixel.b()]).collect();
        let [width, height] = picture.size;
        saving::view(&self.jobs.waker, Image::<u8> { width, height, pixels }, entries, path)
    }

    /// Puts the view on the clipboard as a picture of the size that it has in the window.
    pub(super) fn copy_picture(&mut self, ctx: &egui::Context) {
        match self.picture(ctx, self.model.geometry.picture) {
            Ok(picture) => {
                ctx.copy_image(picture);
                self.model.report([Message::Copied("the view as a picture")]);
            }
            Err(error) => self.model.report([Message::Failed(error)]),
        }
    }

    fn picture(&mut self, ctx: &egui::Context, pixels: [u32; 2]) -> Result<egui::ColorImage, Error> {
        let displayed = self.jobs.displayed(&self.model);
        self.ui.picture(ctx, displayed, self.gpu.as_mut(), pixels)
    }

    /// How the view is displayed, as (keyword, text).
    fn view_entries(&self) -> [(&'static str, String); 3] {
        let view = &self.model.view;
        let [x, y] = view.display.pan;
        [
            ("svbrdf:layout", view.display.layout.name().to_owned()),
            ("svbrdf:projection", format!("{:?}", view.display.projection).to_lowercase()),
            ("svbrdf:zoom", format!("{}, pan {x}, {y}", view.display.zoom)),
        ]
    }
}
