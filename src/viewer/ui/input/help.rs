//! The list of keys and gestures.

use eframe::egui::{self, RichText};

use crate::model::command::{Command, WindowCommand};
use crate::ui::input::keys::{self, HelpLine};

/// Width of the list in one column and in two, in points.
const WIDTHS: [f32; 2] = [560.0, 1120.0];
/// Width of the keys, in points.
const KEYS: f32 = 190.0;

/// The help window; closing it is a command.
pub fn ui(ctx: &egui::Context) -> Option<Command> {
    let mut open = true;
    let room = ctx.content_rect().size();
    let columns = if room.x > WIDTHS[1] + 60.0 { 2 } else { 1 };
    let width = WIDTHS[columns - 1].min((room.x - 40.0).max(0.0));
    let height = (room.y - 130.0).max(0.0);
    egui::Window::new("Keys and mouse")
        .open(&mut open)
        .collapsible(false)
        .resizable(false)
        .anchor(egui::Align2::CENTER_CENTER, [0.0, 0.0])
        .show(ctx, |ui| {
            ui.set_width(width);
            let searched = search(ui);
            ui.separator();
            egui::ScrollArea::vertical()
                .max_height(height)
                .min_scrolled_height(height)
                .auto_shrink([false, true])
                .show(ui, |ui| {
                    let groups = groups(&searched);
                    if groups.is_empty() {
                        ui.weak("No key and no gesture has these words.");
                    }
                    let first = split(&groups, columns);
                    ui.columns(columns, |columns| {
                        for (i, (name, lines)) in groups.iter().enumerate() {
                            group(&mut columns[usize::from(i >= first)], name, lines);
                        }
                    });
                });
        });
    (!open).then_some(WindowCommand::ShowHelp(false).into())
}

/// The field for words of the list; returns them in lower case.
fn search(ui: &mut egui::Ui) -> String {
    let id = ui.scope_id().with("searched");
    let mut text: String = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    let field =
        egui::TextEdit::singleline(&mut text).hint_text("Search keys and effects").desired_width(220.0);
    ui.add(field);
    ui.data_mut(|data| data.insert_temp(id, text.clone()));
    text.to_lowercase()
}

/// The groups and lines that contain the words.
fn groups(searched: &str) -> Vec<(&'static str, Vec<HelpLine>)> {
    let contains = |text: &str| text.to_lowercase().contains(searched);
    let of = |(name, lines): &(&'static str, &[HelpLine])| {
        let lines = lines.iter().copied();
        let found: Vec<HelpLine> =
            lines.filter(|(key, effect)| contains(name) || contains(key) || contains(effect)).collect();
        (!found.is_empty()).then_some((*name, found))
    };
    keys::HELP.iter().filter_map(of).collect()
}

/// The first group of the second column: both columns have about the same number of lines.
fn split(groups: &[(&str, Vec<HelpLine>)], columns: usize) -> usize {
    let size =
        |groups: &[(&str, Vec<HelpLine>)]| groups.iter().map(|(_, lines)| lines.len() + 2).sum::<usize>();
    let longer = |n: &usize| size(&groups[..*n]).max(size(&groups[*n..]));
    if columns == 1 { groups.len() } else { (1..=groups.len()).min_by_key(longer).unwrap_or(0) }
}

/// A group, each line laid out by itself: a grid measures its rows for a frame, in which keys stand beside effects of others.
fn group(ui: &mut egui::Ui, name: &str, lines: &[HelpLine]) {
    ui.strong(name);
    for (number, (key, effect)) in lines.iter().enumerate() {
        let fill = if number % 2 == 1 { ui.visuals().faint_bg_color } else { egui::Color32::TRANSPARENT };
        egui::Frame::NONE.fill(fill).show(ui, |ui| {
            ui.set_width(ui.available_width());
            ui.horizontal_top(|ui| {
                let key = egui::Label::new(RichText::new(*key).monospace().size(11.5)).wrap();
                ui.allocate_ui(egui::vec2(KEYS, 0.0), |ui| {
                    ui.set_width(KEYS);
                    ui.add(key);
                });
                ui.add(egui::Label::new(*effect).wrap());
            });
        });
    }
    ui.add_space(8.0);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_is_searched_in_groups_keys_and_effects() {
        let names =
            |words: &str| groups(words).iter().map(|(name, lines)| (*name, lines.len())).collect::<Vec<_>>();
        assert_eq!(names("").len(), keys::HELP.len());
        assert_eq!(names("orbit the light"), [("Light", 1)]);
        assert_eq!(names("files").first(), Some(&("Files", 4)));
        assert_eq!(names("no such words"), []);
    }

    #[test]
    fn two_columns_have_about_the_same_number_of_lines() {
        let all = groups("");
        let first = split(&all, 2);
        let lines =
            |groups: &[(&str, Vec<HelpLine>)]| groups.iter().map(|(_, lines)| lines.len() + 2).sum::<usize>();
        assert!(lines(&all[..first]).abs_diff(lines(&all[first..])) < 12, "{first}");
        assert_eq!(split(&all, 1), all.len());
    }
}
