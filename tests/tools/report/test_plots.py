"""Axes, the Pareto front, labels, and what plots draw."""

import itertools
import math
import random
import re
import sys

import tap
from lobe_report import libraries

libraries.require()

from lobe_report import axes, bars, scatter, style  # noqa: E402
from lobe_report.labels import LONGEST, Labels, shorten, text_width  # noqa: E402
from lobe_report.pareto import front  # noqa: E402
from lobe_report.scatter import Point, Scatter  # noqa: E402

NAN, INFINITY = math.nan, math.inf


def check(condition, message=""):
    """An assertion that python -O keeps."""
    if not condition:
        raise AssertionError(message)


def near(a, b, tolerance=1e-9):
    return math.isclose(a, b, rel_tol=tolerance, abs_tol=tolerance)


# Axes -----------------------------------------------------------------------------------------

def has_ticks(axis, *ticks):
    check(len(axis.ticks) == len(ticks) and all(map(near, axis.ticks, ticks)), axis)


def test_nice_numbers_are_not_below():
    for value, nice in ((1, 1), (1.01, 2), (2, 2), (3, 5), (5.1, 10), (0.3, 0.5), (0.7, 1),
                        (730, 1000), (1e-5, 1e-5)):
        check(near(axes.nice_number(value), nice), f"{value}: {axes.nice_number(value)}")


def test_linear_axes_begin_at_zero():
    axis = axes.fit([40, 18, 45, NAN])
    check(not axis.is_logarithmic and axis.minimum == 0 and near(axis.position(25), 0.5), axis)
    has_ticks(axis, 0, 10, 20, 30, 40, 50)
    for empty in (axes.linear(0), axes.fit([]), axes.fit([NAN])):
        check(empty.maximum > 0 and len(empty.ticks) >= 2, empty)


def test_a_value_of_zero_is_within_the_axis():
    axis = axes.fit([0, 8, 33])
    check(not axis.is_logarithmic and axis.minimum < 0 and axis.position(0) > 0.02, axis)
    check(axis.ticks[0] == 0, axis)


def test_wide_ranges_are_logarithmic():
    axis = axes.fit([0.04, 1.9])
    check(axis.is_logarithmic and axis.minimum < 0.04 and axis.maximum > 1.9, axis)
    has_ticks(axis, 0.05, 0.1, 0.2, 0.5, 1, 2)
    check(near(axis.position(math.sqrt(axis.minimum * axis.maximum)), 0.5), axis)
    has_ticks(axes.fit([1e-3, 1e3]), 1e-3, 1e-2, 0.1, 1, 10, 100, 1000)
    check(not axes.fit([0, 1e3]).is_logarithmic)


def ranges():
    least = 1e-7
    while least < 1e7:
        factor = 1
        while factor < 1e12:
            yield least, least * factor
            factor *= 2.3
        least *= 3.7
    yield from ((5e-324, 1e17), (1e-299, 1e17), (5e-324, 5e-324), (0, 5e-324), (1e300, INFINITY))


def test_every_axis_has_ticks_within():
    for least, most in ranges():
        axis = axes.fit([least, most])
        check(2 <= len(axis.ticks) <= 32, f"{least}, {most}: {axis}")
        for tick in axis.ticks:
            check(axis.minimum - 1e-9 * axis.maximum <= tick <= axis.maximum * (1 + 1e-9), axis)
        check(all(a < b for a, b in itertools.pairwise(axis.ticks)), axis)
        if axes.is_drawable(most) and most > axes.SMALLEST:
            check(0 < axis.position(most) <= 1 + 1e-9, axis)


def test_ticks_are_labelled_shortly():
    for tick, label in ((0.05, "0.05"), (3 * 0.2, "0.6"), (20000, "20000"), (2e6, "2000000")):
        check(axes.label(tick) == label, axes.label(tick))


# Pareto front ---------------------------------------------------------------------------------

def test_the_front_is_what_no_other_beats():
    costs = [(3, 1), (1, 5), (2, 6), (2, 3), (2, 4), (4, 1), (1, 5), (0, NAN), (INFINITY, 0)]
    check(front(costs) == [1, 3, 0], front(costs))
    check(front([]) == [] and front(costs[7:]) == [])


def beats(a, b):
    return a[0] <= b[0] and a[1] <= b[1] and a != b


def test_fronts_follow_the_definition():
    """Points on a coarse grid, so that many are equal in one cost or both."""
    source = random.Random(1)
    for _ in range(200):
        costs = [(source.randrange(16), source.randrange(16)) for _ in range(24)]
        found = [costs[i] for i in front(costs)]
        for cost in costs:
            check(any(beats(other, cost) for other in costs) != (cost in found), costs)
        for a, b in itertools.pairwise(found):
            check(b[0] > a[0] and b[1] < a[1], found)


# Labels ---------------------------------------------------------------------------------------

def overlap(a, b):
    return (min(a[2], b[2]) > max(a[0], b[0]) + 1e-9 and
            min(a[3], b[3]) > max(a[1], b[1]) + 1e-9)


def test_labels_keep_apart():
    labels = Labels((0, 0, 500, 400))
    # Close together, and the first in a corner.
    points = [(4 + 6 * i, 6 + 5 * i) for i in range(8)]
    for x, y in points:
        labels.take((x - 3, y - 3, x + 3, y + 3))
    boxes = [labels.place(x, y, text_width("moments")) for x, y in points]
    check(all(box[0] >= 0 and box[1] >= 0 and box[2] <= 500 for box in boxes), boxes)
    check(not any(overlap(a, b) for a, b in itertools.combinations(boxes, 2)), boxes)


def test_characters_count_once():
    check(near(text_width("εεε"), 3 * text_width("ε"), 0.1), text_width("εεε"))
    check(text_width("aaaa") > text_width("aaa") > 0)
    check(text_width("$a_b$") > text_width("a_b"), "read as mathematics")


def test_long_labels_are_shortened():
    check(shorten("a\n  b") == "a b" and shorten("x" * LONGEST) == "x" * LONGEST)
    check(len(shorten("x" * 1000)) == LONGEST)


# Style ----------------------------------------------------------------------------------------

def test_marks_differ_in_shape():
    paths = [style.key_path(i, 9) for i in range(len(style.SHAPES))]
    check(len(set(paths)) == len(paths), "two shapes are one")
    for path in paths:
        reach = [abs(float(number)) for number in re.findall(r"-?\d+\.\d+", path)]
        check(2.5 < max(reach) < 7, path)
    check(all(style.colour(i) != style.colour(i - 1) for i in range(1, len(style.COLOURS))))


def test_fills_differ():
    fills = {style.fill(i) for i in range(len(style.TINTS) * len(style.HATCHINGS))}
    check(len(fills) == len(style.TINTS) * len(style.HATCHINGS), len(fills))


# Scatter plots --------------------------------------------------------------------------------

def example(**others):
    points = [Point(1, 9, 0, None, "a & b"), Point(2, 5, 0, 0, "c", 1),
              Point(3, 6, 1, None, "d"), Point(NAN, 6, 1, 2, "not there"),
              Point(3, -1, 1, 2, "not there")]
    return Scatter(**{"id": "id", "title": "title", "x_title": "x", "y_title": "y",
                      "series": ["<first>", "second", "unused"], "points": points,
                      "kinds": ("plain", "dotted"), **others})


def test_a_scatter_plot_draws_what_it_can_show():
    text, numbered = scatter.draw(example())
    check(numbered == [0, 1], numbered)
    for part, count in (('class="ring"', 2), ('class="mark"', 3), ("<title>", 3), ("a &amp; b", 1),
                        ("&lt;first&gt;", 2), ("not there", 0), ("unused", 0), (">plain<", 1),
                        (">dotted<", 1), ('class="front"', 1)):
        check(text.count(part) == count, f"{part}: {text.count(part)} times")


def test_marks_are_where_their_values_are():
    text, _ = scatter.draw(example())
    marks = [tuple(map(float, place)) for place in
             re.findall(r'class="mark".*?<use [^>]*x="([\d.]+)" y="([\d.]+)"', text)]
    titles = re.findall(r'class="mark"[^>]*><title>(.*?)</title>', text)
    places = dict(zip(titles, marks))
    a, c, d = places["a &amp; b"], places["c"], places["d"]
    check(near((d[0] - a[0]) / (c[0] - a[0]), 2, 1e-3), places)
    check(near((c[1] - a[1]) / (d[1] - a[1]), 4 / 3, 1e-3) and c[1] > a[1], places)


def test_nothing_to_show_draws_nothing():
    check(scatter.draw(example(points=[Point(NAN, 1, 0, None, "")])) == ("", []))
    check(scatter.draw(example(points=[])) == ("", []))


def test_extreme_values_are_drawn_or_left_out():
    points = [Point(x, y, 0, None, "p") for x, y in
              ((5e-324, 1e17), (1e300, 1), (0, 0), (1e-200, 1e-300), (INFINITY, 1))]
    text, numbered = scatter.draw(example(points=points))
    check(text.count('class="mark"') == 3 and numbered, text.count('class="mark"'))


def test_names_are_no_mathematics():
    text, _ = scatter.draw(example(series=["$\\frac$", "b\nc", "x" * 500]))
    check("$\\frac$" in text and "b c" in text and "x" * 500 not in text)


def test_plots_of_one_page_share_no_ids():
    texts = [scatter.draw(example(id=name))[0] for name in ("one", "two")]
    ids = [set(re.findall(r' id="([^"]+)"', text)) for text in texts]
    check(ids[0] and not ids[0] & ids[1], ids)
    for text, found in zip(texts, ids):
        used = set(re.findall(r'(?:href="#|url\(#)([^")]+)', text))
        check(used and used <= found, used - found)


def test_equal_plots_are_equal_texts():
    check(scatter.draw(example()) == scatter.draw(example()))


def test_plots_name_no_address():
    check("://" not in scatter.draw(example())[0])


# Bars -----------------------------------------------------------------------------------------

def test_bars_are_as_long_as_their_values():
    plot = bars.Bars("id", "title", "x", ["one", "two"],
                     [bars.Bar("a", [bars.Part(0, 10), bars.Part(1, 30)]),
                      bars.Bar("b", [bars.Part(1, 20)])])
    text = bars.draw(plot)
    paths = re.findall(r'class="part"><title>(.*?)</title><path d="([^"]*)"', text)
    check([title for title, _ in paths] == ["one: 10.00", "two: 30.00", "two: 20.00"], paths)
    spans = []
    for _, path in paths:
        x = [float(place) for place in re.findall(r"[ML]([\d.]+) ", path)]
        spans.append((min(x), max(x) - min(x)))
    (x0, first), (x1, second), (x2, third) = spans
    check(near(second, 3 * first, 1e-3) and near(third, 2 * first, 1e-3), spans)
    check(near(x1, x0 + first, 1e-3) and near(x2, x0, 1e-3), spans)


def test_bars_of_no_length_are_drawn():
    text = bars.draw(bars.Bars("id", "t", "x", ["none"], [bars.Bar("<a>", [bars.Part(0, 0)])]))
    check("&lt;a&gt;" in text and "nan" not in text)


if __name__ == "__main__":
    sys.exit(tap.run(globals()))
