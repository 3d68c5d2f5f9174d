"""Drives the program `lobe` as a user would."""

import atexit
import os
import pty
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM = Path(sys.argv[1]).resolve()
ROOT = Path(sys.argv[2]).resolve()
ASSETS = ROOT.parent / "shared" / "assets"
FOLDER = Path(tempfile.mkdtemp(prefix="lobe-test-"))
atexit.register(shutil.rmtree, FOLDER, ignore_errors=True)
# Each test file has its own cache folder for lobe. The driver's cache of compiled shaders is
# shared: recompiling them would take half the time of small pictures.
os.environ.setdefault("MESA_SHADER_CACHE_DIR",
                      os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache"))

SMALL = ["--size", "32x24"]
SCENE = "checkerboard"  # opened and drawn in least time


def lobe(*arguments, timeout=300, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **environment):
    """Runs `lobe ARGUMENTS...` in a fresh folder. Keywords are environment variables."""
    settings = {**os.environ, "XDG_CACHE_HOME": str(FOLDER / "cache"),
                **{name: str(value) for name, value in environment.items()}}
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=FOLDER, env=settings, text=True,
                          stdout=stdout, stderr=stderr, stdin=subprocess.DEVNULL,
                          timeout=timeout, check=False, errors="replace")


def check(condition, message):
    """An assertion that python -O keeps."""
    if not condition:
        raise AssertionError(message)


def report(result):
    return (f"{' '.join(map(str, result.args))}\nstatus {result.returncode}\n"
            f"stdout: {result.stdout}\nstderr: {result.stderr}")


def succeeds(*arguments, **keywords):
    result = lobe(*arguments, **keywords)
    check(result.returncode == 0, report(result))
    return result


def error_lines(result):
    """Lines on standard error except warnings and notices."""
    lines = result.stderr.splitlines()
    return [line for line in lines if line.startswith("lobe: error: ") or
            not line.startswith("lobe: ")]


def said_to_terminal(*arguments):
    """What the program, which succeeds, writes to standard error if that is a terminal."""
    terminal, end = pty.openpty()
    result = lobe(*arguments, stderr=end)
    os.close(end)
    said = os.read(terminal, 65536).decode()
    os.close(terminal)
    check(result.returncode == 0, said)
    return said


def fails(*arguments, status=1, says=(), **keywords):
    """The program exits with that status, and prints one line that contains all words of `says`."""
    result = lobe(*arguments, **keywords)
    check(result.returncode == status, report(result))
    lines = error_lines(result) if status == 1 else result.stderr.splitlines()
    check(len(lines) == 1 and lines[0].startswith("lobe"), report(result))
    check("Sanitizer" not in result.stderr, report(result))
    for words in [says] if isinstance(says, str) else says:
        check(words in lines[0], f"no '{words}' in: {report(result)}")
    return result


def is_wrong_usage(*arguments, says=()):
    result = fails(*arguments, status=2, says=says)
    check(result.stdout == "", report(result))


def fresh_folder(name):
    folder = FOLDER / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    return folder


def leaves(folder, *names):
    """The folder contains exactly these files."""
    found = sorted(path.name for path in folder.iterdir())
    check(found == sorted(names), f"{folder} holds {found}, not {sorted(names)}")
