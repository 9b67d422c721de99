//! Warnings of values that are permitted but are probably a slip. Each is a sentence that names
//! the value and the slip.

use super::{
    shown::shown,
    values::Values,
    variables::{
        Causality, INTEGERS, InflowModel, REALS, RealRef, Variable, integer, real, string,
    },
};
use core::f64::consts::{FRAC_PI_2, FRAC_PI_3, PI};
use rotor::{
    OperatingPoint, Rotor,
    airfoil::{Airfoil, Axis},
    geometry::{Missed, lock_number},
    numbers::Scalar,
};

/// Largest chord over the rotor radius, from the most slender blades to wide propellers.
const CHORD_RATIOS: (f64, f64) = (0.015, 0.5);

const MAX_SOLIDITY: f64 = 0.5;

/// Largest blade pitch, and largest difference of twist along a blade, rad.
const MAX_PITCH: f64 = FRAC_PI_3;

/// Pitch at an element up to which the closed form, which takes angles for their sines and
/// tangents, has less than 5 % too much thrust in hover, rad.
const MAX_SMALL_PITCH: f64 = PI / 9.0;

/// Lock numbers of built rotors.
const LOCK_NUMBERS: (f64, f64) = (1.0, 20.0);

/// Lock number of an ordinary helicopter.
const USUAL_LOCK_NUMBER: f64 = 8.0;

/// Ratio of a Reynolds number to the nearest of the data up to which these serve. At this ratio the
/// friction drag of a turbulent boundary layer differs by a quarter.
const REYNOLDS_RATIO: f64 = 3.0;

/// The radius r/R whose Reynolds number stands for the blade.
const TYPICAL_RADIUS: f64 = 0.75;

/// Airspeed over tip speed up to which a rotor counts as hovering.
const HOVER: f64 = 0.01;

/// Thrust coefficient down to which a negative thrust counts as 0.
const NO_THRUST: f64 = -1e-5;

/// A rotor at the end of initialisation, whose outputs have been computed.
pub struct Initialized<'a> {
    pub values: &'a Values,
    /// The values of an instance of which nothing is set.
    pub defaults: &'a Values,
    pub rotor: &'a Rotor,
    pub point: &'a OperatingPoint,
    /// Reads the airfoils in the FMU, with their names. Called only if the rotor's own have no data
    /// for its Reynolds numbers.
    pub shipped: &'a dyn Fn() -> Vec<(String, Airfoil)>,
}

/// The warnings; none for an ordinary rotor.
pub fn warnings(start: &Initialized) -> Vec<String> {
    let mut warnings = large_angles(start.values);
    let others = [
        chord(start),
        solidity(start),
        twist_of_file(start),
        small_angles(start),
        replaced(start.values, start.defaults),
        missed_station(start),
        tip_mach(start),
        reynolds(start),
        lock(start),
        thrust(start),
    ];
    warnings.extend(others.into_iter().flatten());
    warnings
}

/// The angle as it would be if it had been given in degrees: "8 deg = 0.1396 rad".
pub fn in_degrees(value: f64) -> String {
    format!("{} deg = {:.4} rad", shown(value), value.to_radians())
}

/// "geometry.radius = 0.762 m".
fn set(values: &Values, reference: RealRef) -> String {
    let Variable { name, unit, .. } = reference.variable();
    format!("{name} = {} {unit}", shown(values.reals[reference]))
}

/// Three significant digits.
fn rounded(value: f64) -> String {
    shown(format!("{value:.2e}").parse().unwrap_or(value))
}

/// The variables or the file that give the shape.
fn shape(values: &Values, parameters: &str) -> String {
    match values.strings[string::GEOMETRY__FILE].as_str() {
        "" => parameters.to_owned(),
        file => format!("geometry.file = {file:?}"),
    }
}

fn has_file(values: &Values) -> bool {
    !values.strings[string::GEOMETRY__FILE].is_empty()
}

fn large_angles(values: &Values) -> Vec<String> {
    // A shaft of 90 deg may be a little more by rounding.
    let upside_down = FRAC_PI_2 + 1e-9;
    let mut limits = vec![
        (real::COLLECTIVE, MAX_PITCH),
        (real::CYCLIC_LONGITUDINAL, MAX_PITCH),
        (real::CYCLIC_LATERAL, MAX_PITCH),
        (real::TILT, upside_down),
        (real::LATERAL_TILT, upside_down),
    ];
    if !has_file(values) {
        limits.push((real::GEOMETRY__TWIST, MAX_PITCH));
    }
    let large = limits
        .into_iter()
        .filter(|(reference, limit)| values.reals[*reference].abs() > *limit);
    let warning = |(reference, limit): (RealRef, f64)| {
        let value = values.reals[reference];
        format!(
            "{} is {:.1} deg, beyond {:.0} deg; was it given in degrees ({})?",
            set(values, reference),
            value.to_degrees(),
            limit.to_degrees(),
            in_degrees(value)
        )
    };
    large.map(warning).collect()
}

fn chord(start: &Initialized) -> Option<String> {
    let geometry = start.rotor.geometry();
    let (chord, radius) = (geometry.largest_chord(), geometry.radius);
    let slip = if chord > CHORD_RATIOS.1 * radius {
        "was the chord given in mm?"
    } else if chord < CHORD_RATIOS.0 * radius {
        "was the chord given as c/R, or the radius in mm?"
    } else {
        return None;
    };
    Some(format!(
        "{}: the largest chord is {} m and the radius {} m; their ratio is {}, and {} to {} is usual: {slip} Both are in m",
        shape(start.values, "geometry.chord and geometry.radius"),
        shown(chord),
        shown(radius),
        rounded(chord / radius),
        CHORD_RATIOS.0,
        CHORD_RATIOS.1
    ))
}

fn solidity(start: &Initialized) -> Option<String> {
    let geometry = start.rotor.geometry();
    let solidity = geometry.solidity();
    (solidity > MAX_SOLIDITY).then(|| {
        format!(
            "{}: the solidity (blade area over disc area) of the {} blades is {}, above {MAX_SOLIDITY}; are chord, radius and number of blades right?",
            shape(start.values, "geometry.chord, geometry.radius and geometry.numberOfBlades"),
            geometry.blades,
            rounded(solidity)
        )
    })
}

fn twist_of_file(start: &Initialized) -> Option<String> {
    let twist = start.rotor.geometry().stations.iter().map(|s| s.twist);
    let (low, high) = twist.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), twist| {
        (twist.min(low), twist.max(high))
    });
    (has_file(start.values) && high - low > MAX_PITCH).then(|| {
        format!(
            "{}: the twist varies by {:.1} deg along the blade, beyond 60 deg; is it in degrees, and measured from the same reference line at every station?",
            shape(start.values, ""),
            (high - low).to_degrees()
        )
    })
}

/// Pitch of the closed form beyond the small angles that it assumes.
fn small_angles(start: &Initialized) -> Option<String> {
    let model = start.values.integers[integer::MODELS__INFLOW];
    let twist = &start.rotor.elements().twist;
    let pitch = twist.iter().map(|twist| start.point.collective + twist);
    let largest = pitch.fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
    (model == InflowModel::AnnulusClosedForm as i32 && largest.abs() > MAX_SMALL_PITCH).then(|| {
        format!(
            "models.inflow = annulusClosedForm assumes small angles and attached flow, but the pitch reaches {:.0} deg; beyond {:.0} deg its thrust is too large by 5 % and more: set models.inflow to annulus",
            largest.to_degrees(),
            MAX_SMALL_PITCH.to_degrees()
        )
    })
}

/// Parameters of the shape that were set although a rotor file replaces them.
fn replaced(values: &Values, defaults: &Values) -> Option<String> {
    fn is_shape<T>(variable: &Variable<T>) -> bool {
        variable.causality == Causality::Parameter && variable.name.starts_with("geometry.")
    }
    let file = values.strings[string::GEOMETRY__FILE].as_str();
    let reals = REALS.iter().zip(values.reals.iter().zip(defaults.reals));
    let reals = reals
        .filter(|(v, (value, default))| is_shape(v) && *value != default)
        .map(|(v, _)| v.name);
    let integers = values.integers.iter().zip(defaults.integers);
    let integers = INTEGERS.iter().zip(integers);
    let integers = integers.filter(|(v, (value, default))| is_shape(v) && *value != default);
    let names: Vec<&str> = reals.chain(integers.map(|(v, _)| v.name)).collect();
    (!file.is_empty() && !names.is_empty()).then(|| {
        format!(
            "{} without effect, because geometry.file = {file:?} gives the shape of the rotor; set geometry.file to \"\", or change the file",
            match names[..] {
                [name] => format!("{name} was set"),
                _ => format!("{} were set", names.join(", ")),
            }
        )
    })
}

fn missed_station(start: &Initialized) -> Option<String> {
    let (geometry, elements) = (start.rotor.geometry(), start.rotor.elements());
    let (index, missed) = elements.missed_station(geometry)?;
    let station = &geometry.stations[index];
    let what = match missed {
        Missed::Airfoil => match geometry.airfoils[station.airfoil].as_str() {
            "" => "the airfoil in airfoil.file".to_owned(),
            name => format!("the airfoil {name:?}"),
        },
        Missed::Twist => "the twist".to_owned(),
        Missed::Chord => "the chord".to_owned(),
    };
    let variable = integer::NUMERICS__ELEMENTS.variable();
    let enough = ((1.0 - geometry.cutout()) / geometry.gap(index)).ceil();
    let remedy = if enough <= f64::from(variable.max) {
        format!("set {} to {enough} or more", variable.name)
    } else {
        "move the stations apart".to_owned()
    };
    Some(format!(
        "{} = {} is too few: an element is {} R wide and misses {what} of the blade station r/R = {} in {}; {remedy}",
        variable.name,
        elements.len(),
        rounded(elements.width / geometry.radius),
        shown(station.radius_ratio),
        shape(start.values, "the geometry"),
    ))
}

fn tip_mach(start: &Initialized) -> Option<String> {
    let reals = &start.values.reals;
    let hover = reals[real::TIP_MACH];
    let air = &start.point.airspeed;
    let edgewise = start.point.speed * start.rotor.geometry().radius + Scalar::hypot(air.x, air.y);
    let advancing = Scalar::hypot(edgewise, air.z) / start.point.air.speed_of_sound;
    let elements = start.rotor.elements();
    let tip = elements.outer_airfoil.last()?;
    let airfoil = &start.rotor.airfoils()[*tip];
    let limit = if advancing > 1.0 {
        "above 1, where no model of this FMU holds".to_owned()
    } else {
        let (_, highest) = airfoil.range(Axis::Mach)?;
        if advancing <= highest {
            return None;
        }
        format!(
            "beyond the highest Mach number, {highest}, in the airfoil file of {:?}, whose data at that number are used",
            airfoil.name()
        )
    };
    Some(format!(
        "the Mach number of the blade tip is {} ({} by rotation alone), {limit}; are {}, the radius of {} m and the airspeed right? rpm is in rev/min",
        rounded(advancing),
        rounded(hover),
        set(start.values, real::RPM),
        shown(start.rotor.geometry().radius),
    ))
}

fn reynolds(start: &Initialized) -> Option<String> {
    let rotor = start.rotor;
    let (geometry, elements) = (rotor.geometry(), rotor.elements());
    let typical = elements
        .radius
        .partition_point(|r| *r < TYPICAL_RADIUS * geometry.radius);
    let typical = typical.min(elements.len() - 1);
    let radius = elements.radius[typical] / geometry.radius;
    let index = if elements.outer_share[typical] < 0.5 {
        elements.inner_airfoil[typical]
    } else {
        elements.outer_airfoil[typical]
    };
    let airfoil = &rotor.airfoils()[index];
    let point = start.point;
    let speed = point.speed * elements.radius[typical];
    let reynolds = point.air.density * speed * geometry.chord(radius) / point.air.viscosity;
    let serves = |airfoil: &Airfoil, ratio: f64| match airfoil.range(Axis::Reynolds) {
        Some((low, high)) => low / ratio <= reynolds && reynolds <= high * ratio,
        None => true,
    };
    // A rotor at rest will turn.
    if reynolds == 0.0 || !airfoil.lifts() || serves(airfoil, REYNOLDS_RATIO) {
        return None;
    }
    let (low, high) = airfoil.range(Axis::Reynolds)?;
    let mut fitting = (start.shipped)();
    fitting.retain(|(_, other)| {
        let has_range = other.range(Axis::Reynolds).is_some();
        let is_alike = other.has_laws() == airfoil.has_laws() && other.lifts();
        has_range && is_alike && serves(other, 1.0)
    });
    fitting.sort_by(|(a, _), (b, _)| a.cmp(b));
    let (file, parameter) = match geometry.airfoils[index].as_str() {
        "" => (
            start.values.strings[string::AIRFOIL__FILE].as_str(),
            "airfoil.file",
        ),
        station => (station, "the airfoil of the stations in geometry.file"),
    };
    let is_same = |other: &Airfoil| section(other.name()) == section(airfoil.name());
    let same = fitting.iter().position(|(_, other)| is_same(other));
    let same = same.map(|index| fitting.remove(index).0);
    let others: Vec<&str> = fitting.iter().map(|(name, _)| name.as_str()).collect();
    let others = others.join(", ");
    let remedy = match (same, others.as_str()) {
        (Some(same), "") => {
            format!("set {parameter} to {same:?}, the same section with data there")
        }
        (Some(same), others) => format!(
            "set {parameter} to {same:?}, the same section with data there; for other sections the FMU has {others}"
        ),
        (None, "") => {
            format!("no file in the FMU has data there; set {parameter} to one of your own")
        }
        (None, others) => format!(
            "set {parameter} to a file of your own or to one in the FMU with data there: {others}"
        ),
    };
    Some(format!(
        "the Reynolds number at r/R = {radius:.2} is {}, but the airfoil file {file:?} has no data near it, only {}; the nearest data are used; {remedy}",
        rounded(reynolds),
        if low == high {
            format!("for {}", rounded(low))
        } else {
            format!("from {} to {}", rounded(low), rounded(high))
        }
    ))
}

/// The section that an airfoil's name begins with, before what tells it from other data.
fn section(name: &str) -> &str {
    name.split(',').next().unwrap_or(name).trim()
}

fn lock(start: &Initialized) -> Option<String> {
    let hinge = &start.rotor.models().hinge;
    hinge.freedom?;
    let inertia = hinge.mass.inertia;
    let geometry = start.rotor.geometry();
    let lock = lock_number(geometry, inertia);
    (!(LOCK_NUMBERS.0..=LOCK_NUMBERS.1).contains(&lock)).then(|| {
        format!(
            "the Lock number rho a c R^4/I of the flapping blades is {}, where {} to {} is usual; does the moment of inertia of {} kg.m2 (from flapping.inertia, flapping.lockNumber or geometry.file) belong to a blade of {} m? For a Lock number of {USUAL_LOCK_NUMBER} it would be {} kg.m2",
            rounded(lock),
            LOCK_NUMBERS.0,
            LOCK_NUMBERS.1,
            shown(inertia),
            shown(geometry.radius),
            rounded(inertia * lock / USUAL_LOCK_NUMBER)
        )
    })
}

fn thrust(start: &Initialized) -> Option<String> {
    let (reals, point) = (&start.values.reals, start.point);
    let tip_speed = point.speed * start.rotor.geometry().radius;
    let hovers = tip_speed > 0.0 && point.airspeed.norm() <= HOVER * tip_speed;
    (hovers && reals[real::THRUST_COEFFICIENT] < NO_THRUST).then(|| {
        format!(
            "the hovering rotor pushes downwards at the start, with a thrust of {} N; is the sign of {} right, and is it the pitch at geometry.pitchReferenceRadius, r/R = {}?",
            rounded(reals[real::THRUST]),
            set(start.values, real::COLLECTIVE),
            shown(start.rotor.geometry().pitch_reference_radius)
        )
    })
}

#[cfg(test)]
mod tests;
