//! The table `[flapping]` of a rotor file: the hub and the blades' inertia.

use super::{
    super::{BladeInertia, Geometry, GeometryError},
    given::{Given, GivenValue},
    nearest,
};
use crate::text_file::excerpt;
use core::f64::consts::PI;
use serde::Deserialize;
use toml::Spanned;

/// The kinds of hubs.
const HUBS: [&str; 4] = ["hinged", "teetering", "hingeless", "rigid"];

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub(super) struct FileFlapping {
    hub: Option<Spanned<String>>,
    inertia: Option<f64>,
    lock_number: Option<f64>,
    hinge_offset: Option<Spanned<f64>>,
    hinge_spring: Option<Spanned<f64>>,
    flap_frequency: Option<Spanned<f64>>,
    precone: Option<Spanned<f64>>,
    undersling: Option<Spanned<f64>>,
    delta3: Option<Spanned<f64>>,
    lowest_angle: Option<Spanned<f64>>,
    highest_angle: Option<Spanned<f64>>,
}

/// What is wrong, and the byte of the file where it is.
type Problem = (usize, String);

impl FileFlapping {
    fn is(&self, hub: &str) -> bool {
        self.hub.as_ref().is_some_and(|word| word.get_ref() == hub)
    }

    /// The inertia of the blades, from exactly one of the two numbers; none for blades that do not
    /// flap and whose inertia is not given.
    pub(super) fn inertia(&self) -> Result<Option<BladeInertia>, GeometryError> {
        let (name, value, inertia) = match (self.inertia, self.lock_number) {
            (Some(moment), None) => ("inertia", moment, BladeInertia::Moment(moment)),
            (None, Some(number)) => ("lockNumber", number, BladeInertia::LockNumber(number)),
            (None, None) if self.is("rigid") => return Ok(None),
            (Some(_), Some(_)) | (None, None) => {
                return Err(GeometryError(
                    "the table [flapping] needs either inertia (kg.m2) or lockNumber".into(),
                ));
            }
        };
        if !(value.is_finite() && value > 0.0) {
            return Err(GeometryError(format!(
                "flapping.{name} is {value}; it must be above 0"
            )));
        }
        Ok(Some(inertia))
    }

    /// What the table gives for the parameters of the FMU. `rpm`: the nominal rotor speed; `line`:
    /// the line of a byte.
    pub(super) fn given(
        &self,
        geometry: &Geometry,
        rpm: Option<f64>,
        line: impl Fn(usize) -> usize,
    ) -> Result<Vec<Given>, Problem> {
        let mut given = Vec::new();
        if let Some(hub) = &self.hub {
            let kind = known(hub)?;
            let at = line(hub.span().start);
            let flaps = GivenValue::Boolean(kind != "rigid");
            given.push(Given::new("flapping.enabled", flaps, at));
            if kind == "teetering" {
                let hub = GivenValue::Text(kind.to_owned());
                given.push(Given::new("flapping.hub", hub, at));
            }
        }
        for (name, value) in [
            ("flapping.hingeOffset", &self.hinge_offset),
            ("flapping.hingeSpring", &self.hinge_spring),
            ("flapping.precone", &self.precone),
            ("flapping.undersling", &self.undersling),
            ("flapping.delta3", &self.delta3),
            ("flapping.lowestAngle", &self.lowest_angle),
            ("flapping.highestAngle", &self.highest_angle),
        ] {
            if let Some(value) = value {
                given.push(Given::number(
                    name,
                    *value.get_ref(),
                    line(value.span().start),
                ));
            }
        }
        if let Some((spring, at)) = self.equivalent_spring(geometry, rpm)? {
            given.push(Given::number("flapping.hingeSpring", spring, line(at)));
        }
        Ok(given)
    }

    /// The spring at the hinge of a hingeless rotor that gives its blades their flapping frequency
    /// nu, per revolution of the nominal speed Omega: nu^2 = 1 + 3/2 e/(1 - e) + k/(I Omega^2),
    /// with the hinge offset e in radii (Johnson 1980, "Helicopter Theory", eq. 5-145).
    fn equivalent_spring(
        &self,
        geometry: &Geometry,
        rpm: Option<f64>,
    ) -> Result<Option<(f64, usize)>, Problem> {
        let Some(frequency) = &self.flap_frequency else {
            return match &self.hub {
                Some(hub) if self.is("hingeless") && self.hinge_spring.is_none() => Err((
                    hub.span().start,
                    "a hingeless hub needs the spring of its equivalent hinge: give flapFrequency (of the turning blade, per revolution, such as 1.12) with rpm, or hingeSpring (N.m/rad)".into(),
                )),
                _ => Ok(None),
            };
        };
        let at = frequency.span().start;
        let fail = |text: &str| Err((at, text.to_owned()));
        if self.hinge_spring.is_some() {
            return fail("flapFrequency and hingeSpring both give the spring; leave one out");
        }
        let Some(rpm) = rpm.filter(|rpm| *rpm > 0.0) else {
            return fail(
                "flapFrequency needs rpm, the nominal rotor speed at which it holds, in rev/min",
            );
        };
        let offset = self.hinge_offset.as_ref().map_or(0.0, |e| *e.get_ref());
        let Some(inertia) = geometry.inertia else {
            return fail(
                "flapFrequency needs the inertia of the blades; give inertia or lockNumber",
            );
        };
        let nu = *frequency.get_ref();
        let without = 1.0 + 1.5 * offset / (1.0 - offset);
        let rest = nu * nu - without;
        if !(rest >= 0.0 && nu <= 10.0) {
            return Err((
                at,
                format!(
                    "flapFrequency is {nu}; it must be at least {:.4} per revolution, that of the hinge offset {offset} without a spring, and at most 10",
                    libm::sqrt(without)
                ),
            ));
        }
        let speed = rpm * PI / 30.0;
        Ok(Some((rest * inertia.moment(geometry) * speed * speed, at)))
    }
}

/// The kind of hub that a word names.
fn known(hub: &Spanned<String>) -> Result<&str, Problem> {
    let word = hub.get_ref().as_str();
    if HUBS.contains(&word) {
        return Ok(word);
    }
    let meant = nearest(word, HUBS.into_iter());
    let meant = meant.map_or_else(String::new, |name| format!("; did you mean \"{name}\"?"));
    let problem = format!(
        "hub is {:?}; write one of \"{}\"{meant}",
        excerpt(word),
        HUBS.join("\", \"")
    );
    Err((hub.span().start, problem))
}
