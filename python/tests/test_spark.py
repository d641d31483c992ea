"""Spark: the example on this machine, and on a cluster of two workers of which one is ended in the middle."""

import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator

import pydeltav
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from conftest import ROOT, UNCERTAIN

pyspark = pytest.importorskip("pyspark", reason="there is no pyspark: in the folder python, pip install '.[spark]'")

# Spark prefers that of JAVA_HOME.
HOME_OF_JAVA = os.environ.get("JAVA_HOME")
JAVA = shutil.which("java", path=f"{HOME_OF_JAVA}/bin" if HOME_OF_JAVA else None)
pytestmark = [
    pytest.mark.skipif(JAVA is None, reason="there is no Java, which Spark needs"),
    pytest.mark.skipif(sys.platform != "linux", reason="processes are found in /proc"),
]

EXAMPLE = ROOT / "python" / "examples" / "spark.py"
HOME = pathlib.Path(pyspark.__file__).parent
ROWS = 240
SAMPLES = 128
# (s) Each part of the cluster and each run on it ends by then. Two idle cores need a tenth of it, but a busy machine more.
PATIENCE = 300


def crashes() -> pa.Table:
    """Rows with an answer and, the third and the last, without; a column that is carried over has NaN, −0 and null."""
    weights = [3600.0 + row for row in range(ROWS)]
    weights[2] = -1.0
    weights[-1] = float("nan")
    odd = [float("nan"), -0.0, 0.0, None]
    return pa.table(
        {
            "id": pa.array(range(ROWS), pa.int64()),
            "vehicle1.weight [lb]": weights,
            "recorder.delta_v": pa.array([odd[row % 4] for row in range(ROWS)], pa.float64()),
        }
    )


def bits(table: pa.Table) -> dict[str, list[object]]:
    """The columns in the order of the ids; of numbers the bits, as NaN is not equal to itself, and −0 is to 0."""
    columns: dict[str, list[object]] = {}
    table = table.sort_by("id")
    for name, column in zip(table.schema.names, table.columns, strict=True):
        values = column.to_pylist()
        if pa.types.is_floating(column.type):
            numbers = np.array([0.0 if value is None else value for value in values])
            of_numbers = numbers.view(np.int64).tolist()
            values = [None if value is None else bit for value, bit in zip(values, of_numbers, strict=True)]
        columns[name] = values
    return columns


@pytest.fixture(scope="module")
def expected() -> dict[str, list[object]]:
    """What one process finds."""
    rows = pa.table(pydeltav.reconstruct_table(crashes(), template=UNCERTAIN, samples=SAMPLES, seed=5, threads=1))
    errors = rows["error"].to_pylist()
    assert [row for row, error in enumerate(errors) if error] == [2, ROWS - 1]
    return bits(rows)


@pytest.fixture
def cases(tmp_path: pathlib.Path) -> pathlib.Path:
    """One row group, which Spark reads as one piece."""
    path = tmp_path / "crashes.parquet"
    pq.write_table(crashes(), path)
    return path


def environment(scratch: pathlib.Path) -> dict[str, str]:
    """On the loopback alone, with the Python of the test and no settings of the user's."""
    mine = {name: value for name, value in os.environ.items() if not name.startswith(("SPARK_", "PYSPARK_"))}
    return mine | {
        "SPARK_HOME": str(HOME),
        "SPARK_CONF_DIR": str(scratch),
        "SPARK_LOCAL_IP": "127.0.0.1",
        "SPARK_PUBLIC_DNS": "127.0.0.1",
        "SPARK_LOCAL_DIRS": str(scratch),
        "SPARK_DAEMON_MEMORY": "256m",
        # It would listen on a port that is not ours to choose.
        "SPARK_MASTER_OPTS": "-Dspark.master.rest.enabled=false",
        # Nothing here runs long enough to be worth more of its compiler.
        "JAVA_TOOL_OPTIONS": "-XX:TieredStopAtLevel=1 -XX:+UseSerialGC",
        "PYSPARK_PYTHON": sys.executable,
        "PYSPARK_DRIVER_PYTHON": sys.executable,
    }


class Process:
    """A process in a session of its own, with all that it starts."""

    def __init__(self, folder: pathlib.Path, command: list[str]) -> None:
        folder.mkdir()
        self.folder = folder
        self.log = folder / "log"
        # No standard input: the Python of a worker ends with its executor.
        with self.log.open("w") as log:
            self.process = subprocess.Popen(
                command,
                cwd=folder,
                env=environment(folder),
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
                start_new_session=True,
            )

    def text(self) -> str:
        return self.log.read_text(errors="replace")

    def alive(self) -> list[int]:
        """The processes of its session, also those that have left its group or lost their parent."""
        found = []
        for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
            try:
                number, rest = stat.parent.name, stat.read_text().rsplit(")", 1)[1].split()
            except OSError:
                continue
            # State, parent, group, session; a zombie has ended.
            if rest[0] != "Z" and int(rest[3]) == self.process.pid:
                found.append(int(number))
        return found

    def kill(self) -> None:
        """As if the machine lost its power."""
        until = time.monotonic() + PATIENCE
        while (alive := self.alive()) and time.monotonic() < until:
            for number in alive:
                try:
                    os.kill(number, signal.SIGKILL)
                except ProcessLookupError:
                    continue
            time.sleep(0.01)
        self.process.wait(timeout=PATIENCE)
        assert not self.alive()


def wait_for(what: str, of: Process, found: Callable[[], bool]) -> None:
    until = time.monotonic() + PATIENCE
    while not found():
        assert time.monotonic() < until, f"{what} took more than {PATIENCE} s\n{of.text()}"
        assert of.process.poll() is None, f"it ended before {what}\n{of.text()}"
        time.sleep(0.01)


class Cluster:
    """A master and two workers of one core each."""

    def __init__(self, folder: pathlib.Path) -> None:
        self.folder = folder
        self.processes: list[Process] = []
        self.workers: list[Process] = []
        self.url = ""

    def begin(self) -> None:
        # Port 0 is any that is free.
        deploy, ports = "org.apache.spark.deploy", ["--host", "127.0.0.1", "--port", "0", "--webui-port", "0"]
        master = self.start("master", "spark-class", f"{deploy}.master.Master", *ports)
        wait_for("the master", master, lambda: "spark://127.0.0.1:" in master.text())
        found = re.search(r"spark://127\.0\.0\.1:\d+", master.text())
        assert found is not None
        self.url = found[0]
        for name in ("worker1", "worker2"):
            limits = ["--cores", "1", "--memory", "1g", "--work-dir", str(self.folder / name)]
            worker = self.start(name, "spark-class", f"{deploy}.worker.Worker", *ports, *limits, self.url)
            self.workers.append(worker)
        for worker in self.workers:
            wait_for("a worker", worker, lambda of=worker: "registered with master" in of.text())  # type: ignore[misc]

    def start(self, name: str, program: str, *arguments: str) -> Process:
        process = Process(self.folder / name, [str(HOME / "bin" / program), *arguments])
        self.processes.append(process)
        return process

    def submit(self, cases: pathlib.Path, results: pathlib.Path, tasks: int) -> Process:
        settings = {
            "spark.ui.enabled": "false",
            "spark.driver.host": "127.0.0.1",
            "spark.driver.bindAddress": "127.0.0.1",
            "spark.executor.memory": "512m",
            # Both workers are there before the first task is handed out.
            "spark.cores.max": "2",
            "spark.scheduler.minRegisteredResourcesRatio": "1.0",
            # How long one worker asks the other, which has ended, for its rows.
            "spark.shuffle.io.maxRetries": "1",
            "spark.shuffle.io.retryWait": "1s",
        }
        set_ = [part for name, value in settings.items() for part in ("--conf", f"{name}={value}")]
        of_run = options(cases, results, tasks)
        return self.start("submit", "spark-submit", "--master", self.url, *set_, str(EXAMPLE), *of_run)

    def end(self) -> None:
        for process in reversed(self.processes):
            process.kill()


def options(cases: pathlib.Path, results: pathlib.Path, tasks: int) -> list[str]:
    given = {"template": UNCERTAIN, "samples": SAMPLES, "seed": 5, "tasks": tasks}
    return [str(cases), str(results), *(part for name, value in given.items() for part in (f"--{name}", str(value)))]


@pytest.fixture
def cluster(tmp_path: pathlib.Path) -> Iterator[Cluster]:
    cluster = Cluster(tmp_path)
    try:
        cluster.begin()
        yield cluster
    finally:
        cluster.end()


def test_a_worker_that_is_lost_costs_no_row_and_no_bit(
    cluster: Cluster, cases: pathlib.Path, tmp_path: pathlib.Path, expected: dict[str, list[object]]
) -> None:
    results, tasks = tmp_path / "results", 12
    submitted = cluster.submit(cases, results, tasks)

    def written() -> int:
        return len(list(results.glob("_temporary/0/task_*")))

    wait_for("the first result", submitted, lambda: written() > 0)
    # The worker that dealt out the rows is lost, with its rows and its task.
    [lost] = [worker for worker in cluster.workers if list(worker.folder.rglob("shuffle_*.data"))]
    assert len(lost.alive()) >= 3, "a worker, its executor and its Python"
    lost.kill()
    assert 0 < written() < tasks, "it was in the middle"
    assert submitted.process.wait(timeout=PATIENCE) == 0, submitted.text()
    assert "Lost executor" in submitted.text()
    assert f"{ROWS} rows, 2 of them without an answer, in {tasks} tasks" in submitted.text()
    assert bits(pq.read_table(results)) == expected


def test_another_number_of_tasks_on_one_machine_changes_no_bit(
    cases: pathlib.Path, tmp_path: pathlib.Path, expected: dict[str, list[object]]
) -> None:
    results = tmp_path / "results"
    run = Process(tmp_path / "run", [sys.executable, str(EXAMPLE), *options(cases, results, 5)])
    try:
        assert run.process.wait(timeout=PATIENCE) == 0, run.text()
    finally:
        run.kill()
    assert f"{ROWS} rows, 2 of them without an answer, in 5 tasks" in run.text()
    assert bits(pq.read_table(results)) == expected


def test_what_is_wrong_is_said_before_spark_begins(cases: pathlib.Path, tmp_path: pathlib.Path) -> None:
    command = [sys.executable, str(EXAMPLE), str(cases), str(tmp_path / "results")]
    run = subprocess.run([*command, "--job", "crush", "--samples", "1000"], capture_output=True, encoding="utf-8")
    assert run.returncode == 2 and "--samples is for the jobs reconstruct and impact" in run.stderr
    run = subprocess.run([*command, "--template", "nowhere.toml"], capture_output=True, encoding="utf-8")
    assert run.returncode == 1 and "error: cannot read the template" in run.stderr and "Traceback" not in run.stderr
