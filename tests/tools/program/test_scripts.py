"""The scripts around the program: set-up with missing packages, and the count of test cases.
Nothing is installed: the commands they call are stand-ins that record their arguments."""

import json
import os
import stat
import subprocess
import sys

import tap
from program import ROOT, check, fresh_folder

STAND_IN = """#!/bin/sh
echo "$(basename "$0") $*" >> "$CALLS"
{body}
"""


def set_up(folder, installed, fails="", arguments=("build",)):
    """Runs a copy of tools/setup with only the packages `installed` present; the command `fails`
    fails. Returns the result and the calls of other programs."""
    commands, calls = folder / "commands", folder / "calls"
    commands.mkdir()
    calls.touch()
    (folder / "tools").mkdir()
    (folder / "tools/setup").write_text((ROOT / "tools/setup").read_text())
    bodies = {"dpkg-query": f"case ' {' '.join(installed)} ' in *\" $3 \"*|*' all '*) printf "
                            "installed;; *) exit 1;; esac",
              "sudo": 'exec "$@"', "apt-get": "", "meson": 'mkdir -p "$2"; touch "$2/build.ninja"',
              "ninja": ""}
    for name, body in bodies.items():
        path = commands / name
        path.write_text(STAND_IN.format(body="exit 1" if name == fails else body))
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
    environment = {**os.environ, "PATH": f"{commands}:{os.environ['PATH']}", "CALLS": str(calls)}
    result = subprocess.run(["bash", folder / "tools/setup", *arguments], env=environment,
                            text=True, capture_output=True, check=False)
    return result, [call for call in calls.read_text().splitlines()
                    if not call.startswith("dpkg-query")]


def test_setup_installs_nothing_where_all_is_in_place():
    result, calls = set_up(fresh_folder("all"), ["all"])
    check(result.returncode == 0, result.stderr)
    check(calls == ["meson setup build", "ninja -C build"], str(calls))


def test_setup_says_and_installs_what_is_missing():
    result, calls = set_up(fresh_folder("some"), ["gcc", "meson", "python3"])
    check(result.returncode == 0, result.stderr)
    said = next(line for line in result.stdout.splitlines() if "about to install" in line)
    for name in ("mesa-vulkan-drivers", "libvulkan-dev", "libopenexr-dev", "ninja-build"):
        check(f" {name}" in said, said)
    check(" meson" not in said and " gcc" not in said, said)
    apt = [call for call in calls if call.startswith("apt-get")]
    check(len(apt) == 2 and apt[0].endswith("update"), str(calls))
    check(said.split(": ")[-1] in apt[1], str(apt))
    check(any(call.startswith("sudo") for call in calls) == (os.geteuid() != 0), str(calls))


def test_setup_fails_where_a_step_fails():
    for command, installed in (("apt-get", []), ("meson", ["all"]), ("ninja", ["all"])):
        result, _ = set_up(fresh_folder("failing"), installed, fails=command)
        check(result.returncode == 1, f"{command}: {result.returncode}")
        check(result.stderr.startswith("tools/setup: "), result.stderr)


def test_setup_hands_options_to_meson_once():
    folder = fresh_folder("options")
    _, calls = set_up(folder, ["all"], arguments=("build-other", "-Dx=y", "--fast"))
    check(calls == ["meson setup build-other -Dx=y --fast", "ninja -C build-other"], str(calls))


def test_debian_packages_are_built_with_what_setup_installs():
    setup = (ROOT / "tools/setup").read_text()
    listed = setup[setup.index("packages=("):setup.index("# to test")].splitlines()[1:]
    words = {word for line in listed if "#" not in line for word in line.split()}
    # Present on every machine that builds packages, or only needed for running.
    words -= {"gcc", "g++", "libc6-dev", "ninja-build", "mesa-vulkan-drivers",
              "vulkan-validationlayers", "python3-matplotlib", "python3-jinja2"}
    control = (ROOT / "tools/debian/control").read_text()
    depends = control[control.index("Build-Depends:"):control.index("Standards-Version")]
    needed = {word for word in depends.replace(",", " ").split() if word[0].isalpha()}
    needed -= {"Build-Depends:", "debhelper-compat"}
    check(needed == words, f"setup alone: {words - needed}; packages alone: {needed - words}")


def test_the_debian_package_needs_what_reports_need():
    control = (ROOT / "tools/debian/control").read_text()
    tools = control[control.index("Package: lobe-tools"):]
    setup = (ROOT / "tools/setup").read_text()
    for package in ("python3-matplotlib", "python3-jinja2"):
        check(f" {package}" in tools[:tools.index("Recommends:")] and package in setup, package)


def count(*entries):
    """The last line and the exit status of the summary of a log."""
    log = fresh_folder("log") / "testlog.json"
    log.write_text("".join(json.dumps({"name": "one", **entry}) + "\n" for entry in entries))
    result = subprocess.run([sys.executable, ROOT / "tests/summary.py", log], text=True,
                            capture_output=True, check=False)
    return result.stdout, result.returncode


def test_cases_are_counted():
    tap_text = "1..3\nok 1 - a\nok 2 - b # SKIP no GPU\nok 3 - c # comment\n"
    check(count({"stdout": tap_text, "result": "OK"}) == ("2 passed, 0 failed\n", 0), "TAP")
    check(count({"stdout": "fine", "result": "OK"}) == ("1 passed, 0 failed\n", 0), "plain")
    check(count({"stdout": tap_text, "result": "OK"}, {"stdout": "", "result": "OK"}) ==
          ("3 passed, 0 failed\n", 0), "both")
    printed, status = count({"stdout": "ok 1 - a\n# processor time: 12.50\n", "result": "OK"})
    check(printed.splitlines() == ["12 s of processor time, the most in:", "    12.5 s  one",
                                   "1 passed, 0 failed"] and status == 0, "times")


def test_failures_are_counted():
    check(count({"stdout": "1..2\nnot ok 1 - a\nok 2 - b\n", "result": "FAIL"}) ==
          ("1 passed, 1 failed\n", 1), "a failed case")
    check(count({"stdout": "1..2\nok 1 - a\nok 2 - b\n", "result": "ERROR"}) ==
          ("2 passed, 1 failed\n", 1), "died at the end")
    check(count({"stdout": "1..5\nok 1 - a\n", "result": "OK"}) == ("1 passed, 1 failed\n", 1),
          "lost cases")
    check(count({"stdout": "", "result": "TIMEOUT"}) == ("0 passed, 1 failed\n", 1), "timeout")
    check(count() == ("0 passed, 1 failed\n", 1), "an empty log")


if __name__ == "__main__":
    sys.exit(tap.run(globals()))
