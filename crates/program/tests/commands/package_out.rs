//! The file that `package --out` names: what is refused, what is replaced and what stays, also when
//! the program or the machine stops in the middle.

use crate::support::{self, drafts, fail, scratch, succeed};
use std::{
    fs::{self, File},
    os::unix::{
        fs::{FileTypeExt, PermissionsExt, symlink},
        net::UnixListener,
    },
    path::{Path, PathBuf},
    process::Command,
};

/// The command that writes the .fmu with a built library.
fn package(out: &Path) -> Command {
    let mut command = support::program();
    command.arg("--library").arg(support::library());
    command.args(["package", "--out"]).arg(out);
    command
}

/// A new folder.
fn folder(name: &str) -> PathBuf {
    let folder = scratch().join(name);
    fs::create_dir_all(&folder).unwrap();
    folder
}

#[track_caller]
fn assert_is_fmu(file: &Path) {
    let metadata = fs::symlink_metadata(file).unwrap();
    assert!(metadata.is_file() && metadata.len() > 10_000, "{file:?}");
    assert_eq!(fs::read(file).unwrap()[..2], *b"PK");
}

/// Before cargo builds the library, which takes a minute: here there is no cargo.
#[test]
fn what_is_not_a_regular_file_is_refused_at_once_and_stays() {
    let folder = folder("not-regular");
    let [fifo, socket, inside, link] =
        ["fifo", "socket", "folder/inside", "link"].map(|n| folder.join(n));
    succeed(Command::new("mkfifo").arg(&fifo));
    let _listener = UnixListener::bind(&socket).unwrap();
    fs::create_dir_all(&inside).unwrap();
    symlink(&fifo, &link).unwrap();
    for (out, kind) in [
        (&*fifo, "a FIFO"),
        (&link, "a FIFO"),
        (&socket, "a socket"),
        (inside.parent().unwrap(), "a folder"),
        // No file can be made beside this one, so that also a wrong program leaves it alone.
        (Path::new("/dev/pts/ptmx"), "a device"),
    ] {
        let mut command = support::program();
        command.env("CARGO", "/nonexistent");
        let message = fail(command.args(["package", "--out"]).arg(out));
        let expected = format!("Error: {} is {kind} and stays what it is", out.display());
        assert!(message.starts_with(&expected), "{message}");
    }
    assert!(fs::symlink_metadata(&fifo).unwrap().file_type().is_fifo());
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert!(
        fs::symlink_metadata(&socket)
            .unwrap()
            .file_type()
            .is_socket()
    );
    assert!(inside.is_dir());
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 4);
}

#[test]
fn a_path_that_cannot_be_written_is_named() {
    let file = folder("impossible").join("file");
    fs::write(&file, "mine").unwrap();
    for (out, words) in [
        (file.join("rotor.fmu"), "Not a directory"),
        (scratch().join("no-such-folder/"), "ends in a slash"),
        (PathBuf::from(".."), "is a folder"),
    ] {
        let message = fail(&mut package(&out));
        assert!(
            message.contains(&out.display().to_string()) && message.contains(words),
            "{message}"
        );
    }
    assert_eq!(fs::read_to_string(&file).unwrap(), "mine");
}

#[test]
fn a_symbolic_link_stays_and_the_file_to_which_it_leads_is_written() {
    let folder = folder("links");
    fs::create_dir(folder.join("below")).unwrap();
    fs::write(folder.join("below/old.fmu"), "old").unwrap();
    for (link, target) in [
        ("to-old.fmu", "below/old.fmu"),
        ("to-link.fmu", "to-old.fmu"),
        ("dangling.fmu", "below/new.fmu"),
        ("to-dangling.fmu", "below/../dangling.fmu"),
    ] {
        symlink(target, folder.join(link)).unwrap();
    }
    for (out, file) in [
        ("to-link.fmu", "below/old.fmu"),
        ("to-dangling.fmu", "below/new.fmu"),
    ] {
        succeed(&mut package(&folder.join(out)));
        assert_is_fmu(&folder.join(file));
    }
    for link in [
        "to-old.fmu",
        "to-link.fmu",
        "dangling.fmu",
        "to-dangling.fmu",
    ] {
        assert!(
            fs::symlink_metadata(folder.join(link))
                .unwrap()
                .is_symlink()
        );
    }

    symlink("circle.fmu", folder.join("circle.fmu")).unwrap();
    let message = fail(&mut package(&folder.join("circle.fmu")));
    assert!(message.contains("circle.fmu: Too many levels"), "{message}");
}

#[test]
fn a_replaced_file_keeps_its_permissions_and_a_new_one_gets_the_usual_ones() {
    let folder = folder("permissions");
    let [old, new, usual] = ["old.fmu", "new.fmu", "usual"].map(|name| folder.join(name));
    let mode = |file: &Path| fs::metadata(file).unwrap().permissions().mode() & 0o777;
    fs::write(&old, "old").unwrap();
    fs::set_permissions(&old, fs::Permissions::from_mode(0o640)).unwrap();
    fs::write(&usual, "").unwrap();
    for file in [&old, &new] {
        succeed(&mut package(file));
        assert_is_fmu(file);
    }
    assert_eq!((mode(&old), mode(&new)), (0o640, mode(&usual)));
}

/// The command, whose calls are observed, and the file with the calls.
fn observed(out: &Path) -> (Command, PathBuf) {
    let calls = out.with_extension("calls");
    let mut command = package(out);
    support::observe(&mut command, &calls);
    (command, calls)
}

/// Otherwise a power failure shortly afterwards could leave an empty file.
#[test]
fn each_file_is_on_the_disk_before_it_takes_its_place_and_the_folder_afterwards() {
    let folder = folder("durable");
    let out = folder.join("rotor.fmu");
    let (mut command, calls) = observed(&out);
    succeed(&mut command);
    let calls = fs::read_to_string(calls).unwrap();
    let calls: Vec<_> = calls.lines().collect();
    assert_eq!(calls.len(), 6, "{calls:?}");
    for (calls, name) in calls.chunks(3).zip(["rotor.fmu", "rotor-fmi3.fmu"]) {
        let [file, rename, names] = calls else {
            panic!("{calls:?}");
        };
        let prefix = format!("fsync {}/.{name}.", folder.display());
        assert!(file.starts_with(&prefix), "{file}");
        assert_eq!(
            *rename,
            format!("rename to {}", folder.join(name).display())
        );
        assert_eq!(*names, format!("fsync {}", folder.display()));
    }
}

#[test]
fn what_a_killed_run_has_left_is_removed_and_what_another_run_is_making_is_not() {
    let folder = folder("killed");
    let out = folder.join("rotor.fmu");
    fs::write(&out, "old").unwrap();
    // A folder of the user that looks like it.
    let own = folder.join(".rotor.fmu.mine.tmp");
    fs::create_dir(&own).unwrap();
    let kill = || {
        let (mut command, _) = observed(&out);
        command.env("KILLED_AT_RENAME", "yes").output().unwrap();
    };
    let left_over = || {
        let mut drafts = drafts(&folder);
        let is_ours = |name: &str| name.starts_with(".rotor.fmu.");
        drafts
            .retain(|draft| *draft != own && is_ours(draft.file_name().unwrap().to_str().unwrap()));
        drafts
    };

    kill();
    assert_eq!(fs::read_to_string(&out).unwrap(), "old");
    let first = left_over();
    assert_eq!(first.len(), 1, "{first:?}");
    let lock = File::open(first[0].join("helicopter-rotor.lock")).unwrap();
    lock.lock().unwrap();
    kill();
    succeed(&mut package(&out));
    assert_is_fmu(&out);
    assert_eq!(left_over(), first);
    drop(lock);
    succeed(&mut package(&out));
    assert_eq!(drafts(&folder), [own]);
}

#[test]
fn an_error_in_the_middle_leaves_the_older_file_and_nothing_else() {
    let folder = folder("error");
    let out = folder.join("rotor.fmu");
    fs::write(&out, "old").unwrap();
    let mut command = support::program();
    command.arg("--library").arg(support::packaged_fmu());
    fail(command.args(["package", "--out"]).arg(&out));
    assert_eq!(fs::read_to_string(&out).unwrap(), "old");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
}

/// The file of FMI 3.0 cannot be written.
#[test]
fn neither_file_is_replaced_if_the_other_cannot_be_written() {
    let folder = folder("both");
    let out = folder.join("rotor.fmu");
    fs::write(&out, "old").unwrap();
    fs::create_dir(folder.join("rotor-fmi3.fmu")).unwrap();
    let message = fail(&mut package(&out));
    assert!(message.contains("rotor-fmi3.fmu is a folder"), "{message}");
    assert_eq!(fs::read_to_string(&out).unwrap(), "old");
    assert_eq!(drafts(&folder), [] as [PathBuf; 0]);
}

#[test]
fn a_library_without_an_end_is_refused() {
    let fifo = folder("endless").join("library.so");
    succeed(Command::new("mkfifo").arg(&fifo));
    let out = fifo.with_file_name("rotor.fmu");
    let mut command = support::program();
    command.arg("--library").arg(&fifo);
    let message = fail(command.args(["package", "--out"]).arg(&out));
    assert!(
        message.contains("library.so is not a regular file"),
        "{message}"
    );
    assert!(!out.exists());
}
