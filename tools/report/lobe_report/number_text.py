"""Numbers as text for people, and in a form that programs can read from the page."""

import math

from markupsafe import Markup


def number_text(value: float, significant: int) -> str:
    """Text with this many significant digits, no exponent, and the complete integer part: 0.00123,
    0.163, 14.2, 1623."""
    if math.isnan(value):
        return "–"
    if math.isinf(value) or abs(value) >= 1e18:
        return "∞" if value > 0 else "−∞"
    if value == 0:
        return "0"
    # The exponent after rounding: 0.9996 with three digits is 1.00.
    exponent = int(f"{value:.{significant - 1}e}".partition("e")[2])
    return f"{value:.{min(max(significant - 1 - exponent, 0), 9)}f}"


def number(value: float, significant: int) -> Markup:
    text = number_text(value, significant)
    if not math.isfinite(value):
        return Markup.escape(text)
    return Markup('<data value="{}">{}</data>').format(f"{value:.9g}", text)
