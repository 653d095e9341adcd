//! Questions about a photograph in the place of the ground truth: read, and compared with every material, each at its own exposure.

use std::path::PathBuf;
use std::sync::Arc;

use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::picture::statistics::Distributions;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::photograph::{PhotographComparison, compare, on_texels};
use svbrdf_files::disk::open::NamedFile;
use svbrdf_files::disk::stamp::Stamp;
use svbrdf_files::photograph::SessionPhotograph;
use svbrdf_files::read::{Albedo, Photograph, read_photograph};
use svbrdf_gpu::{Gpu, Shaded};

use crate::error::Error;
use crate::jobs::Shown;
use crate::jobs::answers::content::{Content, Given, read_all, refuse_mask};
use crate::jobs::answers::{Answer, Answered, Pace, Question, Work};
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::read::{ReadMaterial, file_name};

/// The samples of a photograph.
#[derive(Clone, Debug, PartialEq)]
struct OpenPhotograph {
    path: PathBuf,
    /// Of the file when it was opened.
    stamp: Option<Stamp>,
    transfer: Option<Albedo>,
}

impl Question for OpenPhotograph {
    type Answer = Photograph;
    const PACE: Pace = Pace::AtOnce;
    const KEPT: usize = 1;

    fn answer(&self, _: &Work<'_, Self::Answer>) -> Result<Photograph, Error> {
        Ok(read_photograph(&NamedFile::by_user(&self.path), self.transfer)?)
    }
}

/// A photograph beside every material.
#[derive(Clone, Debug, PartialEq)]
struct ComparePhotograph {
    read: OpenPhotograph,
    falloff: bool,
    materials: Vec<Content>,
    scene: Scene,
    convention: Convention,
    kind: Difference,
    /// What was read, and the adapter.
    given: Given<(Arc<Answered<Photograph>>, Option<Gpu>)>,
}

impl Question for ComparePhotograph {
    type Answer = Photographs;
    const PACE: Pace = Pace::AtOnce;
    const KEPT: usize = 1;

    /// Perhaps in another scene.
    fn is_like(&self, earlier: &Self) -> bool {
        self.materials == earlier.materials && self.read == earlier.read
    }

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<Photographs, Error> {
        Photographs::new(self, work.progress())
    }
}

/// The photograph beside every material.
#[derive(Debug)]
pub struct Photographs {
    /// Of each material.
    pub comparisons: Vec<PhotographComparison>,
    /// The photograph at the exposure of each material, where there is an adapter.
    shaded: Vec<Arc<Shaded>>,
    kind: Difference,
    /// Of the difference of each material.
    distributions: Distributions,
}

impl Photographs {
    /// The comparison of the material at this index.
    pub fn get(&self, index: usize) -> Option<&PhotographComparison> {
        self.comparisons.get(index)
    }

    /// The photograph at the exposure of the material at this index on the adapter.
    pub fn shaded(&self, index: usize) -> Option<&Arc<Shaded>> {
        self.shaded.get(index)
    }

    /// The photograph at the exposure of the material at this index at the texel (column, row); NaN where it is clipped.
    pub fn at(&self, index: usize, [column, row]: [usize; 2]) -> [f32; 3] {
        let image = self.get(index).map(|compared| &compared.photograph);
        image.map_or([f32::NAN; 3], |image| image.pixels[row * image.width + column])
    }

    fn new(asked: &ComparePhotograph, progress: &Progress) -> Result<Self, Error> {
        let ComparePhotograph { read, falloff, scene, convention, kind, given, .. } = asked;
        let Given((photograph, gpu)) = given;
        let (name, falloff) = (file_name(&read.path), falloff.then_some(scene));
        let one = |loaded: &Arc<ReadMaterial>| -> Result<_, Error> {
            let material = loaded.material();
            let photographs = [(on_texels(photograph, &name, material.size(), falloff)?, *scene)];
            Ok(compare(&photographs, material, material.name(), convention, progress)?.remove(0))
        };
        let materials = read_all(&asked.materials)?;
        refuse_mask(&materials, "A photograph is compared over all texels, and not over those of a mask")?;
        let comparisons = materials.iter().map(one).collect::<Result<Vec<_>, _>>()?;
        let values: Vec<_> = comparisons.iter().map(|compared| compared.differences(*kind)).collect();
        let distributions = Distributions::of(&values, kind.is_signed());
        let upload = |gpu: &Gpu| {
            let one =
                |compared: &PhotographComparison| Shaded::of_image(gpu, &compared.photograph).map(Arc::new);
            comparisons.iter().map(one).collect::<Result<Vec<_>, _>>()
        };
        let shaded = gpu.as_ref().map(upload).transpose()?.unwrap_or_default();
        Ok(Self { comparisons, shaded, kind: *kind, distributions })
    }
}

/// The photograph that is open, as far as it is there.
#[derive(Clone, Debug)]
pub struct DisplayedPhotograph<'a> {
    pub source: &'a SessionPhotograph,
    /// Once it has been read.
    pub photograph: Option<Arc<Answered<Photograph>>>,
    /// Whether it cannot be read.
    pub has_failed: bool,
    /// Beside every material, and whether at the exposures of the present scene.
    pub all: Option<(Arc<Answered<Photographs>>, bool)>,
}

impl<'a> DisplayedPhotograph<'a> {
    /// Beside these materials.
    pub fn ask(shown: Shown<'a>, materials: &[LoadedMaterial]) -> Option<Self> {
        let (answers, view, state) = (&shown.jobs.answers, &shown.model.view, &shown.model.photograph);
        let source = state.source()?;
        let (path, stamp, transfer) = (source.path.clone(), state.stamp(), source.transfer);
        let read = OpenPhotograph { path, stamp, transfer };
        let answer = answers.get(&read);
        let has_failed = matches!(answer, Answer::Failed(_));
        let photograph = answer.ready();
        let compare = |photograph: &Arc<Answered<Photograph>>| ComparePhotograph {
            read,
            falloff: source.falloff,
            materials: Content::all(materials),
            scene: view.scene,
            convention: view.convention(),
            kind: view.display.differences.kind(Quantity::Rendering),
            given: Given((photograph.clone(), shown.jobs.gpu.clone())),
        };
        let compared = photograph.as_ref().filter(|_| !materials.is_empty()).map(compare);
        let all = compared.and_then(|question| answers.drawn(&question));
        Some(Self { source, photograph, has_failed, all })
    }

    pub fn all(&self) -> Option<&Photographs> {
        self.all.as_ref().map(|(all, _)| &all.answer)
    }

    /// The distributions of this difference from it, and whether they are of the present scene.
    pub fn distributions(&self, kind: Difference) -> Option<(&Distributions, bool)> {
        let (all, is_current) = self.all.as_ref().filter(|(all, _)| all.kind == kind)?;
        Some((&all.distributions, *is_current))
    }

    /// The name of its file.
    pub fn name(&self) -> String {
        file_name(&self.source.path)
    }

    /// The title of a pane that displays it at the exposure of the material at this index.
    pub fn title(&self, index: usize) -> String {
        let ev =
            self.all().and_then(|all| all.get(index)).map(|one| format!("  {:+.2} EV", one.exposure_ev()));
        format!("PHOTOGRAPH  {}{}", self.name(), ev.unwrap_or_default())
    }
}
