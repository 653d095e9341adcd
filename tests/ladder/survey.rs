//! The comparator of points: the worst errors of every rung in every region, checked against their bounds.

use rayon::prelude::*;

use super::cases::Batch;
use super::rungs::{self, Rgb, Rung};
use super::truth::{Region, Truth};
use crate::support::tolerance::EXTREMES;

/// The errors of all rungs over a set of cases.
#[derive(Clone)]
pub struct Survey {
    /// Number and worst relative error of the values, by region, then by rung.
    errors: [[(u64, f64); Rung::ALL.len()]; Region::ALL.len()],
    /// By region, the largest relative change of R by one ulp of the input.
    pub one_ulp: [f64; Region::ALL.len()],
    /// By rung, the largest error as a share of its bound.
    pub shares: [f64; Rung::ALL.len()],
    /// A few cases outside their bounds.
    faults: Vec<(Rung, String)>,
    pub points: u64,
}

impl Survey {
    const FAULTS_PER_RUNG: usize = 3;

    pub fn new() -> Self {
        Self {
            errors: [[(0, 0.0); Rung::ALL.len()]; Region::ALL.len()],
            one_ulp: [0.0; Region::ALL.len()],
            shares: [0.0; Rung::ALL.len()],
            faults: Vec::new(),
            points: 0,
        }
    }

    /// The number of values of a rung in a region, and the worst relative error.
    pub fn errors(&self, region: Region, rung: Rung) -> (u64, f64) {
        self.errors[region as usize][rung as usize]
    }

    pub fn merge(mut self, other: Self) -> Self {
        for (mine, theirs) in self.errors.as_flattened_mut().iter_mut().zip(other.errors.as_flattened()) {
            *mine = (mine.0 + theirs.0, mine.1.max(theirs.1));
        }
        self.one_ulp.iter_mut().zip(other.one_ulp).for_each(|(a, b)| *a = a.max(b));
        self.shares.iter_mut().zip(other.shares).for_each(|(a, b)| *a = a.max(b));
        other.faults.into_iter().for_each(|(rung, fault)| self.fault(rung, || fault));
        self.points += other.points;
        self
    }

    /// Every rung over `batches`; 256 bits over every `exact_every`-th of them.
    pub fn of(batches: &[Batch], exact_every: usize) -> Self {
        let on_gpu = rungs::on_gpu(batches);
        let surveyed = batches.par_iter().enumerate().map(|(i, batch)| {
            let (mut survey, truth) = (Self::new(), Truth::of(batch));
            survey.points = truth.len() as u64;
            for (c, truth) in (0..3).flat_map(|c| truth.iter().map(move |truth| (c, truth))) {
                let one_ulp = &mut survey.one_ulp[truth.region[c] as usize];
                *one_ulp = one_ulp.max(truth.one_ulp[c]);
            }
            if i.is_multiple_of(exact_every) {
                survey.hold(Rung::F64, "256 bits", batch, &truth, &rungs::with_256_bits(batch));
            }
            survey.hold(Rung::F32, "", batch, &truth, &rungs::in_f32(batch));
            for (name, level) in rungs::levels() {
                if let Some(got) = rungs::simd(level, batch) {
                    survey.hold(Rung::Simd, name, batch, &truth, &got);
                }
            }
            if let Some(on_gpu) = &on_gpu {
                survey.hold(Rung::Wgsl, "", batch, &truth, &on_gpu[i]);
            }
            survey
        });
        surveyed.reduce(Self::new, Self::merge)
    }

    fn fault(&mut self, rung: Rung, problem: impl FnOnce() -> String) {
        if self.faults.iter().filter(|(r, _)| *r == rung).count() < Self::FAULTS_PER_RUNG {
            self.faults.push((rung, problem()));
        }
    }

    /// # Errors
    /// A few cases of each rung outside their bounds.
    pub fn verdict(&self) -> Result<(), String> {
        let faults: Vec<_> = self.faults.iter().map(|(_, fault)| fault.as_str()).collect();
        if faults.is_empty() { Ok(()) } else { Err(faults.join("\n")) }
    }

    /// Checks a rung against the bound of each point and the bound of its region.
    ///
    /// For `Rung::F64`, `other` holds the results in 256 bits; otherwise the results of the rung at the instruction set `level`.
    pub fn hold(&mut self, rung: Rung, level: &str, batch: &Batch, truth: &[Truth], other: &[Rgb]) {
        assert_eq!(truth.len(), other.len(), "one result per case");
        for (i, (truth, other)) in truth.iter().zip(other).enumerate() {
            for c in 0..3 {
                let (expected, other, region) = (truth.expected[c], other[c], truth.region[c]);
                let (got, want, bound) = match rung {
                    Rung::F64 => (expected, other, truth.f64_bound[c]),
                    Rung::Simd => (other, expected, truth.simd_bound[c]),
                    _ => (other, expected, truth.bound[c]),
                };
                let off = (got - want).abs();
                let error = if got == want { 0.0 } else { off / want };
                let (count, worst) = &mut self.errors[region as usize][rung as usize];
                (*count, *worst) = (*count + 1, worst.max(error));
                if got != want {
                    self.shares[rung as usize] = self.shares[rung as usize].max(off / bound);
                }
                let limit = EXTREMES[region as usize][rung as usize];
                let is_radiance = [got, want].iter().all(|x| x.is_finite() && *x >= 0.0);
                if is_radiance && off <= bound && error <= limit {
                    continue;
                }
                self.fault(rung, || {
                    format!(
                        "{rung:?} {level}, {}, {region:?}, channel {c} of {:?}, w_l {:?}, w_v {:?}: got {got:e}, expected {want:e}, off \
                        by {off:e}, at most {bound:e}, relative {error:e}, at most {limit:e}; one ulp changes it by {:e}",
                        batch.convention.name,
                        batch.material.texel(i),
                        batch.w_l,
                        batch.w_v,
                        truth.one_ulp[c],
                    )
                });
            }
        }
    }
}
