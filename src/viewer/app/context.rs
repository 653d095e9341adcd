//! Context of the window that is open: another one after the graphics device was lost.

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use eframe::egui;

/// The egui context of the open window. Clones share it.
#[derive(Clone)]
pub struct CurrentContext(Arc<Mutex<egui::Context>>);

impl CurrentContext {
    pub fn new(ctx: &egui::Context) -> Self {
        Self(Arc::new(Mutex::new(ctx.clone())))
    }

    pub fn get(&self) -> egui::Context {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    pub fn set(&self, ctx: &egui::Context) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = ctx.clone();
    }
}

impl fmt::Debug for CurrentContext {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("CurrentContext")
    }
}
