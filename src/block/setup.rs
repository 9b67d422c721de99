//! From the parameters to a rotor: geometry, airfoils and the choice of models.

use super::{
    location::resolve,
    values::Values,
    variables::{
        BladesModel, CompressibilityModel, DescentModel, GroundEffectModel, InflowModel,
        Initialization, IntegerRef, LiftModel, Rotation, TipLossModel, boolean, integer, real,
        string,
    },
};
use rotor::{
    Blades, Models, Rotor, Start,
    airfoil::{Airfoil, AirfoilError, Lift, SectionModel},
    compressibility::Compressibility,
    flapping::{Freedom, Hinge},
    geometry::{self, Elements, Geometry, GeometryError, RotorFileError},
    inflow::{Descent, ElementInflow, GroundEffect, Inflow, Skew},
    state::MAX_FLAPPING_BLADES,
    tip_loss::TipLoss,
};
use std::path::Path;
use thiserror::Error;

/// Why the parameters make no rotor.
#[derive(Debug, Error, Clone, PartialEq)]
pub enum SetupError {
    #[error("airfoil.file = {name:?}: {cause}")]
    Airfoil { name: String, cause: AirfoilError },
    #[error("geometry.file = {name:?}: airfoil {airfoil:?} of a station: {cause}")]
    StationAirfoil {
        name: String,
        airfoil: String,
        cause: AirfoilError,
    },
    #[error(
        "models.lift = slopesByReynolds, but the airfoil file {airfoil:?} ({parameter}) has no lift slopes; set {parameter} to a Modelica CombiTable file such as airfoils/naca0015.txt, or models.lift to table or twoPi"
    )]
    NoLaws {
        airfoil: String,
        parameter: &'static str,
    },
    #[error("geometry.file = {name:?}: {cause}")]
    RotorFile { name: String, cause: RotorFileError },
    #[error("the geometry parameters make no rotor: {0}; change them or set geometry.file")]
    Geometry(GeometryError),
    #[error(
        "flapping.enabled = true with {blades} blades: at most {MAX_FLAPPING_BLADES} can flap; set fewer blades, or flapping.enabled to false"
    )]
    TooManyToFlap { blades: u32 },
    #[error(
        "flapping.enabled = true with models.blades = disc: a mean over a turn has no blade to flap; set models.blades to automatic or individual"
    )]
    DiscCannotFlap,
    #[error(
        "flapping.enabled = true with models.inflow = annulusClosedForm, which knows axial flow past rigid blades only; set another inflow model, or flapping.enabled to false"
    )]
    ClosedFormCannotFlap,
    #[error(
        "models.groundEffect with models.inflow = annulusClosedForm, which knows free air only; set another inflow model, or models.groundEffect to none"
    )]
    ClosedFormKnowsNoGround,
    #[error("{name} holds the value {value}, which is no choice")]
    Choice { name: &'static str, value: i32 },
}

/// The rotor that the parameters describe, and a sentence for every file that was read.
pub fn rotor(values: &Values, resources: &Path) -> Result<(Rotor, Vec<String>), SetupError> {
    let mut notes = Vec::new();
    let geometry = shape(values, resources, &mut notes)?;
    let standard = values.strings[string::AIRFOIL__FILE].as_str();
    let lift = choice(values, integer::MODELS__LIFT, LiftModel::from_integer)?;
    let mut airfoils = Vec::with_capacity(geometry.airfoils.len());
    for station_airfoil in &geometry.airfoils {
        let own = !station_airfoil.is_empty();
        let name = if own { station_airfoil } else { standard };
        let path = resolve(resources, "airfoils", name);
        let airfoil = Airfoil::read(&path).map_err(|cause| {
            if own {
                SetupError::StationAirfoil {
                    name: values.strings[string::GEOMETRY__FILE].clone(),
                    airfoil: name.to_owned(),
                    cause,
                }
            } else {
                SetupError::Airfoil {
                    name: name.to_owned(),
                    cause,
                }
            }
        })?;
        if lift == LiftModel::SlopesByReynolds && !airfoil.has_laws() {
            return Err(SetupError::NoLaws {
                airfoil: name.to_owned(),
                parameter: if own {
                    "a station's airfoil in geometry.file"
                } else {
                    "airfoil.file"
                },
            });
        }
        notes.push(format!(
            "read airfoil {:?} from {}",
            airfoil.name(),
            path.display()
        ));
        airfoils.push(airfoil);
    }
    // The range check of the table keeps the number of elements positive.
    let count = values.integers[integer::NUMERICS__ELEMENTS].max(1) as usize;
    let elements = Elements::new(&geometry, count);
    let models = models(values, &geometry, &elements)?;
    Ok((Rotor::new(geometry, elements, airfoils, models), notes))
}

/// How the blades are held, and whether they can be as the other models have it.
fn hinge(
    values: &Values,
    geometry: &Geometry,
    inflow: &Inflow,
    blades: Blades,
) -> Result<Hinge, SetupError> {
    let reals = &values.reals;
    let offset = reals[real::FLAPPING__HINGE_OFFSET] * geometry.radius;
    let freedom = values.booleans[boolean::FLAPPING__ENABLED].then(|| Freedom {
        inertia: reals[real::FLAPPING__INERTIA],
        pitch_flap: libm::tan(reals[real::FLAPPING__DELTA3]),
        length: geometry.radius - offset,
    });
    if freedom.is_some() {
        if geometry.blades as usize > MAX_FLAPPING_BLADES {
            let blades = geometry.blades;
            return Err(SetupError::TooManyToFlap { blades });
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
        precone: reals[real::FLAPPING__PRECONE],
        freedom,
    })
}

fn shape(
    values: &Values,
    resources: &Path,
    notes: &mut Vec<String>,
) -> Result<Geometry, SetupError> {
    let name = values.strings[string::GEOMETRY__FILE].as_str();
    if !name.is_empty() {
        let path = resolve(resources, "rotors", name);
        let geometry = Geometry::read(&path).map_err(|cause| SetupError::RotorFile {
            name: name.to_owned(),
            cause,
        })?;
        notes.push(format!("read the rotor's geometry from {}", path.display()));
        return Ok(geometry);
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

fn models(values: &Values, geometry: &Geometry, elements: &Elements) -> Result<Models, SetupError> {
    let inflow = match choice(values, integer::MODELS__INFLOW, InflowModel::from_integer)? {
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
        // The range check of the table keeps the order positive.
        InflowModel::PetersHe => Inflow::peters_he(
            values.integers[integer::NUMERICS__INFLOW_ORDER].max(1) as usize,
            geometry.blades as usize,
            &elements.radius_ratios(geometry.radius),
        ),
    };
    let ground = choice(
        values,
        integer::MODELS__GROUND_EFFECT,
        GroundEffectModel::from_integer,
    )?;
    let ground_effect = match ground {
        GroundEffectModel::None => GroundEffect::None,
        GroundEffectModel::CheesemanBennett => GroundEffect::CheesemanBennett,
        GroundEffectModel::Hayden => GroundEffect::Hayden,
    };
    if inflow.is_axial_only() && ground_effect != GroundEffect::None {
        return Err(SetupError::ClosedFormKnowsNoGround);
    }
    let blades = match choice(values, integer::MODELS__BLADES, BladesModel::from_integer)? {
        BladesModel::Automatic => Blades::Automatic,
        BladesModel::Disc => Blades::Disc,
        BladesModel::Individual => Blades::Individual,
    };
    Ok(Models {
        hinge: hinge(values, geometry, &inflow, blades)?,
        inflow,
        descent: match choice(values, integer::MODELS__DESCENT, DescentModel::from_integer)? {
            DescentModel::Momentum => Descent::Momentum,
            DescentModel::Measured => Descent::Measured,
            DescentModel::Johnson => Descent::Johnson,
        },
        ground_effect,
        blades,
        tip_loss: match choice(
            values,
            integer::MODELS__TIP_LOSS,
            TipLossModel::from_integer,
        )? {
            TipLossModel::None => TipLoss::None,
            TipLossModel::Prandtl => TipLoss::Prandtl,
            TipLossModel::PrandtlTipAndRoot => TipLoss::PrandtlTipAndRoot,
            TipLossModel::GessowMyers | TipLossModel::Wheatley => TipLoss::HalfTipChord,
            TipLossModel::Sissingh => TipLoss::Sissingh,
            TipLossModel::PrandtlThrust => TipLoss::PrandtlThrust,
        },
        section: SectionModel {
            lift: match choice(values, integer::MODELS__LIFT, LiftModel::from_integer)? {
                LiftModel::Table => Lift::Table,
                LiftModel::TwoPi => Lift::TwoPi,
                LiftModel::SlopesByReynolds => Lift::SlopesByReynolds,
            },
            compressibility: match choice(
                values,
                integer::MODELS__COMPRESSIBILITY,
                CompressibilityModel::from_integer,
            )? {
                CompressibilityModel::None => Compressibility::None,
                CompressibilityModel::PrandtlGlauert => Compressibility::PrandtlGlauert,
                CompressibilityModel::KarmanTsien => Compressibility::KarmanTsien,
                CompressibilityModel::Laitone => Compressibility::Laitone,
            },
            drag_reynolds_exponent: values.reals[real::AIRFOIL__DRAG_REYNOLDS_EXPONENT],
        },
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

/// The enumeration's value behind an integer variable.
pub fn choice<T>(
    values: &Values,
    reference: IntegerRef,
    from_integer: fn(i32) -> Option<T>,
) -> Result<T, SetupError> {
    let value = values.integers[reference];
    let name = reference.variable().name;
    from_integer(value).ok_or(SetupError::Choice { name, value })
}
