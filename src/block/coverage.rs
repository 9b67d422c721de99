//! A sentence for the log where the flow goes beyond the data of an airfoil file.

use rotor::{Rotor, airfoil::Axis};

/// What was said already.
#[derive(Debug, Default)]
pub struct Coverage {
    reynolds: bool,
    mach: bool,
}

impl Coverage {
    /// The sentence for the last computation of a rotor, if there is one that was not said before: at
    /// most one on Reynolds and one on Mach numbers. Allocates only for a sentence.
    pub fn note(&mut self, rotor: &Rotor) -> Option<String> {
        for (axis, is_said) in [
            (Axis::Reynolds, &mut self.reynolds),
            (Axis::Mach, &mut self.mach),
        ] {
            if *is_said {
                continue;
            }
            if let Some(beyond) = rotor.beyond_data(axis) {
                *is_said = true;
                let (name, digits, drag) = match axis {
                    Axis::Reynolds => ("Reynolds", 0, " (drag: see airfoil.dragReynoldsExponent)"),
                    Axis::Mach => ("Mach", 3, ""),
                };
                let shown = |(low, high): (f64, f64)| {
                    let (low, high) = (format!("{low:.digits$}"), format!("{high:.digits$}"));
                    if low == high {
                        low
                    } else {
                        format!("{low} to {high}")
                    }
                };
                return Some(format!(
                    "{name} numbers {} at the blades, but {} in the airfoil file of {:?}: the nearest are used beyond them{drag}; this is said once",
                    shown(beyond.met),
                    shown(beyond.file),
                    beyond.airfoil.name()
                ));
            }
        }
        None
    }
}
