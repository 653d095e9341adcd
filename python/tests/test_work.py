"""Long work: Ctrl+C, progress, threads, forked processes."""

import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import textwrap
import threading
import time

import pytest
import svbrdf


def test_ctrl_c_ends_a_long_loss() -> None:
    # Where the tests run in the background, the signal is ignored until a handler is set.
    code = """
        import signal
        import svbrdf
        signal.signal(signal.SIGINT, signal.default_int_handler)
        ground_truth, prediction, _ = svbrdf.built_in()
        print("started", flush=True)
        try:
            svbrdf.loss(ground_truth, prediction, near=1_000_000, distant=1_000_000)
        except KeyboardInterrupt:
            print("interrupted", flush=True)
    """
    command = [sys.executable, "-c", textwrap.dedent(code)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "started\n"
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        assert process.stdout.readline() == "interrupted\n"
        assert process.wait(60) == 0


def test_progress_is_reported_and_what_it_raises_ends_the_work() -> None:
    ground_truth, prediction, _ = svbrdf.built_in()
    seen: list[tuple[int, int]] = []
    svbrdf.loss(ground_truth, prediction, progress=lambda done, total: seen.append((done, total)))
    assert seen
    assert seen[-1][0] == seen[-1][1] > 0

    class Stop(Exception):  # noqa: N818
        pass

    def stop(done: int, total: int) -> None:
        raise Stop

    with pytest.raises(Stop):
        svbrdf.loss(ground_truth, prediction, near=1_000_000, progress=stop)


def test_a_bar_of_tqdm_shows_the_progress(capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("tqdm")
    ground_truth, prediction, _ = svbrdf.built_in()
    svbrdf.loss(ground_truth, prediction, progress=True)
    assert "rendering" in capsys.readouterr().err


def test_the_interpreter_goes_on_while_a_loss_is_computed() -> None:
    ground_truth, prediction, _ = svbrdf.built_in()
    ended = threading.Event()

    def work() -> None:
        svbrdf.loss(ground_truth, prediction, near=300, distant=300)
        ended.set()

    thread = threading.Thread(target=work)
    thread.start()
    turns = 0
    while not ended.wait(0.001):
        turns += 1
    thread.join()
    assert turns > 10


def of_child(seed: int) -> float:
    ground_truth, prediction, _ = svbrdf.built_in()
    return svbrdf.loss(ground_truth, prediction, seed=seed).results[0].loss


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system cannot fork")
@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
def test_a_forked_process_computes_the_same_loss() -> None:
    expected = [of_child(seed) for seed in (1, 2)]
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map_async(of_child, (1, 2)).get(timeout=120) == expected


def test_reports_are_pickled_and_materials_are_refused() -> None:
    ground_truth, prediction, _ = svbrdf.built_in()
    report = svbrdf.loss(ground_truth, prediction, near=2, distant=2)
    assert pickle.loads(pickle.dumps(report)) == report
    with pytest.raises(TypeError, match="cannot pickle"):
        pickle.dumps(ground_truth)
