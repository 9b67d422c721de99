"""The page in Chromium: its numbers are those of FMPy, and it works by mouse, keyboard and touch.

    python page.py --page HelicopterRotor.html --fmu HelicopterRotor.fmu --chromium FILE --pictures FOLDER

runs the tests, and writes pictures of the page into the folder.
"""

import argparse
import ast
import math
import sys
import unittest
from contextlib import contextmanager
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[4] / "fmu-examples"))

from playwright.sync_api import sync_playwright
from rotor import Rotor

AZIMUTHS = 72
DESKTOP = {"viewport": {"width": 1280, "height": 860}}
PHONE = {
    "viewport": {"width": 390, "height": 844},
    "device_scale_factor": 2,
    "is_mobile": True,
    "has_touch": True,
}
# Flights of all kinds: the starts of the rotors, models with and without states, rigid blades, descent.
LINKS = [
    "",
    "rotor=knight-hefner",
    "rotor=propeller&speed=10&tilt=12",
    "rotor=knight-hefner&inflow=annulus&flapping=false&blades=3",
    "rotor=knight-hefner&inflow=annulusClosedForm&climb=2",
    "rotor=knight-hefner&inflow=petersHe&speed=12&cyclicLateral=-1.5",
    "rotor=a109&speed=0&climb=-9&inflow=uniform&flapping=false",
]
COMPUTED = "window.page && page.flight && !document.body.classList.contains('is-computing')"
ARGUMENTS = None


def shown(value, unit):
    """As the page shows a value: four digits, thousands from ten thousand on, angles in degrees."""
    if unit == "%":
        return f"{100.0 * value:.1f} %"
    is_large = unit and abs(value) >= 9999.5
    value = value / 1000.0 if is_large else value
    if unit == "°":
        number = f"{math.degrees(value):.2f}".replace("-0.00", "0.00")
        return f"{number}°"
    decimals = 0 if abs(value) < 5e-7 else max(0, 3 - math.floor(math.log10(abs(value))))
    # Rounding may add a digit: 9.9996 is 10.00.
    if decimals and abs(round(value, decimals)) >= 10.0 ** (4 - decimals):
        decimals -= 1
    number = f"{value:.{decimals}f}" if abs(value) >= 5e-7 else "0"
    return f"{number} {'k' if is_large else ''}{unit}".strip()


def flown(values):
    """The outputs, averaged over a revolution in FMPy, that the page shows, and the flow state."""
    means = dict.fromkeys(
        "thrust power torque thrustCoefficient torqueCoefficient powerCoefficient inducedVelocity"
        " coning longitudinalFlapping lateralFlapping force[1] force[3] advanceRatio tipMach"
        " stalledFraction".split(),
        0.0,
    )
    with Rotor(ARGUMENTS.fmu, values) as rotor:
        for i in range(AZIMUTHS):
            if i > 0:
                rotor.step(60.0 / values["rpm"] / AZIMUTHS)
            for name, value in zip(means, rotor.get(list(means))):
                means[name] += value / AZIMUTHS
        state = rotor["flowState"]
    ct, cp = means["thrustCoefficient"], means.pop("powerCoefficient")
    means["figureOfMerit"] = ct**1.5 / (math.sqrt(2.0) * cp) if ct > 0.0 < cp else 0.0
    return means, state


def collective_for(upward, values):
    """The collective in degrees at which FMPy finds this upward force, by the secant method."""
    (before, error) = (values["collective"], flown(values)[0]["force[3]"] - upward)
    now = before - math.radians(1.0)
    for _ in range(8):
        found = flown({**values, "collective": now})[0]["force[3]"] - upward
        if abs(found) < 1e-4 * upward:
            return math.degrees(now)
        before, now = now, now - found * (now - before) / (found - error)
        error = found
    raise AssertionError("no collective gives this force")


class ThePage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.playwright = sync_playwright().start()
        cls.browser = cls.playwright.chromium.launch(executable_path=str(ARGUMENTS.chromium))

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.playwright.stop()

    @contextmanager
    def opened(self, link="", options=DESKTOP, script=None, until=COMPUTED):
        """The page, when all is computed; it must have met no error and asked for no other file."""
        context = self.browser.new_context(**options)
        page = context.new_page()
        problems = []
        page.on("pageerror", lambda error: problems.append(str(error)))
        page.on("console", lambda message: problems.append(message.text))
        page.on(
            "request",
            lambda request: problems.append(request.url) if is_other(request.url) else None,
        )
        if script:
            page.add_init_script(script)
        page.goto(f"{ARGUMENTS.page.resolve().as_uri()}#{link}")
        self.wait(page, until)
        yield page
        self.assertEqual(problems, [])
        context.close()

    def wait(self, page, until=COMPUTED):
        page.wait_for_function(until, timeout=240_000)

    def output(self, page, name):
        return page.inner_text(f'[data-output="{name}"]')

    def assert_as_in_fmpy(self, page):
        values = ast.literal_eval(page.evaluate("page.python()"))
        means, state = flown(values)
        units = dict(page.evaluate("OUTPUTS.map(([name, , unit]) => [name, unit])"))
        is_hover = values["velocity[1]"] == values["velocity[3]"] == 0.0
        for name, value in means.items():
            expected = shown(value, units[name])
            if name == "figureOfMerit" and not is_hover:
                expected = "–"
            self.assertEqual(self.output(page, name), expected, name)
        self.assertEqual(self.output(page, "flowState").replace(" ", ""), state.lower())

    def test_all_numbers_are_those_of_fmpy_to_the_digits_shown(self):
        for link in LINKS:
            with self.subTest(link), self.opened(link) as page:
                self.assert_as_in_fmpy(page)
                self.assertEqual(page.inner_text("#messages"), "")

    def test_a_point_of_each_curve_is_that_of_fmpy(self):
        with self.opened() as page:
            values = ast.literal_eval(page.evaluate("page.python()"))
            polar = page.evaluate("page.results.polar.points")[20]
            power = page.evaluate("page.results.power.points")[8]
            weight = page.evaluate("page.flight.outputs['force[3]']")
        hover = dict.fromkeys(
            "velocity[1] velocity[3] tilt cyclicLongitudinal cyclicLateral".split(), 0.0
        )
        rigid = {"flapping.enabled": False, "models.blades": "disc"}
        collective = {"collective": math.radians(polar["collective"])}
        with Rotor(ARGUMENTS.fmu, {**values, **rigid, **hover, **collective}) as rotor:
            for name, value in (
                ("thrustCoefficient", polar["ct"]),
                ("torqueCoefficient", polar["cq"]),
            ):
                self.assertAlmostEqual(value / rotor[name], 1.0, delta=1e-9)
        # Blades that flap: the mean over one blade passage, of a flight that carries the weight and
        # pulls the drag area of 1 m2.
        collective, tilt = power["point"]
        flight = {"collective": collective, "tilt": tilt, "velocity[1]": power["speed"]}
        means, parts = {"force[1]": 0.0, "force[3]": 0.0, "power": 0.0, "airDensity": 0.0}, 6
        with Rotor(ARGUMENTS.fmu, {**values, **flight}) as rotor:
            for part in range(parts):
                if part > 0:
                    rotor.step(60.0 / values["rpm"] / values["geometry.numberOfBlades"] / parts)
                for name in means:
                    means[name] += rotor[name] / parts
        self.assertGreater(power["speed"], 30.0)
        self.assertAlmostEqual(power["watts"] / means["power"], 1.0, delta=1e-9)
        drag = 0.5 * means["airDensity"] * power["speed"] ** 2
        self.assertAlmostEqual(means["force[3]"], weight, delta=2e-3 * weight)
        self.assertAlmostEqual(means["force[1]"], drag, delta=2e-3 * weight)

    def test_it_computes_the_same_where_the_browser_allows_no_worker(self):
        with self.opened(script="delete window.Worker") as page:
            self.assert_as_in_fmpy(page)

    def test_keys_move_the_sliders_and_the_view_and_colour_the_disc(self):
        with self.opened() as page:
            thrust = self.output(page, "thrust")
            page.focus("#collective")
            page.keyboard.press("ArrowRight")
            self.wait(page)
            self.assertEqual(page.input_value("#collective-number"), "9.9")
            self.assertNotEqual(self.output(page, "thrust"), thrust)
            self.assert_as_in_fmpy(page)
            page.focus("#scene")
            page.keyboard.press("2")
            self.assertEqual(page.input_value("#field"), "inducedVelocity")
            self.assertIn("m/s", page.inner_text("#high"))
            before = page.evaluate("page.scene.view.azimuth")
            page.keyboard.press("ArrowLeft")
            self.assertLess(page.evaluate("page.scene.view.azimuth"), before)
            page.keyboard.press("r")
            self.wait(page)
            self.assertEqual(self.output(page, "thrust"), thrust)

    def test_the_blades_turn_and_stop(self):
        picture = "document.getElementById('scene').toDataURL()"
        with self.opened() as page:
            one = page.evaluate(picture)
            page.wait_for_timeout(300)
            self.assertNotEqual(page.evaluate(picture), one)
            page.keyboard.press(" ")
            page.wait_for_timeout(100)
            one = page.evaluate(picture)
            page.wait_for_timeout(300)
            self.assertEqual(page.evaluate(picture), one)

    def test_a_link_brings_the_same_flight_and_what_is_impossible_in_it_is_left_out(self):
        with self.opened("rotor=propeller") as page:
            page.fill("#speed-number", "8")
            page.select_option("#inflow", "drees")
            self.wait(page)
            thrust = self.output(page, "thrust")
            link = page.evaluate("location.hash").lstrip("#")
        with self.opened(link) as page:
            self.assertEqual(self.output(page, "thrust"), thrust)
        for link in (
            "rotor=none&collective=900&blades=x&inflow=magic",
            "rotor=toString",
            "flapping=banana",
        ):
            with self.subTest(link), self.opened(link) as page:
                self.assertEqual(page.evaluate("toLink(page.state)"), "rotor=a109")

    def test_the_copied_link_is_that_of_the_values_shown(self):
        # A browser that lets the page change its address no more.
        script = """
            history.replaceState = () => { throw new Error("too often"); };
            const clipboard = { writeText: async (text) => (window.copied = text) };
            Object.defineProperty(navigator, "clipboard", { value: clipboard });
        """
        with self.opened("rotor=propeller", script=script) as page:
            page.fill("#speed-number", "8")
            page.click("#copy-link")
            page.wait_for_function("window.copied")
            address = f"{ARGUMENTS.page.resolve().as_uri()}#rotor=propeller&speed=8"
            self.assertEqual(page.evaluate("copied"), address)

    def test_a_number_out_of_range_counts_as_the_end_of_the_range(self):
        with self.opened() as page:
            page.fill("#collective-number", "900")
            page.press("#collective-number", "Enter")
            self.wait(page)
            self.assertEqual(page.input_value("#collective-number"), "25")
            page.fill("#collective-number", "")
            self.assertEqual(page.evaluate("page.state.collective"), 25)

    def test_arrow_keys_move_a_number_by_the_step_of_its_slider(self):
        with self.opened() as page:
            page.focus("#chord-number")
            page.keyboard.press("ArrowUp")
            self.assertEqual(page.evaluate("page.state.chord"), 0.3353)

    def test_keys_work_on_a_slider_and_after_the_mouse(self):
        is_turning = "page.isTurning"
        with self.opened() as page:
            page.focus("#collective")
            page.keyboard.press(" ")
            self.assertFalse(page.evaluate(is_turning))
            # A list in which the mouse chose, and a button that it pressed.
            page.dispatch_event("#field", "pointerdown")
            page.focus("#field")
            page.select_option("#field", "mach")
            page.keyboard.press("3")
            self.assertEqual(page.input_value("#field"), "thrustPerLength")
            page.click("[data-view]:nth-child(2)")
            page.keyboard.press(" ")
            self.assertTrue(page.evaluate(is_turning))
            # One that keys move keeps the focus.
            page.focus("#field")
            page.keyboard.press("ArrowDown")
            self.assertEqual(page.input_value("#field"), "mach")
            self.assertEqual(page.evaluate("document.activeElement.id"), "field")

    def test_errors_are_told_and_numbers_of_an_earlier_flight_are_marked(self):
        opacity = "Number(getComputedStyle(document.querySelector('#readouts output')).opacity)"
        fail = "() => { throw new Error('%s failed') }"
        # Without a worker the page computes with functions that can be replaced here.
        with self.opened("rotor=knight-hefner", script="delete window.Worker") as page:
            page.evaluate(
                f"hoverPolar = {fail % 'polar'}; levelFlight = {fail % 'power'};"
                "window.healthy = revolution; null"
            )
            page.fill("#collective-number", "9")
            self.wait(page)
            self.assertEqual(
                page.locator("#messages p").all_inner_texts(), ["polar failed", "power failed"]
            )
            self.assertEqual(page.inner_text("#power"), "no such flight")
            self.assertEqual(page.evaluate(opacity), 1.0)
            page.evaluate(f"revolution = {fail % 'revolution'}; null")
            page.fill("#collective-number", "10")
            self.wait(page)
            self.assertIn("revolution failed", page.inner_text("#messages"))
            self.assertEqual(page.evaluate(opacity), 0.3)
            self.assertEqual(page.locator("#curves .present").count(), 0)
            page.evaluate("revolution = healthy; null")
            page.fill("#collective-number", "11")
            self.wait(page)
            self.assertNotIn("revolution", page.inner_text("#messages"))
            self.assertEqual(page.evaluate(opacity), 1.0)

    def test_a_rotor_that_cannot_be_loaded_is_told(self):
        script = """
            delete window.Worker;
            WebAssembly.Instance = class { constructor() { throw new Error("no memory"); } };
        """
        until = "document.getElementById('messages').textContent"
        with self.opened(script=script, until=until) as page:
            self.assertEqual(page.inner_text("#messages"), "The rotor cannot be loaded: no memory")

    def test_the_licences_are_in_the_page(self):
        with self.opened("rotor=knight-hefner", PHONE) as page:
            page.click("summary")
            text = page.inner_text("#licences")
            for part in ("MIT License", "nalgebra", "dlmalloc", "Apache License"):
                self.assertIn(part, text)
            self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), 390)

    def test_measured_points_are_shown_for_the_rotor_that_was_measured_only(self):
        with self.opened("rotor=knight-hefner") as page:
            self.assertEqual(page.locator("#polar .measured").count(), 13)
            page.fill("#twist-number", "-8")
            self.wait(page)
            self.assertEqual(page.locator("#polar .measured").count(), 0)

    def test_power_has_its_bucket_and_the_trimmed_flight_lies_on_it(self):
        with self.opened() as page:
            curve = page.evaluate(
                "page.results.power.points.map(({ speed, watts }) => [speed, watts])"
            )
            self.assertGreaterEqual(len(curve), 14)
            hover, least, last = curve[0][1], min(p for _, p in curve), curve[-1][1]
            self.assertLess(least, 0.65 * hover)
            self.assertGreater(last, 1.5 * least)
            (low, before), (high, after) = [
                max(p for p in curve if p[0] <= 50.0),
                min(p for p in curve if p[0] > 50.0),
            ]
            on_curve = before + (after - before) * (50.0 - low) / (high - low)
            power = page.evaluate("page.flight.outputs.power")
            self.assertAlmostEqual(power / on_curve, 1.0, delta=0.02)

    def test_power_in_level_flight_does_not_depend_on_the_climb_that_is_set(self):
        points = "page.results.power.points.map(({ speed, watts }) => [speed, watts])"
        present = "#power .present"
        with self.opened() as page:
            level = page.evaluate(points)
            upward = page.evaluate("page.flight.outputs['force[3]']")
            values = ast.literal_eval(page.evaluate("page.python()"))
            self.assertEqual(page.locator(present).count(), 1)
        collective = collective_for(upward, {**values, "velocity[3]": 5.0})
        with self.opened(f"climb=5&collective={collective}") as page:
            climbing = page.evaluate(points)
            self.assertAlmostEqual(
                page.evaluate("page.flight.outputs['force[3]']") / upward, 1.0, delta=1e-3
            )
            self.assertEqual(page.locator(present).count(), 0)
        self.assertEqual([speed for speed, _ in climbing], [speed for speed, _ in level])
        for (speed, one), (_, other) in zip(level, climbing):
            # Each has the weight to 0.2 %.
            self.assertAlmostEqual(other / one, 1.0, delta=0.01, msg=f"{speed} m/s")

    def test_there_is_no_power_curve_without_an_upward_force(self):
        with self.opened("rotor=knight-hefner") as page:
            self.assertEqual(page.locator("#power .curve").count(), 1)
            page.fill("#collective-number", "-5")
            self.wait(page)
            self.assertLess(page.evaluate("page.flight.outputs['force[3]']"), 0.0)
            self.assertEqual(page.inner_text("#power"), "no such flight")
            page.hover("#power")
            self.assertEqual(page.inner_text("#power"), "no such flight")
            self.assertRegex(page.inner_text("#drag"), "0.008.m²")

    def test_it_fits_a_phone_and_a_finger_moves_it(self):
        with self.opened("rotor=knight-hefner", PHONE) as page:
            self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), 390)
            thrust = self.output(page, "thrust")
            page.locator("#collective").scroll_into_view_if_needed()
            box = page.locator("#collective").bounding_box()
            page.touchscreen.tap(box["x"] + 0.8 * box["width"], box["y"] + 0.5 * box["height"])
            self.wait(page)
            self.assertNotEqual(self.output(page, "thrust"), thrust)
            self.assert_as_in_fmpy(page)

    def test_pictures(self):
        folder = ARGUMENTS.pictures
        folder.mkdir(parents=True, exist_ok=True)
        looks = {
            "page": ("", {"viewport": {"width": 1280, "height": 1290}}),
            "page-hover": ("rotor=knight-hefner", {"viewport": {"width": 1280, "height": 1290}}),
            "page-phone": ("", PHONE),
            "page-dark": ("", {**DESKTOP, "color_scheme": "dark"}),
        }
        for name, (link, options) in looks.items():
            with self.opened(link, options) as page:
                page.keyboard.press(" ")
                page.evaluate("page.turned = 0.35")
                page.wait_for_timeout(200)
                page.screenshot(path=folder / f"{name}.png")


def is_other(url):
    return not url.startswith((ARGUMENTS.page.resolve().as_uri(), "blob:", "data:"))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("page", "fmu", "chromium", "pictures"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    ARGUMENTS, rest = parser.parse_known_args()
    unittest.main(argv=[sys.argv[0], "-v", *rest])
