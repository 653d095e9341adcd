//! A picture in a panel or a pane.

use eframe::egui;

/// A texture of the window, freed with its last owner.
#[derive(Clone)]
pub(crate) struct PanelTexture(egui::TextureHandle);

impl PanelTexture {
    /// Loads a picture. Workers may do so, too.
    pub(crate) fn new(
        ctx: &egui::Context,
        name: &str,
        picture: egui::ColorImage,
        options: egui::TextureOptions,
    ) -> Self {
        Self(ctx.load_texture(name, picture, options))
    }

    pub(crate) fn id(&self) -> egui::TextureId {
        self.0.id()
    }
}

impl std::fmt::Debug for PanelTexture {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("PanelTexture").field(&self.0.id()).finish()
    }
}
