//! Small materials for renderers that write pictures and no arrays: every texel is a point, whose place depends on the grid.

use glam::DVec3;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

use svbrdf_core::image::Image;
use svbrdf_core::model::grammar::words::{Rows, Sites};
use svbrdf_core::model::grammar::{GridTerms, Point, RendererTerms};
use svbrdf_core::model::scene::{Kind, Scene};

use super::probes::Answer;

/// Texels along a side.
pub const SIDE: usize = 8;
/// The light and the camera of each material, in units of half its width: at the light, apart, grazing, near and far.
const PLACES: [[[f64; 3]; 2]; 6] = [
    [[0.0, 0.0, 2.0], [0.0, 0.0, 2.0]],
    [[0.6, -0.4, 1.2], [-0.5, 0.3, 1.6]],
    [[2.2, 0.5, 0.6], [-1.5, -0.8, 1.0]],
    [[0.2, 0.3, 0.5], [0.1, -0.4, 2.5]],
    [[-3.0, 2.0, 5.0], [2.0, 1.5, 4.0]],
    [[0.5, 1.5, 2.0], [-3.0, 0.5, 0.8]],
];

/// A material to be rendered in one scene.
#[derive(Clone, Debug)]
pub struct ProbeMaterial {
    pub scene: Scene,
    /// Row 0 on top, without light and view.
    texels: Vec<Point>,
}

/// The materials, of random texels whose maps are exact in float32; in half of them the normal is near the half vector.
pub fn probe_materials() -> Vec<ProbeMaterial> {
    let random = &mut ChaCha8Rng::seed_from_u64(0);
    let material = |[light, view]: [[f64; 3]; 2]| {
        let texels = (0..SIDE * SIDE).map(|i| texel(i, light.into(), view.into(), random)).collect();
        ProbeMaterial { scene: Scene { kind: Kind::Near, view, light }, texels }
    };
    PLACES.map(material).into()
}

fn texel(i: usize, light: DVec3, view: DVec3, random: &mut ChaCha8Rng) -> Point {
    let mut uniform = |low: f64, high: f64| f64::from((low + (high - low) * random.random::<f64>()) as f32);
    let roughness = if i % 4 == 3 { uniform(0.05, 0.25) } else { uniform(0.2, 1.0) };
    let at = RendererTerms::BASE.grid.position(i % SIDE, i / SIDE, SIDE, SIDE);
    let half = (light - at).normalize() + (view - at).normalize();
    let mut offset = || DVec3::new(uniform(-1.0, 1.0), uniform(-1.0, 1.0), 0.0);
    let normal = match i % 2 {
        0 => half.normalize() + roughness.powi(2) * offset(),
        _ => DVec3::Z + 0.8 * offset(),
    };
    let normal = normal.normalize().to_array().map(|x| f64::from(x as f32));
    let mut colour = |is_black: bool| [0; 3].map(|_| if is_black { 0.0 } else { uniform(0.02, 0.9) });
    let (diffuse, specular, base_color) = (colour(i % 8 == 4), colour(i % 8 == 5), colour(false));
    let metallic = match i % 3 {
        0 => 0.0,
        1 => 1.0,
        _ => uniform(0.0, 1.0),
    };
    let [light, view] = [[0.0; 3]; 2];
    Point { normal, diffuse, specular, roughness, base_color, metallic, light, view }
}

impl ProbeMaterial {
    /// The maps by their names, linear; normals are vectors of unit length, y up.
    pub fn maps(&self) -> [(&'static str, Image<f32>); 6] {
        let map = |of: fn(&Point) -> [f64; 3]| Image {
            width: SIDE,
            height: SIDE,
            pixels: self.texels.iter().map(|texel| of(texel).map(|x| x as f32)).collect(),
        };
        [
            ("normal", map(|texel| texel.normal)),
            ("diffuse", map(|texel| texel.diffuse)),
            ("specular", map(|texel| texel.specular)),
            ("roughness", map(|texel| [texel.roughness; 3])),
            ("base_color", map(|texel| texel.base_color)),
            ("metallic", map(|texel| [texel.metallic; 3])),
        ]
    }

    /// The texels at their places on a grid.
    pub fn points(&self, grid: &GridTerms) -> Vec<Point> {
        let (light, view) = (self.scene.light.into(), self.scene.view.into());
        let point = |(i, texel): (usize, &Point)| {
            let at = grid.position(i % SIDE, i / SIDE, SIDE, SIDE);
            let (light, view) = grid.vectors(at, light, view, true);
            Point { light: light.to_array(), view: view.to_array(), ..*texel }
        };
        self.texels.iter().enumerate().map(point).collect()
    }
}

impl Answer {
    /// The answer in renderings of the [materials](probe_materials), in their order.
    ///
    /// # Errors
    /// Which picture has another size.
    pub fn of_pictures(pictures: &[Image<f32>], metallic: Option<bool>) -> Result<Self, String> {
        let materials = probe_materials();
        for (number, picture) in pictures.iter().enumerate() {
            if [picture.width, picture.height] != [SIDE; 2] {
                let [width, height] = [picture.width, picture.height];
                return Err(format!(
                    "picture {number}: expected {SIDE} x {SIDE} texels, found {width} x {height}"
                ));
            }
        }
        let radiance = pictures.iter().flat_map(|picture| &picture.pixels).map(|rgb| rgb.map(f64::from));
        let radiance = radiance.collect();
        let on = |grid: GridTerms| {
            (grid, materials.iter().flat_map(|material| material.points(&grid)).collect::<Vec<_>>())
        };
        let grids = Rows::ALL.into_iter().flat_map(|orientation| {
            Sites::ALL.map(|sampling| GridTerms { sampling, orientation, ..RendererTerms::BASE.grid })
        });
        let grids: Vec<_> = grids.map(on).collect();
        let points = grids.first().map(|(_, points)| points.clone()).unwrap_or_default();
        Ok(Self { points, grids, radiance, metallic, picture: None })
    }
}
