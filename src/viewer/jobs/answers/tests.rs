//! The order of answering, and what stays of it.

use super::*;

/// Fails where it is odd, and has no end from 100 on.
#[derive(Clone, Debug, PartialEq)]
struct Double(u32);

impl Question for Double {
    type Answer = u32;
    const KEPT: usize = 2;

    fn is_like(&self, earlier: &Self) -> bool {
        earlier.0 < self.0
    }

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<u32, Error> {
        if self.0 >= 100 {
            loop {
                work.progress().step()?;
                std::thread::yield_now();
            }
        }
        if self.0 % 2 == 1 { Err(Error::internal("planted")) } else { Ok(2 * self.0) }
    }
}

/// A frame that asks for these, and what it finds.
fn frame(answers: &mut Answers, asked: &[u32]) -> (Vec<Answer<u32>>, usize) {
    let errors = answers.begin_frame().len();
    let found = asked.iter().map(|number| answers.get(&Double(*number))).collect();
    answers.end_frame();
    (found, errors)
}

/// Frames until none of these waits; the errors that were told.
fn settle(answers: &mut Answers, asked: &[u32]) -> usize {
    let mut errors = 0;
    loop {
        let (found, told) = frame(answers, asked);
        errors += told;
        if found.iter().all(|one| one.busy().is_none()) {
            return errors;
        }
        std::thread::yield_now();
    }
}

fn known(answers: &Answers, number: u32) -> Option<u32> {
    answers.known(&Double(number)).map(|answered| **answered)
}

#[test]
fn what_fails_is_told_once_and_keeps_no_other_waiting() {
    let mut answers = Answers::default();
    assert_eq!(settle(&mut answers, &[1, 2, 4]), 1);
    assert_eq!([1, 2, 4].map(|number| known(&answers, number)), [None, Some(4), Some(8)]);
    assert_eq!(settle(&mut answers, &[1, 2]), 0, "it is not tried again");
    frame(&mut answers, &[2]);
    assert_eq!(settle(&mut answers, &[1]), 1, "it is, once it was not asked for");
}

#[test]
fn the_first_in_a_frame_is_answered_first_and_what_nobody_asks_for_is_cancelled() {
    let mut answers = Answers::default();
    frame(&mut answers, &[100, 2]);
    std::thread::sleep(Duration::from_millis(20));
    assert!(known(&answers, 2).is_none(), "it waits for the first");
    // Another order on the screen stops what is running.
    settle_one(&mut answers, &[2, 100], 2);
    // Out of sight, the endless one ends; what is asked for then has the processors.
    assert_eq!(settle(&mut answers, &[4]), 0);
}

fn settle_one(answers: &mut Answers, asked: &[u32], number: u32) {
    while known(answers, number).is_none() {
        frame(answers, asked);
        std::thread::yield_now();
    }
}

/// What depends on an answer is before what stands behind it, whenever that answer comes.
#[test]
fn nothing_starts_between_an_answer_and_the_question_that_it_leads_to() {
    for pause in (0..40).chain([20_000]) {
        let mut answers = Answers::default();
        loop {
            answers.begin_frame();
            let first = answers.get(&Double(2)).ready();
            // Long enough for the first to end within the frame, or not.
            std::thread::sleep(Duration::from_micros(5 * pause));
            let again = answers.get(&Double(2)).ready();
            assert_eq!(first.is_some(), again.is_some(), "one state a frame");
            let second = first.and_then(|first| answers.get(&Double(**first)).ready());
            answers.get(&Moving(1));
            answers.get(&Double(100));
            answers.end_frame();
            if second.is_some() {
                break;
            }
            assert!(
                !answers
                    .asked
                    .borrow_mut()
                    .entry(&Double(100))
                    .is_some_and(|one| one.phase() == Phase::Running)
            );
        }
    }
}

#[test]
fn what_is_stopped_by_hand_leaves_the_processors_and_goes_on_by_hand() {
    let mut answers = Answers::default();
    let is_stopped = |answers: &mut Answers| matches!(frame(answers, &[100]).0[..], [Answer::Stopped(None)]);
    frame(&mut answers, &[100]);
    assert!(!is_stopped(&mut answers));
    answers.stop::<Double>();
    settle_one(&mut answers, &[100, 4], 4);
    assert!(is_stopped(&mut answers), "it is not begun again by itself");
    answers.resume::<Double>();
    assert!(!is_stopped(&mut answers) && answers.is_running::<Double>());
}

#[test]
fn answers_out_of_sight_stay_as_many_as_their_kind_keeps_the_latest_first() {
    let mut answers = Answers::default();
    for number in [2, 4, 6, 8] {
        settle(&mut answers, &[number]);
    }
    frame(&mut answers, &[8]);
    assert_eq!([2, 4, 6, 8].map(|number| known(&answers, number)), [None, Some(8), Some(12), Some(16)]);
    assert_eq!(answers.latest(&Double(8)).map(|answered| **answered), Some(12), "it is like those below it");
}

#[test]
fn an_answer_that_is_drawn_in_the_place_of_another_stays() {
    let mut answers = Answers::default();
    settle(&mut answers, &[2]);
    for number in [4, 6, 8, 10] {
        let is_drawn = |answers: &mut Answers| {
            answers.begin_frame();
            let (own, earlier) = (answers.get(&Double(number)).ready(), answers.latest(&Double(3)));
            answers.end_frame();
            assert_eq!(earlier.map(|answered| **answered), Some(4), "{number}");
            own.is_some()
        };
        while !is_drawn(&mut answers) {
            std::thread::yield_now();
        }
    }
    assert!(known(&answers, 4).is_none(), "others do not");
}

/// One that has no end, and tells when it is cancelled.
#[derive(Clone, Debug)]
struct Endless(std::sync::mpsc::Sender<()>);

impl PartialEq for Endless {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Question for Endless {
    type Answer = u32;
    const PACE: Pace = Pace::Beside;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<u32, Error> {
        work.tell(1);
        while work.progress().step().is_ok() {
            std::thread::yield_now();
        }
        let _ = self.0.send(());
        Err(Error::internal("cancelled"))
    }
}

#[test]
fn what_goes_on_beside_the_others_tells_on_the_way_and_ends_where_it_is_not_asked_for() {
    let mut answers = Answers::default();
    let (sender, ends) = std::sync::mpsc::channel();
    loop {
        answers.begin_frame();
        let told = answers.drawn(&Endless(sender.clone()));
        let found = answers.get(&Double(2)).ready();
        answers.end_frame();
        if let (Some((told, true)), Some(found)) = (told, found) {
            assert_eq!((**told, **found), (1, 4));
            break;
        }
        std::thread::yield_now();
    }
    assert!(ends.try_recv().is_err());
    frame(&mut answers, &[2]);
    ends.recv().unwrap();
}

/// A short one.
#[derive(Clone, Debug, PartialEq)]
struct Moving(u32);

impl Question for Moving {
    type Answer = u32;
    const PACE: Pace = Pace::AtOnce;
    const KEPT: usize = 1;

    fn is_like(&self, _: &Self) -> bool {
        true
    }

    fn answer(&self, _: &Work<'_, Self::Answer>) -> Result<u32, Error> {
        Ok(self.0)
    }
}

#[test]
fn an_answer_that_moves_stays_while_another_one_of_its_kind_is_asked_for_and_no_longer() {
    let mut answers = Answers::default();
    while answers.get(&Moving(1)).ready().is_none() {
        answers.end_frame();
        std::thread::yield_now();
        answers.begin_frame();
    }
    answers.end_frame();
    answers.get(&Moving(2));
    answers.end_frame();
    assert!(answers.latest(&Moving(2)).is_some(), "it is drawn until the next one is there");
    for _ in 0..2 {
        answers.get(&Double(100));
        answers.end_frame();
    }
    assert!(answers.known(&Moving(1)).is_none(), "out of sight");
}
