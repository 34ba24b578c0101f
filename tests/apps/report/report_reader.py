# SPDX-License-Identifier: MIT
"""Reads a report back, following docs/reference/report-format.md."""
import array
import base64
import html.parser
import json
import zlib

TYPES = {"u8": "B", "i8": "b", "u16": "H", "i16": "h", "u32": "I", "i32": "i", "f32": "f",
         "f64": "d"}
NONE = 2 ** 32 - 1


class Elements(html.parser.HTMLParser):
    """The elements of a page as a browser parses them: the tags with the names of their attributes,
    and the scripts as (attributes, text)."""

    def __init__(self, text):
        super().__init__(convert_charrefs=False)
        self.tags, self._pieces, self.inside = [], [], False
        self.feed(text)
        self.close()
        self.scripts = [(attributes, "".join(pieces)) for attributes, pieces in self._pieces]

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, tuple(name for name, _ in attributes)))
        self.inside = tag == "script"
        if self.inside:
            self._pieces.append((dict(attributes), []))

    def handle_endtag(self, tag):
        self.inside = self.inside and tag != "script"

    def handle_data(self, data):
        if self.inside:
            self._pieces[-1][1].append(data)


class Array:
    """An array of the page: its decoded `values` in C order, and its `shape`."""

    def __init__(self, attributes, text):
        code = TYPES[attributes["data-type"]]
        self.type = attributes["data-type"]
        self.shape = [int(n) for n in attributes["data-shape"].split(",")]
        count = 1
        for n in self.shape:
            count *= n
        raw = zlib.decompress(base64.b64decode(text, validate=True))
        width = array.array(code).itemsize
        assert len(raw) == count * width, (attributes, len(raw))
        filters = attributes.get("data-filter", "").split()
        if "planes" in filters:
            numbers = bytearray(len(raw))
            for k in range(width):
                numbers[k::width] = raw[k * count:(k + 1) * count]
            raw = bytes(numbers)
        values = array.array(code, raw).tolist()
        columns = count // self.shape[0] if len(self.shape) > 1 and count else 1
        if "delta" in filters:
            bits = 8 * width
            for i in range(columns, count):
                total = (values[i] + values[i - columns]) % 2 ** bits
                values[i] = total - 2 ** bits if code.islower() and total >> bits - 1 else total
        self.stored = values
        if "data-scale" in attributes:
            offset = [float(x) for x in attributes["data-offset"].split(",")]
            scale = [float(x) for x in attributes["data-scale"].split(",")]
            values = [offset[i % columns] + scale[i % columns] * v for i, v in enumerate(values)]
        self.values = values

    def rows(self):
        n = self.shape[1]
        return [tuple(self.values[i:i + n]) for i in range(0, len(self.values), n)]


class Report:
    def __init__(self, path):
        with open(path, encoding="utf-8", newline="") as file:
            self.text = file.read()
        self.meta, self.arrays = None, {}
        for attributes, text in Elements(self.text).scripts:
            if attributes.get("id") == "ph-meta":
                assert self.meta is None and attributes["type"] == "application/json"
                assert "<" not in text
                self.meta = json.loads(text)
            elif attributes.get("type") == "application/x-ph-array":
                name = attributes["data-array"]
                assert name not in self.arrays, name
                self.arrays[name] = Array(attributes, text)

    def __getitem__(self, name):
        return self.arrays[name].values

    def __contains__(self, name):
        return name in self.arrays

    def bars(self, prefix="bars"):
        return list(zip(self[f"{prefix}/dim"], self[f"{prefix}/birth"], self[f"{prefix}/death"]))

    def leaf_labels(self, cut):
        """The segment of each leaf in a cut: 0 for none; segments are numbered from 1 by decreasing
        number of points."""
        rule = self.meta["tree"]["rule"]
        leaves = len(self["tree/leaf_birth"])
        parent = list(range(leaves))

        def find(i):
            while parent[i] != i:
                parent[i] = parent[parent[i]]
                i = parent[i]
            return i

        def join(a, b):
            a, b = find(a), find(b)
            parent[max(a, b)] = min(a, b)

        for a, b, level in zip(self["tree/merge_younger"], self["tree/merge_elder"],
                               self["tree/merge_level"]):
            if (level < cut if rule == "persistence" else level <= cut):
                join(a, b)
        planes = self.arrays["tree/leaf_on"].rows() if "tree/leaf_on" in self else [()] * leaves
        on = {}
        sizes = {}
        for leaf in range(leaves):
            if rule == "value" and self["tree/leaf_birth"][leaf] > cut:
                continue
            size = sizes.setdefault(find(leaf), [0, 0])
            size[0] += self["tree/leaf_points"][leaf]
            size[1] += self["tree/leaf_vertices"][leaf]
            on[find(leaf)] = [a + b for a, b in zip(on.get(find(leaf), [0] * len(planes[leaf])),
                                                    planes[leaf])]
        least = self.meta.get("scene", {}).get("flat", 2)
        kept = [r for r, size in sizes.items() if size[1] >= self.meta["tree"]["min_size"]
                and not any(n / size[1] >= least for n in on[r])]
        kept.sort(key=lambda r: (-sizes[r][0], -sizes[r][1], r))
        label = {root: i + 1 for i, root in enumerate(kept)}
        return [label.get(find(leaf), 0) for leaf in range(leaves)]

    def point_labels(self, cut, points):
        """The segment of each point of the input in a cut. @param points the number of points."""
        return self._of_points(self.leaf_labels(cut), points)

    def answer(self, points):
        """The segment and the surface of each point, as the program stored them."""
        numbers = [0] + [s["number"] for s in self.meta["scene"]["segments"]]
        labels = [numbers[label] for label in self["tree/leaf_label"]]
        surfaces = self._of_points(self["tree/leaf_surface"], points)
        index = self["points/index"] if "points/index" in self else range(points)
        removed = self["points/surface"] if "points/surface" in self else []
        for i, surface in zip(index, removed):
            assert surface == 0 or surfaces[i] == 0
            surfaces[i] += surface
        return self._of_points(labels, points), surfaces

    def _of_points(self, of_leaf, points):
        none = 2 ** 16 - 1 if self.arrays["points/leaf"].type == "u16" else NONE
        labels = [0] * points
        index = self["points/index"] if "points/index" in self else range(points)
        for i, leaf in zip(index, self["points/leaf"]):
            if leaf != none:
                labels[i] = of_leaf[leaf]
        return labels
