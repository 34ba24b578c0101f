# SPDX-License-Identifier: MIT
"""Tests the pictures of barcodes that matplotlib draws."""
import numpy as np
import pytest

import libph as ph

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("agg")
pyplot = pytest.importorskip("matplotlib.pyplot")

ANGLES = np.linspace(0, 2 * np.pi, 20, endpoint=False)
CIRCLE = np.column_stack([np.cos(ANGLES), np.sin(ANGLES)])
VOLUME = np.random.default_rng(0).integers(0, 99, size=(6, 7, 5))


def vertices(births):
    return ph.filtered([(k,) for k in range(len(births))], births)


def path(births, joins):
    """A path of vertices, each joined to the next."""
    n = len(births)
    return ph.filtered([(k,) for k in range(n)] + [(k, k + 1) for k in range(n - 1)],
                       [*births, *joins])


BARCODES = {
    "points": ph.rips(CIRCLE),
    "image": ph.cubical(VOLUME, superlevel=True),
    "zero length": ph.rips(CIRCLE, min_persistence=-1),
    "no bars": ph.rips([]),
    "all are born early": vertices(range(40)),
    "all are born late": path([0, *[50] * 19], range(51, 70)),
    "two long bars": path([0, 0, 0], [0, 9]),
    "long bars all over": vertices(np.zeros(20)),
    "some never begin": vertices([-np.inf, 0, 1]),
}
each = pytest.mark.parametrize("bars", [pytest.param(bars, id=name)
                                        for name, bars in BARCODES.items()])


@each
@pytest.mark.parametrize("kind", ["diagram", "barcode", "betti"])
def test_plots_leave_settings_alone(bars, kind):
    from matplotlib.figure import Figure
    before = dict(matplotlib.rcParams)
    ax = Figure().add_subplot()
    assert bars.plot(kind, ax=ax) is ax
    ax.figure.savefig("/dev/null", format="svg")
    assert dict(matplotlib.rcParams) == before


@pytest.mark.parametrize("kind", ["diagram", "barcode", "betti"])
def test_plot_of_one_dimension(kind):
    from matplotlib.figure import Figure
    bars = ph.rips(CIRCLE)
    for dim, labels in ((1, ["H1"]), ([0, 1], ["H0", "H1"]), (None, ["H0", "H1"])):
        ax = bars.plot(kind, ax=Figure().add_subplot(), dims=dim)
        assert [text.get_text() for text in ax.get_legend().get_texts()] == labels
    for wrong in ("1", [0, -1]):
        with pytest.raises(ph.UsageError, match="dims: found '?-?1'?, expected a whole number"):
            bars.plot(kind, dims=wrong)
    for wrong in ([5], [0, 2]):
        with pytest.raises(ph.UsageError, match=r"dims: found \[.*\], expected dimensions of these bars, 0 to 1"):
            bars.plot(kind, dims=wrong)
    with pytest.raises(ph.UsageError, match="dims: found 0, expected 1, the only dimension"):
        ph.rips(CIRCLE, min_dim=1).plot(kind, dims=0)
    bars.filter(dim=0).plot(kind, ax=Figure().add_subplot(), dims=1)  # H1 was computed
    with pytest.raises(ph.UsageError, match="dim: .*did you mean 'dims'"):
        bars.plot(kind, ax=Figure().add_subplot(), dim=1)


def test_plot_makes_a_figure_of_its_own():
    ax = ph.rips(CIRCLE).plot(color="k", s=3)
    assert ax.figure.number in pyplot.get_fignums()
    pyplot.close(ax.figure)
    with pytest.raises(ph.UsageError, match="kind"):
        ph.rips(CIRCLE).plot("tree")


@pytest.mark.parametrize("name", ["points", "all are born early", "all are born late",
                                  "two long bars", "long bars all over"])
def test_the_legend_of_a_barcode_hides_no_bar(name):
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    figure = Figure(figsize=(5, 4))
    canvas, ax = FigureCanvasAgg(figure), BARCODES[name].plot("barcode", ax=figure.add_subplot())
    canvas.draw()
    box = ax.get_legend().get_window_extent()
    paths = [line.transformed(lines.get_transform())
             for lines in ax.collections for line in lines.get_paths()]
    assert len(paths) == len(BARCODES[name])
    assert not any(line.intersects_bbox(box, filled=False) for line in paths)


def test_infinite_ends_lie_outside():
    from matplotlib.figure import Figure
    bars = ph.cubical(np.array([[-np.inf, 3.0, -np.inf, 1.0], [2, 5, 4, 0]]))
    assert bars.dgm(0)[:, 0].tolist().count(-np.inf) == 2
    ax = bars.plot(ax=Figure().add_subplot())
    places = np.sort(ax.collections[0].get_offsets(), axis=0)
    left, right = ax.get_xlim()
    assert len(places) == 3 and left < places[0, 0] == places[1, 0] < 0 == places[2, 0] < right
    ax = bars.plot("barcode", ax=Figure().add_subplot())
    ends = np.array([segment[:, 0] for segment in ax.collections[0].get_segments()])
    assert sorted(ends[:, 0] < 0) == [False, True, True] and (ends[:, 1] > 3).sum() == 1
    early = ph.cubical(np.array([[-np.inf, -np.inf, 2.0, 1.0]]), min_persistence=-1)
    assert (early.deaths == -np.inf).any()
    ax = early.plot("barcode", ax=Figure().add_subplot())
    ends = np.array([segment[:, 0] for segment in ax.collections[0].get_segments()])
    assert ends[early.deaths == -np.inf].max() < 1
