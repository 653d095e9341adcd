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
use svbrdf_files::read::{Photograph, Transfer, read_photograph};
use svbrdf_gpu::{Gpu, Shaded};

use crate::error::Error;
use crate::jobs::answers::content::{Content, Given, read_all};
use crate::jobs::answers::{Answered, Question, Work};
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::photograph::PhotographState;
use crate::model::material::read::ReadMaterial;
use crate::model::material::read::file_name;
use crate::model::view::ViewState;

/// The samples of a photograph.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadPhotograph {
    path: PathBuf,
    /// Of the file when it was opened.
    stamp: Option<Stamp>,
    transfer: Option<Transfer>,
}

impl ReadPhotograph {
    /// Of what is open.
    pub fn of(state: &PhotographState) -> Option<Self> {
        let source = state.source()?;
        Some(Self { path: source.path.clone(), stamp: state.stamp(), transfer: source.transfer })
    }
}

impl Question for ReadPhotograph {
    type Answer = Photograph;
    const IS_SHORT: bool = true;
    const KEPT: usize = 1;

    fn answer(&self, _: &Work<'_, Self::Answer>) -> Result<Photograph, Error> {
        Ok(read_photograph(&NamedFile::by_user(&self.path), self.transfer)?)
    }
}

/// What was read of a photograph.
pub type Samples = Arc<Answered<Photograph>>;

/// A photograph beside every material.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparePhotograph {
    read: ReadPhotograph,
    falloff: bool,
    materials: Vec<Content>,
    scene: Scene,
    convention: Convention,
    kind: Difference,
    /// What was read, and the adapter.
    given: Given<(Option<Samples>, Option<Gpu>)>,
}

impl ComparePhotograph {
    /// Of the photograph that is open, which is `photograph` once it has been read.
    pub fn of(
        state: &PhotographState,
        materials: &[LoadedMaterial],
        view: &ViewState,
        photograph: Option<Samples>,
        gpu: Option<&Gpu>,
    ) -> Option<Self> {
        Some(Self {
            read: ReadPhotograph::of(state)?,
            falloff: state.source()?.falloff,
            materials: Content::all(materials),
            scene: view.scene,
            convention: view.convention(),
            kind: view.display.differences.kind(Quantity::Rendering),
            given: Given((photograph, gpu.cloned())),
        })
    }

    /// Whether it is of the same photograph and materials, perhaps in another scene.
    pub fn is_like(&self, other: &Self) -> bool {
        self.materials == other.materials && self.read == other.read
    }

    /// Whether the differences are of the same kind, too.
    pub fn has_kind_of(&self, other: &Self) -> bool {
        self.is_like(other) && self.kind == other.kind
    }
}

impl Question for ComparePhotograph {
    type Answer = Photographs;
    const IS_SHORT: bool = true;
    const KEPT: usize = 1;

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

    fn new(asked: &ComparePhotograph, progress: &Progress) -> Result<Self, Error> {
        let ComparePhotograph { read, falloff, scene, convention, kind, given, .. } = asked;
        let Given((photograph, gpu)) = given;
        let photograph = photograph.as_ref().ok_or_else(|| Error::internal("the photograph is not read"))?;
        let (name, falloff) = (file_name(&read.path), falloff.then_some(scene));
        let one = |loaded: &Arc<ReadMaterial>| -> Result<_, Error> {
            let material = loaded.material();
            let photographs = [(on_texels(photograph, &name, material.size(), falloff)?, *scene)];
            Ok(compare(&photographs, material, material.name(), convention, progress)?.remove(0))
        };
        let materials = read_all(&asked.materials)?;
        let comparisons = materials.iter().map(one).collect::<Result<Vec<_>, _>>()?;
        let values: Vec<_> = comparisons.iter().map(|compared| compared.differences(*kind)).collect();
        let distributions = Distributions::of(&values, kind.is_signed());
        let upload = |gpu: &Gpu| {
            let one =
                |compared: &PhotographComparison| Shaded::of_image(gpu, &compared.photograph).map(Arc::new);
            comparisons.iter().map(one).collect::<Result<Vec<_>, _>>()
        };
        let shaded = gpu.as_ref().map(upload).transpose()?.unwrap_or_default();
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
    pub all: Option<&'a Photographs>,
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
