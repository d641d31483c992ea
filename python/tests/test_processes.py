"""Threads, forks, signals and pickles."""

import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import textwrap
import threading
import time

import pydeltav
import joblib
import pytest
from conftest import FIXTURES, ROOT, UNCERTAIN

CASE = pydeltav.Case.read(UNCERTAIN)


def speeds(seed: int) -> str:
    return CASE.uncertainty(1000, seed=seed).to_json()


@pytest.mark.parametrize("threads", [1, 2, 3, None])
def test_the_number_of_threads_does_not_change_a_bit(threads: int | None) -> None:
    assert CASE.uncertainty(10_000, threads=threads).to_json() == CASE.uncertainty(10_000).to_json()


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system does not fork")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_forked_child_has_threads_of_its_own() -> None:
    # The parent's pool is in use: a child that waited for its threads would wait for ever.
    expected = [speeds(seed) for seed in range(4)]
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map_async(speeds, range(4)).get(timeout=60) == expected


def test_joblib_and_spawned_processes_take_cases_and_give_results() -> None:
    results = joblib.Parallel(n_jobs=2)(joblib.delayed(CASE.uncertainty)(1000, seed) for seed in (1, 2))
    assert [result.to_json() for result in results] == [speeds(1), speeds(2)]
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.apply_async(CASE.uncertainty, (1000, 2)).get(timeout=60).to_json() == speeds(2)


def test_pickles_are_the_same_to_the_last_bit() -> None:
    case = pydeltav.Case.read(FIXTURES / "sae-980025.toml")
    again = pickle.loads(pickle.dumps(case))
    assert (again.text, again.name) == (case.text, case.name)
    results = [case.reconstruct(), case.check(), case.compare(), case.sensitivity(), CASE.uncertainty(640, 5)]
    for result in results:
        restored = pickle.loads(pickle.dumps(result))
        assert type(restored) is type(result)
        assert restored.to_json() == result.to_json()
        assert restored.text() == result.text()
        assert restored.html() == result.html()
    drawing = results[0].draw()
    assert pickle.loads(pickle.dumps(drawing)).svg() == drawing.svg()
    histogram = results[-1].histogram("vehicle1.speed")
    assert pickle.loads(pickle.dumps(histogram)).svg() == histogram.svg()
    part = results[0].vehicle1
    assert pickle.loads(pickle.dumps(part)) == part


def test_a_pickle_of_another_version_is_refused() -> None:
    restore, (_, *state) = CASE.uncertainty(640).__reduce__()  # type: ignore[misc]
    with pytest.raises(ValueError, match="pickled by deltav 0.0.1"):
        restore("0.0.1", *state)


def test_other_threads_of_python_run_meanwhile() -> None:
    turns = 0
    ended = threading.Event()

    def count() -> None:
        nonlocal turns
        while not ended.is_set():
            turns += 1
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    began = time.monotonic()
    CASE.uncertainty(1_000_000, threads=1)
    passed = time.monotonic() - began
    ended.set()
    counter.join()
    # A thread that is kept waiting makes one turn or two.
    assert turns > 20 * min(passed, 1)


INTERRUPTED = """
    import pydeltav, sys
    case = pydeltav.Case.read(sys.argv[1])
    print("begun", flush=True)
    try:
        ASK
    except KeyboardInterrupt:
        print("interrupted", flush=True)
    # All is well afterwards.
    print(case.uncertainty(640, threads=2).succeeded)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C is another thing there")
@pytest.mark.parametrize(
    "ask",
    [
        "case.uncertainty(1_000_000)",
        "case.uncertainty(1_000_000, threads=1)",
        "pydeltav.Case.read('fixtures/estimate.toml').estimate(particles=1024)",
    ],
)
def test_ctrl_c_ends_a_long_run(ask: str) -> None:
    script = textwrap.dedent(INTERRUPTED).replace("ASK", ask)
    # Each sample of this case takes milliseconds, and all of them minutes.
    command = [sys.executable, "-c", script, str(FIXTURES / "rear-end-rest-uncertain.toml")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, encoding="utf-8", cwd=ROOT) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "begun\n"
        time.sleep(0.5)
        began = time.monotonic()
        process.send_signal(signal.SIGINT)
        said, _ = process.communicate(timeout=60)
        assert said == "interrupted\n640\n"
        assert process.returncode == 0
        assert time.monotonic() - began < 20


def test_a_search_back_from_rests_leaves_the_interpreter_alive() -> None:
    """Where the compiler does not optimise, it needs more stack than a thread has unless somebody says."""
    code = """
import pydeltav
case = pydeltav.Case.read("fixtures/rear-end-rest.toml")
print("begins", flush=True)
case.estimate(particles=128, pieces=False)
"""
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, cwd=ROOT) as process:
        assert process.stdout is not None and process.stdout.readline() == b"begins\n"
        # A stack that is too small overflows in its first search, a tenth of a second later.
        try:
            assert process.wait(timeout=3.0) == 0
        except subprocess.TimeoutExpired:
            process.kill()
