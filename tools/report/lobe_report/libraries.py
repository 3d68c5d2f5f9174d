"""Finds matplotlib and Jinja2, which only reports need."""

import logging
import os
import sys
import warnings
from pathlib import Path

PACKAGES = "python3-matplotlib and python3-jinja2"
SYSTEM_PYTHON = "/usr/bin/python3"


def _silence():
    """Keeps the libraries' warnings off standard error, which is for lobe's own lines."""
    os.environ["MPLBACKEND"] = "svg"  # the backend that the user configured may not be installed
    logging.getLogger("matplotlib").setLevel(logging.CRITICAL)
    warnings.simplefilter("ignore")


def _try_system_python():
    """Debian's packages serve only the system's Python. PATH may find another one first, or that of
    a virtual environment, which is a link to the same file."""
    if sys.executable != SYSTEM_PYTHON and os.path.exists(SYSTEM_PYTHON):
        os.execv(SYSTEM_PYTHON, [SYSTEM_PYTHON, "-B", *sys.argv])


def require():
    """Returns if both can be imported; otherwise exits."""
    _silence()
    try:
        import jinja2  # noqa: F401
        import matplotlib
        # Ignore the user's settings, so that equal results give equal pages.
        matplotlib.rc_file(Path(__file__).with_name("matplotlibrc"))
    except Exception as error:  # a broken installation may raise anything
        _try_system_python()
        cause = " ".join(str(error).split())[:200]
        sys.exit(f"lobe: error: reports need {PACKAGES} (install them): {cause}")
