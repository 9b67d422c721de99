//! `helicopter-rotor polar`: small files in the form of each program become the polars that they
//! hold, and each mistake its sentence.

use crate::support::{self, fail, program, succeed};
use rotor::airfoil::{Airfoil, Axis, RawPolar};
use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

/// A folder for the files of a test.
fn folder(test: &str) -> PathBuf {
    let folder = support::scratch().join("polar").join(test);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// Writes files, and gives the command for them that writes `out.polar` beside them.
fn command(test: &str, files: &[(&str, &str)], arguments: &[&str]) -> (Command, PathBuf) {
    let folder = folder(test);
    let mut command = program();
    command.arg("polar");
    for (name, text) in files {
        let path = folder.join(name);
        fs::write(&path, text).unwrap();
        command.arg(path);
    }
    let out = folder.join("out.polar");
    command.arg("--out").arg(&out).args(arguments);
    (command, out)
}

/// What the program says, and the polars of the file that it makes.
#[track_caller]
fn made(test: &str, files: &[(&str, &str)], arguments: &[&str]) -> (String, Vec<RawPolar>) {
    let (mut command, out) = command(test, files, arguments);
    let said = succeed(&mut command);
    let text = fs::read_to_string(&out).unwrap();
    assert!(Airfoil::read(&out).is_ok());
    let (_, polars) = Airfoil::raw_polars(&text, "out").unwrap();
    (said, polars)
}

/// The error of a run that writes nothing.
#[track_caller]
fn refused(test: &str, files: &[(&str, &str)], arguments: &[&str]) -> String {
    let (mut command, out) = command(test, files, arguments);
    let error = fail(&mut command);
    assert!(!out.exists() && !out.with_extension("svg").exists());
    error
}

/// Lift and drag of a polar at an angle of its table.
#[track_caller]
fn at(polar: &RawPolar, alpha: f64) -> (f64, f64) {
    let find = |points: &[(f64, f64)]| {
        let point = points.iter().find(|p| (p.0 - alpha).abs() < 1e-6);
        point.unwrap_or_else(|| panic!("{alpha} deg is missing")).1
    };
    (find(&polar.lift), find(&polar.drag))
}

fn reynolds(polars: &[RawPolar]) -> Vec<f64> {
    polars.iter().filter_map(|polar| polar.reynolds).collect()
}

fn machs(polars: &[RawPolar]) -> Vec<f64> {
    polars.iter().filter_map(|polar| polar.mach).collect()
}

/// A polar as XFOIL saves it.
fn xfoil(reynolds: &str, mach: &str, rows: &str) -> String {
    format!(
        "  \n       XFOIL         Version 6.99\n  \n Calculated polar for: SECTION 7                              \n  \n 1 1 Reynolds number fixed          Mach number fixed         \n  \n xtrf =   1.000 (top)        1.000 (bottom)  \n Mach =   {mach}     Re =     {reynolds}     Ncrit =   9.000\n  \n   alpha    CL        CD       CDp       CM     Top_Xtr  Bot_Xtr\n  ------ -------- --------- --------- -------- -------- --------\n{rows}"
    )
}

const ROWS: &str = "  -8.000  -0.7000   0.02000   0.01000   0.0000   0.9000   0.1000
  -6.000  -0.7500   0.01200   0.00500   0.0000   0.9000   0.1000
   0.000   0.1000   0.00600   0.00100   0.0000   0.5000   0.5000
   6.000   0.9000   0.01300   0.00600   0.0000   0.1000   0.9000
   9.000   0.8000   0.04000   0.02000   0.0000   0.1000   0.9000
";

#[test]
fn xfoil_polars_of_several_reynolds_numbers_become_one_file() {
    let low = xfoil(
        "0.200 e 6",
        "0.000",
        &ROWS.replace("0.9000   0.01300", "0.8800   0.01300"),
    );
    // A sweep down after the sweep up, with a run that has failed and the nine columns of 6.97.
    let down = format!(
        "{ROWS}   3.000      NaN   0.00800   0.0000   0.0000   0.1000   0.9000\n   0.000   0.1010   0.00602   0.00100   0.0000  -0.5000   0.0000   0.5000   0.5000\n   0.000   0.1020   0.00604   0.00100   0.0000  -0.5000   0.0000   0.5000   0.5000\n"
    );
    let high = xfoil("1.250 e 6", "0.000", &down);
    let files = [("high.txt", high.as_str()), ("low.txt", low.as_str())];
    let (said, polars) = made("xfoil", &files, &[]);
    for part in [
        "high.txt: an XFOIL polar of SECTION 7; Reynolds number 1250000; Mach number 0; 7 angles from -8 to 9 deg",
        "low.txt: an XFOIL polar of SECTION 7; Reynolds number 200000",
        "high.txt: rows whose lift or drag is no number, left out: 1",
        "high.txt: of rows at one angle that differ by less than 0.01 in lift and 10 % in drag the mean is taken: 2",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
    assert_eq!(reynolds(&polars), [2e5, 1.25e6]);
    assert_eq!(at(&polars[0], 6.0), (0.88, 0.013));
    assert_eq!(at(&polars[1], 6.0), (0.9, 0.013));
    let (lift, drag) = at(&polars[1], 0.0);
    assert!((lift - 0.101).abs() < 1e-12 && (drag - 0.00602).abs() < 1e-12);
}

/// Its text and its table separated by commas, as `Polar::exportPolar` writes them.
#[test]
fn xflr5_polars_are_read_in_both_forms() {
    let head = "xflr5 v6.47\n\n Calculated polar for: SECTION 7\n\n 1 1 Reynolds number fixed          Mach number fixed         \n\n xtrf =   1.000 (top)        1.000 (bottom)\n Mach =   0.000     Re =     0.100 e 6     Ncrit =   9.000\n\n";
    let text = format!(
        "{head}  alpha     CL        CD       CDp       Cm    Top Xtr Bot Xtr   Cpmin    Chinge     XCp    \n ------- -------- --------- --------- -------- ------- ------- -------- --------- ---------\n  -4.000  -0.4000   0.01500   0.00700   0.0000  0.9000  0.1000  -1.0000   0.0000   0.2500\n   5.000   0.6000   0.01700   0.00700   0.0000  0.1000  0.9000  -1.0000   0.0000   0.2500\n\n\n"
    );
    let comma = format!(
        "{head}alpha,CL,CD,CDp,Cm,Top Xtr,Bot Xtr,Cpmin,Chinge,XCp\n  -4.000, -0.4000,  0.01500,  0.00700,  0.0000, 0.9000, 0.1000, -1.0000,  0.0000,  0.2500\n   5.000,  0.6000,  0.01700,  0.00700,  0.0000, 0.1000, 0.9000, -1.0000,  0.0000,  0.2500\n\n"
    );
    for (name, text) in [("text", text.as_str()), ("comma", comma.as_str())] {
        let (said, polars) = made(&format!("xflr5-{name}"), &[("T1_Re0.100.txt", text)], &[]);
        assert!(
            said.contains("an XFLR5 polar of SECTION 7; Reynolds number 100000"),
            "{said}"
        );
        assert_eq!(
            (at(&polars[0], -4.0), at(&polars[0], 5.0)),
            ((-0.4, 0.015), (0.6, 0.017))
        );
    }
    let type_2 = text.replace(
        "1 1 Reynolds number fixed  ",
        "2 2 Reynolds number ~ 1/sqrt(CL)",
    );
    let error = refused("xflr5-type-2", &[("t2.txt", &type_2)], &[]);
    assert!(
        error.contains("its Reynolds number changes with the lift") && error.contains("type 1"),
        "{error}"
    );
}

#[test]
fn airfoiltools_files_are_read() {
    let text = "Xfoil polar. Reynolds number fixed. Mach  number fixed\nPolar key,xf-section7-il-50000\nAirfoil,section7-il\nReynolds number,50000\nNcrit,9\nMach,0\nMax Cl/Cd,37.4\nMax Cl/Cd alpha,5.5\nUrl,http://airfoiltools.com/polar/csv?polar=xf-section7-il-50000\n\nAlpha,Cl,Cd,Cdp,Cm,Top_Xtr,Bot_Xtr\n-5.250,-0.5158,0.11581,0.10876,-0.0005,1.0000,0.2147\n4.500,0.7047,0.02139,0.00435,0.0000,0.4000,1.0000\n";
    let (said, polars) = made("airfoiltools", &[("xf.csv", text)], &[]);
    assert!(said.contains("a polar of airfoiltools.com of section7-il; Reynolds number 50000; Mach number 0; 2 angles"), "{said}");
    assert_eq!(reynolds(&polars), [5e4]);
    assert_eq!(at(&polars[0], -5.25), (-0.5158, 0.11581));
    assert_eq!(at(&polars[0], 4.5), (0.7047, 0.02139));
}

/// The form of the files of OpenFAST's regression tests.
#[test]
fn airfoilinfo_files_are_read_with_all_their_tables() {
    let table = |re: &str, lift: &str| {
        format!(
            "! data for table\n       {re}   Re                ! Reynolds number in millions\n          0   UserProp          ! User property (control) setting\nFalse         InclUAdata        ! Is unsteady aerodynamics data included in this table?\n!........................................\n! Table of aerodynamics coefficients\n          3   NumAlf            ! Number of data lines in the following table\n!    Alpha      Cl      Cd        Cm\n!    (deg)      (-)     (-)       (-)\n   -180.00    0.000   0.0185   0.0000\n      4.00    {lift}   0.0063  -0.1213\n    180.00    0.000   0.0185   0.0000\n"
        )
    };
    let text = format!(
        "! ------------ AirfoilInfo v1.01.x Input File ----------------------------------\n! a section\n! ------------------------------------------------------------------------------\n\"DEFAULT\"     InterpOrd         ! Interpolation order\n          1   NonDimArea        ! The non-dimensional area\n          0   NumCoords         ! The number of coordinates\n          2   NumTabs           ! Number of airfoil tables in this file.\n{}{}",
        table("0.75", "0.500"),
        table("3.0", "0.600")
    );
    let (said, polars) = made("airfoilinfo", &[("af.dat", &text)], &[]);
    assert!(said.contains("an AirfoilInfo file of AeroDyn or OpenFAST; Reynolds numbers 750000, 3000000; 3 angles from -180 to 180 deg"), "{said}");
    assert_eq!(reynolds(&polars), [7.5e5, 3e6]);
    assert_eq!(at(&polars[0], 4.0), (0.5, 0.0063));
    assert_eq!(at(&polars[1], 4.0), (0.6, 0.0063));
    let short = text.replacen("          3   NumAlf", "          4   NumAlf", 1);
    let error = refused("airfoilinfo-short", &[("af.dat", &short)], &[]);
    assert!(
        error.contains(
            "4 rows of angle, lift and drag are expected by NumAlf, of which 3 are found"
        ),
        "{error}"
    );
}

/// Those of WISDEM, which name a Reynolds number and end in EOT, and those of QBlade, which do not.
#[test]
fn the_files_of_aerodyn_13_and_14_are_read() {
    let rows = "-180.00    0.000   0.0202   0.0000\n   2.00    0.700   0.0068  -0.1396\n\n 180.00    0.000   0.0202   0.0000\n";
    let params =
        " 0.0      Control setting\n   8.50     Stall angle (deg)\n   0.0065   Minimum CD value\n";
    let two = format!(
        "A section of 3 lines, text.\nline\nline\n2        Number of airfoil tables in this file\n   1.0     Reynolds numbers in millions\n{params}{rows}EOT\n   2.0     Reynolds numbers in millions\n{params}{}EOT\n",
        rows.replace("0.700", "0.750")
    );
    let (said, polars) = made("aerodyn", &[("af.dat", &two)], &[]);
    assert!(
        said.contains(
            "an airfoil file of AeroDyn 13 or 14; Reynolds numbers 1000000, 2000000; 3 angles"
        ),
        "{said}"
    );
    assert_eq!(reynolds(&polars), [1e6, 2e6]);
    assert_eq!(
        (at(&polars[0], 2.0), at(&polars[1], 2.0)),
        ((0.7, 0.0068), (0.75, 0.0068))
    );
    let side_by_side = "line\nline\n2 Number of airfoil tables in this file\n0.1 0.2 Reynolds numbers in millions\n0 0 Table ID parameter\n-180 0 0.02 0 0 0.03 0\n2 0.3 0.01 0 0.4 0.02 0\n180 0 0.02 0 0 0.03 0\n";
    let (_, polars) = made("aerodyn-columns", &[("af.dat", side_by_side)], &[]);
    assert_eq!(reynolds(&polars), [1e5, 2e5]);
    assert_eq!(
        (at(&polars[0], 2.0), at(&polars[1], 2.0)),
        ((0.3, 0.01), (0.4, 0.02))
    );
    let qblade = format!(
        "AeroDyn airfoil file Created with QBlade on 01.01.2020 at 00:00:00 Compatible with AeroDyn v13.0.\nPolar \"x\" on Foil \"y\" :: generated by QBlade\n1              Number of airfoil tables in this file\n0              Table ID parameter\n12.00          Stall angle (deg)\n0              No longer used, enter zero\n{rows}"
    );
    let error = refused("aerodyn-unknown", &[("af.dat", &qblade)], &[]);
    assert!(
        error.contains(
            "af.dat does not say for which Reynolds number it is; give it with --reynolds"
        ),
        "{error}"
    );
    let (_, polars) = made(
        "aerodyn-given",
        &[("af.dat", &qblade)],
        &["--reynolds", "4e5"],
    );
    assert_eq!(reynolds(&polars), [4e5]);
}

/// The form in QBlade's documentation, and with two Reynolds numbers, decomposed.
#[test]
fn qblade_polars_are_read_for_all_reynolds_numbers() {
    let file = |decomposed: &str, reynolds: &str, rows: &str| {
        format!(
            "----------------------------------------QBlade Multi RE Polar File----\nGenerated with : QBlade CE v 2.0\nArchive Format: 310001\nTime : 21:36:42\nDate : 14.06.2022\n\n----Object Names----\nsection7_Polar                           POLARNAME          - the polar name\nsection7                                 FOILNAME           - the airfoil name to which the polar(s) belong\n\n----Parameters----\n17.0                                     THICKNESS          - the name of the blade\n{decomposed}                                        ISDECOMPOSED       - is the polar decomposed\nREYNOLDS            {reynolds}          - the list of Reynolds numbers for the imported polars\n\n----Polar Data----\nAOA                 CL                  CD                  CM                  \n{rows}"
        )
    };
    let one = file(
        "0",
        "1.0000E+06",
        "-180.000000         0.000000            0.019800            0.000000            \n4.000000            0.898000            0.005400            -0.119900           \n180.000000          0.000000            0.019800            0.000000            \n",
    );
    let (said, polars) = made("qblade", &[("a.plr", &one)], &[]);
    assert!(
        said.contains("a QBlade polar of section7; Reynolds number 1000000; 3 angles"),
        "{said}"
    );
    assert_eq!(at(&polars[0], 4.0), (0.898, 0.0054));
    let two = file(
        "1",
        "1.0E+05 2.0E+05",
        "-180 0 .02 0 0 0 0 0 .03 0 0 0 0\n4 .4 .01 0 9 9 9 .5 .02 0 9 9 9\n180 0 .02 0 0 0 0 0 .03 0 0 0 0\n",
    );
    let (_, polars) = made("qblade-two", &[("a.plr", &two)], &[]);
    assert_eq!(reynolds(&polars), [1e5, 2e5]);
    assert_eq!(
        (at(&polars[0], 4.0), at(&polars[1], 4.0)),
        ((0.4, 0.01), (0.5, 0.02))
    );
    let few = two.replace(" 9 9 9\n", "\n");
    let (_, polars) = made("qblade-few", &[("a.plr", &few)], &[]);
    assert_eq!(at(&polars[1], 4.0), (0.5, 0.02));
    let none = two.replace(".5 .02 0 9 9 9\n", "\n");
    let error = refused("qblade-none", &[("a.plr", &none)], &[]);
    assert!(
        error.contains("the row at 4 deg has 7 numbers, too few for 2 Reynolds numbers"),
        "{error}"
    );
}

/// Angles in rad, as its `AlphaAF` reads them by default; older files have deg and a moment.
#[test]
fn ccblade_tables_are_read_in_rad_and_in_deg() {
    let text = "SECTION 7 (no rotation)\n1000000\n0\n-3.141592653589793\t0\t0.0001\n0.017453292519943295\t0.5842\t0.00594\n3.141592653589793\t0\t0.0001\n";
    let (said, polars) = made("ccblade", &[("a.dat", text)], &[]);
    assert!(said.contains("a CCBlade.jl table of SECTION 7 (no rotation); Reynolds number 1000000; Mach number 0; 3 angles from -180 to 180 deg"), "{said}");
    assert_eq!(at(&polars[0], 1.0), (0.5842, 0.00594));
    let small = "SECTION 7\n1000000\n0\n-0.1\t-0.4\t0.01\n0.1\t0.7\t0.02\n";
    let (_, polars) = made("ccblade-small", &[("a.dat", small)], &[]);
    assert_eq!(at(&polars[0], 0.1_f64.to_degrees()), (0.7, 0.02));
    let (_, polars) = made("ccblade-forced", &[("a.dat", small)], &["--angles", "deg"]);
    assert_eq!(at(&polars[0], 0.1), (0.7, 0.02));
    let old = "SECTION 7\n0.0\n0.0\n-180.0 0.0 0.02 0.1\n1.0 0.2 0.01 0\n180.0 0.0 0.02 0.1\n";
    let error = refused("ccblade-old", &[("a.dat", old)], &[]);
    assert!(
        error.contains("does not say for which Reynolds number"),
        "{error}"
    );
    let (_, polars) = made("ccblade-deg", &[("a.dat", old)], &["--reynolds", "1e6"]);
    assert_eq!(at(&polars[0], 1.0), (0.2, 0.01));
}

#[test]
fn columns_are_found_by_their_names_and_numbers_in_any_separators() {
    for (name, text, file_says_re) in [
        ("commas", "alpha,cl,cd\n-5,-0.5,0.02\n5,0.6,0.01\n", false),
        (
            "other-order",
            "Cd [-];Cl [-];AoA [deg]\n0.02;-0.5;-5\n0.01;0.6;5\n",
            false,
        ),
        (
            "decimal-commas",
            "alpha;cl;cd\n-5,0;-0,5;0,02\n5,0;0,6;0,01\n",
            false,
        ),
        (
            "tabs",
            "angle of attack (deg)\tlift coefficient\tdrag coefficient\n-5\t-0.5\t0.02\n5\t0.6\t0.01\n",
            false,
        ),
        (
            "quotes",
            "\"alpha\",\"C_L\",\"C_D\"\n\"-5\",\"-0.5\",\"0.02\"\n5,0.6,0.01\n",
            false,
        ),
        (
            "rad",
            "alpha_rad cl cd\n-0.08726646259971647 -0.5 0.02\n0.08726646259971647 0.6 0.01\n",
            false,
        ),
        (
            "rad-by-slope",
            "-0.08726646259971647 -0.5 0.02\n0.08726646259971647 0.6 0.01\n",
            false,
        ),
        (
            "no-names",
            "# Re = 0.2e6\n-5 -0.5 2D-2\n5 0.6 1.0D-02\n",
            true,
        ),
        (
            "blanks",
            "! comment\nALPHA  CL  CD  CM\n -5 -0.5 0.02 0\n 5 0.6 0.01 0 ! a comment\n",
            false,
        ),
    ] {
        let arguments: &[&str] = if file_says_re {
            &[]
        } else {
            &["--reynolds", "2e5"]
        };
        let (said, polars) = made(&format!("columns-{name}"), &[("a.csv", text)], arguments);
        assert!(said.contains("a table in columns"), "{said}");
        assert_eq!(reynolds(&polars), [2e5], "{name}");
        assert_eq!(
            (at(&polars[0], -5.0), at(&polars[0], 5.0)),
            ((-0.5, 0.02), (0.6, 0.01)),
            "{name}"
        );
        assert_eq!(
            said.contains("taken for rad, by the slope"),
            name == "rad-by-slope",
            "{said}"
        );
        assert_eq!(
            said.contains("have no names"),
            name == "no-names" || name == "rad-by-slope"
        );
    }
    let numbers =
        "Re,alpha,cl,cd\n1e5,-5,-0.4,0.03\n1e5,5,0.4,0.03\n3e5,-5,-0.5,0.02\n3e5,5,0.5,0.02\n";
    let (_, polars) = made("columns-re", &[("a.csv", numbers)], &[]);
    assert_eq!(reynolds(&polars), [1e5, 3e5]);
    assert_eq!(at(&polars[1], 5.0), (0.5, 0.02));
    let error = refused(
        "columns-wrong",
        &[("a.csv", "angle,lift,moment\n-5,1,2\n5,1,2\n")],
        &[],
    );
    assert!(error.contains("one must be the angle of attack (alpha or aoa), one the lift (cl) and one the drag (cd)"), "{error}");
}

const C81: &str = "Test section                   2 3 1 3 0 0
          0.20   0.60
 -20.00  -0.90  -1.00
   0.00   0.10   0.20
  20.00   1.00   1.20
          0.40
 -20.00   0.20
   0.00   0.01
  20.00   0.25
";

#[test]
fn c81_tables_that_end_early_are_extended_and_keep_their_mach_numbers() {
    let (said, polars) = made("c81", &[("a.c81", C81)], &[]);
    assert!(
        said.contains(
            "a C81 table of Test section; Mach numbers 0.2, 0.4, 0.6; 3 angles from -20 to 20 deg"
        ),
        "{said}"
    );
    assert_eq!(machs(&polars), [0.2, 0.4, 0.6]);
    assert_eq!(at(&polars[0], 20.0), (1.0, 0.25));
    let (lift, drag) = at(&polars[1], 20.0);
    assert!((lift - 1.1).abs() < 1e-12 && drag == 0.25);
    let file = folder("c81").join("out.polar");
    assert_eq!(
        Airfoil::read(&file).unwrap().range(Axis::Mach),
        Some((0.2, 0.6))
    );
    let bad = C81.replace(" 2 3 1 3 0 0", " 2 x 1 3 0 0");
    let error = refused("c81-bad", &[("a.c81", &bad)], &[]);
    assert!(error.contains("`x` is not a count"), "{error}");
}

/// A .polar file has Reynolds or Mach numbers; a file of DUST may have both.
#[test]
fn of_a_dust_file_for_several_reynolds_numbers_one_axis_is_taken() {
    let set = |re: &str, lift: &str| {
        format!(
            "{re}    0.200\n 020202020202\n 0.2 0.6\n-20 -0.9 -1.0\n20 {lift} 1.2\n 0.2 0.6\n-20 0.2 0.3\n20 0.2 0.3\n 0.2 0.6\n-20 0 0\n20 0 0\n"
        )
    };
    let text = format!(
        "2 0 0\n0 1\n0.158 0.158\nCOMMENT#1\n{}{}",
        set("500000.0", "1.0"),
        set("1000000.0", "1.1")
    );
    let error = refused("dust", &[("a.c81", &text)], &[]);
    assert!(
        error.contains("the Reynolds numbers 500000, 1000000 and the Mach numbers 0.2, 0.6")
            && error.contains("`--by reynolds --at MACH` or `--by mach --at REYNOLDS`"),
        "{error}"
    );
    let (_, polars) = made(
        "dust-mach",
        &[("a.c81", &text)],
        &["--by", "mach", "--at", "1e6"],
    );
    assert_eq!(machs(&polars), [0.2, 0.6]);
    assert_eq!(at(&polars[0], 20.0), (1.1, 0.2));
    let (said, polars) = made(
        "dust-re",
        &[("a.c81", &text)],
        &["--by", "reynolds", "--at", "0.6"],
    );
    assert_eq!(reynolds(&polars), [5e5, 1e6]);
    assert_eq!(at(&polars[1], 20.0), (1.2, 0.3));
    assert!(said.contains("set models.compressibility = none"), "{said}");
    let error = refused(
        "dust-other",
        &[("a.c81", &text)],
        &["--by", "mach", "--at", "7"],
    );
    assert!(
        error.contains("no polar has the Reynolds number 7 of --at; they have 500000, 1000000"),
        "{error}"
    );
}

#[test]
fn polars_at_several_mach_numbers_become_blocks_by_mach_number() {
    let (a, b) = (
        xfoil("1.000 e 6", "0.200", ROWS),
        xfoil("1.000 e 6", "0.500", ROWS),
    );
    let (_, polars) = made("machs", &[("a.txt", &a), ("b.txt", &b)], &[]);
    assert_eq!(machs(&polars), [0.2, 0.5]);
    let error = refused("twice", &[("a.txt", &a), ("b.txt", &a)], &[]);
    assert!(
        error.contains("a.txt and b.txt are both for the Reynolds number 1000000; leave one out"),
        "{error}"
    );
}

/// The formulae of Viterna & Corrigan (1982), written here a second time.
#[test]
fn data_stay_as_they_are_and_the_rest_follows_viterna_and_corrigan() {
    let text = xfoil("0.500 e 6", "0.000", ROWS);
    let (said, polars) = made("viterna", &[("a.txt", &text)], &[]);
    assert!(
        !said.contains("the data end"),
        "both stalls are in the data: {said}"
    );
    let blunt = text.replace("0.8000   0.04000", "0.8000   0.70000");
    let (said, _) = made("blunt", &[("a.txt", &blunt)], &["--cd-max", "0.6"]);
    assert!(said.contains("CDmax is 0.7, the largest drag of the data, instead of 0.6"));
    let polar = &polars[0];
    for (alpha, lift, drag) in [(-8.0, -0.7, 0.02), (0.0, 0.1, 0.006), (9.0, 0.8, 0.04)] {
        assert_eq!(at(polar, alpha), (lift, drag));
    }
    let cd_max = 2.01;
    let viterna = |alpha: f64, end: f64, lift: f64, drag: f64| {
        let (a, s) = (alpha.to_radians(), end.to_radians());
        let a2 = (lift - cd_max * s.sin() * s.cos()) * s.sin() / s.cos().powi(2);
        let b2 = (drag - cd_max * s.sin().powi(2)) / s.cos();
        (
            cd_max / 2.0 * (2.0 * a).sin() + a2 * a.cos().powi(2) / a.sin(),
            cd_max * a.sin().powi(2) + b2 * a.cos(),
        )
    };
    let near = |(lift, drag): (f64, f64), expected: (f64, f64)| {
        assert!((lift - expected.0).abs() < 6e-6, "{lift} {expected:?}");
        assert!((drag - expected.1).abs() < 6e-6, "{drag} {expected:?}");
    };
    for alpha in [10.0, 25.0, 45.0, 90.0] {
        near(at(polar, alpha), viterna(alpha, 9.0, 0.8, 0.04));
    }
    let (lift, drag) = viterna(45.0, 9.0, 0.8, 0.04);
    near(at(polar, 135.0), (-0.7 * lift, drag));
    let (lift, drag) = viterna(45.0, 8.0, 0.7, 0.02);
    near(at(polar, -45.0), (-lift, drag));
    near(at(polar, -135.0), (0.7 * lift, drag));
    assert_eq!(at(polar, 180.0), at(polar, -180.0));
    near(at(polar, 180.0), (0.0, 0.006));
    // Without jumps, also where the method begins and changes.
    for coefficient in [&polar.lift, &polar.drag] {
        for pair in coefficient.windows(2) {
            let slope = (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0);
            assert!(slope.abs() < 0.15, "{pair:?}");
        }
    }
}

#[test]
fn rows_that_are_no_data_are_marked_and_the_drawing_shows_them_dashed() {
    let text = xfoil("0.500 e 6", "0.000", ROWS);
    made("marks", &[("a.txt", &text)], &["--name", "A <name>"]);
    let folder = folder("marks");
    let polar = fs::read_to_string(folder.join("out.polar")).unwrap();
    let rows = polar.lines().filter(|l| l.starts_with(' '));
    for row in rows {
        let alpha: f64 = row.split_whitespace().next().unwrap().parse().unwrap();
        assert_eq!(
            row.ends_with("# extended"),
            !(-8.0..=9.0).contains(&alpha),
            "{row}"
        );
    }
    for part in [
        "NASA CP-2230",
        "CDmax = 2.01",
        "a.txt: an XFOIL polar",
        "name A <name>",
    ] {
        assert!(polar.contains(part), "{part}: {polar}");
    }
    assert!(polar.lines().all(|line| line.chars().count() <= 100));
    let drawing = fs::read_to_string(folder.join("out.svg")).unwrap();
    roxmltree::Document::parse(&drawing).unwrap();
    for part in [
        "A &lt;name&gt;; dashed: extended, no data",
        "Re 500000",
        "lift coefficient",
        "drag coefficient",
    ] {
        assert!(drawing.contains(part), "{part}");
    }
    // A full circle needs nothing.
    let whole = "polar 1\nname B\nreynolds 1e5\n-180 0 0.1\n0 0.3 0.01\n180 0 0.1\n";
    made("whole", &[("b.polar", whole)], &[]);
    let polar = fs::read_to_string(self::folder("whole").join("out.polar")).unwrap();
    assert!(!polar.contains("extended"), "{polar}");
}

#[test]
fn the_flat_plate_is_reached_beyond_the_range_of_the_blend() {
    let text = xfoil("0.500 e 6", "0.000", ROWS);
    let arguments = ["--method", "flat-plate", "--blend", "10", "--cd-max", "1.9"];
    let (_, polars) = made("plate", &[("a.txt", &text)], &arguments);
    for alpha in [19.0_f64, 45.0, 90.0, 135.0, -18.0, -45.0, -120.0] {
        let (sin, cos) = alpha.to_radians().sin_cos();
        let (lift, drag) = at(&polars[0], alpha);
        assert!((lift - 1.9 * sin * cos).abs() < 6e-6, "{alpha}: {lift}");
        assert!((drag - 1.9 * sin * sin).abs() < 6e-6, "{alpha}: {drag}");
    }
    // Halfway the mean of both.
    let (sin, cos) = 14.0_f64.to_radians().sin_cos();
    let (lift, drag) = at(&polars[0], 14.0);
    assert!((lift - 0.5 * (0.8 + 1.9 * sin * cos)).abs() < 6e-6);
    assert!((drag - 0.5 * (0.04 + 1.9 * sin * sin)).abs() < 6e-6);
}

#[test]
fn data_of_one_side_are_mirrored_only_on_request() {
    let half = xfoil(
        "0.500 e 6",
        "0.000",
        "   0.000   0.0000   0.00600\n   6.000   0.7000   0.01300\n   9.000   0.6500   0.04000\n",
    );
    let error = refused("half", &[("a.txt", &half)], &[]);
    assert!(
        error.contains("a.txt has no angles below 0; if the section is symmetric, add --symmetric"),
        "{error}"
    );
    let (_, polars) = made("mirrored", &[("a.txt", &half)], &["--symmetric"]);
    assert_eq!(
        (at(&polars[0], -6.0), at(&polars[0], 6.0)),
        ((-0.7, 0.013), (0.7, 0.013))
    );
    let cambered = half.replace("0.0000   0.00600", "0.2000   0.00600");
    let error = refused("cambered", &[("a.txt", &cambered)], &["--symmetric"]);
    assert!(
        error.contains("a lift coefficient of 0.2 at 0 deg, so the section is not symmetric"),
        "{error}"
    );
    let both = xfoil("0.500 e 6", "0.000", ROWS);
    let error = refused("both-sides", &[("a.txt", &both)], &["--symmetric"]);
    assert!(
        error.contains("a.txt has angles below 0, such as -8 deg; leave --symmetric out"),
        "{error}"
    );
}

/// The tables of Sheldahl & Klimas and others run from 0 to 360 deg.
#[test]
fn angles_up_to_360_deg_are_those_below_0() {
    let text = "alpha,cl,cd\n0,0.1,0.01\n90,0,2\n180,0,0.1\n270,0,1.8\n355,-0.5,0.02\n";
    let (said, polars) = made("circle", &[("a.csv", text)], &["--reynolds", "1e6"]);
    assert!(
        said.contains("angles above 180 deg are written as those below 0"),
        "{said}"
    );
    assert_eq!(
        (at(&polars[0], -5.0), at(&polars[0], -90.0)),
        ((-0.5, 0.02), (0.0, 1.8))
    );
    assert_eq!(
        (at(&polars[0], -180.0), at(&polars[0], 180.0)),
        ((0.0, 0.1), (0.0, 0.1))
    );
}

#[test]
fn each_mistake_has_its_sentence() {
    let rows = |rows: &str| xfoil("0.500 e 6", "0.000", rows);
    let before_stall = rows(
        "  -5.000  -0.5000   0.01000\n   0.000   0.0000   0.01000\n   5.000   0.5000   0.01000\n",
    );
    let (said, _) = made("before-stall", &[("a.txt", &before_stall)], &[]);
    for part in [
        "a.txt: the data end at -5 deg, where the lift still falls; the stall beyond is the method's",
        "a.txt: the data end at 5 deg, where the lift still rises; the stall beyond is the method's",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let different = rows(&format!("{ROWS}   0.000   0.2000   0.00600\n"));
    let negative = rows(&ROWS.replace("0.00600   0.00100", "-0.0060   0.00100"));
    let contour =
        "SECTION 7\n1 0\n.8 .1\n.6 .1\n.4 .1\n.2 .1\n0 0\n.2 -.1\n.4 -.1\n.6 -.1\n.8 -.1\n1 0\n";
    let whole = rows(ROWS);
    for (i, (text, arguments, part)) in [
        (different.as_str(), &[][..], "a.txt has two different rows at 0 deg (lift 0.1 and 0.2, drag 0.006 and 0.006); leave one out"),
        (&negative, &[], "the drag coefficient at 0 deg is -0.006; drag cannot be negative"),
        (contour, &[], "it looks like the coordinates of a section, without lift and drag; compute polars of the section"),
        ("a letter\nto somebody\n", &[], "no table of angle, lift and drag is found in it; the forms are polars of XFOIL"),
        ("", &[], "no table of angle, lift and drag is found in it"),
        (&whole, &["--cd-max", "9"], "--cd-max must lie between 0.5 and 4"),
        (&whole, &["--blend", "0"], "--blend must lie between 1 and 90 deg"),
        ("alpha,cl,cd\n-5,-0.5,0.02\n5,0.6,0.01\n", &["--reynolds", "1e5,2e5"], "--reynolds gives 2 numbers, but 1 polars have none in their files"),
        ("alpha,cl,cd\n-5,-0.5,0.02\n5,60,0.01\n", &["--reynolds", "1e5"], "these data make no .polar file that the FMU reads; nothing is written"),
    ].into_iter().enumerate() {
        let error = refused(&format!("mistake-{i}"), &[("a.txt", text)], arguments);
        assert!(error.contains(part), "{part}: {error}");
    }
    let (mut command, _) = command("no-file", &[], &["missing.txt"]);
    assert!(fail(&mut command).contains("cannot read missing.txt"));
    let mut other = program();
    other.args(["polar", "a.txt", "--out", "a.txt"]);
    assert!(fail(&mut other).contains("--out must end in .polar"));
}

/// Who gives the FMU a file of another program is told a command, which must work.
#[test]
fn the_command_in_the_error_of_the_fmu_makes_a_file_that_it_reads() {
    let folder = folder("told");
    let file = folder.join("my section.txt");
    fs::write(&file, xfoil("0.500 e 6", "0.000", ROWS)).unwrap();
    let error = Airfoil::read(&file).unwrap_err().to_string();
    let (what, told) = error.split_once("run: helicopter-rotor ").unwrap();
    assert!(
        what.contains("it looks like an XFOIL polar; the FMU reads .polar"),
        "{what}"
    );
    let arguments: Vec<&str> = told
        .split('"')
        .map(str::trim)
        .filter(|s| !s.is_empty())
        .collect();
    assert_eq!(arguments[0], "polar");
    succeed(program().current_dir(&folder).args(&arguments));
    assert!(Airfoil::read(&folder.join("my section.polar")).is_ok());
    assert!(Path::new(&folder.join("my section.svg")).exists());
}
