// The page's controls: they show the values of `page.state`, and give new ones to `page.put`.

class Controls {
    constructor(page) {
        this.page = page;
        this.inflowModels = page.description.variables["models.inflow"].items;
        for (const [name, { title }] of Object.entries(ROTORS)) $("rotor").append(new Option(title, name));
        for (const { name } of this.inflowModels) $("inflow").append(new Option(name, name));
        for (const [name, { label }] of Object.entries(COLOURED)) $("field").append(new Option(label, name));
        for (const control of CONTROLS) this.makeRow(control);
        $("rotor").addEventListener("change", () => page.begin($("rotor").value));
        $("inflow").addEventListener("change", () => page.put("inflow", $("inflow").value));
        $("flapping").addEventListener("change", () => page.put("flapping", $("flapping").checked));
        $("field").addEventListener("change", () => page.showFlight());
        for (const list of ["rotor", "inflow", "field"]) leaveAfterMouse($(list));
        document.addEventListener("click", ({ target, detail }) => {
            // A click by the mouse, not by a key.
            if (detail > 0) target.closest("button")?.blur();
        });
        $("reset").addEventListener("click", () => page.begin(page.state.rotor));
        $("play").addEventListener("click", () => page.togglePlay());
        $("copy-link").addEventListener("click", () => {
            // Not the address itself, which the browser may not have let the page change.
            copy($("copy-link"), `${location.href.split("#")[0]}#${toLink(page.state)}`);
        });
        $("copy-values").addEventListener("click", () => copy($("copy-values"), page.python()));
        $("controls").addEventListener("submit", (event) => event.preventDefault());
        for (const button of document.querySelectorAll("[data-view]")) {
            const [azimuth, elevation] = button.dataset.view.split(",").map(Number);
            button.addEventListener("click", () => page.scene.look(azimuth, elevation));
        }
        addEventListener("keydown", (event) => this.pressed(event));
    }

    // A slider, and a number for exact values.
    makeRow({ name, label, unit, group }) {
        const row = document.createElement("div");
        row.className = "row";
        row.innerHTML = `<label for="${name}">${label}</label>
            <input type="number" id="${name}-number" aria-label="${label}, number">
            <span class="unit">${unit}</span><input type="range" id="${name}">`;
        document.querySelector(`[data-group="${group}"]`).append(row);
        for (const input of row.querySelectorAll("input")) {
            input.addEventListener("input", () => this.take(name, input));
        }
        // A number that is out of range shows the one that counts.
        $(`${name}-number`).addEventListener("change", () => this.show());
    }

    // An empty or incomplete number changes nothing.
    take(name, input) {
        const value = input.valueAsNumber;
        if (Number.isNaN(value)) return;
        const control = CONTROLS.find((one) => one.name === name);
        const { min, max } = rangeOf(control, this.page.state.rotor);
        const limited = Math.max(min, Math.min(max, value));
        this.page.put(name, name === "blades" ? Math.round(limited) : limited, input);
    }

    // Shows the values in all controls but the one that is being used.
    show(used) {
        const { state } = this.page;
        $("rotor").value = state.rotor;
        $("source").textContent = `${ROTORS[state.rotor].title}: ${ROTORS[state.rotor].source}`;
        $("drag").textContent = `${ROTORS[state.rotor].dragArea}\u00a0m²`;
        $("inflow").value = state.inflow;
        const { description } = this.inflowModels.find((model) => model.name === state.inflow);
        $("inflow-description").textContent = description;
        $("flapping").checked = state.flapping && canFlap(state);
        $("flapping").disabled = !canFlap(state);
        for (const control of CONTROLS) {
            for (const input of [$(control.name), $(`${control.name}-number`)]) {
                if (input === used) continue;
                Object.assign(input, rangeOf(control, state.rotor));
                input.value = state[control.name];
            }
        }
    }

    pressed(event) {
        const { target, key } = event;
        const { page } = this;
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        if (target.matches("select, input[type=number]")) return;
        if (key === " " && !target.matches("button, select, summary, input:not([type=range])")) {
            event.preventDefault();
            page.togglePlay();
        }
        if (key === "r" || key === "R") page.begin(page.state.rotor);
        const field = Object.keys(COLOURED)[Number(key) - 1];
        if (field) {
            $("field").value = field;
            page.showFlight();
        }
        const turn = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[key];
        if (turn && target === $("scene")) {
            event.preventDefault();
            page.scene.turn(...turn);
        }
    }
}

// A list in which the mouse has chosen gives the focus back, so that the page's keys work. One that keys move keeps it.
function leaveAfterMouse(list) {
    let isByMouse = false;
    list.addEventListener("pointerdown", () => (isByMouse = true));
    list.addEventListener("keydown", () => (isByMouse = false));
    list.addEventListener("change", () => isByMouse && list.blur());
}

async function copy(button, text) {
    const label = button.textContent;
    try {
        await navigator.clipboard.writeText(text);
        button.textContent = "Copied";
    } catch {
        // Where the browser does not allow it, the text can be copied from a dialogue.
        prompt("Copy this:", text);
    }
    setTimeout(() => (button.textContent = label), 1200);
}
