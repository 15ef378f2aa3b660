"""Results of a parameter sweep (a study with reference = "none") against what was swept."""

import json
import math

from . import style, tables
from .complaints import BadInput, Unsuitable
from .study import distinct

SHOWN = {"worn_volume": "worn volume", "max_pressure": "largest pressure",
         "contact_half_width": "contact half width"}


def of_sweep(rows):
    """Whether the rows of study.csv are of a study that measures no errors."""
    return all(row.get("reference") == "none" for row in rows)


def draw(path, rows):
    """The swept key with the most numbers is the abscissa, everything else tells curves apart."""
    rows = [row for row in rows if row["status"] == "finished"]
    if not rows:
        raise Unsuitable("no run finished")
    shown = [name for name in SHOWN
             if any(math.isfinite(value_of(path, row, name)) for row in rows)]
    keys = swept_keys(rows)
    if not keys:
        raise Unsuitable("the runs that finished do not differ in a number that was swept")
    if not shown:
        raise Unsuitable(f"no run has a {' or '.join(SHOWN.values())}")
    across = max(keys, key=lambda key: len(distinct(row[key] for row in rows)))
    curves = distinct(curve_of(row, across) for row in rows)
    known = units(path)
    label = with_unit(across, across, known)
    figure = style.figure(style.DOUBLE, 0.4 * style.DOUBLE)
    panels = figure.subplots(1, len(shown), squeeze=False)[0]
    handles = []
    for axes, name in zip(panels, shown):
        handles = [draw_curve(axes, path, rows, across, name, curve, colour)
                   for curve, colour in zip(curves, style.sequence(len(curves)))]
        axes.set_xlabel(label)
        axes.set_ylabel(with_unit(SHOWN[name], name, known))
    style.legend_above_all(figure, [handle for handle in handles if handle.get_label()])
    return figure


def units(path):
    """Of the columns, from study.json beside the table; none where only the table was kept."""
    path = path.with_suffix(".json")
    if not path.exists():
        return {}
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        return {column["name"]: column["unit"] for column in data["columns"]}
    except (ValueError, TypeError, KeyError) as error:
        raise BadInput(f"{path} is damaged: {error}") from error


def with_unit(label, column, known):
    return f"{label} [{style.power(known[column])}]" if known.get(column) else label


def draw_curve(axes, path, rows, across, name, curve, colour):
    members = sorted((float(row[across]), value_of(path, row, name)) for row in rows
                     if curve_of(row, across) == curve)
    line, = axes.plot([x for x, _ in members], [y for _, y in members], color=colour, marker="o",
                      label=curve)
    return line


def value_of(path, row, name):
    return tables.number(path, row, name) if name in row else math.nan


def swept_keys(rows):
    """The keys in `sweep` ("a.b=1; c.d=2") with numbers in all rows, of which several differ."""
    keys = [part.split("=")[0] for part in rows[0]["sweep"].split("; ")] if rows else []
    return [key for key in keys if all(is_number(row.get(key)) for row in rows)
            and len(distinct(row[key] for row in rows)) > 1]


def is_number(text):
    try:
        return math.isfinite(float(text))
    except (TypeError, ValueError):
        return False


def curve_of(row, across):
    """What tells a curve from others: method, setting and the other swept values."""
    others = [part for part in row["sweep"].split("; ") if part.split("=")[0] != across]
    return "; ".join([*others, f"{row['method']} {row['setting_kind']} {row['setting']}"])
