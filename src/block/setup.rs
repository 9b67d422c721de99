//! From the parameters to a rotor: geometry, airfoils and the choice of models.

use super::{
    location::resolve,
    values::Values,
    variables::{
        CompressibilityModel, InflowModel, LiftModel, Rotation, TipLossModel, integer, real, string,
    },
};
use crate::rotor::{
    Models, Rotor,
    airfoil::{Airfoil, AirfoilError, Lift, SectionModel},
    compressibility::Compressibility,
    geometry::{self, Geometry, GeometryError, RotorFileError},
    inflow::{Inflow, Skew},
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
    #[error("geometry.file = {name:?}: {cause}")]
    RotorFile { name: String, cause: RotorFileError },
    #[error("the geometry parameters make no rotor: {0}; change them or set geometry.file")]
    Geometry(GeometryError),
    #[error("{name} holds the value {value}, which is no choice")]
    Choice { name: &'static str, value: i32 },
}

/// The rotor that the parameters describe, and a sentence for every file that was read.
pub fn rotor(values: &Values, resources: &Path) -> Result<(Rotor, Vec<String>), SetupError> {
    let mut notes = Vec::new();
    let geometry = shape(values, resources, &mut notes)?;
    let standard = values.strings[string::AIRFOIL__FILE].as_str();
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
        notes.push(format!(
            "read airfoil {:?} from {}",
            airfoil.name(),
            path.display()
        ));
        airfoils.push(airfoil);
    }
    // The range check of the table keeps the number of elements positive.
    let elements = values.integers[integer::NUMERICS__ELEMENTS].max(1) as usize;
    Ok((
        Rotor::new(geometry, airfoils, models(values)?, elements),
        notes,
    ))
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

fn models(values: &Values) -> Result<Models, SetupError> {
    Ok(Models {
        inflow: match choice(values, integer::MODEL__INFLOW, InflowModel::from_integer)? {
            InflowModel::Annulus => Inflow::Annulus,
            InflowModel::AnnulusClosedForm => Inflow::AnnulusClosedForm,
            InflowModel::Uniform => Inflow::Disc(Skew::Uniform),
            InflowModel::Coleman => Inflow::Disc(Skew::Coleman),
            InflowModel::Drees => Inflow::Disc(Skew::Drees),
            InflowModel::Payne => Inflow::Disc(Skew::Payne),
            InflowModel::WhiteBlake => Inflow::Disc(Skew::WhiteBlake),
            InflowModel::PittPeters => Inflow::Disc(Skew::PittPeters),
            InflowModel::Howlett => Inflow::Disc(Skew::Howlett),
            InflowModel::PittPetersDynamic => Inflow::PittPetersDynamic,
        },
        tip_loss: match choice(values, integer::MODEL__TIP_LOSS, TipLossModel::from_integer)? {
            TipLossModel::None => TipLoss::None,
            TipLossModel::Prandtl => TipLoss::Prandtl,
            TipLossModel::GessowMyers => TipLoss::GessowMyers,
        },
        section: SectionModel {
            lift: match choice(values, integer::MODEL__LIFT, LiftModel::from_integer)? {
                LiftModel::Table => Lift::Table,
                LiftModel::TwoPi => Lift::TwoPi,
            },
            compressibility: match choice(
                values,
                integer::MODEL__COMPRESSIBILITY,
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

/// The enumeration's value behind an integer variable.
pub fn choice<T>(
    values: &Values,
    place: usize,
    from_integer: fn(i32) -> Option<T>,
) -> Result<T, SetupError> {
    let value = values.integers[place];
    let name = super::variables::INTEGERS[place].name;
    from_integer(value).ok_or(SetupError::Choice { name, value })
}
