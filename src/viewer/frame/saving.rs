//! Saving and copying of the view.

use std::path::PathBuf;

use eframe::egui;

use svbrdf_core::image::Image;
use svbrdf_files::disk::inputs::check_output_of;
use svbrdf_files::export::Provenance;
use svbrdf_files::session::window::Framing;

use crate::error::Error;
use crate::frame::layout::Parts;
use crate::jobs::displayed::Displayed;
use crate::jobs::saving;
use crate::jobs::work::job::Job;
use crate::model::dialogs::{SaveKind, SaveRequest};
use crate::model::message::Message;

/// Starts to save.
pub(super) fn save_file(parts: &mut Parts, ctx: &egui::Context, SaveRequest { kind, path }: SaveRequest) {
    if let Err(error) = check_output_of(&path, parts.model.files()) {
        parts.model.report([Message::Failed(error.into())]);
        return;
    }
    let picture = (kind == SaveKind::View).then(|| picture(parts, ctx));
    let (displayed, view) = (parts.displayed(), &parts.model.view);
    let job = match (kind, picture) {
        (SaveKind::View, Some(Ok(picture))) => save_view(parts, picture, path),
        (SaveKind::View, picture) => {
            let missing = || Error::internal("there is no picture of the view");
            let error = picture.and_then(Result::err).unwrap_or_else(missing);
            Job::start(&parts.jobs.waker, |_| Err(error))
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
        (SaveKind::Materials, _) => {
            saving::materials_csv(displayed, parts.ui.dataset.listed().to_vec(), path)
        }
    };
    parts.jobs.saving = Some(job);
}

fn save_view(parts: &Parts, picture: egui::ColorImage, path: PathBuf) -> Job<PathBuf> {
    let displayed = parts.displayed();
    let mut entries = saving::provenance(displayed, saving::content(displayed)).entries();
    entries.extend(view_entries(parts));
    if let Some(text) = displayed.error_map_text().or_else(|| displayed.photograph_text()) {
        Provenance::describe(&mut entries, text);
    }
    let pixels = picture.pixels.iter().map(|pixel| [pixel.r(), pixel.g(), pixel.b()]).collect();
    let [width, height] = picture.size;
    saving::view(&parts.jobs.waker, Image::<u8> { width, height, pixels }, entries, path)
}

/// Puts the view on the clipboard as a picture.
pub(super) fn copy_picture(parts: &mut Parts, ctx: &egui::Context) {
    match picture(parts, ctx) {
        Ok(picture) => {
            ctx.copy_image(picture);
            parts.model.report([Message::Done("Copied the view as a picture".to_owned())]);
        }
        Err(error) => parts.model.report([Message::Failed(error)]),
    }
}

fn picture(parts: &mut Parts, ctx: &egui::Context) -> Result<egui::ColorImage, Error> {
    let displayed = Displayed::of(&parts.model, &parts.jobs);
    parts.ui.picture(ctx, displayed, parts.gpu.as_mut())
}

/// How the view is displayed, as (keyword, text).
fn view_entries(parts: &Parts) -> [(&'static str, String); 3] {
    let view = &parts.model.view;
    let framing = view.display.framing.map_or_else(
        || "fitted".to_owned(),
        |Framing { pixels_per_texel, centre: [x, y] }| {
            format!("{pixels_per_texel} pixels per texel, texel {x}, {y} in the centre")
        },
    );
    [
        ("svbrdf:layout", view.display.layout.name().to_owned()),
        ("svbrdf:projection", format!("{:?}", view.display.projection).to_lowercase()),
        ("svbrdf:zoom", framing),
    ]
}
