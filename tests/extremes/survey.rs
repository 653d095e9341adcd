//! The comparator: the errors of every rung in every region, checked against their bounds.

use rayon::prelude::*;

use super::cases::Batch;
use super::regions::{Place, Region, Truth};
use super::rungs::{self, Rgb, Rung};
use crate::support::tolerance::EXTREMES;

/// Limits of the relative error: errors within each of them are counted.
pub const WITHIN: [f64; 2] = [1e-6, 1e-3];

/// The relative errors of many cases.
#[derive(Clone, Default)]
pub struct Errors {
    pub count: u64,
    pub worst: f64,
    pub worst_case: Option<Case>,
    /// The number of errors within each of [`WITHIN`].
    within: [u64; 2],
}

/// One channel of one texel, as a rung computed it.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    pub convention: &'static str,
    /// The instruction set of the fused kernel.
    pub level: &'static str,
    pub place: Place,
    pub one_ulp: f64,
    pub got: f64,
    pub want: f64,
}

impl Errors {
    fn add(&mut self, error: f64, case: impl FnOnce() -> Option<Case>) {
        self.count += 1;
        for (within, limit) in self.within.iter_mut().zip(WITHIN) {
            *within += u64::from(error <= limit);
        }
        if error > self.worst {
            (self.worst, self.worst_case) = (error, case());
        }
    }

    fn merge(&mut self, other: &Self) {
        self.count += other.count;
        self.within.iter_mut().zip(other.within).for_each(|(a, b)| *a += b);
        if other.worst > self.worst {
            (self.worst, self.worst_case) = (other.worst, other.worst_case);
        }
    }

    /// The share of the errors within each of [`WITHIN`], from 0 to 1.
    pub fn shares_within(&self) -> [f64; 2] {
        self.within.map(|within| within as f64 / self.count as f64)
    }
}

/// The errors of all rungs over a set of cases.
#[derive(Clone)]
pub struct Survey {
    /// Indexed by region, then by rung.
    errors: Vec<Vec<Errors>>,
    /// Per region, the relative change of R by one ulp of the input.
    one_ulp: Vec<Errors>,
    /// Per rung, the largest error as a share of its bound.
    pub shares: Vec<f64>,
    /// A few cases outside their bounds.
    faults: Vec<(Rung, String)>,
    pub points: u64,
}

impl Survey {
    const FAULTS_PER_RUNG: usize = 3;

    pub fn new() -> Self {
        Self {
            errors: vec![vec![Errors::default(); Rung::ALL.len()]; Region::ALL.len()],
            one_ulp: vec![Errors::default(); Region::ALL.len()],
            shares: vec![0.0; Rung::ALL.len()],
            faults: Vec::new(),
            points: 0,
        }
    }

    pub fn errors(&self, region: Region, rung: Rung) -> &Errors {
        &self.errors[region.index()][rung as usize]
    }

    pub fn one_ulp(&self, region: Region) -> &Errors {
        &self.one_ulp[region.index()]
    }

    pub fn merge(mut self, other: Self) -> Self {
        for (mine, theirs) in self.errors.iter_mut().flatten().zip(other.errors.iter().flatten()) {
            mine.merge(theirs);
        }
        self.one_ulp.iter_mut().zip(&other.one_ulp).for_each(|(a, b)| a.merge(b));
        self.shares.iter_mut().zip(other.shares).for_each(|(a, b)| *a = a.max(b));
        for (rung, fault) in other.faults {
            if self.room_for(rung) {
                self.faults.push((rung, fault));
            }
        }
        self.points += other.points;
        self
    }

    /// Every rung over `batches`; 256 bits over every `exact_every`-th of them.
    pub fn of(batches: &[Batch], exact_every: usize) -> Self {
        let on_gpu = rungs::on_gpu(batches);
        let surveyed = batches.par_iter().enumerate().map(|(i, batch)| {
            let (mut survey, truth) = (Self::new(), Truth::of(batch));
            survey.count(&truth);
            if i.is_multiple_of(exact_every) {
                survey.hold(Rung::F64, "256 bits", batch, &truth, &rungs::with_256_bits(batch));
            }
            survey.hold(Rung::F32, "", batch, &truth, &rungs::in_f32(batch));
            for (name, level) in rungs::levels() {
                if let Some(got) = rungs::fused(level, batch) {
                    survey.hold(Rung::Fused, name, batch, &truth, &got);
                }
            }
            if let Some(on_gpu) = &on_gpu {
                survey.hold(Rung::Gpu, "", batch, &truth, &on_gpu[i]);
            }
            for (rung, got) in
                [(Rung::Cancelling, rungs::cancelling(batch)), (Rung::Clamps, rungs::clamped(batch))]
            {
                if let Some(got) = got {
                    survey.note(rung, &truth, &got);
                }
            }
            survey
        });
        surveyed.reduce(Self::new, Self::merge)
    }

    fn room_for(&self, rung: Rung) -> bool {
        self.faults.iter().filter(|(r, _)| *r == rung).count() < Self::FAULTS_PER_RUNG
    }

    /// # Errors
    /// A few cases of each rung outside their bounds.
    pub fn verdict(&self) -> Result<(), String> {
        let faults: Vec<_> = self.faults.iter().map(|(_, fault)| fault.as_str()).collect();
        if faults.is_empty() { Ok(()) } else { Err(faults.join("\n")) }
    }

    fn count(&mut self, truth: &[Truth]) {
        self.points += truth.len() as u64;
        for truth in truth {
            for (region, one_ulp) in truth.region.iter().zip(truth.one_ulp) {
                self.one_ulp[region.index()].add(one_ulp, || None);
            }
        }
    }

    /// Records errors that have no bound.
    fn note(&mut self, rung: Rung, truth: &[Truth], got: &[Rgb]) {
        for (truth, got) in truth.iter().zip(got) {
            for (c, &got) in got.iter().enumerate() {
                let error = error_of_any(got, truth.expected[c]);
                self.errors[truth.region[c].index()][rung as usize].add(error, || None);
            }
        }
    }

    /// Checks a rung against the bound of each point and the bound of its region.
    ///
    /// For `Rung::F64`, `other` holds the results in 256 bits; otherwise the results of the rung at the instruction set
    /// `level`.
    pub fn hold(&mut self, rung: Rung, level: &'static str, batch: &Batch, truth: &[Truth], other: &[Rgb]) {
        assert_eq!(truth.len(), other.len(), "one result per case");
        for (i, (truth, other)) in truth.iter().zip(other).enumerate() {
            for (c, &other) in other.iter().enumerate() {
                let expected = truth.expected[c];
                let (got, want, bound) = match rung {
                    Rung::F64 => (expected, other, truth.f64_bound[c]),
                    Rung::Fused => (other, expected, truth.fused_bound[c]),
                    _ => (other, expected, truth.bound[c]),
                };
                let (convention, one_ulp) = (batch.convention.name, truth.one_ulp[c]);
                let case = Case { convention, level, place: truth.place, one_ulp, got, want };
                if let Err(problem) = self.hold_value(rung, truth.region[c], case, bound)
                    && self.room_for(rung)
                {
                    let (texel, near) = (batch.material.texel(i), batch.near);
                    let (l, v) = (batch.w_l, batch.w_v);
                    let place = format!("channel {c} of {texel:?}, w_l {l:?}, w_v {v:?}, near {near}");
                    self.faults.push((rung, format!("{problem}; {place}")));
                }
            }
        }
    }

    fn hold_value(&mut self, rung: Rung, region: Region, case: Case, bound: f64) -> Result<(), String> {
        let Case { convention, level, one_ulp, got, want, .. } = case;
        let (off, error) = ((got - want).abs(), relative(got, want));
        self.errors[region.index()][rung as usize].add(error, || Some(case));
        if got != want {
            self.shares[rung as usize] = self.shares[rung as usize].max(off / bound);
        }
        let limit = EXTREMES[region.index()][rung as usize];
        let within = off <= bound && error <= limit;
        if is_radiance(got) && is_radiance(want) && within {
            return Ok(());
        }
        Err(format!(
            "{} {level}, {convention}, {}: got {got:e}, expected {want:e}, off by {off:e}, at most {bound:e}, relative \
            {error:e}, at most {limit:e}; one ulp changes it by {one_ulp:e}",
            rung.name(),
            region.description(),
        ))
    }
}

fn is_radiance(x: f64) -> bool {
    x.is_finite() && x >= 0.0
}

/// The relative error; infinite where `got` is not a radiance.
pub fn error_of_any(got: f64, want: f64) -> f64 {
    if is_radiance(got) { relative(got, want) } else { f64::INFINITY }
}

/// |got - want| / want; 0 where both are 0.
fn relative(got: f64, want: f64) -> f64 {
    if got == want { 0.0 } else { (got - want).abs() / want }
}
