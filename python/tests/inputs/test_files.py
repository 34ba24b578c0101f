# SPDX-License-Identifier: MIT
"""Tests that data files are read as arrays."""
import gzip
import logging

import numpy as np
import pytest
import scipy.sparse as sparse

import libph as ph

POINTS = np.random.default_rng(0).normal(size=(20, 3)).round(3)
DISTANCES = np.linalg.norm(POINTS[:, None] - POINTS, axis=2)


def write(folder, name, text):
    path = folder / name
    path.write_text(text)
    return path


def test_points(tmp_path, caplog):
    np.savetxt(tmp_path / "p.csv", POINTS, delimiter=",", header="x,y,z", comments="")
    with caplog.at_level(logging.INFO, "libph"):
        points = ph.read(tmp_path / "p.csv")
    assert points.dtype == np.float64 and np.array_equal(points, POINTS) and points.flags.writeable
    assert "20 points in R^3" in caplog.text and "header" in caplog.text
    assert np.array_equal(ph.read(str(tmp_path / "p.csv"), columns=["y", "1"]), POINTS[:, :2])
    assert np.array_equal(ph.read(tmp_path / "p.csv", "points", columns="2-3"), POINTS[:, 1:])
    with gzip.open(tmp_path / "p.csv.gz", "wt") as file:
        file.write((tmp_path / "p.csv").read_text())
    assert np.array_equal(ph.read(bytes(tmp_path / "p.csv.gz")), POINTS)


def test_distances(tmp_path):
    np.savetxt(tmp_path / "d.txt", DISTANCES, fmt="%.17g")
    read = ph.read(tmp_path / "d.txt", "distance")
    assert np.array_equal(read, DISTANCES)
    assert ph.rips(read, metric="precomputed") == ph.rips(POINTS)
    upper = "\n".join(" ".join(map(repr, row[i + 1:].tolist())) for i, row in enumerate(DISTANCES))
    assert np.array_equal(ph.read(write(tmp_path, "u.txt", upper), "upper-distance"), DISTANCES)
    births = DISTANCES + np.diag(np.arange(20))
    np.save(tmp_path / "b.npy", births)
    assert np.array_equal(ph.read(tmp_path / "b.npy", "distance", diagonal="births"), births)
    with pytest.raises(ph.DataError, match="diagonal='any'"):
        ph.read(tmp_path / "b.npy", "distance")
    assert np.array_equal(ph.read(tmp_path / "b.npy", "distance", diagonal="any"), DISTANCES)
    correlations = np.corrcoef(POINTS)
    np.save(tmp_path / "c.npy", correlations)
    assert np.allclose(ph.read(tmp_path / "c.npy", "distance", from_correlation=True),
                       1 - correlations)


def test_sparse_distances(tmp_path):
    matrix = ph.read(write(tmp_path, "s.txt", "0 1 1.5\n3 2 0\n"), "sparse")
    assert isinstance(matrix, sparse.coo_array) and matrix.shape == (4, 4) and matrix.nnz == 2
    assert ph.rips(matrix, metric="precomputed").dgm(0)[:, 1].tolist() == [1.5, np.inf, np.inf]


@pytest.mark.parametrize("dtype", ["u1", "u2", "i2", "f4", "f8"])
def test_images(tmp_path, dtype):
    image = np.random.default_rng(0).integers(0, 99, size=(4, 5, 6)).astype(dtype)
    np.save(tmp_path / "i.npy", image)
    read = ph.read(tmp_path / "i.npy")
    assert read.dtype == image.dtype and np.array_equal(read, image)
    image.astype(np.dtype(dtype).newbyteorder(">")).tofile(tmp_path / "i.raw")
    assert np.array_equal(ph.read(tmp_path / "i.raw", "raw", raw_shape=image.shape,
                                  raw_dtype=">" + dtype), image)


def test_points_without_a_header(tmp_path):
    scan = np.random.default_rng(0).random((30, 4)).astype("f4")
    scan.tofile(tmp_path / "v.bin")
    assert np.array_equal(ph.read(tmp_path / "v.bin", raw_points=4), scan)
    assert np.array_equal(ph.read(tmp_path / "v.bin", raw_points=4, columns=["1-3"]), scan[:, :3])
    scan.astype(">f8").tofile(tmp_path / "w.bin")
    assert np.array_equal(ph.read(tmp_path / "w.bin", raw_points=4, raw_dtype=">f8"), scan)
    with pytest.warns(UserWarning, match="read as distances; raw_points=4"):
        assert ph.read(tmp_path / "v.bin").shape == (16, 16), "also a triangle of distances"
    for wrong, words in (({"raw_points": 0}, "raw_points"), ({"raw_points": 4, "raw_shape": (120,)}, "raw_shape"),
                         ({"raw_points": 4, "format": "points"}, "raw_points: found format='points', expected"),
                         ({"raw_dtype": "f4", "raw_skip": 2},
                          "raw_dtype, raw_skip: found neither raw_shape nor raw_points")):
        with pytest.raises(ph.UsageError, match=words):
            ph.read(tmp_path / "v.bin", **wrong)
    with pytest.raises(ph.DataError, match="truncated point"):
        ph.read(tmp_path / "v.bin", raw_points=7)
    (tmp_path / "x.raw").write_bytes(b"\1\2\3")
    with pytest.raises(ph.DataError, match="raw_shape N,M.*raw_points D"):
        ph.read(tmp_path / "x.raw")


def test_the_note_on_columns_is_valid_python(tmp_path):
    path = write(tmp_path, "c.csv", "x,y,z,ring\n1,2,3,4\n5,6,7,8\n")
    with pytest.warns(UserWarning) as told:
        assert ph.read(path).shape == (2, 4)
    assert [str(warning.message) for warning in told] == [
        f"{path}: ring is read as a coordinate; columns=['x', 'y', 'z'] leaves it out"]
    assert told[0].filename == __file__
    assert ph.read(path, columns=["x", "y", "z"]).tolist() == [[1, 2, 3], [5, 6, 7]]


def test_structured_arrays_in_files(tmp_path):
    cloud = np.zeros(3, dtype=[("ring", "u1"), ("x", "f4"), ("y", "f4"), ("z", "f4")])
    cloud["x"] = 1, 2, 3
    np.save(tmp_path / "c.npy", cloud)
    assert ph.read(tmp_path / "c.npy").tolist() == [[1, 0, 0], [2, 0, 0], [3, 0, 0]]
    assert ph.read(tmp_path / "c.npy", columns=["ring", "x"]).shape == (3, 2)
    np.savez(tmp_path / "c.npz", cloud=cloud)
    assert ph.read(tmp_path / "c.npz").shape == (3, 3)
    np.save(tmp_path / "c.npy", cloud[["ring", "x"]])
    with pytest.raises(ph.DataError, match=r"found fields ring, x, expected .*columns"):
        ph.read(tmp_path / "c.npy")


def test_an_image_beyond_the_memory_stays_in_its_file(tmp_path):
    image = np.random.default_rng(0).integers(0, 99, size=(100, 100, 100)).astype("u1")
    image.tofile(tmp_path / "i.raw")
    read = ph.read(tmp_path / "i.raw", "raw", raw_shape=image.shape, memory_limit="2MiB")
    assert np.array_equal(read, image)
    np.save(tmp_path / "i.npy", image)
    read = ph.read(tmp_path / "i.npy", memory_limit="2MiB")
    assert np.array_equal(read, image)
    bars = ph.cubical(read)
    del read
    assert bars == ph.cubical(image)


def test_pictures(tmp_path):
    path = write(tmp_path, "p.pgm", "P2 3 2 9\n1 2 3\n4 5 6\n")
    assert ph.read(path).tolist() == [[1, 2, 3], [4, 5, 6]]


def test_complexes(tmp_path):
    path = write(tmp_path, "s.txt", "0 : 0\n1 : 0.5\n0 1 : 2\n")
    simplices = ph.read(path, "simplices")
    assert simplices.simplices == [(0,), (1,), (0, 1)] and simplices.values.tolist() == [0, 0.5, 2]
    assert list(ph.filtered(*simplices)) == [(0, 0, np.inf), (0, 0.5, 2)]
    path = write(tmp_path, "b.txt", "0\n0\n1 0 1\n")
    matrix = ph.read(path, "phat")
    assert matrix.values is None or list(matrix.values) == [0, 1, 2]
    assert list(ph.boundary(*matrix)) == [(0, 0, np.inf), (0, 1, 2)]
    values = write(tmp_path, "v.txt", "1\n2\n7\n")
    assert list(ph.boundary(*ph.read(path, "phat", values=values))) == [(0, 1, np.inf), (0, 2, 7)]


def test_meshes(tmp_path):
    text = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n"
    path = write(tmp_path, "m.off", text)
    mesh = ph.read(path)
    assert mesh.vertices.shape == (4, 3) and mesh.values is None
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 1, 2], [0, 2, 3]]
    values = write(tmp_path, "v.txt", "0\n1\n2\n3\n")
    mesh = ph.read(path, values=values)
    assert list(ph.lower_star(mesh.values, np.unique(mesh.triangles, axis=0))) == [(0, 0, np.inf)]


def test_meshes_with_seams(tmp_path):
    text = ("OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 1 0\n1 0 0\n3 0 1 2\n3 3 4 5\n")
    path, values = write(tmp_path, "m.off", text), write(tmp_path, "v.txt", "0\n1\n2\n3\n2\n1\n")
    with pytest.warns(UserWarning, match="not connected; weld joins them"):
        split = ph.read(path, values=values)
    assert len(split.vertices) == 6
    assert len(ph.lower_star(split.values, split.triangles).dgm(0)) == 2
    mesh = ph.read(path, values=values, weld=True)
    assert mesh.vertices.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]
    assert list(ph.lower_star(mesh.values, mesh.triangles)) == [(0, 0, np.inf)]
    write(tmp_path, "v.txt", "0\n1\n2\n3\n9\n1\n")
    with pytest.raises(ph.DataError, match="values 2 of vertex 2 and 9 of vertex 4"):
        ph.read(path, values=values, weld=True)
    with pytest.raises(ph.UsageError, match="weld"):
        ph.read(write(tmp_path, "p.txt", "0 1\n"), weld=True)


def test_files_that_are_refused(tmp_path):
    with pytest.raises(ph.MissingInputError):
        ph.read(tmp_path / "missing.csv")
    with pytest.raises(ph.MissingInputError):
        ph.read(tmp_path)
    with pytest.raises(ph.DataError, match=r"bad.csv:2"):
        ph.read(write(tmp_path, "bad.csv", "1,2\n3\n"))
    with pytest.raises(ph.DataError, match="nan='drop'") as caught:
        ph.read(write(tmp_path, "nan.csv", "1,2\nnan,1\n"), "points")
    assert caught.value.remedies[0] == ("nan", "drop")
    with pytest.raises(ph.DataError, match="symmetrise='max', 'min' or 'lower' accepts it"):
        ph.read(write(tmp_path, "uneven.csv", "0,1\n2,0\n"), "distance")
    with pytest.raises(ph.UsageError, match="format"):
        ph.read(tmp_path / "bad.csv", "xyzzy")
    with pytest.raises(ph.UsageError, match="raw_dtype"):
        ph.read(tmp_path / "bad.csv", "raw", raw_dtype="c16")
    with pytest.raises(ph.UsageError):
        ph.read(tmp_path / "bad.csv", array="x")
    with pytest.raises(TypeError, match="unexpected keyword"):
        ph.read(tmp_path / "bad.csv", skip=3)
    wide = write(tmp_path, "wide.csv", "1,2\n3,4\n5,6\n")
    with pytest.raises(ph.DataError, match="as many rows as columns, for distances"):
        ph.read(wide, array="distances")
    with pytest.raises(ph.UsageError, match=r"columns: found \[\], expected names"):
        ph.read(wide, columns=[])


def test_a_name_that_is_no_text(tmp_path):
    name = bytes(tmp_path) + b"/\xff\xfe.csv"
    with pytest.raises(ph.MissingInputError):
        ph.read(name)
    with open(name, "w") as file:
        file.write("1,2\n3,4\n")
    assert ph.read(name).tolist() == [[1, 2], [3, 4]]
    ph.rips([[0], [1]]).save(name, "csv")
    assert len(ph.read_barcode(name)) == 2


def test_a_folder_of_slices(tmp_path):
    for k in (10, 9, 1):
        (tmp_path / f"slice{k}.pgm").write_bytes(b"P5 2 1 255\n" + bytes([k, k + 1]))
    volume = ph.read(tmp_path, stack=True)
    assert volume.dtype == np.uint8
    assert volume.tolist() == [[[1, 2]], [[9, 10]], [[10, 11]]]
    with pytest.raises(ph.MissingInputError, match="it is a directory; stack reads the pictures"):
        ph.read(tmp_path)
    with pytest.raises(ph.UsageError, match="expected a folder of pictures"):
        ph.read(tmp_path / "slice1.pgm", stack=True)
