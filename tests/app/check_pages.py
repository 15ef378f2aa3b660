"""The pages of studies and extremes show their tables, and nothing of a name becomes markup.

usage: check_pages.py FOLDER_OF_THE_PLOTS study|extremes FOLDER
"""

import csv
import json
import shutil
import sys
import tempfile
from html.parser import HTMLParser
from pathlib import Path

sys.path.insert(0, sys.argv[1])
sys.dont_write_bytecode = True
from figures import page  # noqa: E402
from figures.complaints import BadInput, Unsuitable  # noqa: E402
from figures.page_table import Heading  # noqa: E402

OWN = set("html head meta title style body h1 h2 h3 p code pre div figure figcaption table thead "
          "tbody tr th td br a span dl dt dd".split())
OF_FIGURES = set("svg style defs g path use clippath rect image".split())


class Reader(HTMLParser):
    """Tables as lists of rows (class, [(class, text)]), and the texts of the other elements."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.ids, self.links, self.open = set(), [], [], []
        self.tables, self.texts = [], {}
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.tags.add(tag)
        self.ids += [given["id"]] if "id" in given else []
        self.links += [given[name] for name in ("href", "src", "xlink:href") if name in given]
        if tag == "table":
            self.tables.append([])
        elif tag == "tr":
            self.tables[-1].append((given.get("class", ""), []))
        elif tag in ("td", "th"):
            self.tables[-1][-1][1].append([given.get("class", ""), ""])
        elif tag == "br":
            return self.handle_data(" ")
        if tag not in ("meta", "br"):
            self.open.append(tag)
        self.texts.setdefault(tag, []).append("")

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, f"</{tag}> closes another element"

    def handle_data(self, data):
        if any(tag in self.open for tag in ("td", "th")):
            self.tables[-1][-1][1][-1][1] += data
        for tag in set(self.open):
            self.texts[tag][-1] += data

    def rows(self):
        """Of the bodies of all tables."""
        return [row for table in self.tables for row in table[1:]]


def read(folder):
    text = (folder / page.NAME).read_text(encoding="utf-8")
    reader = Reader(text)
    assert not reader.open, reader.open
    assert reader.tags <= OWN | OF_FIGURES, reader.tags - OWN - OF_FIGURES
    assert len(reader.ids) == len(set(reader.ids))
    assert all(link.startswith(("#", "data:")) for link in reader.links), "needs something else"
    assert all(link[1:] in reader.ids for link in reader.links if link.startswith("#"))
    return reader


def texts_of(row):
    return [text for _, text in row[1]]


def rendered(kind, folder, change, reports=None):
    """The page of changed data, in another folder."""
    with tempfile.TemporaryDirectory() as place:
        other = Path(place)
        shutil.copy(page.data_of(folder, kind), other)
        data = json.loads(page.data_of(other, kind).read_text())
        change(data)
        page.data_of(other, kind).write_text(json.dumps(data))
        page.write(other, kind, reports or {})
        return read(other)


def check_study(folder):
    reader = read(folder)
    data = json.loads((folder / "study.json").read_text())
    with open(folder / "study.csv", newline="", encoding="utf-8") as file:
        table = list(csv.DictReader(file))

    # Names are text, whatever characters they have.
    assert reader.texts["h1"] == reader.texts["title"][:1] == [data["title"]]  # figures have theirs
    assert reader.texts["pre"] == [data["text"]] and "<" in data["text"] and "&" in data["text"]
    assert reader.texts["code"][:2] == [data["study"], data["scene"]]
    methods = {row["method"] for row in table}
    assert any(set("<>&\"'") <= set(name) for name in methods)
    shown = [texts_of(row)[0] for row in reader.rows()]
    assert all(f"{name} ({row['integrator']})" in shown for row in table if (name := row["method"]))

    # Every run has a row with its error, a failed one with its reason; marked errors are marked.
    runs = [row for row in reader.rows() if texts_of(row)[0] in
            {f"{row['method']} ({row['integrator']})" for row in table}]
    assert len(runs) == len(table)
    for row, (kind, cells) in zip(table, runs):
        if row["status"] == "failed":
            assert kind == "failed" and cells[2][1] == f"failed: {row['reason']}"
            continue
        assert kind == "" and cells[2][1].startswith(f"{float(row['shape_error']):.2e}")
        assert ("marked" in cells[2][0] + cells[3][0]) == (row["marked"] == "1")
        assert all(("marked" in kind) == text.endswith("*") for kind, text in cells)
    assert {row["status"] for row in table} == {"failed", "finished"}
    assert "1" in {row["marked"] for row in table}
    assert f"{len(table)} runs, {sum(row['status'] == 'failed' for row in table)} failed" in \
        reader.texts["p"][0]

    # The figures are in it, with the ids of their own.
    assert reader.texts["figcaption"] and "svg" in reader.tags and "path" in reader.tags
    meanings = {column["meaning"] for column in data["columns"]}
    assert reader.texts["dd"] and set(reader.texts["dd"]) <= meanings - {""}
    check_special_values(folder)


def check_special_values(folder):
    def spoil(data):
        values = data["rows"][-1]["values"]
        values.update(shape_error="nan", shape_error_max=None, steps=None, worn_volume="inf")
        data["rows"][-1]["marked"] = []
        data["title"] = "bell\u0007 and\u0000 <script>"
        data["rows"][0]["values"]["status"] = "missing"
    reader = rendered("study", folder, spoil)
    assert texts_of(reader.rows()[-1])[2:4] == ["not finite", "\N{EN DASH}"]
    assert reader.texts["h1"] == ["bell  and  <script>"]
    assert "1 missing" in reader.texts["p"][0] and "svg" not in reader.tags

    def warned(data):
        data["warnings"] = {"runs": 3, "each": [{"runs": 2, "run": "a<b>", "text": "few & <wide>"}]}
    reader = rendered("study", folder, warned)
    assert "Warnings" in reader.texts["h2"] and "Of 3 runs; " in " ".join(reader.texts["p"])
    assert ["2", "runs/a<b>.json", "few & <wide>"] in [texts_of(row) for row in reader.rows()]

    def closed(data):
        for point in data["sweep"]:
            point["reference"] = {"text": "closed form", "closed_form": True, "error": 0,
                                  "error_max": 0, "pressure_error": None}
    reader = rendered("study", folder, closed)
    assert texts_of(reader.rows()[0])[1:] == ["closed form", "exact", "exact", "\N{EN DASH}"]
    assert not any("of another family" in text for text in reader.texts["p"])

    def uncompared(data):
        data["compared"] = False
        for point in data["sweep"]:
            del point["reference"]
        for row in data["rows"]:
            row["marked"] = []
    reader = rendered("study", folder, uncompared)
    assert len(reader.tables) == 1 and "References" not in reader.texts["h2"]
    assert texts_of(reader.tables[0][0])[0] == "body.young_modulus MPa"
    assert any(text.startswith("worn volume") for text in texts_of(reader.tables[0][0]))

    reader = rendered("study", folder, lambda data: None, {"<b>": Unsuitable("nothing & nobody")})
    assert "No figures. <b>: nothing & nobody" in reader.texts["p"]
    for damage in (lambda data: data.pop("rows"), lambda data: data.update(columns=3),
                   lambda data: data["rows"][0]["values"].pop("status")):
        try:
            rendered("study", folder, damage)
            raise AssertionError("damage is not seen")
        except BadInput as error:
            assert "study.json is damaged" in str(error), error


def check_extremes(folder):
    reader = read(folder)
    with open(folder / "extremes.csv", newline="", encoding="utf-8") as file:
        table = list(csv.DictReader(file))
    counts = {texts_of(row)[0]: texts_of(row)[1:] for row in reader.tables[0][1:]}
    verdicts = texts_of(reader.tables[0][0])[1:]
    for study in {row["study"] for row in table} | {"all"}:
        for verdict, count in zip(verdicts, counts[study]):
            cases = [row for row in table
                     if row["verdict"] == verdict and study in (row["study"], "all")]
            assert count == (str(len(cases)) if cases else "\N{EN DASH}")
    assert set(reader.texts["h2"]) >= {row["study"] for row in table}
    assert any(set("<>&") <= set(row["study"]) for row in table)
    cases = [row for table in reader.tables[1:] for row in table[1:]]
    for row, (kind, cells) in zip(table, cases, strict=True):
        assert [cells[i][1] for i in (1, 2, -1)] == [row["run"], row["verdict"], row["reason"]]
        assert kind == ("failed" if row["verdict"] in ("wrong", "hung", "crashed") else "")
    assert {"agrees", "refused", "wrong"} <= {row["verdict"] for row in table}


# Titles are broken where the lines are about as long as each other.
assert Heading("steps").lines == ["steps"]
assert Heading("largest shape error").lines == ["largest", "shape error"]

{"study": check_study, "extremes": check_extremes}[sys.argv[2]](Path(sys.argv[3]))
