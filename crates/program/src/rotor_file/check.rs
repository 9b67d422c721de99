//! `helicopter-rotor check FILE`: the rotor in a file as tables and a drawing, and how it hovers.

use super::drawing;
use crate::{Failure, failed, output, sources};
use clap::Args;
use helicopter_rotor::block::{
    Note, RotorBlock,
    variables::{HubModel, RealRef, boolean, integer, real, string},
};
use rotor::geometry::{Geometry, Rotation, RotorDefinition, lock_number};
use std::path::{Path, PathBuf};

/// Shows a rotor definition file: its blade, solidity, Lock number, and how the rotor hovers.
#[derive(Args)]
pub struct Check {
    /// The rotor definition (TOML)
    file: PathBuf,
    /// Rotor speed for the hover, rev/min [default: that of the file, or 960]
    #[arg(long)]
    rpm: Option<f64>,
    /// Collective for the hover, deg [default: that of the file, or 8]
    #[arg(long, allow_hyphen_values = true)]
    collective: Option<f64>,
}

impl Check {
    pub fn run(&self) -> Result<(), Failure> {
        let path = std::path::absolute(&self.file)
            .map_err(failed(format!("cannot find {}", self.file.display())))?;
        let definition = RotorDefinition::read(&path).map_err(|e| Failure(e.to_string()))?;
        let mut block = block(&path)?;
        if let Some(rpm) = self.rpm {
            set(&mut block, real::RPM, rpm)?;
        }
        if let Some(collective) = self.collective {
            set(&mut block, real::COLLECTIVE, collective.to_radians())?;
        }
        block.start().map_err(|e| Failure(e.to_string()))?;
        let mut lines = vec![title(&definition, &self.file)];
        let standard = &block.values().strings[string::AIRFOIL__FILE];
        lines.extend(blade(&definition.geometry, standard));
        lines.push(String::new());
        lines.extend(drawing::blade(&definition.geometry));
        lines.push(String::new());
        lines.extend(numbers(&definition, &block));
        lines.push(String::new());
        lines.push(hover(&block));
        for note in block.take_notes() {
            match note {
                Note::Event(text) => lines.push(format!("  {text}")),
                Note::Warning(text) => lines.push(format!("  Warning: {text}")),
            }
        }
        output::print(lines.join("\n"))
    }
}

/// A block with the rotor of a file and the resources of the FMU.
pub fn block(path: &Path) -> Result<RotorBlock, Failure> {
    let mut block = RotorBlock::new(sources().join("modelDescription/resources"));
    let text = path.to_str().ok_or_else(|| {
        Failure(format!(
            "the path {} is not UTF-8; rename the file or its folder",
            path.display()
        ))
    })?;
    block
        .set_strings(&[string::GEOMETRY__FILE], &[text])
        .map_err(|e| Failure(e.to_string()))?;
    Ok(block)
}

fn set(block: &mut RotorBlock, reference: RealRef, value: f64) -> Result<(), Failure> {
    let set = block.set_reals(&[reference], &[value]);
    set.map_err(|e| Failure(e.to_string()))
}

fn title(definition: &RotorDefinition, file: &Path) -> String {
    let geometry = &definition.geometry;
    let mut title = match &definition.name {
        Some(name) => format!("{name} ({})", file.display()),
        None => file.display().to_string(),
    };
    if let Some(source) = definition.source.as_ref().filter(|text| !text.is_empty()) {
        title += &format!("\nSource: {source}");
    }
    let turns = match geometry.rotation {
        Rotation::CounterClockwise => "counter-clockwise",
        Rotation::Clockwise => "clockwise",
    };
    title
        + &format!(
            "\n{} blades, radius {} m, cutout {} R ({:.4} m), {turns} seen from above\n",
            geometry.blades,
            geometry.radius,
            geometry.cutout(),
            geometry.cutout() * geometry.radius
        )
}

/// The stations as a table. `standard`: the airfoil of those that name none.
fn blade(geometry: &Geometry, standard: &str) -> Vec<String> {
    let pitch = if geometry.has_blade_angles {
        "angle deg"
    } else {
        "twist deg"
    };
    let mut lines = vec![format!(
        "{:>8} {:>9} {:>9} {:>10} {:>8}  airfoil",
        "r/R", "r m", "chord m", pitch, "c/R"
    )];
    for (i, station) in geometry.stations.iter().enumerate() {
        let is_step = i > 0 && geometry.stations[i - 1].radius_ratio == station.radius_ratio;
        let name = match geometry.airfoils[station.airfoil].as_str() {
            "" => format!("{standard} (airfoil.file)"),
            name => name.to_owned(),
        };
        lines.push(format!(
            "{:>8.4} {:>9.4} {:>9.4} {:>10.3} {:>8.4}  {} {name}{}",
            station.radius_ratio,
            station.radius_ratio * geometry.radius,
            station.chord,
            station.twist.to_degrees(),
            station.chord / geometry.radius,
            drawing::letter(station.airfoil),
            if is_step { "  (step)" } else { "" }
        ));
    }
    lines
}

/// Solidity, inertia and what else follows from the file.
fn numbers(definition: &RotorDefinition, block: &RotorBlock) -> Vec<String> {
    let geometry = &definition.geometry;
    let mut lines = vec![format!(
        "Solidity {:.4} (blade area over disc area), thrust-weighted {:.4}",
        geometry.solidity(),
        geometry.thrust_weighted_solidity()
    )];
    let values = block.values();
    lines.push(match geometry.inertia {
        Some(inertia) => {
            let moment = inertia.moment(geometry);
            format!(
                "Lock number {:.3}: inertia of a blade {moment:.5} kg.m2 (rho 1.225 kg/m3, a 5.7 per rad, chord at 0.75 R)",
                lock_number(geometry, moment)
            )
        }
        None => "Lock number: the file gives no inertia; add [flapping] with inertia or lockNumber".to_owned(),
    });
    let flaps = values.booleans[boolean::FLAPPING__ENABLED];
    let deg = |r: RealRef| values.reals[r].to_degrees();
    lines.push(if flaps {
        let is_seesaw = values.integers[integer::FLAPPING__HUB] == HubModel::Teetering as i32;
        let hub = if is_seesaw {
            format!(
                "teetering, undersling {} m",
                values.reals[real::FLAPPING__UNDERSLING]
            )
        } else {
            format!("hinge offset {} R", values.reals[real::FLAPPING__HINGE_OFFSET])
        };
        format!(
            "Hub: {hub}, spring {:.1} N.m/rad, precone {:.2} deg, delta3 {:.1} deg, stops {:.1} and {:.1} deg",
            values.reals[real::FLAPPING__HINGE_SPRING],
            deg(real::FLAPPING__PRECONE),
            deg(real::FLAPPING__DELTA3),
            deg(real::FLAPPING__LOWEST_ANGLE),
            deg(real::FLAPPING__HIGHEST_ANGLE)
        )
    } else {
        "Hub: rigid; the blades do not flap".to_owned()
    });
    lines
}

/// The hover of the block, in one line.
fn hover(block: &RotorBlock) -> String {
    let get = |r: RealRef| block.values().reals[r];
    format!(
        "Hover at sea level, {:.1} rev/min, collective {:.2} deg: thrust {} N, power {} W, CT {:.5}, CQ {:.6}, figure of merit {:.3}, tip Mach number {:.3}, tip Reynolds number {:.2e}, coning {:.2} deg",
        get(real::ROTOR_SPEED),
        get(real::COLLECTIVE).to_degrees(),
        four_digits(get(real::THRUST)),
        four_digits(get(real::POWER)),
        get(real::THRUST_COEFFICIENT),
        get(real::TORQUE_COEFFICIENT),
        get(real::FIGURE_OF_MERIT),
        get(real::TIP_MACH),
        get(real::TIP_REYNOLDS),
        get(real::CONING).to_degrees()
    )
}

/// Four significant digits, without an exponent.
fn four_digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    rounded.to_string()
}
