"""Finds matplotlib and Jinja2, which lobe itself can do without."""

import logging
import os
import sys
import warnings
from pathlib import Path

PACKAGES = "python3-matplotlib and python3-jinja2"
SYSTEM_PYTHON = "/usr/bin/python3"


def _silence():
    """Standard error is for lobe's own lines."""
    os.environ["MPLBACKEND"] = "svg"  # a user's own may be one that is not installed
    logging.getLogger("matplotlib").setLevel(logging.CRITICAL)
    warnings.simplefilter("ignore")


def _try_system_python():
    """Packages of the system are for its own Python; another one may come first in PATH, or a
    virtual environment, whose program is a link to the same file."""
    if sys.executable != SYSTEM_PYTHON and os.path.exists(SYSTEM_PYTHON):
        os.execv(SYSTEM_PYTHON, [SYSTEM_PYTHON, "-B", *sys.argv])


def require():
    """Returns when both can be imported; ends the program otherwise."""
    _silence()
    try:
        import jinja2  # noqa: F401
        import matplotlib
        # Nothing of a user's own settings, so that equal results give equal pages.
        matplotlib.rc_file(Path(__file__).with_name("matplotlibrc"))
    except Exception as error:  # a broken installation may raise anything
        _try_system_python()
        cause = " ".join(str(error).split())[:200]
        sys.exit(f"lobe: error: reports need {PACKAGES} (install them): {cause}")
