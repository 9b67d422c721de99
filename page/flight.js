// What the page computes with the rotor: a revolution in flight, and two curves. It runs in a worker, so that the page
// moves while it computes.

const AZIMUTHS = 72; // of a revolution
const STATIONS = 20; // along the blade
const PARTS = 6; // of a blade passage, over which pulsating loads are averaged
const FIELDS = ["angleOfAttack", "inducedVelocity", "thrustPerLength", "mach"];
const MEANS = [
    "thrust",
    "torque",
    "power",
    "thrustCoefficient",
    "torqueCoefficient",
    "powerCoefficient",
    "inducedVelocity",
    "inflowRatio",
    "advanceRatio",
    "coning",
    "longitudinalFlapping",
    "lateralFlapping",
    "force[1]",
    "force[2]",
    "force[3]",
    "hubMoment[1]",
    "hubMoment[2]",
    "stalledFraction",
    "tipMach",
    "tipReynolds",
];

function stationNames(kind) {
    return Array.from({ length: STATIONS }, (_, k) => `station[${k + 1}].${kind}`);
}

// One revolution from the steady (with flapping or dynamic inflow: periodic) start: means of the outputs, the flow at
// blade 1 around the azimuth, and its flap angles.
function revolution(rotor, values) {
    rotor.restart(values);
    const radii = rotor.get(stationNames("radius"));
    const names = [...MEANS, "state.flapAngle[1]", ...FIELDS.flatMap(stationNames)];
    const means = new Array(MEANS.length).fill(0);
    const fields = Object.fromEntries(FIELDS.map((field) => [field, []]));
    const flap = [];
    for (let i = 0; i < AZIMUTHS; i++) {
        // At the start blade 1 is over the tail.
        if (i > 0) rotor.step(60 / values.rpm / AZIMUTHS);
        const found = rotor.get(names);
        means.forEach((_, k) => (means[k] += found[k] / AZIMUTHS));
        flap.push(found[MEANS.length]);
        FIELDS.forEach((field, k) => {
            const begin = MEANS.length + 1 + k * STATIONS;
            fields[field].push(found.slice(begin, begin + STATIONS));
        });
    }
    const outputs = Object.fromEntries(MEANS.map((name, k) => [name, means[k]]));
    const { thrustCoefficient: ct, powerCoefficient: cp } = outputs;
    outputs.figureOfMerit = ct > 0 && cp > 0 ? ct ** 1.5 / (Math.SQRT2 * cp) : 0;
    return { outputs, flowState: rotor.item("flowState"), radii, fields, flap };
}

// The same rotor with rigid blades, whose loads are averaged over the disc: one computation gives the mean.
function averaged(values) {
    return { ...values, "flapping.enabled": false, "models.blades": "disc" };
}

// Thrust and torque coefficients in hover against collective, up to stall, at the present rotor speed.
function hoverPolar(rotor, values) {
    const hover = { "velocity[1]": 0, "velocity[3]": 0, tilt: 0, cyclicLongitudinal: 0, cyclicLateral: 0 };
    rotor.restart({ ...averaged(values), ...hover });
    const points = [];
    let most = -Infinity;
    for (let degrees = 0; degrees <= 20; degrees += 0.5) {
        rotor.set({ collective: (degrees * Math.PI) / 180 });
        const [ct, cq] = rotor.get(["thrustCoefficient", "torqueCoefficient"]);
        if (ct < most) break; // stalled
        most = ct;
        if (ct >= 0) points.push({ collective: degrees, ct, cq });
    }
    return points;
}

// Power in level flight at one speed, of a body with this weight (N) and drag area (m2): the quasi-Newton method of
// Broyden (1965) finds collective and tilt (rad). `guess` is the answer at a speed nearby, or a beginning without
// `jacobian`. There is no power where the rotor cannot fly so.
function levelFlight(rotor, values, { weight, dragArea, speed, guess }) {
    const forces = ([collective, tilt]) => {
        const level = { collective, tilt, "velocity[1]": speed, "velocity[3]": 0 };
        const [forward, up, power, density] = meanLoads(rotor, { ...values, ...level });
        return { errors: [forward - 0.5 * density * speed ** 2 * dragArea, up - weight], power };
    };
    let { point, jacobian } = guess;
    let now = forces(point);
    if (!jacobian) {
        const columns = [0, 1].map((k) => {
            const moved = forces(point.map((c, i) => (i === k ? c + 0.01 : c)));
            return moved.errors.map((error, i) => (error - now.errors[i]) / 0.01);
        });
        jacobian = [0, 1].map((row) => columns.map((column) => column[row]));
    }
    for (let iteration = 0; iteration < 10; iteration++) {
        if (Math.max(...now.errors.map(Math.abs)) <= 2e-3 * weight) return { speed, point, jacobian, power: now.power };
        const [[a, b], [c, d]] = jacobian;
        const determinant = a * d - b * c;
        const [e, f] = now.errors;
        const step = [(b * f - d * e) / determinant, (c * e - a * f) / determinant];
        if (!step.every(Number.isFinite)) break;
        const size = Math.max(...step.map(Math.abs));
        const change = step.map((s) => s * Math.min(1, 0.06 / size));
        point = point.map((old, k) => old + change[k]);
        if (point.some((angle) => Math.abs(angle) > 0.6)) break;
        const next = forces(point);
        const square = change[0] ** 2 + change[1] ** 2;
        jacobian = jacobian.map((row, i) => {
            const missed = next.errors[i] - now.errors[i] - row[0] * change[0] - row[1] * change[1];
            return row.map((entry, k) => entry + (missed * change[k]) / square);
        });
        now = next;
    }
    return { speed };
}

// Means of the forces forward and up, the power and the air density: of rigid blades over the disc, of blades that flap
// over one blade passage.
function meanLoads(rotor, values) {
    const flaps = values["flapping.enabled"];
    rotor.restart(flaps ? values : averaged(values));
    const parts = flaps ? PARTS : 1;
    let sum = [0, 0, 0, 0];
    for (let k = 0; k < parts; k++) {
        if (k > 0) rotor.step(60 / values.rpm / values["geometry.numberOfBlades"] / parts);
        const found = rotor.get(["force[1]", "force[3]", "power", "airDensity"]);
        sum = sum.map((total, i) => total + found[i] / parts);
    }
    return sum;
}

// What the worker answers to a message. Each answer has the identity of its question.
let worked; // the rotor of this worker
function answer({ id, job, module, description, values, flight }) {
    try {
        if (module) worked = new Rotor(module, description);
        const jobs = {
            load: () => true,
            revolution: () => revolution(worked, values),
            polar: () => hoverPolar(worked, values),
            power: () => levelFlight(worked, values, flight),
        };
        const result = jobs[job]();
        return { id, job, result, messages: [...new Set(worked.messages)] };
    } catch (error) {
        return { id, job, error: error.message };
    }
}
