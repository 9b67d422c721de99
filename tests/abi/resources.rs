//! Where the resources are found: by the location that the importer passes, else by where the
//! library lies.

use crate::support::{
    Creation, Fmu, Instance,
    fmu::{scratch, unpack_into, uri},
};
use std::{path::Path, sync::OnceLock};

/// The FMU unpacked in a folder with a name that must be percent-encoded.
fn odd() -> &'static Fmu {
    static FMU: OnceLock<Fmu> = OnceLock::new();
    FMU.get_or_init(|| {
        let folder = scratch().join("rotor fmü #100%");
        unpack_into(&folder);
        Fmu::load(&folder)
    })
}

/// Asserts that an instance made with a location reads its airfoil below `folder`.
#[track_caller]
fn reads_below(folder: &Path, fmu: &Fmu, location: Option<String>) {
    let tried = format!("{location:?}");
    let creation = Creation {
        resources: location,
        logging_on: true,
        ..Creation::default()
    };
    let instance = Instance::create(fmu, &creation).unwrap();
    instance.initialize();
    let log = instance.take_log();
    let path = folder.join("airfoils");
    let path = path.to_str().unwrap().replace('%', "%%");
    assert!(
        log.iter().any(|line| line.message.contains(&path)),
        "{tried}: {log:?}"
    );
}

/// The library is another copy's, so that its own place would be the wrong one.
#[test]
fn every_way_to_write_the_location_is_understood() {
    let folder = odd().resources();
    let plain = folder.to_str().unwrap().to_owned();
    let encoded = uri(&folder);
    let path = encoded.strip_prefix("file://").unwrap();
    assert!(path.contains("rotor%20fm%C3%BC%20%23100%25"), "{path}");
    for location in [
        encoded.clone(),
        format!("{encoded}/"),
        format!("file:{path}"),
        format!("file://localhost{path}"),
        format!("FILE://{path}"),
        encoded.replace("%C3%BC", "%c3%bc"),
        encoded.replace("%C3%BC", "ü").replace("%20", " "),
        plain.clone(),
        format!("{plain}/"),
    ] {
        reads_below(&folder, Fmu::shared(), Some(location));
    }
}

/// As some importers for Windows write them.
#[cfg(windows)]
#[test]
fn every_way_to_write_a_location_with_a_drive_is_understood() {
    let folder = odd().resources();
    let encoded = uri(&folder);
    let path = encoded.strip_prefix("file:///").unwrap();
    let plain = folder.to_str().unwrap().to_owned();
    assert!(path[1..].starts_with("%3A/"), "{path}");
    for location in [
        format!("file:///{}", path.replacen("%3A", ":", 1)),
        format!("file:///{}", path.replacen("%3A", "|", 1)),
        format!("file://{path}"),
        format!("file:{path}"),
        format!("file:/{path}"),
        format!("file://localhost/{path}"),
        format!("file:///{}", path.replace('/', "\\")),
        plain.replace('\\', "/"),
        plain,
    ] {
        reads_below(&folder, Fmu::shared(), Some(location));
    }
}

#[test]
fn without_a_usable_location_the_resources_beside_the_library_are_found() {
    for fmu in [Fmu::shared(), odd()] {
        let resources = fmu.resources();
        let a_file = uri(&resources.join("airfoils/naca0015.polar"));
        for location in [
            "",
            " ",
            "\t\n",
            "resources",
            "./resources/",
            "file:resources",
            "größe/資源",
            "file:",
            "file://",
            "file:///no/such/folder",
            "/no/such/folder",
            "http://example.org/resources",
            "%",
            "file:///%FF%FE",
            a_file.as_str(),
        ] {
            reads_below(&resources, fmu, Some(location.to_owned()));
        }
        reads_below(&resources, fmu, None);
    }
}

/// A folder that exists but holds no resources, as importers that pass the unpacked FMU's own
/// folder or a temporary one do.
#[test]
fn a_location_without_our_files_in_it_is_not_used() {
    let fmu = Fmu::shared();
    let empty = scratch().join("empty");
    std::fs::create_dir_all(&empty).unwrap();
    reads_below(&fmu.resources(), fmu, Some(uri(&empty)));
    reads_below(&fmu.resources(), fmu, Some(uri(&fmu.folder)));
}

/// An importer may load one FMU into the global namespace, where its functions are found in the
/// place of those of the next.
#[cfg(unix)]
#[test]
fn the_resources_are_found_beside_this_library_where_another_fmu_is_loaded_globally() {
    use crate::support::{child, fmu::binary};
    use libloading::os::unix::{Library, RTLD_GLOBAL, RTLD_NOW};
    let name = "resources::the_resources_are_found_beside_this_library_where_another_fmu_is_loaded_globally";
    if child::run_alone(name).is_some() {
        return;
    }
    let [first, second] = ["loaded-globally", "loaded-next"].map(|name| {
        let folder = scratch().join(name);
        unpack_into(&folder);
        folder
    });
    // SAFETY: the library has no initialisation routines but those of the C runtime.
    let global = unsafe { Library::open(Some(binary(&first)), RTLD_NOW | RTLD_GLOBAL) }.unwrap();
    let fmu = Fmu::load(&second);
    reads_below(&second.join("resources"), &fmu, None);
    drop((fmu, global));
}
