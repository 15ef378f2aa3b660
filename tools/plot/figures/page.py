"""The page of a study or of extremes, index.html: figures, and the tables of the JSON that gnomon
has written beside its CSV. The templates are in tools/plot/templates."""

import json
import os
import re
from pathlib import Path

from . import extremes_page, study_page
from .complaints import BadInput, Unsuitable, reason_of

NAME = "index.html"
VIEWS = {"study": study_page.view, "extremes": extremes_page.view}
TEMPLATES = Path(__file__).resolve().parent.parent / "templates"
CONTROL = re.compile(r"[\x00-\x09\x0b-\x1f\x7f]")  # not allowed in HTML


def data_of(folder, kind):
    return folder / f"{kind}.json"


def has_data(folder):
    return any(data_of(folder, kind).is_file() for kind in VIEWS)


def write(folder, kind, reports, complaint=""):
    """Replaces the page; returns its path. `reports`: pictures by the name of their figure, or the
    reason why there are none; `complaint`: why no figure could be drawn."""
    pictures = {name: report for name, report in reports.items()
                if not isinstance(report, Unsuitable)}
    skipped = [complaint] if complaint else \
        [f"{name}: {report}" for name, report in reports.items() if name not in pictures]
    figures = [figure(name, files) for name, files in pictures.items()]
    text = rendered(folder, kind, figures, skipped)
    part = folder / f"{NAME}.part"
    part.write_text(text, encoding="utf-8")
    os.replace(part, folder / NAME)
    return folder / NAME


def figure(name, files):
    """A picture as an element of a page: without prologue, and without metadata, which holds links.
    The ids in it are its own (output.own_ids)."""
    svg = files[f"{name}.svg"].decode()
    svg = re.sub(r"<metadata>.*?</metadata>\s*", "", svg[svg.index("<svg"):], flags=re.DOTALL)
    return {"name": name, "svg": svg}


def rendered(folder, kind, figures, skipped):
    import jinja2  # only pages need it
    templates = jinja2.Environment(loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True,
                                   undefined=jinja2.StrictUndefined, trim_blocks=True,
                                   lstrip_blocks=True)
    template = templates.get_template(f"{kind}.html")
    path = data_of(folder, kind)
    try:
        view = VIEWS[kind](clean(json.loads(path.read_text(encoding="utf-8"))))
        return template.render(view, figures=figures, skipped=skipped)
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError,
            jinja2.UndefinedError) as error:
        raise BadInput(f"{path} is damaged, or of another version of gnomon: "
                       f"{reason_of(error)}") from error


def clean(data):
    """Control characters become spaces."""
    if isinstance(data, dict):
        return {clean(key): clean(value) for key, value in data.items()}
    if isinstance(data, list):
        return [clean(value) for value in data]
    return CONTROL.sub(" ", data) if isinstance(data, str) else data
