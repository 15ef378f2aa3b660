#!/usr/bin/env python3
"""Draws gnomon's figures: of results, of study directories, of spectra, of extremes; and the pages
of studies and extremes (docs/figures.md).

    gnomon_plot.py result RESULT.h5... [-o DIR] [--svg]
    gnomon_plot.py study DIR [-o DIR] [--svg]
    gnomon_plot.py spectrum DIR [-o DIR] [--svg]
    gnomon_plot.py extremes DIR [-o DIR] [--svg]
    gnomon_plot.py any RESULT.h5|DIR...      finds out which; what `gnomon plot` calls
    gnomon_plot.py mesh MESH.xdmf -o FILE    one picture; what `gnomon mesh` calls

Exit codes: 0 done, 1 a package is missing or a file cannot be written, 2 bad input.
"""

import argparse
import importlib
import logging
import os
import sys
from pathlib import Path

PACKAGES = "python3-matplotlib python3-h5py python3-jinja2"
DEBIANS_OWN = "/usr/bin/python3"


def find_packages(needed):
    """Another Python may come first in the path: the packages belong to Debian's. Where Matplotlib
    cannot write below HOME it uses a temporary folder, which is nobody's concern."""
    logging.getLogger("matplotlib").setLevel(logging.ERROR)
    try:
        for name in needed:
            importlib.import_module(name)
    except ImportError as error:
        if not os.environ.get("GNOMON_PLOT_SECOND_TRY") and os.access(DEBIANS_OWN, os.X_OK):
            os.environ["GNOMON_PLOT_SECOND_TRY"] = "1"
            sys.stdout.flush()
            os.execv(DEBIANS_OWN, [DEBIANS_OWN, *sys.argv])
        raise SystemExit(complain(
            f"drawing needs Python's {error.name}: install the packages {PACKAGES}", 1))
    except OSError:
        raise SystemExit(complain("drawing needs a writable folder for temporary files (TMPDIR) or "
                                  "settings (HOME)", 1))


def complain(message, code):
    print("gnomon: " + " ".join(str(message).split()), file=sys.stderr)
    return code


def options():
    parser = argparse.ArgumentParser(prog="gnomon_plot.py", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kind", choices=["any", "result", "study", "spectrum", "extremes", "mesh"])
    parser.add_argument("targets", nargs="+", type=Path, metavar="RESULT.h5|DIR")
    parser.add_argument("-o", "--output", type=Path, metavar="DIR",
                        help="folder of the figures, without pages; default: figures, beside or in "
                             "the target, and pages in the target")
    parser.add_argument("--svg", action="store_true", help="figures only as SVG")
    return parser.parse_args()


def main():
    chosen = options()
    for target in chosen.targets:
        if not os.path.exists(target):  # also false for an invalid name
            return complain(f"there is no file or folder {target}", 2)
    from figures import page
    has_page = chosen.output is None and any(page.has_data(target) for target in chosen.targets)
    find_packages(["matplotlib", "h5py"] + ["jinja2"] * has_page)
    from figures import run
    from figures.complaints import BadInput
    try:
        if chosen.kind == "mesh":
            run.draw_mesh(chosen.targets[0], chosen.output)
        else:
            run.draw(chosen.kind, chosen.targets, chosen.output, chosen.svg)
    except BadInput as error:
        return complain(error, 2)
    except OSError as error:
        target = error.filename or "what is drawn or printed"
        return complain(f"cannot read or write {target}: {error.strerror}", 1)
    except RuntimeError as error:  # circular links
        return complain(error, 2)
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(complain("interrupted", 1))
