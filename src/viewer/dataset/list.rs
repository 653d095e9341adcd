//! List of materials: a row each with name and the losses of the methods.

use std::ops::Range;
use std::sync::Arc;

use eframe::egui::{self, Align2, FontId, Rect, RichText, Sense, WidgetInfo, pos2, vec2};

use egui_material_icons::icons;

use crate::dataset::losses::DatasetLosses;
use crate::dataset::rows::{Rows, chosen_method, lines, texts};
use crate::jobs::Shown;
use crate::jobs::answers::Answered;
use crate::model::dataset::list::{CaseLosses, ListFilter, ListOrder, ListView};
use crate::model::dataset::{DatasetState, OpenDataset};
use crate::model::material::loaded::drawable;
use crate::widgets::names::shortened;
use crate::widgets::{named, theme};

/// The sign of a material that is marked, after its name.
pub const MARK: &str = " *";
/// Height of the name, and height of the bar of a method, in points.
const NAME: f32 = 17.0;
const BAR: f32 = 12.0;
/// Width of a loss beside its bar, in points.
const NUMBER: f32 = 46.0;
/// The most bars in a row: more methods are in the contact sheet.
const MOST_BARS: usize = 12;

/// The list at the left of the panes.
#[derive(Debug)]
pub struct MaterialsDrawer<'a> {
    pub shown: Shown<'a>,
    pub open: &'a OpenDataset,
    pub rows: &'a Rows,
    pub losses: Arc<Answered<DatasetLosses>>,
    /// The rows in sight.
    pub in_sight: &'a mut Range<usize>,
    pub scrolled_to: &'a mut Option<usize>,
}

impl MaterialsDrawer<'_> {
    pub fn ui(&mut self, ui: &mut egui::Ui, next: &mut DatasetState) {
        self.controls(ui, next);
        egui::Panel::bottom("material card").resizable(false).frame(egui::Frame::NONE).show(ui, |ui| {
            self.card(ui, next);
        });
        self.list(ui, next);
    }

    fn controls(&self, ui: &mut egui::Ui, next: &mut DatasetState) {
        ui.horizontal(|ui| {
            let sheet = ui.selectable_label(next.sheet.is_open, "Sheet");
            if sheet.on_hover_text("Contact sheet: all materials under the present light (S)").clicked() {
                next.show_sheet(!next.sheet.is_open);
            }
            let search = egui::TextEdit::singleline(&mut next.list.search)
                .hint_text("Search")
                .desired_width(f32::INFINITY);
            let search = ui.add(search);
            if std::mem::take(&mut next.finds) {
                search.request_focus();
            }
            search.widget_info(|| WidgetInfo::labeled(egui::Role::TextInput, true, "Search materials"));
        });
        let list = &mut next.list;
        ui.horizontal(|ui| {
            self.order(ui, list);
            let arrow = if list.is_reversed { icons::ICON_ARROW_UPWARD } else { icons::ICON_ARROW_DOWNWARD };
            let reverse = ui.selectable_label(list.is_reversed, arrow.codepoint);
            reverse.widget_info(|| {
                WidgetInfo::selected(egui::Role::Button, true, list.is_reversed, "Reverse order")
            });
            if reverse.on_hover_text("The other way round").clicked() {
                list.is_reversed ^= true;
            }
            let filters =
                egui::ComboBox::from_id_salt("filter").selected_text(list.filter.name()).width(70.0);
            let filters = filters.show_ui(ui, |ui| {
                let has_floors = self.open.settings.diagnose;
                for filter in
                    ListFilter::ALL.into_iter().filter(|one| has_floors || *one != ListFilter::NotResolvable)
                {
                    ui.selectable_value(&mut list.filter, filter, filter.name());
                }
            });
            named(&filters.response, "Materials that are listed");
        });
        ui.label(RichText::new(self.counts()).small().weak());
    }

    /// How many are listed, and how many losses are there.
    fn counts(&self) -> String {
        let (listed, all) = (self.rows.cases.len(), self.open.cases.len());
        let noun = self.open.noun();
        let materials =
            if listed == all { format!("{all} {noun}s") } else { format!("{listed} of {all} {noun}s") };
        match self.losses.count() {
            known if known < all => format!("{materials}, losses of {known}"),
            _ => materials,
        }
    }

    fn order(&self, ui: &mut egui::Ui, list: &mut ListView) {
        let methods = self.open.methods();
        let names: Vec<&str> = methods.iter().map(String::as_str).collect();
        let names = shortened(&names, 14);
        let text = |order: ListOrder| match order {
            ListOrder::Name => "by name".to_owned(),
            ListOrder::Loss(method) => format!("loss of {}", names.get(method).map_or("", String::as_str)),
            ListOrder::Disagreement => "disagreement".to_owned(),
        };
        let combo = egui::ComboBox::from_id_salt("order").selected_text(text(list.order)).width(112.0);
        let combo = combo.show_ui(ui, |ui| {
            let mut one = |order| ui.selectable_value(&mut list.order, order, text(order));
            one(ListOrder::Name);
            (0..methods.len()).for_each(|method| drop(one(ListOrder::Loss(method))));
            if methods.len() > 1 {
                one(ListOrder::Disagreement).on_hover_text("The largest difference of two methods first");
            }
        });
        named(&combo.response, "Order of the materials");
    }

    /// What is known of the material in the window that is not in its panes, and what a person has noted.
    fn card(&self, ui: &mut egui::Ui, next: &mut DatasetState) {
        let dataset = &self.shown.model.dataset;
        let name = self.open.name(dataset.wanted);
        let mark = dataset.mark(name).cloned().unwrap_or_default();
        ui.separator();
        for note in &self.losses.notes {
            let label = egui::Label::new(RichText::new(note).small().color(ui.visuals().warn_fg_color));
            ui.add(label.truncate()).on_hover_text(note);
        }
        ui.horizontal(|ui| {
            let star = ui.selectable_label(mark.is_marked, icons::ICON_STAR.codepoint);
            star.widget_info(|| {
                WidgetInfo::selected(egui::Role::Button, true, mark.is_marked, "Mark this material")
            });
            let hover = match self.open.is_of_predictions() {
                true => "Pin this prediction: it stays beside the others (K)",
                false => "Mark this material (K)",
            };
            if star.on_hover_text(hover).clicked() {
                next.toggle_mark();
            }
            let mut note = mark.note.clone();
            let hint = format!("Note on {}", drawable(name));
            let field = egui::TextEdit::singleline(&mut note).hint_text(hint).desired_width(f32::INFINITY);
            let field = ui.add(field);
            field.widget_info(|| WidgetInfo::labeled(egui::Role::TextInput, true, "Note on this material"));
            if note != mark.note {
                next.change_mark(|mark| mark.note = note);
            }
        });
    }

    fn list(&mut self, ui: &mut egui::Ui, next: &mut DatasetState) {
        let height = self.row_height();
        let wanted = self.shown.model.dataset.wanted;
        let spacing = ui.spacing().item_spacing.y;
        if self.rows.cases.is_empty() {
            *self.in_sight = 0..0;
            ui.weak(format!("No {} is like this.", self.open.noun()));
            return;
        }
        let mut area = egui::ScrollArea::vertical().auto_shrink([false, false]).id_salt("materials");
        // What is shown is in sight when it changes, and stays where it is otherwise.
        if *self.scrolled_to != Some(wanted)
            && let Some(row) = self.rows.row(wanted)
        {
            let inner = self.in_sight.start + 1..self.in_sight.end.saturating_sub(1);
            if !inner.contains(&row) {
                let above = ui.available_height() / 2.0 - height / 2.0;
                area = area.vertical_scroll_offset((row as f32 * (height + spacing) - above).max(0.0));
            }
            *self.scrolled_to = Some(wanted);
        }
        let shown = area.show_rows(ui, height, self.rows.cases.len(), |ui, rows| {
            for row in rows.clone() {
                self.row(ui, row, next);
            }
            rows
        });
        *self.in_sight = shown.inner;
    }

    fn bars(&self) -> usize {
        self.open.methods().len().min(MOST_BARS)
    }

    fn row_height(&self) -> f32 {
        NAME + BAR * self.bars() as f32 + 7.0
    }

    fn row(&mut self, ui: &mut egui::Ui, row: usize, next: &mut DatasetState) {
        let Some((case, ahead)) = self.rows.at(row) else { return };
        let dataset = &self.shown.model.dataset;
        let name = self.open.name(case);
        let (rect, response) =
            ui.allocate_exact_size(vec2(ui.available_width(), self.row_height()), Sense::click());
        let is_shown = dataset.wanted == case;
        response.widget_info(|| {
            WidgetInfo::selected(egui::Role::Button, true, is_shown, format!("Material {name}"))
        });
        let visuals = ui.style().interact_selectable(&response, is_shown);
        if is_shown || response.hovered() {
            ui.painter().rect_filled(rect, 3.0, visuals.weak_bg_fill);
        }
        let right = rect.shrink(2.0);
        let mark = dataset.mark(name).filter(|mark| mark.is_marked).map_or("", |_| MARK);
        let text = format!("{}{mark}", drawable(name));
        let painter = ui.painter().with_clip_rect(right.intersect(ui.clip_rect()));
        painter.text(right.min, Align2::LEFT_TOP, text, FontId::proportional(13.0), visuals.text_color());
        let losses = self.losses.row(case);
        let bars = Rect::from_min_max(pos2(right.left(), right.top() + NAME), right.max);
        self.paint_bars(ui, bars, case, losses);
        let response = match losses {
            Some(losses) => response.on_hover_text(lines(losses, self.open.methods())),
            None => response,
        };
        if response.clicked() {
            next.show(case, ahead);
        }
    }

    /// A bar a method in its colour with its loss, from the same zero to the same largest loss in every row.
    fn paint_bars(&self, ui: &egui::Ui, area: Rect, case: usize, losses: Option<&CaseLosses>) {
        let Some(losses) = losses else { return };
        let largest = self.losses.largest.max(f64::MIN_POSITIVE);
        let chosen = chosen_method(self.shown);
        let of_predictions = self.open.is_of_predictions();
        let texts = texts(losses);
        let (font, painter) = (FontId::monospace(10.5), ui.painter());
        for (index, known) in losses.by_method.iter().take(MOST_BARS).enumerate() {
            let line = Rect::from_min_size(area.min + vec2(0.0, index as f32 * BAR), vec2(area.width(), BAR));
            let is_chosen = self.open.methods().get(index).map(String::as_str) == chosen;
            let slot = if of_predictions { case + 1 } else { index + 1 };
            let (text, ink, share) = match known {
                None => ("none", theme::problem(ui.visuals()), 0.0),
                Some(known) => {
                    let strength =
                        if is_chosen { ui.visuals().text_color() } else { ui.visuals().weak_text_color() };
                    (texts[index].as_str(), strength, (known.loss / largest) as f32)
                }
            };
            painter.text(line.right_center(), Align2::RIGHT_CENTER, text, font.clone(), ink);
            let room = line.with_max_x(line.right() - NUMBER).shrink2(vec2(0.0, 3.0));
            let bar = room.with_max_x(room.left() + room.width() * share);
            painter.rect_filled(bar, 0.0, theme::series(slot, ui.visuals().dark_mode));
        }
    }
}
