//! A warning for the log when a blade flaps far beyond its stops.

use core::f64::consts::PI;
use rotor::{Rotor, State};

/// How far beyond a stop is far, rad: ten times as far as the weight of a blade presses it.
const FAR: f64 = 0.1;

/// Which of the two sentences, on blades beyond a stop and blades turned over, have been logged.
#[derive(Debug, Clone, Copy, Default)]
pub struct BeyondStopsNotice {
    beyond: bool,
    turned_over: bool,
}

impl BeyondStopsNotice {
    /// The sentence for this state, unless it has been logged before. Allocates only if it returns
    /// one.
    pub fn next(&mut self, rotor: &Rotor, state: &State) -> Option<String> {
        let stops = rotor.models().hinge.freedom.as_ref()?.stops;
        let angles = state.flaps[..rotor.flapping_blades()].iter();
        let angles = angles.map(|flap| flap.angle).enumerate();
        let (blade, angle) = angles.max_by(|(_, a), (_, b)| {
            let (a, b) = (stops.excess(*a), stops.excess(*b));
            a.total_cmp(&b)
        })?;
        let degrees = angle * 180.0 / PI;
        let blade = blade + 1;
        if angle.abs() > PI && !self.turned_over {
            (self.beyond, self.turned_over) = (true, true);
            return Some(format!(
                "blade {blade} has turned over its hinge, to a flap angle of {degrees:.0} deg: the flapping diverges and the results mean nothing; check rpm, wind and the inertia of the blades; this is said once"
            ));
        }
        if stops.excess(angle) > FAR && !self.beyond {
            self.beyond = true;
            let (name, stop) = if angle < stops.lowest {
                ("flapping.lowestAngle", stops.lowest)
            } else {
                ("flapping.highestAngle", stops.highest)
            };
            return Some(format!(
                "the flap angle of blade {blade} is {degrees:.1} deg, far beyond the stop at {name} = {:.1} deg: a real blade would bend or break; check rpm, wind and the inertia of the blades; this is said once",
                stop * 180.0 / PI
            ));
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::super::{RotorBlock, variables::boolean};
    use super::*;

    const RESOURCES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/modelDescription/resources");

    #[test]
    fn each_sentence_names_the_blade_once() -> Result<(), Box<dyn std::error::Error>> {
        let mut block = RotorBlock::new(RESOURCES.into());
        block.set_booleans(&[boolean::FLAPPING__ENABLED], &[1])?;
        let rotor = block.rotor()?;
        let mut notice = BeyondStopsNotice::default();
        let mut state = State::default();
        let mut at = |angle: f64| {
            state.flaps[2].angle = angle;
            notice.next(&rotor, &state)
        };
        for angle in [0.0, 0.6, 0.65, -0.4, -0.49] {
            assert_eq!(at(angle), None, "{angle}");
        }
        let beyond = at(-0.55).unwrap_or_default();
        assert!(
            beyond.contains(
                "blade 3 is -31.5 deg, far beyond the stop at flapping.lowestAngle = -22.9 deg"
            ),
            "{beyond}"
        );
        assert_eq!(at(0.9), None, "said once");
        let over = at(3.5).unwrap_or_default();
        assert!(
            over.contains("blade 3 has turned over its hinge, to a flap angle of 201 deg"),
            "{over}"
        );
        assert_eq!(at(-4.0), None, "said once");
        Ok(())
    }
}
