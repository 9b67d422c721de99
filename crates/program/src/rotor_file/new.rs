//! `helicopter-rotor new FILE`: a commented rotor definition file from answers or options.

use super::block;
use crate::{
    Failure,
    draft::{Draft, place_of_file},
    failed, output,
    package::{self, own_rotor},
};
use clap::Args;
use helicopter_rotor::block::{packaged, variables::string};
use rotor::geometry::RotorDefinition;
use std::{
    fs,
    io::{self, BufRead, IsTerminal},
    path::{Path, PathBuf},
};

/// Writes a commented rotor definition file, to be edited.
///
/// In a terminal it asks for what no option gives; Enter takes the value in brackets. Otherwise it
/// takes these values. An existing file is not replaced.
#[derive(Args)]
pub struct New {
    /// The file to write (TOML)
    file: PathBuf,
    /// Name of the rotor
    #[arg(long)]
    name: Option<String>,
    /// Number of blades
    #[arg(long)]
    blades: Option<u32>,
    /// Rotor radius, m
    #[arg(long)]
    radius: Option<f64>,
    /// Radius r/R at which the blade begins
    #[arg(long)]
    cutout: Option<f64>,
    /// Chord at the cutout, m
    #[arg(long)]
    chord: Option<f64>,
    /// Chord at the tip, m
    #[arg(long)]
    tip_chord: Option<f64>,
    /// Twist from the shaft to the tip, deg; negative for washout
    #[arg(long, allow_hyphen_values = true)]
    twist: Option<f64>,
    /// CCW or CW, seen from above
    #[arg(long)]
    rotation: Option<String>,
    /// Airfoil file: a name in the FMU, or of a file beside the rotor file
    #[arg(long)]
    airfoil: Option<String>,
    /// Nominal rotor speed, rev/min
    #[arg(long)]
    rpm: Option<f64>,
    /// Nominal collective, deg
    #[arg(long, allow_hyphen_values = true)]
    collective: Option<f64>,
    /// Hub: rigid, hinged, teetering or hingeless
    #[arg(long)]
    hub: Option<String>,
    /// Lock number of the blades
    #[arg(long)]
    lock_number: Option<f64>,
    /// Precone, deg
    #[arg(long, allow_hyphen_values = true)]
    precone: Option<f64>,
    /// Distance of a teetering hinge above the point where the axes of the blades meet the shaft, m
    #[arg(long, allow_hyphen_values = true)]
    undersling: Option<f64>,
}

/// Lock number of blades with hinges: 8 to 10 (Johnson 1980, "Helicopter Theory", p. 186).
const USUAL_LOCK_NUMBER: f64 = 8.0;
/// Precone of a teetering rotor, deg: assumed.
const USUAL_PRECONE: f64 = 2.5;

impl New {
    pub fn run(self) -> Result<(), Failure> {
        if self.file.exists() {
            return Err(Failure(format!(
                "{} exists; remove it or write another file",
                self.file.display()
            )));
        }
        let file = self.file.clone();
        let mut questions = Questions {
            asks: io::stdin().is_terminal() && io::stdout().is_terminal(),
        };
        let text = self.text(&mut questions)?;
        let draft = Draft::new(place_of_file(&file)?)?;
        fs::write(draft.path(), text.as_bytes())
            .map_err(failed(format!("cannot write {}", file.display())))?;
        let missing = start(&draft.path(), &file).map_err(|Failure(problem)| {
            // The user knows nothing of the draft.
            let draft = draft.path().display().to_string();
            let problem = problem.replace(&draft, &file.display().to_string());
            Failure(format!(
                "these values describe no rotor ({problem}); nothing was written"
            ))
        })?;
        draft.publish()?;
        output::print(format_args!(
            "Wrote {0}; look at it with `helicopter-rotor check {0}`",
            file.display()
        ))?;
        if let Some(airfoil) = missing {
            output::note(format_args!(
                "The airfoil {airfoil:?} is neither beside the rotor file nor among those of the FMU; put it beside the file"
            ));
        }
        Ok(())
    }

    /// The content of the file.
    fn text(self, ask: &mut Questions) -> Result<String, Failure> {
        let name = ask.value("Name", self.name, "My rotor".to_owned())?;
        let blades = ask.value("Number of blades", self.blades, 2)?;
        let radius = ask.value("Radius, m", self.radius, 1.0)?;
        let cutout = ask.value("Radius r/R where the blade begins", self.cutout, 0.15)?;
        let chord = ask.value("Chord at the root, m", self.chord, rounded(radius * 0.07))?;
        let tip_chord = ask.value("Chord at the tip, m", self.tip_chord, chord)?;
        let twist = ask.value("Twist from shaft to tip, deg", self.twist, -8.0)?;
        let rotation = ask.value(
            "Rotation seen from above, CCW or CW",
            self.rotation,
            "CCW".into(),
        )?;
        let airfoil = ask.value(
            "Airfoil file",
            self.airfoil,
            "airfoils/naca0012.polar".to_owned(),
        )?;
        // A tip speed of 200 m/s.
        let rpm = ask.value("Nominal speed, rev/min", self.rpm, rounded(1910.0 / radius))?;
        let collective = ask.value("Nominal collective, deg", self.collective, 8.0)?;
        let hub = ask.value(
            "Hub: rigid, hinged, teetering or hingeless",
            self.hub,
            "rigid".into(),
        )?;
        let lock_number = if hub == "rigid" && self.lock_number.is_none() {
            USUAL_LOCK_NUMBER
        } else {
            ask.value("Lock number", self.lock_number, USUAL_LOCK_NUMBER)?
        };
        let is_teetering = hub == "teetering";
        let precone = if is_teetering {
            Some(ask.value("Precone, deg", self.precone, USUAL_PRECONE)?)
        } else {
            self.precone
        };
        let undersling = match (is_teetering, self.undersling) {
            (true, given) => {
                // The centre of mass of uniform blades, at half the radius, lies at the hinge.
                let balanced = rounded(0.5 * radius * precone.unwrap_or(0.0).to_radians());
                Some(ask.value("Undersling, m", given, balanced)?)
            }
            (false, None) => None,
            (false, Some(_)) => {
                return Err(Failure(format!(
                    "--undersling belongs to a teetering hub, and the hub is {hub}; leave it out, or give --hub teetering"
                )));
            }
        };
        let quoted = |text: &str| text.replace('\\', "\\\\").replace('"', "\\\"");
        let station = |r: f64, chord: f64| {
            format!(
                "    {{ r = {r}, chord = {chord}, twist = {} }},\n",
                rounded(twist * r)
            )
        };
        let entry = |text: String, comment: &str| format!("{text:<36} # {comment}\n");
        let mut text = String::from(
            "\
# A rotor for HelicopterRotor.fmu: set the parameter geometry.file to this file, or make an .fmu of
# its own with `helicopter-rotor package --rotor FILE --name NAME`. All angles are in degrees.
",
        );
        text += &entry(format!("name = \"{}\"", quoted(&name)), "free text");
        text += &entry("source = \"\"".into(), "where the numbers come from");
        text += "\n";
        text += &entry(
            format!("numberOfBlades = {blades}"),
            "1 to 20; at most 8 if they flap",
        );
        text += &entry(
            format!("radius = {radius:?}"),
            "m, from the shaft to the tip",
        );
        text += &entry(
            format!("rotation = \"{}\"", quoted(&rotation)),
            "CCW or CW, seen from above",
        );
        text += &entry(
            format!("rpm = {rpm:?}"),
            "nominal, rev/min, until the input rpm is set",
        );
        text += &entry(
            format!("collective = {collective:?}"),
            "nominal, until the input collective is set",
        );
        text += &entry(
            "pitchReferenceRadius = 0.75".into(),
            "r/R at which the pitch is the collective",
        );
        text += &entry(
            format!("airfoil = \"{}\"", quoted(&airfoil)),
            "a file beside this one, or in the FMU",
        );
        text += "
# From the cutout to the tip: r as r/R, chord in m. Only differences of twist count. With angle in
# its place the collective is added to the angles. Two stations at one r are a step. A station may
# name its own airfoil.
station = [
";
        text += &station(cutout, chord);
        text += &station(1.0, tip_chord);
        text += "]\n\n[flapping]\n";
        text += &entry(
            format!("hub = \"{}\"", quoted(&hub)),
            "rigid, hinged, teetering or hingeless",
        );
        text += &entry(
            format!("lockNumber = {lock_number:?}"),
            "rho a c R^4/I; or inertia, of one blade, kg.m2",
        );
        text += &match undersling {
            Some(undersling) => entry(
                format!("undersling = {undersling:?}"),
                "m, from where the blade axes meet up to the hinge",
            ),
            None => entry("# hingeOffset = 0.05".into(), "r/R"),
        };
        text += &if hub == "hingeless" {
            entry(
                "flapFrequency = 1.1".into(),
                "of the turning blade, per revolution: gives the spring",
            )
        } else {
            entry("# hingeSpring = 100.0".into(), "N.m/rad")
        };
        text += &match precone {
            Some(precone) => entry(format!("precone = {precone:?}"), "deg"),
            None => entry("# precone = 2.0".into(), "deg"),
        };
        text += &entry("# delta3 = 15.0".into(), "deg, pitch-flap coupling");
        text += &entry("# lowestAngle = -6.0".into(), "droop stop, deg");
        text += &entry("# highestAngle = 20.0".into(), "flap stop, deg");
        text += "
# Any of the parameters models.*, drive.* and numerics.* of the FMU:
[models]
# inflow = \"pittPeters\"

[drive]
# mode = \"torque\"
";
        text += &entry("# inertia = 1.0".into(), "of all that turns, kg.m2");
        Ok(text)
    }
}

/// Makes the rotor in a draft as the FMU does, and starts it. `file`: where the draft will lie. An
/// airfoil that is not there yet, which is returned, is replaced by one of the FMU.
fn start(draft: &Path, file: &Path) -> Result<Option<String>, Failure> {
    let definition = RotorDefinition::read(draft).map_err(|e| Failure(e.to_string()))?;
    let mut rotor = block(draft)?;
    let mut set = |reference, text: &str| {
        let set = rotor.set_strings(&[reference], &[text]);
        set.map_err(|e| Failure(e.to_string()))
    };
    let mut missing = None;
    for airfoil in own_rotor::airfoils(&definition) {
        // The draft lies in a folder of its own.
        if let Some(beside) = packaged::beside(file, airfoil) {
            let path = std::path::absolute(&beside)
                .map_err(failed(format!("cannot find {}", beside.display())))?;
            set(string::AIRFOIL__FILE, &path.to_string_lossy())?;
        } else if !own_rotor::is_in(&package::resources(), airfoil) {
            set(string::SETTINGS, "airfoil.file = airfoils/naca0012.polar")?;
            missing = Some(airfoil.to_owned());
        }
    }
    rotor.start().map_err(|e| Failure(e.to_string()))?;
    Ok(missing)
}

/// Three significant digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

/// Asks at the terminal, if there is one.
struct Questions {
    asks: bool,
}

impl Questions {
    /// The value that an option gives, the answer to a question, or the default.
    fn value<T: std::str::FromStr + std::fmt::Display>(
        &mut self,
        question: &str,
        option: Option<T>,
        default: T,
    ) -> Result<T, Failure> {
        if let Some(value) = option {
            return Ok(value);
        }
        if !self.asks {
            return Ok(default);
        }
        loop {
            output::print(format_args!("{question} [{default}]:"))?;
            let mut answer = String::new();
            let read = io::stdin().lock().read_line(&mut answer);
            if read.map_err(failed("cannot read the answer"))? == 0 {
                return Err(Failure("the answers ended; nothing was written".into()));
            }
            let answer = answer.trim();
            if answer.is_empty() {
                return Ok(default);
            }
            match answer.parse() {
                Ok(value) => return Ok(value),
                Err(_) => output::note(format_args!("{answer:?} is no such value; again:")),
            }
        }
    }
}
