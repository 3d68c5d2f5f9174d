"""The results of a sweep, as tools/sweep/results.h describes them. `lobe report` has checked the
file: every member has its type."""

from __future__ import annotations

import dataclasses
import json
import math
import re
from dataclasses import dataclass, field
from pathlib import Path

from .errors import ReportError

MAXIMUM_FILTERS = 64
MAXIMUM_ROWS = 1024  # of a scene: more points make no plot
NAN = float("nan")

# Characters that neither HTML nor SVG may contain.
_FORBIDDEN = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\ud800-\udfff\ufffe\uffff]")


@dataclass
class Pass:
    name: str
    milliseconds: float
    count: int
    building: bool
    bytes: float
    copy_milliseconds: float
    once: bool = False


@dataclass
class Errors:
    relative_l2: float
    relative_l1: float
    flip: float
    mean_ratio: float = NAN


@dataclass
class Row:
    scene: str
    filter: str
    settings: dict[str, str]
    varied: str
    rebuilt_ms: float
    retained_ms: float
    building_ms: float
    shading_ms: float
    passes: list[Pass]
    memory_bytes: int
    bytes_per_texel: float
    error: Errors
    error_lobe_base: Errors
    flicker: float
    inside_relative_l2: float = NAN
    silhouettes_relative_l2: float = NAN
    environment_ms: float = NAN
    changed_ms: float = NAN
    changed_wall_ms: float = NAN
    changed_caller_cpu_ms: float = NAN
    changed_process_cpu_ms: float = NAN
    picture: str | None = None
    worth: float = field(default=NAN, init=False)  # in samples, see supersampling.py
    gain: float = field(default=NAN, init=False)  # time of those samples, over retained_ms

    @property
    def is_default(self) -> bool:
        return not self.varied

    @property
    def varied_value(self) -> str:
        return self.settings.get(self.varied, "?")

    @property
    def is_far(self) -> bool:
        """True for the supersampling filter, whose time and error are so far from all others that
        plots omit it; their captions give its figures."""
        return self.filter == "reference"


@dataclass
class Supersampling:
    samples: int
    relative_l2: float


@dataclass
class Scene:
    name: str
    triangles: int
    environment: str | None = None
    lighting: str | None = None
    noise: float = NAN
    supersampling: list[Supersampling] = field(default_factory=list)
    reference: str | None = None
    skipped: str | None = None


@dataclass
class Results:
    path: Path
    time: float  # when the file was written
    version: str
    device: str
    driver: str
    device_type: str
    size: list[int]
    reference_samples: int
    path_samples: int
    frames: int
    complete: bool
    scenes: list[Scene]
    rows: list[Row]
    filters: list[str] = field(init=False)  # in the order of their first rows
    _defaults: dict[tuple[str, str], Row] = field(init=False)

    def __post_init__(self):
        self.filters = list(dict.fromkeys(row.filter for row in self.rows))
        self._defaults = {(row.scene, row.filter): row for row in reversed(self.rows)
                          if row.is_default}

    def default(self, scene: str, name: str) -> Row | None:
        """The row of a scene and a filter with all knobs at their defaults."""
        return self._defaults.get((scene, name))

    def rows_of(self, scene: Scene) -> list[Row]:
        return [row for row in self.rows if row.scene == scene.name]

    def filters_of(self, scene: Scene) -> list[tuple[int, Row]]:
        """The filters measured in a scene: index and row of the defaults of each."""
        rows = ((i, self.default(scene.name, name)) for i, name in enumerate(self.filters))
        return [(i, row) for i, row in rows if row]


# Reading --------------------------------------------------------------------------------------

def clean(value):
    """Replaces characters in all texts of a decoded document that a page must not contain."""
    if isinstance(value, str):
        return _FORBIDDEN.sub("\ufffd", value)
    if isinstance(value, list):
        return [clean(item) for item in value]
    if isinstance(value, dict):
        return {key: clean(item) for key, item in value.items()}
    return value


def parse_json(path: Path):
    """If a member is repeated, the first counts, as in the C reader."""
    try:
        text = path.read_bytes().decode("utf-8-sig", "replace")
        return clean(json.loads(text, strict=False,
                                object_pairs_hook=lambda pairs: dict(reversed(pairs))))
    except OSError as error:
        raise ReportError(f"{path}: {error.strerror}") from error
    except (ValueError, RecursionError) as error:
        raise ReportError(f"{path}: not JSON: {error}") from error


def _make(kind, members, **others):
    """An instance of a class from members of an object; unknown ones are ignored, a number that
    is null becomes NaN."""
    known = {entry.name: entry.type for entry in dataclasses.fields(kind) if entry.init}
    values = {name: NAN if members[name] is None and known[name] == "float" else members[name]
              for name in known if name in members}
    return kind(**{**values, **others})


def _make_row(members):
    return _make(Row, members,
                 settings={entry["name"]: entry["value"] for entry in members["settings"]},
                 passes=[_make(Pass, entry) for entry in members["passes"]],
                 error=_make(Errors, members["error"]),
                 error_lobe_base=_make(Errors, members["error_lobe_base"]))


def without_noise(error: float, noise: float) -> float:
    """A relative L2 error without the reference's noise."""
    if math.isnan(noise) or math.isnan(error):
        return error
    return math.sqrt(max(error * error - noise * noise, 0))


def _remove_noise(results: Results):
    noise = {scene.name: scene.noise for scene in reversed(results.scenes)}
    for row in results.rows:
        row.error.relative_l2 = without_noise(row.error.relative_l2, noise.get(row.scene, NAN))


def _make_scene(members):
    return _make(Scene, members, supersampling=[_make(Supersampling, entry)
                                                for entry in members.get("supersampling", [])])


def _check_limits(results: Results):
    if len(results.filters) > MAXIMUM_FILTERS:
        raise ReportError(f"{results.path}: more than {MAXIMUM_FILTERS} filters")
    for scene in results.scenes:
        count = len(results.rows_of(scene))
        if not scene.skipped and count > MAXIMUM_ROWS:
            raise ReportError(f"{results.path}: scene '{scene.name}' has {count} rows, a plot "
                              f"shows at most {MAXIMUM_ROWS}")


def read(path: Path) -> Results:
    """Errors (relative L2) exclude the references' noise."""
    members = parse_json(path)
    results = _make(Results, members, path=path, time=path.stat().st_mtime,
                    scenes=[_make_scene(entry) for entry in members["scenes"]],
                    rows=[_make_row(entry) for entry in members["rows"]])
    _remove_noise(results)
    _check_limits(results)
    return results
