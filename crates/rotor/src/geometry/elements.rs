//! The blade cut into elements: one array for each quantity, from root to tip.

use super::Geometry;
use crate::numbers::LANES;
use core::f64::consts::PI;

/// Twist that the elements around a station may miss, rad.
const HIDDEN_TWIST: f64 = 2.0 * PI / 180.0;

/// Ratio of a station's chord to those of the elements around it up to which they show it.
const HIDDEN_CHORD: f64 = 1.25;

/// What the elements do not show of a station.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Missed {
    /// No element has the station's airfoil.
    Airfoil,
    /// The station's twist differs by more than 2 deg from that of the elements around it.
    Twist,
    /// The station's chord is more than a quarter larger than that of the elements around it,
    /// which have the blade's area, but spread.
    Chord,
}

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
    /// The same elements in blocks that are computed side by side.
    pub blocks: Vec<Block>,
}

/// Neighbouring elements, one in each lane. The lanes that the last block has too many repeat the
/// blade's last element, but do not count.
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// Index of the first element.
    pub first: usize,
    /// Number of elements, 1 to `LANES`.
    pub count: usize,
    /// 1 for lanes that count, else 0.
    pub counts: [f64; LANES],
    /// Radius of the element's middle, m.
    pub radius: [f64; LANES],
    /// Mean chord, m.
    pub chord: [f64; LANES],
    /// Pitch of the section less the collective, rad.
    pub twist: [f64; LANES],
    /// The airfoils, by their index in `Geometry::airfoils`, with their shares in each lane, whose
    /// sum is 1.
    pub airfoils: Vec<(usize, [f64; LANES])>,
}

impl Block {
    /// The element of a lane, by its index.
    pub fn element(&self, lane: usize) -> usize {
        self.first + lane.min(self.count - 1)
    }
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
            blocks: Vec::new(),
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
        let firsts = (0..count).step_by(LANES);
        elements.blocks = firsts.map(|first| elements.block(first)).collect();
        elements
    }

    /// The block that begins at an element.
    fn block(&self, first: usize) -> Block {
        let count = LANES.min(self.len() - first);
        let element = |lane: usize| first + lane.min(count - 1);
        let of_lanes = |values: &[f64]| core::array::from_fn(|lane| values[element(lane)]);
        let mut airfoils: Vec<(usize, [f64; LANES])> = Vec::new();
        for lane in 0..LANES {
            let i = element(lane);
            let share = self.outer_share[i];
            for (airfoil, share) in [
                (self.inner_airfoil[i], 1.0 - share),
                (self.outer_airfoil[i], share),
            ] {
                let known = airfoils.iter_mut().find(|(known, _)| *known == airfoil);
                match known {
                    Some((_, shares)) => shares[lane] += share,
                    None if share > 0.0 => {
                        let mut shares = [0.0; LANES];
                        shares[lane] = share;
                        airfoils.push((airfoil, shares));
                    }
                    None => {}
                }
            }
        }
        Block {
            first,
            count,
            counts: core::array::from_fn(|lane| f64::from(u8::from(lane < count))),
            radius: of_lanes(&self.radius),
            chord: of_lanes(&self.chord),
            twist: of_lanes(&self.twist),
            airfoils,
        }
    }

    /// Whether an airfoil, by its index in `Geometry::airfoils`, has a share in an element.
    pub fn uses(&self, element: usize, airfoil: usize) -> bool {
        let share = self.outer_share[element];
        let is_inner = self.inner_airfoil[element] == airfoil && share < 1.0;
        let is_outer = self.outer_airfoil[element] == airfoil && share > 0.0;
        is_inner || is_outer
    }

    /// The first station that is nearer to a neighbour than an element is wide and that the
    /// elements miss, by its index. A step is not missed if both of its sides are shown, nor is a
    /// rounded tip.
    pub fn missed_station(&self, geometry: &Geometry) -> Option<(usize, Missed)> {
        let width = self.width / geometry.radius;
        (0..geometry.stations.len()).find_map(|index| {
            let is_narrow = geometry.gap(index) < width;
            let missed = is_narrow.then(|| self.missed(geometry, index)).flatten();
            missed.map(|missed| (index, missed))
        })
    }

    /// What the elements miss of a station, if anything.
    fn missed(&self, geometry: &Geometry, index: usize) -> Option<Missed> {
        let station = &geometry.stations[index];
        if !(0..self.len()).any(|element| self.uses(element, station.airfoil)) {
            return Some(Missed::Airfoil);
        }
        let from_cutout = station.radius_ratio - geometry.cutout();
        let element = (from_cutout * geometry.radius / self.width) as usize;
        let element = element.min(self.len() - 1);
        let around = element.saturating_sub(1)..(element + 2).min(self.len());
        let range = |values: &[f64]| {
            let ends = (f64::INFINITY, f64::NEG_INFINITY);
            let values = values.iter();
            values.fold(ends, |(low, high), v| (v.min(low), v.max(high)))
        };
        let (low, high) = range(&self.twist[around.clone()]);
        let twist = geometry.twist(station.radius_ratio);
        if twist < low - HIDDEN_TWIST || twist > high + HIDDEN_TWIST {
            return Some(Missed::Twist);
        }
        let (_, widest) = range(&self.chord[around]);
        (station.chord > HIDDEN_CHORD * widest).then_some(Missed::Chord)
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
    use crate::geometry::Station;

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

    #[test]
    fn narrow_stations_are_missed_but_steps_and_rounded_tips_are_not() {
        let blade = |stations: &[(f64, f64, f64, usize)]| {
            let mut geometry = Geometry::linear(2, 2.0, 0.2, 0.1, 1.0, 0.0);
            let station =
                |&(radius_ratio, chord, twist, airfoil): &(f64, f64, f64, usize)| Station {
                    radius_ratio,
                    chord,
                    twist,
                    airfoil,
                };
            geometry.stations = stations.iter().map(station).collect();
            geometry.airfoils = vec!["a".to_owned(), "b".to_owned()];
            geometry
        };
        let narrow = |chord: f64, twist: f64, airfoil: usize| {
            blade(&[
                (0.2, 0.1, 0.0, 0),
                (0.599, 0.1, 0.0, 0),
                (0.6, chord, twist, airfoil),
                (0.602, 0.1, 0.0, 0),
                (1.0, 0.1, 0.0, 0),
            ])
        };
        let step = blade(&[
            (0.2, 0.1, 0.0, 0),
            (0.6, 0.1, 0.0, 0),
            (0.601, 0.2, 0.2, 1),
            (0.999, 0.2, 0.2, 1),
            (1.0, 0.0, 0.2, 1),
        ]);
        assert!((step.gap(2) - 0.001).abs() < 1e-12 && (step.gap(0) - 0.4).abs() < 1e-12);
        for (geometry, missed) in [
            (narrow(0.1, 0.0, 0), None),
            (narrow(0.1, 0.0, 1), Some((2, Missed::Airfoil))),
            (narrow(0.1, 0.1, 0), Some((2, Missed::Twist))),
            (narrow(0.1, -0.1, 0), Some((2, Missed::Twist))),
            (narrow(0.2, 0.0, 0), Some((2, Missed::Chord))),
            (narrow(0.0, 0.0, 0), None),
            (step, None),
        ] {
            let elements = Elements::new(&geometry, 40);
            assert_eq!(elements.missed_station(&geometry), missed);
            let fine = Elements::new(&geometry, 2000);
            assert_eq!(fine.missed_station(&geometry), None);
        }
    }
}
