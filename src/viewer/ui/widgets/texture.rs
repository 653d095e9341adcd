//! Textures of pictures that jobs have made.

use std::collections::HashMap;
use std::sync::{Arc, Weak};

use eframe::egui::{ColorImage, Context, TextureHandle, TextureId, TextureOptions};

use crate::jobs::work::picture::Picture;

/// The textures of the pictures that panels and panes draw; each is freed with its picture.
#[derive(Default)]
pub struct PanelTextures(HashMap<usize, (Weak<Picture>, TextureHandle)>);

impl PanelTextures {
    /// The texture of a picture, which is loaded where it is new.
    pub fn id(&mut self, ctx: &Context, picture: &Arc<Picture>, options: TextureOptions) -> TextureId {
        self.0.retain(|_, (of, _)| of.strong_count() > 0);
        let load = || {
            let image = ColorImage::from_rgba_premultiplied(picture.size, picture.pixels.as_flattened());
            (Arc::downgrade(picture), ctx.load_texture("picture", image, options))
        };
        // A picture that lives is at an address of its own.
        self.0.entry(Arc::as_ptr(picture).addr()).or_insert_with(load).1.id()
    }
}

impl std::fmt::Debug for PanelTextures {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("PanelTextures").field(&self.0.len()).finish()
    }
}
