//! From the parameters to a rotor: its geometry, its airfoils and its models. Each choice among the
//! parameters is mapped to the physics here.

use super::{
    airfoils::read_airfoils,
    files::{FileHash, ReadFile},
    location::resolve,
    resource_files,
    rotor_file::{self, Taken},
    values::Values,
    variables::{
        BladesModel, CompressibilityModel, DescentModel, GroundEffectModel, HubModel, InflowModel,
        Initialization, IntegerRef, LiftModel, Rotation, TipLossModel, boolean, integer, real,
        string,
    },
};
use rotor::{
    Blades, Models, Rotor, Start,
    airfoil::{AirfoilError, Lift, SectionModel},
    compressibility::Compressibility,
    flapping::{BladeMass, Freedom, Hinge, Stops},
    geometry::{self, BladeInertia, Elements, Geometry, GeometryError, RotorFileError},
    inflow::{Descent, ElementInflow, GroundEffect, Inflow, Skew},
    seesaw::Seesaw,
    state::MAX_FLAPPING_BLADES,
    tip_loss::TipLoss,
};
use std::path::Path;
use thiserror::Error;

/// Why no rotor can be made from the parameters.
#[derive(Debug, Error, Clone, PartialEq)]
pub enum SetupError {
    #[error("airfoil.file = {name:?}: {cause}")]
    Airfoil { name: String, cause: AirfoilError },
    #[error("geometry.file = {name:?}: airfoil {airfoil}: {cause}")]
    StationAirfoil {
        name: String,
        /// Its name, and where else it was looked for.
        airfoil: String,
        cause: AirfoilError,
    },
    #[error(
        "models.lift = slopesByReynolds, but the airfoil file {airfoil:?} ({parameter}) has no lift slopes; set {parameter} to a Modelica CombiTable file such as airfoils/naca0015.txt, or models.lift to table or twoPi"
    )]
    NoLiftSlopes {
        airfoil: String,
        parameter: &'static str,
    },
    #[error("geometry.file = {name:?}: {cause}")]
    RotorFile { name: String, cause: RotorFileError },
    #[error("geometry.file = {name:?}: rotor file {problem}")]
    RotorFileValue {
        name: String,
        /// Beginning with the file and the line.
        problem: String,
    },
    #[error("the geometry parameters describe no rotor: {0}; change them or set geometry.file")]
    Geometry(GeometryError),
    #[error(
        "flapping.enabled = true with {blades} blades: at most {MAX_FLAPPING_BLADES} can flap; set fewer blades, or flapping.enabled to false"
    )]
    TooManyFlappingBlades { blades: u32 },
    #[error(
        "flapping.enabled = true with models.blades = disc: the average over one revolution has no blades that could flap; set models.blades to automatic or individual"
    )]
    DiscCannotFlap,
    #[error(
        "flapping.enabled = true with models.inflow = annulusClosedForm, which holds for axial flow past rigid blades only; set another inflow model, or flapping.enabled to false"
    )]
    ClosedFormCannotFlap,
    #[error(
        "models.groundEffect with models.inflow = annulusClosedForm, which holds in free air only; set another inflow model, or models.groundEffect to none"
    )]
    ClosedFormNearGround,
    #[error(
        "flapping.precone = {precone} rad lies beyond the stops of the blades, flapping.lowestAngle = {lowest} rad and flapping.highestAngle = {highest} rad; set it between them, or move the stops"
    )]
    PreconeBeyondStops {
        precone: f64,
        lowest: f64,
        highest: f64,
    },
    #[error(
        "flapping.hub = teetering with {blades} blades: a seesaw has two; set two blades, or flapping.hub to hinged"
    )]
    SeesawBlades { blades: u32 },
    #[error(
        "flapping.hub = teetering with flapping.hingeOffset = {offset}: the hinge of a seesaw is at the shaft; set flapping.hingeOffset to 0, or flapping.hub to hinged"
    )]
    SeesawOffset { offset: f64 },
    #[error("{name} = {value}, which is not the number of a choice; set one of its choices")]
    Choice { name: &'static str, value: i32 },
}

/// The rotor that the parameters describe, and every file that was read, a rotor file first. With
/// `defaults`, which are the values of a rotor of which nothing is set, `values` gets what the
/// rotor file gives for variables that the importer has not set.
pub fn rotor(
    values: &mut Values,
    defaults: Option<&Values>,
    resources: &Path,
) -> Result<(Rotor, Vec<ReadFile>), SetupError> {
    let mut files = Vec::new();
    let geometry = geometry(values, defaults, resources, &mut files)?;
    let values = &*values;
    let section = section(values)?;
    let airfoils = read_airfoils(values, &geometry, section.lift, resources, &mut files)?;
    // The range of the variable keeps the number of elements positive.
    let count = values.integers[integer::NUMERICS__ELEMENTS].max(1) as usize;
    let elements = Elements::new(&geometry, count);
    let models = models(values, &geometry, &elements, section)?;
    Ok((Rotor::new(geometry, elements, airfoils, models), files))
}

/// The geometry in the rotor file or, without one, that of the geometry parameters.
fn geometry(
    values: &mut Values,
    defaults: Option<&Values>,
    resources: &Path,
    files: &mut Vec<ReadFile>,
) -> Result<Geometry, SetupError> {
    let name = values.strings[string::GEOMETRY__FILE].as_str();
    if !name.is_empty() {
        let path = resolve(resources, "rotors", name);
        let name = name.to_owned();
        let definition = match resource_files::rotor(&path) {
            Ok(read) => read,
            Err(cause) => return Err(SetupError::RotorFile { name, cause }),
        };
        let taken = match defaults {
            Some(defaults) => rotor_file::apply(values, defaults, &definition, &path)?,
            None => Taken::default(),
        };
        let hash = definition.hash;
        files.push(ReadFile {
            content: FileHash { name, hash },
            path,
            what: "read the rotor's geometry".to_owned(),
            details: taken.note(),
        });
        return Ok(definition.geometry);
    }
    let mut geometry = Geometry::linear(
        values.integers[integer::GEOMETRY__NUMBER_OF_BLADES].max(0) as u32,
        values.reals[real::GEOMETRY__RADIUS],
        values.reals[real::GEOMETRY__ROOT_CUTOUT],
        values.reals[real::GEOMETRY__CHORD],
        values.reals[real::GEOMETRY__TAPER_RATIO],
        values.reals[real::GEOMETRY__TWIST],
    );
    geometry.pitch_reference_radius = values.reals[real::GEOMETRY__PITCH_REFERENCE_RADIUS];
    geometry.rotation = match choice(values, integer::GEOMETRY__ROTATION, Rotation::from_integer)? {
        Rotation::CounterClockwise => geometry::Rotation::CounterClockwise,
        Rotation::Clockwise => geometry::Rotation::Clockwise,
    };
    geometry.check().map_err(SetupError::Geometry)?;
    Ok(geometry)
}

/// The models that the parameters choose. Fails if they cannot be combined.
fn models(
    values: &Values,
    geometry: &Geometry,
    elements: &Elements,
    section: SectionModel,
) -> Result<Models, SetupError> {
    let inflow = inflow(values, geometry, elements)?;
    let ground_effect = ground_effect(values)?;
    if inflow.is_axial_only() && ground_effect != GroundEffect::None {
        return Err(SetupError::ClosedFormNearGround);
    }
    let blades = blades(values)?;
    Ok(Models {
        hinge: hinge(values, geometry, &inflow, blades)?,
        seesaw: seesaw(values, geometry)?,
        inflow,
        descent: descent(values)?,
        ground_effect,
        blades,
        tip_loss: tip_loss(values)?,
        section,
    })
}

fn inflow(values: &Values, geometry: &Geometry, elements: &Elements) -> Result<Inflow, SetupError> {
    let model = choice(values, integer::MODELS__INFLOW, InflowModel::from_integer)?;
    Ok(match model {
        InflowModel::Annulus => Inflow::Elements(ElementInflow::Annulus),
        InflowModel::AnnulusClosedForm => Inflow::Elements(ElementInflow::AnnulusClosedForm),
        InflowModel::Uniform => Inflow::Linear(Skew::Uniform),
        InflowModel::Coleman => Inflow::Linear(Skew::Coleman),
        InflowModel::Drees => Inflow::Linear(Skew::Drees),
        InflowModel::Payne => Inflow::Linear(Skew::Payne),
        InflowModel::WhiteBlake => Inflow::Linear(Skew::WhiteBlake),
        InflowModel::PittPeters => Inflow::Linear(Skew::PittPeters),
        InflowModel::Howlett => Inflow::Linear(Skew::Howlett),
        InflowModel::GlauertHighSpeed => Inflow::Linear(Skew::GlauertHighSpeed),
        InflowModel::FiniteBlades => Inflow::Elements(ElementInflow::FiniteBlades),
        InflowModel::PittPetersDynamic => Inflow::PittPetersDynamic,
        // The range of the variable keeps the order positive.
        InflowModel::PetersHe => Inflow::peters_he(
            values.integers[integer::NUMERICS__INFLOW_ORDER].max(1) as usize,
            geometry.blades as usize,
            &elements.radius_ratios(geometry.radius),
        ),
    })
}

fn descent(values: &Values) -> Result<Descent, SetupError> {
    let model = choice(values, integer::MODELS__DESCENT, DescentModel::from_integer)?;
    Ok(match model {
        DescentModel::Momentum => Descent::Momentum,
        DescentModel::Measured => Descent::Measured,
        DescentModel::Johnson => Descent::Johnson,
    })
}

fn ground_effect(values: &Values) -> Result<GroundEffect, SetupError> {
    let model = choice(
        values,
        integer::MODELS__GROUND_EFFECT,
        GroundEffectModel::from_integer,
    )?;
    Ok(match model {
        GroundEffectModel::None => GroundEffect::None,
        GroundEffectModel::CheesemanBennett => GroundEffect::CheesemanBennett,
        GroundEffectModel::Hayden => GroundEffect::Hayden,
    })
}

fn blades(values: &Values) -> Result<Blades, SetupError> {
    let model = choice(values, integer::MODELS__BLADES, BladesModel::from_integer)?;
    Ok(match model {
        BladesModel::Automatic => Blades::Automatic,
        BladesModel::Disc => Blades::Disc,
        BladesModel::Individual => Blades::Individual,
    })
}

fn tip_loss(values: &Values) -> Result<TipLoss, SetupError> {
    let model = choice(
        values,
        integer::MODELS__TIP_LOSS,
        TipLossModel::from_integer,
    )?;
    Ok(match model {
        TipLossModel::None => TipLoss::None,
        TipLossModel::Prandtl => TipLoss::Prandtl,
        TipLossModel::PrandtlTipAndRoot => TipLoss::PrandtlTipAndRoot,
        // Both authors have the same formula.
        TipLossModel::GessowMyers | TipLossModel::Wheatley => TipLoss::HalfTipChord,
        TipLossModel::Sissingh => TipLoss::Sissingh,
        TipLossModel::PrandtlThrust => TipLoss::PrandtlThrust,
    })
}

/// How section coefficients are made from the airfoil data.
fn section(values: &Values) -> Result<SectionModel, SetupError> {
    let lift = choice(values, integer::MODELS__LIFT, LiftModel::from_integer)?;
    let compressibility = choice(
        values,
        integer::MODELS__COMPRESSIBILITY,
        CompressibilityModel::from_integer,
    )?;
    Ok(SectionModel {
        lift: match lift {
            LiftModel::Table => Lift::Table,
            LiftModel::TwoPi => Lift::TwoPi,
            LiftModel::SlopesByReynolds => Lift::SlopesByReynolds,
        },
        compressibility: match compressibility {
            CompressibilityModel::None => Compressibility::None,
            CompressibilityModel::PrandtlGlauert => Compressibility::PrandtlGlauert,
            CompressibilityModel::KarmanTsien => Compressibility::KarmanTsien,
            CompressibilityModel::Laitone => Compressibility::Laitone,
        },
        drag_reynolds_exponent: values.reals[real::AIRFOIL__DRAG_REYNOLDS_EXPONENT],
    })
}

/// The flapping hinges. Fails if the blades flap and the other models do not allow it.
fn hinge(
    values: &Values,
    geometry: &Geometry,
    inflow: &Inflow,
    blades: Blades,
) -> Result<Hinge, SetupError> {
    let reals = &values.reals;
    let offset = reals[real::FLAPPING__HINGE_OFFSET] * geometry.radius;
    let length = geometry.radius - offset;
    let mass = BladeMass::rod(blade_inertia(values, geometry), length);
    let freedom = values.booleans[boolean::FLAPPING__ENABLED].then(|| Freedom {
        pitch_flap: libm::tan(reals[real::FLAPPING__DELTA3]),
        length,
        stops: Stops {
            lowest: reals[real::FLAPPING__LOWEST_ANGLE],
            highest: reals[real::FLAPPING__HIGHEST_ANGLE],
        },
    });
    let precone = reals[real::FLAPPING__PRECONE];
    if let Some(freedom) = freedom {
        if freedom.stops.excess(precone) > 0.0 {
            let Stops { lowest, highest } = freedom.stops;
            return Err(SetupError::PreconeBeyondStops {
                precone,
                lowest,
                highest,
            });
        }
        if geometry.blades as usize > MAX_FLAPPING_BLADES {
            let blades = geometry.blades;
            return Err(SetupError::TooManyFlappingBlades { blades });
        }
        if blades == Blades::Disc {
            return Err(SetupError::DiscCannotFlap);
        }
        if inflow.is_axial_only() {
            return Err(SetupError::ClosedFormCannotFlap);
        }
    }
    Ok(Hinge {
        offset,
        precone,
        mass,
        freedom,
    })
}

/// The seesaw of blades that flap as one. Fails if the rotor cannot have one.
fn seesaw(values: &Values, geometry: &Geometry) -> Result<Option<Seesaw>, SetupError> {
    let hub = choice(values, integer::FLAPPING__HUB, HubModel::from_integer)?;
    match hub {
        HubModel::Hinged => return Ok(None),
        HubModel::Teetering if !values.booleans[boolean::FLAPPING__ENABLED] => return Ok(None),
        HubModel::Teetering => {}
    }
    let blades = geometry.blades;
    if blades != 2 {
        return Err(SetupError::SeesawBlades { blades });
    }
    let offset = values.reals[real::FLAPPING__HINGE_OFFSET];
    if offset != 0.0 {
        return Err(SetupError::SeesawOffset { offset });
    }
    let undersling = values.reals[real::FLAPPING__UNDERSLING];
    Ok(Some(Seesaw { undersling }))
}

/// The moment of inertia of one blade about its hinge, kg.m2: from the parameters, otherwise from
/// the rotor file, otherwise in proportion to the default rotor's.
fn blade_inertia(values: &Values, geometry: &Geometry) -> f64 {
    let inertia = values.reals[real::FLAPPING__INERTIA];
    let number = values.reals[real::FLAPPING__LOCK_NUMBER];
    let known_from = if inertia > 0.0 {
        BladeInertia::Moment(inertia)
    } else if number > 0.0 {
        BladeInertia::LockNumber(number)
    } else {
        geometry.inertia.unwrap_or(BladeInertia::LikeDefaultRotor)
    };
    known_from.moment(geometry)
}

/// A warning if the inertia of the blades is given twice.
pub fn unused_lock_number(values: &Values) -> Option<String> {
    let inertia = values.reals[real::FLAPPING__INERTIA];
    let number = values.reals[real::FLAPPING__LOCK_NUMBER];
    (inertia > 0.0 && number > 0.0).then(|| {
        format!(
            "flapping.inertia = {inertia} kg.m2 and flapping.lockNumber = {number} both give the inertia of the blades, and flapping.inertia is used; set one of them to 0"
        )
    })
}

/// How the rotor starts.
pub fn start(values: &Values) -> Result<Start, SetupError> {
    let start = choice(
        values,
        integer::INITIALIZATION,
        Initialization::from_integer,
    )?;
    Ok(match start {
        Initialization::Steady => Start::Steady,
        Initialization::Rest => Start::Rest,
    })
}

/// The value of an enumeration variable as the Rust enumeration `T`.
pub fn choice<T>(
    values: &Values,
    reference: IntegerRef,
    from_integer: fn(i32) -> Option<T>,
) -> Result<T, SetupError> {
    let value = values.integers[reference];
    let name = reference.variable().name;
    from_integer(value).ok_or(SetupError::Choice { name, value })
}

#[cfg(test)]
mod tests {
    use super::super::{BlockError, Note, RotorBlock, flight_condition::FlightCondition};
    use super::*;
    use std::f64::consts::PI;

    const RESOURCES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/modelDescription/resources");

    type TestResult = Result<(), Box<dyn std::error::Error>>;

    fn flapping_block(file: &str) -> Result<RotorBlock, Box<dyn std::error::Error>> {
        let mut block = RotorBlock::new(RESOURCES.into());
        block.set_booleans(&[boolean::FLAPPING__ENABLED], &[1])?;
        block.set_strings(&[string::GEOMETRY__FILE], &[file])?;
        Ok(block)
    }

    fn inertia(block: &mut RotorBlock) -> Result<f64, BlockError> {
        Ok(block.rotor()?.models().hinge.mass.inertia)
    }

    #[test]
    fn a_parameter_wins_over_the_file_and_the_file_over_the_default() -> TestResult {
        for (file, moment, number, expected) in [
            ("", 0.0, 0.0, 0.05),
            ("", 0.02, 0.0, 0.02),
            ("", 0.0, 2.391_831_6, 0.05),
            ("pca-2.toml", 0.0, 0.0, 452.8),
            ("pca-2.toml", 300.0, 0.0, 300.0),
            ("pca-2.toml", 0.0, 19.058, 452.8),
            (
                "caradonna-tung.toml",
                0.0,
                0.0,
                0.05 * (0.1905 / 0.0508) * 5.0625,
            ),
        ] {
            let mut block = flapping_block(file)?;
            let references = [real::FLAPPING__INERTIA, real::FLAPPING__LOCK_NUMBER];
            block.set_reals(&references, &[moment, number])?;
            let found = inertia(&mut block)?;
            assert!((found / expected - 1.0).abs() < 1e-4, "{file}: {found}");
        }
        let default = inertia(&mut flapping_block("")?)?;
        assert_eq!(default.to_bits(), 0.05_f64.to_bits());
        let mut block = flapping_block("")?;
        let references = [real::FLAPPING__INERTIA, real::FLAPPING__LOCK_NUMBER];
        block.set_reals(&references, &[0.02, 8.0])?;
        assert_eq!(inertia(&mut block)?, 0.02);
        let notes = block.take_notes();
        let is_warning = |note: &Note| matches!(note, Note::Warning(text) if text.contains("flapping.inertia is used"));
        assert!(notes.iter().any(is_warning), "{notes:?}");
        Ok(())
    }

    /// With nothing set but flapping, rotors of all sizes take about as many steps in 10 ms as the
    /// default rotor, and start in a periodic state instead of at rest.
    #[test]
    fn blades_of_any_size_flap_at_the_cost_of_the_default_rotor() -> TestResult {
        let steps = |block: &mut RotorBlock| -> Result<f64, Box<dyn std::error::Error>> {
            block.start()?;
            let point = FlightCondition::new(block.values())?.point;
            let rotor = block.rotor()?;
            Ok(rotor.division(&point, &block.memory.state, 0.01).plain)
        };
        let default = steps(&mut flapping_block("")?)?;
        let mut large = flapping_block("")?;
        let references = [real::GEOMETRY__RADIUS, real::GEOMETRY__CHORD, real::RPM];
        large.set_reals(&references, &[7.3, 0.53, 324.0])?;
        for (name, mut block) in [
            ("pca-2.toml", flapping_block("pca-2.toml")?),
            ("radius 7.3 m", large),
            ("thesis.toml", flapping_block("thesis.toml")?),
        ] {
            let found = steps(&mut block)?;
            assert!(found <= 5.0 * default, "{name}: {found}, default {default}");
            let coning = real::CONING;
            let start = block.values().reals[coning];
            assert!(start.abs() > 1e-3, "{name} starts at rest: {start}");
            // After a blade passage each blade is where the next one was.
            let passage = 60.0 / block.values().reals[real::RPM] / 4.0;
            let before = block.memory.state.flaps;
            block.step(passage)?;
            let after = block.memory.state.flaps;
            for (k, flap) in after.iter().enumerate().take(4) {
                let change = (flap.angle - before[(k + 1) % 4].angle).abs();
                assert!(change < 1e-6 * PI, "{name}: {change:e}");
            }
        }
        Ok(())
    }
}
