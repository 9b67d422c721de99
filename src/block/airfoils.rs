//! Reads the airfoil files of a rotor.

use super::{
    files::{FileHash, ReadFile},
    location::resolve,
    resource_files,
    setup::SetupError,
    values::Values,
    variables::string,
};
use rotor::{
    airfoil::{Airfoil, Lift},
    geometry::Geometry,
};
use std::path::Path;

/// The airfoils in the FMU with the names by which `airfoil.file` finds them; those that cannot be
/// read are left out.
pub fn shipped(resources: &Path) -> Vec<(String, Airfoil)> {
    let airfoils = resource_files::names(resources, "airfoils").into_iter();
    let airfoils = airfoils.filter_map(|name| {
        let name = format!("airfoils/{name}");
        let (airfoil, _) = resource_files::airfoil(&resources.join(&name)).ok()?;
        Some((name, airfoil))
    });
    airfoils.collect()
}

/// Reads the airfoils of a geometry, in its order. A station without an airfoil of its own has the
/// airfoil of the parameter `airfoil.file`. `files` gets every file.
pub fn read_airfoils(
    values: &Values,
    geometry: &Geometry,
    lift: Lift,
    resources: &Path,
    files: &mut Vec<ReadFile>,
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
        let (airfoil, hash) = resource_files::airfoil(&path).map_err(|cause| {
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
        files.push(ReadFile {
            content: FileHash {
                name: name.to_owned(),
                hash,
            },
            path,
            what: format!("read airfoil {:?}", airfoil.name()),
        });
        airfoils.push(airfoil);
    }
    Ok(airfoils)
}
