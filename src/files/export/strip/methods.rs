//! A figure of methods: materials in rows, the ground truth and each method in columns, all under one light and view.

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::image::Image;
use svbrdf_core::material::{Mask, Material};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::content::PictureContent;
use svbrdf_core::picture::difference::DifferenceParams;
use svbrdf_core::picture::exposure;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::progress::Progress;

use super::crop::Crop;
use super::legend::{self, content_name, scene_text, stops};
use super::sheet::{Division, GAP, Paper, SMALL, Sheet, style};
use crate::disk::memory;
use crate::error::Error;
use crate::export::figure::{Anchor, Figure, MILLIMETRE};

/// The place of a prediction that is not there.
const MISSING: [u8; 3] = [224; 3];
/// Steps in which the width of a figure of a given height is found, to a 4096th of what it is without one: a step lays out all texts.
const HALVINGS: usize = 12;
/// Points of an inch.
const INCH: f64 = 72.0;

/// What every cell shows, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct MethodStrip {
    /// Of a difference, its range is one of all cells.
    pub content: PictureContent,
    pub scene: Scene,
    pub convention: Convention,
    /// Stops by which renderings are brightened. `None`: for each row so that the brightest 1% of its ground truth just clip.
    pub exposure_ev: Option<f32>,
    /// Rectangles of texels that are framed in every cell and magnified beside it.
    pub crops: Vec<Crop>,
    pub paper: Paper,
    /// Pixels of an inch: larger materials are averaged to their cell, unless there are crops.
    pub dpi: f64,
}

/// What a row has of a material.
#[derive(Clone, Debug)]
pub struct MethodRow {
    /// The ground truth, then a prediction of each method; `None` where there is none. One of another size is as none.
    pub materials: Vec<Option<Material<f32>>>,
    /// Texels outside of it are gray.
    pub mask: Option<Mask>,
    /// What stands below each of them, such as its loss; none without.
    pub texts: Vec<String>,
}

impl MethodStrip {
    /// The figure under the names of the methods, a row for each of the named materials; `row` reads it when it is drawn. The ground
    /// truth shows its value where predictions show a difference from it.
    ///
    /// # Errors
    /// Those of [`PictureContent::pictures`], and of [`Material::resized`]; [`Error::Memory`]; [`Error::FigureTooNarrow`];
    /// [`Error::CropOutside`].
    pub fn figure(
        &self,
        methods: &[String],
        materials: &[String],
        row: impl Fn(usize) -> MethodRow,
        progress: &Progress,
    ) -> Result<Figure, Error> {
        progress.begin(materials.len() as u64);
        let (sheet, mut figure, mut top) = self.headed(methods, materials)?;
        let (side, [rows, columns]) = (self.side(&sheet), [materials.len(), 1 + methods.len()]);
        let what = || format!("a figure of {rows} x {columns} cells of {side} pixels");
        let _reserved = memory::reserve((3 * side * side * rows * columns) as u64, what)?;
        for (index, name) in materials.iter().enumerate() {
            top = self.draw_row(&mut figure, &sheet, top, (name, &row(index)), progress)?;
            progress.step()?;
        }
        self.end(&mut figure, &sheet, top);
        Ok(figure)
    }

    /// The same figure, as narrow as a height in millimetres takes. `sizes` are those of the ground truths, `None` where there is none;
    /// `has_texts`: whether there are texts below the cells.
    ///
    /// # Errors
    /// [`Error::FigureTooHigh`]; those of [`MethodStrip::figure`] but of its pictures.
    pub fn within(
        &self,
        height_mm: f64,
        (methods, materials): (&[String], &[String]),
        sizes: &[Option<[usize; 2]>],
        has_texts: bool,
    ) -> Result<Self, Error> {
        let millimetres = |strip: &Self| {
            let size = strip.size((methods, materials), sizes, has_texts)?;
            Ok::<_, Error>(size.map(|side| side / MILLIMETRE))
        };
        let [width, mut least] = millimetres(self)?;
        if least <= height_mm {
            return Ok(self.clone());
        }
        let (mut found, mut ends) = (None, [0.0, width]);
        for _ in 0..HALVINGS {
            let width = 0.5 * (ends[0] + ends[1]);
            let narrower = Self { paper: Paper { width_mm: Some(width), ..self.paper }, ..self.clone() };
            match millimetres(&narrower) {
                Ok([_, height]) if height > height_mm => {
                    least = least.min(height);
                    ends[1] = width;
                }
                Ok(_) => {
                    found = Some(narrower);
                    ends[0] = width;
                }
                Err(Error::FigureTooNarrow { .. }) => ends[0] = width,
                Err(other) => return Err(other),
            }
        }
        let (rows, text_pt) = (materials.len(), self.paper.text_pt);
        found.ok_or(Error::FigureTooHigh { height_mm, rows, text_pt, least: least.ceil() })
    }

    /// Width and height in points.
    fn size(
        &self,
        (methods, materials): (&[String], &[String]),
        sizes: &[Option<[usize; 2]>],
        has_texts: bool,
    ) -> Result<[f64; 2], Error> {
        let (sheet, mut figure, mut top) = self.headed(methods, materials)?;
        let side = self.side(&sheet);
        for size in sizes {
            let cell = size.map_or([side; 2], |size| self.reduced_size(size, side));
            top += row_height(&sheet, &Division::new(cell, &self.crops, sheet.column)?, has_texts);
        }
        self.end(&mut figure, &sheet, top);
        Ok(figure.size)
    }

    /// A figure with the names of its columns, and the top of its first row.
    fn headed(&self, methods: &[String], materials: &[String]) -> Result<(Sheet, Figure, f64), Error> {
        let heads = std::iter::once("ground truth").chain(methods.iter().map(String::as_str));
        let heads: Vec<Vec<(String, f64)>> = heads.map(|head| vec![(head.to_owned(), 1.0)]).collect();
        let sheet = Sheet::new(self.paper, heads.len(), materials, !self.crops.is_empty())?;
        let mut figure = Figure::new([sheet.width, 0.0], self.dpi / INCH);
        let top = sheet.headings(&mut figure, &heads);
        Ok((sheet, figure, top))
    }

    /// Ends a figure with what is below its rows.
    fn end(&self, figure: &mut Figure, sheet: &Sheet, mut top: f64) {
        if let Some(difference) = self.content.difference {
            let width = sheet.column.max(8.0 * sheet.em);
            legend::draw(figure, [sheet.left(1), top], width, sheet.em, difference);
            top += (legend::HEIGHT + GAP) * sheet.em;
        }
        figure.size[1] = sheet.note(figure, top, &self.note());
    }

    /// Pixels of a cell without insets.
    fn side(&self, sheet: &Sheet) -> usize {
        (sheet.column * self.dpi / INCH).round().max(1.0) as usize
    }

    fn note(&self) -> String {
        let shown = content_name(&self.content);
        if self.content.quantity != Quantity::Rendering {
            return shown;
        }
        let each = || "each row exposed to the brightest 1% of its ground truth".to_owned();
        format!("{shown}; {}; {}", scene_text(&self.scene), self.exposure_ev.map_or_else(each, stops))
    }

    /// Draws a row below `top`; returns the top of the next one.
    fn draw_row(
        &self,
        figure: &mut Figure,
        sheet: &Sheet,
        top: f64,
        (name, row): (&str, &MethodRow),
        progress: &Progress,
    ) -> Result<f64, Error> {
        let side = self.side(sheet);
        let cells = self.cells(row, side, progress)?;
        let size = cells.first().map_or([side; 2], |cell| [cell.width, cell.height]);
        let division = Division::new(size, &self.crops, sheet.column)?;
        sheet.name(figure, top, size[1] as f64 * division.texel, name);
        for (column, cell) in cells.into_iter().enumerate() {
            division.put(figure, [sheet.left(column), top], cell);
        }
        let below = top + division.height;
        for (column, text) in row.texts.iter().enumerate() {
            let size = SMALL * sheet.em;
            figure.text([sheet.left(column), below], sheet.column, text, style(size, Anchor::Left));
        }
        Ok(top + row_height(sheet, &division, !row.texts.is_empty()))
    }

    fn cells(&self, row: &MethodRow, side: usize, progress: &Progress) -> Result<Vec<Image<u8>>, Error> {
        let size = row.materials.first().and_then(Option::as_ref).map(Material::size);
        // A prediction of another size cannot be compared.
        let is_of_size = |one: &&Material<f32>| Some(one.size()) == size;
        let reduced = |one: &Option<Material<f32>>| {
            one.as_ref().filter(is_of_size).map(|one| self.reduced(one.clone(), side)).transpose()
        };
        let materials: Vec<Option<Material<f32>>> =
            row.materials.iter().map(reduced).collect::<Result<_, CoreError>>()?;
        let truth = materials.first().and_then(Option::as_ref);
        let automatic =
            || truth.map_or(0.0, |truth| exposure::automatic(truth, &self.scene, &self.convention));
        let ev = self.exposure_ev.unwrap_or_else(automatic);
        let value = PictureContent { difference: None, ..self.content };
        let image = |one: &Material<f32>| {
            self.content.quantity.image(one, &self.scene, &self.convention, &progress.part())
        };
        let of_truth = truth.map(image).transpose()?;
        let mut cells = Vec::new();
        for (column, one) in materials.iter().enumerate() {
            let pair = one.as_ref().zip(of_truth.as_ref());
            let Some((one, truth)) = pair else {
                let [width, height] =
                    of_truth.as_ref().map_or([side; 2], |truth| [truth.width, truth.height]);
                cells.push(Image { width, height, pixels: vec![MISSING; width * height] });
                continue;
            };
            let image = image(one)?;
            let (content, image) = match self.content.difference.filter(|_| column > 0) {
                None => (value, image),
                Some(difference) => {
                    let params = DifferenceParams { epsilon: self.convention.epsilon, exposure_ev: ev };
                    (self.content, difference.kind.picture(truth, &image, params))
                }
            };
            let pixels = image.pixels.iter().map(|rgb| content.colour(*rgb, ev)).collect();
            let mut cell = Image { width: image.width, height: image.height, pixels };
            row.mask.iter().for_each(|mask| mask.gray_outside(&mut cell));
            cells.push(cell);
        }
        Ok(cells)
    }

    /// The material with sides of at most `side`; with crops the material.
    fn reduced(&self, material: Material<f32>, side: usize) -> Result<Material<f32>, CoreError> {
        let size = self.reduced_size(material.size(), side);
        if size == material.size() { Ok(material) } else { material.resized(size) }
    }

    /// The size of that material.
    fn reduced_size(&self, size: [usize; 2], side: usize) -> [usize; 2] {
        let longest = size[0].max(size[1]);
        if longest <= side || !self.crops.is_empty() {
            return size;
        }
        size.map(|length| (length * side / longest).max(1))
    }

    /// Where the figure comes from, as (keyword, text).
    pub fn entries(&self, methods: &[String], materials: &[String]) -> Vec<(&'static str, String)> {
        let exposure = self.exposure_ev.map_or("automatic, of each row".to_owned(), |ev| format!("{ev} EV"));
        vec![
            ("svbrdf:columns", format!("ground truth | {}", methods.join(" | "))),
            ("svbrdf:sources", materials.join(" | ")),
            ("svbrdf:shows", self.content.text(self.convention.epsilon)),
            ("svbrdf:scene", serde_json::to_string(&self.scene).unwrap_or_default()),
            ("svbrdf:convention", self.convention.name.to_owned()),
            ("svbrdf:exposure", exposure),
        ]
    }
}

/// The height of a row with the gap below it, in points.
fn row_height(sheet: &Sheet, division: &Division, has_texts: bool) -> f64 {
    let texts = if has_texts { 1.2 * SMALL * sheet.em } else { 0.0 };
    division.height + texts + GAP * sheet.em
}

#[cfg(test)]
mod tests {
    use svbrdf_core::model::scene::Kind;
    use svbrdf_core::picture::content::ColouredDifference;
    use svbrdf_core::picture::difference::Difference;
    use svbrdf_core::picture::quantity::Quantity;

    use super::*;
    use crate::samples;

    /// Two rows: the built-in pair, and the same without its second prediction.
    fn rows() -> Vec<MethodRow> {
        let built_in = samples::load::<f32>().unwrap();
        let predictions = built_in.predictions.into_iter().map(|one| Some(one.material));
        let all: Vec<_> = std::iter::once(Some(built_in.ground_truth.material)).chain(predictions).collect();
        let texts = ["", "0.3218", "0.2047"].map(str::to_owned).to_vec();
        let mut lacking = all.clone();
        lacking[2] = None;
        [all, lacking].map(|materials| MethodRow { materials, mask: None, texts: texts.clone() }).to_vec()
    }

    /// The figure of those rows.
    fn figure_of(strip: &MethodStrip, rows: &[MethodRow]) -> Figure {
        let [methods, names] =
            [["blurred", "rough"], ["tiles", "lacking"]].map(|names| names.map(str::to_owned));
        strip.figure(&methods, &names, |row| rows[row].clone(), &Progress::default()).unwrap()
    }

    fn strip(difference: Option<ColouredDifference>) -> MethodStrip {
        let content = PictureContent { quantity: Quantity::Rendering, difference };
        let scene = Scene { kind: Kind::Near, view: [0.0, 0.0, 2.5], light: [0.4, 0.5, 1.2] };
        let (paper, crops) = (Paper::default(), Vec::new());
        let (convention, exposure_ev) = (Convention::default(), Some(0.5));
        MethodStrip { content, scene, convention, exposure_ev, crops, paper, dpi: 144.0 }
    }

    #[test]
    fn each_cell_is_the_rendering_of_its_material_and_a_missing_one_is_gray() {
        let (rows, strip) = (rows(), strip(None));
        let figure = figure_of(&strip, &rows);
        let cells: Vec<_> = figure.pictures().collect();
        assert_eq!(cells.len(), 6);
        for (place, (at, size, cell)) in cells.iter().enumerate() {
            let (row, column) = (place / 3, place % 3);
            let Some(material) = rows[row].materials[column].clone() else {
                assert!(cell.pixels.iter().all(|pixel| *pixel == MISSING));
                continue;
            };
            let material = material.resized([cell.width, cell.height]).unwrap();
            let part = Progress::default();
            let image = Quantity::Rendering.image(&material, &strip.scene, &strip.convention, &part).unwrap();
            let expected: Vec<_> = image.pixels.iter().map(|rgb| strip.content.colour(*rgb, 0.5)).collect();
            assert!(cell.pixels == expected, "row {row}, column {column}");
            assert!((size[0] * figure.scale - cell.width as f64).abs() < 0.5, "a pixel for a pixel");
            let next = cells.get(place + 1).map_or(f64::MAX, |(next, ..)| next[0]);
            assert!(column == 2 || at[0] + size[0] < next, "row {row}, column {column}");
        }
        assert!(cells[1].2 != cells[2].2, "a planted fault: columns that changed places");
        let crops = vec!["10,10,40,30".parse().unwrap()];
        let with_insets = figure_of(&MethodStrip { crops, ..strip }, &rows);
        assert_eq!(with_insets.pictures().count(), 12);
    }

    #[test]
    fn a_figure_of_a_given_height_is_as_narrow_as_it_takes_before_it_is_drawn() {
        let (rows, names) = (rows(), [["blurred", "rough"], ["tiles", "lacking"]]);
        let [methods, materials] = names.map(|names| names.map(str::to_owned));
        let difference = ColouredDifference { kind: Difference::Log, range: Some(2.0) };
        for strip in [strip(None), strip(Some(difference))] {
            let within = |most| strip.within(most, (&methods, &materials), &[Some([256; 2]); 2], true);
            let height = |strip: &MethodStrip| figure_of(strip, &rows).size[1] / MILLIMETRE;
            let whole = height(&strip);
            assert_eq!(within(whole + 0.01).unwrap(), strip);
            let most = 0.9 * whole;
            let found = height(&within(most).unwrap());
            assert!((most - found).abs() < 0.05 && found <= most + 1e-6, "{found}, {most}");
            let problem = within(12.0).unwrap_err().to_string();
            assert!(problem.contains("12 mm high") && problem.contains("2 rows"), "{problem}");
        }
    }

    #[test]
    fn a_difference_has_a_scale_bar_and_the_ground_truth_its_value() {
        let rows = rows();
        let difference = ColouredDifference { kind: Difference::Log, range: Some(2.0) };
        let [value, difference] =
            [None, Some(difference)].map(|difference| figure_of(&strip(difference), &rows));
        assert!(difference.size[1] > value.size[1] + 7.0);
        let cell = |figure: &Figure, place: usize| figure.pictures().nth(place).unwrap().2.clone();
        assert_eq!(cell(&value, 0), cell(&difference, 0), "the ground truth");
        assert_ne!(cell(&value, 1), cell(&difference, 1));
    }
}
