//! A photograph in the place of the ground truth: read, brought onto the texels, and compared with every material, on workers.

mod compared;
mod corner_editor;
mod keys;
mod picture;

use std::sync::Arc;

pub(super) use compared::Photographs;
use compared::{ComparedKey, compare, key};
pub(super) use corner_editor::{CornerEditor, NAMES as CORNER_NAMES};
use keys::{ReadKey, RectifiedKey};

use super::latest::Latest;
use super::panel_texture::PanelTexture;
use super::slot::Slot;
use super::source::file_name;
use super::state::ViewState;
use super::work_context::WorkContext;
use super::worker::Task;
use crate::error::Error;
use crate::files::read::{Photograph, read_photograph};
use crate::files::session::SessionPhotograph;
use crate::photograph::{Corners, Rectified};
use crate::picture::statistics::Distributions;

/// The photograph that renderings are compared with, and the work on it.
#[derive(Debug, Default)]
pub(super) struct PhotographRun {
    source: Option<SessionPhotograph>,
    read: Latest<ReadKey, Arc<Photograph>>,
    rectified: Latest<RectifiedKey, Arc<Rectified>>,
    compared: Latest<ComparedKey, Arc<Photographs>>,
    /// Whether the corners are edited: its pane then shows the photograph as it was taken.
    edits_corners: bool,
    picture: Latest<ReadKey, PanelTexture>,
}

/// The photograph as the panes and the panel show it.
#[derive(Clone, Copy, Debug)]
pub(super) struct PhotographScene<'a> {
    pub source: &'a SessionPhotograph,
    /// Once it has been read.
    pub photograph: Option<&'a Photograph>,
    /// The share of the texels that are left out, once it is on the texels.
    pub clipped: Option<f64>,
    /// Beside every material, once they are there.
    pub all: Option<&'a Arc<Photographs>>,
    /// While the corners are edited.
    pub editor: Option<CornerEditor<'a>>,
}

impl PhotographScene<'_> {
    /// The name of its file.
    pub(super) fn name(&self) -> String {
        file_name(&self.source.path)
    }

    /// The title of a pane that shows it at the exposure of slot `slot`.
    pub(super) fn title(&self, slot: usize) -> String {
        if self.editor.is_some() {
            return format!("PHOTOGRAPH  {}  as it was taken", self.name());
        }
        let ev = self.all.and_then(|all| all.get(slot)).map(|one| format!("  {:+.2} EV", one.exposure_ev()));
        format!("PHOTOGRAPH  {}{}", self.name(), ev.unwrap_or_default())
    }
}

impl PhotographRun {
    /// Opens another photograph, or closes the one that is open.
    pub(super) fn set(&mut self, source: Option<SessionPhotograph>) {
        self.source = source;
        self.edits_corners &= self.source.is_some();
    }

    /// Starts or ends to edit the corners.
    pub(super) fn edit_corners(&mut self, on: bool) {
        self.edits_corners = on && self.source.is_some();
    }

    /// Whether the corners are edited.
    pub(super) fn edits_corners(&self) -> bool {
        self.edits_corners
    }

    /// Whether what is open has been read.
    pub(super) fn is_settled(&self) -> bool {
        self.source.is_none() || self.photograph().is_some()
    }

    /// What is open.
    pub(super) fn source(&self) -> Option<&SessionPhotograph> {
        self.source.as_ref()
    }

    /// What is open, to change how it is used.
    pub(super) fn source_mut(&mut self) -> Option<&mut SessionPhotograph> {
        self.source.as_mut()
    }

    /// The photograph, once it has been read.
    pub(super) fn photograph(&self) -> Option<&Arc<Photograph>> {
        let (of, photograph) = self.read.get()?;
        (Some(of) == self.read_key().as_ref()).then_some(photograph)
    }

    fn read_key(&self) -> Option<ReadKey> {
        self.source.as_ref().map(|source| (source.path.clone(), source.read))
    }

    /// Takes over results, and computes what is wanted now. Without a photograph that can be read, there is none.
    pub(super) fn follow(&mut self, work: &WorkContext<'_>) -> Option<Error> {
        let wanted = self.read_key();
        let error = self.read.follow(work.ctx, wanted, |(path, options)| {
            let (path, options) = (path.clone(), *options);
            Task::start(work.ctx, move |_| read_photograph(&path, &options).map(Arc::new))
        });
        if error.is_some() {
            *self = Self::default();
            return error;
        }
        let error = self.rectify(work);
        let error = error.or_else(|| self.compare(work));
        error.or_else(|| self.draw(work))
    }

    /// The photograph as it was taken, while the corners are edited.
    fn draw(&mut self, work: &WorkContext<'_>) -> Option<Error> {
        let photograph = self.photograph().filter(|_| self.edits_corners).cloned();
        let (ctx, longest) = (work.ctx.clone(), work.ctx.input(|i| i.max_texture_side));
        let wanted = photograph.is_some().then(|| self.read_key()).flatten();
        self.picture.follow(work.ctx, wanted, |_| {
            Task::start(work.ctx, move |_| {
                let photograph = photograph.ok_or_else(|| Error::Internal("no photograph".to_owned()))?;
                Ok(picture::texture(&ctx, &photograph, longest))
            })
        })
    }

    fn rectify(&mut self, work: &WorkContext<'_>) -> Option<Error> {
        let (Some(source), Some(slot)) = (&self.source, work.slots.first()) else {
            self.rectified = Latest::default();
            return None;
        };
        let photograph = self.photograph()?.clone();
        let corners = source.corners.map_or_else(|| Corners::whole(photograph.size()), Corners);
        let size = slot.loaded.material.size();
        let wanted = RectifiedKey { read: self.read_key()?, corners, size };
        self.rectified.follow(work.ctx, Some(wanted), |_| {
            Task::start(work.ctx, move |progress| {
                Rectified::new(&photograph, &corners, size, progress).map(Arc::new)
            })
        })
    }

    fn compare(&mut self, work: &WorkContext<'_>) -> Option<Error> {
        let (Some(source), Some((of, rectified))) = (&self.source, self.rectified.get()) else {
            self.compared = Latest::default();
            return None;
        };
        // It is still on the texels of materials that have been closed.
        if work.slots.first().is_none_or(|slot| slot.loaded.material.size() != of.size) {
            return None;
        }
        let wanted = key(of.clone(), source.falloff, work.slots, work.state);
        let rectified = rectified.clone();
        self.compared.follow(work.ctx, Some(wanted), |key| {
            let (key, gpu, convention) = (key.clone(), work.gpu.cloned(), work.state.convention());
            let materials = work.materials();
            Task::start(work.ctx, move |progress| {
                compare(&key, &rectified, &materials, &convention, gpu.as_ref(), progress).map(Arc::new)
            })
        })
    }

    /// The photograph as it is shown beside `slots`, perhaps at the exposures of an earlier scene.
    pub(super) fn scene(&self, slots: &[Slot]) -> Option<PhotographScene<'_>> {
        let source = self.source.as_ref()?;
        let photograph = self.photograph().map(AsRef::as_ref);
        let of_now = |key: &ReadKey| Some(key) == self.read_key().as_ref();
        let rectified = self.rectified.get().filter(|(of, _)| of_now(&of.read));
        let picture = self.picture.get().filter(|(of, _)| of_now(of)).map(|(_, picture)| picture);
        let editor = photograph.filter(|_| self.edits_corners).map(|photograph| {
            let size = photograph.size();
            let corners = source.corners.map_or_else(|| Corners::whole(size), Corners);
            CornerEditor { picture, size, corners }
        });
        let all = self.compared.get().filter(|(of, _)| of.is_of(slots) && of_now(&of.rectified.read));
        Some(PhotographScene {
            source,
            photograph,
            clipped: rectified.map(|(_, rectified)| rectified.clipped_share()),
            all: all.map(|(_, all)| all),
            editor,
        })
    }

    /// The distributions of the chosen difference of every material, and whether they are up to date.
    pub(super) fn distributions(&self, slots: &[Slot], state: &ViewState) -> Option<(&Distributions, bool)> {
        let source = self.source.as_ref()?;
        let (of, all) = self.compared.get()?;
        let (rectified, _) = self.rectified.get()?;
        let now = key(rectified.clone(), source.falloff, slots, state);
        let of_now = Some(&rectified.read) == self.read_key().as_ref()
            && source.corners.is_none_or(|corners| rectified.corners == Corners(corners));
        (of.is_of(slots) && of.kind == now.kind).then_some((&all.distributions, *of == now && of_now))
    }
}
