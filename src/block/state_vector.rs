//! The rotor's states as the list of continuous states that the table of variables declares.

use super::{references::Reals, variables::STATES};
use rotor::{
    State,
    disc::Flap,
    numbers::Scalar,
    state::{MAX_FLAPPING_BLADES, MAX_INFLOW_STATES},
};

/// The states, or their derivatives, in the order of `STATES`.
pub type StateVector<S = f64> = [S; STATES.len()];

const _: () = assert!(STATES.len() == 2 + MAX_INFLOW_STATES + 2 * MAX_FLAPPING_BLADES);

/// Azimuth, speed, inflow, flap angles and flap rates.
pub fn to_vector<S: Scalar>(state: &State<S>) -> StateVector<S> {
    let State {
        azimuth,
        speed,
        inflow,
        flaps,
    } = state;
    let angles = flaps.iter().map(|flap| flap.angle);
    let rates = flaps.iter().map(|flap| flap.rate);
    let values = [*azimuth, *speed].into_iter().chain(*inflow);
    let mut vector = [S::zero(); STATES.len()];
    for (slot, value) in vector.iter_mut().zip(values.chain(angles).chain(rates)) {
        *slot = value;
    }
    vector
}

/// The inverse of `to_vector`.
pub fn from_vector<S: Scalar>(vector: &StateVector<S>) -> State<S> {
    let mut state = State {
        azimuth: vector[0],
        speed: vector[1],
        ..State::default()
    };
    let (inflow, flaps) = vector[2..].split_at(MAX_INFLOW_STATES);
    state.inflow.copy_from_slice(inflow);
    let (angles, rates) = flaps.split_at(MAX_FLAPPING_BLADES);
    for ((flap, angle), rate) in state.flaps.iter_mut().zip(angles).zip(rates) {
        *flap = Flap {
            angle: *angle,
            rate: *rate,
        };
    }
    state
}

/// Writes states among the Real variables.
pub fn write_states<S: Scalar>(reals: &mut Reals<S>, state: &State<S>) {
    for (row, value) in STATES.iter().zip(to_vector(state)) {
        reals[row.value] = value;
    }
}

/// Writes derivatives among the Real variables.
pub fn write_derivatives<S: Scalar>(reals: &mut Reals<S>, rates: &State<S>) {
    for (row, value) in STATES.iter().zip(to_vector(rates)) {
        reals[row.derivative] = value;
    }
}

/// The states among the Real variables.
pub fn read_states<S: Scalar>(reals: &Reals<S>) -> State<S> {
    from_vector(&core::array::from_fn(|i| reals[STATES[i].value]))
}

#[cfg(test)]
mod tests {
    use super::super::variables::REALS;
    use super::*;

    #[test]
    fn the_names_of_the_table_are_those_of_the_states_in_this_order() {
        let mut names = vec!["azimuth".to_owned(), "state.rotorSpeed".to_owned()];
        names.extend((1..=MAX_INFLOW_STATES).map(|i| format!("state.inflow[{i}]")));
        names.extend((1..=MAX_FLAPPING_BLADES).map(|i| format!("state.flapAngle[{i}]")));
        names.extend((1..=MAX_FLAPPING_BLADES).map(|i| format!("state.flapRate[{i}]")));
        for (row, name) in STATES.iter().zip(&names) {
            assert_eq!(row.value.variable().name, name);
            assert_eq!(row.derivative.variable().name, format!("der({name})"));
            assert!(row.nominal > 0.0 && row.value.variable().is_state);
        }
        assert_eq!(REALS.iter().filter(|v| v.is_state).count(), STATES.len());
        assert_eq!(STATES.len(), names.len());
    }

    #[test]
    fn a_list_makes_the_states_of_which_it_was_made() {
        let vector: StateVector = core::array::from_fn(|i| i as f64);
        assert_eq!(to_vector(&from_vector(&vector)), vector);
        let state = from_vector(&vector);
        assert_eq!((state.azimuth, state.speed), (0.0, 1.0));
        assert_eq!((state.inflow[0], state.inflow[23]), (2.0, 25.0));
        assert_eq!((state.flaps[0].angle, state.flaps[7].angle), (26.0, 33.0));
        assert_eq!((state.flaps[0].rate, state.flaps[7].rate), (34.0, 41.0));
    }
}
