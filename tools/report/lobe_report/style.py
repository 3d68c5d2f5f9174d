"""How filters and passes are distinguished: by colour on a screen; by shape, dashes and hatching in
print and by people with colour blindness. The same index looks the same in every plot."""

from __future__ import annotations

from matplotlib.markers import MarkerStyle
from matplotlib.path import Path

# Okabe and Ito 2008, "Color Universal Design", except for their yellow, which is too pale on
# white: grey instead.
COLOURS = ("#000000", "#e69f00", "#0072b2", "#009e73", "#d55e00", "#56b4e9", "#cc79a7", "#7a7a7a")
DASHES = ("-", (0, (6, 3)), (0, (2, 2)), (0, (8, 2, 2, 2)), (0, (4, 2)), (0, (1, 3)))
# A marker and its size, so that all look equally large.
SHAPES = (("o", 0.95), ("s", 0.88), ("^", 1.1), ("D", 0.85), ("v", 1.1), ("*", 1.4), ("X", 1.1),
          ("h", 1.1), ((4, 1, 0), 1.4), ("p", 1.15))
TINTS = (("#f4f4f4", "#bbbbbb"), ("#fbe6b8", "#dca52e"), ("#cfe3f2", "#6ea6cf"),
         ("#cdeadf", "#55b894"), ("#f8d9c6", "#dd8a55"), ("#dff1fb", "#86c1e4"),
         ("#f2dfe9", "#cf93b4"), ("#dcdcdc", "#9a9a9a"), ("#fff6d0", "#cdb23c"),
         ("#e4e1f3", "#968ec9"))
HATCHINGS = ("", "///", "\\\\\\", "---", "|||", ".")


def colour(series: int) -> str:
    return COLOURS[series % len(COLOURS)]


def dashes(series: int):
    return DASHES[series % len(DASHES)]


def shape(series: int):
    """A marker of matplotlib."""
    return SHAPES[series % len(SHAPES)][0]


def shape_size(series: int) -> float:
    """Scales the marker's diameter."""
    return SHAPES[series % len(SHAPES)][1]


def fill(kind: int) -> tuple[str, str, str]:
    """Fill colour, hatching colour and hatching of an area, light enough for text."""
    # When colours repeat, the hatching changes.
    hatching = HATCHINGS[(kind + kind // len(TINTS)) % len(HATCHINGS)]
    return *TINTS[kind % len(TINTS)], hatching


def key_path(series: int, size: float) -> str:
    """The marker as a path of SVG, `size` wide, around (0, 0)."""
    marker = MarkerStyle(shape(series))
    path = marker.get_path().transformed(marker.get_transform())
    scale = size * shape_size(series)
    commands = {Path.MOVETO: "M", Path.LINETO: "L", Path.CURVE3: "Q", Path.CURVE4: "C"}
    parts = []
    for points, code in path.iter_segments(simplify=False):
        if code == Path.CLOSEPOLY:
            parts.append("Z")
        elif code in commands:
            pairs = zip(points[::2], points[1::2])
            parts.append(commands[code] + " ".join(f"{scale * x:.2f},{-scale * y:.2f}"
                                                   for x, y in pairs))
    return "".join(parts)
