//! Files that are missing or malformed: the error names parameter, file and remedy or place, the
//! instance goes on with a good file as if nothing had been.

use crate::support::{
    Instance, c,
    fmu::{Fmu, scratch},
    instance::bits,
};
use std::{fs, path::PathBuf};

/// Writes a file of this test.
fn written(name: &str, content: &[u8]) -> String {
    let folder = scratch().join("bad-files");
    fs::create_dir_all(&folder).unwrap();
    let file = folder.join(name);
    fs::write(&file, content).unwrap();
    file.to_str().unwrap().to_owned()
}

/// Asserts that the initialisation with a file is refused in a sentence with `parts`, and succeeds
/// with the default again, with the same results.
#[track_caller]
fn refused(parameter: &str, file: &str, parts: &[&str]) {
    let instance = Instance::new();
    let default = {
        let running = Instance::running();
        running.string(parameter)
    };
    assert_eq!(instance.set_string(parameter, file), c::OK);
    instance.begin_initialization();
    let message = instance.refused(instance.exit_initialization());
    let file = file.replace('%', "%%");
    for part in [&[parameter, file.as_str()], parts].concat() {
        // The value of a parameter is quoted, and its backslashes are doubled.
        let quoted = part.replace('\\', "\\\\");
        assert!(
            message.contains(part) || message.contains(&quoted),
            "{part:?} is not in: {message}"
        );
    }
    assert!(!message.ends_with(['\n', ' ']), "{message:?}");
    assert_eq!(instance.set_string(parameter, &default), c::OK);
    assert_eq!(
        instance.exit_initialization(),
        c::OK,
        "{:?}",
        instance.take_log()
    );
    assert_eq!(bits(&instance.reals()), bits(&Instance::running().reals()));
}

fn good_polar() -> String {
    fs::read_to_string(Fmu::shared().resources().join("airfoils/naca0015.polar")).unwrap()
}

const C81: &str = "\
Test section                   1 3 1 3 1 2
          0.00
-180.00   0.00
   0.00   0.10
 180.00   0.00
          0.00
-180.00   0.03
   0.00   0.01
 180.00   0.03
";

#[test]
fn a_missing_file_is_named_with_the_remedy() {
    let remedy = "give a file that exists";
    for parameter in ["airfoil.file", "geometry.file"] {
        let nowhere = "/no/such/folder/file.polar";
        for file in [
            "missing.polar",
            nowhere,
            "file:///no/such/file.c81",
            "100%s%n.polar",
            "ü.polar",
        ] {
            let path = file.strip_prefix("file://").unwrap_or(file);
            refused(parameter, file, &[remedy, &path.replace('%', "%%")]);
        }
        // A folder is no file.
        refused(parameter, scratch().to_str().unwrap(), &[remedy]);
    }
    refused("airfoil.file", "", &["airfoil.file"]);
}

#[test]
fn malformed_polars_are_refused_with_the_place() {
    let good = good_polar();
    let (half, _) = good.split_at(good.len() / 2);
    let cut_row = &half[..half.rfind(' ').unwrap()];
    let all_bytes: Vec<u8> = (0..=255).collect();
    let small = "polar 1\nreynolds 1e5\n-180 0 0.03\n0 0.1 0.01\n180 0 0.03\n";
    for (name, content, part) in [
        (
            "empty.polar",
            &b""[..],
            "the file is empty; it must begin with `polar 1`",
        ),
        ("comment.polar", b"# nothing\n", "the file is empty"),
        ("bytes.polar", &all_bytes, "text"),
        ("utf-16.polar", b"\xff\xfep\0o\0l\0a\0r\0", "text"),
        ("zeros.polar", b"polar 1\n\0\0\0\n", "line 2"),
        ("truncated.polar", half.as_bytes(), "line "),
        ("truncated-row.polar", cut_row.as_bytes(), "line "),
        (
            "header-only.polar",
            b"polar 1\nname x\n",
            "no `reynolds` or `mach` block",
        ),
        (
            "nan.polar",
            small.replace("0.1 ", "nan ").as_bytes(),
            "line 4",
        ),
        (
            "infinite.polar",
            small.replace("0.1 ", "1e999 ").as_bytes(),
            "line 4",
        ),
        (
            "reynolds.polar",
            small.replace("1e5", "-1e5").as_bytes(),
            "line 2",
        ),
        (
            "drag.polar",
            small.replace("0.01", "-0.01").as_bytes(),
            "line 4",
        ),
        (
            "words.polar",
            small.replace("0.1 ", "O.1 ").as_bytes(),
            "line 4",
        ),
    ] {
        refused("airfoil.file", &written(name, content), &[name, part]);
    }
    // What was changed is otherwise good.
    let instance = Instance::new();
    assert_eq!(
        instance.set_string("airfoil.file", &written("small.polar", small.as_bytes())),
        c::OK
    );
    instance.initialize();
}

#[test]
fn malformed_c81_files_are_refused_with_the_place() {
    let all_bytes: Vec<u8> = (0..=255).collect();
    for (name, content, part) in [
        ("empty.c81", &b""[..], "line 1"),
        ("bytes.c81", &all_bytes, "text"),
        ("truncated.c81", &C81.as_bytes()[..C81.len() / 2], "line "),
        (
            "counts.c81",
            C81.replace(" 1 3 1 3", "99999999").as_bytes(),
            "line ",
        ),
        (
            "letters.c81",
            "ü".repeat(60).as_bytes(),
            "line 1, column 31",
        ),
        ("nan.c81", C81.replace("0.10", " nan").as_bytes(), "line 4"),
    ] {
        refused("airfoil.file", &written(name, content), &[name, part]);
    }
    let instance = Instance::new();
    assert_eq!(
        instance.set_string("airfoil.file", &written("good.c81", C81.as_bytes())),
        c::OK
    );
    instance.initialize();
}

const COMBI: &str = "#1\ndouble airfoil(1, 7)\n1e5 6 4 0.2 0.01 0 0.5\n";

#[test]
fn malformed_combi_tables_are_refused_with_the_place() {
    let all_bytes: Vec<u8> = [b"#1\n".to_vec(), (0..=255).collect()].concat();
    for (name, content, part) in [
        ("empty.txt", &b""[..], "line 1"),
        ("only.txt", b"#1", "has no table"),
        ("bytes.txt", &all_bytes, "text"),
        (
            "truncated.txt",
            &COMBI.as_bytes()[..COMBI.len() - 5],
            "ends after 6 numbers",
        ),
        (
            "size.txt",
            COMBI.replace("1, 7", "2, 7").as_bytes(),
            "ends after 7 numbers",
        ),
        (
            "nan.txt",
            COMBI.replace(" 6 ", " nan ").as_bytes(),
            "line 3, column 5",
        ),
        (
            "degrees.txt",
            COMBI.replace("0.2", "12").as_bytes(),
            "angles are in rad",
        ),
        (
            "columns.txt",
            COMBI.replace("1, 7", "7, 1").as_bytes(),
            "5 to 11 columns",
        ),
    ] {
        refused("airfoil.file", &written(name, content), &[name, part]);
    }
    let instance = Instance::new();
    assert_eq!(
        instance.set_string("airfoil.file", &written("good.txt", COMBI.as_bytes())),
        c::OK
    );
    instance.initialize();
}

#[test]
fn malformed_rotor_files_are_refused_with_the_place() {
    let good = "numberOfBlades = 2\nradius = 1.0\nstation = [\n\
        { r = 0.2, chord = 0.1 },\n{ r = 1.0, chord = 0.1, airfoil = \"naca0015.polar\" },\n]\n";
    let changed = |from: &str, to: &str| {
        assert!(good.contains(from));
        good.replacen(from, to, 1).into_bytes()
    };
    let all_bytes: Vec<u8> = (0..=255).collect();
    for (name, content, part) in [
        ("empty.toml", vec![], "missing field"),
        ("bytes.toml", all_bytes, "text"),
        (
            "truncated.toml",
            good.as_bytes()[..good.len() / 2].to_vec(),
            "line ",
        ),
        ("blades.toml", changed("= 2", "= 0"), "must be 1 or more"),
        ("minus.toml", changed("= 2", "= -2"), "line 1"),
        (
            "radius.toml",
            changed("1.0", "-1.0"),
            "must lie between 0.001 and 1000 m",
        ),
        (
            "infinite.toml",
            changed("1.0", "inf"),
            "must lie between 0.001 and 1000 m",
        ),
        ("nan.toml", changed("0.1 }", "nan }"), "chord"),
        ("station.toml", changed("r = 0.2", "r = nan"), "station"),
        ("cutout.toml", changed("r = 0.2", "r = 1.2"), "outwards"),
        (
            "typing-error.toml",
            changed("radius", "raduis"),
            "unknown field `raduis`",
        ),
        (
            "no-airfoil.toml",
            changed("naca0015", "naca0016"),
            "naca0016.polar",
        ),
    ] {
        refused("geometry.file", &written(name, &content), &[name, part]);
    }
    let instance = Instance::new();
    assert_eq!(
        instance.set_string("geometry.file", &written("good.toml", good.as_bytes())),
        c::OK
    );
    instance.initialize();
}

/// Finite numbers that no rotor has: a refusal or finite results, nothing else.
#[test]
fn absurd_numbers_in_files_are_refused_and_steep_tables_stay_finite() {
    let rotor = |blades: &str, radius: &str, chord: &str, twist: &str| {
        format!(
            "numberOfBlades = {blades}\nradius = {radius}\nstation = [\n\
             {{ r = 0.2, chord = {chord}, twist = {twist} }},\n{{ r = 1.0, chord = 0.1 }},\n]\n"
        )
    };
    let polar = |lift: &str, drag: &str, reynolds: &str| {
        format!(
            "polar 1\nreynolds {reynolds}\n-180 0 0\n0 {lift} {drag}\n1e-300 {lift} 0\n180 0 0\n"
        )
    };
    for (parameter, name, content, refusal) in [
        (
            "geometry.file",
            "blades-absurd.toml",
            rotor("4294967295", "1.0", "0.1", "0.0"),
            "must be 20 or fewer",
        ),
        (
            "geometry.file",
            "big.toml",
            rotor("2", "1e100", "0.1", "0.0"),
            "the rotor radius is 1e100 m; it must lie between",
        ),
        (
            "geometry.file",
            "tiny.toml",
            rotor("2", "1e-300", "0.1", "0.0"),
            "the rotor radius is 1e-300 m",
        ),
        (
            "geometry.file",
            "chord-absurd.toml",
            rotor("2", "1.0", "1e100", "0.0"),
            "at the blade station r/R = 0.2 the chord is 1e100 m",
        ),
        (
            "geometry.file",
            "twist-absurd.toml",
            rotor("2", "1.0", "0.1", "1e300"),
            "at the blade station r/R = 0.2 the twist is",
        ),
        (
            "airfoil.file",
            "lift-absurd.polar",
            polar("1e300", "0", "1e5"),
            "line 4: the coefficient at 0 deg is 1e300; it must lie between",
        ),
        (
            "airfoil.file",
            "drag-absurd.polar",
            polar("0", "1e300", "1e5"),
            "line 4: the coefficient at 0 deg is 1e300; it must lie between",
        ),
        (
            "airfoil.file",
            "both-absurd.polar",
            polar("-1e308", "1e308", "1e5"),
            "line 4: the coefficient at 0 deg is -1e308",
        ),
        (
            "airfoil.file",
            "combi-absurd.txt",
            COMBI.replace("0.01 0 0.5", "1e300 0 1e307"),
            "the drag polynomial gives 1e300 at 0.00 deg",
        ),
        (
            "airfoil.file",
            "combi-steep.txt",
            COMBI.replace("6 4 0.2", "20 0 1e-300"),
            "",
        ),
        (
            "airfoil.file",
            "reynolds-absurd.polar",
            polar("1", "0.1", "1e308"),
            "line 2: Reynolds number 1e308 must lie between",
        ),
        ("airfoil.file", "steep.polar", polar("10", "10", "1e5"), ""),
    ] {
        let instance = Instance::new();
        assert_eq!(
            instance.set_string(parameter, &written(name, content.as_bytes())),
            c::OK
        );
        instance.begin_initialization();
        let status = instance.exit_initialization();
        if refusal.is_empty() {
            assert_eq!(status, c::OK, "{name}: {:?}", instance.take_log());
            let reals = instance.reals();
            assert!(
                reals.iter().all(|value| value.is_finite()),
                "{name}: {reals:?}"
            );
        } else {
            let message = instance.refused(status);
            assert!(
                message.contains(name) && message.contains(refusal),
                "{message}"
            );
        }
    }
}

#[test]
fn a_file_may_be_named_by_its_name_its_place_in_resources_its_path_or_its_uri() {
    let path: PathBuf = Fmu::shared().resources().join("airfoils/naca0015.polar");
    let path = path.to_str().unwrap();
    let copy = written("a copy, 50% ü.polar", good_polar().as_bytes());
    let copy_uri = crate::support::fmu::uri(copy.as_ref());
    let thrusts: Vec<u64> = [
        "naca0015.polar",
        "airfoils/naca0015.polar",
        path,
        &format!("file://{path}"),
        &copy,
        &copy_uri,
    ]
    .iter()
    .map(|name| {
        let instance = Instance::new();
        assert_eq!(instance.set_string("airfoil.file", name), c::OK);
        instance.initialize();
        instance.real("thrust").to_bits()
    })
    .collect();
    assert!(
        thrusts.iter().all(|thrust| *thrust == thrusts[0]),
        "{thrusts:?}"
    );
    assert_ne!(
        thrusts[0],
        Instance::running().real("thrust").to_bits(),
        "the default is another"
    );
}
