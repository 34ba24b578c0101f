# SPDX-License-Identifier: MIT
"""Compares vectors of lists of diagrams, in all layouts, with plain loops."""
import numpy as np
import pytest

import libph as ph
from samples import of_class

pytest.importorskip("sklearn", reason="scikit-learn is missing: nothing of libph.sklearn is tested")
from sklearn.base import clone  # noqa: E402

from libph.sklearn import (Atol, BettiCurve, Entropy, EulerCurve, Landscape, Lengths,  # noqa: E402
                           LifeEntropy, PersistenceImage, RipsPersistence, Silhouette, Statistics)

OF_DIAGRAMS = [PersistenceImage, Landscape, BettiCurve, Entropy, Lengths, Statistics, Silhouette,
               LifeEntropy, Atol]


def expected_columns(kind, dgm, all_of_it):
    """The columns with the parameters below, computed by the functions that test_vectors.py
    checks."""
    from libph._vectors import _functions
    values = np.concatenate(all_of_it)
    grid = (values.min(), values.max()), 6
    of_curves = {Landscape: lambda: _functions.landscape(dgm, 2, *grid).ravel(),
                 BettiCurve: lambda: _functions.betti_curve(dgm, *grid),
                 Silhouette: lambda: _functions.silhouette(dgm, 1, *grid),
                 LifeEntropy: lambda: _functions.life_entropy(dgm, *grid)}
    if kind in of_curves:
        return of_curves[kind]()
    if kind is Entropy:
        return [_functions.entropy(dgm)]
    if kind is Lengths:
        return _functions.longest(dgm, 3)
    if kind is Statistics:
        return _functions.statistics(dgm)
    if kind is Atol:
        return _functions.atol(dgm, *_functions.fit_atol(all_of_it, 3, 0), "laplace")
    births = values[:, 0].min(), values[:, 0].max()
    lengths = 0, (values[:, 1] - values[:, 0]).max()
    if births[0] == births[1]:
        births = births[0] - lengths[1] / 2, births[0] + lengths[1] / 2
    bandwidth = max(births[1] - births[0], lengths[1]) / 20
    return _functions.image(dgm, bandwidth, (3, 2), births, lengths, 1).ravel()


SMALL = {PersistenceImage: PersistenceImage(resolution=(3, 2)),
         Landscape: Landscape(layers=2, resolution=6), BettiCurve: BettiCurve(resolution=6),
         Entropy: Entropy(), Lengths: Lengths(count=3), Statistics: Statistics(),
         Silhouette: Silhouette(resolution=6), LifeEntropy: LifeEntropy(resolution=6),
         Atol: Atol(centres=3)}


@pytest.mark.parametrize("kind", OF_DIAGRAMS, ids=of_class)
def test_ranges_are_those_of_the_samples_that_were_fitted(kind, dgms):
    fitted = clone(SMALL[kind]).fit(dgms[:3])
    found = fitted.transform(dgms)  # these include a sample that the estimator was not fitted to
    for i, row in enumerate(dgms):
        expected = np.concatenate([
            expected_columns(kind, dgm, [other[j] for other in dgms[:3]])
            for j, dgm in enumerate(row)])
        assert np.array_equal(found[i], expected)
    assert found.dtype == np.float64 and found.shape[1] == len(fitted.get_feature_names_out())


@pytest.mark.parametrize("kind", OF_DIAGRAMS, ids=of_class)
def test_layouts(kind, clouds, dgms):
    """Lists, arrays of lists, barcodes, padded arrays and tables can hold the same diagrams."""
    expected = clone(SMALL[kind]).fit_transform(dgms)
    objects = np.empty((len(dgms), 2), dtype=object)
    for i, row in enumerate(dgms):
        objects[i, 0], objects[i, 1] = row
    giotto = RipsPersistence(output="giotto", reduced=True).fit_transform(clouds)
    table = RipsPersistence(reduced=True).set_output(transform="pandas").fit_transform(clouds)
    for other in (list(objects), objects, giotto, table, [tuple(row) for row in dgms]):
        assert np.array_equal(clone(SMALL[kind]).fit_transform(other), expected)
    if kind is PersistenceImage:  # images with weight 1 would count bars of length 0
        flat = PersistenceImage(weight_power=0, resolution=2)
        assert np.array_equal(flat.fit_transform(giotto), flat.fit_transform(dgms))
    bars = RipsPersistence(output="barcode").fit_transform(clouds)
    dropped = clone(SMALL[kind]).set_params(infinity="drop").fit(bars)
    assert np.array_equal(dropped.transform(bars), expected)
    single = clone(SMALL[kind]).fit_transform([row[1] for row in dgms])
    assert np.array_equal(single, expected[:, expected.shape[1] // 2:])
    as_lists = clone(SMALL[kind]).fit_transform([row[1].tolist() for row in dgms])
    assert np.array_equal(as_lists, single)


def test_names(clouds, dgms):
    assert Lengths(count=2).fit(dgms).get_feature_names_out().tolist() == [
        "dgm0_length0", "dgm0_length1", "dgm1_length0", "dgm1_length1"]
    bars = RipsPersistence(output="barcode").fit_transform(clouds)
    assert Entropy(infinity="drop").fit(bars).get_feature_names_out().tolist() == [
        "H0_entropy", "H1_entropy"]
    giotto = RipsPersistence((1,), output="giotto").fit_transform(clouds)
    assert BettiCurve(resolution=2).fit(giotto).get_feature_names_out().tolist() == [
        "H1_betti0", "H1_betti1"]
    image = PersistenceImage(resolution=(2, 1)).fit(dgms)
    assert image.get_feature_names_out(["a", "b"]).tolist() == [
        "a_p0_b0", "a_p0_b1", "b_p0_b0", "b_p0_b1"]
    landscape = Landscape(layers=2, resolution=1).fit(dgms)
    assert landscape.get_feature_names_out()[:2].tolist() == ["dgm0_layer0_0", "dgm0_layer1_0"]
    assert Statistics().fit(dgms).get_feature_names_out()[[0, 37, 38]].tolist() == [
        "dgm0_birth_mean", "dgm0_entropy", "dgm1_birth_mean"]
    assert Atol(centres=2).fit(dgms).get_feature_names_out()[1] == "dgm0_atol1"
    assert Silhouette().fit(dgms).get_feature_names_out()[99] == "dgm0_silhouette99"
    assert LifeEntropy().fit(dgms).get_feature_names_out()[99] == "dgm0_life99"
    with pytest.raises(ph.UsageError, match="input_features: found 1 names, expected 2"):
        landscape.get_feature_names_out(["a"])


@pytest.mark.parametrize("orientation", ["ascending", "descending", "births"])
def test_a_name_is_that_of_its_number(orientation):
    """The column of the pixel with the highest persistence and the largest birth has the
    corresponding name."""
    image = PersistenceImage(resolution=(2, 3), bandwidth=1e-3, birth_range=(0, 2),
                             persistence_range=(0, 3), orientation=orientation)
    (row,) = image.fit_transform([[[1.5, 4.0]]])
    assert image.get_feature_names_out()[np.argmax(row)] == "dgm0_p2_b1"


def test_bars_that_never_die_are_never_dropped_in_silence(clouds):
    dgms = RipsPersistence().fit_transform(clouds)
    for kind in (PersistenceImage, Entropy, Lengths, Statistics, Silhouette, LifeEntropy, Atol):
        small = SMALL[kind]
        with pytest.raises(ph.UsageError, match="sample 0, dgm0: row 11: found a bar that never"):
            clone(small).fit(dgms)
        capped, dropped = (clone(small).set_params(infinity=rule).fit_transform(dgms)
                           for rule in (5.0, "drop"))
        assert not np.array_equal(capped, dropped)
    curve = BettiCurve(resolution=3, range=(0, 100)).fit_transform(dgms)
    assert curve[:, 2].tolist() == [1] * 4
    assert Lengths(count=1, infinity=5.0).fit_transform(dgms)[:, 0].tolist() == [5] * 4


def test_ranges_that_are_given(dgms):
    both = Landscape(range=(0, 2)).fit(dgms)
    assert both.ranges_ == [(0, 2)] * 2 and both.grids_[0][-1] == 2
    each = BettiCurve(range=[(0, 2), None]).fit(dgms)
    h1 = np.concatenate([row[1] for row in dgms])
    assert each.ranges_ == [(0, 2), (h1.min(), h1.max())]
    image = PersistenceImage(birth_range=(0, 1), persistence_range=[None, (0, 3)]).fit(dgms)
    assert image.birth_ranges_ == [(0, 1)] * 2 and image.persistence_ranges_[1] == (0, 3)
    assert image.bandwidths_[1] == pytest.approx(3 / 20)
    with pytest.raises(ph.UsageError, match="range: found 3 ranges, expected 2"):
        Landscape(range=[None] * 3).fit(dgms)
    with pytest.raises(ph.UsageError, match=r"range: found \(1, 0\)"):
        Landscape(range=(1, 0)).fit(dgms)


def test_fitted_grids_are_used_again(dgms):
    """The ranges fitted to one batch are stored as text and given to another transformer."""
    import json
    for kind in (Landscape, BettiCurve, Silhouette, LifeEntropy):
        fitted = kind(resolution=7).fit(dgms[:2])
        again = kind(resolution=7, range=json.loads(json.dumps(fitted.ranges_))).fit(dgms[2:])
        assert np.array_equal(again.transform(dgms), fitted.transform(dgms))
        assert again.ranges_ == fitted.ranges_
    image = PersistenceImage(resolution=4, bandwidth=0.1).fit(dgms[:2])
    again = PersistenceImage(resolution=4, bandwidth=0.1, birth_range=image.birth_ranges_,
                             persistence_range=image.persistence_ranges_).fit(dgms[2:])
    assert np.array_equal(again.transform(dgms), image.transform(dgms))


def test_centres_need_so_many_places(dgms):
    with pytest.raises(ph.DataError, match="dgm0: distinct bars: found 6., expected at least 1000"):
        Atol(centres=1000).fit(dgms)


# ---- Euler curves of images


def test_euler_curves(rng):
    images = [rng.integers(0, 9, shape) for shape in ((5, 6), (4, 4), (3, 3, 4))]
    fitted = EulerCurve(resolution=9).fit(images)
    low, high = min(image.min() for image in images), max(image.max() for image in images)
    assert fitted.range_ == (low, high) and np.array_equal(fitted.grid_, np.linspace(low, high, 9))
    for row, image in zip(fitted.transform(images), images):
        assert row.tolist() == [ph.cubical(image).euler_curve()(t) for t in fitted.grid_]
    assert EulerCurve(superlevel=True).fit(images).range_ == (-high, -low)
    assert EulerCurve(threshold=high - 2).fit(images).range_ == (low, high - 2)
    again = EulerCurve(resolution=9, range=fitted.range_, n_jobs=2).fit(images[:1])
    assert np.array_equal(again.transform(images), fitted.transform(images))
    assert fitted.get_feature_names_out()[[0, 8]].tolist() == ["euler0", "euler8"]
    holes = np.where(rng.random((5, 5)) < 0.2, np.nan, 1.0)
    assert EulerCurve(nan="drop").fit([holes, 3 * holes]).range_ == (1, 3)
    with pytest.raises(ph.DataError, match="sample 1: image: row 0, column 0: found nan"):
        fitted.transform([images[0], [[np.nan]]])
    with pytest.raises(ph.UsageError, match="expected a list of images"):
        EulerCurve().fit(np.zeros(5))


@pytest.mark.parametrize("X, words", [
    (5, "found int"), ("ab", "found str"), (np.ones((3, 2)), r"found an array of shape \(3, 2\)"),
    ([], "found no samples"), ([[]], "found samples without diagrams"),
    ([[np.ones((1, 2))], [np.ones((1, 2))] * 2], "sample 1: found 2 diagrams, expected 1"),
    ([ph.rips([[0], [1]]), np.ones((1, 2))], "found barcodes and arrays"),
    ([np.array([[1.0, 0.0]])], "sample 0: row 0: found birth 1.0 and death 0.0"),
    (np.array([[[0, 1, 0.5]]]), "found dimensions"), (ph.rips([[0], [1]]), "found Barcode")])
def test_what_is_no_list_of_diagrams(X, words):
    with pytest.raises(ph.Error, match=words):
        Entropy(infinity="drop").fit(X)


def test_other_diagrams_than_those_fitted(dgms):
    with pytest.raises(ph.UsageError, match="found 1 diagrams for each sample, expected 2"):
        Entropy().fit(dgms).transform([row[0] for row in dgms])


@pytest.mark.parametrize("estimator, wrong", [
    (Atol(centres=1), {"contrast": "x"}), (Silhouette(), {"height": "bogus"}),
    (Landscape(), {"height": "bogus"}), (Entropy(), {"unit": "digits"}),
    (LifeEntropy(), {"normalised": "yes"}), (PersistenceImage(), {"pixel": "round"}),
    (PersistenceImage(), {"orientation": "up"})], ids=str)
def test_parameters_that_changed_since_the_fit_are_checked(estimator, wrong):
    fitted = clone(estimator).fit([[[0, 1], [0, 2]]]).set_params(**wrong)
    with pytest.raises(ph.UsageError, match=f"{next(iter(wrong))}: found"):
        fitted.transform([[[0, 1]]])


@pytest.mark.parametrize("kind", [Lengths, ph.sklearn.DiagramDistances], ids=of_class)
def test_diagrams_have_the_names_of_those_that_were_fitted(kind, clouds):
    table = RipsPersistence(reduced=True).set_output(transform="pandas").fit_transform(clouds)
    fitted = kind().fit(table)
    with pytest.raises(ph.UsageError, match="X: found diagrams H1, H0, expected H0, H1, in"):
        fitted.transform(table[["H1", "H0"]])
    giotto = RipsPersistence((0, 1), output="giotto", reduced=True).fit_transform(clouds)
    other = giotto.copy()
    other[:, :, 2] *= 2
    expected = fitted.transform(giotto)
    with pytest.raises(ph.UsageError, match="X: found diagrams H0, H2, expected H0, H1"):
        fitted.transform(other)
    without_names = RipsPersistence(reduced=True).fit_transform(clouds)
    assert np.array_equal(fitted.transform(without_names), expected)
    assert len(fitted.transform([])) == 0


def test_diagrams_that_are_none(clouds):
    for kind in (BettiCurve, Statistics, ph.sklearn.DiagramDistances, ph.sklearn.DiagramKernels):
        with pytest.raises(ph.UsageError, match="shape .3, 0, 3., expected at least one bar"):
            kind().fit_transform(np.empty((3, 0, 3)))
        with pytest.raises(ph.DataError, match="sample 0, diagram 0: row 1: found 1 numbers"):
            kind().fit([[[[0, 1], [2]], [[0, 1]]]])


def test_the_threshold_of_an_euler_curve_is_a_number():
    with pytest.raises(ph.UsageError, match="threshold: found 'a', expected a number"):
        EulerCurve(threshold="a").fit([[[1, 2]]])
