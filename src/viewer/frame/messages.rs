//! Errors and warnings in a list, and the latest success for a moment, over the panes.

use eframe::egui::{self, Align2, RichText};

use svbrdf_core::text::line;

use crate::message::{Message, MessageList, Severity};
use crate::model::material::loaded::drawable;
use crate::model::{Model, opening};
use crate::widgets::theme;

/// Share of the window's height that the list takes at most.
const HIGHEST: f32 = 0.3;

/// The messages over `area`, each with what can be done about it.
pub fn ui(ctx: &egui::Context, area: egui::Rect, messages: &MessageList, next: &mut Model) {
    let lasting: Vec<_> = messages.lasting().collect();
    let mut bottom = area.bottom() - 8.0;
    // An area without a width of its own is as wide as what it showed before.
    let widest = (area.width() - 40.0).clamp(200.0, 720.0);
    if !lasting.is_empty() {
        let list = egui::Area::new(egui::Id::unique("messages"))
            .order(egui::Order::Middle)
            .pivot(Align2::LEFT_BOTTOM)
            .fixed_pos(egui::pos2(area.left() + 8.0, bottom))
            .show(ctx, |ui| {
                egui::Frame::window(ui.style()).show(ui, |ui| {
                    ui.set_max_width(widest);
                    list(ui, &lasting, next);
                });
            });
        bottom = list.response.rect.top() - 8.0;
    }
    if let Some(message) = messages.passing() {
        egui::Area::new(egui::Id::unique("success"))
            .order(egui::Order::Foreground)
            .pivot(Align2::CENTER_BOTTOM)
            .fixed_pos(egui::pos2(area.center().x, bottom))
            .interactable(false)
            .show(ctx, |ui| {
                egui::Frame::popup(ui.style()).show(ui, |ui| {
                    ui.set_max_width(widest);
                    ui.label(text_of(message));
                });
            });
    }
}

fn list(ui: &mut egui::Ui, messages: &[(usize, &Message)], next: &mut Model) {
    let highest = HIGHEST * ui.ctx().content_rect().height();
    egui::ScrollArea::vertical().max_height(highest).show(ui, |ui| {
        for &(number, message) in messages.iter().rev() {
            ui.horizontal_top(|ui| {
                let close = ui.small_button("x").on_hover_text("Dismiss this message");
                let name = format!("Dismiss: {}", text_of(message));
                close.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
                if close.clicked() {
                    next.messages.dismiss(number);
                }
                ui.vertical(|ui| {
                    ui.add(egui::Label::new(text(ui, message)).wrap());
                    if let Some(retry) = message.retry()
                        && ui.button(retry.label()).clicked()
                    {
                        next.messages.dismiss(number);
                        opening::retry(next, retry);
                    }
                });
            });
        }
    });
    if messages.len() > 1 && ui.button("Dismiss all").clicked() {
        next.messages.dismiss_all();
    }
}

/// The text of a message, in which names from files steer nothing.
fn text_of(message: &Message) -> String {
    drawable(&line(&message.to_string()))
}

fn text(ui: &egui::Ui, message: &Message) -> RichText {
    let colour = match message.severity() {
        Severity::Success => ui.visuals().text_color(),
        Severity::Warning => ui.visuals().warn_fg_color,
        Severity::Error => theme::problem(ui.visuals()),
    };
    RichText::new(text_of(message)).color(colour)
}
