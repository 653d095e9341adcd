//! The numbers of every quantity below the panes: the statistics of each of its differences.

use svbrdf_core::picture::difference::DifferenceParams;

use super::*;

#[needs(adapter)]
fn every_difference_of_every_quantity_has_its_statistics_histogram_and_range() {
    let (materials, scene) = (materials(), ViewState::default().scene);
    let params = DifferenceParams { epsilon: PRINTED.epsilon, exposure_ev: 0.0 };
    let mut window = built_in();
    press(&mut window, egui::Key::D);
    let mut means = Vec::new();
    for quantity in Quantity::ALL {
        let image = |material| quantity.image(material, &scene, &PRINTED, &Progress::default()).unwrap();
        let images: Vec<_> = materials.iter().map(image).collect();
        for &kind in Difference::pointwise(quantity) {
            let display = &mut window.state_mut().parts.model.view.display;
            display.quantity = quantity;
            display.differences.choose(quantity, kind);
            window.run_steps(2);
            let found = statistics(&mut window);
            let of = |index: usize| Statistics::of(&kind.of_images(&images[0], &images[index], params));
            let what = format!("{} of {}", kind.name(), quantity.name());
            assert_eq!(found.iter().copied().map(Some).collect::<Vec<_>>(), [of(1), of(2)], "{what}");
            let measured = window.difference_distributions().unwrap();
            for histogram in &measured.histograms {
                let counts: u64 = histogram.counts.iter().sum();
                assert!(counts > 60_000, "{what}: {counts} texels in the histogram");
            }
            assert_eq!(window.difference_range(), measured.auto_range, "{what}");
            means.push(found[0].mean);
        }
    }
    let others = means.windows(2).filter(|two| two[0] != two[1]).count();
    assert!(others >= 8, "a planted fault: one difference for all, {means:?}");
}
