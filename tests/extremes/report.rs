//! docs/extremes.md: the tables of a survey with their explanation.

use std::fmt::Write as _;

use super::regions::Region;
use super::rungs::{self, Rung};
use super::survey::{Case, Errors, Survey};

/// The document. `random` is the number of random points among the points of the survey.
pub fn markdown(survey: &Survey, random: u64, adapter: Option<&str>) -> String {
    let levels: Vec<_> = rungs::levels().into_iter().map(|(name, _)| name).collect();
    let mut text = format!(
        include_str!("report.txt"),
        random = random,
        table = survey.points - random,
        exact = Region::ALL.iter().map(|r| survey.errors(*r, Rung::F64).count).sum::<u64>() / 3,
        levels = levels.join(", "),
        adapter = adapter.unwrap_or("none"),
        worst = table(survey, |errors| number(errors.worst)),
        within = table(survey, |errors| errors.shares_within().map(percent).join(" / ")),
        f64_share = share(survey, Rung::F64),
        f32_share = share(survey, Rung::F32),
        fused_share = share(survey, Rung::Fused),
        gpu_share = share(survey, Rung::Gpu),
    );
    text.push_str(&worst_cases(survey));
    text
}

fn share(survey: &Survey, rung: Rung) -> String {
    format!("{:.2}", survey.shares[rung as usize])
}

/// A row for each region, a column for each rung.
fn table(survey: &Survey, value: impl Fn(&Errors) -> String) -> String {
    let mut text = "| region | values | one ulp |".to_owned();
    Rung::ALL.iter().for_each(|rung| text.extend([" ", rung.name(), " |"]));
    text.extend(["\n|---|---|---|", &"---|".repeat(Rung::ALL.len()), "\n"]);
    for region in Region::ALL {
        let one_ulp = survey.one_ulp(region);
        let _ = write!(text, "| {} | {} | {} |", region.description(), one_ulp.count, value(one_ulp));
        for rung in Rung::ALL {
            let errors = survey.errors(region, rung);
            let shown = if errors.count == 0 { "-".to_owned() } else { value(errors) };
            let _ = write!(text, " {shown} |");
        }
        text.push('\n');
    }
    text
}

fn number(x: f64) -> String {
    match x {
        0.0 => "0".to_owned(),
        _ if x.is_infinite() => "inf".to_owned(),
        _ => format!("{x:.1e}"),
    }
}

/// Rounded down, so that 100% means all.
fn percent(share: f64) -> String {
    format!("{}%", (1000.0 * share).floor() / 10.0)
}

/// The worst case of each rung in each region.
fn worst_cases(survey: &Survey) -> String {
    let mut text =
        "| region | rung | convention | r | sin(n, h) | NoL | NoV | l.z | v.z | \\|l + v\\| | one ulp | \
        expected | got |\n"
            .to_owned();
    text.extend(["|", &"---|".repeat(13), "\n"]);
    for region in Region::ALL {
        for rung in [Rung::F64, Rung::F32, Rung::Fused, Rung::Gpu] {
            if let Some(case) = survey.errors(region, rung).worst_case {
                let _ = writeln!(text, "| {} | {} | {}", region.description(), rung.name(), of_case(&case));
            }
        }
    }
    text
}

fn of_case(case: &Case) -> String {
    let p = &case.place;
    let level = if case.level.is_empty() { String::new() } else { format!(", {}", case.level) };
    let lengths = [p.rough, p.sine, p.n_dot_l, p.n_dot_v, p.l_z, p.v_z, p.sum].map(|x| format!("{x:.2e}"));
    format!(
        "{}{level} | {} | {} | {:.9e} | {:.9e} |",
        case.convention,
        lengths.join(" | "),
        number(case.one_ulp),
        case.want,
        case.got,
    )
}
