"""Tables of a page: headings and cells as text, of rows {column: value} of a JSON file."""

from dataclasses import dataclass

NONE = "\N{EN DASH}"
LONG = 9  # letters of a title on one line


@dataclass
class Heading:
    title: str
    unit: str = ""
    meaning: str = ""
    numeric: bool = True

    @property
    def lines(self):
        """The title on one line, or on two that are about as long as each other."""
        spaces = [i for i, letter in enumerate(self.title) if letter == " "]
        if not spaces or len(self.title) <= LONG:
            return [self.title]
        middle = min(spaces, key=lambda i: abs(2 * i + 1 - len(self.title)))
        return [self.title[:middle], self.title[middle + 1:]]


@dataclass
class Cell:
    text: str
    numeric: bool = True
    marked: bool = False  # an error that its reference cannot resolve
    wide: bool = False  # a sentence, which takes several lines
    parts: bool = False  # of which each may have its own line
    span: int = 1
    link: str = ""


@dataclass
class Row:
    cells: list
    failed: bool = False


@dataclass
class Table:
    headings: list
    rows: list
    title: str = ""
    anchor: str = ""


def number(value, form):
    """Gnomon writes a number that is not finite as a text, because JSON has none."""
    if value is None:
        return NONE
    return "not finite" if isinstance(value, str) else format(value, form)


def text(value, **further):
    return Cell(str(value), numeric=False, **further)
