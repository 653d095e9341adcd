//! Jobs of a photograph in the place of the ground truth: read, brought onto the texels, and compared with every material.

pub mod compared;
pub mod filmstrip;
pub mod keys;
pub mod picture;

use std::path::PathBuf;
use std::sync::Arc;

pub use compared::Photographs;
use svbrdf_core::picture::statistics::Distributions;
use svbrdf_evaluate::photograph::Rectified;
use svbrdf_files::photograph::Corners;
use svbrdf_files::photograph::SessionPhotograph;
use svbrdf_files::read::{Photograph, read_photograph};

use crate::error::Error;
use crate::jobs::work::context::JobContext;
use crate::jobs::work::job::Job;
use crate::jobs::work::latest::Latest;
use crate::jobs::work::picture::Picture;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::photograph::PhotographState;
use crate::model::material::source::file_name;
use crate::model::view::state::ViewState;

use compared::{ComparedKey, compare, key};
use filmstrip::Filmstrip;
use keys::{ReadKey, RectifiedKey};

/// The jobs on the photograph that renderings are compared with.
#[derive(Debug, Default)]
pub struct PhotographJobs {
    read: Latest<ReadKey, Arc<Photograph>>,
    /// Why a photograph of a capture cannot be read.
    problem: Option<(ReadKey, String)>,
    rectified: Latest<RectifiedKey, Arc<Rectified>>,
    compared: Latest<ComparedKey, Arc<Photographs>>,
    picture: Latest<ReadKey, Arc<Picture>>,
    /// Of the file that lists the capture.
    filmstrip: Latest<PathBuf, Arc<Filmstrip>>,
}

/// The photograph as the panes and the panel display it.
#[derive(Clone, Copy, Debug)]
pub struct DisplayedPhotograph<'a> {
    pub source: &'a SessionPhotograph,
    /// Once it has been read.
    pub photograph: Option<&'a Photograph>,
    /// Why it cannot be read, where it is one of a capture.
    pub problem: Option<&'a str>,
    /// The share of the texels that is left out, once it is on the texels.
    pub clipped: Option<f64>,
    /// Beside every material, once they are there.
    pub all: Option<&'a Arc<Photographs>>,
    /// While the corners are edited.
    pub corners: Option<EditedCorners<'a>>,
    /// The photographs of the capture to which it belongs, once they have been read.
    pub filmstrip: Option<&'a Arc<Filmstrip>>,
}

/// The photograph as it was taken, and the corners of the material in it.
#[derive(Clone, Copy, Debug)]
pub struct EditedCorners<'a> {
    /// Once it is there.
    pub picture: Option<&'a Arc<Picture>>,
    /// Width and height of the photograph, in pixels.
    pub size: [usize; 2],
    pub corners: Corners,
}

impl DisplayedPhotograph<'_> {
    /// The name of its file.
    pub fn name(&self) -> String {
        file_name(&self.source.path)
    }

    /// The title of a pane that displays it at the exposure of the material at this index.
    pub fn title(&self, index: usize) -> String {
        if self.corners.is_some() {
            return format!("PHOTOGRAPH  {}  as it was taken", self.name());
        }
        let ev = self.all.and_then(|all| all.get(index)).map(|one| format!("  {:+.2} EV", one.exposure_ev()));
        format!("PHOTOGRAPH  {}{}", self.name(), ev.unwrap_or_default())
    }
}

fn read_key(state: &PhotographState) -> Option<ReadKey> {
    state.source().map(|source| (source.path.clone(), state.stamp(), source.read))
}

impl PhotographJobs {
    /// The photograph, once it has been read.
    pub fn photograph(&self, state: &PhotographState) -> Option<&Arc<Photograph>> {
        let (of, photograph) = self.read.get()?;
        (Some(of) == read_key(state).as_ref()).then_some(photograph)
    }

    /// Why the photograph of a capture cannot be read.
    fn problem(&self, state: &PhotographState) -> Option<&str> {
        let (of, problem) = self.problem.as_ref()?;
        (Some(of) == read_key(state).as_ref()).then_some(problem)
    }

    /// Whether what is open has been read, as far as it can be.
    pub fn is_settled(&self, state: &PhotographState) -> bool {
        state.source().is_none() || self.photograph(state).is_some() || self.problem(state).is_some()
    }

    /// Takes over results, and computes what is wanted now. Where the photograph cannot be read and is none of a capture, the error
    /// is the first of the pair; `longest` is the longest side of a picture for a texture.
    pub fn follow(
        &mut self,
        work: &JobContext<'_>,
        state: &PhotographState,
        longest: usize,
    ) -> [Option<Error>; 2] {
        let error = self.read.follow(read_key(state), |(path, _, options)| {
            let (path, options) = (path.clone(), *options);
            Job::start(work.waker, move |_| Ok(Arc::new(read_photograph(&path, &options)?)))
        });
        if let Some(error) = error {
            let of_capture =
                read_key(state).filter(|_| state.source().is_some_and(|one| one.capture.is_some()));
            let Some(of_capture) = of_capture else {
                *self = Self::default();
                return [Some(error), None];
            };
            self.problem = Some((of_capture, error.to_string()));
        }
        let error = self.rectify(work, state);
        let error = error.or_else(|| self.compare(work, state));
        let error = error.or_else(|| self.draw(work, state, longest));
        [None, error.or_else(|| self.list(work, state))]
    }

    /// The photograph as it was taken, while the corners are edited.
    fn draw(&mut self, work: &JobContext<'_>, state: &PhotographState, longest: usize) -> Option<Error> {
        let photograph = self.photograph(state).filter(|_| state.edits_corners()).cloned();
        let wanted = photograph.is_some().then(|| read_key(state)).flatten();
        self.picture.follow(wanted, |_| {
            Job::start(work.waker, move |_| {
                let photograph = photograph.ok_or_else(|| Error::internal("no photograph"))?;
                Ok(Arc::new(picture::picture(&photograph, longest)))
            })
        })
    }

    /// The photographs of the capture to which the photograph belongs, once it is there.
    fn list(&mut self, work: &JobContext<'_>, state: &PhotographState) -> Option<Error> {
        let wanted = state.source().and_then(|source| source.capture.clone());
        if wanted.is_some() && !self.is_settled(state) {
            return None;
        }
        self.filmstrip.follow(wanted, |path| {
            let path = path.clone();
            Job::start(work.waker, move |progress| filmstrip::read(&path, progress).map(Arc::new))
        })
    }

    fn rectify(&mut self, work: &JobContext<'_>, state: &PhotographState) -> Option<Error> {
        let (Some(source), Some(ground_truth)) = (state.source(), work.materials.first()) else {
            self.rectified = Latest::default();
            return None;
        };
        let photograph = self.photograph(state)?.clone();
        let corners = source.corners.unwrap_or_else(|| Corners::whole(photograph.size()));
        let size = ground_truth.material().size();
        let wanted = RectifiedKey { read: read_key(state)?, corners, size };
        self.rectified.follow(Some(wanted), |_| {
            Job::start(work.waker, move |progress| {
                Ok(Arc::new(Rectified::new(&photograph, &corners, size, progress)?))
            })
        })
    }

    fn compare(&mut self, work: &JobContext<'_>, state: &PhotographState) -> Option<Error> {
        let (Some(source), Some((of, rectified))) = (state.source(), self.rectified.get()) else {
            self.compared = Latest::default();
            return None;
        };
        // It is still on the texels of materials that have been closed.
        if work.materials.first().is_none_or(|one| one.material().size() != of.size) {
            return None;
        }
        let wanted = key(of.clone(), source.falloff, work.materials, work.view);
        let rectified = rectified.clone();
        self.compared.follow(Some(wanted), |key| {
            let (key, gpu, convention) = (key.clone(), work.gpu.cloned(), work.view.convention());
            let materials = work.materials();
            Job::start(work.waker, move |progress| {
                compare(&key, &rectified, &materials, &convention, gpu.as_ref(), progress).map(Arc::new)
            })
        })
    }

    /// The photograph as it is displayed beside `materials`, perhaps at the exposures of an earlier scene.
    pub fn displayed<'a>(
        &'a self,
        state: &'a PhotographState,
        materials: &[LoadedMaterial],
    ) -> Option<DisplayedPhotograph<'a>> {
        let (source, now) = (state.source()?, read_key(state));
        let photograph = self.photograph(state).map(AsRef::as_ref);
        let of_now = |key: &ReadKey| Some(key) == now.as_ref();
        let rectified = self.rectified.get().filter(|(of, _)| of_now(&of.read));
        let picture = self.picture.get().filter(|(of, _)| of_now(of)).map(|(_, picture)| picture);
        let corners = photograph.filter(|_| state.edits_corners()).map(|photograph| {
            let size = photograph.size();
            EditedCorners { picture, size, corners: source.corners.unwrap_or_else(|| Corners::whole(size)) }
        });
        let all = self.compared.get().filter(|(of, _)| of.is_of(materials) && of_now(&of.rectified.read));
        let filmstrip = self.filmstrip.get().filter(|(of, _)| source.capture.as_ref() == Some(of));
        Some(DisplayedPhotograph {
            source,
            photograph,
            problem: self.problem(state),
            clipped: rectified.map(|(_, rectified)| rectified.clipped_share()),
            all: all.map(|(_, all)| all),
            corners,
            filmstrip: filmstrip.map(|(_, strip)| strip),
        })
    }

    /// The distributions of the chosen difference of every material, and whether they are up to date.
    pub fn distributions(
        &self,
        state: &PhotographState,
        materials: &[LoadedMaterial],
        view: &ViewState,
    ) -> Option<(&Distributions, bool)> {
        let source = state.source()?;
        let (of, all) = self.compared.get()?;
        let (rectified, _) = self.rectified.get()?;
        let now = key(rectified.clone(), source.falloff, materials, view);
        let of_now = Some(&rectified.read) == read_key(state).as_ref()
            && source.corners.is_none_or(|corners| rectified.corners == corners);
        (of.is_of(materials) && of.kind == now.kind).then_some((&all.distributions, *of == now && of_now))
    }
}
