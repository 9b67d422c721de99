//! Whether the airfoils' data cover the flow at the blades.

use super::{
    airfoil::{Airfoil, Axis},
    blade_loads::ElementLoads,
    rotor::Rotor,
};

/// An airfoil that is used at Reynolds or Mach numbers outside its data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutsideData<'a> {
    /// The first such airfoil in the order of their use along the blade.
    pub airfoil: &'a Airfoil,
    /// Lowest and highest number in its file.
    pub file: (f64, f64),
    /// Lowest and highest number at the elements with this airfoil.
    pub at_blades: (f64, f64),
}

impl Rotor {
    /// The first airfoil that is used outside its data; `loads` has one entry for each element.
    /// Allocates nothing. Elements in still air do not count.
    pub fn outside_data(&self, loads: &[ElementLoads], axis: Axis) -> Option<OutsideData<'_>> {
        let airfoils = self.airfoils().iter().enumerate();
        airfoils.into_iter().find_map(|(index, airfoil)| {
            let file = airfoil.range(axis)?;
            let at_blades = self.at_blades(loads, index, axis)?;
            let is_outside = at_blades.0 < file.0 || at_blades.1 > file.1;
            is_outside.then_some(OutsideData {
                airfoil,
                file,
                at_blades,
            })
        })
    }

    /// Lowest and highest number at the elements that use an airfoil.
    fn at_blades(&self, loads: &[ElementLoads], airfoil: usize, axis: Axis) -> Option<(f64, f64)> {
        let elements = self.elements();
        let mut range = None;
        for (i, load) in loads.iter().enumerate() {
            if load.speed == 0.0 || !elements.uses(i, airfoil) {
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
