# SPDX-License-Identifier: MIT
"""Notebooks run without errors and warnings, and their numbers are right."""
import copy
import gc
import json
import os
import re
import sys
import warnings
from pathlib import Path

import pytest

import libph

for package in ("nbformat", "nbclient", "ipykernel", "matplotlib", "scipy", "sklearn", "pandas"):
    pytest.importorskip(package, reason=f"{package} is missing, which the notebooks need")
import nbclient  # noqa: E402
import nbformat  # noqa: E402
from jupyter_client.kernelspec import KernelSpecManager  # noqa: E402
from jupyter_client.manager import AsyncKernelManager  # noqa: E402

SOURCE = Path(os.environ.get("PH_SOURCE_DIR", Path(__file__).parents[2]))
FOLDER = SOURCE / "python/notebooks"

# Statements in the text of each notebook, and conditions that must hold in the kernel after the
# last cell.
FACTS = {
    "circle_and_torus": [
        ("These 60 points", "circle.shape == (60, 2)"),
        ("At *t* = 0.2 there are 16 components.", "bars.betti(0.2)[0] == 16"),
        ("At *t* = 0.6 there is one, and a loop.", "bars.betti(0.6).tolist() == [1, 1]"),
        ("At *t* = 1.8 triangles fill the loop.", "bars.betti(1.8).tolist() == [1, 0]"),
        ("Of the 3 bars of H1 one is long",
         "sorted(b.persistence > 0.1 for b in bars.filter(dim=1)) == [False, False, True]"),
        ("One bar of H0 never dies", "np.isinf(bars.dgm(0)[:, 1]).sum() == 1"),
        ("From 5000 random points", "len(points) == 5000"),
        ("picks 300 that", "len(torus) == 300"),
        ("2 dots of H1 and 1 of H2", "[(bars_of_torus.filter(dim=d).deaths"
         " - bars_of_torus.filter(dim=d).births > 0.7).sum() for d in (1, 2)] == [2, 1]"),
    ],
    "time_series": [
        ("repeats every 37.5 samples", "np.allclose(wave[:-75], wave[75:]) and"
         " not np.allclose(wave[:-25], wave[25:], atol=0.5)"),
        ("The noise below has the same values in random order",
         "np.array_equal(np.sort(noise), np.sort(signal))"),
        ("take 200 points", "len(sample) == bars_of_noise.meta['vertices'] == 200"),
        ("At all delays from 2 to 11 the bar of the signal is longer than any of the noise.",
         "of_signal[1:11].min() > of_noise.max()"),
        ("At 12 and 13 the loop is flat: 3 delays are about a period.",
         "of_signal[11:13].max() < of_noise.min()"),
        ("At 18 and 19 it is flat again: 2 delays are.", "of_signal[17:19].max() < of_noise.min()"),
        ("We take delay 6 and dimension 6.", "np.array_equal(points, embed(signal, 6, 6))"),
        ("picks the same 200 points as `subsample`",
         "ph.rips(points, subsample=200) == ph.rips(points[sample])"),
        ("The signal has 1 long bar of H1, the noise has none.",
         "(bars.filter(dim=1).deaths - bars.filter(dim=1).births > 0.8).sum() == 1 and"
         " of_noise[5] < 0.8"),
        ("The period comes out right to 0.1 %", "abs(period / 37.5 - 1) < 0.001"),
        ("all 25 turns", "int(len(points) / 37.5) == int(abs(phase[-1] - phase[0])) == 25"),
    ],
    "correlations": [
        ("30 measures of cell nuclei in 569 images", "table.shape == (569, 30)"),
        ("There are 10 properties.", "len({name.replace('mean ', '').replace('worst ', '')"
         ".replace(' error', '') for name in table.columns}) == 10"),
        ("1 − |r| may be longer than a way around",
         "any(distances.iloc[i, j] > distances.iloc[i, k] + distances.iloc[k, j]"
         " for i in range(9) for j in range(9) for k in range(9))"),
        ("the groups of more than one variable at *t* = 0.08, the dashed line",
         "np.array_equal(group, tree.components(0.08))"),
        ("Of the 3 groups, the largest has 6 variables: radius, perimeter and area",
         "len(groups) == 3 and sorted(max(groups, key=len)) == sorted(f'{statistic} {name}'"
         " for name in ('radius', 'perimeter', 'area') for statistic in ('mean', 'worst'))"),
        ("Its 4 variables are two properties, compactness and fractal dimension",
         "sorted(loop) == sorted(pattern.replace('*', name) for name in"
         " ('compactness', 'fractal dimension') for pattern in ('* error', 'worst *'))"),
        ("Those across share neither, and are at 0.40 and 0.47.",
         "sorted(round(distances.loc[loop[i], loop[i + 2]], 2) for i in (0, 1)) == [0.4, 0.47] and"
         " max(distances.loc[loop[i], loop[i - 1]] for i in range(4)) < 0.3"),
        ("Do so 99 times", "len(by_chance) == 99"),
        ("Of our 9 loops, 4 are longer than the longest of all shuffled tables.",
         "len(bars.filter(dim=1)) == 9 and sum(lengths > max(by_chance)) == 4"),
        ("would beat 99 others with a probability of 1 %", "1 / (len(by_chance) + 1) == 0.01"),
    ],
    "images": [
        ("Bars no longer than 60 grey values", "min(b.persistence for b in bars) > 60"),
        ("H0 are components: 3 of them", "len(bars.filter(dim=0)) == 3"),
        ("H1 are holes: 1, in the ring", "len(bars.filter(dim=1)) == 1"),
        ("The brightest never does, so its mask is the whole image.",
         "np.isinf(bars[0].death) and bars[0].birth == -int(blobs.max()) and bars.voxels(0).all()"),
        ("256 × 256 pixels", "head.shape == (256, 256)"),
        ("A little blur removes nearly half of all bars.",
         "0.45 < 1 - len(bars_of_head) / len(bars_of_noisy) < 0.5"),
        ("the brain has the longest bar (orange)",
         "bars_of_head.voxels(bars_of_head.longest(0, 2)[1])[[60, 90, 100], [120, 60, 160]].all()"),
        ("A muscle of the face that is as bright is in its mask.",
         "bars_of_head.voxels(bars_of_head.longest(0, 2)[1])[190, 85]"),
        ("a brain with 2 dark ventricles", "len(ventricles) == 2"),
        ("Nearly all bars are noise", "len(bars_of_volume) > 1000 * len(long)"),
        ("What is left are 2 components, the scalp and the brain; and 3 cavities",
         "[bar.dim for bar in long] == [0, 0, 2, 2, 2]"),
        ("the brightest voxels of the brain, which are there already",
         "volume[brain & ~long.voxels(2)].min() >= -long[2].birth > 70"),
        ("The brain is right to 1 %.", "(long.voxels(1) ^ tissue).sum() < 0.01 * tissue.sum()"),
        ("The ventricles are less than 10 % too large",
         "all(t < f < 1.1 * t for f, t in zip(found[1:], true[1:]))"),
    ],
    "mesh": [
        ("a grid of 60 × 30 vertices", "len(vertices) == 60 * 30 == len(triangles) / 2"),
        ("None of the 4 bars dies.", "len(bars) == 4 and np.isinf(bars.deaths).all()"),
        ("1 component, 2 loops and 1 hollow", "bars.dims.tolist() == [0, 1, 1, 2]"),
        ("The component begins at the bottom and the hollow at the top.",
         "bars[0].birth == height.min() and bars[3].birth == height.max()"),
        ("The loops begin at the lower and the upper end of the hole in the middle.",
         "np.allclose(bars.births[1:3], [-1, 1]) and np.isclose(distance.min(), 1)"),
        ("every 3 seconds of arc", "np.isclose(degrees * 3600, 3)"),
        ("We take 8000 random places", "len(metres) == 8000"),
        ("There is no gap between long and short ones",
         "(lambda x: max(x[:-1] / x[1:]) < 1.5)(np.sort(lengths[np.isfinite(lengths)])[:-20:-1])"),
        ("prominences above 180 metres. These are 7 peaks",
         "len(places) == 7 == (peaks.deaths - peaks.births > 180).sum()"),
        ("the highest never dies", "np.isinf(peaks[places[0]].death) and"
         " metres[summits[0]] == metres.max()"),
    ],
    "scene": [
        ("a point in space for each of 120 × 160 pixels", "scene.labels.shape == (120, 160)"),
        ("finds 2 objects", "len(scene.objects) == 2"),
        ("that of its object, or 0", "set(np.unique(scene.labels)) == {0, 1, 2}"),
        ("by default 1: the noise", "stack.meta['cut'] == 1"),
        ("The short bar here is 168 long.",
         "round(bars[0].persistence) == 168 == round(value) and np.isinf(bars[1].death)"),
        ("All others are shorter than 0.1", "len(bars) == 2"),
        ("a table 0.9 m away", "abs(np.median(depth) - 0.9) < 0.001"),
        ("Only the ring has one.", "[len(own.signature(k).filter(dim=1)) for k in (1, 2, 3)] =="
         " [1, 0, 0] and own.labels[from_ring < 0.02].min() == own.labels[from_ring < 0.02].max()"
         " == 1"),
        ("Its hole has a radius of 0.045 m",
         "abs(np.hypot(x - 0.2, y + 0.02)[ring > 0].min() - 0.045) < 0.002"),
        ("the answer is 0.04 m", "round(own.signature(1).filter(dim=1)[0].death, 3) == 0.04"),
        ("voxels are 0.005 m wide", "own.meta['voxel'] == 0.005"),
    ],
}
# Statements with numbers that need no check, because they are definitions.
DEFINITIONS = ["is 1 if one rises whenever", "−1 if it falls then, and near 0 if it does neither",
               "where two groups of variables join"]
NUMBER = re.compile(r"(?<![\w.])(?:\d+(?:[.]\d+)?|two|three|four|five|six|seven|eight|nine|ten)\b")


def read(name):
    return nbformat.read(FOLDER / f"{name}.ipynb", nbformat.NO_CONVERT)


def words_of(notebook):
    """The text of a notebook's Markdown cells, with single spaces between words."""
    text = " ".join(cell.source for cell in notebook.cells if cell.cell_type == "markdown")
    return re.sub(r"\s+", " ", text)


def execute(notebook, facts, folder, specs):
    """An executed copy of the notebook. Errors, warnings and wrong facts make the test fail."""
    done = copy.deepcopy(notebook)
    first = nbformat.v4.new_code_cell("import warnings\nwarnings.simplefilter('error')")
    checks = [nbformat.v4.new_code_cell(f"assert {fact}, {words!r}") for words, fact in facts]
    done.cells = [first, *done.cells, *checks]
    manager = AsyncKernelManager(kernel_name="this",
                                 kernel_spec_manager=KernelSpecManager(kernel_dirs=[str(specs)]))
    nbclient.NotebookClient(done, km=manager, timeout=120,
                            resources={"metadata": {"path": str(folder)}}).execute()
    return done


def outputs_of(notebook, kind):
    return [output for cell in notebook.cells if cell.cell_type == "code"
            for output in cell.outputs if kind in output.get("data", {})]


@pytest.fixture(scope="session")
def specs(tmp_path_factory):
    """The specification of a kernel that runs this Python, finds the same modules, and leaves no
    files behind."""
    folder = tmp_path_factory.mktemp("kernels")
    (folder / "this").mkdir()
    argv = [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"]
    places = [str(Path(libph.__file__).absolute().parents[1]), os.environ.get("PYTHONPATH", "")]
    (folder / "this/kernel.json").write_text(json.dumps(
        {"argv": argv, "display_name": "this", "language": "python",
         "env": {"PYTHONPATH": os.pathsep.join(filter(None, places)),
                 "IPYTHONDIR": str(folder), "PYDEVD_DISABLE_FILE_VALIDATION": "1"}}))
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("JUPYTER_RUNTIME_DIR", str(folder))
        patch.delenv("MPLBACKEND", raising=False)
        yield folder


@pytest.fixture(autouse=True)
def _sockets_that_are_left():
    """jupyter_client leaves sockets to the garbage collector, which warns about them."""
    yield
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ResourceWarning)
        gc.collect()


def test_each_notebook_has_facts():
    assert sorted(FACTS) == sorted(path.stem for path in FOLDER.glob("*.ipynb"))


@pytest.mark.parametrize("name", FACTS)
def test_notebooks_are_small(name):
    notebook = read(name)
    nbformat.validate(notebook)
    assert (notebook.nbformat, notebook.nbformat_minor) == (4, 5)
    assert set(notebook.metadata) == {"kernelspec", "language_info", "license"}
    assert re.fullmatch(r"# [^\n]+\n\n[^\n].*\.", notebook.cells[0].source, re.S)
    assert 8 <= len(notebook.cells) <= 15
    assert (FOLDER / f"{name}.ipynb").stat().st_size < 10_000
    for cell in notebook.cells:
        assert cell.source.strip() and max(map(len, cell.source.split("\n"))) <= 100
        assert cell.metadata in ({}, {"tags": ["report"]})
        if cell.cell_type == "code":
            assert cell.outputs == [] and cell.execution_count is None


@pytest.mark.parametrize("name", FACTS)
def test_each_number_of_the_text_is_a_fact(name):
    words = words_of(read(name))
    for phrase, _ in FACTS[name]:
        assert phrase in words, phrase
    for phrase in [*(phrase for phrase, _ in FACTS[name]), *DEFINITIONS]:
        words = words.replace(phrase, "")
    plain = re.sub(r"`[^`]*`|\[[A-Z][^]]*\d{4}\]|dimension \d|\d-D", "", words)
    assert NUMBER.findall(plain) == []


@pytest.mark.parametrize("name", FACTS)
def test_notebooks_run_and_tell_the_truth(name, specs):
    notebook = read(name)
    reports = [cell for cell in notebook.cells if "tags" in cell.metadata]
    if not libph._core.has_page():
        notebook.cells = [cell for cell in notebook.cells if cell not in reports]
    done = execute(notebook, FACTS[name], FOLDER, specs)
    told = [output.text for cell in done.cells if cell.cell_type == "code"
            for output in cell.outputs if output.get("name") == "stderr"]
    assert told == []
    assert len(outputs_of(done, "image/png")) >= 2
    if reports and not libph._core.has_page():
        pytest.skip("all but the report was tested: this libph was built without npm")
    frames = [output for output in outputs_of(done, "text/html")
              if output.data["text/html"].startswith("<iframe")]
    assert len(frames) == len(reports)


@pytest.mark.parametrize("name", ["images", "scene"])
def test_data_are_found_from_the_root_too(name, specs):
    notebook = read(name)
    (line,) = [line for cell in notebook.cells for line in cell.source.split("\n")
               if line.startswith("data =")]
    source = f"from pathlib import Path\n{line}\nassert (data / 'table.pcd').exists()"
    notebook.cells = [nbformat.v4.new_code_cell(source)]
    execute(notebook, [], SOURCE, specs)


@pytest.mark.parametrize("source, facts, message", [
    ("import warnings; warnings.warn('loud')", [], "UserWarning: loud"),
    ("1 / 0", [], "ZeroDivisionError"),
    ("n = 2", [("there are 3", "n == 3")], "there are 3")])
def test_what_is_wrong_is_found(source, facts, message, tmp_path, specs):
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(source)])
    with pytest.raises(nbclient.exceptions.CellExecutionError, match=message):
        execute(notebook, facts, tmp_path, specs)
