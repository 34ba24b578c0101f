# SPDX-License-Identifier: MIT
"""slurm.py PH_BARCODE: tests the SLURM commands of docs/how-to/scale-out.md unchanged, on a SLURM
cluster of one machine, which this test starts and ends. Exit code 77, with the reason, if SLURM is
not available.

The scripts of the page run unchanged: a job array, and a job that waits for the array. Then one
part is removed and another one is cut off, as if jobs had died. A second array computes these two
parts and reuses the others.
"""
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from volume import volume  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/how-to/scale-out.md"
SKIPPED = 77

CONF = """ClusterName=one
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
AuthType=auth/none
CredType=cred/none
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=1,bf_interval=1
ReturnToService=2
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
NodeName={host} NodeAddr=127.0.0.1 CPUs={cores} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Slurm:
    """A SLURM cluster with a controller and one node, in a separate folder."""

    def __init__(self, folder):
        self.folder, self.daemons = folder, []
        for name in ("state", "spool"):
            os.mkdir(folder / name)
        conf = folder / "slurm.conf"
        conf.write_text(CONF.format(host=socket.gethostname().split(".")[0], user=pathlib.Path.home().owner()
                                    if os.geteuid() else "root", ports=free_ports(2),
                                    folder=folder, cores=os.cpu_count()))
        self.env = {**os.environ, "SLURM_CONF": str(conf)}

    def __enter__(self):
        for daemon in ("slurmctld", "slurmd"):
            self.daemons.append(subprocess.Popen([daemon, "-D"], env=self.env, stdout=subprocess.DEVNULL,
                                                 stderr=subprocess.DEVNULL))
        until = time.monotonic() + 30
        while time.monotonic() < until:
            said = subprocess.run(["sinfo", "-h", "-o", "%t"], env=self.env, capture_output=True, text=True)
            if said.returncode == 0 and said.stdout.strip() in ("idle", "mix", "alloc"):
                return self
            time.sleep(0.2)
        logs = "".join(path.read_text(errors="replace") for path in self.folder.glob("*.log"))
        self.__exit__()
        sys.exit(f"SLURM did not start:\n{logs}")

    def __exit__(self, *_):
        for daemon in reversed(self.daemons):
            daemon.terminate()
        for daemon in self.daemons:
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                daemon.kill()


def scripts_of_page():
    """The blocks ```sh in the page's section on SLURM: two scripts, and the commands that submit
    them."""
    section = re.search(r"^## SLURM\n(.*?)^## ", PAGE.read_text(encoding="utf-8"), re.M | re.S).group(1)
    blocks = re.findall(r"^```sh\n(.*?)^```", section, re.M | re.S)
    assert len(blocks) == 3, f"{PAGE}: found {len(blocks)} blocks on SLURM, expected 3"
    return blocks


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    missing = [name for name in ("slurmctld", "slurmd", "sbatch", "sinfo") if not shutil.which(name)]
    if missing:
        skip(f"SLURM is not installed ({', '.join(missing)})")
    if os.geteuid() != 0:
        skip("a SLURM of one's own needs root")
    if not os.path.ismount("/sys/fs/cgroup"):
        skip("slurmd needs control groups, and there is no file system of them at /sys/fs/cgroup")
    parts, join, submit = scripts_of_page()
    with tempfile.TemporaryDirectory() as name, Slurm(pathlib.Path(name)) as slurm:
        work = pathlib.Path(name) / "work"
        work.mkdir()
        volume(work / "volume.npy")
        (work / "parts.sh").write_text(parts)
        (work / "join.sh").write_text(join)
        env = {**slurm.env, "PATH": f"{program.parent}:{os.environ['PATH']}"}

        def run(command):
            subprocess.run(["bash", "-ec", command], cwd=work, env=env, check=True, timeout=120)

        def logs():
            return "".join(path.read_text(errors="replace") for path in sorted(work.glob("slurm-*.out")))
        run(submit)
        run("ph-barcode volume.npy --max-dim 0 -o one.csv --quiet")
        bars = work / "bars.csv"
        assert bars.exists(), logs()
        assert bars.read_bytes() == (work / "one.csv").read_bytes(), "other bytes than one process"
        assert len(bars.read_text().splitlines()) > 100
        written = {part.name: part.stat() for part in work.glob("part*.ph")}
        assert len(written) == 8, written
        # A job that died half-way leaves no part or an invalid part. The same command is then run
        # again.
        (work / "part3.ph").unlink()
        (work / "part5.ph").write_bytes((work / "part5.ph").read_bytes()[:100])
        bars.unlink()
        run(submit)
        assert bars.read_bytes() == (work / "one.csv").read_bytes(), logs()
        again = {part.name: part.stat() for part in work.glob("part*.ph")}
        # A file system may give the inode number of a removed file to a new one.
        kept = sorted(name for name in again if os.path.samestat(again[name], written[name])
                      and again[name].st_mtime_ns == written[name].st_mtime_ns)
        assert kept == [f"part{i}.ph" for i in (1, 2, 4, 6, 7, 8)], kept
    print("an array of 8 jobs and its join: the same bytes as one process; a second run computes 2")


if __name__ == "__main__":
    main()
