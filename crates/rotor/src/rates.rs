//! Rates of change of the states.

use super::{
    evaluation::Evaluation,
    inflow::{DiscLoading, DiscLoads},
    numbers::Scalar,
    operating_point::Drive,
    state::State,
};
use core::f64::consts::PI;

/// Rates of the states, per second, under the aerodynamic loads.
pub(crate) fn of<S: Scalar>(evaluation: &Evaluation<S>, loads: &DiscLoads<S>) -> State<S> {
    let Evaluation {
        rotor,
        point,
        axes,
        positions,
        ..
    } = evaluation;
    let inflow = &rotor.models().inflow;
    let radius = rotor.geometry().radius;
    let loading = DiscLoading {
        thrust: loads.force.z,
        moment_x: loads.moment.x,
        moment_y: loads.moment.y,
        density_area: point.air.density * PI * radius * radius,
        series: loads.inflow_loading,
    };
    let in_wind = inflow.rates(&evaluation.inflow_states, &loading, &evaluation.stream());
    let mut rates = State {
        azimuth: point.speed,
        inflow: inflow.out_of_wind(&in_wind, axes),
        ..State::default()
    };
    if evaluation.freedom.is_some() {
        let accelerations = evaluation.flap_accelerations(&loads.hinge_moments);
        let blades = rates.flaps.iter_mut().zip(positions.iter());
        for ((rate, position), acceleration) in blades.zip(accelerations) {
            rate.angle = position.flap.rate;
            rate.rate = acceleration;
        }
    }
    if let Drive::Torque { torque, inertia } = point.drive {
        rates.speed = (torque + loads.moment.z) / inertia;
    }
    rates
}

/// An estimate of the fastest rates of the states, 1/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fastest {
    /// Of flapping between the stops, which the lift damps and, with delta3, stiffens.
    pub(crate) flapping: f64,
    /// Of the inflow, of stops that a blade may meet, and of the rotor speed, which the loads damp.
    pub(crate) others: f64,
}

/// The fastest rates of the states within a time, s.
pub(crate) fn fastest(evaluation: &Evaluation, time: f64) -> Fastest {
    let Evaluation {
        rotor, point, flow, ..
    } = evaluation;
    let radius = rotor.geometry().radius;
    let chords = rotor.geometry().stations.iter().map(|s| s.chord);
    let chord = chords.fold(0.0, f64::max);
    let blades = f64::from(rotor.geometry().blades);
    let solidity = blades * chord / (PI * radius);
    let tip_speed = flow.rotation.abs() * radius;
    let inflow = rotor.models().inflow.fastest_rate(
        &evaluation.state.inflow,
        solidity,
        tip_speed,
        &evaluation.stream(),
        evaluation.is_individual,
    );
    let speed = tip_speed + flow.edgewise + flow.climb.abs();
    let (flapping, stops) = evaluation.freedom.map_or((0.0, 0.0), |freedom| {
        let hinge = &rotor.models().hinge;
        let flaps = &evaluation.state.flaps[..rotor.flapping_blades()];
        let free = freedom.fastest_rate(hinge, point, flow, chord, speed);
        if freedom.may_meet_stop(flaps, time) {
            (free, hinge.stop_rate(flow.rotation))
        } else {
            (free, 0.0)
        }
    });
    let turning = match point.drive {
        Drive::Speed => 0.0,
        Drive::Torque { inertia, .. } => {
            blades * point.air.density * PI * speed * chord * radius * radius * radius
                / (3.0 * inertia)
        }
    };
    Fastest {
        flapping,
        others: inflow + stops + turning,
    }
}
