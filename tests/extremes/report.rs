//! docs/extremes.md: the table of a survey with its explanation. docs/extremes.csv: shares and worst cases.

use std::fmt::Write as _;

use super::regions::Region;
use super::rungs::{self, Rung};
use super::survey::{Case, Survey};

/// The document. `random` is the number of random points among the points of the survey.
pub fn markdown(survey: &Survey, random: u64, adapter: Option<&str>) -> String {
    let levels: Vec<_> = rungs::levels().into_iter().map(|(name, _)| name).collect();
    format!(
        include_str!("report.txt"),
        random = random,
        table = survey.points - random,
        exact = Region::ALL.iter().map(|r| survey.errors(*r, Rung::F64).count).sum::<u64>() / 3,
        levels = levels.join(", "),
        adapter = adapter.unwrap_or("none"),
        worst = worst_errors(survey),
        f64_share = share(survey, Rung::F64),
        f32_share = share(survey, Rung::F32),
        fused_share = share(survey, Rung::Fused),
        gpu_share = share(survey, Rung::Gpu),
    )
}

fn share(survey: &Survey, rung: Rung) -> String {
    format!("{:.2}", survey.shares[rung as usize])
}

/// A row for each region, a column for each rung.
fn worst_errors(survey: &Survey) -> String {
    let mut text = "| region | values | one ulp |".to_owned();
    Rung::ALL.iter().for_each(|rung| text.extend([" ", rung.name(), " |"]));
    text.extend(["\n|---|---|---|", &"---|".repeat(Rung::ALL.len()), "\n"]);
    for region in Region::ALL {
        let one_ulp = survey.one_ulp(region);
        let _ = write!(text, "| {} | {} | {} |", region.description(), one_ulp.count, number(one_ulp.worst));
        for rung in Rung::ALL {
            let errors = survey.errors(region, rung);
            let shown = if errors.count == 0 { "-".to_owned() } else { number(errors.worst) };
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

/// A row for each rung in each region: the worst error, the shares within two bounds, and the worst case.
pub fn csv(survey: &Survey) -> String {
    let mut text =
        "region,rung,values,worst,within 1e-6,within 1e-3,convention,level,r,\"sin(n, h)\",NoL,NoV,l.z,v.z,\
        |l + v|,one ulp,expected,got\n"
            .to_owned();
    for region in Region::ALL {
        let one_ulp = survey.one_ulp(region);
        let rungs = Rung::ALL.iter().map(|rung| (rung.name(), survey.errors(region, *rung)));
        for (name, errors) in std::iter::once(("one ulp", one_ulp)).chain(rungs) {
            if errors.count > 0 {
                let shares = errors.shares_within().map(percent).join(",");
                let case = errors.worst_case.as_ref().map_or_else(|| ",".repeat(11), of_case);
                let (values, worst) = (one_ulp.count, number(errors.worst));
                let _ =
                    writeln!(text, "\"{}\",{name},{values},{worst},{shares},{case}", region.description());
            }
        }
    }
    text
}

fn of_case(case: &Case) -> String {
    let p = &case.place;
    let lengths = [p.rough, p.sine, p.n_dot_l, p.n_dot_v, p.l_z, p.v_z, p.sum].map(|x| format!("{x:.2e}"));
    format!(
        "{},{},{},{},{:.9e},{:.9e}",
        case.convention,
        case.level,
        lengths.join(","),
        number(case.one_ulp),
        case.want,
        case.got,
    )
}
