//! Names of files and options of any letters.

use svbrdf_files::read::{Binding, Reflectance, TileGrid};

use super::*;

#[test]
fn folders_of_any_names_never_panic() {
    let parts: Vec<&str> =
        "normal|gl|DX|diff|rough|_|-|.| |ks|shared|0|3|1024|\u{e4}\u{130}|orm".split('|').collect();
    let picture = encoded(&packed("N", 1, |_, v| v), ImageFormat::Png);
    let mut random = ChaCha8Rng::seed_from_u64(9);
    let mut below = |limit: usize| random.next_u32() as usize % limit;
    let (mut opened, mut refused) = (0, 0);
    for _ in 0..budget() {
        let folder = tempdir().unwrap();
        for _ in 0..1 + below(6) {
            let name: String = (0..1 + below(6)).map(|_| parts[below(parts.len())]).collect();
            std::fs::write(folder.path().join(name + ".png"), &picture).unwrap();
        }
        match read::<f32>(folder.path(), &OPTIONS, &Progress::default()) {
            Ok(_) => opened += 1,
            Err(_) => refused += 1,
        }
    }
    println!("folders: {opened} opened, {refused} refused");
    assert!(opened > 0 && refused > 0);
}

#[test]
fn options_of_any_letters_never_panic() {
    let mut random = ChaCha8Rng::seed_from_u64(13);
    let mut below = |limit: usize| random.next_u32() as usize % limit;
    let letters: Vec<char> = "nndrsbmi4x1:=.-e\u{e4}NaNinf".chars().collect();
    let mut understood = 0;
    for _ in 0..100 * budget() {
        let text: String = (0..below(8)).map(|_| letters[below(letters.len())]).collect();
        if let Ok(order) = text.parse::<Order>() {
            assert_eq!(order.to_string().parse::<Order>().unwrap(), order);
            understood += 1;
        }
        understood +=
            usize::from(text.parse::<TileGrid>().is_ok_and(|grid| grid.columns > 0 && grid.rows > 0));
        understood +=
            usize::from(text.parse::<Reflectance>().is_ok_and(|f| (0.0..=1.0).contains(&f.value())));
        understood += usize::from(text.parse::<Binding>().is_ok());
    }
    assert!(understood > 0);
}
