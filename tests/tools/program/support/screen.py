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
# What window_faults.c should do next.
FAULT = FOLDER / "fault"


class Screen:
    """An X server whose frame buffer is a file, in the format of xwd."""

    def __init__(self):
        self.folder = FOLDER / "screen"
        self.folder.mkdir()
        reader, writer = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writer), "-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-fbdir",
             str(self.folder), "-nocursor", "-noreset", "-nolisten", "tcp"],
            pass_fds=[writer], stderr=subprocess.DEVNULL)
        os.close(writer)
        with os.fdopen(reader) as lines:
            self.name = f":{lines.readline().strip()}"
        atexit.register(self.close)

    def close(self):
        self.server.terminate()
        self.server.wait()

    def do(self, *words):
        """Sends events, in xdotool's syntax."""
        subprocess.run(["xdotool", *map(str, words)], check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, "DISPLAY": self.name})

    def picture(self, left=0, top=0, width=WIDTH, height=HEIGHT):
        """Part of the screen: rows of B, G, R and an unused byte per pixel."""
        data = (self.folder / "Xvfb_screen0").read_bytes()
        header = struct.unpack(">25I", data[:100])
        start, stride = header[0] + 12 * header[19], header[12]
        rows = (start + y * stride for y in range(top, top + height))
        return [data[row + 4 * left:row + 4 * (left + width)] for row in rows]


def threads(process):
    """For each thread: its state ("S": sleeping) and its CPU time in ticks."""
    found = []
    for task in Path(f"/proc/{process}/task").iterdir():
        try:
            fields = (task / "stat").read_text().rsplit(")", 1)[1].split()
        except (FileNotFoundError, ProcessLookupError):
            continue  # it has just exited
        found.append((fields[0], int(fields[11]) + int(fields[12])))
    return found


class Window:
    """`lobe view`, at the requested size, in the top left corner of a screen."""

    def __init__(self, screen, *arguments, program=PROGRAM, faults=None, settles=True):
        self.screen = screen
        self.errors = open(FOLDER / "view.err", "w+", encoding="utf-8")
        settings = {**os.environ, "DISPLAY": screen.name, "LOBE_TEST_FAULT": str(FAULT),
                    "XDG_CACHE_HOME": str(FOLDER / "cache")}
        if faults:
            settings["LD_PRELOAD"] = " ".join((settings.get("LD_PRELOAD", ""), str(faults)))
        self.process = subprocess.Popen(
            [program, "view", *map(str, arguments)], cwd=FOLDER, stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL, stderr=self.errors, env=settings)
        self.number = self.find()
        if settles:
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
        """CPU time of the program."""
        return sum(ticks for _, ticks in threads(self.process.pid)) / os.sysconf("SC_CLK_TCK")

    def settle(self):
        """Waits until both the program and the server sleep."""
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
        """Sends events and waits for their effect."""
        self.screen.do(*words)
        self.settle()

    def foretell(self, *lines):
        """Sets what window_faults.c does from now on."""
        changed = FAULT.with_suffix(".new")
        changed.write_text("".join(f"{line}\n" for line in lines))
        changed.rename(FAULT)

    def meets(self, line, *words):
        """Events during which a function of Vulkan fails, or monitors change."""
        self.foretell(line)
        self.do(*words)
        check(not FAULT.exists(), f"{line}: nothing came of it")

    def drop(self, *paths):
        """Drops files or folders from another program's window."""
        with Client(self.screen.name) as client:
            client.drop(self.number, paths)
        self.settle()

    def minimise(self):
        """Resizes the window as window managers do."""
        with Client(self.screen.name) as client:
            client.set_state(self.number, ICONIC)
        self.screen.do("windowunmap", self.number)

    def restore(self):
        with Client(self.screen.name) as client:
            client.set_state(self.number, NORMAL)
        self.screen.do("windowmap", "--sync", self.number, "windowfocus", self.number)

    def close(self):
        """Closes the window as its close button does: with the message that window managers
        send."""
        with Client(self.screen.name) as client:
            client.close_window(self.number)
            return self.process.wait(timeout=60)


class Event(ctypes.Structure):
    """The common start of Xlib's events, padded to the size of any of them."""
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                ("display", ctypes.c_void_p), ("window", ctypes.c_ulong),
                ("rest", ctypes.c_ulong * 24)]


# From X11/X.h.
SELECTION_REQUEST, SELECTION_NOTIFY, CLIENT_MESSAGE = 30, 31, 33
# From X11/Xutil.h: states of windows.
NORMAL, ICONIC = 1, 3


class Client:
    """An X client that sends the messages of window managers and of drag sources."""

    def __init__(self, name):
        self.xlib = ctypes.CDLL("libX11.so.6")
        for function in ("XInternAtom", "XCreateSimpleWindow", "XDefaultRootWindow"):
            getattr(self.xlib, function).restype = ctypes.c_ulong
        self.xlib.XOpenDisplay.restype = ctypes.c_void_p
        self.display = ctypes.c_void_p(self.xlib.XOpenDisplay(name.encode()))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.xlib.XCloseDisplay(self.display)

    def atom(self, name):
        return self.xlib.XInternAtom(self.display, name.encode(), 0)

    def send(self, window, event):
        self.xlib.XSendEvent(self.display, ctypes.c_ulong(window), 0, ctypes.c_long(0),
                             ctypes.byref(event))
        self.xlib.XFlush(self.display)

    def message(self, window, kind, *data):
        """XClientMessageEvent: its type, the format, and five words."""
        event = Event(type=CLIENT_MESSAGE, window=window)
        for i, word in enumerate((self.atom(kind), 32, *data)):
            event.rest[i] = word
        self.send(window, event)

    def close_window(self, window):
        self.message(window, "WM_PROTOCOLS", self.atom("WM_DELETE_WINDOW"))

    def set_state(self, window, state):
        values = (ctypes.c_ulong * 2)(state, 0)
        kind = ctypes.c_ulong(self.atom("WM_STATE"))
        self.xlib.XChangeProperty(self.display, ctypes.c_ulong(window), kind, kind, 32, 0, values,
                                  2)
        self.xlib.XFlush(self.display)

    def wait_for(self, kind):
        """The next event of that type within ten seconds."""
        event = Event()
        for _ in range(500):
            if self.xlib.XCheckTypedEvent(self.display, kind, ctypes.byref(event)):
                return event
            time.sleep(0.02)
        raise AssertionError(f"no event of type {kind}")

    def drop(self, window, paths):
        """XDND, version 5: announces files, their position and the drop; then delivers their names
        on request."""
        root = ctypes.c_ulong(self.xlib.XDefaultRootWindow(self.display))
        source = self.xlib.XCreateSimpleWindow(self.display, root, 700, 500, 9, 9, 0,
                                               ctypes.c_ulong(0), ctypes.c_ulong(0))
        selection, names = self.atom("XdndSelection"), self.atom("text/uri-list")
        self.xlib.XSetSelectionOwner(self.display, ctypes.c_ulong(selection),
                                     ctypes.c_ulong(source), ctypes.c_ulong(0))
        self.message(window, "XdndEnter", source, 5 << 24, names)
        self.message(window, "XdndPosition", source, 0, 100 << 16 | 100, 0,
                     self.atom("XdndActionCopy"))
        self.wait_for(CLIENT_MESSAGE)
        self.message(window, "XdndDrop", source)
        # XSelectionRequestEvent: requestor, selection, target, property, time
        asked = self.wait_for(SELECTION_REQUEST).rest
        text = "".join(f"file://{path}\r\n" for path in paths).encode()
        self.xlib.XChangeProperty(self.display, ctypes.c_ulong(asked[0]), ctypes.c_ulong(asked[3]),
                                  ctypes.c_ulong(asked[2]), 8, 0, text, len(text))
        answer = Event(type=SELECTION_NOTIFY, window=asked[0])
        for i in range(4):
            answer.rest[i] = asked[i + 1]
        self.send(asked[0], answer)
        self.wait_for(CLIENT_MESSAGE)
