//! Inspection of texels: pins with their numbers, computed in f64, and a rectangle.

use svbrdf_core::material::{Grid, Material};
use svbrdf_core::model::brdf::{Model, Texel};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::model::terms::Terms;
use svbrdf_core::render::{texel_terms, widened};
use svbrdf_files::session::window::SessionInspection;

/// Most pinned texels.
const MOST: usize = 12;

/// Pinned texels and the rectangle. Undo does not cover them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Inspection {
    /// The pinned (column, row)s, the earliest first.
    pub pins: Vec<[usize; 2]>,
    pub region: Option<Region>,
    /// Whether the next left-drag draws the rectangle.
    pub is_armed: bool,
}

impl Inspection {
    /// Pins a texel, or removes its pin. The earliest pin makes room for one too many.
    pub fn toggle_pin(&mut self, texel: [usize; 2]) {
        if let Some(index) = self.pins.iter().position(|pin| *pin == texel) {
            self.pins.remove(index);
            return;
        }
        self.pin(texel);
    }

    fn pin(&mut self, texel: [usize; 2]) {
        self.pins.retain(|pin| *pin != texel);
        if self.pins.len() == MOST {
            self.pins.remove(0);
        }
        self.pins.push(texel);
    }

    /// Drops what lies outside of materials of `size` = (width, height).
    pub fn keep_within(&mut self, size: [usize; 2]) {
        self.pins.retain(|pin| pin[0] < size[0] && pin[1] < size[1]);
        self.region = self.region.filter(|region| region.fits(size));
    }
}

impl From<&Inspection> for SessionInspection {
    fn from(inspection: &Inspection) -> Self {
        let rectangle = inspection.region.map(|region| [region.first, region.last]);
        Self { pins: inspection.pins.clone(), rectangle }
    }
}

impl From<&SessionInspection> for Inspection {
    /// Leaves out what no material has.
    fn from(saved: &SessionInspection) -> Self {
        let mut inspection = Self::default();
        saved.pins.iter().for_each(|pin| inspection.pin(*pin));
        let is_ordered = |[first, last]: &[[usize; 2]; 2]| (0..2).all(|axis| first[axis] <= last[axis]);
        inspection.region = saved.rectangle.filter(is_ordered).map(|[first, last]| Region { first, last });
        inspection
    }
}

/// A rectangle of texels, both ends included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    /// The least (column, row).
    pub first: [usize; 2],
    /// The greatest (column, row).
    pub last: [usize; 2],
}

impl Region {
    /// The texels between two points of the plane, both included; `None` where the material has none there.
    pub fn between(grid: Grid, a: [f32; 2], b: [f32; 2]) -> Option<Self> {
        let (a, b) = (grid.place(a), grid.place(b));
        let (mut first, mut last) = ([0; 2], [0; 2]);
        for (axis, count) in [grid.width, grid.height].into_iter().enumerate() {
            let (low, high) = (a[axis].min(b[axis]), a[axis].max(b[axis]));
            if high < 0.0 || low >= count as f32 {
                return None;
            }
            first[axis] = low.max(0.0) as usize;
            last[axis] = (high as usize).min(count - 1);
        }
        Some(Self { first, last })
    }

    /// (columns, rows).
    pub fn size(&self) -> [usize; 2] {
        [0, 1].map(|axis| (self.last[axis] - self.first[axis]).saturating_add(1))
    }

    /// Whether a material of `size` = (width, height) has all of it.
    pub fn fits(&self, size: [usize; 2]) -> bool {
        (0..2).all(|axis| self.last[axis] < size[axis])
    }

    /// The places of its upper left and its lower right corner.
    pub fn edges(&self) -> [[f32; 2]; 2] {
        [self.first.map(|number| number as f32), self.last.map(|number| number as f32 + 1.0)]
    }

    /// (left, top, width, height), as graphics adapters take rectangles.
    pub fn rectangle(self) -> [u32; 4] {
        let ([left, top], [width, height]) = (self.first, self.size());
        [left, top, width, height].map(|number| number as u32)
    }
}

/// The columns of [`PinnedTexel::cells`]: a name, and what it means.
pub const HEADS: [(&str, &str); 14] = [
    ("normal", "The unit normal: x, y, z"),
    ("diffuse", "Diffuse albedo, linear RGB"),
    ("specular", "Specular reflectance at normal incidence, linear RGB"),
    ("roughness", "Roughness; the GGX width is its square"),
    ("rendering", "Radiance under this light and view, linear RGB"),
    ("D", "The distribution of microfacets"),
    ("G", "The geometry term, with 1 / (NoL NoV) of the microfacet denominator cancelled"),
    ("F", "The Fresnel term, RGB"),
    ("NoL", "Cosine between normal and light"),
    ("NoV", "Cosine between normal and view"),
    ("NoH", "Cosine between normal and half vector"),
    ("VoH", "Cosine between view and half vector"),
    ("normal error", "The angle to the ground truth's normal, in degrees"),
    (
        "loss term",
        "Mean over RGB of the difference that the convention takes, |ln(p + epsilon) - ln(g + epsilon)| or that of its norm: the texel's \
        part of the loss of this scene",
    ),
];

/// A texel of one material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PinnedTexel {
    pub texel: Texel<f64>,
    pub terms: Terms<f64>,
    /// The angle to the ground truth's normal in degrees, and the loss term; `None` for the ground truth.
    pub errors: Option<[f64; 2]>,
}

impl PinnedTexel {
    /// The numbers in the order of [`HEADS`].
    pub fn cells(&self) -> [Vec<f64>; 14] {
        let Self { texel, terms, errors } = self;
        let error = |i: usize| errors.map_or_else(Vec::new, |errors| vec![errors[i]]);
        [
            texel.normal.to_array().to_vec(),
            texel.diffuse.to_vec(),
            texel.specular.to_vec(),
            vec![texel.roughness],
            terms.radiance.to_vec(),
            vec![terms.d],
            vec![terms.g],
            terms.f.to_vec(),
            vec![terms.n_dot_l],
            vec![terms.n_dot_v],
            vec![terms.n_dot_h],
            vec![terms.v_dot_h],
            error(0),
            error(1),
        ]
    }
}

/// The texel in column `column` of row `row` of every material, the ground truth first.
pub fn rows<'a>(
    materials: impl IntoIterator<Item = &'a Material<f32>>,
    [column, row]: [usize; 2],
    scene: &Scene,
    convention: &Convention,
) -> Vec<PinnedTexel> {
    let (model, rays) = (Model::<f64>::from(convention), scene.rays::<f64>());
    let mut rows: Vec<PinnedTexel> = Vec::new();
    for material in materials {
        let texel = widened(&material.texel(row * material.width() + column));
        let terms = texel_terms(&texel, material.grid(), &model, &rays, [column, row]);
        let errors = rows.first().map(|ground_truth| {
            let [g, p] = [ground_truth.terms.radiance, terms.radiance];
            let loss = convention.norm().of(&p, &g, convention.epsilon).unwrap_or_default();
            let [g, p] = [ground_truth.texel.normal, texel.normal];
            [g.cross(p).length().atan2(g.dot(p)).to_degrees(), loss]
        });
        rows.push(PinnedTexel { texel, terms, errors });
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    use svbrdf_core::model::convention::PRINTED;
    use svbrdf_core::model::scene::Kind;
    use svbrdf_core::progress::Progress;
    use svbrdf_core::render;
    use svbrdf_files::samples;

    #[test]
    fn a_pin_is_set_once_and_removed_by_setting_it_again() {
        let mut inspection = Inspection::default();
        for texel in [[1, 2], [3, 4], [1, 2]] {
            inspection.toggle_pin(texel);
        }
        assert_eq!(inspection.pins, [[3, 4]]);
        (0..20).for_each(|i| inspection.toggle_pin([i, 9]));
        assert_eq!((inspection.pins.len(), inspection.pins[0]), (MOST, [8, 9]));
        inspection.keep_within([10, 10]);
        assert_eq!(inspection.pins, [[8, 9], [9, 9]]);
        inspection.keep_within([10, 9]);
        assert!(inspection.pins.is_empty());
    }

    #[test]
    fn what_a_session_holds_comes_back_and_no_number_of_it_breaks_the_window() {
        let region = Some(Region { first: [2, 3], last: [9, 3] });
        let inspection = Inspection { pins: vec![[1, 2], [3, 4]], region, is_armed: false };
        assert_eq!(Inspection::from(&SessionInspection::from(&inspection)), inspection);
        let rectangles = [[[5, 5], [4, 6]], [[0, 0], [usize::MAX, usize::MAX]], [[usize::MAX; 2]; 2]];
        for rectangle in rectangles {
            let pins = (0..40).map(|i| [usize::MAX - i, 0]).collect();
            let mut found = Inspection::from(&SessionInspection { pins, rectangle: Some(rectangle) });
            assert_eq!(found.pins.len(), MOST);
            found.keep_within([256, 256]);
            assert!(found.pins.is_empty() && found.region.is_none(), "{found:?}");
        }
    }

    const GRID: Grid = Grid { width: 48, height: 20 };

    #[test]
    fn a_rectangle_is_limited_to_the_material() {
        let all = Region::between(GRID, [-9.0, 9.0], [9.0, -9.0]).unwrap();
        assert_eq!((all.first, all.last), ([0, 0], [47, 19]));
        assert_eq!(Region::between(GRID, [2.0, 0.0], [3.0, 0.1]), None);
        assert!(all.fits([48, 20]) && !all.fits([47, 20]) && !all.fits([48, 19]));
    }

    #[test]
    fn the_numbers_of_a_pin_are_those_of_the_core_in_f64() {
        let samples = samples::load::<f32>().unwrap();
        let materials = [samples.ground_truth.material, samples.predictions[0].material.clone()];
        let scene = Scene { kind: Kind::Near, view: [0.3, -0.2, 2.0], light: [0.4, 0.5, 1.2] };
        let pictures = [0, 1].map(|i| {
            render::render(&materials[i].cast::<f64>(), &scene, &PRINTED, &Progress::default()).unwrap()
        });
        for texel in [[0, 0], [255, 0], [0, 255], [255, 255], [100, 37]] {
            let index = texel[1] * 256 + texel[0];
            let rows = rows(&materials, texel, &scene, &PRINTED);
            let [g, p] = [0, 1].map(|i| pictures[i].pixels[index]);
            assert_eq!([rows[0].terms.radiance, rows[1].terms.radiance], [g, p], "{texel:?}");
            let ln = |v: f64| (v + PRINTED.epsilon).ln();
            let loss = (0..3).map(|c| (ln(p[c]) - ln(g[c])).abs()).sum::<f64>() / 3.0;
            assert_eq!(rows[1].errors.unwrap()[1], loss);
            assert!(rows[0].errors.is_none());
        }
    }
}
