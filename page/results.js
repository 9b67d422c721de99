// The page's results: numbers and curves.

const OUTPUTS = [
    ["thrust", "Thrust", "N"],
    ["power", "Power", "W"],
    ["torque", "Torque", "N·m"],
    ["figureOfMerit", "Figure of merit", ""],
    ["thrustCoefficient", "CT", ""],
    ["torqueCoefficient", "CQ", ""],
    ["inducedVelocity", "Induced velocity", "m/s"],
    ["coning", "Coning a₀", "°"],
    ["longitudinalFlapping", "Flap back a₁", "°"],
    ["lateralFlapping", "Flap right b₁", "°"],
    ["force[1]", "Force forward", "N"],
    ["force[3]", "Force up", "N"],
    ["advanceRatio", "Advance ratio μ", ""],
    ["tipMach", "Tip Mach", ""],
    ["stalledFraction", "Stalled span", "%"],
    ["flowState", "Flow", ""],
];

// What colours the disc, and the factor from the FMU's unit to the one that is shown.
const COLOURED = {
    angleOfAttack: { label: "Angle of attack", unit: "°", factor: 1 / DEG },
    inducedVelocity: { label: "Induced velocity", unit: "m/s", factor: 1 },
    thrustPerLength: { label: "Thrust per length", unit: "N/m", factor: 1 },
    mach: { label: "Mach number", unit: "", factor: 1 },
};

// Four digits; thousands of a unit from ten thousand on. Angles have two decimals.
function shown(value, unit) {
    if (unit === "%") return `${(100 * value).toFixed(1)} %`;
    if (unit === "°") return `${value.toFixed(2).replace("-0.00", "0.00")}°`;
    const isLarge = unit !== "" && Math.abs(value) >= 9999.5;
    const number = Math.abs(value) < 5e-7 ? "0" : (isLarge ? value / 1000 : value).toPrecision(4);
    return `${number} ${isLarge ? "k" : ""}${unit}`.trim();
}

class Results {
    constructor(description, measured) {
        this.measured = measured;
        for (const [name, label] of OUTPUTS) {
            const box = document.createElement("div");
            box.innerHTML = `<span>${label}</span><output data-output="${name}">–</output>`;
            box.title = description.variables[name].description;
            $("readouts").append(box);
        }
        this.polar = new Chart($("polar"), {
            title: "Thrust against torque coefficient in hover",
            x: "torque coefficient CQ, 10⁻³",
            y: "thrust coefficient CT, 10⁻³",
            describe: (p) => `${p.collective}°: CT ${p.y.toFixed(2)}, CQ ${p.x.toFixed(3)}`,
        });
        this.power = new Chart($("power"), {
            title: "Power against flight speed",
            x: "flight speed, m/s",
            y: "power",
            describe: (p) => {
                const [collective, tilt] = p.point.map((angle) => (angle / DEG).toFixed(1));
                return `${p.x.toFixed(0)} m/s: ${shown(p.watts, "W")}, collective ${collective}°, tilt ${tilt}°`;
            },
        });
    }

    showNumbers({ outputs, flowState }, state) {
        for (const [name, , unit] of OUTPUTS) {
            const value = unit === "°" ? outputs[name] / DEG : outputs[name];
            let text;
            if (name === "flowState") text = flowState.replace(/[A-Z]/g, (letter) => ` ${letter.toLowerCase()}`);
            else if (name === "figureOfMerit" && !isHover(state)) text = "–";
            else text = shown(value, unit);
            document.querySelector(`[data-output="${name}"]`).textContent = text;
        }
    }

    showLegend([low, high], field) {
        const { unit, factor } = COLOURED[field];
        $("low").textContent = shown(low * factor, unit);
        $("high").textContent = shown(high * factor, unit);
        const colours = Array.from({ length: 11 }, (_, k) => colourAt(k / 10));
        $("colours").style.background = `linear-gradient(90deg, ${colours.join(",")})`;
    }

    // Measured points are those of the rotor that was measured only.
    showPolar(points, state, flight) {
        const rotor = ROTORS[state.rotor].measured;
        const isMeasured = rotor && Object.keys(rotor).every((name) => rotor[name] === state[name]);
        const measured = isMeasured ? this.measured.filter((p) => p.blades === state.blades) : [];
        const scaled = (p) => ({ ...p, x: 1000 * p.cq, y: 1000 * p.ct });
        const { torqueCoefficient: cq, thrustCoefficient: ct } = flight?.outputs ?? {};
        const present = isHover(state) && flight ? scaled({ cq, ct }) : undefined;
        this.polar.draw(points.map(scaled), measured.map(scaled), present);
        $("measured").textContent = measured.length
            ? "Circles: measured by Knight & Hefner (1937), NACA TN 626. Nothing is fitted to them."
            : "";
    }

    // The present flight is on the curve of level flight only if it does not climb.
    showPower(points, state, flight) {
        const isShown = flight && points.length > 0 && state.climb === 0;
        const present = isShown ? [{ speed: state.speed, power: flight.outputs.power }] : [];
        const isLarge = Math.max(...[...points, ...present].map((p) => p.power)) >= 9999.5;
        this.power.y = isLarge ? "power, kW" : "power, W";
        const scaled = (p) => ({ ...p, x: p.speed, y: isLarge ? p.power / 1000 : p.power, watts: p.power });
        this.power.draw(points.map(scaled), [], present.map(scaled)[0]);
    }
}

function isHover({ speed, climb }) {
    return speed === 0 && climb === 0;
}
