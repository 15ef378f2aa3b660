"""What goes wrong on the user's side. The program turns it into one line and exit code 2."""


class BadInput(Exception):
    """A file that is missing, or is not what it should be."""


class Unsuitable(Exception):
    """A figure that makes no sense for these data; the others are drawn all the same."""
