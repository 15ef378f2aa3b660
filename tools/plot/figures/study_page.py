"""What the page of a study shows of DIR/study.json."""

import re

from .page_table import Cell, Heading, Row, Table, number, text

TITLES = {  # of columns; others have their names, without underscores
    "shape_error_max": "largest shape error", "shape_error_self": "self error",
    "newton_iterations": "Newton iterations", "residual_evaluations": "residuals",
    "jacobian_evaluations": "Jacobians", "krylov_iterations": "Krylov iterations",
    "wall_seconds": "wall time", "cpu_seconds": "CPU time", "peak_memory_mb": "memory"}
FORMS = {"error": ".2e", "observation": ".5g", "cost": ".2f"}  # of the groups of columns
MEMORY = "peak_memory_mb"


def view(data):
    """The variables of templates/study.html."""
    rows = data["rows"]
    shown = Shown(data["columns"], rows, "error" if data["compared"] else "observation")
    closed = [point["reference"]["closed_form"] for point in data["sweep"] if data["compared"]]
    failed = [row for row in rows if row["values"]["status"] == "failed"]
    missing = [row for row in rows if row["values"]["status"] == "missing"]
    told = data.get("warnings", {"runs": 0, "each": []})  # earlier studies have none
    return {
        "title": data["title"] or data["study"],
        "study": data,
        "counts": ", ".join([of(len(rows), "run"), f"{len(failed)} failed"]
                            + [f"{len(missing)} missing"] * bool(missing)),
        "references": references(data) if data["compared"] else None,
        "recommended": recommended(data) if data["compared"] and data.get("recommendations") else None,
        "any_closed": any(closed),
        "all_closed": all(closed),
        "times": times(data["sweep"]) if data["compared"] else "",
        "by": common_method(rows),
        "tables": error_tables(data, shown) if data["compared"] else [sweep_table(data, shown)],
        "marked": any(row["marked"] for row in rows),
        "warned": of(told["runs"], "run"),
        "warnings": warnings(told["each"]),
        "columns": [heading(column) for column in shown.results + shown.costs],
    }


class Shown:
    """The columns that the tables show: without those that are empty, and costs that are zero."""

    def __init__(self, columns, rows, results):
        def used(group, useless):
            return [column for column in columns if column["group"] == group
                    and any(row["values"][column["name"]] not in useless for row in rows)]
        self.swept = used("sweep", ())
        self.results = used(results, (None,))
        self.costs = used("cost", (None, 0))

    def cells(self, row):
        """The results of a run, or why there are none; and its costs."""
        values = row["values"]
        if values["status"] == "finished":
            results = [value_cell(column, row) for column in self.results]
            results = results or [text(values["status"])]
        else:
            results = [text(f"{values['status']}: {values['reason']}", wide=True,
                            span=max(1, len(self.results)))]
        return results + [value_cell(column, row) for column in self.costs]

    def headings(self):
        results = [heading(column) for column in self.results] or [Heading("result", numeric=False)]
        return results + [heading(column) for column in self.costs]


def heading(column):
    name = column["name"]
    return Heading(TITLES.get(name, name.replace("_", " ")), column["unit"], column["meaning"])


def value_cell(column, row):
    name, value = column["name"], row["values"][column["name"]]
    form = "d" if isinstance(value, int) else ".0f" if name == MEMORY else FORMS[column["group"]]
    return Cell(number(value, form), marked=name in row["marked"])


def error_tables(data, shown):
    """One for each combination of swept values."""
    headings = [Heading("method", numeric=False), Heading("setting", numeric=False)]
    tables = []
    for index, point in enumerate(data["sweep"]):
        rows = [Row([text(method(row)), text(setting(row))] + shown.cells(row), is_failed(row))
                for row in data["rows"] if row["sweep"] == index]
        tables.append(Table(headings + shown.headings(), rows, point["label"]))
    return tables


def sweep_table(data, shown):
    """Of a study without a reference: all runs in one table, without what they have in common."""
    headings = [Heading(column["name"], column["unit"], column["meaning"])
                for column in shown.swept]
    further = [] if common_method(data["rows"]) else [method, setting]
    headings += [Heading(part.__name__, numeric=False) for part in further]
    rows = []
    for row in data["rows"]:
        swept = [swept_cell(row["values"][column["name"]]) for column in shown.swept]
        rows.append(Row(swept + [text(part(row)) for part in further] + shown.cells(row),
                        is_failed(row)))
    return Table(headings + shown.headings(), rows)


def swept_cell(value):
    return Cell(value if isinstance(value, str) else plain(value))


def is_failed(row):
    return row["values"]["status"] != "finished"


def method(row):
    name, integrator = row["values"]["method"], row["values"]["integrator"]
    return name if name == integrator else f"{name} ({integrator})"


def setting(row):
    kind = row["values"]["setting_kind"]
    return f"{kind} {plain(row['values']['setting'])}" + " s" * (kind == "step")


def common_method(rows):
    """By which method and setting all runs are; empty if they differ."""
    ways = {f"{method(row)}, {setting(row)}" for row in rows}
    return ways.pop() if len(ways) == 1 else ""


def references(data):
    """Of the errors of each combination of swept values, with the error of the reference itself."""
    units = {column["name"]: column["unit"] for column in data["columns"]}
    swept = any(point["label"] for point in data["sweep"])
    headings = [Heading("sweep", numeric=False)] * swept + [
        Heading("reference", numeric=False),
        Heading("difference of shape at the end", units["shape_error"]),
        Heading("difference of shape, largest in time", units["shape_error"]),
        Heading("difference of pressure at the end", units["pressure_error"])]
    rows = []
    for point in data["sweep"]:
        reference = point["reference"]
        own = ["exact" if reference["closed_form"] else number(reference[name], ".2e")
               for name in ("error", "error_max")]
        cells = [text(reference["text"], wide=True), *map(Cell, own),
                 Cell(number(reference["pressure_error"], ".2e"))]
        label = [text(point["label"], parts=True)] * swept
        rows.append(Row(label + cells, failed=reference["error"] is None))
    return Table(headings, rows)


def recommended(data):
    """The cheapest run of each accuracy, for each combination of swept values."""
    swept = any(point["label"] for point in data["sweep"])
    headings = [Heading("sweep", numeric=False)] * swept + [
        Heading("error / wear"), Heading("method", numeric=False),
        Heading("setting", numeric=False), Heading("Newton iterations"), Heading("CPU time", "s")]
    rows = []
    for each in data["recommendations"]:
        cells = [text(data["sweep"][each["sweep"]]["label"], parts=True)] * swept
        cells.append(Cell(plain(each["error"])))
        if each["row"] is None:
            cells.append(text("none of these", span=4))
        else:
            row = data["rows"][each["row"]]
            cells += [text(method(row)), text(setting(row)),
                      Cell(number(row["values"]["newton_iterations"], "d")),
                      Cell(number(row["values"]["cpu_seconds"], ".2f"))]
        rows.append(Row(cells))
    return Table(headings, rows)


def warnings(each):
    """One row for each; nothing without any."""
    headings = [Heading(name, numeric=name == "runs") for name in ("runs", "as", "warning")]
    rows = [Row([Cell(str(one["runs"])), text(f"runs/{one['run']}.json", parts=True),
                 text(one["text"], wide=True)]) for one in each]
    return Table(headings, rows) if rows else None


def times(sweep):
    first = sweep[0]["times"]
    differ = any(point["times"] != first for point in sweep)
    note = " in the first combination of swept values" * differ
    return ", ".join(map(plain, first)) + " s" + note


def plain(value):
    """12.5, 0.001, 1e-5."""
    return re.sub(r"e([-+])0+", r"e\1", f"{value:.12g}")


def of(count, noun):
    return f"{count} {noun}" + "s" * (count != 1)
