//! Table of a data set: its matrix, with pictures of all cells in the place of the panes, or with losses alone beside the panes.

use eframe::egui::scroll_area::ScrollSource;
use eframe::egui::{self, RichText, WidgetInfo, vec2};
use egui_material_icons::icons;

use svbrdf_core::model::scene::Endpoint;

use crate::dataset::cells::Drawn;
use crate::dataset::pictures::{DrawCells, ReadCells, ReadRow};
use crate::dataset::places::{GAP, LINE, MatrixTable, NAMES, NUMBER, Places, WIDE_NAMES};
use crate::jobs::Shown;
use crate::model::dataset::DatasetState;
use crate::model::dataset::list::ListFilter;
use crate::model::material::loaded::drawable;
use crate::model::{Model, endpoint};
use crate::widgets::named;

/// Least and greatest side of a picture that is fitted to the window, in points.
const LEAST: f32 = 110.0;
const MOST: f32 = 184.0;
/// The change of the size of a cell by a step of the wheel, per point of its motion.
const WHEEL: f32 = 0.004;

/// The width of a table of losses for this many methods, in points.
pub fn width(methods: usize) -> f32 {
    NAMES + 26.0 + (NUMBER.x + GAP) * methods as f32
}

impl MatrixTable<'_> {
    pub fn ui(&mut self, ui: &mut egui::Ui, next: &mut Model) {
        self.controls(ui, &mut next.dataset);
        egui::Panel::bottom("material card").resizable(false).frame(egui::Frame::NONE).show(ui, |ui| {
            self.card(ui, &mut next.dataset);
        });
        if self.matrix.rows.is_empty() {
            ui.weak(format!("No {} is like this.", self.matrix.open.noun()));
        } else {
            self.table(ui, next);
        }
    }

    fn controls(&self, ui: &mut egui::Ui, next: &mut DatasetState) {
        ui.horizontal_wrapped(|ui| {
            let pictures = ui.selectable_label(self.has_pictures, "Pictures");
            let hover = "All materials under the present light, in the place of the panes (S)";
            if pictures.on_hover_text(hover).clicked() {
                next.show_table(!self.has_pictures);
            }
            let filters = egui::ComboBox::from_id_salt("filter").selected_text(next.list.filter.name());
            let filters = filters.width(70.0).show_ui(ui, |ui| {
                let has_floors = self.matrix.open.settings.diagnose;
                for filter in
                    ListFilter::ALL.into_iter().filter(|one| has_floors || *one != ListFilter::NotResolvable)
                {
                    ui.selectable_value(&mut next.list.filter, filter, filter.name());
                }
            });
            named(&filters.response, "Materials that are listed");
            let search = egui::TextEdit::singleline(&mut next.list.search).hint_text("Search");
            let search = ui.add(search.desired_width((ui.available_width() - 12.0).clamp(60.0, 180.0)));
            if std::mem::take(&mut next.finds) {
                search.request_focus();
            }
            search.widget_info(|| WidgetInfo::labeled(egui::Role::TextInput, true, "Search materials"));
            let counts = RichText::new(self.matrix.counts()).small().weak();
            ui.add(egui::Label::new(counts).extend());
        });
    }

    /// What a person has noted on the material in the window, and what is to be known of the results folder.
    fn card(&self, ui: &mut egui::Ui, next: &mut DatasetState) {
        let (dataset, open) = (&self.matrix.shown.model.dataset, self.matrix.open);
        let name = open.name(dataset.wanted);
        let mark = dataset.mark(name).cloned().unwrap_or_default();
        ui.separator();
        for note in &self.matrix.losses.notes {
            let label = egui::Label::new(RichText::new(note).small().color(ui.visuals().warn_fg_color));
            ui.add(label.truncate()).on_hover_text(note);
        }
        ui.horizontal(|ui| {
            let star = ui.selectable_label(mark.is_marked, icons::ICON_STAR.codepoint);
            star.widget_info(|| {
                WidgetInfo::selected(egui::Role::Button, true, mark.is_marked, "Mark this material")
            });
            let hover = match open.is_of_predictions() {
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

    fn table(&mut self, ui: &mut egui::Ui, next: &mut Model) {
        let (rows, methods) = (self.matrix.rows.len(), self.matrix.open.methods().len());
        let area = ui.available_rect_before_wrap();
        let fitting = (area.width() - WIDE_NAMES - 12.0) / (methods + 1) as f32 - GAP;
        let cell = self.matrix.shown.model.dataset.table.cell;
        let cell = cell.unwrap_or(fitting.clamp(LEAST, MOST));
        let places = match self.has_pictures {
            true => Places {
                view: area,
                origin: area.min,
                cell: vec2(cell, cell),
                head: 3.0 * LINE + 4.0,
                names: WIDE_NAMES,
                first: 0,
            },
            false => {
                let numbers = (NUMBER.x + GAP) * methods as f32 + 10.0;
                let names = (area.width() - numbers).max(NAMES);
                Places { view: area, origin: area.min, cell: NUMBER, head: 2.0 * LINE + 4.0, names, first: 1 }
            }
        };
        let size = vec2(places.left(methods + 1), places.top(rows)) - area.min.to_vec2();
        let is_over = ui.input(|i| i.pointer.hover_pos().is_some_and(|at| places.body().contains(at)));
        let zooms = self.has_pictures && is_over;
        let mut scroll = egui::ScrollArea::both().id_salt(self.has_pictures).auto_shrink([false, false]);
        if zooms {
            // Over the pictures the wheel sizes them.
            scroll = scroll.scroll_source(ScrollSource { mouse_wheel: false, ..ScrollSource::default() });
        }
        if let Some(offset) = self.state.scrolled.take().or_else(|| self.offset(&places)) {
            scroll = scroll.scroll_offset(offset);
        }
        let out = scroll.show_viewport(ui, |ui, viewport| {
            ui.set_min_size(size);
            let origin = ui.min_rect().min;
            let places = Places { view: viewport.translate(origin.to_vec2()), origin, ..places };
            self.contents(ui, &places, next);
            if zooms {
                self.wheel(ui, &places, next);
            }
        });
        self.state.offsets[usize::from(self.has_pictures)] = out.state.clamped_offset();
    }

    /// Where the table is scrolled to, so that the material in the window is in sight when it changes; `None` where it is.
    fn offset(&mut self, places: &Places) -> Option<egui::Vec2> {
        let wanted = self.matrix.shown.model.dataset.wanted;
        let now = Some((wanted, self.has_pictures));
        if std::mem::replace(&mut self.state.scrolled_to, now) == now {
            return None;
        }
        let offset = self.state.offsets[usize::from(self.has_pictures)];
        let top = self.matrix.row(wanted)? as f32 * (places.cell.y + GAP);
        let room = places.body().height() - places.cell.y;
        let is_in_sight = top >= offset.y && top <= offset.y + room;
        (!is_in_sight).then(|| vec2(offset.x, (top - 0.5 * room).max(0.0)))
    }

    fn contents(&mut self, ui: &mut egui::Ui, places: &Places, next: &mut Model) {
        let step = places.cell.y + GAP;
        let (first, rows) = (places.top(0), self.matrix.rows.len());
        let row = |y: f32| (((y - first) / step).floor().max(0.0) as usize).min(rows);
        let range = row(places.body().top())..(row(places.body().bottom()) + 1).min(rows);
        let cases = self.matrix.rows.get(range.clone()).unwrap_or_default();
        let dataset = &self.matrix.shown.model.dataset;
        dataset.in_sight.set(&[&[dataset.wanted], cases].concat());
        let drawn = if self.has_pictures { self.drawn(ui, places, cases) } else { Drawn::default() };
        for row in range {
            self.row(ui, places, row, &drawn, next);
        }
        self.state.rows = drawn.rows;
        self.heads(ui, places, next);
    }

    /// What is drawn of these rows, which are asked for from the first on.
    fn drawn(&self, ui: &egui::Ui, places: &Places, cases: &[usize]) -> Drawn {
        let Shown { model, jobs } = self.matrix.shown;
        let pixels = (places.cell.x * ui.pixels_per_point()).round() as usize;
        let read = |case: &usize| {
            let row = ReadRow::of(self.matrix.open, *case, pixels, model.dataset.version(*case));
            Some((*case, jobs.answers.get(&row).ready()?))
        };
        let rows: Vec<ReadCells> = cases.iter().filter_map(read).collect();
        let pictures = jobs.answers.drawn(&DrawCells::of(rows.clone(), &model.view));
        Drawn { rows, pictures: pictures.map(|(pictures, _)| pictures) }
    }

    /// The wheel over the pictures changes their size about the pointer, with Shift the height of the light. Beyond the largest size the
    /// row under the pointer becomes the panes.
    fn wheel(&mut self, ui: &egui::Ui, places: &Places, next: &mut Model) {
        let (delta, modifiers, pointer) =
            ui.input(|i| (i.smooth_scroll_delta, i.modifiers, i.pointer.hover_pos()));
        let turned = delta.x + delta.y;
        let (factor, Some(pointer)) = ((turned * WHEEL).exp(), pointer) else { return };
        if turned != 0.0 && modifiers.shift_only() {
            endpoint::scale_height(&mut next.view.scene, Endpoint::Light, f64::from(factor));
        } else if turned != 0.0 && modifiers.is_none() {
            let from = pointer - places.origin - vec2(places.names, places.head);
            let row = (from.y / (places.cell.y + GAP)).max(0.0) as usize;
            let cell = next.dataset.set_cell(places.cell.x * factor);
            if cell == places.cell.x
                && factor > 1.0
                && let Some((case, ahead)) = self.matrix.at(row)
            {
                next.dataset.show(case, ahead);
                return next.dataset.show_table(false);
            }
            let grown = (cell + GAP) / (places.cell.x + GAP);
            let offset = places.view.min - places.origin + from * (grown - 1.0);
            self.state.scrolled = Some(offset.max(egui::Vec2::ZERO));
        }
    }
}
