"""Shell completion of `lobe`: subcommands, options, and the names of filters, knobs, scenes and
files."""

import os
import pty
import shutil
import subprocess
import sys
import time

import tap
from program import FOLDER, check, fresh_folder, is_wrong_usage, succeeds

BASH = """
source "$1"
COMP_LINE=$2 COMP_POINT=${#2}
_lobe
printf '%s\\n' "${COMPREPLY[@]}"
"""

# Writes the completions to a file, and "." after each line.
ZSH = """
fpath=($PWD/zsh $fpath)
autoload -Uz compinit
compinit -u -D
unsetopt auto_list auto_menu list_ambiguous list_beep
compadd() {
    local -a words
    if (( ! ${@[(I)-[OAD]*]} )); then
        builtin compadd -A words "$@"
        print -rl -- $words >> offered
    fi
    builtin compadd "$@"
}
forget() { zle kill-buffer; print . >> offered }
zle -N forget
bindkey '^I' complete-word '^G' forget
print . >> offered
"""


def script(shell):
    path = FOLDER / f"lobe.{shell}"
    if not path.exists():
        path.write_text(succeeds("completion", shell).stdout, encoding="utf-8")
    return path


def run(*command, cwd=FOLDER):
    result = subprocess.run(command, cwd=cwd, text=True, capture_output=True, check=False,
                            env={"PATH": "/usr/bin:/bin", "HOME": str(FOLDER),
                                 "LC_ALL": "C.UTF-8"})
    check(result.returncode == 0 and not result.stderr, f"{command}: {result.stderr}")
    return result.stdout.split("\n")


def offers(line, **keywords):
    """Bash's completions of the last word of a line."""
    words = run("bash", "--norc", "-c", BASH, "bash", script("bash"), line, **keywords)
    return {word for word in words if word}


def filters():
    return [line.split(":")[0] for line in succeeds("filters").stdout.splitlines()
            if line and not line.startswith(" ")]


def knobs():
    """The choices of all knobs by name; none for numbers."""
    found = {}
    for line in succeeds("filters").stdout.splitlines():
        words = line.split()
        if line.startswith("    ") and len(words) > 2 and words[2][0] in "[{":
            choices = line[line.index("{") + 1:-1].split(", ") if "{" in line else []
            found.setdefault(words[0], set()).update(choices)
    return found


def scenes():
    return {line.split()[0] for line in succeeds("scenes").stdout.splitlines()}


def test_subcommands():
    check(offers("lobe re") == {"render", "report"}, offers("lobe re"))
    check({"bench", "help", "--version", "manual"} <= offers("lobe "), offers("lobe "))
    check(offers("lobe help com") == {"compare", "completion"}, offers("lobe help com"))
    check(offers("lobe manual fi") == {"filters"}, offers("lobe manual fi"))


def test_options_of_a_subcommand():
    check(offers("lobe render hall --fi") == {"--filter"}, offers("lobe render hall --fi"))
    check(offers("lobe compare --") >= {"--diff", "--crop", "--json", "--help"}, "compare")
    check("--diff" not in offers("lobe render --"), "an option of another subcommand")


def test_filters():
    check(offers("lobe render hall --filter ") == set(filters()), "all")
    check(offers("lobe render hall --filter=le") == {"lean", "leadr"}, "after =")
    check(offers("lobe bench --filters direct,mo") == {"direct,moments"}, "in a list")


def test_knobs_and_their_choices():
    check(offers("lobe render --set ") == {f"{name}=" for name in knobs()}, "names")
    check(offers("lobe render --set epsilon") == {"epsilon0=", "epsilon1="}, "epsilon")
    for name, choices in knobs().items():
        check(offers(f"lobe render hall --set {name}=") == choices, name)


def test_choices_of_an_option():
    check(offers("lobe render --depth ") == {"half", "float"}, "after a blank")
    check(offers("lobe render --depth=ha") == {"half"}, "after =")
    check(offers("lobe render --frames ") == set(), "numbers")


def test_scenes_and_files():
    folder = fresh_folder("completion")
    (folder / "hall of mirrors.gltf").touch()
    (folder / "textures").mkdir()
    check(offers("lobe render ", cwd=folder) ==
          scenes() | {"hall of mirrors.gltf", "textures"}, "all")
    check(offers("lobe bench hall h", cwd=folder) == {"hall", "hall of mirrors.gltf"}, "h")
    check(offers("lobe render -o hall\\ of", cwd=folder) == {"hall of mirrors.gltf"}, "escaped")
    check(offers("lobe render --assets ", cwd=folder) == {"textures"}, "folders")


def test_fish():
    if not shutil.which("fish"):
        return "there is no fish"

    def offered(line):
        return {word.split("\t")[0] for word in
                run("fish", "--no-config", "-c", f"source {script('fish')}; complete -C '{line}'")
                if word}
    check(offered("lobe re") == {"render", "report"}, offered("lobe re"))
    check(offered("lobe render hall --filter le") == {"lean", "leadr"}, "filters")
    check(offered("lobe render hall --set view=") == {"view=radiance", "view=lobes", "view=level",
                                                       "view=samples"},
          offered("lobe render hall --set view="))
    check(offered("lobe compare --di") == {"--diff"}, "options")
    check({"hall"} <= offered("lobe render ha"), "scenes")
    return None


class Zsh:
    """A shell in a terminal that receives key presses."""

    def __init__(self):
        self.folder = fresh_folder("zsh")
        (self.folder / "zsh").mkdir()
        shutil.copy(script("zsh"), self.folder / "zsh/_lobe")
        (self.folder / "start").write_text(ZSH, encoding="utf-8")
        self.offered = self.folder / "offered"
        process, self.terminal = pty.fork()
        if process == 0:
            os.chdir(self.folder)
            os.execvpe("zsh", ["zsh", "-f", "-i"], {
                "PATH": "/usr/bin:/bin", "HOME": str(self.folder), "TERM": "dumb",
                "LC_ALL": "C.UTF-8"})
        os.set_blocking(self.terminal, False)
        self.press("source ./start\n")

    def press(self, keys):
        """Returns the completions once all keys have been processed."""
        os.write(self.terminal, keys.encode())
        for _ in range(1000):
            time.sleep(0.01)
            try:
                os.read(self.terminal, 65536)  # a full terminal buffer would block the shell
            except BlockingIOError:
                pass
            if self.offered.exists() and self.offered.read_text().endswith(".\n"):
                words = set(self.offered.read_text().split("\n")) - {"", "."}
                self.offered.unlink()
                return words
        raise AssertionError(f"zsh says nothing to {keys!r}")

    def offers(self, line):
        return self.press(line + "\t\a")

    def close(self):
        os.close(self.terminal)
        os.wait()


def test_zsh():
    if not shutil.which("zsh"):
        return "there is no zsh"
    run("zsh", "-n", script("zsh"))
    shell = Zsh()
    (shell.folder / "hall of mirrors.gltf").touch()
    for line, words in (("lobe re", {"render", "report"}),
                        ("lobe help com", {"compare", "completion"}),
                        ("lobe compare --di", {"--diff"}),
                        ("lobe render hall --filter ", set(filters())),
                        ("lobe render hall --filter=le", {"lean", "leadr"}),
                        ("lobe bench --filters direct,mo", {"moments"}),
                        ("lobe render hall --set epsilon", {"epsilon0", "epsilon1"}),
                        ("lobe render --depth ", {"half", "float"}),
                        ("lobe view ha", {"hall", "hall\\ of\\ mirrors.gltf"})):
        check(shell.offers(line) == words, f"{line}: {shell.offers(line)}")
    for name, choices in knobs().items():
        found = shell.offers(f"lobe render hall --set {name}=")
        check(found == choices, f"{name}: {found}")
    shell.close()
    return None


def test_unknown_shell():
    is_wrong_usage("completion", "csh", says=["csh", "bash"])
    is_wrong_usage("completion", says="bash")


if __name__ == "__main__":
    sys.exit(tap.run(globals()))
