"""glTF files of bright squares that move along x, in each way that a file can move them."""

import base64
import bisect
import struct

from files import gltf_write

# Seconds, none of them that of a frame: frames are 1/30 s apart.
TIMES = [0, 0.14, 0.35]
PLACES = [-1.0, 0.8, -0.3]
# Of cubic splines, per second: of each key, the tangent that arrives and the one that leaves.
TANGENTS = [(0.0, 6.0), (-9.0, 3.0), (12.0, 0.0)]
WAYS = ["node", "skin", "morph"]
INTERPOLATIONS = ["STEP", "LINEAR", "CUBICSPLINE"]
HALF_WIDTH = 2.0  # metres that a picture shows to each side
ROW = 0.25        # between squares that move in different ways


def place(interpolation, seconds):
    """Where the square's middle is: glTF 2.0, appendix C."""
    seconds %= TIMES[-1]
    k = min(bisect.bisect_right(TIMES, seconds), len(TIMES) - 1) - 1
    length = TIMES[k + 1] - TIMES[k]
    t, start, end = (seconds - TIMES[k]) / length, PLACES[k], PLACES[k + 1]
    if interpolation == "STEP":
        return start
    if interpolation == "LINEAR":
        return start + t * (end - start)
    leaves, arrives = length * TANGENTS[k][1], length * TANGENTS[k + 1][0]
    # The polynomial through both ends with both slopes, by Horner's scheme.
    return start + t * (leaves + t * (3 * (end - start) - 2 * leaves - arrives +
                                      t * (2 * (start - end) + leaves + arrives)))


class Buffer:
    """Accessors, each with a view of its own."""

    def __init__(self):
        self.data, self.views, self.accessors = b"", [], []

    def add(self, kind, component, values):
        sizes = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}
        form = {5126: "f", 5121: "B", 5123: "H"}[component]
        packed = struct.pack(f"<{len(values)}{form}", *values)
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(packed)})
        self.accessors.append({"bufferView": len(self.views) - 1, "componentType": component,
                               "type": kind, "count": len(values) // sizes[kind]})
        self.data += packed + bytes(-len(packed) % 4)
        return len(self.accessors) - 1

    def members(self):
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        return {"buffers": [{"byteLength": len(self.data), "uri": uri}],
                "bufferViews": self.views, "accessors": self.accessors}


class Squares:
    """The document, square by square."""

    def __init__(self, count):
        self.buffer, self.count, self.added = Buffer(), count, 0
        s = 0.4 * ROW
        self.attributes = {
            "POSITION": self.buffer.add("VEC3", 5126, [-s, -s, 0, s, -s, 0, s, s, 0, -s, s, 0]),
            "NORMAL": self.buffer.add("VEC3", 5126, [0, 0, 1] * 4)}
        self.indices = self.buffer.add("SCALAR", 5123, [0, 1, 2, 0, 2, 3])
        self.joints = self.buffer.add("VEC4", 5121, [0] * 16)
        self.weights = self.buffer.add("VEC4", 5126, [1, 0, 0, 0] * 4)
        self.target = self.buffer.add("VEC3", 5126, [1, 0, 0] * 4)
        self.times = self.buffer.add("SCALAR", 5126, TIMES)
        self.animation = {"name": "slide", "channels": [], "samplers": []}
        self.document = {
            "asset": {"version": "2.0"}, "meshes": [], "skins": [],
            "nodes": [{"camera": 0, "translation": [0, 0, 5]}],
            "materials": [{"emissiveFactor": [1, 1, 1]}], "animations": [self.animation],
            "cameras": [{"type": "orthographic", "orthographic": {
                "xmag": HALF_WIDTH, "ymag": count * ROW / 2, "znear": 1, "zfar": 9}}]}

    def _outputs(self, way, interpolation, y):
        """The channel's values: along x, or of one weight."""
        values = []
        for here, (arrives, leaves) in zip(PLACES, TANGENTS):
            three = (arrives, here, leaves) if interpolation == "CUBICSPLINE" else (here,)
            for i, value in enumerate(three):
                height = y if len(three) == 1 or i == 1 else 0
                values += [value] if way == "morph" else [value, height, 0]
        return self.buffer.add("SCALAR" if way == "morph" else "VEC3", 5126, values)

    def add(self, way, interpolation):
        """Below those before."""
        y = ((self.count - 1) / 2 - self.added) * ROW
        self.added += 1
        primitive = {"attributes": dict(self.attributes), "indices": self.indices, "material": 0}
        node = {"mesh": len(self.document["meshes"])}
        target = {"node": len(self.document["nodes"]), "path": "translation"}
        self.document["meshes"].append({"primitives": [primitive]})
        self.document["nodes"].append(node)
        if way == "skin":
            primitive["attributes"].update({"JOINTS_0": self.joints, "WEIGHTS_0": self.weights})
            node["skin"] = len(self.document["skins"])
            target["node"] += 1
            self.document["skins"].append({"joints": [target["node"]]})
            self.document["nodes"].append({"name": "joint"})
        elif way == "morph":
            node["translation"] = [0, y, 0]
            primitive["targets"] = [{"POSITION": self.target}]
            target["path"] = "weights"
        self.animation["channels"].append({"sampler": len(self.animation["samplers"]),
                                           "target": target})
        self.animation["samplers"].append({
            "input": self.times, "output": self._outputs(way, interpolation, y),
            "interpolation": interpolation})

    def finish(self):
        if not self.document["skins"]:
            del self.document["skins"]
        return {**self.document, **self.buffer.members()}


def moving_squares(ways):
    """The document: an orthographic camera sees HALF_WIDTH to each side, and one row for each pair
    of a way and an interpolation, the first at the top."""
    squares = Squares(len(ways))
    for way, interpolation in ways:
        squares.add(way, interpolation)
    return squares.finish()


def write_moving_square(path, way="node", interpolation="LINEAR"):
    gltf_write(path, moving_squares([(way, interpolation)]))
    return path
