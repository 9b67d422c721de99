// The rotors of the page, the values that the page's controls have, and the FMU's values that follow from them.

const DEG = Math.PI / 180;

const $ = (id) => document.getElementById(id);

// `fixed` are values of the FMU; `start` those of the controls; `most` the ends of their ranges; `dragArea` (m2) is that
// of the body below the rotor; with the values in `measured` the rotor is the one that was measured in hover.
const ROTORS = {
    a109: {
        title: "Main rotor of the Agusta A109",
        source: "Heffley & Mnich (1988), NASA CR-177476, as two public programs copy its table: dimensions, inertia, and 10.8 ft² of drag area along x. Assumed: NACA 0012, a cutout of 0.2, and the pitch, which carries the weight of 24 kN.",
        fixed: {
            "geometry.radius": 5.4864,
            "geometry.rootCutout": 0.2,
            "airfoil.file": "airfoils/naca0012.polar",
            "flapping.hingeOffset": 0.5 / 18,
            "flapping.inertia": 287.43,
        },
        start: {
            collective: 9.8,
            cyclicLongitudinal: 3,
            cyclicLateral: -1.5,
            rpm: 385,
            tilt: 3.5,
            speed: 50,
            blades: 4,
            twist: -6,
            chord: 0.33528,
        },
        most: { rpm: 500, speed: 90, climb: 25, chord: 0.8 },
        dragArea: 1.0,
    },
    "knight-hefner": {
        title: "Model rotor of Knight & Hefner (1937)",
        source: "NACA TN 626: 5 ft, NACA 0015, hinges at 1 in, 960 rev/min. Assumed: a Lock number of 6, and the drag area.",
        fixed: {
            "geometry.radius": 0.762,
            "geometry.rootCutout": 1 / 6,
            "airfoil.file": "airfoils/naca0015-knight-hefner-reynolds.polar",
            "flapping.hingeOffset": 1 / 30,
            "flapping.lockNumber": 6,
            "air.atmosphere": "userDefined",
            "air.density": 1.164,
            "air.temperature": 303.15,
        },
        start: { collective: 8, rpm: 960, speed: 0, blades: 4, twist: 0, chord: 0.0508 },
        most: { rpm: 1600, speed: 30, climb: 10, chord: 0.12 },
        dragArea: 0.008,
        measured: { chord: 0.0508, twist: 0, rpm: 960 },
    },
    propeller: {
        title: "Rotor of a small quadrotor",
        source: "A size that students build. All numbers are assumed.",
        fixed: {
            "geometry.radius": 0.127,
            "geometry.rootCutout": 1 / 6,
            "airfoil.file": "airfoils/naca0012.polar",
            "flapping.inertia": 4.8e-5,
        },
        start: { collective: 17, rpm: 5000, speed: 0, blades: 2, twist: -8, chord: 0.024, flapping: false },
        most: { rpm: 9000, speed: 25, climb: 12, chord: 0.04 },
        dragArea: 0.004,
    },
};

// The controls: their ranges, where these do not depend on the rotor, and the steps of their values.
const CONTROLS = [
    { name: "collective", label: "Collective", unit: "°", least: -5, most: 25, step: 0.1, group: "controls" },
    {
        name: "cyclicLongitudinal",
        label: "Cyclic, forward",
        unit: "°",
        least: -10,
        most: 10,
        step: 0.1,
        group: "controls",
    },
    { name: "cyclicLateral", label: "Cyclic, lateral", unit: "°", least: -10, most: 10, step: 0.1, group: "controls" },
    { name: "rpm", label: "Rotor speed", unit: "rev/min", least: 100, step: 5, group: "controls" },
    { name: "tilt", label: "Shaft tilt, forward", unit: "°", least: -20, most: 20, step: 0.5, group: "flight" },
    { name: "speed", label: "Flight speed", unit: "m/s", least: 0, step: 0.5, group: "flight" },
    { name: "climb", label: "Climb", unit: "m/s", step: 0.1, group: "flight" },
    { name: "blades", label: "Blades", unit: "", least: 1, most: 8, step: 1, group: "blades" },
    { name: "twist", label: "Twist", unit: "°", least: -20, most: 10, step: 0.5, group: "blades" },
    { name: "chord", label: "Chord", unit: "m", least: 0.01, step: 0.0001, group: "blades" },
];

const COMMON = {
    collective: 8,
    cyclicLongitudinal: 0,
    cyclicLateral: 0,
    tilt: 0,
    climb: 0,
    inflow: "pittPetersDynamic",
    flapping: true,
};

// The values of all controls at the start.
function startOf(rotor) {
    return { rotor, ...COMMON, ...ROTORS[rotor].start };
}

function rangeOf({ name, least, most, step }, rotor) {
    const end = most ?? ROTORS[rotor].most[name];
    return { min: least ?? -end, max: end, step };
}

// Blades cannot flap in the closed form, which holds for axial flow past rigid blades.
function canFlap(state) {
    return state.inflow !== "annulusClosedForm";
}

// The FMU's values for those of the controls. With 20 elements and steps of 6 degrees, instead of the FMU's 40 and 3,
// results change by some tenths of a per cent, and are there four times as fast.
function fmuValues(state) {
    return {
        ...ROTORS[state.rotor].fixed,
        "geometry.numberOfBlades": state.blades,
        "geometry.chord": state.chord,
        "geometry.twist": state.twist * DEG,
        "models.inflow": state.inflow,
        "flapping.enabled": state.flapping && canFlap(state),
        "numerics.elements": 20,
        "numerics.azimuthStep": 6 * DEG,
        collective: state.collective * DEG,
        cyclicLongitudinal: state.cyclicLongitudinal * DEG,
        cyclicLateral: state.cyclicLateral * DEG,
        rpm: state.rpm,
        tilt: state.tilt * DEG,
        "velocity[1]": state.speed,
        "velocity[3]": state.climb,
    };
}

// What the picture of the rotor needs: lengths in radii, angles in rad.
function drawnRotor(state) {
    const { fixed, most, start } = ROTORS[state.rotor];
    const radius = fixed["geometry.radius"];
    return {
        blades: state.blades,
        tilt: state.tilt * DEG,
        collective: state.collective * DEG,
        twist: state.twist * DEG,
        longitudinal: state.cyclicLongitudinal * DEG,
        lateral: state.cyclicLateral * DEG,
        chord: state.chord / radius,
        cutout: fixed["geometry.rootCutout"],
        hinge: fixed["flapping.hingeOffset"] ?? 0,
        speed: state.speed,
        climb: state.climb,
        fastest: most.speed,
        // With CT = 0.008 in air of 1.225 kg/m3, at the speed that the rotor starts with.
        referenceForce: 0.0098 * Math.PI * radius ** 4 * ((start.rpm * Math.PI) / 30) ** 2,
    };
}

// The part of a link after the #: what differs from the rotor's start.
function toLink(state) {
    const start = startOf(state.rotor);
    const changed = Object.keys(start).filter((name) => state[name] !== start[name]);
    return new URLSearchParams([["rotor", state.rotor], ...changed.map((name) => [name, state[name]])]).toString();
}

// What a link says; what is unknown or out of range in it is left out.
function fromLink(link, inflowModels) {
    const said = new URLSearchParams(link.replace(/^#/, ""));
    const rotor = Object.hasOwn(ROTORS, said.get("rotor")) ? said.get("rotor") : "a109";
    const state = startOf(rotor);
    for (const control of CONTROLS) {
        const { min, max } = rangeOf(control, rotor);
        const value = Number(said.get(control.name) || NaN);
        if (value >= min && value <= max) state[control.name] = value;
    }
    state.blades = Math.round(state.blades);
    if (inflowModels.includes(said.get("inflow"))) state.inflow = said.get("inflow");
    if (["true", "false"].includes(said.get("flapping"))) state.flapping = said.get("flapping") === "true";
    return state;
}

// The points that Knight & Hefner measured in hover, from the file in fmu-examples/data/.
function measuredPoints(text) {
    const [names, ...rows] = text
        .split("\n")
        .filter((line) => line && !line.startsWith("#"))
        .map((line) => line.split(","));
    const column = (row, name) => Number(row[names.indexOf(name)]);
    return rows.map((row) => ({
        blades: column(row, "blades"),
        ct: column(row, "CT_rotor"),
        cq: column(row, "CQ_rotor"),
    }));
}
