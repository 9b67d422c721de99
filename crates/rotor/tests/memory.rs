//! What reading a file takes of memory is limited, whatever is in it. Where there is less, the
//! reader says so in a sentence.

use rotor::{airfoil::Airfoil, geometry::Geometry};
use std::{
    alloc::{GlobalAlloc, Layout, System},
    cell::Cell,
    fs,
    path::PathBuf,
    ptr,
};

/// The system's allocator, with the memory of each thread counted and limited.
struct Limited;

thread_local! {
    /// Bytes in use, and the most that there were.
    static USED: Cell<isize> = const { Cell::new(0) };
    static PEAK: Cell<isize> = const { Cell::new(0) };
    static LIMIT: Cell<isize> = const { Cell::new(isize::MAX) };
}

/// Blocks below this size are given in any case: that the last one is there for an error message
/// cannot be promised.
const SMALL: usize = 1024;

impl Limited {
    /// Counts a change; false if the limit forbids it.
    fn change(old: usize, new: usize) -> bool {
        let used = USED.get() + new as isize - old as isize;
        if new > old.max(SMALL) && used > LIMIT.get() {
            return false;
        }
        USED.set(used);
        PEAK.set(PEAK.get().max(used));
        true
    }
}

// SAFETY: what is not refused is passed on to the system's allocator.
unsafe impl GlobalAlloc for Limited {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if !Self::change(0, layout.size()) {
            return ptr::null_mut();
        }
        // SAFETY: passed on from the caller.
        unsafe { System.alloc(layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        if !Self::change(layout.size(), size) {
            return ptr::null_mut();
        }
        // SAFETY: passed on from the caller.
        unsafe { System.realloc(pointer, layout, size) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        Self::change(layout.size(), 0);
        // SAFETY: passed on from the caller.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Limited = Limited;

/// A file of these tests.
fn written(name: &str, content: String) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::write(&path, content).unwrap();
    path
}

/// The result of a call, and the most memory that was in use, in bytes more than before.
fn peak<T>(call: impl FnOnce() -> T) -> (T, isize) {
    let before = USED.get();
    PEAK.set(before);
    let answer = call();
    (answer, PEAK.get() - before)
}

/// 16 MB of a text.
fn filled(begin: &str, unit: &str) -> String {
    begin.to_owned() + &unit.repeat(16_000_000 / unit.len())
}

/// Blocks of different Reynolds numbers with so many intervals each.
fn blocks(count: u32, intervals: u32) -> String {
    let angle = |i: u32| -180.0 + 360.0 * f64::from(i) / f64::from(intervals);
    let rows = (0..=intervals).map(|i| format!("{} 0 0.1\n", angle(i)));
    let rows: String = rows.collect();
    let block = |i: u32| format!("reynolds {i}\n{rows}");
    "polar 1\n".to_owned() + &(1..=count).map(block).collect::<String>()
}

/// A C81 file of Mach numbers from 0.001 upwards.
fn c81(machs: u32, intervals: u32) -> String {
    let row = |begin: &str, value: f64| {
        let values = (1..=machs).map(|i| format!(" {}", value * f64::from(i)));
        begin.to_owned() + &values.collect::<String>() + "\n"
    };
    let angle = |i: u32| -180.0 + 360.0 * f64::from(i) / f64::from(intervals);
    let rows = (0..=intervals).map(|i| row(&angle(i).to_string(), 0.0));
    let table = row("", 0.001) + &rows.collect::<String>();
    let angles = intervals + 1;
    format!("name {machs} {angles} {machs} {angles}\n{table}{table}")
}

/// The shapes of files that take the most memory. 100,000 Reynolds numbers, in a file of 4 MB, took
/// 400 MB.
#[test]
fn no_file_of_section_data_takes_more_than_200_mb_and_a_wrong_one_leaves_nothing() {
    for (name, content) in [
        ("blocks.polar", blocks(100_000, 1)),
        ("rows.polar", filled("polar 1\nreynolds 1\n", "0 0 0\n")),
        ("row.polar", filled("polar 1\nreynolds 1\n", "0 ")),
        ("lines.c81", filled("name 1 1 1 1\n", "0\n")),
        ("line.c81", filled("name 1 1 1 1\n", "0 ")),
        ("counts.c81", filled("", "1 ")),
        ("values.c81", filled("name 999 999 999 999\n", "0 ")),
        ("rows.c81", c81(999, 998)),
        ("tables.txt", filled("#1\n", "double a(1,1)\n0\n")),
        ("numbers.txt", filled("#1\ndouble a(9999999,9)\n", "0 ")),
        ("name.txt", filled("#1\ndouble ", "a")),
    ] {
        let path = written(name, content);
        let before = USED.get();
        let (_, peak) = peak(|| drop(Airfoil::read(&path)));
        assert!(peak < 200_000_000, "{name} takes {peak} bytes");
        assert_eq!(USED.get(), before, "{name}");
        fs::remove_file(path).unwrap();
    }
}

#[test]
fn no_rotor_file_takes_more_than_30_mb() {
    for (name, content) in [
        (
            "stations.toml",
            "station=[".to_owned() + &"{},".repeat(85_000),
        ),
        ("numbers.toml", "a=[".to_owned() + &"0,".repeat(125_000)),
        ("arrays.toml", "a=".to_owned() + &"[".repeat(250_000)),
        ("keys.toml", "a".to_owned() + &".a".repeat(125_000) + "=1"),
        ("comments.toml", "#\n".repeat(125_000)),
        ("tables.toml", "[[a]]\n".repeat(40_000)),
        (
            "large.toml",
            "station=[".to_owned() + &"{},".repeat(5_000_000),
        ),
        ("text.toml", format!("name=\"{}\"", "\\n".repeat(125_000))),
    ] {
        let path = written(name, content);
        let (answer, peak) = peak(|| Geometry::read(&path));
        assert!(peak < 30_000_000, "{name} takes {peak} bytes");
        assert!(answer.is_err());
        fs::remove_file(path).unwrap();
    }
}

/// With less memory than a file needs, at a hundred places in the reader.
#[test]
fn section_data_without_memory_for_them_are_refused_in_a_sentence() {
    let laws = (1..=999).map(|re| format!("{re} 6 4 0.2 0.01\n"));
    let laws = "#1\ndouble a(999, 5)\n".to_owned() + &laws.collect::<String>();
    for (name, content) in [
        ("long.polar", blocks(2, 30_000)),
        ("many.polar", blocks(999, 40)),
        ("large.c81", c81(100, 200)),
        ("laws.txt", laws),
    ] {
        let path = written(name, content);
        let (answer, needed) = peak(|| Airfoil::read(&path));
        assert!(answer.is_ok(), "{name}: {answer:?}");
        for percent in 0..100 {
            LIMIT.set(USED.get() + needed * percent / 100);
            let answer = Airfoil::read(&path);
            LIMIT.set(isize::MAX);
            let error = answer.unwrap_err().to_string();
            assert!(
                error.contains(name) && error.contains("there is not enough memory for "),
                "{error}"
            );
        }
        fs::remove_file(path).unwrap();
    }
}

/// The parser, the crate toml, takes its memory or ends the process: the reader asks before it.
#[test]
fn a_rotor_file_without_memory_for_it_is_refused_in_a_sentence() {
    let station = |i: u32| format!("{{ r = {}, chord = 0.1 }},\n", 0.2 + 8e-4 * f64::from(i));
    let stations: String = (0..=1000).filter(|i| *i != 999).map(station).collect();
    let text = format!("numberOfBlades = 2\nradius = 1\nstation = [\n{stations}]\n");
    let needed = 100 * text.len() as isize;
    let path = written("long.toml", text);
    for percent in 0..=110 {
        LIMIT.set(USED.get() + needed * percent / 100);
        let answer = Geometry::read(&path);
        LIMIT.set(isize::MAX);
        match answer {
            Ok(_) => assert!(percent > 100, "{percent} %"),
            Err(error) => {
                let error = error.to_string();
                assert!(
                    percent < 110 && error.contains("there is not enough memory for "),
                    "{percent} %: {error}"
                );
            }
        }
    }
    fs::remove_file(path).unwrap();
}
