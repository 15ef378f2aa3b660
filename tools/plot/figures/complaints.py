"""Errors of the user. The program reports them with one line and exit code 2."""


class BadInput(Exception):
    """A file that is missing, or is not what it should be."""


class Unsuitable(Exception):
    """A figure that makes no sense for these data; the other figures are drawn nevertheless."""


def reason_of(error):
    """Never empty, and without the quotes that a KeyError puts around its text."""
    text = error.args[0] if isinstance(error, KeyError) and error.args else error
    return str(text) or type(error).__name__
