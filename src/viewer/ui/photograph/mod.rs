//! Photograph in the window: its card in the side panel, and the editor of its corners.

pub mod card;
pub mod corner_editor;
mod filmstrip;
