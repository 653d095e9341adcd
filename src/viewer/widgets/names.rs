//! Names shortened to a width, and still distinct.

use eframe::egui::{Color32, FontId, Ui};

/// Characters after which a common beginning may end.
const SEPARATORS: [char; 6] = ['/', '\\', '_', '-', ' ', '.'];
/// The fewest and the most characters of a name in a text that is fitted.
pub const FEWEST: usize = 6;
const MOST: usize = 80;

/// The longest `text(most)`, whose names have at most `most` characters each, that fits into `width` points; `None` where even the
/// shortest does not.
pub fn fitted(ui: &Ui, font: &FontId, width: f32, text: impl Fn(usize) -> String) -> Option<String> {
    let fits = |text: &str| {
        let galley = ui.painter().layout_no_wrap(text.to_owned(), font.clone(), Color32::PLACEHOLDER);
        galley.size().x <= width
    };
    let whole = text(usize::MAX);
    if fits(&whole) {
        return Some(whole);
    }
    let lengths: Vec<usize> = (FEWEST..=MOST).collect();
    let fitting = lengths.partition_point(|length| fits(&text(*length)));
    fitting.checked_sub(1).map(|last| text(lengths[last]))
}

/// Names of materials, shortened so that they stay distinct.
#[derive(Clone, Debug)]
pub struct Names<'a> {
    names: Vec<&'a str>,
    /// Characters of the longest, and of the beginning and the ending that all have in common.
    longest: usize,
    common: usize,
    ending: usize,
}

impl<'a> Names<'a> {
    pub fn new(names: &[&'a str]) -> Self {
        let longest = names.iter().map(|name| name.chars().count()).max().unwrap_or(0);
        let shortest = names.iter().map(|name| name.chars().count()).min().unwrap_or(0);
        let (common, ending) =
            if names.len() > 1 { (common_beginning(names), common_ending(names)) } else { (0, 0) };
        Self { names: names.to_vec(), longest, common, ending: ending.min(shortest - common.min(shortest)) }
    }

    /// The name in place `index` in at most `most` characters. Where one of the names is too long, the beginning that all have in
    /// common becomes an ellipsis, then the ending; a name that is still too long loses its middle.
    pub fn shortened(&self, index: usize, most: usize) -> String {
        let Some(name) = self.names.get(index) else { return String::new() };
        if self.longest <= most {
            return (*name).to_owned();
        }
        // An ellipsis takes the room of a character.
        let (start, dots) = if self.common > 2 { (self.common, "\u{2026}") } else { (0, "") };
        let cuts_ending = self.ending > 2 && self.longest - start + dots.chars().count() > most;
        let (ending, more) = if cuts_ending { (self.ending, "\u{2026}") } else { (0, "") };
        let count = name.chars().count() - start - ending;
        let own: String = name.chars().skip(start).take(count).collect();
        without_middle(&format!("{dots}{own}{more}"), most)
    }
}

/// The names in at most `most` characters each, as [`Names::shortened`].
pub fn shortened(names: &[&str], most: usize) -> Vec<String> {
    let all = Names::new(names);
    (0..names.len()).map(|index| all.shortened(index, most)).collect()
}

/// The number of characters, up to and with a separator, that all names begin with.
fn common_beginning(names: &[&str]) -> usize {
    let Some((first, others)) = names.split_first() else { return 0 };
    let shared = |other: &&str| first.chars().zip(other.chars()).take_while(|(a, b)| a == b).count();
    let length = others.iter().map(shared).min().unwrap_or(0);
    let beginning: Vec<char> = first.chars().take(length).collect();
    beginning.iter().rposition(|c| SEPARATORS.contains(c)).map_or(0, |at| at + 1)
}

/// The number of characters, from a separator on, that all names end with.
fn common_ending(names: &[&str]) -> usize {
    let reversed: Vec<String> = names.iter().map(|name| name.chars().rev().collect()).collect();
    common_beginning(&reversed.iter().map(String::as_str).collect::<Vec<_>>())
}

/// The text with an ellipsis for its middle where it has more than `most` characters. The end, which counts epochs and names
/// files, keeps more.
fn without_middle(text: &str, most: usize) -> String {
    let count = text.chars().count();
    if count <= most {
        return text.to_owned();
    }
    let head = most.saturating_sub(1) * 2 / 5;
    let tail = most.saturating_sub(1) - head;
    let end: String = text.chars().skip(count - tail).collect();
    format!("{}\u{2026}{end}", text.chars().take(head).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::material::loaded::{DRAWN, drawable};
    use eframe::egui;

    #[test]
    fn every_character_that_names_keep_has_a_picture_and_the_others_are_written_out() {
        let ctx = egui::Context::default();
        ctx.run_ui(egui::RawInput::default(), |_| ()).textures_delta.clear();
        let font = FontId::proportional(13.0);
        let has = |c: char| ctx.fonts_mut(|fonts| fonts.has_glyph(&font, c));
        let lacking: Vec<char> = DRAWN.into_iter().flatten().filter(|c| !has(*c)).collect();
        assert!(lacking.is_empty(), "{lacking:?}");
        assert!(!has('\u{5317}') && !has('\u{05e9}'), "what is written out has none");
        assert_eq!(drawable("bois_été Ω ж\u{2026}"), "bois_été Ω ж\u{2026}");
        assert_eq!(drawable("\u{5317}\u{4eac}.png"), r"\u{5317}\u{4eac}.png");
    }

    #[test]
    fn long_names_lose_their_common_beginning_and_then_their_middle() {
        let names = ["experiment_42/epoch_0001", "experiment_42/epoch_0002", "experiment_42/epoch_0010"];
        assert_eq!(shortened(&names, 12), ["\u{2026}0001", "\u{2026}0002", "\u{2026}0010"]);
        let one = shortened(&["a_rather_long_name_of_a_run_0007"], 16);
        assert_eq!(one, ["a_rath\u{2026}_run_0007"]);
        assert_eq!(one[0].chars().count(), 16);
    }

    #[test]
    fn a_folder_that_tells_names_apart_is_kept_and_the_file_that_all_have_is_not() {
        let names = ["ours/mat17.png", "diffusion-large/mat17.png", "theirs/mat17.png"];
        assert_eq!(shortened(&names, 16), ["ours\u{2026}", "diffusion-large\u{2026}", "theirs\u{2026}"]);
        let both = ["runs/a/mat17.png", "runs/bcdef/mat17.png"];
        assert_eq!(shortened(&both, 17), ["\u{2026}a/mat17.png", "\u{2026}bcdef/mat17.png"]);
        assert_eq!(shortened(&both, 8), ["\u{2026}a\u{2026}", "\u{2026}bcdef\u{2026}"]);
    }

    #[test]
    fn a_fitted_name_uses_the_width_and_keeps_its_ending() {
        let names: Vec<String> =
            (1..16).map(|i| format!("method_{i:02}_with_a_long_name_epoch_{i}000")).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let names = Names::new(&names);
        egui::__run_test_ui(|ui| {
            let font = FontId::proportional(13.5);
            let width =
                |text: String| ui.painter().layout_no_wrap(text, font.clone(), Color32::PLACEHOLDER).size().x;
            for room in [85.0, 100.0, 120.0, 200.0, 1000.0] {
                let text = |most| format!("{}  {}", 7, names.shortened(6, most));
                let fitted = fitted(ui, &font, room, text).unwrap();
                assert!(width(fitted.clone()) <= room && fitted.ends_with("000"), "{room}: {fitted}");
                let longer = text(fitted.chars().count() - 3 + 1);
                assert!(width(longer.clone()) > room || room == 1000.0, "{longer} would fit into {room}");
            }
            assert_eq!(fitted(ui, &font, 20.0, |most| names.shortened(0, most)), None);
        });
    }
}
