//! Saving and copying of the view.

use eframe::egui;

use svbrdf_core::image::Image;
use svbrdf_files::disk::inputs::check_output_of;
use svbrdf_files::export::Provenance;
use svbrdf_files::session::window::Framing;

use crate::error::Error;
use crate::frame::layout::Parts;
use crate::frame::written::{self, Writing};
use crate::jobs::work::job::Job;
use crate::jobs::{Edit, SAVING, Shown};
use crate::message::Message;
use crate::model::Model;
use crate::model::dialogs::{SaveKind, SaveRequest};
use crate::model::view::ViewState;
use crate::pane::displayed::Displayed;

/// Starts to save.
pub(super) fn save_file(parts: &mut Parts, ctx: &egui::Context, SaveRequest { kind, path }: SaveRequest) {
    if let Err(error) = check_output_of(&path, parts.model.files()) {
        parts.model.report([Message::Failed(error.into())]);
        return;
    }
    let picture = (kind == SaveKind::View).then(|| picture(parts, ctx)).transpose();
    let writing = picture.map(|picture| writing(parts, kind, picture));
    let job = Job::<Edit>::start(&parts.jobs.waker, move |progress| {
        let result = writing.and_then(|write| write(&path, progress)).map(|()| path);
        Ok(Box::new(|model: &mut Model| model.saved(result)))
    });
    parts.jobs.edits.insert(SAVING, job);
}

/// What is written; `picture` is of the view.
fn writing(parts: &Parts, kind: SaveKind, picture: Option<egui::ColorImage>) -> Writing {
    let (displayed, view) = (&parts.displayed(), &parts.model.view);
    match (kind, picture) {
        (_, Some(picture)) => save_view(displayed, picture),
        (SaveKind::View | SaveKind::Renderings, _) if view.display.difference && view.is_error_map() => {
            written::error_maps(displayed)
        }
        (SaveKind::View | SaveKind::Renderings, _) if displayed.photograph().is_some() => {
            written::against_photograph(displayed)
        }
        (SaveKind::View | SaveKind::Renderings, _) => written::renderings(displayed),
        (SaveKind::Strip, _) => written::strip(displayed),
        (SaveKind::Session, _) => written::session(displayed),
        (SaveKind::Scenes, _) => written::scenes(displayed),
        (SaveKind::Materials, _) => written::materials_csv(displayed),
    }
}

fn save_view(displayed: &Displayed<'_>, picture: egui::ColorImage) -> Writing {
    let mut entries = written::provenance(displayed, written::content(displayed)).entries();
    entries.extend(view_entries(displayed.view()));
    if let Some(text) = written::error_map_text(displayed).or_else(|| written::photograph_text(displayed)) {
        Provenance::describe(&mut entries, text);
    }
    let pixels = picture.pixels.iter().map(|pixel| [pixel.r(), pixel.g(), pixel.b()]).collect();
    let [width, height] = picture.size;
    written::view(Image::<u8> { width, height, pixels }, entries)
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
    let Parts { model, jobs, ui, gpu } = parts;
    ui.picture(ctx, Displayed::ask(Shown { model, jobs }), gpu.as_mut())
}

/// How the view is displayed, as (keyword, text).
fn view_entries(view: &ViewState) -> [(&'static str, String); 3] {
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
