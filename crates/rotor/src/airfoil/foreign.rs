//! Recognises the files of other programs, so that an error can say what a file is and what to do.
//!
//! What each looks like is known from files and writers of the programs themselves: XFOIL and
//! XFLR5 polars; airfoiltools.com; NREL's AirfoilInfo v1.01 (OpenFAST's regression tests) and the
//! files of AeroDyn 13 and 14 before it; CCBlade.jl; QBlade's `.plr`.

use super::{
    AirfoilError, c81, combi,
    formats::has_extension,
    polar,
    records::{number, words},
};
use std::{fmt, path::Path};

/// A kind of file that is not in one of the formats.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Foreign {
    /// A polar that XFOIL has saved, or another program in its form.
    Xfoil,
    /// The same by XFLR5 or flow5, in its form or separated by commas.
    Xflr5,
    /// A polar of airfoiltools.com, separated by commas.
    AirfoilTools,
    /// AirfoilInfo of AeroDyn 15 and OpenFAST.
    AirfoilInfo,
    /// An airfoil file of AeroDyn 13 or 14, or another program in its form.
    AeroDyn,
    /// QBlade's polars by Reynolds number.
    QBlade,
    /// A table of CCBlade.jl: three lines and then angle in rad, lift and drag.
    CcBlade,
    /// A C81 table whose name says that it is something else.
    C81,
    /// The contour of a section, not its lift and drag.
    Coordinates,
    /// Columns of numbers, three or more.
    Columns,
}

impl fmt::Display for Foreign {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Xfoil => "an XFOIL polar",
            Self::Xflr5 => "an XFLR5 polar",
            Self::AirfoilTools => "a polar of airfoiltools.com",
            Self::AirfoilInfo => "an AirfoilInfo file of AeroDyn or OpenFAST",
            Self::AeroDyn => "an airfoil file of AeroDyn 13 or 14",
            Self::QBlade => "a QBlade polar",
            Self::CcBlade => "a CCBlade.jl table",
            Self::C81 => "a C81 table",
            Self::Coordinates => "the coordinates of a section, without lift and drag",
            Self::Columns => "a table in columns",
        })
    }
}

/// Lines in which a file says what it is.
const HEAD: usize = 60;

/// Bytes of a line in which it says so.
const LINE: usize = 300;

/// Lines that are looked at for what a table has in common.
const TABLE: usize = 400;

impl Foreign {
    /// What a text looks like; none if it has no table.
    pub fn recognised(text: &str) -> Option<Self> {
        if c81::begins(text) {
            return Some(Self::C81);
        }
        named(text).or_else(|| of_numbers(text))
    }
}

/// A file that says what it is.
fn named(text: &str) -> Option<Foreign> {
    let has = |part: &str| {
        let mut head = text.lines().take(HEAD);
        head.any(|line| contains(line, part))
    };
    // An XFOIL polar that another program writes has the name of that program.
    let is_polar = has("calculated polar for");
    if is_polar && (has("xflr5") || has("flow5")) {
        return Some(Foreign::Xflr5);
    }
    [
        (
            has("polar key,") || has("airfoiltools.com"),
            Foreign::AirfoilTools,
        ),
        (is_polar || has("xfoil  "), Foreign::Xfoil),
        // QBlade also writes files in the form of AeroDyn.
        (
            has("number of airfoil tables in this file") && !has("numtabs"),
            Foreign::AeroDyn,
        ),
        (has("airfoilinfo") || has("numtabs"), Foreign::AirfoilInfo),
        (has("polarname") || has("qblade multi re"), Foreign::QBlade),
    ]
    .into_iter()
    .find_map(|(is, kind)| is.then_some(kind))
}

/// Whether a line has a part, in small letters, in any letters.
fn contains(line: &str, part: &str) -> bool {
    let part = part.as_bytes();
    let line = line.as_bytes();
    line[..line.len().min(LINE)]
        .windows(part.len())
        .any(|window| window.eq_ignore_ascii_case(part))
}

/// What the numbers of a file look like.
fn of_numbers(text: &str) -> Option<Foreign> {
    // Lines of numbers only, by how many there are in a line, and how many are points of a contour.
    let (mut tables, mut pairs, mut on_contour) = (0, 0, 0);
    let mut begin = [0; 4];
    let lines = text.lines().filter(|line| !line.trim().is_empty());
    for (i, line) in lines.take(TABLE).enumerate() {
        let mut numbers = [0.0; 2];
        let mut count = 0;
        for word in words(line) {
            let Some(value) = number(word) else {
                count = 0;
                break;
            };
            if let Some(place) = numbers.get_mut(count) {
                *place = value;
            }
            count += 1;
        }
        if let Some(place) = begin.get_mut(i) {
            *place = count;
        }
        match count {
            0 | 1 => {}
            2 => {
                pairs += 1;
                let [x, y]: [f64; 2] = numbers;
                on_contour += usize::from((-0.01..=1.01).contains(&x) && y.abs() <= 0.5);
            }
            _ => tables += 1,
        }
    }
    match (tables, begin) {
        (2.., [0, 1, 1, 3 | 4]) => Some(Foreign::CcBlade),
        (2.., _) => Some(Foreign::Columns),
        // Two numbers may also count the points of both sides.
        _ if pairs >= 10 && on_contour + 1 >= pairs => Some(Foreign::Coordinates),
        _ => None,
    }
}

/// The error of a file that begins as none of the formats does: what it looks like instead, if that
/// is known.
pub fn explained(error: AirfoilError, text: &str, path: &Path) -> AirfoilError {
    let is_c81 = !has_extension(path, "polar") && c81::begins(text);
    if polar::begins(text) || combi::begins(text) || is_c81 {
        return error;
    }
    match Foreign::recognised(text) {
        None => error,
        Some(looks_like) => AirfoilError::Foreign {
            file: path.display().to_string(),
            looks_like,
            polar: path.with_extension("polar").file_name().map_or_else(
                || "section.polar".to_owned(),
                |name| name.to_string_lossy().into_owned(),
            ),
        },
    }
}

/// What to do with a file that looks like something else.
pub fn remedy(looks_like: Foreign, file: &str, polar: &str) -> String {
    match looks_like {
        Foreign::Coordinates => "compute polars of the section, for example with XFOIL, and make a .polar file of these with `helicopter-rotor polar`".to_owned(),
        Foreign::C81 => "give it a name that ends in .c81".to_owned(),
        Foreign::Xfoil
        | Foreign::Xflr5
        | Foreign::AirfoilTools
        | Foreign::AirfoilInfo
        | Foreign::AeroDyn
        | Foreign::QBlade
        | Foreign::CcBlade
        | Foreign::Columns => {
            format!("run: helicopter-rotor polar \"{file}\" --out \"{polar}\"")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Airfoil;
    use super::*;

    /// Small files in the form of each program, with what they are.
    const FILES: [(Foreign, &str); 14] = [
        (
            Foreign::Xfoil,
            "\n       XFOIL         Version 6.99\n\n Calculated polar for: TEST\n\n 1 1 Reynolds number fixed          Mach number fixed\n\n Mach =   0.000     Re =     0.500 e 6     Ncrit =   9.000\n\n   alpha    CL        CD\n  ------ -------- ---------\n   0.000   0.1000   0.01000\n   1.000   0.2000   0.01000\n",
        ),
        (
            Foreign::Xflr5,
            "xflr5 v6.47\n\n Calculated polar for: TEST\n\n 1 1 Reynolds number fixed          Mach number fixed\n\nalpha,CL,CD\n 0.000,0.1000,0.01000\n",
        ),
        (
            Foreign::AirfoilTools,
            "Xfoil polar. Reynolds number fixed. Mach  number fixed\nPolar key,xf-test-il-50000\nAirfoil,test-il\nReynolds number,50000\n\nAlpha,Cl,Cd,Cdp,Cm,Top_Xtr,Bot_Xtr\n0.000,0.1,0.01,0,0,1,1\n",
        ),
        (
            Foreign::AirfoilInfo,
            "! ------------ AirfoilInfo v1.01.x Input File ------\n          1   NumTabs   ! Number of airfoil tables in this file.\n 0.75 Re\n 2 NumAlf\n 0 0.1 0.01\n1 0.2 0.01\n",
        ),
        (
            Foreign::AeroDyn,
            "AeroDyn airfoil file, generated by QBlade\ntitle\n1   Number of airfoil tables in this file\n0   Table ID parameter\n-180 0 0.1 0\n180 0 0.1 0\n",
        ),
        (
            Foreign::QBlade,
            "----QBlade Multi RE Polar File----\nTest   POLARNAME  - the polar name\nREYNOLDS 1.0E+06  - the list\nAOA CL CD CM\n0 0.1 0.01 0\n1 0.2 0.01 0\n",
        ),
        (
            Foreign::CcBlade,
            "Test (no rotation)\n1000000\n0\n-0.1\t-0.5\t0.02\n0.1\t0.5\t0.02\n",
        ),
        (
            Foreign::CcBlade,
            "Test, old\n0.0\n0.0\n-180.0 0.0 0.02 0.1\n180.0 0.0 0.02 0.1\n",
        ),
        (
            Foreign::C81,
            "Test 1 2 1 2\n0\n-180 0\n180 0\n0\n-180 0.1\n180 0.1\n",
        ),
        (
            Foreign::Coordinates,
            "NACA 0000\n1 0\n.8 .1\n.6 .1\n.4 .1\n.2 .1\n0 0\n.2 -.1\n.4 -.1\n.6 -.1\n.8 -.1\n1 0\n",
        ),
        (
            Foreign::Coordinates,
            "NACA 0000\n 6. 6.\n\n0 0\n.2 .1\n.4 .1\n.6 .1\n.8 .1\n1 0\n\n0 0\n.2 -.1\n.4 -.1\n.6 -.1\n.8 -.1\n1 0\n",
        ),
        (Foreign::Columns, "alpha,cl,cd\n-1,-0.1,0.01\n1,0.1,0.01\n"),
        (Foreign::Columns, "-1\t-0.1\t0.01\n1\t0.1\t0.01\n"),
        (
            Foreign::Columns,
            "# Re = 0.05e6\n-9.000000000000000000e+01 -7.678535430653904863e-17 1.254000000000000004e+00\n-8.818181818181817277e+01 -3.979925730190594230e-02 1.254253572299562913e+00\n",
        ),
    ];

    #[test]
    fn the_files_of_other_programs_are_recognised() {
        for (expected, text) in FILES {
            for text in [
                text.to_owned(),
                text.replace('\n', "\r\n"),
                text.to_uppercase(),
            ] {
                assert_eq!(Foreign::recognised(&text), Some(expected), "{text}");
            }
        }
        for text in ["", "text\n", "1 2\n3 4\n", "1 2 3\n"] {
            assert_eq!(Foreign::recognised(text), None, "{text}");
        }
    }

    #[test]
    fn the_error_says_what_a_file_looks_like_and_which_command_makes_a_polar_of_it() {
        for (looks_like, text) in FILES {
            for name in ["/home/a b/test.txt", "test.polar"] {
                let error = match Airfoil::from_text(text, Path::new(name)) {
                    Ok(_) if looks_like == Foreign::C81 => continue,
                    Ok(_) => panic!("{looks_like} is read"),
                    Err(error) => error.to_string(),
                };
                let begin = format!(
                    "airfoil file {name}: it looks like {looks_like}; the FMU reads .polar, C81 and CombiTable files; "
                );
                let command =
                    format!("run: helicopter-rotor polar \"{name}\" --out \"test.polar\"");
                let end = if looks_like == Foreign::C81 {
                    "give it a name that ends in .c81"
                } else if looks_like == Foreign::Coordinates {
                    "compute polars of the section, for example with XFOIL, and make a .polar file of these with `helicopter-rotor polar`"
                } else {
                    &command
                };
                assert_eq!(error, begin + end);
            }
        }
    }

    /// The mistake in a file of one of the formats is told, and not what else it could be.
    #[test]
    fn a_file_that_begins_as_it_should_gets_the_error_of_its_format() {
        for (name, text, part) in [
            (
                "a.polar",
                "polar 1\nreynolds 1e5\n-180 0 0.1\n0 0 x\n180 0 0.1\n",
                "line 4",
            ),
            (
                "a.c81",
                "Test 1 2 1 2\n0\n-180 0 0.1\n180 0 0.1\n",
                "line 3",
            ),
            ("a.txt", "#1\n1 2 3\n1 2 3\n", "line 2"),
            (
                "a.c81",
                "1 0 0\n0\n0\nXFOIL  data\n1e6 0.2\nTest 1 2 1 2 1 2\n0\n-180 x\n",
                "line 8",
            ),
        ] {
            let error = Airfoil::from_text(text, Path::new(name))
                .unwrap_err()
                .to_string();
            assert!(
                error.contains(part) && !error.contains("looks like"),
                "{error}"
            );
        }
    }
}
