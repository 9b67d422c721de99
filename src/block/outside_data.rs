//! A sentence for the log when the flow at the blades lies outside the data of an airfoil file.

use rotor::{BladeLoads, Rotor, airfoil::Axis};

/// Which of the two sentences, on Reynolds and on Mach numbers, have been logged.
#[derive(Debug, Clone, Copy, Default)]
pub struct OutsideDataNotice {
    reynolds: bool,
    mach: bool,
}

impl OutsideDataNotice {
    /// The sentence for these loads, unless it has been logged before. Allocates only if it returns
    /// one.
    pub fn next(&mut self, rotor: &Rotor, blade: &BladeLoads) -> Option<String> {
        for (axis, is_logged) in [
            (Axis::Reynolds, &mut self.reynolds),
            (Axis::Mach, &mut self.mach),
        ] {
            if *is_logged {
                continue;
            }
            if let Some(found) = rotor.outside_data(blade.elements(), axis) {
                *is_logged = true;
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
                    "{name} numbers {} at the blades, but {} in the airfoil file of {:?}; outside its range the nearest data are used{drag}; this is said once",
                    shown(found.at_blades),
                    shown(found.file),
                    found.airfoil.name()
                ));
            }
        }
        None
    }
}
