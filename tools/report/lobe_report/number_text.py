"""How people read a number, and how a page holds it for programs as well."""

import math

from markupsafe import Markup


def number_text(value: float, significant: int) -> str:
    """So many significant digits, no exponent, no digit of the integer part left out: 0.00123,
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
