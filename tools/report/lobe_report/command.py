"""The script's command line, which `lobe report` passes."""

import argparse
import sys
from pathlib import Path

from . import page, picture_stream, results, supersampling, targets
from .errors import ReportError


def _parse(arguments):
    parser = argparse.ArgumentParser(prog="lobe-report")
    parser.add_argument("results", type=Path)
    parser.add_argument("--picture-width", type=int, required=True)
    parser.add_argument("--targets", type=Path)
    return parser.parse_args(arguments)


def _fail(message):
    print("lobe: error:", " ".join(message.split()), file=sys.stderr)
    return 1


def run(arguments):
    """Returns the exit status."""
    options = _parse(arguments)
    try:
        measured = results.read(options.results)
        supersampling.add_worth(measured)
        wanted = targets.read(options.targets) if options.targets else []
        pictures = picture_stream.PictureStream(sys.stdin.buffer)
        text = page.draw(measured, wanted, pictures, options.picture_width)
        sys.stdout.buffer.write(text.encode("utf-8"))
        sys.stdout.flush()
    except picture_stream.Interrupted:
        return 1  # the sender has reported the cause
    except ReportError as error:
        return _fail(str(error))
    except Exception as error:  # users should see no traceback
        return _fail(f"{options.results}: no report: {type(error).__name__}: {error}")
    return 0
