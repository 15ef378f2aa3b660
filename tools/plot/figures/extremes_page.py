"""What the page of extremes shows of DIR/extremes.json."""

from collections import Counter

from .page_table import NONE, Cell, Heading, Row, Table, number, text

SHOWN = {  # columns of the tables of cases: their titles, and the forms of their numbers
    "sweep": ("sweep", None), "run": ("run", None), "verdict": ("verdict", None),
    "difference": ("difference", ".1e"), "bound": ("bound", ".1e"),
    "pressure_difference": ("difference of pressure", ".1e"), "steps": ("steps", "d"),
    "wall_seconds": ("wall time", ".2f"), "reason": ("why", None)}


def view(data):
    """The variables of templates/extremes.html."""
    rows = [row["values"] for row in data["rows"]]
    studies = list(dict.fromkeys(row["study"] for row in rows))
    anchors = {name: f"study-{i}" for i, name in enumerate(studies, start=1)}
    columns = {column["name"]: column for column in data["columns"]}
    headings = [heading(columns[name], title, form) for name, (title, form) in SHOWN.items()]
    return {
        "version": data["gnomon"],
        "verdicts": data["verdicts"],
        "count": len(rows),
        "counts": counts(rows, studies, anchors, [verdict["name"] for verdict in data["verdicts"]]),
        "tables": [cases(data, name, anchors[name], headings) for name in studies],
        "marked": any(row["marked"] for row in data["rows"]),
        "columns": [heading for heading in headings if heading.numeric],
    }


def heading(column, title, form):
    return Heading(title, column["unit"], column["meaning"], numeric=form is not None)


def counts(rows, studies, anchors, verdicts):
    """How many cases of each study have which verdict."""
    found = Counter((row["study"], row["verdict"]) for row in rows)
    found.update(("", row["verdict"]) for row in rows)
    def line(first, name):
        return Row([first] + [Cell(str(found[name, verdict] or NONE)) for verdict in verdicts])
    return Table([Heading("study", numeric=False)] + [Heading(verdict) for verdict in verdicts],
                 [line(text("all"), "")]
                 + [line(text(name, link=f"#{anchors[name]}"), name)
                    for name in studies])


def cases(data, study, anchor, headings):
    faults = {verdict["name"] for verdict in data["verdicts"] if verdict["fault"]}
    rows = [Row([cell(row, name, form) for name, (_, form) in SHOWN.items()],
                row["values"]["verdict"] in faults)
            for row in data["rows"] if row["values"]["study"] == study]
    return Table(headings, rows, study, anchor)


def cell(row, name, form):
    value = row["values"][name]
    if form is None:
        return text(value, wide=name == "reason", parts=name == "sweep")
    return Cell(number(value, form), marked=name in row["marked"])
