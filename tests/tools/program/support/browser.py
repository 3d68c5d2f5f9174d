"""Opens pages in a headless browser."""

import os
import shutil
import subprocess

from files import png_read
from program import FOLDER, check

NAMES = ("chromium-headless-shell", "chromium-shell", "chromium", "google-chrome")


def _find():
    found = [path for path in map(shutil.which, NAMES) if path]
    check(found, f"no browser: none of {', '.join(NAMES)}")
    return found[0]


def _environment():
    """The environment without what is set for our own program: sanitizers and their preloaded
    libraries."""
    environment = {name: value for name, value in os.environ.items()
                   if not name.startswith(("LD_PRELOAD", "ASAN_", "LSAN_", "UBSAN_", "MALLOC_"))}
    return {**environment, "HOME": str(FOLDER), "XDG_CACHE_HOME": str(FOLDER / "cache"),
            "XDG_CONFIG_HOME": str(FOLDER / "config")}


def screenshot(page, width, height, scale=1.0):
    """Loads a file without network; returns the messages of its console, and the picture of its
    upper left part as width, height and RGB. `width` and `height` are the window's; the picture
    has them times `scale`."""
    picture = FOLDER / "screenshot.png"
    picture.unlink(missing_ok=True)
    result = subprocess.run(
        [_find(), "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
         "--disable-dev-shm-usage", "--host-resolver-rules=MAP * ~NOTFOUND",
         "--enable-logging=stderr", f"--user-data-dir={FOLDER / 'profile'}",
         f"--window-size={width},{height}", f"--force-device-scale-factor={scale}",
         f"--screenshot={picture}", page.as_uri()],
        env=_environment(), text=True, capture_output=True, timeout=240, check=False,
        cwd=FOLDER, errors="replace")
    check(result.returncode == 0 and picture.exists(), f"the browser failed: {result.stderr}")
    messages = [line for line in result.stderr.splitlines() if ":CONSOLE" in line]
    return messages, png_read(picture)
