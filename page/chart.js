// A small chart in SVG: one line, measured points, and the present point. Pointing at it shows the nearest point.

const SVG = "http://www.w3.org/2000/svg";

function element(parent, name, attributes, text) {
    const made = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    if (text !== undefined) made.textContent = text;
    parent.append(made);
    return made;
}

// Round numbers for about `count` ticks.
function ticks(low, high, count) {
    const rough = (high - low) / count;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = power * [1, 2, 2.5, 5, 10].find((factor) => factor * power >= rough * 0.999);
    const found = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) found.push(k * step);
    return found;
}

// A tick's text without the errors of its multiplication.
function tickText(value) {
    return String(Number(value.toPrecision(6)));
}

class Chart {
    // `describe` says what stands beside the nearest point: text for {x, y, ...}.
    constructor(holder, { title, x, y, describe }) {
        this.svg = element(holder, "svg", { viewBox: "0 0 420 260", role: "img", "aria-label": title });
        Object.assign(this, { x, y, describe });
        this.svg.addEventListener("pointermove", (event) => this.point(event));
        this.svg.addEventListener("pointerleave", () => this.hint?.replaceChildren());
    }

    // `points`: of the line; `measured` and `present` are also {x, y}.
    draw(points, measured = [], present = undefined) {
        const { svg } = this;
        svg.replaceChildren();
        this.points = points;
        const all = [...points, ...measured, ...(present ? [present] : [])];
        if (all.length === 0) {
            element(svg, "text", { x: 210, y: 130, class: "axis", "text-anchor": "middle" }, "no such flight");
            return;
        }
        const highest = Math.max(...all.map((p) => p.y), 0);
        const lowest = Math.min(...all.map((p) => p.y), 0);
        const right = Math.max(...all.map((p) => p.x));
        const left = Math.min(...all.map((p) => p.x), 0);
        const top = highest + 0.06 * (highest - lowest || 1);
        this.toX = (x) => 58 + ((x - left) / (right - left || 1)) * 346;
        this.toY = (y) => 214 - ((y - lowest) / (top - lowest)) * 200;
        for (const tick of ticks(left, right, 6)) {
            element(svg, "line", { x1: this.toX(tick), x2: this.toX(tick), y1: 14, y2: 214, class: "grid" });
            element(svg, "text", { x: this.toX(tick), y: 230, class: "axis", "text-anchor": "middle" }, tickText(tick));
        }
        for (const tick of ticks(lowest, top, 5)) {
            element(svg, "line", { x1: 58, x2: 404, y1: this.toY(tick), y2: this.toY(tick), class: "grid" });
            element(svg, "text", { x: 52, y: this.toY(tick) + 4, class: "axis", "text-anchor": "end" }, tickText(tick));
        }
        element(svg, "text", { x: 231, y: 252, class: "label", "text-anchor": "middle" }, this.x);
        element(
            svg,
            "text",
            { transform: "translate(12 114) rotate(-90)", class: "label", "text-anchor": "middle" },
            this.y,
        );
        const line = points.map((p) => `${this.toX(p.x).toFixed(1)},${this.toY(p.y).toFixed(1)}`).join(" ");
        element(svg, "polyline", { points: line, class: "curve" });
        for (const { x, y } of measured) {
            element(svg, "circle", { cx: this.toX(x), cy: this.toY(y), r: 4, class: "measured" });
        }
        if (present) {
            element(svg, "circle", { cx: this.toX(present.x), cy: this.toY(present.y), r: 6, class: "present" });
        }
        this.hint = element(svg, "g", {});
    }

    point(event) {
        if (!this.hint || this.points.length === 0) return;
        const box = this.svg.getBoundingClientRect();
        const x = ((event.clientX - box.left) / box.width) * 420;
        const y = ((event.clientY - box.top) / box.height) * 260;
        const distance = (p) => Math.hypot(this.toX(p.x) - x, this.toY(p.y) - y);
        const nearest = this.points.reduce((best, p) => (distance(p) < distance(best) ? p : best));
        const [cx, cy] = [this.toX(nearest.x), this.toY(nearest.y)];
        this.hint.replaceChildren();
        element(this.hint, "circle", { cx, cy, r: 4, class: "nearest" });
        const isRight = cx > 230;
        const place = { x: cx + (isRight ? -9 : 9), y: Math.max(cy - 8, 20), "text-anchor": isRight ? "end" : "start" };
        element(this.hint, "text", { ...place, class: "hint" }, this.describe(nearest));
    }
}
