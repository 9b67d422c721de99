// The page: connects controls, computer, results and the picture of the rotor.

const SECONDS = 2.4; // of a revolution on the page

class Page {
    constructor({ module, description, measured }) {
        this.description = description;
        this.scene = new Scene($("scene"));
        this.results = new Results(description, measured);
        this.controls = new Controls(this);
        this.computer = new Computer(
            { module, description },
            {
                revolution: (flight, state, messages) => this.foundRevolution(flight, state, messages),
                polar: (points) => this.results.showPolar(points, this.state, this.presentFlight()),
                power: (points) => this.results.showPower(points, this.state, this.presentFlight()),
                failed: tell,
            },
        );
        this.turned = 0;
        this.travelled = 0;
        this.isTurning = !matchMedia("(prefers-reduced-motion: reduce)").matches;
        $("version").textContent = description.version;
        this.showPlay();
        this.follow();
        addEventListener("hashchange", () => {
            if (location.hash.slice(1) !== toLink(this.state)) this.follow();
        });
        requestAnimationFrame((now) => this.frame(now, now));
    }

    // Takes the values of the link.
    follow() {
        this.state = fromLink(
            location.hash,
            this.controls.inflowModels.map((model) => model.name),
        );
        this.changed();
    }

    // The start of a rotor.
    begin(rotor) {
        this.state = startOf(rotor);
        this.changed();
    }

    // A new value of a control; `used` is the input from which it comes.
    put(name, value, used) {
        this.state[name] = value;
        this.changed(used);
    }

    changed(used) {
        this.controls.show(used);
        try {
            history.replaceState(null, "", `#${toLink(this.state)}`);
        } catch {
            // Browsers limit how often the address may change; the next change writes it.
        }
        this.computer.want(this.state);
    }

    // Without a flight, because of an error, the numbers of an earlier one are marked as invalid.
    foundRevolution(flight, state, messages) {
        $("messages").replaceChildren();
        messages.forEach(tell);
        document.body.classList.toggle("has-failed", !flight);
        if (!flight) return;
        Object.assign(this, { flight, flightState: state });
        this.showFlight();
    }

    // None after an error.
    presentFlight() {
        return document.body.classList.contains("has-failed") ? undefined : this.flight;
    }

    showFlight() {
        if (!this.flight) return;
        const { flight, flightState: state } = this;
        const field = $("field").value;
        this.results.showNumbers(flight, state);
        this.scene.show(flight, drawnRotor(state), field);
        this.results.showLegend(this.scene.range, field);
        $("slow").textContent = `slowed down ${Math.round((SECONDS * state.rpm) / 60)} times`;
    }

    togglePlay() {
        this.isTurning = !this.isTurning;
        this.showPlay();
    }

    showPlay() {
        $("play").textContent = this.isTurning ? "Stop" : "Turn";
    }

    frame(now, before) {
        if (this.isTurning && this.flight) {
            const turns = Math.min(now - before, 100) / 1000 / SECONDS;
            this.turned += 2 * Math.PI * turns;
            // The advance ratio is the way in radii for each radian.
            const { speed, rpm, rotor } = this.state;
            const tipSpeed = ((rpm * Math.PI) / 30) * ROTORS[rotor].fixed["geometry.radius"];
            this.travelled += (2 * Math.PI * turns * speed) / tipSpeed;
        }
        this.scene.draw(this.turned, this.travelled);
        requestAnimationFrame((later) => this.frame(later, now));
    }

    // The FMU's values as Python writes them.
    python() {
        const lines = Object.entries(fmuValues(this.state)).map(([name, value]) => {
            const text = { true: "True", false: "False" }[value] ?? JSON.stringify(value);
            return `    ${JSON.stringify(name)}: ${text},`;
        });
        return `{\n${lines.join("\n")}\n}\n`;
    }
}

// Each message stands there once.
function tell(message) {
    if ([...$("messages").children].some((line) => line.textContent === message)) return;
    const line = document.createElement("p");
    line.textContent = message;
    $("messages").append(line);
}

async function load() {
    const data = JSON.parse($("data").textContent);
    $("licences").textContent = data.licences;
    const packed = Uint8Array.from(atob(data.library), (letter) => letter.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    const module = await WebAssembly.compile(await new Response(stream).arrayBuffer());
    const measured = measuredPoints(data.measured);
    window.page = new Page({ module, description: readDescription(data.description), measured });
}

load().catch((error) => {
    tell(`The rotor cannot be loaded: ${error.message}. It needs a browser of 2023 or later.`);
});
