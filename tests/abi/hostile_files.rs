//! Files that are made to do harm: they never hang an instance, and what they say does not flood
//! the log. The error is a sentence, as for any other file. `crates/rotor/tests/memory.rs` tests
//! how much memory they take.

use crate::support::{Instance, c, fmu::scratch};
use std::fs;

/// Writes a file of this test.
fn written(name: &str, content: &str) -> String {
    let folder = scratch().join("hostile-files");
    fs::create_dir_all(&folder).unwrap();
    let file = folder.join(name);
    fs::write(&file, content).unwrap();
    file.to_str().unwrap().to_owned()
}

/// The message with which the initialisation with a file is refused.
#[track_caller]
fn message(parameter: &str, file: &str) -> String {
    let instance = Instance::new();
    assert_eq!(instance.set_string(parameter, file), c::OK);
    instance.begin_initialization();
    let message = instance.refused(instance.exit_initialization());
    assert!(message.contains(parameter), "{message}");
    message
}

#[cfg(target_os = "linux")]
#[test]
fn files_of_the_system_neither_hang_an_instance_nor_fill_its_memory() {
    use std::{sync::mpsc, thread, time::Duration};
    for parameter in ["airfoil.file", "geometry.file"] {
        for file in [
            "/proc/kmsg",
            "/proc/self/pagemap",
            "/dev/zero",
            "/dev/stdin",
        ] {
            let (done, wait) = mpsc::channel();
            thread::spawn(move || done.send(message(parameter, file)));
            let message = wait.recv_timeout(Duration::from_secs(10));
            let message =
                message.unwrap_or_else(|_| panic!("{parameter} = {file} hangs or panics"));
            assert!(message.contains(file), "{message}");
        }
    }
}

/// Each message has at most 500 characters, and at most 80 of the file in one piece.
#[test]
fn a_line_of_ten_million_characters_does_not_flood_the_log() {
    let long = "y".repeat(10_000_000);
    let short = &long[..200_000];
    for (parameter, name, content) in [
        ("airfoil.file", "line.polar", long.clone()),
        (
            "airfoil.file",
            "number.polar",
            format!("polar 1\nreynolds {long}"),
        ),
        ("airfoil.file", "line.c81", long.clone()),
        ("airfoil.file", "line.txt", format!("#1\n{long}")),
        (
            "airfoil.file",
            "table.txt",
            format!("#1\ndouble {long}(1,1)\n"),
        ),
        ("geometry.file", "key.toml", format!("{short} = 1")),
        (
            "geometry.file",
            "value.toml",
            format!("radius = \"{short}\""),
        ),
        ("geometry.file", "large.toml", long.clone()),
        ("airfoil.file", "large.polar", long.repeat(2)),
    ] {
        let message = message(parameter, &written(name, &content));
        let longest = message.split(|c| c != 'y').map(str::len).max();
        assert!(longest <= Some(80), "{message}");
        assert!(message.chars().count() <= 500, "{message}");
        assert!(message.contains(name), "{message}");
    }
}

#[test]
fn an_endless_path_leaves_the_parameter_and_the_remedy_in_the_message() {
    for parameter in ["airfoil.file", "geometry.file"] {
        let message = message(parameter, &"y".repeat(50_000));
        assert_eq!(message.chars().count(), 500);
        assert!(
            message.contains('…') && message.ends_with("exists and is text"),
            "{message}"
        );
    }
}

#[test]
fn the_name_of_a_section_is_logged_with_at_most_80_characters() {
    let name = "y".repeat(1_000_000);
    let text = format!("polar 1\nname {name}\nreynolds 1\n-180 0 0.1\n180 0 0.1\n");
    let instance = Instance::new();
    assert_eq!(instance.set_debug_logging(true, &[]), c::OK);
    let file = written("name.polar", &text);
    assert_eq!(instance.set_string("airfoil.file", &file), c::OK);
    instance.initialize();
    let log = instance.take_log();
    let lines = log.iter().map(|line| line.message.as_str());
    let longest = lines
        .flat_map(|m| m.split(|c| c != 'y'))
        .map(str::len)
        .max();
    assert_eq!(longest, Some(79), "{log:?}");
}
