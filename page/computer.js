// Decides what to compute next, and has a worker compute it, or this thread where the browser allows no worker.

const SPEEDS = 15; // of the power curve, besides hover

class Computer {
    // `found` takes each answer, with whether it belongs to an older state.
    constructor(library, found) {
        this.library = library;
        this.found = found;
        this.version = 0;
        this.wanted = [];
        this.begin();
    }

    begin() {
        const source = ["fmi", "flight"].map((id) => $(id).textContent).join("\n");
        const listen = "\nonmessage = ({ data }) => postMessage(answer(data));";
        const here = (question) => setTimeout(() => this.answered(answer(question)), 0);
        try {
            const file = URL.createObjectURL(new Blob([source, listen], { type: "text/javascript" }));
            const worker = new Worker(file);
            worker.onmessage = ({ data }) => this.answered(data);
            worker.onerror = () => {
                this.ask = here;
                this.send("load", this.library);
            };
            this.ask = (question) => worker.postMessage(question);
        } catch {
            this.ask = here;
        }
        this.send("load", this.library);
    }

    // The state has changed: all is computed anew, the revolution first.
    want(state) {
        this.state = { ...state };
        this.version += 1;
        this.wanted = ["revolution", "polar", "power"];
        document.body.classList.add("is-computing");
        this.next();
    }

    send(job, question) {
        this.isBusy = true;
        this.ask({ id: this.version, job, ...question });
    }

    next() {
        if (this.isBusy || !this.state) return;
        const values = fmuValues(this.state);
        if (this.wanted[0] === "power") {
            const question = this.nextSpeed(values);
            if (question) return this.send("power", question);
            if (this.curve.length === 0) this.found.power([]);
            this.wanted.shift();
        }
        if (this.wanted.length === 0) {
            document.body.classList.remove("is-computing");
            return;
        }
        this.asked = this.state;
        this.send(this.wanted.shift(), { values });
    }

    // The power curve is computed speed by speed, so that a slider that moves does not wait for it: upwards and
    // downwards from the present speed, where the pitch is known. Undefined after the last.
    nextSpeed(values) {
        if (this.curveOf !== this.version) {
            const fastest = ROTORS[this.state.rotor].most.speed;
            const speeds = Array.from({ length: SPEEDS + 1 }, (_, k) => (fastest * k) / SPEEDS);
            const above = speeds.filter((speed) => speed >= this.state.speed);
            const below = speeds.filter((speed) => speed < this.state.speed).reverse();
            Object.assign(this, { curveOf: this.version, curve: [], speeds: [...above, ...below] });
            this.firstBelow = below[0];
        }
        const speed = this.speeds.shift();
        if (speed === undefined || !(this.weight > 0)) return undefined;
        if (this.curve.length === 0 || speed === this.firstBelow) {
            this.guess = { point: [values.collective, values.tilt], jacobian: this.curve[0]?.jacobian };
        }
        const { dragArea } = ROTORS[this.state.rotor];
        return { values, flight: { weight: this.weight, dragArea, speed, guess: this.guess } };
    }

    answered({ id, job, result, messages, error }) {
        // Without a rotor nothing more is asked.
        if (error && job === "load") return this.found.failed(`The rotor cannot be loaded: ${error}`);
        this.isBusy = false;
        const isOld = id !== this.version;
        if (job === "revolution") {
            this.weight = result?.outputs["force[3]"];
            // Also if it is old: what is shown follows a slider that moves on.
            this.found.revolution(result, this.asked, error ? [error] : messages);
        }
        if (error && job !== "revolution" && !isOld) this.found.failed(error);
        if (job === "polar" && !isOld) this.found.polar(result ?? []);
        if (job === "power" && !isOld) {
            if (result?.power !== undefined) {
                this.curve.push(result);
                this.guess = result;
            }
            this.found.power([...this.curve].sort((a, b) => a.speed - b.speed));
        }
        this.next();
    }
}
