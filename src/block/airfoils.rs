//! Reads the airfoil files of a rotor.

use super::{location::resolve, setup::SetupError, values::Values, variables::string};
use rotor::{
    airfoil::{Airfoil, Lift},
    geometry::Geometry,
};
use std::path::Path;

/// Reads the airfoils of a geometry, in its order. A station without an airfoil of its own has the
/// airfoil of the parameter `airfoil.file`. `notes` gets a sentence for every file.
pub fn read_airfoils(
    values: &Values,
    geometry: &Geometry,
    lift: Lift,
    resources: &Path,
    notes: &mut Vec<String>,
) -> Result<Vec<Airfoil>, SetupError> {
    let mut airfoils = Vec::with_capacity(geometry.airfoils.len());
    for station in &geometry.airfoils {
        let has_own = !station.is_empty();
        let name = if has_own {
            station
        } else {
            &values.strings[string::AIRFOIL__FILE]
        };
        let path = resolve(resources, "airfoils", name);
        let airfoil = Airfoil::read(&path).map_err(|cause| {
            if has_own {
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
        if lift == Lift::SlopesByReynolds && !airfoil.has_laws() {
            return Err(SetupError::NoLiftSlopes {
                airfoil: name.to_owned(),
                parameter: if has_own {
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
    Ok(airfoils)
}
