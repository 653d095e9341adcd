//! Loss of the graphics device: the window is closed, and opened again on a new device with everything that it had.
//!
//! eframe 0.37 creates its device with its window, and cannot replace it. So [`App`] outlives its window.

use std::time::{Duration, Instant};

use eframe::egui;

use svbrdf_core::error::Error;

use super::App;
use crate::model::message::Message;

/// Losses longer ago than this do not count: the device has worked since then.
const RECENT: Duration = Duration::from_secs(10);
/// Number of recent losses after which a new device of the same kind is not tried again.
const RETRIES: usize = 3;

/// Which adapters a window may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Adapters {
    /// The best one.
    All,
    /// Those that compute on the CPU, where there are any.
    Software,
}

/// The recent losses of devices.
#[derive(Debug)]
pub struct DeviceLosses {
    recent: Vec<Instant>,
    adapters: Adapters,
}

impl Default for DeviceLosses {
    fn default() -> Self {
        Self { recent: Vec::new(), adapters: Adapters::All }
    }
}

impl DeviceLosses {
    /// Where the next device comes from after a loss at `now`; `None` where devices are lost again and again.
    pub fn next(&mut self, now: Instant) -> Option<Adapters> {
        self.recent.retain(|earlier| now.duration_since(*earlier) < RECENT);
        self.recent.push(now);
        if self.recent.len() > RETRIES {
            if self.adapters == Adapters::Software {
                return None;
            }
            self.adapters = Adapters::Software;
            self.recent.clear();
        }
        Some(self.adapters)
    }
}

/// The end of the window where devices are lost again and again.
pub fn given_up(problem: &str) -> Error {
    Error::Gpu {
        problem: format!("the graphics device was lost again and again ({problem})"),
        remedy: "update the graphics driver, or set WGPU_BACKEND to another one (vulkan, gl); the next start offers \
                 to reopen these materials with Ctrl+Shift+O",
    }
}

impl App {
    /// Why the device of the window was lost, where it was.
    pub fn loss(&self) -> Option<&str> {
        self.parts.gpu.as_ref().and_then(|gpu| gpu.gpu.loss())
    }

    /// Closes the window of a lost device, and draws nothing into it: egui-wgpu 0.37 would panic.
    pub(super) fn leave(&mut self, ctx: &egui::Context) {
        self.crash.forgive();
        ctx.graphics_mut(|graphics| *graphics = Default::default());
        self.memory = Some(ctx.memory(Clone::clone));
        ctx.send_viewport_cmd(egui::ViewportCommand::Close);
    }

    /// Continues in a new window, on its device, with everything that the last one had.
    pub fn resume(&mut self, cc: &eframe::CreationContext<'_>) {
        let reason = self.loss().unwrap_or("no reason is known").trim().to_owned();
        self.context.set(&cc.egui_ctx);
        if let Some(memory) = self.memory.take() {
            cc.egui_ctx.memory_mut(|now| *now = memory);
        }
        // After the memory, which holds the fonts that are to be loaded.
        super::theme::install(&cc.egui_ctx);
        cc.egui_ctx.set_zoom_factor(self.parts.model.settings.ui_scale);
        self.opened_at = self.parts.model.time;
        self.parts.ui.forget_device();
        self.parts.gpu = super::adapter(cc, &mut self.parts.model, &self.context);
        self.parts.jobs.replace_device(self.parts.gpu.as_ref().map(|gpu| gpu.gpu.clone()));
        if let Some(gpu) = &self.parts.gpu {
            let adapter = gpu.gpu.report.name.clone();
            self.parts.model.report([Message::DeviceReplaced { reason, adapter }]);
        }
    }
}

/// When the tests of the real window lose its device: `drag` in every drag, `always` in every frame.
#[cfg(feature = "testing")]
const LOSE: &str = "SVBRDF_TEST_LOSE_DEVICE";

#[cfg(feature = "testing")]
impl App {
    /// Loses the device where a test wants that.
    pub(super) fn lose_for_test(&self, ctx: &egui::Context) {
        let is_due = match std::env::var(LOSE).as_deref() {
            Ok("drag") => ctx.input(|i| i.pointer.is_decidedly_dragging()),
            Ok("always") => true,
            _ => false,
        };
        self.parts.gpu.iter().filter(|_| is_due).for_each(|gpu| gpu.gpu.lose());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_device_is_replaced_three_times_then_by_software_then_no_more_and_old_losses_do_not_count() {
        let (start, mut losses) = (Instant::now(), DeviceLosses::default());
        let mut next = |seconds| losses.next(start + Duration::from_secs(seconds));
        for hour in 0..50 {
            assert_eq!(next(3600 * hour), Some(Adapters::All), "{hour}");
        }
        let at = 3600 * 50;
        assert_eq!([at, at + 1, at + 2].map(&mut next), [Some(Adapters::All); 3]);
        assert_eq!([at + 3, at + 4, at + 5, at + 6].map(&mut next), [Some(Adapters::Software); 4]);
        assert_eq!(next(at + 7), None);
    }
}
