//! Status bar: the line at the bottom: the numbers of the texel under the pointer.

use eframe::egui::{self, RichText};

use crate::frame::actions::pin_here;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::{Model, display};
use crate::pane;
use crate::pane::Displayed;
use crate::pane::viewport::Viewport;
use crate::photograph::compared::Photographs;
use crate::widgets::numbers::{WIDTH, fixed};
use crate::widgets::{number, theme};

/// Width of the line, in points, below which its buttons have short names.
const NARROW: f32 = 850.0;
/// Width of the field of the magnification, in points.
const FIELD: f32 = 56.0;
/// Characters of the texel's (column, row).
const PLACE: usize = 9;

/// Draws the line: that of the table, where it is in the place of the panes, or the numbers of texels.
pub fn ui(
    ui: &mut egui::Ui,
    shown: &Displayed<'_>,
    viewport: &Viewport,
    of_table: Option<String>,
    next: &mut Model,
) {
    if let Some(text) = of_table {
        // As high as with the buttons.
        ui.set_height(ui.spacing().interact_size.y);
        return drop(ui.add(egui::Label::new(text).truncate()));
    }
    let (view, materials) = (&shown.model.view, shown.materials());
    let hovered = viewport.hovered;
    let grid = shown.model.materials.ground_truth().map(LoadedMaterial::grid);
    // The pointer was over a texel in the frame before: the materials of this one may be smaller.
    let size = materials.first().map_or([0, 0], |one| one.material().size());
    let texel = hovered.and_then(|hovered| hovered.texel);
    let bar = StatusBar {
        shown,
        texel: texel.filter(|texel| (0..2).all(|axis| texel[axis] < size[axis])),
        hovered: hovered.map(|hovered| hovered.index),
    };
    let pixels = grid.map_or(1.0, |grid| viewport.magnification(grid, view));
    ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
        ui.set_height(ui.spacing().interact_size.y);
        buttons(ui, next);
        ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| bar.columns(ui, pixels, next));
    });
}

/// What the columns show.
#[derive(Debug)]
struct StatusBar<'a> {
    shown: &'a Displayed<'a>,
    /// The texel under the pointer.
    texel: Option<[usize; 2]>,
    /// The slot of the pane under the pointer.
    hovered: Option<usize>,
}

impl StatusBar<'_> {
    /// The texel, then one column for each material whose numbers fit, the ground truth first.
    fn columns(&self, ui: &mut egui::Ui, pixels: f32, next: &mut Model) {
        let size = if ui.ctx().content_rect().width() > NARROW { 12.5 } else { 11.0 };
        let font = egui::FontId::monospace(size);
        let place = match self.texel {
            Some([column, row]) => format!("{column},{row}"),
            None => "-".to_owned(),
        };
        let mono = |text: String| RichText::new(text).font(font.clone());
        ui.label(mono(format!("texel {place:<PLACE$}")));
        magnification_field(ui, pixels, next);
        if let Some(photographs) = self.shown.photographs() {
            self.photograph(ui, photographs, mono);
        }
        for index in self.order() {
            let text = format!("{} {}", self.shown.materials()[index].number(), self.numbers(index));
            let glyph = ui.fonts_mut(|fonts| fonts.glyph_width(&font, 'm'));
            let width = glyph * text.chars().count() as f32;
            if ui.available_width() < width + 12.0 {
                break;
            }
            ui.separator();
            let text =
                if index == 0 { mono(text).color(theme::ground_truth(ui.visuals())) } else { mono(text) };
            let text = if self.hovered == Some(index) { text.strong() } else { text };
            ui.label(text).on_hover_text(self.shown.materials()[index].name());
        }
    }

    /// The column of the photograph, at the exposure of the chosen material.
    fn photograph(&self, ui: &mut egui::Ui, photographs: &Photographs, mono: impl Fn(String) -> RichText) {
        let chosen = self.shown.chosen();
        let at = |texel| photographs.at(chosen, texel).map(f64::from).to_vec();
        ui.separator();
        let text = format!("photo {}", texts(self.texel.map(at), 3));
        let text = mono(text).color(theme::ground_truth(ui.visuals()));
        let hover = format!("The photograph at the exposure of {}", self.shown.materials()[chosen].name());
        ui.label(text).on_hover_text(hover);
    }

    /// The indices in the order of their columns: the ground truth, the chosen prediction, then the others. It does not depend
    /// on the pointer, so that columns stay where they are.
    fn order(&self) -> Vec<usize> {
        let all = 0..self.shown.materials().len();
        let fits_all = self.shown.materials().len() <= 4;
        let chosen = self.shown.view().display.prediction + 1;
        let mut order: Vec<usize> = all.collect();
        if !fits_all && chosen < order.len() {
            order.remove(chosen);
            order.insert(1, chosen);
        }
        order
    }

    /// The numbers of material `index` at the texel, always of the same width.
    fn numbers(&self, index: usize) -> String {
        let (shown, difference) = (self.shown, self.shown.view().display.difference);
        let numbers = self.texel.map(|texel| pane::numbers(shown, index, difference, texel));
        format!("{}{}", texts(numbers, pane::count(shown, index)), pane::unit(shown.view(), index))
    }
}

/// The numbers, or as many dashes of their width.
fn texts(numbers: Option<Vec<f64>>, count: usize) -> String {
    let dashes = || vec![format!("{:>1$}", "-", WIDTH); count];
    numbers.map_or_else(dashes, |all| all.into_iter().map(fixed).collect()).join(" ")
}

/// The magnification, in a field of constant width.
fn magnification_field(ui: &mut egui::Ui, now: f32, next: &mut Model) {
    let (mut pixels, speed) = (now, 0.01 * now);
    number(ui, "Magnification", &mut pixels, 1.0, |drag| {
        drag.speed(speed)
            .range(1e-3..=1e4)
            .custom_formatter(|value, _| magnification(value as f32))
            .custom_parser(|text| text.trim_start_matches('×').trim().parse().ok())
            .min_size(egui::vec2(FIELD, 0.0))
    })
    .on_hover_text("Magnification: screen pixels per texel; double-click for 1 (0)");
    if pixels != now {
        display::magnify(next, pixels);
    }
}

fn buttons(ui: &mut egui::Ui, next: &mut Model) {
    let wide = ui.ctx().content_rect().width() > NARROW;
    let (rectangle, pin) = if wide { ("Rectangle (Q)", "Pin (I)") } else { ("Rect.", "Pin") };
    let rectangle = ui.toggle_value(&mut next.inspection.is_armed, rectangle);
    rectangle.on_hover_text(
        "A rectangle that a saved strip magnifies: the next left-drag draws it (Q); on maps also Shift + left-drag",
    );
    let pin = ui.button(pin).on_hover_text(
        "Pin the texel that was last under the pointer: all its numbers in a table (I); also Alt + click",
    );
    if pin.clicked() {
        pin_here(next);
    }
}

/// Screen pixels per texel, in at most 6 characters.
fn magnification(pixels: f32) -> String {
    match pixels {
        p if p >= 9.95 => format!("×{p:.0}"),
        p if p >= 0.995 => format!("×{p:.1}"),
        p => format!("×{p:.2}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_magnification_has_two_digits_or_more() {
        assert_eq!([0.254, 1.0, 12.3, 400.0].map(magnification), ["×0.25", "×1.0", "×12", "×400"]);
    }
}
