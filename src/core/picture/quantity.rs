//! The quantities of a material: its rendering and its maps.

use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::image::Image;
use crate::material::Material;
use crate::model::brdf::Model;
use crate::model::convention::Convention;
use crate::model::scene::Scene;
use crate::progress::Progress;
use crate::render;

/// The rendering or a map of a material.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Quantity {
    /// Algorithm 3 under the light and the view.
    #[default]
    Rendering,
    /// The unit normal n as (n + 1) / 2, as normal maps are stored.
    Normal,
    /// The diffuse albedo, linear; encoded as sRGB on the screen.
    Diffuse,
    /// The specular reflectance, linear; encoded as sRGB on the screen.
    Specular,
    /// The roughness as a gray value, shown as it is.
    Roughness,
}

impl Quantity {
    /// Every choice, in the order in which keys cycle through them.
    pub const ALL: [Self; 5] =
        [Self::Rendering, Self::Normal, Self::Diffuse, Self::Specular, Self::Roughness];

    /// The name for users.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rendering => "rendering",
            Self::Normal => "normal",
            Self::Diffuse => "diffuse",
            Self::Specular => "specular",
            Self::Roughness => "roughness",
        }
    }

    /// The quantity of the texel in column `column` of row `row`; of normals (x, y, z), of roughness the same three times.
    pub fn at(
        self,
        material: &Material<f32>,
        scene: &Scene,
        convention: &Convention,
        [column, row]: [usize; 2],
    ) -> [f32; 3] {
        let texel = || material.texel(row * material.width() + column);
        match self {
            Self::Rendering => {
                render::render_texel(material, &Model::from(convention), &scene.rays(), column, row)
            }
            Self::Normal => texel().normal.to_array(),
            Self::Diffuse => texel().diffuse,
            Self::Specular => texel().specular,
            Self::Roughness => [texel().roughness; 3],
        }
    }

    /// How many numbers a texel has that differ from each other: 1 for roughness, otherwise 3.
    pub fn channels(self) -> usize {
        if self == Self::Roughness { 1 } else { 3 }
    }

    /// The quantity of every texel of `material` as linear RGB; of normals (x, y, z), of roughness the same three times.
    ///
    /// # Errors
    /// Those of [`render::render_f32`].
    pub fn image(
        self,
        material: &Material<f32>,
        scene: &Scene,
        convention: &Convention,
        progress: &Progress,
    ) -> Result<Image<f32>, Error> {
        let planes = material.planes();
        let [x, y, z] = match self {
            Self::Rendering => return render::render_f32(material, scene, convention, progress),
            Self::Normal => planes.normal.each_ref(),
            Self::Diffuse => planes.diffuse.each_ref(),
            Self::Specular => planes.specular.each_ref(),
            Self::Roughness => [&planes.roughness; 3],
        };
        let pixels = (0..x.len()).map(|i| [x[i], y[i], z[i]]).collect();
        Ok(Image { width: material.width(), height: material.height(), pixels })
    }
}

impl FromStr for Quantity {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let found = Self::ALL.into_iter().find(|quantity| quantity.name() == text);
        found.ok_or_else(|| Error::unknown_name("quantity", text, Self::ALL.map(Self::name).join(", ")))
    }
}
