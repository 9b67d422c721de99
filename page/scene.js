// The rotor in perspective: blades that turn and flap, and the disc that they sweep, coloured by the flow at them.
// Lengths are in rotor radii. In the hub frame x is forward, y to the left, z up along the shaft.

// Viridis by Smith, van der Walt and Firing (2015), at eleven places.
const VIRIDIS = [
    [68, 1, 84],
    [72, 36, 117],
    [65, 68, 135],
    [53, 95, 141],
    [42, 120, 142],
    [33, 145, 140],
    [34, 168, 132],
    [68, 191, 112],
    [122, 209, 81],
    [189, 223, 38],
    [253, 231, 37],
];

function colourAt(fraction) {
    const place = Math.max(0, Math.min(1, fraction)) * (VIRIDIS.length - 1);
    const k = Math.min(Math.floor(place), VIRIDIS.length - 2);
    const mix = VIRIDIS[k].map((c, i) => Math.round(c + (place - k) * (VIRIDIS[k + 1][i] - c)));
    return `rgb(${mix.join(",")})`;
}

// The range of colours: all values but the most extreme, which would take the colours from the others. Each counts by
// its area on the disc.
function colourRange(rows, radii) {
    const sorted = rows.flatMap((row) => row.map((value, k) => [value, radii[k]])).sort((a, b) => a[0] - b[0]);
    const area = sorted.reduce((sum, [, weight]) => sum + weight, 0);
    const at = (part) => {
        let sum = 0;
        return (sorted.find(([, weight]) => (sum += weight) >= part * area) ?? sorted.at(-1))[0];
    };
    let [low, high] = [at(0.03), at(0.97)];
    const least = 1e-3 * Math.max(Math.abs(low), Math.abs(high), 1e-6);
    if (high - low < least) [low, high] = [low - 20 * least, high + 20 * least];
    return [low, high];
}

class Scene {
    constructor(canvas) {
        this.canvas = canvas;
        this.context = canvas.getContext("2d");
        this.view = { azimuth: -2.25, elevation: 0.5 };
        this.disc = document.createElement("canvas");
        this.followPointer();
    }

    // What is drawn: the flight, the geometry and the field that colours the disc.
    show(flight, rotor, field) {
        this.flight = flight;
        this.rotor = rotor;
        this.field = field;
        this.range = colourRange(flight.fields[field], flight.radii);
        this.isDiscDrawn = false;
    }

    followPointer() {
        let last;
        this.canvas.addEventListener("pointerdown", (event) => {
            last = event;
            this.canvas.setPointerCapture(event.pointerId);
        });
        this.canvas.addEventListener("pointermove", (event) => {
            if (!last) return;
            // A finger that moves up or down scrolls the page.
            const isMouse = event.pointerType === "mouse";
            this.turn((last.clientX - event.clientX) * 0.01, isMouse ? (event.clientY - last.clientY) * 0.01 : 0);
            last = event;
        });
        for (const end of ["pointerup", "pointercancel"]) {
            this.canvas.addEventListener(end, () => (last = undefined));
        }
    }

    turn(azimuth, elevation) {
        this.look(this.view.azimuth + azimuth, this.view.elevation + elevation);
    }

    look(azimuth, elevation) {
        this.view = { azimuth, elevation: Math.max(0.12, Math.min(1.5, elevation)) };
        this.isDiscDrawn = false;
    }

    resize() {
        const scale = Math.min(window.devicePixelRatio || 1, 2);
        const { clientWidth, clientHeight } = this.canvas;
        const [width, height] = [Math.round(clientWidth * scale), Math.round(clientHeight * scale)];
        if (this.canvas.width === width && this.canvas.height === height && this.scale === scale) return;
        this.scale = scale;
        for (const canvas of [this.canvas, this.disc]) Object.assign(canvas, { width, height });
        this.isDiscDrawn = false;
    }

    // From the ground frame to the picture, in pixels.
    project([x, y, z]) {
        const { azimuth, elevation } = this.view;
        const [sa, ca, se, ce] = [Math.sin(azimuth), Math.cos(azimuth), Math.sin(elevation), Math.cos(elevation)];
        const right = -sa * x + ca * y;
        const ahead = ca * x + sa * y;
        const up = ce * z + se * -ahead;
        const depth = 4.6 - (ce * ahead + se * z);
        const { width, height } = this.canvas;
        const size = Math.min(width * 1.95, height * 2.75) / depth;
        return [width / 2 + size * right, height * 0.47 - size * up, depth];
    }

    // From the hub frame to the ground frame: turned about y by the tilt.
    tilted([x, y, z]) {
        const [s, c] = [Math.sin(this.rotor.tilt), Math.cos(this.rotor.tilt)];
        return [c * x + s * z, y, c * z - s * x];
    }

    // A point of a blade at azimuth `psi`, which flaps about its hinge: `along` the radius, `ahead` in the direction of
    // rotation, `above` the blade.
    onBlade(psi, along, ahead = 0, above = 0) {
        const hinge = this.rotor.hinge;
        const flap = this.flapAt(psi);
        const outboard = Math.max(along - hinge, 0);
        const radius = Math.min(along, hinge) + outboard * Math.cos(flap) - above * Math.sin(flap);
        const height = outboard * Math.sin(flap) + above * Math.cos(flap);
        const [s, c] = [Math.sin(psi), Math.cos(psi)];
        // From over the tail, counter-clockwise from above.
        return this.tilted([-c * radius + s * ahead, -s * radius - c * ahead, height]);
    }

    flapAt(psi) {
        const { flap } = this.flight;
        const turn = (psi / (2 * Math.PI)) % 1;
        const place = (turn < 0 ? turn + 1 : turn) * flap.length;
        const k = Math.floor(place) % flap.length;
        return flap[k] + (place - Math.floor(place)) * (flap[(k + 1) % flap.length] - flap[k]);
    }

    path(context, points, close = false) {
        context.beginPath();
        points.forEach((point, k) => {
            const [x, y] = this.project(point);
            if (k === 0) context.moveTo(x, y);
            else context.lineTo(x, y);
        });
        if (close) context.closePath();
    }

    // `turned`: azimuth of blade 1; `travelled`: way through the air, in radii.
    draw(turned, travelled) {
        this.resize();
        const { context, canvas } = this;
        const style = getComputedStyle(canvas);
        this.ink = style.getPropertyValue("--ink");
        this.faint = style.getPropertyValue("--faint");
        this.accent = style.getPropertyValue("--accent");
        this.mark = style.getPropertyValue("--mark");
        context.clearRect(0, 0, canvas.width, canvas.height);
        if (!this.flight) return;
        this.drawGround(travelled);
        this.drawMast();
        if (!this.isDiscDrawn) this.drawDisc();
        context.globalAlpha = 0.86;
        context.drawImage(this.disc, 0, 0);
        context.globalAlpha = 1;
        this.drawLabels();
        const { blades } = this.rotor;
        const order = Array.from({ length: blades }, (_, k) => turned + (k * 2 * Math.PI) / blades);
        // The farthest first.
        order.sort((a, b) => this.project(this.onBlade(b, 1))[2] - this.project(this.onBlade(a, 1))[2]);
        for (const psi of order) this.drawBlade(psi);
        this.drawHub();
        this.drawThrust();
    }

    // Lines on the ground, which pass below in flight.
    drawGround(travelled) {
        const { context } = this;
        const [floor, size, step] = [-0.95, 2.1, 0.3];
        context.lineWidth = this.scale;
        context.strokeStyle = this.faint;
        const line = (from, to, fade) => {
            context.globalAlpha = Math.max(0, 0.9 * (1 - fade * fade));
            this.path(context, [from, to]);
            context.stroke();
        };
        for (let y = -size; y <= size + 1e-9; y += step) {
            const half = Math.sqrt(Math.max(size * size - y * y, 0));
            line([-half, y, floor], [half, y, floor], y / size);
        }
        const shift = travelled % step;
        for (let x = -size - shift; x <= size; x += step) {
            const half = Math.sqrt(Math.max(size * size - x * x, 0));
            line([x, -half, floor], [x, half, floor], x / size);
        }
        context.globalAlpha = 1;
    }

    drawMast() {
        const { context } = this;
        context.strokeStyle = this.ink;
        context.lineCap = "round";
        context.lineWidth = 5 * this.scale;
        this.path(context, [this.tilted([0, 0, -0.55]), this.tilted([0, 0, 0])]);
        context.stroke();
    }

    // The disc as the blades sweep it; drawn once for each view.
    drawDisc() {
        const context = this.disc.getContext("2d");
        context.clearRect(0, 0, this.disc.width, this.disc.height);
        const rows = this.flight.fields[this.field];
        const { radii } = this.flight;
        const half = 0.5 * (radii[1] - radii[0]);
        const [low, high] = this.range;
        const step = (2 * Math.PI) / rows.length;
        context.lineWidth = this.scale;
        rows.forEach((row, i) => {
            const [from, to] = [(i - 0.5) * step, (i + 0.5) * step];
            row.forEach((value, k) => {
                const [inner, outer] = [radii[k] - half, radii[k] + half];
                const corners = [
                    [from, inner],
                    [from, outer],
                    [to, outer],
                    [to, inner],
                ];
                this.path(
                    context,
                    corners.map(([psi, radius]) => this.onBlade(psi, radius)),
                    true,
                );
                context.fillStyle = context.strokeStyle = colourAt((value - low) / (high - low));
                context.fill();
                // Closes the seams between neighbours.
                context.stroke();
            });
        });
        const around = Array.from({ length: 121 }, (_, k) => this.onBlade((k * 2 * Math.PI) / 120, 1));
        this.path(context, around, true);
        context.strokeStyle = this.ink;
        context.lineWidth = 1.5 * this.scale;
        context.stroke();
        this.isDiscDrawn = true;
    }

    // Azimuths, written around the plane of the hub.
    drawLabels() {
        const { context } = this;
        context.fillStyle = this.ink;
        context.font = `${12 * this.scale}px system-ui, sans-serif`;
        context.textAlign = "center";
        context.textBaseline = "middle";
        const isNarrow = this.canvas.clientWidth < 600;
        const labels = isNarrow
            ? ["ψ = 0°", "90°", "180°", "270°"]
            : ["ψ = 0°, tail", "90°, advancing", "180°, ahead", "270°, retreating"];
        labels.forEach((label, k) => {
            const [x, y] = this.project(this.onBlade((k * Math.PI) / 2, isNarrow ? 1.12 : 1.18));
            const margin = context.measureText(label).width / 2 + 4 * this.scale;
            context.fillText(label, Math.max(margin, Math.min(this.canvas.width - margin, x)), y);
        });
    }

    drawBlade(psi) {
        const { context, rotor } = this;
        const { cutout, chord, twist } = rotor;
        const parts = 8;
        const cyclic = rotor.longitudinal * Math.sin(psi) + rotor.lateral * Math.cos(psi);
        const edge = (radius, fromQuarter) => {
            const pitch = rotor.collective + twist * radius - cyclic;
            return this.onBlade(
                psi,
                radius,
                fromQuarter * chord * Math.cos(pitch),
                fromQuarter * chord * Math.sin(pitch),
            );
        };
        context.lineCap = "round";
        context.strokeStyle = this.ink;
        context.lineWidth = 4 * this.scale;
        this.path(context, [this.onBlade(psi, 0.02), this.onBlade(psi, cutout)]);
        context.stroke();
        const radii = Array.from({ length: parts + 1 }, (_, k) => cutout + ((1 - cutout) * k) / parts);
        const outline = [...radii.map((r) => edge(r, 0.25)), ...radii.reverse().map((r) => edge(r, -0.75))];
        this.path(context, outline, true);
        context.fillStyle = "#f6f7f9";
        context.fill();
        context.strokeStyle = "#1d2733";
        context.lineWidth = 1.3 * this.scale;
        context.stroke();
        // A band near the tip, as blades have it.
        const band = [edge(0.97, 0.25), edge(0.9, 0.25), edge(0.9, -0.75), edge(0.97, -0.75)];
        this.path(context, band, true);
        context.fillStyle = this.mark;
        context.fill();
    }

    drawHub() {
        const { context } = this;
        const [x, y, depth] = this.project(this.tilted([0, 0, 0.01]));
        context.beginPath();
        context.arc(x, y, (36 * this.scale) / depth, 0, 2 * Math.PI);
        context.fillStyle = this.ink;
        context.fill();
    }

    // The force of the rotor, and its way through the air.
    drawThrust() {
        const force = [1, 2, 3].map((k) => this.flight.outputs[`force[${k}]`]);
        const size = Math.hypot(...force);
        if (!(size > 0)) return;
        const length = Math.min(0.72, 0.5 * Math.sqrt(size / this.rotor.referenceForce));
        this.arrow(
            [0, 0, 0.02],
            force.map((f) => (f / size) * length),
            this.accent,
        );
        const { speed, climb } = this.rotor;
        const fast = Math.hypot(speed, climb);
        if (fast > 0) {
            const way = Math.min(0.9, 0.25 + fast / this.rotor.fastest);
            this.arrow([0, 0, -0.55], [(speed / fast) * way, 0, (climb / fast) * way], this.mark);
        }
    }

    arrow(from, along, colour) {
        const { context } = this;
        const to = from.map((c, k) => c + along[k]);
        const [[x0, y0], [x1, y1]] = [this.project(from), this.project(to)];
        const angle = Math.atan2(y1 - y0, x1 - x0);
        const head = 12 * this.scale;
        context.strokeStyle = context.fillStyle = colour;
        context.lineWidth = 4 * this.scale;
        context.lineCap = "butt";
        context.beginPath();
        context.moveTo(x0, y0);
        context.lineTo(x1 - 0.8 * head * Math.cos(angle), y1 - 0.8 * head * Math.sin(angle));
        context.stroke();
        context.beginPath();
        context.moveTo(x1, y1);
        for (const side of [-1, 1]) {
            context.lineTo(x1 - head * Math.cos(angle + 0.42 * side), y1 - head * Math.sin(angle + 0.42 * side));
        }
        context.fill();
    }
}
