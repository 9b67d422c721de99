"""The page from its template, page.md, which has the text; numbers and tables are filled in."""

import re
from dataclasses import dataclass, field
from pathlib import Path

from errors import Errors

TEMPLATE = Path(__file__).resolve().parent / "page.md"


@dataclass
class Report:
    """The result of a case: texts for the places of the template, by name, and its errors."""

    texts: dict[str, str] = field(default_factory=dict)
    errors: list[Errors] = field(default_factory=list)


def fill(texts):
    """The page. A place without a text, or a text without a place, is an error."""
    template = TEMPLATE.read_text(encoding="utf-8")
    places = set(re.findall(r"\{\{([\w.-]+)\}\}", template))
    if missing := places - set(texts):
        raise ValueError(f"page.md has places without a text: {sorted(missing)}")
    if unused := set(texts) - places:
        raise ValueError(f"page.md has no place for {sorted(unused)}")
    return re.sub(r"\{\{([\w.-]+)\}\}", lambda place: texts[place.group(1)], template)


def table(header, rows, left=1):
    """A Markdown table; the first `left` columns are text, the others are aligned to the right."""
    rules = ["---"] * left + ["---:"] * (len(header) - left)
    lines = [header, rules, *rows]
    return "\n".join("| " + " | ".join(map(str, cells)) + " |" for cells in lines)


def number(value, unit, signed=False):
    """Ratios with four decimals, degrees with two, per cent with one."""
    digits = {"1": 4, "deg": 2}.get(unit, 1)
    # Adding 0 turns "-0.0" into "0.0".
    value = round(value, digits) + 0.0
    return f"{value:+.{digits}f}" if signed else f"{value:.{digits}f}"


STATISTICS = ["points", "mean", "mean of magnitudes", "RMS", "worst", "scatter"]


def statistics(errors, with_unit=False):
    """The cells under STATISTICS."""

    def said(value, signed=False):
        text = number(value, errors.unit, signed)
        return f"{text} {errors.unit}" if with_unit and errors.unit != "1" else text

    return [
        errors.points,
        said(errors.mean, True),
        said(errors.mean_absolute),
        said(errors.rms),
        said(errors.worst, True),
        said(errors.scatter) if errors.scatter is not None else "-",
    ]


def error_table(rows):
    """Errors of one case, each in its unit."""
    cells = [[e.quantity, e.model, *statistics(e), e.unit] for e in rows]
    return table(["quantity", "model", *STATISTICS, "unit"], cells, 2)
