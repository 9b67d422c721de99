//! Values out of the block: the rotor's response to the present inputs, parameters and states.

use super::{
    BlockError, Fresh, Note, RotorBlock, Stage, airfoils,
    beyond_stops::BeyondStopsNotice,
    files::{self, FileHash, ReadFile},
    flight_condition::FlightCondition,
    integrate::Memory,
    outputs::write_response,
    outside_data::OutsideDataNotice,
    plausibility::{self, Initialized},
    references::Reals,
    settings, setup,
    shown::shown,
    values::Values,
    variables::{Causality, FlowState, REALS, Variable, integer, real},
};
use crate::host::memory::Watch;
use rotor::{Rotor, SolveError, Work, Workspace};
use std::{path::Path, sync::Arc};

/// The warning where the search for a steady start fails; `budget` if it has used that up.
fn no_steady_start(budget: Option<i32>) -> String {
    let cause = match budget {
        Some(budget) => format!(
            "the search for a steady start takes more work than numerics.budget = {budget} computations of blade sections"
        ),
        None => "no state was found in which inflow and flapping repeat themselves".to_owned(),
    };
    let raise = match budget {
        Some(_) => "raise numerics.budget, or ",
        None => "",
    };
    format!(
        "{cause}; the simulation starts from the inflow of momentum theory with the blades at rest, and settles by itself ({raise}set initialization to rest to start without inflow and without this search)"
    )
}

/// A rotor with the memory that it needs, and the files from which it was made.
pub(super) struct MadeRotor {
    rotor: Arc<Rotor>,
    workspace: Workspace,
    files: Vec<ReadFile>,
    /// What it was made from, with what a rotor file gave.
    values: Values,
}

impl MadeRotor {
    /// The rotor of these parameters. With `defaults` its file gives what is not set.
    pub(super) fn of(
        values: &Values,
        defaults: Option<&Values>,
        resources: &Path,
    ) -> Result<Self, BlockError> {
        let watch = Watch::begin();
        let mut values = values.clone();
        let (rotor, files) = setup::rotor(&mut values, defaults, resources)?;
        let made = Self {
            values,
            workspace: Workspace::new(&rotor),
            rotor: Arc::new(rotor),
            files,
        };
        if watch.is_short() {
            return Err(BlockError::NoMemory);
        }
        Ok(made)
    }
}

impl RotorBlock {
    /// Ends the configuration, after which fixed parameters cannot change. Warns of implausible
    /// values, and of assignments in `settings` that were replaced.
    pub fn start(&mut self) -> Result<(), BlockError> {
        self.update()?;
        let start = Initialized {
            rotor: &*self.rotor()?,
            values: &self.values,
            defaults: &self.defaults,
            point: &FlightCondition::new(&self.values)?.point,
            shipped: &|| airfoils::shipped(&self.resources),
        };
        let mut warnings = plausibility::warnings(&start);
        warnings.extend(settings::replaced(&self.values));
        self.notes.extend(warnings.into_iter().map(Note::Warning));
        self.stage = Stage::Running;
        Ok(())
    }

    /// Computes the outputs for the present inputs, parameters and states, unless they are up to
    /// date. While the block is being configured, it finds the states at the start first.
    pub fn update(&mut self) -> Result<(), BlockError> {
        if self.fresh == Fresh::All {
            return Ok(());
        }
        let watch = Watch::begin();
        // A rotor file may give inputs and parameters.
        self.rotor()?;
        let condition = FlightCondition::new(&self.values)?;
        self.workspace.work = self.budget();
        let memory = match self.stage {
            Stage::Running | Stage::Integrating => self.memory,
            Stage::Configuring => {
                let values = &self.values;
                let start = setup::start(values)?;
                let azimuth_step = values.reals[real::NUMERICS__AZIMUTH_STEP];
                let rotor = self.rotor()?;
                self.workspace.work = self.budget();
                let workspace = &mut self.workspace;
                let started = rotor.start(&condition.point, start, azimuth_step, workspace);
                let started = started.map_err(|e| self.unsolved(e))?;
                if watch.is_short() {
                    self.forget_rotor();
                    self.notes.clear();
                    return Err(BlockError::NoMemory);
                }
                let step = rotor.work_of_step(&condition.point, &started.state, false) as u64;
                let has_work = self.workspace.work.check(step).is_ok();
                self.note_start(started.is_found, has_work);
                // The outputs of a start that has used up its budget, which are one computation of
                // the whole rotor.
                self.workspace.work = Work::default();
                Memory::starting(started.state)
            }
        };
        self.publish(&condition, memory)
    }

    /// Warns once if the start has no steady or periodic state. `has_work`: whether the budget
    /// would have allowed more.
    fn note_start(&mut self, is_found: bool, has_work: bool) {
        if !is_found && self.has_start {
            let budget = self.values.integers[integer::NUMERICS__BUDGET];
            let warning = no_steady_start((!has_work).then_some(budget));
            self.notes.push(Note::Warning(warning));
        }
        self.has_start = is_found;
    }

    /// The rotor of the present parameters, which is made if there is none.
    pub(super) fn rotor(&mut self) -> Result<Arc<Rotor>, BlockError> {
        if let Some(rotor) = &self.rotor {
            return Ok(Arc::clone(rotor));
        }
        let made = if self.stage == Stage::Configuring {
            let mut own = self.values.clone();
            // Its references were those of variables, and exist.
            let _ = own.withdraw_file();
            MadeRotor::of(&own, Some(&self.defaults), &self.resources)?
        } else {
            MadeRotor::of(&self.values, None, &self.resources)?
        };
        let unused = setup::unused_lock_number(&self.values);
        self.notes.extend(unused.map(Note::Warning));
        Ok(self.take_over(made))
    }

    /// Stores a rotor that was just made. Warns of files that are not those of the state that was
    /// restored before.
    pub(super) fn take_over(&mut self, made: MadeRotor) -> Arc<Rotor> {
        let MadeRotor {
            rotor,
            workspace,
            files,
            values,
        } = made;
        self.values = values;
        let notes = files.iter().map(|file| Note::Event(file.note()));
        self.notes.extend(notes);
        self.files = files;
        self.workspace = workspace;
        let saved = std::mem::take(&mut self.saved_files);
        self.compare_files(&saved);
        self.outside_data = OutsideDataNotice::default();
        self.beyond_stops = BeyondStopsNotice::default();
        Arc::clone(self.rotor.insert(rotor))
    }

    /// Warns of files of the rotor whose content differs from that in a saved state.
    pub(super) fn compare_files(&mut self, saved: &[FileHash]) {
        let changes = files::changes(saved, &self.files);
        self.notes.extend(changes.into_iter().map(Note::Warning));
    }

    /// Computes the outputs in a flight condition. If all are finite, they and the states in
    /// `memory` become the block's; otherwise nothing changes.
    pub(super) fn publish(
        &mut self,
        condition: &FlightCondition,
        memory: Memory,
    ) -> Result<(), BlockError> {
        let mut reals = self.values.reals;
        let rotor = self.rotor()?;
        let state = &memory.state;
        let response = rotor
            .respond(&condition.point, state, &mut self.workspace)
            .map_err(|error| unsolved(error, &self.values))?;
        write_response(&mut reals, &rotor, condition, state, &response);
        check_finite(&self.values, &reals)?;
        self.values.reals = reals;
        self.known_rates
            .keep_published(&rotor, &condition.point, state, &response.rates);
        let flow_state = match response.hub.flow_state {
            rotor::inflow::FlowState::Normal => FlowState::Normal,
            rotor::inflow::FlowState::VortexRing => FlowState::VortexRing,
            rotor::inflow::FlowState::TurbulentWake => FlowState::TurbulentWake,
            rotor::inflow::FlowState::WindmillBrake => FlowState::WindmillBrake,
        };
        self.flow_state = flow_state as i32;
        if self.stage != Stage::Integrating && !self.holds_flow_state {
            self.values.integers[integer::FLOW_STATE] = self.flow_state;
        }
        self.memory = memory;
        self.fresh = Fresh::All;
        let outside = self.outside_data.next(&rotor, &response.blade);
        self.notes.extend(outside.map(Note::Event));
        let beyond = self.beyond_stops.next(&rotor, &self.memory.state);
        self.notes.extend(beyond.map(Note::Warning));
        Ok(())
    }

    /// The block's error for one of the rotor, with the present inputs.
    pub(super) fn unsolved(&self, error: SolveError) -> BlockError {
        unsolved(error, &self.values)
    }

    /// The work that a step or a start may take, as `numerics.budget` says.
    pub(super) fn budget(&self) -> Work {
        let budget = self.values.integers[integer::NUMERICS__BUDGET];
        Work::up_to(budget.max(0) as u64)
    }
}

/// The block's error for one of the rotor.
pub(super) fn unsolved(error: SolveError, values: &Values) -> BlockError {
    match error {
        SolveError::TooMuchWork(budget) => BlockError::TooMuchWork(budget),
        error => BlockError::Unsolved(error, inputs(values)),
    }
}

/// An error if any computed value in `reals` is not finite.
pub(super) fn check_finite(values: &Values, reals: &Reals) -> Result<(), BlockError> {
    // 0 times a number is 0, and NaN if it is not finite: a sum for all variables at once, in four
    // parts that the processor adds side by side.
    let (fours, rest) = reals.as_chunks::<4>();
    let mut sums = [0.0; 4];
    for four in fours {
        for (sum, value) in sums.iter_mut().zip(four) {
            *sum += 0.0 * value;
        }
    }
    if sums.iter().chain(rest).all(|value| value.is_finite()) {
        return Ok(());
    }
    for (variable, value) in REALS.iter().zip(reals) {
        if variable.causality.is_computed() && !value.is_finite() {
            return Err(BlockError::NotFinite {
                name: variable.name,
                value: *value,
                inputs: inputs(values),
            });
        }
    }
    Ok(())
}

/// The inputs that differ from their start values, as text for an error message.
pub(super) fn inputs(values: &Values) -> String {
    let is_set =
        |v: &Variable<f64>, value: f64| v.causality == Causality::Input && value != v.start;
    let inputs = REALS.iter().zip(values.reals);
    let inputs = inputs.filter(|(v, value)| is_set(v, *value));
    let texts = inputs.map(|(v, value)| format!("{} = {} {}", v.name, shown(value), v.unit));
    let texts: Vec<String> = texts.collect();
    if texts.is_empty() {
        return "all have their start values".to_owned();
    }
    texts.join(", ")
}
