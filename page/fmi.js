// The rotor's FMU in JavaScript: its library, compiled to WebAssembly, behind the C interface of FMI 2.0, as any other
// importer uses it. Variables go by their names in modelDescription.xml.

const FMI_ERROR = 3;
const CO_SIMULATION = 1;
const SCRATCH = 65536; // bytes for the arguments of one call

// What importers read in modelDescription.xml: the GUID, and the variables by name.
function readDescription(xml) {
    const root = new DOMParser().parseFromString(xml, "text/xml").documentElement;
    const items = {};
    for (const type of root.querySelectorAll("SimpleType")) {
        items[type.getAttribute("name")] = [...type.querySelectorAll("Item")].map((item) => ({
            name: item.getAttribute("name"),
            value: Number(item.getAttribute("value")),
            description: item.getAttribute("description"),
        }));
    }
    const variables = {};
    for (const variable of root.querySelectorAll("ScalarVariable")) {
        const typed = variable.firstElementChild;
        variables[variable.getAttribute("name")] = {
            reference: Number(variable.getAttribute("valueReference")),
            type: typed.tagName,
            items: items[typed.getAttribute("declaredType")],
            description: variable.getAttribute("description"),
        };
    }
    return { guid: root.getAttribute("guid"), version: root.getAttribute("version"), variables };
}

class RotorError extends Error {}

// One instance of the FMU, for co-simulation. It begins in Initialization Mode: parameters and inputs can be set, and
// outputs are those of the steady start with them. The first `step` ends this mode.
class Rotor {
    // `module`: the compiled library.
    constructor(module, description) {
        this.module = module;
        this.description = description;
        this.load();
    }

    // Also after a trap, which leaves the library's memory in an unknown state.
    load() {
        this.exports = new WebAssembly.Instance(this.module, {}).exports;
        this.scratch = this.exports.memory.grow(SCRATCH / 65536) * 65536;
        this.component = 0;
        this.messages = [];
    }

    // Memory for the arguments of one call: a place in it, in steps of 8 bytes.
    place(bytes) {
        const here = this.used;
        this.used += Math.ceil(bytes / 8) * 8;
        if (this.used > this.scratch + SCRATCH) throw new RotorError("The arguments of a call are too long.");
        return here;
    }

    text(text) {
        const bytes = new TextEncoder().encode(`${text}\0`);
        const place = this.place(bytes.length);
        new Uint8Array(this.exports.memory.buffer).set(bytes, place);
        return place;
    }

    numbers(Kind, values) {
        const place = this.place(values.length * Kind.BYTES_PER_ELEMENT);
        new Kind(this.exports.memory.buffer, place, values.length).set(values);
        return place;
    }

    textAt(place) {
        const bytes = new Uint8Array(this.exports.memory.buffer);
        return new TextDecoder().decode(bytes.subarray(place, bytes.indexOf(0, place)));
    }

    // Calls a function of the interface; `prepare` writes its arguments into memory and returns them.
    call(name, prepare) {
        this.used = this.scratch;
        let status;
        try {
            status = this.exports[name](this.component, ...prepare());
        } catch (error) {
            if (error instanceof RotorError) throw error;
            this.load();
            throw new RotorError(`The library failed in ${name}: ${error.message}`);
        }
        if (status >= FMI_ERROR) throw new RotorError(this.messages.pop() ?? `${name} failed.`);
    }

    // A fresh rotor with these values and the defaults of all others, in Initialization Mode.
    restart(values) {
        this.messages = [];
        if (this.component) this.call("fmi2Reset", () => []);
        else this.instantiate();
        this.time = 0;
        this.started = false;
        this.set(values);
        this.call("fmi2SetupExperiment", () => [0, 0, 0, 0, 0]);
        this.call("fmi2EnterInitializationMode", () => []);
    }

    instantiate() {
        this.used = this.scratch;
        const callbacks = this.numbers(Uint32Array, [this.logger(), 0, 0, 0, 0]);
        const { guid } = this.description;
        this.component = this.exports.fmi2Instantiate(
            this.text("rotor"),
            CO_SIMULATION,
            this.text(guid),
            this.text(""),
            callbacks,
            0,
            0,
        );
        if (!this.component) throw new RotorError(this.messages.pop() ?? "There is no instance.");
    }

    // A function for the library's table, with the arguments of fmi2CallbackLogger: environment, instance, status,
    // category, message, and the place of the variable arguments, of which there are none. A table takes no plain
    // JavaScript function, so a small module imports the function and exports it again.
    logger() {
        const shim = Uint8Array.of(
            0,
            97,
            115,
            109,
            1,
            0,
            0,
            0, // WebAssembly, version 1
            1,
            10,
            1,
            96,
            6,
            127,
            127,
            127,
            127,
            127,
            127,
            0, // type 0: six integers, no result
            2,
            7,
            1,
            1,
            101,
            1,
            102,
            0,
            0, // import function 0 of type 0 as e.f
            7,
            5,
            1,
            1,
            102,
            0,
            0, // export it as f
        );
        const log = (_environment, _instance, _status, _category, message) => {
            // The message is the format of a printf.
            this.messages.push(this.textAt(message).replaceAll("%%", "%"));
        };
        const { f } = new WebAssembly.Instance(new WebAssembly.Module(shim), { e: { f: log } }).exports;
        const table = this.exports.__indirect_function_table;
        const index = table.grow(1);
        table.set(index, f);
        return index;
    }

    variable(name) {
        const variable = this.description.variables[name];
        if (!variable) throw new RotorError(`There is no variable ${name}.`);
        return variable;
    }

    references(names) {
        return this.numbers(
            Uint32Array,
            names.map((name) => this.variable(name).reference),
        );
    }

    // Sets parameters or inputs, {name: value}; enumerations by the names of their items.
    set(values) {
        const reals = Object.keys(values).filter((name) => this.variable(name).type === "Real");
        for (const [name, value] of Object.entries(values)) {
            const { type, items } = this.variable(name);
            if (type === "Real") continue;
            const setter = type === "Enumeration" ? "fmi2SetInteger" : `fmi2Set${type}`;
            this.call(setter, () => {
                if (type === "String") {
                    const text = this.text(value);
                    return [this.references([name]), 1, this.numbers(Uint32Array, [text])];
                }
                const number = items ? items.find((item) => item.name === value)?.value : Number(value);
                return [this.references([name]), 1, this.numbers(Int32Array, [number])];
            });
        }
        if (reals.length === 0) return;
        this.call("fmi2SetReal", () => [
            this.references(reals),
            reals.length,
            this.numbers(
                Float64Array,
                reals.map((name) => values[name]),
            ),
        ]);
    }

    // The values of real variables, in the order of their names.
    get(names) {
        let place;
        this.call("fmi2GetReal", () => {
            const references = this.references(names);
            place = this.place(8 * names.length);
            return [references, names.length, place];
        });
        return Array.from(new Float64Array(this.exports.memory.buffer, place, names.length));
    }

    // The name of an item of an enumeration.
    item(name) {
        let place;
        this.call("fmi2GetInteger", () => {
            const references = this.references([name]);
            place = this.place(4);
            return [references, 1, place];
        });
        const [number] = new Int32Array(this.exports.memory.buffer, place, 1);
        return this.variable(name).items.find((item) => item.value === number).name;
    }

    // Moves on by `duration`, s.
    step(duration) {
        if (!this.started) {
            this.call("fmi2ExitInitializationMode", () => []);
            this.started = true;
        }
        this.call("fmi2DoStep", () => [this.time, duration, 0]);
        this.time += duration;
    }
}
