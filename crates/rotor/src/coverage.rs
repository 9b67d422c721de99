//! Whether the airfoils' data reach as far as the flow at the blades.

use super::{
    Rotor,
    airfoil::{Airfoil, Axis},
};

/// An airfoil that meets Reynolds or Mach numbers that its file does not have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beyond<'a> {
    pub airfoil: &'a Airfoil,
    /// Lowest and highest number of the file, and of the elements with this airfoil.
    pub file: (f64, f64),
    pub met: (f64, f64),
}

impl Rotor {
    /// What the first airfoil (by the order of their first use along the blade) meets beyond its data
    /// in the last computation. Allocates nothing. Elements in still air meet nothing.
    pub fn beyond_data(&self, axis: Axis) -> Option<Beyond<'_>> {
        self.airfoils
            .iter()
            .enumerate()
            .find_map(|(place, airfoil)| {
                let file = airfoil.range(axis)?;
                let met = self.met(place, axis)?;
                let is_beyond = met.0 < file.0 || met.1 > file.1;
                is_beyond.then_some(Beyond { airfoil, file, met })
            })
    }

    /// Lowest and highest number at the elements that use an airfoil.
    fn met(&self, airfoil: usize, axis: Axis) -> Option<(f64, f64)> {
        let mut range = None;
        for (i, load) in self.loads.iter().enumerate() {
            let share = self.elements.outer_share[i];
            let is_inner = self.elements.inner_airfoil[i] == airfoil && share < 1.0;
            let is_outer = self.elements.outer_airfoil[i] == airfoil && share > 0.0;
            if load.speed == 0.0 || !(is_inner || is_outer) {
                continue;
            }
            let number = match axis {
                Axis::Reynolds => load.reynolds,
                Axis::Mach => load.mach,
            };
            let (low, high): (f64, f64) = range.unwrap_or((number, number));
            range = Some((low.min(number), high.max(number)));
        }
        range
    }
}
