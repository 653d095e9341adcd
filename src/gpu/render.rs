//! One rendering on the device, read back.

use svbrdf_core::error::Error;
use svbrdf_core::image::Image;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::quantity::Quantity;

use super::{Gpu, MaterialTextures, ShadeParams, Shading};

impl Gpu {
    /// Algorithm 3 over a whole material, as [`svbrdf_core::render::render`] computes it on the CPU.
    ///
    /// # Errors
    /// [`Error::UnusableScene`] where [`Scene::check`] refuses the scene, [`Error::Gpu`] where the adapter cannot
    /// render to 32-bit floats, the material is too large for it, or it fails.
    pub fn render(
        &self,
        material: &Material<f32>,
        scene: &Scene,
        convention: &Convention,
    ) -> Result<Image<f32>, Error> {
        scene.check_usable()?;
        let textures = MaterialTextures::upload(self, material)?;
        let shading = Shading::new(self)?;
        let target = shading.target(self, material.size())?;
        let params = ShadeParams {
            scene: *scene,
            convention: *convention,
            quantity: Quantity::Rendering,
            repeated: false,
        };
        shading.draw(self, &textures, &params, &target);
        target.read_back(self)
    }
}
