//! An .fmu whose defaults are those of one rotor: `resources/packaged.txt` names its rotor file and
//! its GUID. The program writes it, in the form of `settings`.

use super::{
    RotorBlock,
    from_file::FromFile,
    location::resolve,
    rotor_file, settings,
    setup::SetupError,
    values::Values,
    variables::{Rotation, StringRef, integer, real, string},
};
use rotor::geometry::{self, RotorDefinition};
use std::{
    fs::File,
    io::Read,
    path::{Path, PathBuf},
};

/// The file in the resources.
pub const FILE: &str = "packaged.txt";
/// The folder of the resources that holds the rotor file and what lies beside it.
pub const FOLDER: &str = "rotors";
/// Bytes of the longest such file.
const MAX_BYTES: u64 = 1 << 16;

/// What the file says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Packaged {
    /// The GUID in modelDescription.xml.
    pub guid: String,
    /// The GUID of the library, which is that of the general FMU: its variables are those of the
    /// description.
    pub library: String,
    /// The default of `geometry.file`.
    pub rotor: String,
}

impl Packaged {
    /// What the file in these resources says; none in the general FMU.
    pub fn read(resources: &Path) -> Option<Self> {
        let mut text = String::new();
        let file = File::open(resources.join(FILE)).ok()?;
        file.take(MAX_BYTES).read_to_string(&mut text).ok()?;
        let value = |name: &str| settings::value(&text, name).map(str::to_owned);
        Some(Self {
            guid: value("guid")?,
            library: value("library")?,
            rotor: value(string::GEOMETRY__FILE.variable().name)?,
        })
    }

    /// The text of the file.
    pub fn text(&self) -> String {
        let Self {
            guid,
            library,
            rotor,
        } = self;
        let file = string::GEOMETRY__FILE.variable().name;
        format!("guid = \"{guid}\";\nlibrary = \"{library}\";\n{file} = \"{rotor}\";\n")
    }
}

/// The default values of the FMU with these resources.
pub(super) fn defaults(resources: &Path) -> Values {
    let Some(packaged) = Packaged::read(resources) else {
        return Values::default();
    };
    let path = resolve(resources, FOLDER, &packaged.rotor);
    defaults_of(&path, &packaged.rotor).unwrap_or_else(|_| {
        // The error is told when the rotor is made.
        let mut values = Values::default();
        values.strings[string::GEOMETRY__FILE] = packaged.rotor;
        values
    })
}

/// The default values of an FMU whose `geometry.file` is `name`, which is the file at `path`.
pub fn defaults_of(path: &Path, name: &str) -> Result<Values, SetupError> {
    let definition = RotorDefinition::read(path).map_err(|cause| SetupError::RotorFile {
        name: name.to_owned(),
        cause,
    })?;
    let general = Values::default();
    let mut values = general.clone();
    name.clone_into(&mut values.strings[string::GEOMETRY__FILE]);
    rotor_file::apply(&mut values, &general, &definition, path)?;
    values.from_file = FromFile::default();
    let airfoil = string::AIRFOIL__FILE;
    if beside(path, &values.strings[airfoil]).is_some() && gives(&definition, airfoil) {
        // Found from the resources, as any value of this parameter is.
        values.strings[airfoil] = format!("{FOLDER}/{}", values.strings[airfoil]);
    }
    show_geometry(&mut values, &definition.geometry);
    Ok(values)
}

fn gives(definition: &RotorDefinition, text: StringRef) -> bool {
    let name = text.variable().name;
    definition.given.iter().any(|given| given.name == name)
}

/// The file of this name beside the rotor file at `path`, if there is one.
pub fn beside(path: &Path, name: &str) -> Option<PathBuf> {
    let file = path.parent()?.join(name);
    (!name.is_empty() && file.is_file()).then_some(file)
}

/// The geometry parameters as those of the rotor, which is that of the file: for the tools that
/// show them.
fn show_geometry(values: &mut Values, geometry: &geometry::Geometry) {
    let (Some(first), Some(last)) = (geometry.stations.first(), geometry.stations.last()) else {
        return;
    };
    let (cutout, root) = (first.radius_ratio, first.chord.max(1e-4));
    let twist = (last.twist - first.twist) / (1.0 - cutout);
    for (reference, value) in [
        (real::GEOMETRY__RADIUS, geometry.radius),
        (real::GEOMETRY__ROOT_CUTOUT, cutout),
        (real::GEOMETRY__CHORD, root),
        (real::GEOMETRY__TAPER_RATIO, last.chord / root),
        (real::GEOMETRY__TWIST, twist),
        (
            real::GEOMETRY__PITCH_REFERENCE_RADIUS,
            geometry.pitch_reference_radius,
        ),
    ] {
        let variable = reference.variable();
        values.reals[reference] = value.clamp(variable.min, variable.max);
    }
    values.integers[integer::GEOMETRY__NUMBER_OF_BLADES] = geometry.blades as i32;
    values.integers[integer::GEOMETRY__ROTATION] = match geometry.rotation {
        geometry::Rotation::CounterClockwise => Rotation::CounterClockwise,
        geometry::Rotation::Clockwise => Rotation::Clockwise,
    } as i32;
}

impl RotorBlock {
    /// The values of an instance of which nothing is set.
    pub fn defaults(&self) -> &Values {
        &self.defaults
    }
}
