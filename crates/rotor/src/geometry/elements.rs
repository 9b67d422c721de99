//! The blade cut into elements: one array for each quantity, from root to tip.

use super::Geometry;

/// Blade elements of equal width from the cutout to the tip. All arrays have one entry for each
/// element, from the inside out. SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Elements {
    /// Width of each element, m.
    pub width: f64,
    /// Radius of the element's middle, m.
    pub radius: Vec<f64>,
    /// Mean chord over the element, m: any number of elements has the area of the blade.
    pub chord: Vec<f64>,
    /// Pitch of the section less the collective, rad, positive nose up.
    pub twist: Vec<f64>,
    /// Index of the airfoil of the next station inboard, in `Geometry::airfoils`.
    pub inner_airfoil: Vec<usize>,
    /// Index of the airfoil of the next station outboard.
    pub outer_airfoil: Vec<usize>,
    /// Share of the outer airfoil in the section's coefficients, 0 to 1.
    pub outer_share: Vec<f64>,
}

impl Elements {
    /// Cuts a geometry that passed [`Geometry::check`] into `count` (>= 1) elements.
    pub fn new(geometry: &Geometry, count: usize) -> Self {
        let cutout = geometry.cutout();
        let step = (1.0 - cutout) / count as f64;
        let edge = |i: usize| cutout + step * i as f64;
        let mut elements = Self {
            width: step * geometry.radius,
            radius: Vec::with_capacity(count),
            chord: Vec::with_capacity(count),
            twist: Vec::with_capacity(count),
            inner_airfoil: Vec::with_capacity(count),
            outer_airfoil: Vec::with_capacity(count),
            outer_share: Vec::with_capacity(count),
        };
        for i in 0..count {
            let middle = cutout + step * (i as f64 + 0.5);
            let (inner, outer, share) = geometry.between(middle);
            elements.radius.push(middle * geometry.radius);
            elements
                .chord
                .push(geometry.area(edge(i), edge(i + 1)) / elements.width);
            elements.twist.push(geometry.twist(middle));
            elements.inner_airfoil.push(inner.airfoil);
            elements.outer_airfoil.push(outer.airfoil);
            elements.outer_share.push(share);
        }
        elements
    }

    /// Whether an airfoil, by its index in `Geometry::airfoils`, has a share in an element.
    pub fn uses(&self, element: usize, airfoil: usize) -> bool {
        let share = self.outer_share[element];
        let is_inner = self.inner_airfoil[element] == airfoil && share < 1.0;
        let is_outer = self.outer_airfoil[element] == airfoil && share > 0.0;
        is_inner || is_outer
    }

    /// Number of elements.
    pub fn len(&self) -> usize {
        self.radius.len()
    }

    /// r/R of the elements' middles; `radius` is R, m.
    pub fn radius_ratios(&self, radius: f64) -> Vec<f64> {
        self.radius.iter().map(|r| r / radius).collect()
    }

    /// Whether there are no elements.
    pub fn is_empty(&self) -> bool {
        self.radius.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_keep_the_area_of_the_blade() {
        let geometry = Geometry::linear(2, 2.0, 0.25, 0.2, 0.5, 0.0);
        for count in [1, 7, 40] {
            let elements = Elements::new(&geometry, count);
            let area: f64 = elements.chord.iter().map(|c| c * elements.width).sum();
            assert!((area - 0.75 * 2.0 * 0.15).abs() < 1e-12, "{count}: {area}");
            assert_eq!(elements.len(), count);
        }
    }
}
