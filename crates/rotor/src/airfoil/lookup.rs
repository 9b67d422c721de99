//! Curves of several layers, prepared for look-ups without a search.

use super::curve::Curve;
use crate::{
    numbers::{LANES, Lanes, Mask, Plain},
    text_file::{NoMemory, push},
};
use core::f64::consts::PI;

/// Number of equal parts of the circle for which the first row is kept: half a degree each.
const PARTS: usize = 720;

/// The points of curves with the slopes behind them.
#[derive(Debug, Clone, PartialEq)]
pub struct Lookup {
    /// The rows of all curves: `Curve::rows`.
    row: Vec<[f64; 4]>,
    /// The row in which each part of the circle begins, curve by curve.
    first: Vec<u32>,
}

impl Lookup {
    /// The curves of all layers.
    ///
    /// # Errors
    ///
    /// If there is no memory for them.
    pub fn try_new(curves: &[Curve]) -> Result<Self, NoMemory> {
        let (mut rows, mut first) = (Vec::new(), Vec::new());
        for curve in curves {
            let base = rows.len();
            for row in curve.rows() {
                push(&mut rows, row, "the points")?;
            }
            let mut at = base;
            for part in 0..PARTS {
                let begin = -PI + 2.0 * PI * part as f64 / PARTS as f64;
                while begin >= rows[at][3] {
                    at += 1;
                }
                push(&mut first, at as u32, "the index of the angles")?;
            }
        }
        Ok(Self { row: rows, first })
    }

    /// The coefficient at angles between -pi and pi, rad, each in the curve of its layer.
    #[inline(always)]
    pub fn value<L: Lanes>(&self, layer: &[usize; LANES], alpha: L) -> L {
        let x = alpha.values();
        let is_number = x.is_negligible(f64::MAX);
        let part = ((x + PI) * (PARTS as f64 / (2.0 * PI))).to_index();
        let mut index = [0; LANES];
        for lane in 0..L::COUNT {
            let part = part[lane].min(PARTS - 1);
            index[lane] = self.first[layer[lane] * PARTS + part] as usize;
        }
        loop {
            let [begin, value, slope, end] = <L::Real as Plain>::rows(&self.row, &index);
            // A point within the part, and one before it by rounding or by the direction of change.
            let forth = is_number & !alpha.below(end);
            let back = alpha.below(begin) & x.above(L::Real::splat(-PI));
            if !(forth | back).any() {
                let beyond = alpha.plus_real(-begin);
                return beyond.times(slope).plus_real(value);
            }
            for (lane, index) in index.iter_mut().enumerate().take(L::COUNT) {
                *index = *index + usize::from(forth.lane(lane)) - usize::from(back.lane(lane));
            }
        }
    }
}
