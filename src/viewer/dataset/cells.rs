//! Small materials of a data set, for the contact sheet: a row at a time.

use std::sync::Arc;

use rayon::prelude::*;

use svbrdf_core::material::Material;
use svbrdf_core::progress::Progress;
use svbrdf_files::read::Read;

use crate::error::Error;
use crate::jobs::answers::{Pace, Question, Work};
use crate::model::dataset::OpenDataset;

/// Longest sides of small materials, in texels.
const SIDES: [usize; 4] = [48, 96, 192, 384];

/// A material of a data set: in column 0 the ground truth, from column 1 on the prediction of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SheetCell {
    pub case: usize,
    pub column: usize,
}

/// A small material, or why there is none.
pub type Reduced = Result<Arc<Material<f32>>, String>;

/// The small ground truth of a material, and the predictions of all methods.
#[derive(Clone, Debug)]
pub struct ReadRow {
    open: Arc<OpenDataset>,
    case: usize,
    /// Longest side, in texels.
    side: usize,
    version: u64,
}

impl PartialEq for ReadRow {
    fn eq(&self, other: &Self) -> bool {
        let of = |one: &Self| (Arc::as_ptr(&one.open).addr(), one.case, one.side, one.version);
        of(self) == of(other)
    }
}

impl ReadRow {
    /// The row of a material that is drawn with this longest side in pixels, after its files were read again so often.
    pub fn of(open: &Arc<OpenDataset>, case: usize, pixels: usize, version: u64) -> Self {
        let side = SIDES.into_iter().find(|side| *side >= pixels).unwrap_or(SIDES[SIDES.len() - 1]);
        Self { open: open.clone(), case, side, version }
    }

    fn read(&self, column: usize, progress: &Progress) -> Reduced {
        let source = self.open.source(self.case, column)?;
        let read: Read<f32> = source.read(&progress.part()).map_err(|error| error.to_string())?;
        let size = read.material.size();
        let (longest, side) = (size[0].max(size[1]), self.side);
        let small = size.map(|length| if longest > side { (length * side / longest).max(1) } else { length });
        read.material.resized(small).map(Arc::new).map_err(|error| error.to_string())
    }
}

impl Question for ReadRow {
    type Answer = Vec<Reduced>;
    const PACE: Pace = Pace::AtOnce;
    const KEPT: usize = 32;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<Self::Answer, Error> {
        let columns = 0..=self.open.methods().len();
        Ok(columns.into_par_iter().map(|column| self.read(column, work.progress())).collect())
    }
}
