//! The C interface as an importer sees it: the shared library out of the packaged .fmu.

mod support;

mod abi {
    mod arguments;
    mod both_interfaces;
    mod capabilities;
    mod course;
    mod dependencies;
    mod derivatives;
    mod exports;
    mod extremes;
    mod files;
    mod fmu_state;
    mod input_derivatives;
    mod legality;
    mod logging;
    mod many;
    mod model_exchange;
    mod ownership;
    mod pointers;
    mod random;
    mod resources;
    mod serialized;
    mod silence;
    mod values;
}
