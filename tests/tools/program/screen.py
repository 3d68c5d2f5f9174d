"""A screen without a monitor (Xvfb), on which windows are driven by real events (xdotool)."""

import atexit
import ctypes
import os
import struct
import subprocess
import time
from pathlib import Path

from program import FOLDER, PROGRAM, check

WIDTH, HEIGHT = 800, 600


class Screen:
    """An X server whose picture lies in a file, in the format of xwd."""

    def __init__(self):
        self.folder = FOLDER / "screen"
        self.folder.mkdir()
        reader, writer = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writer), "-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-fbdir",
             str(self.folder), "-nocursor", "-noreset", "-nolisten", "tcp"], pass_fds=[writer], stderr=subprocess.DEVNULL)
        os.close(writer)
        with os.fdopen(reader) as lines:
            self.name = f":{lines.readline().strip()}"
        atexit.register(self.close)

    def close(self):
        self.server.terminate()
        self.server.wait()

    def do(self, *words):
        """Events: xdotool's words."""
        subprocess.run(["xdotool", *map(str, words)], check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, "DISPLAY": self.name})

    def picture(self, left=0, top=0, width=WIDTH, height=HEIGHT):
        """Part of what is to be seen: rows of B, G, R and a byte without meaning a pixel."""
        data = (self.folder / "Xvfb_screen0").read_bytes()
        header = struct.unpack(">25I", data[:100])
        start, stride = header[0] + 12 * header[19], header[12]
        rows = (start + y * stride for y in range(top, top + height))
        return [data[row + 4 * left:row + 4 * (left + width)] for row in rows]


def threads(process):
    """Of each thread: what it does ("S": sleeps) and how many ticks it has taken."""
    found = []
    for task in Path(f"/proc/{process}/task").iterdir():
        try:
            fields = (task / "stat").read_text().rsplit(")", 1)[1].split()
        except (FileNotFoundError, ProcessLookupError):
            continue  # it has just ended
        found.append((fields[0], int(fields[11]) + int(fields[12])))
    return found


class Window:
    """`lobe view`, as large as it is asked to be, in the top left corner of a screen."""

    def __init__(self, screen, *arguments):
        self.screen = screen
        self.errors = open(FOLDER / "view.err", "w+", encoding="utf-8")
        self.process = subprocess.Popen(
            [PROGRAM, "view", *map(str, arguments)], cwd=FOLDER, stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL, stderr=self.errors,
            env={**os.environ, "DISPLAY": screen.name, "XDG_CACHE_HOME": str(FOLDER / "cache")})
        self.number = self.find()
        self.settle()
        screen.do("windowmove", self.number, 0, 0, "windowfocus", self.number)

    def said(self):
        self.errors.flush()
        self.errors.seek(0)
        return self.errors.read()

    def find(self):
        """X's number of the window, once there is one."""
        for _ in range(300):
            check(self.process.poll() is None, f"ended before it had a window: {self.said()}")
            found = subprocess.run(["xdotool", "search", "--onlyvisible", "--name", "^lobe - "],
                                   env={**os.environ, "DISPLAY": self.screen.name}, text=True,
                                   stdout=subprocess.PIPE, check=False)
            if found.stdout:
                return int(found.stdout.split()[0])
            time.sleep(0.1)
        raise AssertionError(f"no window: {self.said()}")

    def seconds(self):
        """Time of processors that the program has taken."""
        return sum(ticks for _, ticks in threads(self.process.pid)) / os.sysconf("SC_CLK_TCK")

    def settle(self):
        """Waits until the program sleeps, and the server, too."""
        quiet, before = 0, None
        for _ in range(2000):
            time.sleep(0.02)
            now = threads(self.process.pid) + threads(self.screen.server.pid)
            asleep = all(state == "S" for state, _ in now)
            quiet = quiet + 1 if asleep and now == before else 0
            before = now
            if quiet == 5:
                return
        raise AssertionError(f"never comes to rest: {self.said()}")

    def do(self, *words):
        """Events, and what comes of them."""
        self.screen.do(*words)
        self.settle()

    def close(self):
        """As by the cross in the window's corner: the message that window managers send."""
        close_window(self.screen.name, self.number)
        return self.process.wait(timeout=60)


class ClientMessage(ctypes.Structure):
    """Xlib's XClientMessageEvent, with what follows it in XEvent."""
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                ("display", ctypes.c_void_p), ("window", ctypes.c_ulong),
                ("message_type", ctypes.c_ulong), ("format", ctypes.c_int),
                ("data", ctypes.c_long * 5), ("rest", ctypes.c_long * 24)]


def close_window(name, number):
    xlib = ctypes.CDLL("libX11.so.6")
    xlib.XOpenDisplay.restype = ctypes.c_void_p
    xlib.XInternAtom.restype = ctypes.c_ulong
    display = ctypes.c_void_p(xlib.XOpenDisplay(name.encode()))
    message = ClientMessage(type=33, window=number, format=32)
    message.message_type = xlib.XInternAtom(display, b"WM_PROTOCOLS", 0)
    message.data[0] = xlib.XInternAtom(display, b"WM_DELETE_WINDOW", 0)
    xlib.XSendEvent(display, ctypes.c_ulong(number), 0, ctypes.c_long(0), ctypes.byref(message))
    xlib.XCloseDisplay(display)
