//! Names shortened to a width, and still distinct.

/// Characters after which a common beginning may end.
const SEPARATORS: [char; 6] = ['/', '\\', '_', '-', ' ', '.'];

/// The names in at most `most` characters each. Where one is too long, the beginning that all have in common becomes an
/// ellipsis; a name that is still too long loses its middle.
pub fn shortened(names: &[&str], most: usize) -> Vec<String> {
    let too_long = names.iter().any(|name| name.chars().count() > most);
    let cut = if too_long && names.len() > 1 { common_beginning(names) } else { 0 };
    let one = |name: &&str| {
        let ending: String = name.chars().skip(cut).collect();
        let text = if cut > 2 { format!("\u{2026}{ending}") } else { (*name).to_owned() };
        without_middle(&text, most)
    };
    names.iter().map(one).collect()
}

/// The number of characters, up to and with a separator, that all names begin with.
fn common_beginning(names: &[&str]) -> usize {
    let Some((first, others)) = names.split_first() else { return 0 };
    let shared = |other: &&str| first.chars().zip(other.chars()).take_while(|(a, b)| a == b).count();
    let length = others.iter().map(shared).min().unwrap_or(0);
    let beginning: Vec<char> = first.chars().take(length).collect();
    beginning.iter().rposition(|c| SEPARATORS.contains(c)).map_or(0, |at| at + 1)
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

    #[test]
    fn names_that_fit_stay_as_they_are() {
        assert_eq!(shortened(&["run_1", "run_2"], 10), ["run_1", "run_2"]);
        assert_eq!(shortened(&[], 10), Vec::<String>::new());
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
    fn different_names_stay_different() {
        let names: Vec<String> = (0..40).map(|i| format!("model/with/some/name/step_{i:05}_final")).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let short = shortened(&names, 18);
        let distinct: std::collections::HashSet<_> = short.iter().collect();
        assert_eq!(distinct.len(), 40, "{short:?}");
        assert!(short.iter().all(|name| name.chars().count() <= 18), "{short:?}");
    }
}
