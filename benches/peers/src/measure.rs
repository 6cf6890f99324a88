//! Times of several programs for the same work, in turns.

use std::hint::black_box;
use std::time::{Duration, Instant};

/// One of those that are compared: how long so many repetitions take it.
pub struct Contestant<'a> {
    pub name: String,
    run: Box<dyn FnMut(u32) -> Result<Duration, String> + 'a>,
}

/// Times of a run: means of rounds.
#[derive(Clone, Debug)]
pub struct Sample {
    pub least: Duration,
    pub median: Duration,
    pub rounds: usize,
}

/// Rounds where there is time for them.
const ROUNDS: usize = 15;

/// Rounds of what takes long.
const FEWEST: usize = 3;

/// What a contestant may take for one input altogether, if it has had its fewest rounds.
const PATIENCE: Duration = Duration::from_secs(4);

/// So long a round takes at least, as far as repetitions help.
const ROUND: Duration = Duration::from_millis(10);

impl<'a> Contestant<'a> {
    /// `run` gets fresh input from `input`; making that isn't counted, nor is dropping what `run` made.
    pub fn new<I, T>(
        name: impl Into<String>,
        mut input: impl FnMut() -> I + 'a,
        mut run: impl FnMut(I) -> Result<T, String> + 'a,
    ) -> Self {
        let run = move |repetitions: u32| {
            let mut total = Duration::ZERO;
            for _ in 0..repetitions {
                let input = input();
                let start = Instant::now();
                let made = black_box(run(input)?);
                total += start.elapsed();
                drop(made);
            }
            Ok(total)
        };
        Contestant { name: name.into(), run: Box::new(run) }
    }

    /// One that takes its own time.
    pub fn with_clock(name: impl Into<String>, run: impl FnMut(u32) -> Result<Duration, String> + 'a) -> Self {
        Contestant { name: name.into(), run: Box::new(run) }
    }
}

/// What one contestant did so far.
struct Progress {
    repetitions: u32,
    times: Vec<Duration>,
    spent: Duration,
}

/// Lets them run in turns, so that all have the same luck with what else the machine does.
pub fn in_turns(contestants: &mut [Contestant<'_>]) -> Vec<Result<Sample, String>> {
    let mut progress: Vec<_> = contestants.iter_mut().map(first_run).collect();
    for round in 0..ROUNDS {
        for (contestant, progress) in contestants.iter_mut().zip(&mut progress) {
            let Ok(state) = progress else { continue };
            if round >= FEWEST && state.spent > PATIENCE {
                continue;
            }
            match (contestant.run)(state.repetitions) {
                Ok(time) => {
                    state.spent += time;
                    state.times.push(time / state.repetitions);
                }
                Err(error) => *progress = Err(error),
            }
        }
    }
    progress.into_iter().map(|progress| progress.map(|progress| sample(progress.times))).collect()
}

/// A run that isn't counted tells how many a round needs. One before it does what is done once in a program, such as reading profiles.
fn first_run(contestant: &mut Contestant<'_>) -> Result<Progress, String> {
    (contestant.run)(1)?;
    let time = (contestant.run)(1)?.max(Duration::from_nanos(100));
    let repetitions = (ROUND.as_nanos() / time.as_nanos()).clamp(1, 1_000) as u32;
    Ok(Progress { repetitions, times: Vec::new(), spent: Duration::ZERO })
}

fn sample(mut times: Vec<Duration>) -> Sample {
    times.sort_unstable();
    Sample { least: times[0], median: times[times.len() / 2], rounds: times.len() }
}
