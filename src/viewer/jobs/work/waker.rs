//! Waker of the window: asks for a frame, from any thread.

use std::fmt;
use std::sync::Arc;
use std::time::Duration;

/// Asks for a frame after a while.
#[derive(Clone)]
pub struct Waker(Arc<dyn Fn(Duration) + Send + Sync>);

impl Waker {
    /// `ask` asks for a frame after this time at the latest.
    pub fn new(ask: impl Fn(Duration) + Send + Sync + 'static) -> Self {
        Self(Arc::new(ask))
    }

    /// Asks for a frame at once.
    pub fn wake(&self) {
        self.wake_after(Duration::ZERO);
    }

    /// Asks for a frame after this time at the latest.
    pub fn wake_after(&self, time: Duration) {
        (self.0)(time);
    }
}

impl Default for Waker {
    /// A waker of no window.
    fn default() -> Self {
        Self::new(|_| {})
    }
}

impl fmt::Debug for Waker {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Waker")
    }
}
