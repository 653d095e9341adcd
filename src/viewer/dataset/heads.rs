//! Heads of the columns of the table: the table of methods, what the rows are sorted by, and the colours of differences.

use eframe::egui::{self, Align2, FontId, Rect, Response, Sense, StrokeKind, WidgetInfo, pos2, vec2};

use svbrdf_evaluate::dataset::MethodSummary;

use crate::dataset::pictures;
use crate::dataset::places::{GAP, LINE, MatrixTable, Places};
use crate::dataset::summary;
use crate::model::Model;
use crate::model::dataset::list::{ListOrder, ListView};
use crate::model::material::loaded::drawable;
use crate::widgets::names::{Names, fitted};
use crate::widgets::numbers::{apart, digits};
use crate::widgets::paint::colour_bar;
use crate::widgets::theme;

impl MatrixTable<'_> {
    /// The heads of the columns: the table of methods. A click sorts by the losses of one.
    pub fn heads(&self, ui: &egui::Ui, places: &Places, next: &mut Model) {
        let corner = Rect::from_min_size(places.view.min, vec2(places.names, places.head));
        self.corner(ui, corner, next);
        let report = summary::drawn(self.matrix.shown);
        let means: Vec<f64> = report.iter().flat_map(|all| &all.methods).map(|one| one.mean).collect();
        let means = apart(&means, means.iter().map(|mean| digits(*mean)).collect());
        let methods: Vec<&str> = self.matrix.open.methods().iter().map(String::as_str).collect();
        let names = Names::new(&methods);
        let fonts = (FontId::proportional(12.5), FontId::monospace(11.0));
        let heads = corner.with_min_x(corner.right()).with_max_x(places.view.right());
        for (place, &column) in self.matrix.columns.iter().enumerate().skip(places.first) {
            let room = corner.with_min_x(places.left(place)).with_max_x(places.left(place) + places.cell.x);
            let seen = room.intersect(heads);
            let painter = ui.painter().with_clip_rect(seen.intersect(ui.clip_rect()));
            let paint = |number: usize, text: &str, font: &FontId, ink| {
                let at = room.min + vec2(0.0, (number as f32 + 0.5) * LINE);
                painter.text(at, Align2::LEFT_CENTER, text, font.clone(), ink);
            };
            let Some(method) = column.checked_sub(1) else {
                paint(0, "GROUND TRUTH", &fonts.0, theme::ground_truth(ui.visuals()));
                continue;
            };
            let is_chosen = self.matrix.chosen() == Some(column);
            let ink = if is_chosen { ui.visuals().strong_text_color() } else { ui.visuals().text_color() };
            let title = |most| format!("{column}  {}", drawable(&names.shortened(method, most)));
            let name = fitted(ui, &fonts.0, places.cell.x, title).unwrap_or_else(|| title(4));
            paint(0, &name, &fonts.0, ink);
            let arrow = arrow(next, ListOrder::Loss(method));
            let found = report.as_ref().and_then(|all| {
                let place = all.methods.iter().position(|one| one.method == methods[method])?;
                let one = all.methods.get(place).filter(|one| one.mean.is_finite())?;
                let is_better = |other: &&MethodSummary| other.compared && other.mean < one.mean;
                Some((1 + all.methods.iter().filter(is_better).count(), one, means.get(place)?))
            });
            let mean = found.map_or("", |(_, _, mean)| mean);
            let mut told = format!("{mean}{arrow}");
            let mut hover = format!(
                "{}\nThe largest losses of this method first; again: the least\nDrag it to another place",
                methods[method]
            );
            if let Some((rank, one, _)) = found {
                let interval = one.interval95_materials.map(|ends| ends.map(digits));
                let over =
                    interval.map_or("few materials".to_owned(), |[low, high]| format!("[{low}, {high}]"));
                let rank = if one.compared { format!("rank {rank}") } else { "unranked".to_owned() };
                let count = format!("{} of {} materials", one.materials, one.materials + one.failures);
                hover = format!("{hover}\nmean {mean}, 95% over materials: {over}; {rank}, {count}");
                told = if self.has_pictures { format!("{mean}  {rank}{arrow}") } else { told };
                paint(2, &over, &fonts.1, ui.visuals().weak_text_color());
            }
            paint(1, &told, &fonts.1, ui.visuals().text_color());
            let line = room.with_min_y(room.bottom() - 3.0).with_max_y(room.bottom() - 1.0);
            if !self.matrix.open.is_of_predictions() {
                painter.rect_filled(line, 0.0, theme::series(column, ui.visuals().dark_mode));
            }
            let response = ui.interact(seen, ui.scope_id().with(("head", method)), Sense::click_and_drag());
            let name = format!("Sort by {}: {told}", methods[method]);
            response.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, &name));
            let response = response.on_hover_text(hover);
            self.act(ui, places, (column, room), &response, &mut next.dataset.list);
        }
    }

    /// A click on the head of a column sorts by its losses; a drag moves it to the place that has an outline meanwhile.
    fn act(
        &self,
        ui: &egui::Ui,
        places: &Places,
        (column, room): (usize, Rect),
        response: &Response,
        next: &mut ListView,
    ) {
        if response.clicked() {
            next.sort_by(ListOrder::Loss(column - 1));
        }
        let is_dragged = response.dragged() || response.drag_stopped();
        let Some(pointer) = response.interact_pointer_pos().filter(|_| is_dragged) else { return };
        let methods = self.matrix.open.methods();
        let to = (1..=methods.len()).rev().find(|place| places.left(*place) <= pointer.x).unwrap_or(1);
        let room = Rect::from_min_size(pos2(places.left(to), room.top()), room.size());
        ui.painter().rect_stroke(room, 0.0, (1.0, theme::accent(ui.visuals())), StrokeKind::Inside);
        if response.drag_stopped() {
            next.move_column(methods, column, to - 1);
        }
    }

    /// What sorts by names, and by the disagreement of methods; below it the colours of differences.
    fn corner(&self, ui: &egui::Ui, corner: Rect, next: &mut Model) {
        let several = self.matrix.open.methods().len() > 1;
        let orders = [
            (ListOrder::Name, "Name", "By name; again: the other way round"),
            (
                ListOrder::Disagreement,
                "Disagreement",
                "The largest difference of two methods first; again: the least",
            ),
        ];
        for (number, (order, name, hover)) in orders.into_iter().take(1 + usize::from(several)).enumerate() {
            let top = corner.top() + number as f32 * LINE;
            let room = corner.with_min_y(top).with_max_y(top + LINE);
            let response = ui.interact(room, ui.scope_id().with(("head", name)), Sense::click());
            response.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, format!("Sort by {name}")));
            let is_sorted = next.dataset.list.order == order;
            let ink =
                if is_sorted { ui.visuals().strong_text_color() } else { ui.visuals().weak_text_color() };
            let text = format!("{name}{}", arrow(next, order));
            ui.painter().text(room.left_center(), Align2::LEFT_CENTER, text, FontId::monospace(11.0), ink);
            if response.on_hover_text(hover).clicked() {
                next.dataset.list.sort_by(order);
            }
        }
        if self.has_pictures {
            self.legend(ui, corner.with_min_y(corner.bottom() - LINE));
        }
    }

    /// The colours of differences, which all cells share, between the numbers of both ends.
    fn legend(&self, ui: &egui::Ui, area: Rect) {
        let shown = self.matrix.shown;
        let (display, range) = (&shown.model.view.display, pictures::latest(shown).and_then(|one| one.range));
        let Some(range) = range.filter(|_| display.difference) else { return };
        let (kind, _) = display.differences.pointwise(display.quantity);
        let least = if kind.is_signed() { -1.0 } else { 0.0 };
        let (font, ink) = (FontId::monospace(10.0), ui.visuals().text_color());
        let middle = area.center().y;
        let text = |value: f64| digits(value).replace('-', "\u{2212}");
        let low = pos2(area.left(), middle);
        let low = ui.painter().text(low, Align2::LEFT_CENTER, text(least * range), font.clone(), ink);
        let high = pos2(area.right() - 2.0 * GAP, middle);
        let high = ui.painter().text(high, Align2::RIGHT_CENTER, text(range), font, ink);
        let bar =
            Rect::from_min_max(pos2(low.right() + 3.0, middle - 4.0), pos2(high.left() - 3.0, middle + 4.0));
        ui.painter().add(colour_bar(bar, [least as f32, 1.0], kind.is_signed()));
    }
}

/// The direction of an order that the rows have, after its name.
fn arrow(model: &Model, order: ListOrder) -> &'static str {
    let list = &model.dataset.list;
    match (list.order == order, list.is_reversed) {
        (false, _) => "",
        (true, false) => " \u{2193}",
        (true, true) => " \u{2191}",
    }
}
