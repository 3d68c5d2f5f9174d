"""From renderings to the pictures that a report shows."""

import base64
import io
import struct
import sys

import numpy
from PIL import Image

import tap
from lobe_report import libraries

libraries.require()

from lobe_report import gallery, picture_stream, pictures  # noqa: E402
from lobe_report.pictures import Window  # noqa: E402

WIDTH, HEIGHT = 30, 20
HEAT = numpy.repeat(numpy.arange(256, dtype=numpy.uint8)[:, None], 3, axis=1)  # grey by value


def check(condition, message=""):
    """An assertion that python -O keeps."""
    if not condition:
        raise AssertionError(message)


def linear(seed, width=WIDTH, height=HEIGHT):
    return numpy.random.default_rng(seed).random((height, width, 4), dtype=numpy.float32)


def errors(value):
    return numpy.full((HEIGHT, WIDTH), value, numpy.float32)


def test_a_map_has_the_error_that_is_reported():
    test, reference = linear(1), linear(2)
    found = pictures.error_map(test, reference)
    a, r = (picture[..., :3].astype(float) for picture in (test, reference))
    relative_l2 = numpy.sqrt(((a - r) ** 2).sum() / (r ** 2).sum())
    check(abs(numpy.sqrt((found.astype(float) ** 2).mean()) - relative_l2) < 1e-6, relative_l2)
    pixel = numpy.sqrt(((a - r)[3, 5] ** 2).sum() / ((r ** 2).sum() / (WIDTH * HEIGHT)))
    check(abs(found[3, 5] - pixel) < 1e-5, f"{found[3, 5]}, not {pixel}")


def test_a_black_reference_has_no_finite_error():
    found = pictures.error_map(linear(1), numpy.zeros((HEIGHT, WIDTH, 4), numpy.float32))
    check(not numpy.isfinite(found).any(), found)
    check(pictures.quantile([found], 0.9) == 0)
    shown = pictures.heat_map(found, 1, 4, HEAT)
    check((shown == 0).all(), shown)


def test_quantiles_pool_all_pictures():
    maps = [errors(0.25), errors(3)]
    for part, value in ((0.4, 0.25), (0.6, 3), (1, 3)):
        check(pictures.quantile(maps, part) == value, f"{part}: {pictures.quantile(maps, part)}")
    check(pictures.quantile([], 0.5) == 0)
    maps[1][::2], maps[1][1::2] = numpy.nan, numpy.inf
    check(pictures.quantile(maps, 1) == 0.25, pictures.quantile(maps, 1))


def test_the_worst_window_is_found():
    found = errors(0.1)
    found[10:14, 15:21] = 1
    check(pictures.worst_window([found], 6, 4) == Window(15, 10, 6, 4),
          pictures.worst_window([found], 6, 4))
    other = errors(0)
    other[0:4, 0:6] = 10
    check(pictures.worst_window([found, other], 6, 4) == Window(0, 0, 6, 4), "sum of both")


def test_a_window_that_is_not_finite_counts_nothing():
    found = errors(0.1)
    found[0, 0] = numpy.nan
    found[10, 15] = 5
    check(pictures.worst_window([found], 6, 4) != Window(0, 0, 6, 4))


def test_pictures_are_averaged_as_light():
    # Columns of 0 and 188 (0.5 as light) by turns; the last block has a single column, of 0.
    shown = numpy.zeros((2, 5, 3), numpy.uint8)
    shown[:, 1::2] = 188
    reduced = pictures.reduce(shown, 2)
    check(reduced.shape == (1, 3, 3), reduced.shape)
    # 0.25 of light is 137 in sRGB.
    check(abs(int(reduced[0, 0, 0]) - 137) <= 1, reduced)
    check((reduced[0, 0] == reduced[0, 1]).all() and (reduced[0, 2] == 0).all(), reduced)


def test_a_reduction_keeps_plain_areas():
    for value in (0, 1, 7, 100, 200, 254, 255):
        shown = numpy.full((HEIGHT, WIDTH, 3), value, numpy.uint8)
        check((pictures.reduce(shown, 7) == value).all(), value)


def test_pictures_are_reduced_to_the_width_at_most():
    for width, maximum, factor in ((320, 320, 1), (321, 320, 2), (640, 320, 2), (641, 320, 3)):
        check(pictures.reduction(width, maximum) == factor, f"{width} to {maximum}")


def test_heat_maps_end_at_the_scale():
    for scale, value in ((2, 64), (1, 128), (0.5, 255), (0.1, 255)):
        shown = pictures.heat_map(errors(0.5), scale, 4, HEAT)
        check(shown.shape == (5, 8, 3) and (shown == value).all(), f"{scale}: {shown[0, 0]}")


def test_blocks_of_errors_are_averaged():
    found = errors(0)
    found[:, ::2] = 1
    check((pictures.heat_map(found, 1, 2, HEAT) == 128).all())


def test_a_window_is_shown_pixel_for_pixel():
    shown = numpy.arange(HEIGHT * WIDTH * 3, dtype=numpy.uint32).astype(numpy.uint8)
    shown = shown.reshape(HEIGHT, WIDTH, 3)
    part = Window(7, 5, 9, 4).of(shown)
    check(part.shape == (4, 9, 3) and (part == shown[5:9, 7:16]).all())


def test_a_page_holds_all_of_a_picture():
    shown = (255 * linear(4)[..., :3]).astype(numpy.uint8)
    kind, data = pictures.data_uri(shown).split(",")
    check(kind == "data:image/png;base64", kind)
    read = numpy.asarray(Image.open(io.BytesIO(base64.b64decode(data, validate=True))))
    check((read == shown).all())
    check(pictures.data_uri(shown) == pictures.data_uri(shown), "two PNGs of one picture")


def test_the_scale_leaves_out_the_worst_tenth():
    maps = [errors(0.3)]
    maps[0][:1] = 100
    check(gallery._scale(maps) == 0.5, gallery._scale(maps))
    check(gallery._scale([]) == 1 and gallery._scale([errors(0)]) == 1)


# Stream ---------------------------------------------------------------------------------------

def sent(*scenes):
    data = HEAT.tobytes()
    for scene in scenes:
        data += struct.pack("=I", len(scene))
        for row, picture in scene:
            shown = numpy.full(picture.shape, 9, numpy.uint8)
            data += struct.pack("=3I", row, picture.shape[1], picture.shape[0])
            data += picture.tobytes() + shown.tobytes()
    return data


def test_pictures_come_scene_by_scene():
    a, b = linear(1, 4, 3), linear(2, 4, 3)
    data = sent([(picture_stream.REFERENCE, a), (7, b)], [], [(picture_stream.REFERENCE, b)])
    stream = picture_stream.PictureStream(io.BytesIO(data))
    check((stream.heat_colours == HEAT).all(), "colours")
    first, none, last = (list(stream.scene()) for _ in range(3))
    check([picture.row for picture in first] == [None, 7] and none == [], "rows")
    check((first[1].linear == b).all() and (last[0].linear == b).all(), "texels")
    check(first[0].size == (4, 3) and first[0].shown.shape == (3, 4, 3), "size")


def test_a_stream_that_ends_early_is_noticed():
    data = sent([(picture_stream.REFERENCE, linear(1, 4, 3))])
    for size in (0, 100, 768, 770, 780, len(data) - 1):
        try:
            list(picture_stream.PictureStream(io.BytesIO(data[:size])).scene())
        except picture_stream.Interrupted:
            continue
        raise AssertionError(f"{size} bytes were enough")


if __name__ == "__main__":
    sys.exit(tap.run(globals()))
