//! Measures several programs that do the same work. The programs run in turn.

use std::hint::black_box;
use std::time::{Duration, Instant};

/// A program to measure. The program returns the time for a number of repetitions.
pub struct Contestant<'a> {
    pub name: String,
    run: Box<dyn FnMut(u32) -> Result<Duration, String> + 'a>,
}

/// Times that a program needs for one repetition. The times are calculated from the mean of each round.
#[derive(Clone, Debug)]
pub struct Sample {
    pub least: Duration,
    pub median: Duration,
    pub rounds: usize,
}

/// Maximum number of rounds. The time limit can end the measurement earlier.
const ROUNDS: usize = 15;

/// Minimum number of rounds.
const FEWEST: usize = 3;

/// Time limit for a program with one input. The minimum number of rounds is run even if the rounds take longer.
const PATIENCE: Duration = Duration::from_secs(4);

/// Target duration of a round. Work that takes less time is repeated within a round, but at most 1,000 times.
const ROUND: Duration = Duration::from_millis(10);

impl<'a> Contestant<'a> {
    /// Creates a program to measure. For each call of `run`, the program calls `input` to create an input. Creating the
    /// input and dropping the result are not measured.
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

    /// Creates a program that measures its own time.
    pub fn with_clock(name: impl Into<String>, run: impl FnMut(u32) -> Result<Duration, String> + 'a) -> Self {
        Contestant { name: name.into(), run: Box::new(run) }
    }
}

/// Rounds that were measured so far for one program.
struct Progress {
    repetitions: u32,
    times: Vec<Duration>,
    spent: Duration,
}

/// Runs the programs in turn, so that other load on the machine affects all of them equally.
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

/// Runs a program twice without counting the results. The first run does one-time work such as reading the profiles. The second
/// run determines the number of repetitions per round.
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
