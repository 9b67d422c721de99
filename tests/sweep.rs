//! Every combination of the models, flown: each flight is finite or ends in one clear error, and
//! the same flight gives the same bits again.
//!
//! The enumerations, their values and the switches are read from the table of variables, so that a
//! model that is added to it is flown as well. All combinations of those that shape the solution
//! fly once, in a flight and with the other choices of a sequence that spreads evenly, so that each
//! pair of values meets hundreds of times; and all flights are flown with each inflow model, with
//! and without flapping.

// The standard library's functions are independent of those under test.
#![allow(clippy::disallowed_methods)]

use helicopter_rotor::block::{
    BlockError, RotorBlock, SetupError,
    variables::{BooleanRef, IntegerRef, REALS, RealRef, boolean, integer, real, string},
};
use rotor::SolveError;
use std::{
    f64::consts::PI,
    panic::{AssertUnwindSafe, catch_unwind},
    path::PathBuf,
    sync::atomic::{AtomicUsize, Ordering},
    thread,
};

const THREADS: usize = 2;
const ELEMENTS: i32 = 4;
/// rad.
const LONGEST_AZIMUTH_STEP: f64 = real::NUMERICS__AZIMUTH_STEP.variable().max;
const STEP: f64 = 0.02;
const RPM: f64 = 960.0;

/// Speeds along the disc over the tip speed at `RPM`.
const ADVANCE: [f64; 5] = [0.0, 0.05, 0.15, 0.3, 0.5];
/// Climbs over the induced velocity in hover.
const CLIMB: [f64; 7] = [-3.0, -1.8, -1.0, -0.5, 0.0, 1.0, 3.0];
const COLLECTIVE_DEGREES: [f64; 4] = [-20.0, 0.0, 10.0, 40.0];
/// Rotor speeds over `RPM`.
const TURNING: [f64; 4] = [0.0, 0.5, 1.0, 1.5];
/// Heights of the hub above the ground over R.
const HEIGHT: [f64; 5] = [0.0, 0.4, 1.0, 2.5, 5.0];
/// N.m, where a torque turns the rotor.
const TORQUE: [f64; 3] = [-5.0, 0.0, 10.0];
/// Few, because the steady start of flapping blades takes time by the square of their number.
const BLADES: [i32; 3] = [1, 2, 3];
/// Levels of the above, and of the collective and the rotor speed that follow.
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

/// The choices that shape the solution; those that only shape the sections or the frame are not
/// among them.
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

/// Largest share, in percent, of the flights for which no steady state is found, and of all that
/// have no solution.
const MOST_WITHOUT_STEADY_STATE: f64 = 0.25;
const MOST_WITHOUT_SOLUTION: f64 = 0.3;

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
            Self::Enumeration(place) => place.variable().choices.len(),
            Self::Switch(_) => 2,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Enumeration(place) => place.variable().name,
            Self::Switch(place) => place.variable().name,
        }
    }

    /// Its values' names, which are those of the number from 0.
    fn value_name(self, value: usize) -> String {
        match self {
            Self::Enumeration(place) => place.variable().choices[value].to_owned(),
            Self::Switch(_) => (value == 1).to_string(),
        }
    }

    /// The value that the table starts with.
    fn default(self) -> usize {
        match self {
            Self::Enumeration(place) => place.variable().start as usize - 1,
            Self::Switch(place) => place.variable().start as usize,
        }
    }

    fn set(self, block: &mut RotorBlock, value: usize) {
        match self {
            Self::Enumeration(place) => block.set_integers(&[place], &[value as i32 + 1]),
            Self::Switch(place) => block.set_booleans(&[place], &[value as i32]),
        }
        .unwrap();
    }

    /// Whether this is the enumeration or switch of a name.
    fn is(self, name: &str) -> bool {
        self.name() == name
    }
}

/// All combinations of the values of some choices: the place of each in the number of the
/// combination.
fn digits(mut number: usize, counts: impl Iterator<Item = usize>) -> Vec<usize> {
    let mut next = |count: usize| {
        let digit = number % count;
        number /= count;
        digit
    };
    counts.map(&mut next).collect()
}

/// Point `number` of a sequence that spreads evenly in all of its coordinates and in their pairs:
/// multiples of powers of the root of x^24 = x + 1 without their whole parts (Roberts'
/// generalisation of the golden section). Every arithmetic progression of its points spreads evenly
/// as well, so that it goes well with the digits of the same number.
fn spread(number: usize, coordinate: usize) -> f64 {
    let root: f64 = (0..60).fold(1.1, |x, _| (1.0 + x).powf(1.0 / 24.0));
    (0.5 + number as f64 * root.powi(-1 - coordinate as i32)).fract()
}

/// One flight with one combination of models.
#[derive(Debug, Clone)]
struct Run {
    values: Vec<usize>,
    levels: [usize; LEVELS.len()],
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Outcome {
    Flown,
    Refused,
    NoSteadyState,
    Unsolved,
}

struct Sweep {
    choices: Vec<Choice>,
    hover_velocity: f64,
}

fn block() -> RotorBlock {
    let resources = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("modelDescription/resources");
    let mut block = RotorBlock::new(resources);
    block
        .set_integers(&[integer::NUMERICS__ELEMENTS], &[ELEMENTS])
        .unwrap();
    set(
        &mut block,
        real::NUMERICS__AZIMUTH_STEP,
        LONGEST_AZIMUTH_STEP,
    );
    block
}

fn set(block: &mut RotorBlock, place: RealRef, value: f64) {
    block.set_reals(&[place], &[value]).unwrap();
}

/// The computed variables, by their bits.
fn bits(block: &RotorBlock) -> Vec<u64> {
    let rows = REALS.iter().zip(block.values().reals);
    let computed = rows.filter(|(v, _)| v.causality.is_computed());
    computed.map(|(_, value)| value.to_bits()).collect()
}

impl Sweep {
    fn new() -> Self {
        let mut hover = block();
        hover.update().unwrap();
        Self {
            choices: Choice::all(),
            hover_velocity: hover.values().reals[real::INDUCED_VELOCITY],
        }
    }

    /// Every combination of the structure, each with one flight and the other choices of the
    /// sequence.
    fn combinations(&self) -> usize {
        self.structure().map(|c| c.count()).product()
    }

    fn structure(&self) -> impl Iterator<Item = &Choice> {
        let is_structure = |c: &&Choice| STRUCTURE.contains(&c.name());
        self.choices.iter().filter(is_structure)
    }

    fn combination(&self, number: usize) -> Run {
        let mut own = digits(number, self.structure().map(|c| c.count())).into_iter();
        let value = |(i, choice): (usize, &Choice)| {
            if STRUCTURE.contains(&choice.name()) {
                own.next().unwrap()
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

    /// The choices that are combined with every flight; the others have their defaults.
    fn main_choices(&self) -> impl Iterator<Item = &Choice> {
        let names = ["models.inflow", "flapping.enabled"];
        let is_main = move |c: &&Choice| names.iter().any(|name| c.is(name));
        self.choices.iter().filter(is_main)
    }

    fn flights(&self) -> usize {
        let models: usize = self.main_choices().map(|c| c.count()).product();
        models * LEVELS[..4].iter().product::<usize>()
    }

    /// Every flight with every main choice; what follows it is that of the sequence.
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
        let [
            advance,
            climb,
            collective,
            turning,
            later,
            later_turning,
            blades,
            height,
            torque,
        ] = run.levels;
        texts.push(format!(
            "mu {}, climb {} v_h, collective {} then {} deg, rotor speed {} then {}, {} blades, height {} R, torque {} N.m",
            ADVANCE[advance],
            CLIMB[climb],
            COLLECTIVE_DEGREES[collective],
            COLLECTIVE_DEGREES[later],
            TURNING[turning],
            TURNING[later_turning],
            BLADES[blades],
            HEIGHT[height],
            TORQUE[torque]
        ));
        texts.join(", ")
    }

    /// Whether the parameters are documented to be refused: blades that flap as a mean over a turn
    /// or in the closed form.
    fn expected_refusal(&self, run: &Run) -> bool {
        let has = |name: &str, value: &str| self.has(run, name, value);
        let flaps = has(boolean::FLAPPING__ENABLED.variable().name, "true");
        let closed = has("models.inflow", "annulusClosedForm");
        flaps && (has("models.blades", "disc") || closed)
            || closed && !has("models.groundEffect", "none")
    }

    fn has(&self, run: &Run, name: &str, value: &str) -> bool {
        let mut values = self.choices.iter().zip(&run.values);
        values.any(|(c, v)| c.is(name) && c.value_name(*v) == value)
    }

    /// Starts, steps, changes collective and rotor speed, steps again.
    fn fly(&self, run: &Run) -> Result<(Outcome, Vec<u64>), String> {
        let mut block = block();
        for (choice, value) in self.choices.iter().zip(&run.values) {
            choice.set(&mut block, *value);
        }
        if self.has(run, "models.lift", "slopesByReynolds") {
            let place = string::AIRFOIL__FILE;
            block.set_strings(&[place], &["naca0015.txt"]).unwrap();
        }
        let [
            advance,
            climb,
            collective,
            turning,
            later,
            later_turning,
            blades,
            height,
            torque,
        ] = run.levels;
        let count = integer::GEOMETRY__NUMBER_OF_BLADES;
        block.set_integers(&[count], &[BLADES[blades]]).unwrap();
        let tip_speed = RPM * PI / 30.0 * block.values().reals[real::GEOMETRY__RADIUS];
        set(&mut block, real::VELOCITY_1, ADVANCE[advance] * tip_speed);
        let radius = block.values().reals[real::GEOMETRY__RADIUS];
        set(
            &mut block,
            real::HEIGHT_ABOVE_GROUND,
            HEIGHT[height] * radius,
        );
        set(&mut block, real::DRIVE_TORQUE, TORQUE[torque]);
        let climb = CLIMB[climb] * self.hover_velocity;
        set(&mut block, real::VELOCITY_3, climb);
        let control = |block: &mut RotorBlock, collective: usize, turning: usize| {
            let pitch = COLLECTIVE_DEGREES[collective].to_radians();
            set(block, real::COLLECTIVE, pitch);
            set(block, real::RPM, TURNING[turning] * RPM);
        };
        control(&mut block, collective, turning);
        let before = bits(&block);
        let is_refusal_expected = self.expected_refusal(run);
        match block.start() {
            Ok(()) if is_refusal_expected => return Err("was not refused".to_owned()),
            Ok(()) => {}
            Err(error) => return judged(error, &block, before, is_refusal_expected),
        }
        for step in 0..2 {
            if step == 1 {
                control(&mut block, later, later_turning);
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
        Ok((Outcome::Flown, bits(&block)))
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

/// What an error means: one of those expected, after which the outputs are what they were before.
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
        BlockError::Unsolved(SolveError::NoSteadyState, _) => Outcome::NoSteadyState,
        BlockError::Unsolved(..) => Outcome::Unsolved,
        _ => return Err(error.to_string()),
    };
    if bits(block) != before {
        return Err(format!("outputs changed with {error}"));
    }
    Ok((outcome, before))
}

/// Runs by inflow model: flown, refused, without a steady state, without another solution.
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
    let (steady, all) = (
        percent(no_steady_state),
        percent(no_steady_state + unsolved),
    );
    println!("{steady:.3} % without steady state, {all:.3} % without solution");
    assert!(
        steady <= MOST_WITHOUT_STEADY_STATE && all <= MOST_WITHOUT_SOLUTION,
        "{total:?}: {steady} and {all} percent"
    );
}
