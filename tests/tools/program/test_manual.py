"""The manual pages that `lobe` prints from its own tables: one for the program and for each
subcommand, complete, and without errors."""

import re
import shutil
import subprocess
import sys
from functools import cache

import tap
from program import FOLDER, check, is_wrong_usage, report, succeeds


@cache
def subcommands():
    """The subcommands that the help lists."""
    text = succeeds("--help").stdout
    return re.findall(r"^  (\w+) ", text[text.index("Subcommands:"):], re.MULTILINE)


@cache
def page(*subcommand):
    """The page's source, as a file. Cases share it: the program prints each once."""
    path = FOLDER / ("-".join(("lobe", *subcommand)) + ".1")
    path.write_text(succeeds("manual", *subcommand).stdout, encoding="utf-8")
    return path


def pages():
    return [page(), *(page(name) for name in subcommands())]


def shown(path):
    """The rendered page, in one line."""
    result = subprocess.run(["man", "-l", path], text=True, capture_output=True, check=False,
                            env={"PATH": "/usr/bin:/bin", "LC_ALL": "C.UTF-8", "MANWIDTH": "1000",
                                 "MANOPT": "--no-hyphenation --no-justification"})
    check(result.returncode == 0, result.stderr)
    return " ".join(result.stdout.split())


def test_program_page_names_every_subcommand():
    text = page().read_text()
    for name in subcommands():
        check(f".BR lobe\\-{name} (1)" in text, name)


def test_pages_have_what_the_help_has():
    for name in subcommands():
        plain = page(name).read_text().replace("\\-", "-")
        for option in re.findall(r"--[a-z-]+", succeeds(name, "--help").stdout):
            check(option in plain, f"{name}: {option}")


def test_filters_page_has_every_knob():
    text = page("filters").read_text().replace("\\-", "-").replace("\\(aq", "'")
    for word in succeeds("filters").stdout.split():
        check(word.rstrip(":") in text, word)


def test_pages_are_shown_as_meant():
    if not shutil.which("man"):
        return "there is no man"
    render, compare = shown(page("render")), shown(page("compare"))
    for words in ("lobe-render - render a scene to an OpenEXR or PNG file",
                  "lobe render [OPTION]... SCENE -o FILE", "-o, --output FILE output: FILE.exr",
                  "[1, 4096] (default 64)", "half, float (default half)", "see 'lobe filters'"):
        check(words in render, f"no '{words}' in {render}")
    check("mean of (a - b)^2 / (b^2 + 0.01)" in compare, compare)
    check("epsilon0 0.95 [0, 1] below this, one lobe becomes four" in shown(page("filters")),
          "knobs")
    check("tablecloth a draped cloth" in shown(page("scenes")), "scenes")
    return None


def test_groff_warns_of_nothing():
    if not shutil.which("man"):
        return "there is no man"
    for path in pages():
        result = subprocess.run(["man", "--warnings=all", "-E", "UTF-8", "-Tutf8", "-Z", "-l",
                                 path],
                                env={"PATH": "/usr/bin:/bin", "LC_ALL": "C.UTF-8"},
                                capture_output=True, check=False)
        check(result.returncode == 0 and not result.stderr, f"{path.name}: {result.stderr}")
    return None


def test_mandoc_warns_of_nothing_but_the_date():
    if not shutil.which("mandoc"):
        return "there is no mandoc"
    for path in pages():
        result = subprocess.run(["mandoc", "-Tlint", "-W", "warning", path], text=True,
                                capture_output=True, check=False)
        said = [line for line in (result.stdout + result.stderr).splitlines()
                if "missing date" not in line]
        check(not said, "\n".join(said))
    return None


def test_unknown_subcommand():
    is_wrong_usage("manual", "paint", says="paint")
    is_wrong_usage("manual", "render", "bench", says="bench")
    is_wrong_usage("render", "--help=paint", says="paint")


def test_help_of_the_manual_prints_no_page():
    result = succeeds("manual", "render", "--help")
    check(result.stdout.startswith("Usage: lobe manual") and ".TH" not in result.stdout,
          report(result))


if __name__ == "__main__":
    sys.exit(tap.run(globals()))
