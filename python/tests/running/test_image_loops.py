# SPDX-License-Identifier: MIT
"""Tests that the parts of a volume, which exchange messages, find the same loops as a single
process."""
import copy
import multiprocessing
import os
import pickle
import random
import re
import shutil
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

import libph as ph

SOURCE = Path(os.environ.get("PH_SOURCE_DIR", Path(__file__).parents[3]))
RNG = np.random.default_rng(6)
VOLUME = RNG.random((12, 8, 7)).astype(np.float32)


def begun(image, count, field=2, **options):
    """The joined parts and, for each part, an ImageLoops object that has already begun."""
    parts = [ph.image_part(image, i, count, loops=True, **options) for i in range(count)]
    whole = ph.join_parts(random.Random(1).sample(parts, count))
    loops = [ph.ImageLoops(part, field=field) for part in parts]
    for some, told in zip(loops, whole.told_to_loops()):
        some.begin(told)
    return whole, loops


def rounds(loops):
    """Exchanges messages until none is in transit."""
    while True:
        letters = []
        for some in loops:
            some.work()
            assert some.is_idle
            letters += some.take_messages()
        if not letters:
            return [some.barcode() for some in loops]
        for to, message in letters:
            loops[to].receive(message)


@pytest.mark.parametrize("count", [1, 2, 5, 12])
@pytest.mark.parametrize("options", [
    {}, {"construction": "cells", "field": 3}, {"periodic": True}, {"superlevel": True},
    {"threshold": 0.6}, {"max_dim": 1}, {"min_dim": 1, "max_dim": 1, "cells": False}])
def test_the_same_bars(count, options):
    whole, loops = begun(VOLUME, count, **options)
    bars, expected = whole.barcode(loops=reversed(rounds(loops))), ph.cubical(VOLUME, **options)
    assert bars == expected and (bars.dims == 1).any()
    for name in ("construction", "superlevel", "shape", "threshold", "field", "periodic"):
        assert bars.meta.get(name) == expected.meta.get(name), name
    if options.get("cells", True):
        assert np.array_equal(bars.birth_cells(1), expected.birth_cells(1))
        assert np.array_equal(bars.death_cells(1), expected.death_cells(1))


def test_the_order_of_all_is_free():
    """The parts work in small steps. Messages arrive late and in any order, even before `begin`."""
    chance = random.Random(3)
    for _ in range(5):
        count = 4
        parts = [ph.image_part(VOLUME, i, count, loops=True) for i in range(count)]
        whole = ph.join_parts(parts)
        loops = [ph.ImageLoops(part) for part in parts]
        told = whole.told_to_loops()
        waiting, letters = list(range(count)), []
        while True:
            if waiting and (not letters or chance.random() < 0.3):
                number = waiting.pop(chance.randrange(len(waiting)))
                loops[number].begin(told[number])
            some = chance.choice(loops)
            some.work(most=chance.randint(1, 20))
            letters += some.take_messages()
            if letters and chance.random() < 0.5:
                to, message = letters.pop(chance.randrange(len(letters)))
                loops[to].receive(message)
            elif not letters and not waiting and all(some.is_idle for some in loops):
                letters = [letter for some in loops for letter in some.take_messages()]
                if not letters:
                    break
        sent = sum(some.messages_sent for some in loops)
        assert sent == sum(some.messages_received for some in loops) > 0
        assert sum(some.bytes_sent for some in loops) > 0
        assert whole.barcode(loops=[some.barcode() for some in loops]) == ph.cubical(VOLUME)


def _actor(number, count, field, mine, others, to_whole, to_rank):
    """The work of one process, which has one part, the loops of this part, and a mailbox. In each
    round, every process sends a message to every other process, which keeps them in step."""
    part = ph.image_part(VOLUME, number, count, loops=True, threads=1)
    loops = ph.ImageLoops(part, field=field, threads=1)
    to_whole.put((number, part))
    loops.begin(to_rank.get())
    while True:
        loops.work()
        letters = dict(loops.take_messages())
        for to, box in enumerate(others):
            if to != number:
                box.put((number, bool(letters), letters.get(to)))
        heard = {}
        while len(heard) < count - 1:
            sender, is_busy, message = mine.get()
            assert sender not in heard
            heard[sender] = is_busy
            if message is not None:
                loops.receive(message)
        # No process continues before all have received the messages of the round.
        to_whole.put(("round", number))
        if to_rank.get() == "done" and not letters and not any(heard.values()):
            break
    to_whole.put(("bars", loops.barcode()))


def test_processes_as_actors():
    count, field = 3, 3
    spawn = multiprocessing.get_context("spawn")
    boxes = [spawn.Queue() for _ in range(count)]
    to_whole, to_ranks = spawn.Queue(), [spawn.Queue() for _ in range(count)]
    actors = [spawn.Process(target=_actor, daemon=True, args=(
        i, count, field, boxes[i], boxes, to_whole, to_ranks[i])) for i in range(count)]
    for actor in actors:
        actor.start()
    parts = dict(to_whole.get(timeout=60) for _ in range(count))
    whole = ph.join_parts(parts.values())
    for box, told in zip(to_ranks, whole.told_to_loops()):
        box.put(told)
    bars, ended = [], 0
    while len(bars) < count:
        kind, value = to_whole.get(timeout=60)
        if kind == "bars":
            bars.append(value)
            continue
        ended += 1
        if ended % count == 0:
            for box in to_ranks:
                box.put("done")
    for actor in actors:
        actor.join(60)
    assert whole.barcode(loops=bars) == ph.cubical(VOLUME, field=field)


RANKS = """
import sys
import numpy as np
from mpi4py import MPI
import libph as ph

comm = MPI.COMM_WORLD
volume = np.random.default_rng(0).random((12, 10, 8))
part = ph.image_part(volume, comm.rank, comm.size, loops=True, threads=1)
loops = ph.ImageLoops(part, threads=1)
parts = comm.gather(part)
whole = ph.join_parts(parts) if comm.rank == 0 else None
loops.begin(comm.scatter(whole.told_to_loops() if whole else None))
is_done = False
while not is_done:
    {round}
bars = comm.gather(loops.barcode())
if whole:
    sys.exit(whole.barcode(loops=bars) != ph.cubical(volume))
"""


def test_the_page_on_the_ranks_of_mpi4py(tmp_path):
    pytest.importorskip("mpi4py")
    mpirun = shutil.which("mpirun.openmpi")  # Debian's mpi4py uses this MPI
    if mpirun is None:
        pytest.skip("there is no mpirun.openmpi")
    page = SOURCE / "docs/how-to/scale-out.md"
    (block,) = re.findall(r"```python\n(loops\.work\(\)\n.*?)```", page.read_text(), re.DOTALL)
    script = tmp_path / "ranks.py"
    script.write_text(RANKS.format(round=block.replace("\n", "\n    ")))
    subprocess.run([mpirun, "--oversubscribe", "-n", "3", sys.executable, script], check=True,
                   timeout=100, cwd=tmp_path, stdin=subprocess.DEVNULL, env={
                       **os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1",
                       "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                       "PYTHONPATH": str(Path(ph.__file__).parents[1])})


def test_calls_out_of_order():
    part = ph.image_part(VOLUME, 0, 2, loops=True)
    assert part.has_loops and part == pickle.loads(pickle.dumps(part))
    for sent in (copy.copy(part), pickle.loads(pickle.dumps(part)),
                 ph.ImagePart.from_bytes(part.to_bytes()), ph.image_part(VOLUME, 0, 2, max_dim=0),
                 ph.image_part(VOLUME[0], 0, 2, loops=True)):
        with pytest.raises(ph.UsageError, match="expected an unused result of"):
            ph.ImageLoops(sent)
    with pytest.raises(ph.UsageError, match="expected ImagePart"):
        ph.ImageLoops(b"part")
    for field in (4, 1, "two"):
        with pytest.raises(ph.UsageError, match="field"):
            ph.ImageLoops(part, field=field)
    loops = ph.ImageLoops(part)  # the part still has its voxels after the refused calls
    with pytest.raises(ph.UsageError, match="was already used, sent or joined"):
        ph.ImageLoops(part)
    assert repr(loops) == "ImageLoops(0 of 2, shape=(12, 8, 7))" and loops.is_idle
    with pytest.raises(ph.UsageError, match="not begun"):
        loops.barcode()
    with pytest.raises(TypeError, match="stay in the process"):
        pickle.dumps(loops)
    loops.work()
    whole = ph.join_parts([part, ph.image_part(VOLUME, 1, 2, loops=True)])
    told = whole.told_to_loops()
    with pytest.raises(ph.UsageError, match="expected bytes"):
        loops.begin("told")
    loops.begin(told[0])
    with pytest.raises(ph.UsageError, match="found a second call of begin"):
        loops.begin(told[0])
    with pytest.raises(ph.UsageError, match="messages that were not taken"):
        loops.barcode()
    with pytest.raises(TypeError, match="thread"):
        loops.work(thread=1)
    with pytest.raises(ph.UsageError, match="most"):
        loops.work(0)
    with pytest.raises(ph.DataError, match="found 1 of 2"):
        part.told_to_loops()
    with pytest.raises(ph.UsageError, match="without loops"):
        ph.image_part(VOLUME, 0, 1, max_dim=0).told_to_loops()


def test_damage_is_seen():
    whole, loops = begun(VOLUME, 3)
    told = whole.told_to_loops()
    fresh = [ph.ImageLoops(ph.image_part(VOLUME, 0, 3, loops=True)) for _ in range(5)]
    for some, what in zip(fresh, (told[1], told[0][:-1], b"", told[0] + b"0")):
        with pytest.raises(ph.DataError):
            some.begin(what)
        for call in (some.work, some.take_messages, some.barcode, lambda: some.receive(b"")):
            with pytest.raises(ph.UsageError, match="an earlier call failed"):
                call()
    other = ph.join_parts([ph.image_part(VOLUME[::-1].copy(), i, 3, loops=True, superlevel=True)
                           for i in range(3)])
    with pytest.raises(ph.DataError):
        fresh[4].begin(other.told_to_loops()[0])
    for some in loops:
        some.work()
    to, message = loops[0].take_messages()[0]
    wrong = bytearray(message)
    wrong[len(wrong) // 2] ^= 1
    with pytest.raises(ph.DataError):
        loops[to].receive(wrong)
    assert to != 2
    with pytest.raises(ph.DataError):
        loops[2].receive(message)  # the message is for another part


def test_what_is_lost_is_seen():
    whole, loops = begun(VOLUME, 3)
    bars = rounds(loops)
    for few in (None, [], bars[:2], [*bars[:2], bars[0]], [*bars, bars[0]]):
        with pytest.raises(ph.DataError, match="expected one for each part"):
            whole.barcode(loops=few)
    with pytest.raises(ph.UsageError, match="ImageLoops.barcode"):
        whole.barcode(loops=[ph.cubical(VOLUME)] * 3)
    others = rounds(begun(VOLUME, 3, field=3)[1])
    with pytest.raises(ph.DataError, match="loops: field: found 3, expected 2"):
        whole.barcode(loops=[*bars[:2], others[2]])
    flat = ph.image_part(VOLUME[0], 0, 1, loops=True)
    assert not flat.has_loops and flat.barcode() == ph.cubical(VOLUME[0])
    with pytest.raises(ph.UsageError, match="a part without loops"):
        flat.barcode(loops=bars)
    with pytest.raises(ph.DataError, match="found 2 of 3"):
        ph.join_parts([ph.image_part(VOLUME, i, 3, loops=True) for i in (0, 1)]).barcode(loops=bars)
    # Drops one message.
    whole, loops = begun(VOLUME, 3)
    lost = False
    while True:
        letters = []
        for some in loops:
            some.work()
            letters += some.take_messages()
        if not letters:
            break
        if not lost and len(letters) > 1:
            letters.pop()
            lost = True
        for to, message in letters:
            loops[to].receive(message)
    with pytest.raises(ph.DataError, match="received messages, expected "):
        whole.barcode(loops=[some.barcode() for some in loops])


def test_limits_hold():
    volume = RNG.random((64, 64, 64))
    part = ph.image_part(volume, 0, 1, loops=True)
    with pytest.raises(ph.MemoryLimitError):
        ph.ImageLoops(part, memory_limit="10kB")
    (loops,) = begun(volume, 1)[1]
    stop = threading.Event()
    stop.set()
    with pytest.raises(ph.Cancelled):
        loops.work(stop=stop)
    with pytest.raises(ph.UsageError, match="found work to do"):
        loops.barcode()  # the failed call changed nothing
    with pytest.raises(ph.Timeout):
        loops.work(timeout=1e-5)
    with pytest.raises(ph.UsageError, match="an earlier call failed"):
        loops.barcode()
    whole, loops = begun(volume, 1)
    loops[0].work(progress=lambda *news: None, timeout=100)
    assert whole.barcode(loops=rounds(loops)) == ph.cubical(volume)
    whole, loops = begun(volume, 2)
    workers = [threading.Thread(target=some.work) for some in loops for _ in "ab"]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert whole.barcode(loops=rounds(loops)) == ph.cubical(volume)


def test_the_image_may_go_away():
    image = RNG.random((9, 8, 7))
    expected = ph.cubical(image)
    whole, loops = begun(image.copy(), 3)
    whole_f, loops_f = begun(np.asfortranarray(image), 3)
    assert whole.barcode(loops=rounds(loops)) == expected
    assert whole_f.barcode(loops=rounds(loops_f)) == expected
