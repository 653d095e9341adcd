//! Sessions with random values: no window crashes on them.

use rand::SeedableRng as _;
use rand::rngs::ChaCha8Rng;
use serde_json::{Value, json};
use svbrdf_files::session::Session;

use super::soak::below;
use super::*;

/// Sessions of the usual run.
const SESSIONS: u64 = 40;

/// The places of all values that contain no others.
fn leaves(value: &Value, place: &str, found: &mut Vec<String>) {
    match value {
        Value::Object(all) => all.iter().for_each(|(key, one)| leaves(one, &format!("{place}/{key}"), found)),
        Value::Array(all) => {
            all.iter().enumerate().for_each(|(index, one)| leaves(one, &format!("{place}/{index}"), found));
        }
        _ => found.push(place.to_owned()),
    }
}

/// A session with one or two values replaced: a number mostly by another number.
fn damaged(session: &Value, random: &mut ChaCha8Rng) -> Value {
    let numbers = [0.0, -0.0, -1.0, 0.5, 1e-30, 1e9, -1e9, 1e39, 1e308].map(|number| json!(number));
    let mut others = [0, -1, 4_294_967_296, i64::MIN].map(|number| json!(number)).to_vec();
    others.extend([json!(u64::MAX), json!(true), json!(null), json!([]), json!({})]);
    others.extend(["".to_owned(), "\u{202e}".repeat(300)].map(|text| json!(text)));
    let (mut damaged, mut places) = (session.clone(), Vec::new());
    leaves(session, "", &mut places);
    for _ in 0..=below(random, 2) {
        let is_number = |place: &&String| session.pointer(place).is_some_and(Value::is_f64);
        let of_numbers: Vec<_> = places.iter().filter(is_number).collect();
        let is_other = below(random, 3) == 0;
        let place = if is_other {
            &places[below(random, places.len())]
        } else {
            of_numbers[below(random, of_numbers.len())]
        };
        let replacements = if is_other { &others[..] } else { &numbers[..] };
        if let Some(value) = damaged.pointer_mut(place) {
            *value = replacements[below(random, replacements.len())].clone();
        }
    }
    damaged
}

#[needs(adapter)]
fn sessions_of_random_values_open_or_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = built_in();
    let whole: Value = serde_json::from_str(
        &window.state().parts.model.session().text(&folder.path().join("s.svbrdf-session.json")).unwrap(),
    )
    .unwrap();
    let (mut opened, mut random) = (0, ChaCha8Rng::seed_from_u64(30));
    for number in 0..SESSIONS {
        let path = folder.path().join(format!("{number}.svbrdf-session.json"));
        let text = damaged(&whole, &mut random).to_string();
        std::fs::write(&path, &text).unwrap();
        match Session::read(&path) {
            Ok(_) => opened += 1,
            Err(error) => assert!(error.to_string().contains(path.to_str().unwrap()), "{error}"),
        }
        drop_files(&mut window, [path]);
        window.run_steps(2);
        wait(&mut window, "the session", |app| !app.is_reading());
        assert!(!window.state().has_crashed(), "{text}");
        if number % 10 == 0 {
            window.render().unwrap();
        }
    }
    // Neither comparator is idle: some are opened, and some are refused.
    assert!((5..SESSIONS - 5).contains(&opened), "{opened} of {SESSIONS} sessions can be read");
}
