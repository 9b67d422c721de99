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
/// airfoil of the parameter `airfoil.file`. What a rotor file names is looked for beside that file
/// first. `files` begins with the rotor file, if there is one, and gets every file.
pub fn read_airfoils(
    values: &Values,
    geometry: &Geometry,
    lift: Lift,
    resources: &Path,
    files: &mut Vec<ReadFile>,
) -> Result<Vec<Airfoil>, SetupError> {
    // The first file is the rotor file, if there is one.
    let folder = files.first().and_then(|file| file.path.parent());
    let folder = folder.map(Path::to_path_buf);
    let mut airfoils = Vec::with_capacity(geometry.airfoils.len());
    for station in &geometry.airfoils {
        let has_own = !station.is_empty();
        let name = if has_own {
            station
        } else {
            &values.strings[string::AIRFOIL__FILE]
        };
        let is_of_file = has_own || values.from_file.gave(string::AIRFOIL__FILE);
        let folder = folder.as_deref().filter(|_| is_of_file);
        let beside = folder.map(|folder| folder.join(name));
        let path = match beside.filter(|path| resource_files::is_file(path)) {
            Some(path) => path,
            None => resolve(resources, "airfoils", name),
        };
        let (airfoil, hash) = resource_files::airfoil(&path).map_err(|cause| {
            if has_own {
                SetupError::StationAirfoil {
                    name: values.strings[string::GEOMETRY__FILE].clone(),
                    airfoil: format!("{name:?} of a station{}", place(folder, &path)),
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
            details: String::new(),
        });
        airfoils.push(airfoil);
    }
    Ok(airfoils)
}

/// Where an airfoil file that does not exist was looked for besides `path`, as a part of a
/// sentence.
fn place(folder: Option<&Path>, path: &Path) -> String {
    match folder {
        Some(folder) if !path.is_file() => {
            format!(
                ", which is not beside the rotor file in {} either",
                folder.display()
            )
        }
        _ => String::new(),
    }
}
