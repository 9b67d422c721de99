//! Draws a `.polar` file: lift and drag over the full circle and near zero, data solid and with
//! points, what was added dashed.

use super::{Block, By, Point, Row, text::File};
use crate::{Failure, failed};
use plotters::prelude::*;

/// Width and height of the drawing, pixels.
const SIZE: (u32, u32) = (1100, 760);

/// The angles shown at the right, deg.
const NEAR: f64 = 30.0;

/// The blocks that get a line of their own in the legend.
const MAX_LEGEND: usize = 12;

/// The drawing as SVG.
pub fn svg(file: &File) -> Result<String, Failure> {
    let mut svg = String::new();
    paint(file, &mut svg).map_err(failed("cannot draw the polar"))?;
    Ok(svg)
}

fn paint(file: &File, svg: &mut String) -> Result<(), Box<dyn std::error::Error>> {
    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let added = if file.how.is_some() {
        "; dashed: extended, no data"
    } else {
        ""
    };
    let root = root.titled(&format!("{}{added}", file.name), ("sans-serif", 22))?;
    let panels = root.split_evenly((2, 2));
    let lift: fn(&Point) -> f64 = |point| point.lift;
    let drag: fn(&Point) -> f64 = |point| point.drag;
    let near = (-NEAR, NEAR);
    let circle = (-180.0, 180.0);
    for (panel, name, value, range, has_legend) in [
        (&panels[0], "lift coefficient", lift, circle, false),
        (&panels[1], "lift coefficient", lift, near, true),
        (&panels[2], "drag coefficient", drag, circle, false),
        (&panels[3], "drag coefficient", drag, near, false),
    ] {
        let inside = |row: &&Row| (range.0..=range.1).contains(&row.point.alpha);
        let rows = file
            .blocks
            .iter()
            .flat_map(|block| block.rows.iter().filter(inside));
        let values = rows.map(|row| value(&row.point));
        let (low, high) = values.fold((0.0, 0.0), |(low, high): (f64, f64), value| {
            (low.min(value), high.max(value))
        });
        let margin = 0.05 * (high - low).max(0.01);
        let mut chart = ChartBuilder::on(panel)
            .margin(12)
            .x_label_area_size(36)
            .y_label_area_size(56)
            .build_cartesian_2d(range.0..range.1, (low - margin)..(high + margin))?;
        chart
            .configure_mesh()
            .light_line_style(WHITE)
            .x_desc("angle of attack, deg")
            .y_desc(name)
            .x_labels(if range == circle { 13 } else { 7 })
            .x_label_formatter(&|alpha| format!("{alpha:.0}"))
            .draw()?;
        for (i, block) in file.blocks.iter().enumerate() {
            let color = color(i, file.blocks.len());
            for (points, is_extended) in pieces(block, range, value) {
                if is_extended {
                    let dashed = DashedLineSeries::new(points, 4, 4, color.stroke_width(1));
                    chart.draw_series(dashed)?;
                } else {
                    let line = LineSeries::new(points, color.stroke_width(2));
                    let drawn = chart.draw_series(line.point_size(1))?;
                    if has_legend && i < MAX_LEGEND {
                        drawn
                            .label(label(file.by, block.number))
                            .legend(move |(x, y)| {
                                PathElement::new([(x, y), (x + 18, y)], color.stroke_width(2))
                            });
                    }
                }
            }
        }
        if has_legend {
            chart
                .configure_series_labels()
                .position(SeriesLabelPosition::UpperLeft)
                .background_style(WHITE.mix(0.8))
                .draw()?;
        }
    }
    root.present()?;
    Ok(())
}

fn label(by: By, number: f64) -> String {
    match by {
        By::Reynolds => format!("Re {number}"),
        By::Mach => format!("Mach {number}"),
    }
}

/// From blue to red.
fn color(index: usize, count: usize) -> HSLColor {
    let place = if count > 1 {
        index as f64 / (count - 1) as f64
    } else {
        0.0
    };
    HSLColor(0.62 - 0.62 * place, 0.8, 0.42)
}

/// The lines of a block in a range of angles, each of data or of what was added. A line that was
/// added begins and ends at the data beside it.
fn pieces(
    block: &Block,
    range: (f64, f64),
    value: fn(&Point) -> f64,
) -> Vec<(Vec<(f64, f64)>, bool)> {
    let mut pieces: Vec<(Vec<(f64, f64)>, bool)> = Vec::new();
    let mut last: Option<(&Row, (f64, f64))> = None;
    let inside = |row: &&Row| (range.0..=range.1).contains(&row.point.alpha);
    for row in block.rows.iter().filter(inside) {
        let point = (row.point.alpha, value(&row.point));
        match pieces.last_mut() {
            Some((points, is_extended)) if *is_extended == row.is_extended => points.push(point),
            _ => {
                let mut begin = Vec::new();
                if let Some((before, at)) = last {
                    if row.is_extended {
                        begin.push(at);
                    } else if let Some((points, _)) =
                        pieces.last_mut().filter(|_| before.is_extended)
                    {
                        points.push(point);
                    }
                }
                begin.push(point);
                pieces.push((begin, row.is_extended));
            }
        }
        last = Some((row, point));
    }
    pieces
}
