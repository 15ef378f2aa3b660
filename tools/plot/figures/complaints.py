"""What goes wrong on the user's side. The program turns it into one line and exit code 2."""


class BadInput(Exception):
    """A file that is missing, or is not what it should be."""


class Unsuitable(Exception):
    """A figure that makes no sense for these data; the others are drawn all the same."""


def reason_of(error):
    """Never empty, and without the quotes that a KeyError puts around its text."""
    text = error.args[0] if isinstance(error, KeyError) and error.args else error
    return str(text) or type(error).__name__
