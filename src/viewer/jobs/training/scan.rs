//! Scan of folders for the steps of training runs.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::time::{Duration, SystemTime};

use svbrdf_files::disk::stamp::Stamp;
use svbrdf_files::steps::{TrainingRun, TrainingStep, runs_in};

use crate::jobs::reading::watch::{INTERVAL, QUIET};
use crate::jobs::work::job::Job;
use crate::jobs::work::waker::Waker;

/// The training runs in some folders. Folders are listed once, or again and again where they are watched.
#[derive(Debug, Default)]
pub struct RunScan {
    scanner: Option<Scanner>,
    folders: Vec<PathBuf>,
    watch: bool,
    known: HashMap<PathBuf, Vec<TrainingRun>>,
}

/// A folder in which other runs or steps are than before.
#[derive(Debug)]
pub struct RunNews {
    pub folder: PathBuf,
    /// `None` where it had not been looked at.
    pub before: Option<Vec<TrainingRun>>,
}

impl RunScan {
    /// Looks into these folders, and returns where something is new since the last call.
    pub fn follow(&mut self, waker: &Waker, folders: Vec<PathBuf>, watch: bool) -> Vec<RunNews> {
        if folders.is_empty() {
            *self = Self::default();
            return Vec::new();
        }
        if self.scanner.is_none() || self.folders != folders || self.watch != watch {
            self.known.retain(|folder, _| folders.contains(folder));
            let settling = Settling::of(self.known.values().flatten());
            self.scanner = Some(Scanner::start(waker, folders.clone(), watch, INTERVAL, settling));
            (self.folders, self.watch) = (folders, watch);
        }
        let found: Vec<_> = self.scanner.iter().flat_map(|scanner| scanner.job.updates()).collect();
        let mut news = Vec::new();
        for (folder, runs) in found {
            if self.known.get(&folder) != Some(&runs) {
                let before = self.known.insert(folder.clone(), runs);
                news.push(RunNews { folder, before });
            }
        }
        news
    }

    /// Looks into all folders again.
    pub fn again(&mut self) {
        self.scanner = None;
    }

    /// The runs in a folder; none before it has been looked at.
    pub fn runs(&self, folder: &Path) -> &[TrainingRun] {
        self.known.get(folder).map_or(&[], Vec::as_slice)
    }
}

/// The thread that looks; it ends when this is dropped, or once there is nothing left to wait for.
#[derive(Debug)]
struct Scanner {
    job: Job<(), (PathBuf, Vec<TrainingRun>)>,
    _running: Sender<()>,
}

impl Scanner {
    fn start(
        waker: &Waker,
        folders: Vec<PathBuf>,
        watch: bool,
        interval: Duration,
        mut settling: Settling,
    ) -> Self {
        let (running, stopped) = mpsc::channel();
        let job = Job::watch(waker, move |worker| {
            let mut sent: HashMap<PathBuf, Vec<TrainingRun>> = HashMap::new();
            loop {
                let mut all_settled = true;
                for folder in &folders {
                    // The steps of a folder that cannot be listed now stay in the window.
                    let Ok(runs) = runs_in(folder) else { continue };
                    let (runs, settled) = settling.settled(runs, SystemTime::now());
                    all_settled &= settled;
                    // Steps that are all being written are nothing new yet.
                    let is_known = sent.get(folder).map_or(runs.is_empty(), |sent| *sent == runs);
                    if is_known {
                        continue;
                    }
                    sent.insert(folder.clone(), runs.clone());
                    worker.report((folder.clone(), runs))?;
                }
                let is_over = !watch && all_settled;
                if is_over || stopped.recv_timeout(interval) != Err(RecvTimeoutError::Timeout) {
                    return Ok(());
                }
            }
        });
        Self { job, _running: running }
    }
}

/// Which steps nobody writes at the moment.
#[derive(Debug, Default)]
struct Settling(HashMap<PathBuf, KnownStep>);

/// A step as it was when it was looked at.
#[derive(Clone, Copy, Debug)]
struct KnownStep {
    latest: Stamp,
    /// The latest stamp with which it stood still.
    settled: Option<Stamp>,
}

impl Settling {
    /// The steps of `runs` have stood still.
    fn of<'a>(runs: impl Iterator<Item = &'a TrainingRun>) -> Self {
        let known = |step: &TrainingStep| KnownStep { latest: step.stamp, settled: Some(step.stamp) };
        Self(runs.flat_map(|run| &run.steps).map(|step| (step.path.clone(), known(step))).collect())
    }

    /// The runs without the steps that have not stood still yet, and whether these are all. A step stands still that has the same
    /// stamp as in the last call, or was written a while ago; one that is written anew stays as it was.
    fn settled(&mut self, runs: Vec<TrainingRun>, now: SystemTime) -> (Vec<TrainingRun>, bool) {
        let mut all = true;
        let mut settled_step = |mut step: TrainingStep| {
            let before = self.0.get(&step.path).copied();
            let is_recent = step.stamp.is_younger_than(QUIET, now);
            let is_still = before.is_some_and(|before| before.latest == step.stamp) || !is_recent;
            let settled = match step.stamp {
                // A folder without files yet.
                Stamp { files: 0, .. } => None,
                stamp if is_still => Some(stamp),
                _ => before.and_then(|before| before.settled),
            };
            all &= is_still;
            self.0.insert(step.path.clone(), KnownStep { latest: step.stamp, settled });
            step.stamp = settled?;
            Some(step)
        };
        let mut settled_run = |run: TrainingRun| {
            let steps: Vec<_> = run.steps.into_iter().filter_map(&mut settled_step).collect();
            (!steps.is_empty()).then_some(TrainingRun { steps, ..run })
        };
        let runs = runs.into_iter().filter_map(&mut settled_run).collect();
        (runs, all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use svbrdf_files::steps::{Counter, RunId};

    const NOW: SystemTime = SystemTime::UNIX_EPOCH;

    /// A run whose steps have these sizes and were written this many seconds ago.
    fn run(steps: &[(u64, u64, u64)]) -> Vec<TrainingRun> {
        let id = RunId { folder: "x".into(), name: "a".to_owned(), counter: Counter::Step };
        let step = |&(number, bytes, age): &(u64, u64, u64)| TrainingStep {
            number,
            path: format!("x/a_step{number}").into(),
            stamp: Stamp {
                files: usize::from(bytes > 0),
                bytes,
                modified: NOW.checked_sub(Duration::from_secs(age)),
            },
        };
        vec![TrainingRun { id, steps: steps.iter().map(step).collect() }]
    }

    /// The numbers and sizes of the steps that stand still, and whether these are all.
    fn look(settling: &mut Settling, steps: &[(u64, u64, u64)]) -> (Vec<(u64, u64)>, bool) {
        let (runs, all) = settling.settled(run(steps), NOW);
        (runs.iter().flat_map(|run| &run.steps).map(|step| (step.number, step.stamp.bytes)).collect(), all)
    }

    #[test]
    fn steps_are_taken_when_they_stand_still() {
        let mut settling = Settling::default();
        assert_eq!(look(&mut settling, &[(1, 9, 100)]), (vec![(1, 9)], true), "an old one at once");
        assert_eq!(look(&mut settling, &[(1, 9, 100), (2, 5, 0)]), (vec![(1, 9)], false));
        assert_eq!(look(&mut settling, &[(1, 9, 100), (2, 7, 0)]), (vec![(1, 9)], false), "it grows");
        assert_eq!(look(&mut settling, &[(1, 9, 100), (2, 7, 0)]), (vec![(1, 9), (2, 7)], true));
        // It is written anew, and stays as it was until it stands still again.
        assert_eq!(look(&mut settling, &[(2, 3, 1)]), (vec![(2, 7)], false));
        assert_eq!(look(&mut settling, &[(2, 3, 1)]), (vec![(2, 3)], true));
        let two = look(&mut Settling::default(), &[(1, 5, 0), (2, 9, 100)]);
        assert_eq!(two, (vec![(2, 9)], false), "not all, whichever comes last");
        let mut known = Settling::of(run(&[(1, 9, 0)]).iter());
        assert_eq!(look(&mut known, &[(1, 9, 0), (2, 5, 0)]), (vec![(1, 9)], false), "known before");
        assert_eq!(look(&mut settling, &[(3, 0, 0)]).0, [], "an empty folder");
        assert_eq!(look(&mut settling, &[(3, 0, 0)]).0, []);
    }

    #[test]
    fn new_steps_are_found_while_a_folder_is_watched() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str| std::fs::write(folder.path().join(name), "x").unwrap();
        let steps = |runs: &[TrainingRun]| -> Vec<u64> {
            runs.iter().flat_map(|run| &run.steps).map(|step| step.number).collect()
        };
        write("a_step1.png");
        for watch in [true, false] {
            let folders = vec![folder.path().to_owned()];
            let interval = Duration::from_millis(1);
            let scanner = Scanner::start(&Waker::default(), folders, watch, interval, Settling::default());
            let next = || {
                loop {
                    if let [(_, runs)] = &scanner.job.updates()[..] {
                        return steps(runs);
                    }
                    std::thread::yield_now();
                }
            };
            let mut found = Vec::new();
            while found.is_empty() {
                found = next();
            }
            assert_eq!(found, if watch { vec![1] } else { vec![1, 2] });
            if watch {
                write("a_step2.png");
                assert_eq!(next(), [1, 2]);
                std::thread::sleep(Duration::from_millis(50));
                assert!(scanner.job.updates().is_empty(), "nothing is new");
            } else {
                assert!(scanner.job.wait().is_ok(), "it has ended");
            }
        }
    }
}
