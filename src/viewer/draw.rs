//! The whole window, drawn: each part is given what it shows and returns commands.

use eframe::egui::{self, RichText};

use super::app::App;
use super::command::{Command, WindowCommand};
use super::panels;
use super::panels::legend::LegendStrip;
use super::panels::loss::LossPanel;
use super::panels::materials::MaterialsPanel;
use super::panels::photograph::PhotographCard;
use super::panels::pins::Drawer;
use super::panels::scene::ScenePanel;
use super::panels::status::StatusBar;
use super::panels::study::StudyWindow;
use super::panels::top::TopBar;
use super::panels::training::TrainingPanel;
use super::panels::values::ValueStrip;
use super::panels::why::WhyPanel;
use super::panes::Scenery;
use super::settings::Tab;
use super::slot::Slot;
use super::why::ComparedPair;
use crate::files::read::Certainty;

/// Least width of the side panel, in points: its contents do not fit into less.
const SIDE: f32 = 320.0;

/// The panel without a background: the window is cleared in its colour, and filling it again takes time on slow adapters.
fn bare(panel: egui::Panel, ui: &egui::Ui) -> egui::Panel {
    panel.frame(egui::Frame::side_top_panel(ui.style()).fill(egui::Color32::TRANSPARENT))
}

impl App {
    /// Draws everything and returns the commands of the person.
    pub(super) fn draw(&mut self, ui: &mut egui::Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        bare(egui::Panel::top("top"), ui).show(ui, |ui| commands.extend(self.top(ui)));
        bare(egui::Panel::bottom("status"), ui).show(ui, |ui| commands.extend(self.status(ui)));
        let below_bar = ui.available_height();
        if !self.inspect.is_empty() && self.slots.ground_truth().is_some() {
            bare(egui::Panel::bottom("drawer"), ui)
                .resizable(false)
                .show(ui, |ui| commands.extend(self.drawer(ui)));
        }
        let shown = *self.side_panel(ui.ctx());
        let mut side_panel = shown;
        bare(egui::Panel::right("side"), ui)
            .default_size(SIDE)
            .size_range(SIDE..=(0.4 * ui.available_width()).max(SIDE))
            .show_collapsible(ui, &mut side_panel, |ui| commands.extend(self.side(ui)));
        if side_panel != shown {
            commands.push(WindowCommand::ToggleSidePanel.into());
        }
        let area = ui.available_rect_before_wrap();
        self.drawer_share = 1.0 - area.height() / below_bar.max(1.0);
        self.picture_size = [area.width(), area.height()].map(|side| (side * ui.pixels_per_point()) as u32);
        commands.extend(self.content(ui));
        commands.extend(panels::messages::ui(ui.ctx(), area, &self.messages));
        commands.extend(self.windows(ui.ctx()));
        commands
    }

    /// The panes and the legend: what a picture of the view has.
    pub(super) fn content(&mut self, ui: &mut egui::Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        // A saved picture has the arrangement of the window, also at another size.
        let undivided = ui.available_height() / (1.0 - self.drawer_share).max(0.1);
        if self.state.difference && self.compares() {
            bare(egui::Panel::bottom("legend"), ui).show(ui, |ui| commands.extend(self.legend(ui)));
        }
        if self.settings.histograms && !self.state.difference && self.slots.ground_truth().is_some() {
            bare(egui::Panel::bottom("values"), ui).show(ui, |ui| self.values(ui));
        }
        egui::CentralPanel::no_frame().show(ui, |ui| commands.extend(self.panes(ui, undivided)));
        commands
    }

    /// Whether there is something to compare: predictions, or a photograph.
    fn compares(&self) -> bool {
        !self.slots.predictions().is_empty() || self.photograph_scene().is_some()
    }

    fn top(&mut self, ui: &mut egui::Ui) -> Vec<Command> {
        let side_panel = *self.side_panel(ui.ctx());
        let bar = TopBar {
            state: &self.state,
            dark: self.settings.dark,
            side_panel,
            scale: self.settings.ui_scale,
            histograms: self.settings.histograms,
            has_predictions: !self.slots.predictions().is_empty(),
            has_photograph: self.photograph.source().is_some(),
            swapped: self.swapped,
        };
        bar.ui(ui)
    }

    fn status(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let hovered = self.viewport.hovered;
        let grid = self.slots.ground_truth().map(|slot| slot.loaded.material.grid());
        let bar = StatusBar {
            state: &self.state,
            slots: &self.seen,
            error_maps: self.error_maps().map(AsRef::as_ref),
            photographs: self.photographs().map(AsRef::as_ref),
            texel: hovered.and_then(|hovered| self.state.texel_at(grid?, hovered.point)),
            hovered: hovered.map(|hovered| hovered.slot),
            magnification: grid.map_or(1.0, |grid| self.viewport.magnification(grid, &self.state)),
            armed: self.inspect.armed,
            adapter: self.gpu.as_ref().map(|g| &g.gpu.report),
            frame_ms: self.frame_ms,
        };
        bar.ui(ui)
    }

    fn drawer(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let numbers = |region| self.region.get(region, &self.seen, &self.state);
        let drawer = Drawer {
            inspect: &self.inspect,
            slots: &self.seen,
            state: &self.state,
            region: self.inspect.region.and_then(numbers),
        };
        drawer.ui(ui)
    }

    /// The tab, and below it light and view.
    fn side(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let mut commands = self.tabs(ui);
        bare(egui::Panel::bottom("scene"), ui).resizable(false).show(ui, |ui| {
            let header = egui::CollapsingHeader::new("Light and view").default_open(true);
            let scene =
                ScenePanel { state: &self.state, settings: &self.settings, animation: &self.animation };
            header.show_unindented(ui, |ui| commands.extend(scene.ui(ui)));
        });
        if let Some(photograph) = self.photograph.scene(&self.seen) {
            let shown = self.photograph_scene().is_some();
            let names = self.seen.iter().map(Slot::name).collect();
            let card = PhotographCard { photograph, names, shown };
            bare(egui::Panel::bottom("photograph"), ui)
                .resizable(false)
                .show(ui, |ui| commands.extend(card.ui(ui)));
        }
        egui::ScrollArea::vertical().id_salt(self.settings.tab as usize).auto_shrink([false, false]).show(
            ui,
            |ui| {
                commands.extend(match self.settings.tab {
                    Tab::Loss => self.loss_tab(ui),
                    Tab::Why => self.why_tab(ui),
                    Tab::Files => MaterialsPanel { slots: &self.slots, watch: self.settings.watch }.ui(ui),
                });
            },
        );
        commands
    }

    fn tabs(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        let unsure = self.slots.slots.iter().flat_map(|slot| &slot.loaded.assumptions);
        let unsure = unsure.filter(|assumption| assumption.certainty == Certainty::Unsure).count();
        ui.horizontal(|ui| {
            for (tab, name, question) in Tab::ALL {
                let text = match tab {
                    Tab::Files if unsure > 0 => {
                        RichText::new(format!("{name} ({unsure}?)")).color(ui.visuals().warn_fg_color)
                    }
                    _ => RichText::new(name),
                };
                let label = ui.selectable_label(self.settings.tab == tab, text.size(14.5));
                label.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Tab, true, format!("Tab {name}")));
                let hover = match tab {
                    Tab::Files if unsure > 0 => format!("{question} {unsure} guesses are unsure"),
                    _ => question.to_owned(),
                };
                if label.on_hover_text(hover).clicked() {
                    commands.push(WindowCommand::ChooseTab(tab).into());
                }
            }
        });
        ui.separator();
        commands
    }

    fn loss_tab(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let loss = LossPanel {
            settings: &self.settings.loss,
            auto: self.settings.auto_loss,
            run: &self.loss,
            few: &self.few,
            sorted: self.settings.sort_losses,
            slots: &self.slots,
            chosen: self.state.prediction,
        };
        let mut commands = loss.ui(ui);
        let training = TrainingPanel {
            runs: self.training.views(&self.slots.slots),
            chosen: self.state.prediction,
            watch: self.settings.watch,
            busy: self.training.losses.busy(),
        };
        commands.extend(training.ui(ui));
        commands
    }

    fn why_tab(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let why = WhyPanel {
            state: &self.state,
            losses: self.scene_loss.get(&self.slots, &self.state),
            names: self.slots.predictions().iter().map(|slot| slot.name()).collect(),
            pair: ComparedPair::of(&self.slots.slots, &self.state),
            why: &self.why,
            sections: self.settings.why,
            settings: &self.settings.loss,
        };
        why.ui(ui)
    }

    fn legend(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let distributions = self.distributions();
        let first = usize::from(self.photograph_scene().is_none());
        let strip = LegendStrip {
            quantity: self.state.quantity,
            kind: self.state.difference_kind(),
            error_map: self.state.is_error_map().then(|| self.error_map_summary()),
            set_range: self.state.differences.range(self.state.quantity),
            range: self.range(),
            distributions: distributions.map(|(distributions, _)| distributions),
            current: distributions.is_some_and(|(_, current)| current),
            names: self.seen.iter().skip(first).map(|slot| slot.name()).collect(),
            first,
            chosen: (self.state.prediction + 1).min(self.seen.len().saturating_sub(1)).saturating_sub(first),
        };
        strip.ui(ui)
    }

    fn values(&self, ui: &mut egui::Ui) {
        let strip = ValueStrip {
            quantity: self.state.quantity,
            values: self.values.get(&self.seen, &self.state),
            names: self.seen.iter().map(|slot| slot.name()).collect(),
            chosen: self.state.prediction + 1,
        };
        strip.ui(ui);
    }

    fn panes(&mut self, ui: &mut egui::Ui, undivided: f32) -> Vec<Command> {
        let peek = ui.input(|i| i.key_down(egui::Key::G)) && !ui.ctx().text_edit_focused();
        let error_maps = self.error_maps().cloned();
        let range = self.range();
        let is_photographed = self.photograph_scene().is_some();
        let photograph = if is_photographed { self.photograph.scene(&self.seen) } else { None };
        let scenery = Scenery {
            slots: &self.seen,
            state: &self.state,
            dark: self.settings.dark,
            highlight_follows: self.settings.highlight_follows,
            view_handle: self.settings.view_handle,
            peek,
            swapped: self.swapped,
            reading: !self.slots.openings.is_empty(),
            range,
            error_maps: error_maps.as_deref(),
            photograph,
            inspect: &self.inspect,
            undivided,
        };
        self.viewport.ui(ui, &scenery, self.gpu.as_mut())
    }

    fn windows(&mut self, ctx: &egui::Context) -> Vec<Command> {
        let mut commands = Vec::new();
        if self.help {
            commands.extend(panels::help::ui(ctx));
        }
        if self.study_window {
            commands.extend(self.study_window(ctx));
        }
        if let Some(window) = &mut self.open_window {
            commands.extend(window.ui(ctx, &self.settings.recent, self.settings.last.as_ref()));
        }
        if let Some(window) = &mut self.photograph_window {
            commands.extend(window.ui(ctx));
        }
        if let Some(window) = &mut self.save_window {
            commands.extend(window.ui(ctx, self.picture_size));
        }
        commands
    }

    fn study_window(&self, ctx: &egui::Context) -> Vec<Command> {
        let window = StudyWindow {
            run: &self.study,
            measured: self.study.measured(&self.slots, self.state.prediction, &self.state.convention()),
            current: self.settings.loss.sampling(),
        };
        window.ui(ctx)
    }
}
