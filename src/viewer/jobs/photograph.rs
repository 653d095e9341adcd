//! Jobs of a photograph in the place of the ground truth: read, and compared with every material, each at its own exposure.

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
use svbrdf_files::read::{Photograph, Transfer, read_photograph};
use svbrdf_gpu::{Gpu, Shaded};

use crate::error::Error;
use crate::jobs::work::context::JobContext;
use crate::jobs::work::job::Job;
use crate::jobs::work::latest::Latest;
use crate::model::material::loaded::{LoadedMaterial, ids};
use crate::model::material::photograph::PhotographState;
use crate::model::material::read::file_name;
use crate::model::material::read::{MaterialId, ReadMaterial};
use crate::model::view::ViewState;

/// What the samples of a photograph depend on: its file, the stamp of the file when it was opened, and how it is read.
type ReadKey = (PathBuf, Option<Stamp>, Option<Transfer>);

/// What the comparisons depend on.
#[derive(Clone, Debug, PartialEq)]
struct ComparedKey {
    read: ReadKey,
    falloff: bool,
    /// Of all materials.
    ids: Vec<MaterialId>,
    scene: Scene,
    convention: Convention,
    kind: Difference,
}

/// The jobs on the photograph that renderings are compared with.
#[derive(Debug, Default)]
pub struct PhotographJobs {
    read: Latest<ReadKey, Arc<Photograph>>,
    compared: Latest<ComparedKey, Arc<Photographs>>,
}

/// The photograph beside every material.
#[derive(Debug)]
pub struct Photographs {
    /// Of each material.
    pub comparisons: Vec<PhotographComparison>,
    /// The photograph at the exposure of each material, where there is an adapter.
    shaded: Vec<Arc<Shaded>>,
    /// Of the chosen difference of each material.
    pub distributions: Distributions,
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

    fn new(
        (key, photograph): (&ComparedKey, &Photograph),
        materials: &[Arc<ReadMaterial>],
        gpu: Option<&Gpu>,
        progress: &Progress,
    ) -> Result<Self, Error> {
        let (name, falloff) = (file_name(&key.read.0), key.falloff.then_some(&key.scene));
        let one = |loaded: &Arc<ReadMaterial>| -> Result<_, Error> {
            let material = loaded.material();
            let on_texels = on_texels(photograph, &name, material.size(), falloff)?;
            let photographs = [(on_texels, key.scene)];
            Ok(compare(&photographs, material, material.name(), &key.convention, progress)?.remove(0))
        };
        let comparisons = materials.iter().map(one).collect::<Result<Vec<_>, _>>()?;
        let values: Vec<_> = comparisons.iter().map(|compared| compared.differences(key.kind)).collect();
        let distributions = Distributions::of(&values, key.kind.is_signed());
        let upload = |gpu: &Gpu| {
            let one =
                |compared: &PhotographComparison| Shaded::of_image(gpu, &compared.photograph).map(Arc::new);
            comparisons.iter().map(one).collect::<Result<Vec<_>, _>>()
        };
        let shaded = gpu.map(upload).transpose()?.unwrap_or_default();
        Ok(Self { comparisons, shaded, distributions })
    }
}

/// The photograph as the panes and the panel display it.
#[derive(Clone, Copy, Debug)]
pub struct DisplayedPhotograph<'a> {
    pub source: &'a SessionPhotograph,
    /// Once it has been read.
    pub photograph: Option<&'a Photograph>,
    /// Beside every material, once they are there.
    pub all: Option<&'a Arc<Photographs>>,
}

impl DisplayedPhotograph<'_> {
    /// The name of its file.
    pub fn name(&self) -> String {
        file_name(&self.source.path)
    }

    /// The title of a pane that displays it at the exposure of the material at this index.
    pub fn title(&self, index: usize) -> String {
        let ev = self.all.and_then(|all| all.get(index)).map(|one| format!("  {:+.2} EV", one.exposure_ev()));
        format!("PHOTOGRAPH  {}{}", self.name(), ev.unwrap_or_default())
    }
}

fn read_key(state: &PhotographState) -> Option<ReadKey> {
    state.source().map(|source| (source.path.clone(), state.stamp(), source.transfer))
}

fn compared_key(
    state: &PhotographState,
    materials: &[LoadedMaterial],
    view: &ViewState,
) -> Option<ComparedKey> {
    Some(ComparedKey {
        read: read_key(state)?,
        falloff: state.source()?.falloff,
        ids: ids(materials),
        scene: view.scene,
        convention: view.convention(),
        kind: view.display.differences.kind(Quantity::Rendering),
    })
}

impl PhotographJobs {
    /// The photograph, once it has been read.
    fn photograph(&self, state: &PhotographState) -> Option<&Arc<Photograph>> {
        let (of, photograph) = self.read.get()?;
        (Some(of) == read_key(state).as_ref()).then_some(photograph)
    }

    /// Whether what is open has been read.
    pub fn is_settled(&self, state: &PhotographState) -> bool {
        state.source().is_none() || self.photograph(state).is_some()
    }

    /// Takes over results, and computes what is wanted now; why the photograph cannot be read, and why it cannot be compared.
    pub fn follow(&mut self, work: &JobContext<'_>, state: &PhotographState) -> [Option<Error>; 2] {
        let error = self.read.follow(read_key(state), |(path, _, transfer)| {
            let (file, transfer) = (NamedFile::by_user(path), *transfer);
            Job::start(work.waker, move |_| Ok(Arc::new(read_photograph(&file, transfer)?)))
        });
        if error.is_some() {
            *self = Self::default();
            return [error, None];
        }
        [None, self.compare(work, state)]
    }

    fn compare(&mut self, work: &JobContext<'_>, state: &PhotographState) -> Option<Error> {
        let wanted = compared_key(state, work.materials, work.view).filter(|key| !key.ids.is_empty());
        let Some(wanted) = wanted else {
            self.compared = Latest::default();
            return None;
        };
        let photograph = self.photograph(state)?.clone();
        self.compared.follow(Some(wanted), |key| {
            let (key, gpu, materials) = (key.clone(), work.gpu.cloned(), work.materials());
            Job::start(work.waker, move |progress| {
                Photographs::new((&key, &photograph), &materials, gpu.as_ref(), progress).map(Arc::new)
            })
        })
    }

    /// The photograph as it is displayed beside `materials`, perhaps at the exposures of an earlier scene.
    pub fn displayed<'a>(
        &'a self,
        state: &'a PhotographState,
        materials: &[LoadedMaterial],
    ) -> Option<DisplayedPhotograph<'a>> {
        let (source, now) = (state.source()?, read_key(state)?);
        let all = self.compared.get().filter(|(of, _)| of.ids == ids(materials) && of.read == now);
        let photograph = self.photograph(state).map(AsRef::as_ref);
        Some(DisplayedPhotograph { source, photograph, all: all.map(|(_, all)| all) })
    }

    /// The distributions of the chosen difference of every material, and whether they are up to date.
    pub fn distributions(
        &self,
        state: &PhotographState,
        materials: &[LoadedMaterial],
        view: &ViewState,
    ) -> Option<(&Distributions, bool)> {
        let now = compared_key(state, materials, view)?;
        let (of, all) = self.compared.get()?;
        (of.ids == now.ids && of.kind == now.kind).then_some((&all.distributions, *of == now))
    }
}
