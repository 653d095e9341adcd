//! A map as stored: a picture, or a channel of one, before its values are interpreted.

use std::path::{Path, PathBuf};

use rayon::prelude::*;

use crate::disk::open::NamedFile;
use crate::read::options::transfer::{encoded, linear};
use crate::read::options::{Albedo, Workflow};
use crate::read::raster::{Raster, Samples};
use crate::read::record::{Note, Unused};

/// The part of a map that is specified as a value.
const SPECIFIED: &str = "a constant";

/// The heights of a material, which tell the direction of y in its normals.
#[derive(Clone, Debug)]
pub(crate) enum StoredHeight {
    /// A file, decoded only where names leave the direction open.
    File(NamedFile),
    Picture {
        raster: Raster,
        file: PathBuf,
    },
}

/// A map as stored.
#[derive(Clone, Debug)]
pub(crate) struct StoredMap {
    pub raster: Raster,
    pub file: PathBuf,
    /// Layer, channel or tile within the file, for people; may be empty.
    pub part: String,
}

impl StoredMap {
    /// The note that a workflow does not use this map.
    pub(crate) fn unused(&self, workflow: Workflow) -> Note {
        let part = if self.part.is_empty() { String::new() } else { format!(", {}", self.part) };
        Note::Unused { what: format!("{}{part}", self.file.display()), why: Unused::Workflow(workflow) }
    }

    /// A map that is specified as these values; they stand where other maps have a file.
    pub(crate) fn specified(values: &[f32]) -> Self {
        let text = values.iter().map(f32::to_string).collect::<Vec<_>>().join(",");
        Self { raster: Raster::constant("value", values), file: text.into(), part: SPECIFIED.to_owned() }
    }

    /// Whether it is specified as a value, and in no file.
    pub(crate) fn is_specified(&self) -> bool {
        self.part == SPECIFIED
    }

    /// A map of one value that stands in the file `path`.
    pub(crate) fn constant(path: &Path, values: &[f32]) -> Self {
        let raster = Raster::constant("value", values);
        Self { raster, file: path.to_owned(), part: "value".to_owned() }
    }

    /// Colours stored as `space` times linear factors, stored likewise.
    pub(crate) fn times(self, factor: [f32; 3], space: Albedo) -> Self {
        if factor == [1.0; 3] {
            return self;
        }
        let last = self.raster.channels.len() - 1;
        let times = |c: usize| {
            let plane = &self.raster.channels[last.min(c)];
            Samples::floats(plane.decoded(|v| encoded(linear(v, space) * f64::from(factor[c]), space)))
        };
        let channels = [0, 1, 2].map(times).into();
        Self { raster: Raster { channels, ..self.raster.without_samples() }, ..self }
    }

    /// Normals stored as (n + 1) / 2 with x and y times `scale`, of length 1 again, stored likewise as floats.
    pub(crate) fn scaled_normals(self, scale: f64) -> Self {
        if scale == 1.0 || self.raster.channels.len() < 3 {
            return self;
        }
        let raster = &self.raster;
        let texel = |index: usize| {
            let [x, y, z] = raster.rgb(index).map(|c| 2.0 * c - 1.0);
            let n = [scale * x, scale * y, z];
            let length = n.iter().map(|x| x * x).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
            n.map(|x| (0.5 * x / length + 0.5) as f32)
        };
        let texels: Vec<[f32; 3]> = (0..raster.width * raster.height).into_par_iter().map(texel).collect();
        let channels = Samples::interleaved(texels.into_flattened(), 3);
        Self { raster: Raster { channels, alpha: None, ..raster.without_samples() }, ..self }
    }

    /// Takes the samples out, so that they can be dropped; size and names stay.
    pub(crate) fn take(&mut self) -> Self {
        let left = self.raster.without_samples();
        Self {
            raster: std::mem::replace(&mut self.raster, left),
            file: self.file.clone(),
            part: self.part.clone(),
        }
    }
}
