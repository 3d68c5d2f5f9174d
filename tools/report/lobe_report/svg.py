"""Converts a matplotlib figure to an SVG element for a page with several."""

from __future__ import annotations

import io
import re
import xml.etree.ElementTree as ElementTree

from markupsafe import Markup
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

# An artist's gid holds its class and, after a colon, the index of a tooltip.
_GID = re.compile(r"(mark|part|ring|front|label|halo|overlay)(?::(\d+))?")
_UNITS = 72  # pixels per inch of an SVG


def make_figure(width: float, height: float) -> Figure:
    """In pixels of the page."""
    return Figure(figsize=(width / _UNITS, height / _UNITS))


def _print(figure: Figure) -> ElementTree.Element:
    file = io.BytesIO()
    nothing = dict.fromkeys(("Date", "Creator", "Format", "Type"))
    FigureCanvasSVG(figure).print_svg(file, metadata=nothing)
    return ElementTree.fromstring(file.getvalue())


def _remove_namespaces(root: ElementTree.Element):
    """HTML uses SVG elements without namespaces."""
    for element in root.iter():
        element.tag = element.tag.rpartition("}")[2]
        for name in list(element.attrib):
            value = element.attrib.pop(name)
            element.set(name.rpartition("}")[2], value)


def _remove_unused(root: ElementTree.Element):
    """Removes metadata, a style for the whole page, and the white background."""
    for parent in list(root.iter()):
        for child in list(parent):
            if child.tag in ("metadata", "style") or child.get("id") == "patch_1":
                parent.remove(child)


def _describe_groups(root: ElementTree.Element, tooltips: list[str]):
    for group in root.iter("g"):
        match = _GID.fullmatch(group.get("id", ""))
        if not match:
            continue
        del group.attrib["id"]
        group.set("class", match[1])
        if match[2]:
            title = ElementTree.Element("title")
            title.text = tooltips[int(match[2])]
            group.insert(0, title)


def _make_names_unique(root: ElementTree.Element, prefix: str):
    """Adds the prefix to ids that are referred to, and removes the others."""
    text = ElementTree.tostring(root, encoding="unicode")
    used = set(re.findall(r"[\"(]#([^\")]+)[\")]", text))
    for element in root.iter():
        if element.get("id") in used:
            element.set("id", f"{prefix}-{element.get('id')}")
        else:
            element.attrib.pop("id", None)
        if "href" in element.attrib:
            element.set("href", element.get("href").replace("#", f"#{prefix}-"))
        for name in ("style", "clip-path", "fill"):
            if "url(#" in element.get(name, ""):
                element.set(name, element.get(name).replace("url(#", f"url(#{prefix}-"))


def _leave_font_to_page(root: ElementTree.Element):
    for text in root.iter("text"):
        style = re.sub(r"font: ([\d.]+px) [^;]*", r"font-size: \1", text.get("style", ""))
        text.set("style", style)


def _round(match: re.Match) -> str:
    return f"{float(match[0]):.2f}".rstrip("0").rstrip(".")


def _compact(root: ElementTree.Element):
    """A page has dozens of plots: spaces and invisible digits would double its size."""
    for element in root.iter():
        element.tail = None
        if element.text and not element.text.strip():
            element.text = None
        if element.get("transform", "").startswith("rotate(-0 "):
            del element.attrib["transform"]
        for name in ("d", "x", "y", "transform", "style"):
            if name in element.attrib:
                value = re.sub(r"-?\d+\.\d{3,}", _round, element.get(name))
                element.set(name, re.sub(r"\s*([;:MLz])\s*", r"\1", value.strip()))


def _name(root: ElementTree.Element, prefix: str, title: str, description: str):
    """A title and description for screen readers."""
    root.attrib = {"class": "plot", "viewBox": root.get("viewBox"), "role": "img",
                   "aria-labelledby": f"{prefix}-title {prefix}-text"}
    for index, (tag, part, text) in enumerate((("title", "title", title),
                                               ("desc", "text", description))):
        element = ElementTree.Element(tag, {"id": f"{prefix}-{part}"})
        element.text = text
        root.insert(index, element)


def inline(figure: Figure, prefix: str, title: str, description: str,
           tooltips: list[str] = ()) -> Markup:
    """`prefix` is unique in the page."""
    root = _print(figure)
    _remove_namespaces(root)
    _remove_unused(root)
    _describe_groups(root, tooltips)
    _make_names_unique(root, prefix)
    _leave_font_to_page(root)
    _compact(root)
    _name(root, prefix, title, description)
    return Markup(ElementTree.tostring(root, encoding="unicode"))
