//! Lists of names for messages.

/// Most file names that a message lists.
const MOST_LISTED: usize = 12;

/// Files that other programs leave beside pictures.
pub(crate) fn is_junk(name: &str) -> bool {
    let name = name.to_lowercase();
    [".import", ".meta", ".uid"].iter().any(|end| name.ends_with(end))
        || name == "thumbs.db"
        || name == "desktop.ini"
}

/// The file names for a message, no matter how many they are, without the files that other programs leave.
pub(crate) fn listing(names: &[String]) -> String {
    let names: Vec<&str> = names.iter().map(String::as_str).filter(|name| !is_junk(name)).collect();
    match names.len() {
        0 => "no files".to_owned(),
        count if count > MOST_LISTED => {
            format!("{} and {} more", names[..MOST_LISTED].join(", "), count - MOST_LISTED)
        }
        _ => names.join(", "),
    }
}
