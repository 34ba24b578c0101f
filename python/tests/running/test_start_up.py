# SPDX-License-Identifier: MIT
"""libph starts quickly, calls import nothing, and a process may fork at any time."""
import importlib.util
import inspect
import os
import resource
import subprocess
import sys
import textwrap

import pytest

import libph as ph
from workloads import run_python

ONE_CALL = "import numpy as np, libph as ph; ph.rips(np.arange(20.0).reshape(10, 2)**2)"


def cpu_seconds(code, cache):
    """The CPU time of a process that runs this code, with bytecode in the folder `cache`."""
    def used():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    start = used()
    subprocess.run([sys.executable, "-c", code], check=True, env={
        **os.environ, "PYTHONDONTWRITEBYTECODE": "", "PYTHONPYCACHEPREFIX": str(cache)})
    return used() - start


def test_a_process_with_one_call_imports_little():
    code = textwrap.dedent("""
        import sys, numpy
        before = set(sys.modules)
        CALL
        new = set(sys.modules) - before
        ours = {name for name in new if name.startswith("libph")}
        print(len(ours), len(new - ours), *sorted(new - ours))
    """).replace("CALL", ONE_CALL)
    ours, others, *names = run_python(code).stdout.split()
    assert int(ours) <= 28 and int(others) <= 25, names
    assert not {name.partition(".")[0] for name in names} & {
        "difflib", "joblib", "matplotlib", "pandas", "scipy", "sklearn", "torch", "tqdm"}


def test_a_process_with_one_call_costs_little_more_than_numpy(tmp_path):
    """The factor is 1.3. The least of several times is steady on a busy machine as well. The first
    processes also compile the modules."""
    alone, with_call = zip(*[(cpu_seconds("import numpy", tmp_path), cpu_seconds(ONE_CALL, tmp_path))
                             for _ in range(9)])
    assert min(with_call) < 1.6 * min(alone)


# ---- calls

# The arguments of each public function.
CALLS = {
    "alpha": "(X,)",
    "alpha_shape": "(X, 1.0)",
    "barycentre": "([bars, bars], 0)",
    "batch": "(ph.rips, [X, X])",
    "bottleneck": "(bars, bars)",
    "bottleneck_matching": "(bars, bars, 0)",
    "boundary": "(sparse([[0, 0, 1], [0, 0, 1], [0, 0, 0]]), [0, 0, 1])",
    "cloud_part": "(X, 0, 2)",
    "cluster_tree": "(X,)",
    "collapse": "(sparse(abs(X[:, :1] - X[:, 0])),)",
    "confidence_band": "([[0, 1, 2], [1, 2, 3]],)",
    "confidence_radius": "(X,)",
    "core_distances": "(X, 3)",
    "cubical": "(X,)",
    "delay_embedding": "(X[:, 0], 2)",
    "diagram_distances": "([bars, bars], None, 0)",
    "diagram_kernels": "([bars, bars], None, 1)",
    "distance_to_measure": "(X, 3)",
    "estimate": "(X,)",
    "euler_curve": "(X,)",
    "farthest_points": "(X, 3)",
    "filtered": "([(0,), (1,), (0, 1)], [0, 0, 1])",
    "image_part": "(X, 0, 2)",
    "join_parts": "([ph.image_part(X, part, 2) for part in range(2)],)",
    "limits": "()",
    "lower_star": "([0, 2, 1], [[0, 1], [1, 2]])",
    "merge_tree": "(X,)",
    "p_values": "(bars, 1)",
    "permutation_test": "(abs(X[:, :1] - X[:, 0]), [0] * 5 + [1] * 5)",
    "point_image": "(X, 0.5)",
    "read": "(stored('X.npy'),)",
    "read_barcode": "(stored('bars.json'),)",
    "report": "(X,)",
    "rips": "(X,)",
    "segment": "(np.array([[x, y, 1] for x in range(9) for y in range(9)]) / 100,)",
    "sliced_wasserstein": "(bars, bars)",
    "wasserstein": "(bars, bars)",
    "wasserstein_matching": "(bars, bars, 0)",
    "write_nifti": "(os.path.join(FOLDER, 'image.nii'), X)",
}

# Calls each function in a process of its own, which has imported only NumPy and what the arguments
# need, and prints the modules that the call imports.
HARNESS = """
import os, sys, threading
import numpy as np
import libph as ph

def sparse(matrix):
    import scipy.sparse
    return scipy.sparse.csc_array(matrix)

def stored(name):
    path = os.path.join(FOLDER, name)
    if name == "X.npy":
        np.save(path, X)
    else:
        ph.rips(X).save(path)
    return path

X = np.random.default_rng(0).random((10, 2))
for name, arguments in CALLS.items():
    sys.stdout.flush()
    pid = os.fork()
    if pid == 0:
        function = getattr(ph, name)
        bars = ph.rips(X) if "bars" in arguments else None
        values = eval(arguments)
        options = {"threads": 1, "memory_limit": "1GiB", "progress": False, "timeout": 60.0,
                   "stop": threading.Event()} if name in WITH_OPTIONS else {}
        before = set(sys.modules)
        try:
            function(*values, **options)
        except ph.NotBuiltIn:
            pass
        print(name, *sorted(set(sys.modules) - before))
        sys.stdout.flush()
        os._exit(0)
    assert os.waitpid(pid, 0)[1] == 0, name
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system cannot fork")
def test_a_call_imports_nothing(tmp_path):
    functions = {name: getattr(ph, name) for name in ph.__all__
                 if inspect.isfunction(getattr(ph, name))}
    assert functions.keys() == CALLS.keys()
    calls = dict(CALLS)
    if importlib.util.find_spec("scipy") is None:
        calls = {name: values for name, values in CALLS.items() if "sparse" not in values}
    with_options = [name for name, function in functions.items()
                    if inspect.Parameter.VAR_KEYWORD in {
                        p.kind for p in inspect.signature(function).parameters.values()}]
    assert len(with_options) > 30
    given = f"CALLS, WITH_OPTIONS, FOLDER = {calls!r}, {with_options!r}, {str(tmp_path)!r}\n"
    lines = run_python(given + HARNESS).stdout.splitlines()
    assert lines == list(calls)


# ---- forks

# A thread calls libph while the process forks 200 times; each child calls libph as well. A child
# that has not ended after 20 s hangs.
FORKS = """
import os, sys, threading, time
import numpy as np
HIDE
import libph as ph
X = np.random.default_rng(0).random((10, 2))
end = False
THREAD
thread = threading.Thread(target=work)
thread.start()
children = []
for _ in range(COUNT):
    pid = os.fork()
    if pid == 0:
        CALL
        os._exit(0)
    children.append(pid)
end = True
thread.join()
late = time.monotonic() + 20
hung = 0
for pid in children:
    while os.waitpid(pid, os.WNOHANG) == (0, 0):
        if time.monotonic() > late:
            os.kill(pid, 9)
            os.waitpid(pid, 0)
            hung += 1
            break
        time.sleep(0.001)
print(hung)
"""


def hung(call, thread, count, hide=""):
    code = FORKS.replace("HIDE", hide).replace("THREAD", textwrap.dedent(thread))
    done = run_python(code.replace("CALL", call).replace("COUNT", str(count)))
    return done.stdout + done.stderr


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system cannot fork")
@pytest.mark.parametrize("progress", [False, True])
def test_forks_while_a_thread_calls(progress):
    """Where tqdm is missing, each attempt to import it looks for it again."""
    call = f"ph.rips(X, threads=1, progress={progress})"
    thread = f"""
        def work():
            while not end:
                {call}
    """
    assert hung(call, thread, 200, "sys.modules['tqdm'] = None") == "0\n"


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system cannot fork")
def test_forks_while_a_thread_loads():
    thread = """
        def work():
            for name in ph.__all__:
                getattr(ph, name)
    """
    assert hung("[getattr(ph, name) for name in ph.__all__]", thread, 20) == "0\n"


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system cannot fork")
@pytest.mark.parametrize("repeat", range(5))
def test_forks_while_a_thread_makes_mistakes(repeat):
    """The first message with a hint imports the tables of hints. A fork during this import is
    likely, because the threads take turns often."""
    thread = """
        def mistake():
            try:
                ph.rips(X, maxdim=2)
            except TypeError:
                pass

        def work():
            while not end:
                mistake()

        ph.rips(X)
        sys.setswitchinterval(1e-6)
    """
    assert hung("mistake()", thread, 20) == "0\n"
