//! A located surface of MaterialX.

use std::path::{Path, PathBuf};

use super::picture::LocatedPicture;
use super::surface_model::{SurfaceModel, USE_SPECULAR};

/// A surface of a MaterialX document, its inputs followed to pictures and values.
#[derive(Debug)]
pub(crate) struct LocatedMtlx {
    pub path: PathBuf,
    /// The name of the surface.
    pub name: String,
    pub model: &'static SurfaceModel,
    /// The inputs that are read, by name.
    pub inputs: Vec<(&'static str, Result<Bound, Obstacle>)>,
    /// The pictures that inputs lead to, each once for every map that it is read as.
    pub pictures: Vec<LocatedPicture>,
    /// Inputs that change the look and are not modelled.
    pub not_modelled: Vec<String>,
    /// The names of all surfaces of the document, and which of them this is.
    pub surfaces: (Vec<String>, usize),
}

/// What an input is bound to.
#[derive(Clone, Debug)]
pub(crate) enum Bound {
    /// A value, and its colour space where the file declares it.
    Values {
        values: Vec<f32>,
        space: Option<String>,
    },
    Picture(BoundPicture),
}

/// The picture that an input is bound to.
#[derive(Clone, Debug)]
pub(crate) struct BoundPicture {
    pub file: String,
    /// The colour space where the file declares it.
    pub space: Option<String>,
    /// Whether its node is one of colours, so that the colour space counts.
    pub is_colour: bool,
    /// The one channel that is taken of it.
    pub channel: Option<usize>,
    /// What is computed of its linear numbers.
    pub affine: Affine,
    /// The scale of x and y of a normal.
    pub scale: f32,
}

/// Products with `scale` plus `offset`, for red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Affine {
    pub scale: [f32; 3],
    pub offset: [f32; 3],
}

impl Default for Affine {
    fn default() -> Self {
        Self { scale: [1.0; 3], offset: [0.0; 3] }
    }
}

impl Bound {
    /// Channel number `channel` alone.
    #[must_use]
    pub(crate) fn channel(self, channel: usize) -> Self {
        match self {
            Self::Values { values, .. } if values.len() > 1 => {
                let value = values.get(channel).or(values.last()).copied().unwrap_or_default();
                Self::Values { values: vec![value], space: None }
            }
            Self::Picture(picture) if picture.channel.is_none() => {
                let Affine { scale, offset } = picture.affine;
                let one = |three: [f32; 3]| [three.get(channel).copied().unwrap_or(three[2]); 3];
                let affine = Affine { scale: one(scale), offset: one(offset) };
                Self::Picture(BoundPicture { channel: Some(channel), affine, ..picture })
            }
            other => other,
        }
    }
}

/// What stands in the way from an input to a picture or a value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Obstacle {
    /// A node that computes, by its name and kind.
    Procedural(String),
    /// A name that leads nowhere, or round.
    Nowhere(String),
    /// Normals of another space than that of the tangents, by its name.
    Space(String),
}

impl LocatedMtlx {
    /// What input `name` is bound to; `None` where the document does not declare it.
    pub(crate) fn bound(&self, name: &str) -> Option<&Result<Bound, Obstacle>> {
        self.inputs.iter().find(|(input, _)| *input == name).map(|(_, bound)| bound)
    }

    /// Whether the surface is a `UsdPreviewSurface` in its specular workflow.
    pub(crate) fn is_specular_usd(&self) -> bool {
        let declared = self.bound(USE_SPECULAR);
        matches!(declared, Some(Ok(Bound::Values { values, .. })) if values.first().is_some_and(|v| *v != 0.0))
    }

    /// The path of a file beside the document, or of a path of its own.
    pub(crate) fn path_of(&self, file: &str) -> PathBuf {
        self.path.parent().unwrap_or(Path::new("")).join(file)
    }
}
