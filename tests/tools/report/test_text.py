"""How a page writes numbers and text."""

import math
import sys
from html.parser import HTMLParser

import tap
from lobe_report import page
from lobe_report.number_text import number, number_text


def check(condition, message=""):
    """An assertion that python -O keeps."""
    if not condition:
        raise AssertionError(message)


def test_numbers_read_well():
    for value, digits, text in ((0.0123456, 3, "0.0123"), (0.99996, 4, "1.000"), (9.996, 3, "10.0"),
                                (14194.3, 4, "14194"), (-2.5, 2, "-2.5"), (0, 4, "0"),
                                (math.nan, 4, "–"), (math.inf, 4, "∞"), (-math.inf, 4, "−∞"),
                                (1e30, 4, "∞"), (1e-30, 3, "0.000000000")):
        check(number_text(value, digits) == text, f"{value}: {number_text(value, digits)}")


def test_pages_hold_numbers_with_all_digits():
    check(number(1 / 3, 3) == '<data value="0.333333333">0.333</data>', number(1 / 3, 3))
    check(number(math.nan, 3) == "–" and number(math.inf, 3) == "∞")


def test_text_is_escaped():
    template = page._environment().from_string('<a title="{{ text }}">{{ text }}</a>')
    text = "<b x=\"1\">'&amp;'</b> ε₀"
    written = template.render(text=text)
    check("<b" not in written and "'" not in written, written)
    found = []

    class Reader(HTMLParser):
        def handle_starttag(self, tag, attrs):
            found.append(dict(attrs)["title"])

        def handle_data(self, data):
            found.append(data)
    reader = Reader()
    reader.feed(written)
    reader.close()
    check(found == [text, text], found)


if __name__ == "__main__":
    sys.exit(tap.run(globals()))
