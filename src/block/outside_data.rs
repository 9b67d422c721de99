//! A sentence for the log when the flow at the blades lies outside the data of an airfoil file.

use rotor::{BladeLoads, Rotor, airfoil::Axis};

/// Which of the two sentences have been logged.
#[derive(Debug, Default)]
pub struct OutsideDataNotice {
    reynolds: bool,
    mach: bool,
}

impl OutsideDataNotice {
    /// The sentence for these loads, if it has not been logged before: at most one on Reynolds and
    /// one on Mach numbers. Allocates only for a sentence.
    pub fn next(&mut self, rotor: &Rotor, blade: &BladeLoads) -> Option<String> {
        for (axis, is_said) in [
            (Axis::Reynolds, &mut self.reynolds),
            (Axis::Mach, &mut self.mach),
        ] {
            if *is_said {
                continue;
            }
            if let Some(found) = rotor.outside_data(blade.elements(), axis) {
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
                    shown(found.met),
                    shown(found.file),
                    found.airfoil.name()
                ));
            }
        }
        None
    }
}
