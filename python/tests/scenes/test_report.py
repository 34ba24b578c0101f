# SPDX-License-Identifier: MIT
"""Tests that reports from Python equal the pages that --report writes, except for the stated
origin, and that notebooks show reports in an iframe."""
import html.parser
import json
import os
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.distance import pdist, squareform

import libph as ph
from libph import _core, _report
from scenes import CAMERA, TABLE, depth_of_scene, points_of_scene

needs_page = pytest.mark.skipif(not _core.has_page(), reason="built without the page of reports")
META = re.compile(r'<script type="application/json" id="ph-meta">(.*?)</script>', re.S)


def parts(page):
    """The metadata of a page, and the rest of the page."""
    meta = json.loads(META.search(page)[1])
    return meta, META.sub("", page, count=1)


def differing(mine, its):
    """The lines that differ, each cut to its beginning, which identifies the line."""
    mine, its = mine.split("\n"), its.split("\n")
    return [(a[:120], b[:120]) for a, b in zip(mine, its) if a != b] + [len(mine)] * (
        len(mine) != len(its))


def check(report, written):
    """Checks that the pages differ only in version, command line, file, times, memory and notes."""
    (mine, my_rest), (its, its_rest) = parts(report.html), parts(written)
    assert differing(my_rest, its_rest) == []
    origin, other = mine.pop("provenance"), its.pop("provenance")
    assert mine.pop("program").startswith("libph ") and its.pop("program").startswith("ph-")
    assert mine == its
    for name in ("complex", "field", "max_dim", "threshold", "engine"):
        assert origin.get(name) == other.get(name), name
    return origin, other


@pytest.fixture
def barcode_page(program, tmp_path):
    """A function that returns the page that ph-barcode writes for an array or a text."""
    def page(data, name, *arguments):
        path = tmp_path / name
        if isinstance(data, np.ndarray):
            np.save(path, data)
        else:
            path.write_text(data)
        done = subprocess.run([program, path, "--output-format", "none", "--report",
                               tmp_path / "out.html", *map(str, arguments)],
                              capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return (tmp_path / "out.html").read_text()
    return page


# Adding 0.0 turns -0 into 0, as the file readers do.
POINTS = np.random.default_rng(3).normal(size=(50, 2)).round(2) + 0.0
SOLID = np.random.default_rng(4).normal(size=(40, 5))


@needs_page
@pytest.mark.parametrize("points, options, arguments", [
    (POINTS, {}, []), (POINTS, {"max_dim": 2, "representatives": "cycles"},
                       ["--max-dim", 2, "--representatives", "cycles"]),
    (POINTS, {"representatives": "cocycles", "field": 3},
     ["--representatives", "cocycles", "--field", 3]),
    (POINTS, {"max_dim": 0}, ["--max-dim", 0]), (SOLID, {}, []), (SOLID[:, :3], {}, []),
    (np.asfortranarray(SOLID), {"metric": "manhattan"}, ["--metric", "manhattan"]),
    (POINTS, {"metric": "minkowski", "minkowski_p": 3}, ["--metric", "minkowski:3"]),
    (POINTS, {"threshold": 0.7}, ["--threshold", 0.7]),
    (POINTS, {"weights": "dtm", "dtm_neighbors": 4}, ["--dtm", 4]),
    (POINTS, {"weights": "core", "core_neighbors": 4}, ["--core", 4]),
    (POINTS, {"weights": "dtm", "dtm_neighbors": 3, "weight_exponent": 2},
     ["--dtm", 3, "--weight-exponent", 2]),
    (POINTS, {"subsample": 20}, ["--subsample", 20]),
    (POINTS, {"approximation": 1.0}, ["--approximate", 1.0]),
    (np.repeat(POINTS[:9], 3, axis=0), {}, []),
    (POINTS, {"min_persistence": -1}, ["--min-persistence", -1]),
    (POINTS, {"min_dim": 1}, ["--min-dim", 1]),
], ids=lambda x: str(getattr(x, "shape", x)))
def test_pages_of_points(barcode_page, points, options, arguments):
    written = barcode_page(points, "points.npy", "--format", "npy", *arguments)
    check(ph.report(points, complex="rips", title="points.npy", **options), written)
    bars = ph.rips(points, **options)
    origin, _ = check(bars.report(points, title="points.npy"), written) \
        if options.get("min_persistence", 0) >= 0 else ({}, {})
    if options.get("weights"):
        kind = options["weights"]
        exponent = options.get("weight_exponent", 1 if kind == "dtm" else "inf")
        assert origin["notes"]["Vertices enter late"] == \
            f"{kind} {options[f'{kind}_neighbors']}, exponent {exponent}"
    if "approximation" in options:
        assert "epsilon 1" in origin["notes"]["Approximation"]


@needs_page
def test_pages_of_points_that_are_left_out(barcode_page):
    rng = np.random.default_rng(5)
    points = POINTS.copy()
    points[rng.integers(50, size=5), 0] = np.nan
    text = "\n".join(",".join(map(str, row)) for row in points)
    written = barcode_page(text, "points.csv", "--format", "points", "--nan", "drop")
    check(ph.rips(points, nan="drop").report(points, title="points.csv"), written)


@needs_page
def test_pages_of_distances(barcode_page):
    square = squareform(pdist(SOLID))
    written = barcode_page(square, "d.npy", "--format", "distance")
    bars = ph.rips(square, metric="precomputed")
    check(bars.report(square, title="d.npy"), written)
    check(bars.report(pdist(SOLID), title="d.npy"), written)
    np.fill_diagonal(square, np.linspace(0, 1, len(square)))
    written = barcode_page(square, "d.npy", "--format", "distance", "--diagonal", "births")
    check(ph.rips(square, metric="precomputed", diagonal="births").report(square, title="d.npy"),
          written)
    square[3, 4] += 1
    written = barcode_page(square, "d.npy", "--format", "distance", "--symmetrise", "max",
                           "--diagonal", "zero")
    bars = ph.rips(square, metric="precomputed", diagonal="any", symmetrise="max")
    check(bars.report(square, title="d.npy"), written)


IMAGE = np.random.default_rng(6).normal(size=(12, 15)).round(1) + 0.0
VOLUME = np.random.default_rng(7).integers(0, 99, size=(7, 8, 9)).astype(np.uint8)


@needs_page
@pytest.mark.parametrize("image, options, arguments", [
    (IMAGE, {}, []), (IMAGE, {"superlevel": True}, ["--superlevel"]),
    (IMAGE, {"construction": "cells"}, ["--construction", "cells"]),
    (IMAGE, {"periodic": [0]}, ["--periodic", 0]), (IMAGE, {"threshold": 0.5}, ["--threshold", 0.5]),
    (VOLUME, {"representatives": "voxels"}, ["--representatives", "voxels"]),
    (VOLUME, {"representatives": "cycles"}, ["--representatives", "cycles"]),
    (VOLUME[:, :2].reshape(7, 2, 9, 1), {}, []),
], ids=lambda x: str(getattr(x, "shape", x)))
def test_pages_of_images(barcode_page, image, options, arguments):
    written = barcode_page(image, "image.npy", "--complex", "cubical", *arguments)
    bars = ph.cubical(image, **options)
    check(bars.report(image, title="image.npy"), written)
    check(ph.report(image, complex="cubical", title="image.npy", **options), written)


@needs_page
def test_pages_of_images_of_points(barcode_page):
    points = SOLID[:, :3]
    written = barcode_page(points, "p.npy", "--format", "npy", "--complex", "cubical",
                           "--voxel", 0.5)
    image = ph.point_image(points, 0.5)
    check(ph.cubical(image).report(image, title="p.npy"), written)
    check(ph.report(image, title="p.npy"), written)


@needs_page
def test_pages_of_listed_complexes(barcode_page, tmp_path):
    mesh = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 0 2 3\n3 1 2 3\n"
    (tmp_path / "values.txt").write_text("0\n3\n1\n2\n")
    written = barcode_page(mesh, "m.off", "--values", tmp_path / "values.txt")
    data = ph.read(tmp_path / "m.off", values=tmp_path / "values.txt")
    check(ph.report(data, title="m.off"), written)
    bars = ph.lower_star(data.values, data.triangles)
    check(bars.report(data, title="m.off"), written)
    with pytest.raises(ph.UsageError, match="expected a Mesh"):
        bars.report(data.vertices)
    simplices = "0 : 0\n1 : 0.5\n2 : 1\n0 1 : 2\n1 2 : 2\n0 2 : 3\n0 1 2 : 4\n"
    written = barcode_page(simplices, "s.txt", "--format", "simplices")
    data = ph.read(tmp_path / "s.txt", format="simplices")
    check(ph.report(data, title="s.txt"), written)
    check(ph.filtered(*data).report(data, title="s.txt"), written)


@needs_page
def test_pages_of_bars_alone(program, tmp_path):
    bars = ph.rips(POINTS)
    bars.save(tmp_path / "bars.json")
    done = subprocess.run([program, tmp_path / "bars.json", "--output-format", "none", "--report",
                           tmp_path / "out.html"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    for own in (bars, ph.read_barcode(tmp_path / "bars.json")):
        meta, rest = parts(own.report(title="bars.json").html)
        expected, expected_rest = parts((tmp_path / "out.html").read_text())
        assert differing(rest, expected_rest) == []
        for page in (meta, expected):
            del page["provenance"], page["program"]
        assert meta == expected
    # A barcode that was read from a file can also be reported with its data, because the file
    # states how the barcode was computed.
    weighted = ph.rips(POINTS, metric="manhattan")
    weighted.save(tmp_path / "bars.json")
    read = ph.read_barcode(tmp_path / "bars.json")
    for options in ({}, {"metric": "manhattan"}):
        assert parts(read.report(POINTS, title="x", **options).html)[1] == \
            parts(weighted.report(POINTS, title="x").html)[1]
    with pytest.raises(ph.DataError, match="merge tree has no class"):
        read.report(POINTS, metric="euclidean")


@needs_page
@pytest.mark.filterwarnings("ignore::UserWarning")
def test_pages_of_scenes(tmp_path, rng):
    program = os.environ.get("PH_SEGMENT", "")
    if not os.access(program, os.X_OK):
        pytest.skip("PH_SEGMENT names no program")
    depth, points = depth_of_scene(rng), points_of_scene(rng)
    np.save(tmp_path / "depth.npy", depth)
    np.save(tmp_path / "points.npy", points)
    camera = ["--intrinsics", ",".join(map(str, CAMERA))]
    for found, arguments in (
            (ph.segment(TABLE), [TABLE]),
            (ph.segment(TABLE, method="paper"), [TABLE, "--method", "paper"]),
            (ph.segment(points), [tmp_path / "points.npy"]),
            (ph.segment(points, supervoxels=0.05), [tmp_path / "points.npy", "--supervoxels", "0.05"]),
            (ph.segment(points).cut(0.1), [tmp_path / "points.npy", "--cut", "0.1"]),
            (ph.segment(depth, intrinsics=CAMERA), [tmp_path / "depth.npy", *camera])):
        done = subprocess.run([program, *map(str, arguments), "--report", tmp_path / "out.html"],
                              capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        (mine, my_rest), (its, its_rest) = (
            parts(found.report(title=Path(arguments[0]).name).html),
            parts((tmp_path / "out.html").read_text()))
        assert differing(my_rest, its_rest) == []
        assert its["tree"].pop("command")[0] == "ph-segment" and "command" not in mine["tree"]
        origin, other = mine.pop("provenance"), its.pop("provenance")
        assert origin["notes"] == other["notes"]
        assert origin["input"]["description"] == other["input"]["description"]
        del mine["program"], its["program"]
        assert mine == its


# ---- use of the page


@needs_page
def test_titles_and_repr():
    bars = ph.rips(POINTS)
    assert re.fullmatch(r"Report\('rips of 50 points in R\^2', \d\.\d MB\)", repr(bars.report()))
    assert bars.report(POINTS).title == "rips of 50 points in R^2"
    assert ph.report(VOLUME).title == "cubical of 7 x 8 x 9"
    assert ph.segment(TABLE).report().title == "table.pcd"
    assert ph.rips(np.empty((0, 2))).report(np.empty((0, 2))).title == "rips of 0 points in R^2"
    origin = parts(bars.report(POINTS).html)[0]["provenance"]
    assert origin["version"] == f"libph {ph.__version__}" and origin["engine"] == "edge-links"
    assert origin["input"] == {"description": "50 points in R^2"} and "command" not in origin


@needs_page
def test_save(tmp_path):
    report = ph.rips(POINTS).report(POINTS)
    report.save(tmp_path / "page.html")
    assert (tmp_path / "page.html").read_bytes() == report.html.encode()
    with pytest.raises(ph.OutputError):
        report.save(tmp_path / "no" / "page.html")
    with pytest.raises(TypeError):
        ph.Report()


class Frames(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.tags = []

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))


@needs_page
def test_a_frame_of_a_notebook():
    report = ph.rips(POINTS).report(POINTS, title='A & B "quoted" </script> <i>')
    frames = Frames()
    frames.feed(report._repr_html_())
    ((tag, attributes),) = frames.tags
    assert tag == "iframe" and attributes["srcdoc"] == report.html
    assert attributes["title"] == report.title
    # The page may run its own script and offer files; it has no access to the notebook.
    assert attributes["sandbox"].split() == ["allow-scripts", "allow-downloads"]
    assert parts(report.html)[0]["title"] == report.title


@needs_page
@pytest.mark.parametrize("act, error, words", [
    (lambda: ph.rips(POINTS).report(POINTS[:-1]), ph.DataError, "X: found 49 points, expected 50"),
    (lambda: ph.cubical(IMAGE).report(IMAGE.T), ph.DataError, r"X: found \(15, 12\), expected"),
    (lambda: ph.rips(POINTS).report(POINTS * 2), ph.DataError, "merge tree has no class"),
    (lambda: ph.cubical(IMAGE).report(IMAGE + 1), ph.DataError, "merge tree has no class"),
    (lambda: ph.rips(POINTS).report(metric="l1"), ph.UsageError, "metric: does nothing without X"),
    (lambda: ph.rips(POINTS, metric=lambda a, b: abs(a - b).sum()).report(POINTS), ph.UsageError,
     "metric: found none"),
    (lambda: ph.rips(POINTS, weights=np.ones(50)).report(POINTS), ph.UsageError,
     "weights: found none"),
    (lambda: ph.report(POINTS, colour=1), TypeError, "colour"),
    (lambda: ph.report(ph.Simplices([(0,)], np.zeros(1)), complex="rips"), ph.UsageError,
     "complex: found 'rips'"),
    (lambda: ph.report(None), ph.UsageError, "X: found NoneType"),
], ids=range(10))
def test_what_is_wrong_is_said(act, error, words):
    with pytest.raises(error, match=words):
        act()


@needs_page
def test_what_only_the_user_knows_can_be_given():
    weights = np.linspace(0, 1, 50)
    bars = ph.rips(POINTS, weights=weights)
    page = bars.report(POINTS, weights=weights, title="x")
    assert parts(page.html)[1] == parts(ph.report(POINTS, weights=weights, title="x").html)[1]


@needs_page
def test_limits():
    image = np.zeros((300, 300, 30))
    with pytest.raises(ph.MemoryLimitError):
        ph.report(np.random.default_rng(0).normal(size=image.shape), memory_limit="20MB")
    with pytest.raises(ph.Timeout):
        ph.report(np.random.default_rng(0).normal(size=(8000, 5)), timeout=0.05)


def test_without_npm(monkeypatch):
    monkeypatch.setattr(_report._core, "has_page", lambda: False)
    for act in (lambda: ph.report(POINTS), lambda: ph.rips(POINTS).report(),
                lambda: ph.segment(TABLE).report()):
        with pytest.raises(ph.NotBuiltIn, match="Install Node.js with npm .*pip install") as caught:
            act()
        assert isinstance(caught.value, NotImplementedError)
