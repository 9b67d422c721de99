//! Every combination of the models in flight: all outputs are finite or there is one clear error,
//! and the same flight gives the same bits again.
//!
//! The enumerations, their values and the switches are read from the table of variables, so that
//! new models are covered, too. There are two series of runs:
//!
//! * Every combination of the choices that shape the solution, once. The flight and the other
//!   choices come from a sequence that spreads evenly, so that each pair of values occurs hundreds
//!   of times.
//! * Every flight with each inflow model, with and without flapping.

use crate::support::block::{default_block, get, set, set_boolean, set_integer, set_string};
use helicopter_rotor::block::{
    BlockError, Note, RotorBlock, SetupError,
    variables::{BooleanRef, IntegerRef, REALS, boolean, integer, real, string},
};
use std::{
    f64::consts::PI,
    panic::{AssertUnwindSafe, catch_unwind},
    sync::atomic::{AtomicUsize, Ordering},
    thread,
};

const THREADS: usize = 2;
const ELEMENTS: i32 = 4;
/// Largest azimuth step, rad.
const LONGEST_AZIMUTH_STEP: f64 = real::NUMERICS__AZIMUTH_STEP.variable().max;
/// Communication step, s.
const STEP: f64 = 0.02;
const RPM: f64 = 960.0;

/// Edgewise speeds over the tip speed at `RPM`.
const ADVANCE: [f64; 5] = [0.0, 0.05, 0.15, 0.3, 0.5];
/// Climb speeds over the induced velocity in hover.
const CLIMB: [f64; 7] = [-3.0, -1.8, -1.0, -0.5, 0.0, 1.0, 3.0];
const COLLECTIVE_DEGREES: [f64; 4] = [-20.0, 0.0, 10.0, 40.0];
/// Rotor speeds over `RPM`.
const TURNING: [f64; 4] = [0.0, 0.5, 1.0, 1.5];
/// Heights of the hub above the ground over R.
const HEIGHT: [f64; 5] = [0.0, 0.4, 1.0, 2.5, 5.0];
/// Torques, N.m, if a torque drives the rotor.
const TORQUE: [f64; 3] = [-5.0, 0.0, 10.0];
/// Few, because the time for the steady start of flapping blades grows with the square of their
/// number.
const BLADES: [i32; 3] = [1, 2, 3];
/// The number of values of each, with the collective and the rotor speed of the second step.
const LEVELS: [usize; 9] = [
    ADVANCE.len(),
    CLIMB.len(),
    COLLECTIVE_DEGREES.len(),
    TURNING.len(),
    COLLECTIVE_DEGREES.len(),
    TURNING.len(),
    BLADES.len(),
    HEIGHT.len(),
    TORQUE.len(),
];

/// The choices that shape the solution. Choices of section data or frames are not among them.
const STRUCTURE: [&str; 8] = [
    "models.inflow",
    "models.blades",
    "flapping.enabled",
    "models.tipLoss",
    "models.descent",
    "models.groundEffect",
    "drive.mode",
    "initialization",
];

/// Largest accepted share of runs that start without a steady or periodic state, %: blades thrown
/// against their stops, at large pitch and half of the rotor speed, may have none.
const MAX_WITHOUT_STEADY_STATE: f64 = 2.5;
/// Largest accepted share of runs without a solution, %.
const MAX_WITHOUT_SOLUTION: f64 = 0.1;

/// A parameter with a few values.
#[derive(Debug, Clone, Copy)]
enum Choice {
    Enumeration(IntegerRef),
    Switch(BooleanRef),
}

impl Choice {
    fn all() -> Vec<Self> {
        let enumerations = IntegerRef::all().filter(|reference| {
            let variable = reference.variable();
            !variable.choices.is_empty() && !variable.causality.is_computed()
        });
        enumerations
            .map(Self::Enumeration)
            .chain(BooleanRef::all().map(Self::Switch))
            .collect()
    }

    fn count(self) -> usize {
        match self {
            Self::Enumeration(reference) => reference.variable().choices.len(),
            Self::Switch(_) => 2,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Enumeration(reference) => reference.variable().name,
            Self::Switch(reference) => reference.variable().name,
        }
    }

    /// The name of a value, which counts from 0.
    fn value_name(self, value: usize) -> String {
        match self {
            Self::Enumeration(reference) => reference.variable().choices[value].to_owned(),
            Self::Switch(_) => (value == 1).to_string(),
        }
    }

    /// The default value.
    fn default(self) -> usize {
        match self {
            Self::Enumeration(reference) => reference.variable().start as usize - 1,
            Self::Switch(reference) => reference.variable().start as usize,
        }
    }

    fn set(self, block: &mut RotorBlock, value: usize) {
        match self {
            Self::Enumeration(reference) => set_integer(block, reference, value as i32 + 1),
            Self::Switch(reference) => set_boolean(block, reference, value == 1),
        }
    }

    /// Whether this is the choice of a name.
    fn is(self, name: &str) -> bool {
        self.name() == name
    }
}

/// One combination of the values of some choices: the digits of its number, each in the base of the
/// count of values.
fn digits(mut number: usize, counts: impl Iterator<Item = usize>) -> Vec<usize> {
    let mut next = |count: usize| {
        let digit = number % count;
        number /= count;
        digit
    };
    counts.map(&mut next).collect()
}

/// Point `number` of a sequence that spreads evenly in all of its coordinates and in their pairs:
/// the fractional parts of multiples of powers of the root of x^24 = x + 1 (Roberts' generalisation
/// of the golden section). Every arithmetic progression of its points spreads evenly, too, so that
/// it can be combined with the digits of the same number.
fn spread(number: usize, coordinate: usize) -> f64 {
    let root: f64 = (0..60).fold(1.1, |x, _| (1.0 + x).powf(1.0 / 24.0));
    (0.5 + number as f64 * root.powi(-1 - coordinate as i32)).fract()
}

/// One flight with one combination of models.
#[derive(Debug, Clone)]
struct Run {
    /// The value of each choice.
    values: Vec<usize>,
    /// The indices in the lists of flight conditions.
    levels: [usize; LEVELS.len()],
}

/// The flight of a run, in the units of the lists above.
struct Flight {
    advance: f64,
    climb: f64,
    /// In the first and the second step.
    collective_degrees: [f64; 2],
    /// In the first and the second step.
    turning: [f64; 2],
    blades: i32,
    height: f64,
    torque: f64,
}

impl Run {
    fn flight(&self) -> Flight {
        let [
            advance,
            climb,
            collective,
            turning,
            later_collective,
            later_turning,
            blades,
            height,
            torque,
        ] = self.levels;
        Flight {
            advance: ADVANCE[advance],
            climb: CLIMB[climb],
            collective_degrees: [collective, later_collective].map(|k| COLLECTIVE_DEGREES[k]),
            turning: [turning, later_turning].map(|k| TURNING[k]),
            blades: BLADES[blades],
            height: HEIGHT[height],
            torque: TORQUE[torque],
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Outcome {
    Flown,
    Refused,
    FlownWithoutSteadyState,
    Unsolved,
}

struct Sweep {
    choices: Vec<Choice>,
    hover_velocity: f64,
}

/// A block with few elements and long steps.
fn fast_block() -> RotorBlock {
    let mut block = default_block();
    set_integer(&mut block, integer::NUMERICS__ELEMENTS, ELEMENTS);
    set(
        &mut block,
        real::NUMERICS__AZIMUTH_STEP,
        LONGEST_AZIMUTH_STEP,
    );
    block
}

/// The bits of the computed variables.
fn bits(block: &RotorBlock) -> Vec<u64> {
    let rows = REALS.iter().zip(block.values().reals);
    let computed = rows.filter(|(v, _)| v.causality.is_computed());
    computed.map(|(_, value)| value.to_bits()).collect()
}

impl Sweep {
    fn new() -> Self {
        let mut hover = fast_block();
        hover.update().unwrap();
        Self {
            choices: Choice::all(),
            hover_velocity: get(&hover, real::INDUCED_VELOCITY),
        }
    }

    /// The number of runs of the first series.
    fn combinations(&self) -> usize {
        self.structure().map(|c| c.count()).product()
    }

    fn structure(&self) -> impl Iterator<Item = &Choice> {
        let is_structure = |c: &&Choice| STRUCTURE.contains(&c.name());
        self.choices.iter().filter(is_structure)
    }

    /// A run of the first series.
    fn combination(&self, number: usize) -> Run {
        let mut structure = digits(number, self.structure().map(|c| c.count())).into_iter();
        let value = |(i, choice): (usize, &Choice)| {
            if STRUCTURE.contains(&choice.name()) {
                structure.next().unwrap()
            } else {
                (spread(number, LEVELS.len() + 1 + i) * choice.count() as f64) as usize
            }
        };
        let values = self.choices.iter().enumerate().map(value).collect();
        let level = |k: usize| (spread(number, k) * LEVELS[k] as f64) as usize;
        Run {
            values,
            levels: std::array::from_fn(level),
        }
    }

    /// The choices that the second series combines with every flight. The others have their
    /// defaults.
    fn main_choices(&self) -> impl Iterator<Item = &Choice> {
        let names = ["models.inflow", "flapping.enabled"];
        let is_main = move |c: &&Choice| names.iter().any(|name| c.is(name));
        self.choices.iter().filter(is_main)
    }

    /// The number of runs of the second series.
    fn flights(&self) -> usize {
        let models: usize = self.main_choices().map(|c| c.count()).product();
        models * LEVELS[..4].iter().product::<usize>()
    }

    /// A run of the second series. The second step of the flight comes from the sequence.
    fn flight(&self, number: usize) -> Run {
        let counts = self.main_choices().map(|c| c.count());
        let all = digits(number, counts.chain(LEVELS[..4].iter().copied()));
        let (main, first) = all.split_at(self.main_choices().count());
        let mut main = main.iter();
        let names: Vec<_> = self.main_choices().map(|c| c.name()).collect();
        let value = |choice: &Choice| match names.contains(&choice.name()) {
            true => *main.next().unwrap(),
            false => choice.default(),
        };
        let level = |k: usize| match first.get(k) {
            Some(level) => *level,
            None => (spread(number, k) * LEVELS[k] as f64) as usize,
        };
        Run {
            values: self.choices.iter().map(value).collect(),
            levels: std::array::from_fn(level),
        }
    }

    fn describe(&self, run: &Run) -> String {
        let values = self.choices.iter().zip(&run.values);
        let mut texts: Vec<_> = values
            .map(|(choice, value)| format!("{} = {}", choice.name(), choice.value_name(*value)))
            .collect();
        let flight = run.flight();
        texts.push(format!(
            "mu {}, climb {} v_h, collective {} then {} deg, rotor speed {} then {}, {} blades, height {} R, torque {} N.m",
            flight.advance,
            flight.climb,
            flight.collective_degrees[0],
            flight.collective_degrees[1],
            flight.turning[0],
            flight.turning[1],
            self.blades(run),
            flight.height,
            flight.torque
        ));
        texts.join(", ")
    }

    /// Whether the documentation says that the combination is refused: flapping blades averaged
    /// over one revolution or with the closed form, and the closed form with ground effect.
    fn expects_refusal(&self, run: &Run) -> bool {
        let has = |name: &str, value: &str| self.has(run, name, value);
        let flaps = has(boolean::FLAPPING__ENABLED.variable().name, "true");
        let closed = has("models.inflow", "annulusClosedForm");
        flaps && (has("models.blades", "disc") || closed)
            || closed && !has("models.groundEffect", "none")
    }

    /// The number of blades: a seesaw has two.
    fn blades(&self, run: &Run) -> i32 {
        if self.has(run, "flapping.hub", "teetering") {
            2
        } else {
            run.flight().blades
        }
    }

    fn has(&self, run: &Run, name: &str, value: &str) -> bool {
        let mut values = self.choices.iter().zip(&run.values);
        values.any(|(c, v)| c.is(name) && c.value_name(*v) == value)
    }

    /// Starts, steps, changes collective and rotor speed, and steps again.
    fn fly(&self, run: &Run) -> Result<(Outcome, Vec<u64>), String> {
        let mut block = fast_block();
        for (choice, value) in self.choices.iter().zip(&run.values) {
            choice.set(&mut block, *value);
        }
        if self.has(run, "models.lift", "slopesByReynolds") {
            set_string(&mut block, string::AIRFOIL__FILE, "naca0015.txt");
        }
        let flight = run.flight();
        let blades = self.blades(run);
        set_integer(&mut block, integer::GEOMETRY__NUMBER_OF_BLADES, blades);
        let tip_speed = RPM * PI / 30.0 * get(&block, real::GEOMETRY__RADIUS);
        set(&mut block, real::VELOCITY_1, flight.advance * tip_speed);
        let radius = get(&block, real::GEOMETRY__RADIUS);
        set(
            &mut block,
            real::HEIGHT_ABOVE_GROUND,
            flight.height * radius,
        );
        set(&mut block, real::DRIVE_TORQUE, flight.torque);
        let climb = flight.climb * self.hover_velocity;
        set(&mut block, real::VELOCITY_3, climb);
        let control = |block: &mut RotorBlock, step: usize| {
            let pitch = flight.collective_degrees[step].to_radians();
            set(block, real::COLLECTIVE, pitch);
            set(block, real::RPM, flight.turning[step] * RPM);
        };
        control(&mut block, 0);
        let before = bits(&block);
        let is_refusal_expected = self.expects_refusal(run);
        match block.start() {
            Ok(()) if is_refusal_expected => return Err("was not refused".to_owned()),
            Ok(()) => {}
            Err(error) => return judged(error, &block, before, is_refusal_expected),
        }
        let is_steady = !block.take_notes().iter().any(|note| match note {
            Note::Warning(text) => text.contains("no state was found"),
            Note::Event(_) => false,
        });
        for step in 0..2 {
            if step == 1 {
                control(&mut block, step);
            }
            let before = bits(&block);
            if let Err(error) = block.step(STEP) {
                return judged(error, &block, before, false);
            }
        }
        let reals = REALS.iter().zip(block.values().reals);
        for (variable, value) in reals {
            if !value.is_finite() {
                return Err(format!("{} = {value}", variable.name));
            }
        }
        let outcome = if is_steady {
            Outcome::Flown
        } else {
            Outcome::FlownWithoutSteadyState
        };
        Ok((outcome, bits(&block)))
    }

    fn checked(&self, run: &Run, twice: bool) -> Outcome {
        let fly = || {
            let flown = catch_unwind(AssertUnwindSafe(|| self.fly(run)));
            match flown {
                Ok(Ok(answer)) => answer,
                Ok(Err(what)) => panic!("{}: {what}", self.describe(run)),
                Err(_) => panic!("{}: panicked", self.describe(run)),
            }
        };
        let (outcome, outputs) = fly();
        if twice {
            let again = fly();
            let is_same = again == (outcome, outputs);
            assert!(is_same, "{}: differs from itself", self.describe(run));
        }
        outcome
    }
}

/// The outcome of a run with an error. It must be an expected one, and must leave the outputs as
/// they were before.
fn judged(
    error: BlockError,
    block: &RotorBlock,
    before: Vec<u64>,
    is_refusal_expected: bool,
) -> Result<(Outcome, Vec<u64>), String> {
    let outcome = match &error {
        BlockError::Setup(
            SetupError::DiscCannotFlap
            | SetupError::ClosedFormCannotFlap
            | SetupError::ClosedFormNearGround,
        ) if is_refusal_expected => Outcome::Refused,
        BlockError::Unsolved(..) => Outcome::Unsolved,
        _ => return Err(error.to_string()),
    };
    if bits(block) != before {
        return Err(format!("outputs changed with {error}"));
    }
    Ok((outcome, before))
}

/// The number of runs with each outcome, by inflow model.
type Counts = Vec<[usize; 4]>;

#[test]
fn every_combination_of_models_is_finite_or_one_clear_error() {
    let sweep = Sweep::new();
    let inflow = sweep.choices.iter().position(|c| c.is("models.inflow"));
    let inflow = inflow.unwrap();
    let (combinations, flights) = (sweep.combinations(), sweep.flights());
    let next = AtomicUsize::new(0);
    let work = || {
        let mut counts: Counts = vec![[0; 4]; sweep.choices[inflow].count()];
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            let run = match number {
                n if n < combinations => sweep.combination(n),
                n if n < combinations + flights => sweep.flight(n - combinations),
                _ => return counts,
            };
            let twice = spread(number, LEVELS.len()) < 0.1;
            let outcome = sweep.checked(&run, twice);
            counts[run.values[inflow]][outcome as usize] += 1;
            if outcome as usize >= 2 {
                println!("{outcome:?} {}", sweep.describe(&run));
            }
        }
    };
    let counts: Vec<Counts> = thread::scope(|scope| {
        let threads: Vec<_> = (0..THREADS).map(|_| scope.spawn(work)).collect();
        let joined = threads.into_iter().map(|t| t.join());
        joined
            .map(|counts| counts.unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
            .collect()
    });
    let mut total = [0; 4];
    println!("inflow model: flown, refused by setup, without steady state, without other solution");
    for value in 0..sweep.choices[inflow].count() {
        let by_model: [usize; 4] =
            std::array::from_fn(|k| counts.iter().map(|c| c[value][k]).sum());
        println!("{}: {by_model:?}", sweep.choices[inflow].value_name(value));
        (0..4).for_each(|k| total[k] += by_model[k]);
    }
    let [flown, refused, no_steady_state, unsolved] = total;
    let runs = flown + refused + no_steady_state + unsolved;
    println!("{runs} runs: {total:?}");
    assert_eq!(runs, combinations + flights);
    let percent = |part: usize| 100.0 * part as f64 / (runs - refused) as f64;
    let (steady, all) = (percent(no_steady_state), percent(unsolved));
    println!("{steady:.3} % without steady state, {all:.3} % without solution");
    assert!(
        steady <= MAX_WITHOUT_STEADY_STATE && all <= MAX_WITHOUT_SOLUTION,
        "{total:?}: {steady} and {all} percent"
    );
}
