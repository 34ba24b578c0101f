# SPDX-License-Identifier: MIT
"""Builds wheels with CMake: a build backend (PEP 517, PEP 660) that needs only the standard
library.

``pip install .`` therefore needs no network if CMake, a compiler and pybind11 are installed.
Settings (``pip install . --config-settings NAME=VALUE``):

build-dir
    An existing build folder, configured with PH_BUILD_PYTHON. The module is built there, without a
    new configuration.
cmake-args
    More arguments for the configuration, separated by blanks and quoted as in a shell. If the
    setting is given several times, all its arguments are used.
"""
import base64
import csv
import hashlib
import io
import os
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NAME = "libph"
# The files that a build needs and that a source archive contains.
SOURCES = ("CMakeLists.txt", "cmake", "libph", "libsegment", "libreport", "viewer", "python",
           "pyproject.toml", "LICENSE", "README.md", "CHANGELOG.md", "CITATION.cff",
           "docs/reference/python.md")


def version():
    return re.search(r"VERSION (\d+\.\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text())[1]


def metadata():
    """The file METADATA of a wheel. It repeats what pyproject.toml says about the project, because
    Python 3.9 has no TOML parser. A test checks that both agree."""
    return f"""\
Metadata-Version: 2.1
Name: {NAME}
Version: {version()}
Summary: Persistent homology: barcodes of points, images and filtered complexes
License: MIT
Requires-Python: >=3.9
Requires-Dist: numpy>=1.22
Provides-Extra: all
Requires-Dist: scipy; extra == "all"
Requires-Dist: scikit-learn; extra == "all"
Requires-Dist: pandas; extra == "all"
Requires-Dist: matplotlib; extra == "all"
Requires-Dist: tqdm; extra == "all"
Description-Content-Type: text/markdown

""" + (ROOT / "docs/reference/python.md").read_text()


# ---- the functions that pip calls


def _requirements(settings=None):
    """The packages that pip must fetch before a build: pybind11, unless the system has it."""
    places = (Path(prefix, share, "cmake/pybind11")
              for prefix in ("/usr", "/usr/local") for share in ("lib", "share"))
    return [] if any(place.exists() for place in places) else ["pybind11>=2.10"]


get_requires_for_build_wheel = get_requires_for_build_editable = _requirements


def get_requires_for_build_sdist(config_settings=None):
    return []


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    folder = Path(metadata_directory) / dist_info()
    folder.mkdir()
    for name, content in dist_info_files().items():
        (folder / name).write_text(content)
    return folder.name


prepare_metadata_for_build_editable = prepare_metadata_for_build_wheel


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    folder = build(config_settings or {})
    with tempfile.TemporaryDirectory() as staging:
        run("cmake", "--install", folder, "--prefix", staging, "--component", "python", "--strip")
        (package,) = Path(staging).rglob(f"{NAME}/__init__.py")
        root = package.parents[1]
        files = {str(path.relative_to(root)): path.read_bytes()
                 for path in sorted(root.rglob("*")) if path.is_file()}
    return write_wheel(wheel_directory, files)


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    """Makes a wheel that points to the build folder, which links to the Python sources. Only a
    change of the C++ code needs a new installation."""
    folder = build(config_settings or {})
    return write_wheel(wheel_directory, {f"__editable__.{NAME}.pth":
                                         f"{(folder / 'python').resolve()}\n".encode()})


def build_sdist(sdist_directory, config_settings=None):
    stem = f"{NAME}-{version()}"
    name = f"{stem}.tar.gz"
    with tarfile.open(Path(sdist_directory) / name, "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for source in SOURCES:
            archive.add(ROOT / source, f"{stem}/{source}", filter=without_caches)
        content = metadata().encode()
        info = tarfile.TarInfo(f"{stem}/PKG-INFO")
        info.size = len(content)
        archive.addfile(info, io.BytesIO(content))
    return name


# ---- helpers


def without_caches(info):
    """The member of an archive, or None for a file to leave out: files that Python, npm or a build
    made, and tests of the viewer. A report page that is already built stays in the archive, because
    a build without npm needs it."""
    name = info.name.split("/", 1)[1]
    is_cache = "__pycache__" in name or name.endswith(".pyc") or name.startswith(
        ("viewer/node_modules", "viewer/test"))
    is_built = name.startswith("viewer/build/") and name != "viewer/build/report-template.html"
    return None if is_cache or is_built else info


def run(*command):
    print("+", *command, flush=True)
    subprocess.run([str(word) for word in command], check=True)


def words_of(setting):
    """The words of a setting, which newer versions of pip pass as a list if it is given twice."""
    return shlex.split(setting if isinstance(setting, str) else " ".join(setting))


def make_folder(folder):
    try:
        folder.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except OSError as error:
        raise SystemExit(f"libph: {folder}: found no folder to build in: {error.strerror}; copy the "
                         "sources to where you may write") from None


def build(settings):
    """Compiles the module. @return the build folder."""
    unknown = sorted(settings.keys() - {"build-dir", "cmake-args"})
    if unknown:
        raise SystemExit(f"libph: found setting {unknown[0]}, expected build-dir or cmake-args")
    given = settings.get("build-dir")
    folder = Path(given) if given else ROOT / "build" / f"python-{sys.implementation.cache_tag}"
    if not given:
        make_folder(folder)
        generator = ["-G", "Ninja"] if shutil.which("ninja") else []
        # `--fresh`, because an earlier configuration may have had other paths, another generator or
        # other arguments.
        run("cmake", "--fresh", "-S", ROOT, "-B", folder, *generator, "-DCMAKE_BUILD_TYPE=Release",
            "-DPH_BUILD_PYTHON=ON", "-DPH_BUILD_APPS=OFF", "-DPH_BUILD_TESTS=OFF",
            "-DPH_BUILD_EXAMPLES=OFF", "-DPH_WITH_FREETYPE=OFF", "-DPH_INSTALL=OFF",
            "-DPH_UNITY=ON", f"-DPython3_EXECUTABLE={sys.executable}",
            *pybind11_folder(), *words_of(settings.get("cmake-args", "")))
    jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or os.cpu_count() or 1
    run("cmake", "--build", folder, "--target", "_core", "--parallel", jobs)
    return folder


def pybind11_folder():
    """CMake's argument for the folder where pip installed pybind11; empty if there is none."""
    try:
        import pybind11
    except ImportError:
        return []
    return [f"-Dpybind11_DIR={pybind11.get_cmake_dir()}"]


def dist_info():
    return f"{NAME}-{version()}.dist-info"


def dist_info_files():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    abi = python + getattr(sys, "abiflags", "")
    tag = f"{python}-{abi}-{re.sub('[-.]', '_', sysconfig.get_platform())}"
    return {"METADATA": metadata(), "LICENSE": (ROOT / "LICENSE").read_text(),
            "WHEEL": f"Wheel-Version: 1.0\nGenerator: {NAME}\nRoot-Is-Purelib: false\nTag: {tag}\n"}


def write_wheel(folder, files):
    """Writes a wheel that contains the given files and its metadata.

    @param files the content of each file, by name. @return the file name of the wheel."""
    information = dist_info_files()
    tag = re.search("Tag: (.*)", information["WHEEL"])[1]
    name = f"{NAME}-{version()}-{tag}.whl"
    files = {**files, **{f"{dist_info()}/{key}": text.encode() for key, text in information.items()}}
    record = io.StringIO()
    rows = csv.writer(record, lineterminator="\n")
    with zipfile.ZipFile(Path(folder) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, content in files.items():
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            rows.writerow([path, f"sha256={digest}", len(content)])
            write_member(wheel, path, content)
        rows.writerow([f"{dist_info()}/RECORD", "", ""])
        write_member(wheel, f"{dist_info()}/RECORD", record.getvalue().encode())
    return name


def write_member(wheel, path, content):
    """Adds a file with a fixed time and mode: the same files always make the same wheel."""
    info = zipfile.ZipInfo(path, (1980, 1, 1, 0, 0, 0))
    info.compress_type = zipfile.ZIP_DEFLATED
    info.external_attr = (0o755 if path.endswith(".so") else 0o644) << 16
    wheel.writestr(info, content)
