"""Assessments on Dask: the bytes of one process, whatever the shards, the workers and what is killed."""

import contextlib
import io
import os
import random
import re
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import freestand as fs
import pytest
from conftest import ROOT, program

distributed = pytest.importorskip("distributed", reason="distributed is not installed: pip install 'freestand[dask]'")
from dask import config as dask_config  # noqa: E402
from freestand import dask as fsd  # noqa: E402

# Dask warns of ports and of connections to workers that the tests kill.
pytestmark = pytest.mark.filterwarnings("ignore")

ROWS = 12
#: A few worlds of short motions, and a rigid base alone: seconds in all, also where nothing is optimised.
STUDY = {
    "ground": {"seed": 3, "count": 3},
    "building": {"storeys": 3},
    "worlds": {"first": 2, "most": 4, "shares": False},
    "assessment": {"compliant": False, "pages": 2},
}
LIST = "id,level_ratio,height [m],thickness [m],mass [kg]\n" + "".join(
    f"o{i},{i % 3 / 2},{1 + 0.1 * i:.1f},{0.25 + 0.03 * (i % 7):.2f},80\n" for i in range(ROWS)
)
SAME = ("objects.csv", "objects.parquet", "worlds.csv")


@pytest.fixture(scope="module")
def city(tmp_path_factory):
    """The study and the list as files, and the files of one process."""
    folder = tmp_path_factory.mktemp("city")
    from freestand._convert import toml

    (folder / "city.toml").write_text(toml(STUDY))
    (folder / "city.csv").write_text(LIST)
    result = fs.assess(folder / "city.toml", folder / "city.csv", out=folder / "whole", parquet=True, threads=1)
    return folder, result


@pytest.fixture(scope="module")
def clients():
    """A cluster of processes, as many as wanted; its nannies start killed workers again."""
    # With 0 a single death is reported as a failure, so that the shard is submitted again by assess itself.
    with (
        dask_config.set({"distributed.scheduler.allowed-failures": 0}),
        distributed.LocalCluster(
            n_workers=1, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs=50
        ) as cluster,
        distributed.Client(cluster) as client,
    ):

        def of(workers):
            cluster.scale(workers)
            deadline = time.monotonic() + 60
            while len(client.scheduler_info(n_workers=-1)["workers"]) != workers and time.monotonic() < deadline:
                time.sleep(0.05)
            return client

        yield of


def assert_same(city, out, result):
    folder, whole = city
    for name in SAME:
        assert (out / name).read_bytes() == (folder / "whole" / name).read_bytes(), name
    assert result.to_dict()["rows"] == whole.to_dict()["rows"] and len(result.objects) == ROWS
    assert not out.with_name(out.name + "-plan").exists(), "the plan is left"


def children(plan):
    """The processes that calculate shards of a plan, by their command lines."""
    found = {}
    for one in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            words = (one / "cmdline").read_bytes().split(b"\0")
            # The small process before it has the words of the program after its own.
            if words[1:4] == [b"shard", b"run", str(plan).encode()]:
                found[int(one.name)] = int(words[5])
    return found


def is_running(pid):
    with contextlib.suppress(OSError):
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    return False


def waited(condition, seconds=30):
    deadline = time.monotonic() + seconds
    while not condition() and time.monotonic() < deadline:
        time.sleep(0.02)
    return condition()


# 64: more than there are objects.
@pytest.mark.parametrize(
    ("workers", "shards"),
    [(1, 1), pytest.param(2, 7, marks=pytest.mark.long), pytest.param(2, 64, marks=pytest.mark.long), pytest.param(4, None, marks=pytest.mark.long)],
)
def test_the_files_are_those_of_one_process(city, clients, tmp_path, workers, shards):
    folder, _ = city
    out = tmp_path / "out"
    result = fsd.assess(folder / "city.toml", folder / "city.csv", out=out, shards=shards, client=clients(workers))
    assert_same(city, out, result)
    assert not children(f"{out}-plan")


@pytest.mark.long
def test_tables_and_dictionaries_without_a_cluster(city, tmp_path, monkeypatch):
    """A local worker is made where there is no client; a study in memory finds files as fs.assess does."""
    pandas = pytest.importorskip("pandas")
    folder, _ = city
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(distributed, "default_client", lambda: (_ for _ in ()).throw(ValueError("no client")))
    frame = pandas.read_csv(folder / "city.csv")
    expected = fs.assess(STUDY, frame, out=tmp_path / "whole", parquet=True, seed=11, threads=1)
    result = fsd.assess(STUDY, frame, out="out", seed=11, shards=2, threads=2)
    for name in SAME:
        assert (tmp_path / "out" / name).read_bytes() == (tmp_path / "whole" / name).read_bytes(), name
    # Neither the built-in study nor the name of a temporary file.
    assert b'"Study":"given as text"' in (tmp_path / "out" / "objects.parquet").read_bytes()
    assert result.warnings == expected.warnings
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out", "whole"], "a file is left"


@pytest.mark.skipif(sys.platform != "linux", reason="looks for processes in /proc")
@pytest.mark.parametrize("victim", [pytest.param("worker", marks=pytest.mark.long), pytest.param("child", marks=pytest.mark.long)])
def test_what_is_killed_is_calculated_again(city, clients, tmp_path, victim):
    """SIGKILL at a random moment to a process that calculates a shard, or to its worker."""
    folder, _ = city
    client = clients(2)
    seed = int(os.environ.get("FREESTAND_TEST_SEED", random.SystemRandom().randrange(10**6)))
    print(f"FREESTAND_TEST_SEED={seed}")
    delay = random.Random(seed).uniform(0, 0.15)
    out = tmp_path / "out"
    plan = f"{out}-plan"
    before = {info["pid"] for info in client.run(lambda: {"pid": os.getpid()}).values()}
    killed = []

    def kill():
        deadline = time.monotonic() + 60
        wait = delay
        while not killed and time.monotonic() < deadline:
            for child in children(plan):
                time.sleep(wait)
                # Whoever was finished first was waited for too long.
                wait /= 2
                with contextlib.suppress(OSError, IndexError):
                    parent = int(Path(f"/proc/{child}/stat").read_text().rsplit(")", 1)[1].split()[1])
                    os.kill(parent if victim == "worker" else child, signal.SIGKILL)
                    killed.append(child)
                    if victim == "worker":
                        killed.append(waited(lambda: child not in children(plan)))
                    return
            time.sleep(0.002)

    killer = threading.Thread(target=kill)
    killer.start()
    result = fsd.assess(folder / "city.toml", folder / "city.csv", out=out, shards=ROWS, client=client)
    killer.join()
    assert killed, "all shards were finished before one could be killed"
    assert_same(city, out, result)
    assert list(result.objects["id"]) == [f"o{i}" for i in range(ROWS)]
    if victim == "worker":
        assert killed[1:] == [True], "the child outlived its worker"
        assert {info["pid"] for info in client.run(lambda: {"pid": os.getpid()}).values()} != before


@pytest.mark.long
def test_a_shard_that_always_fails_is_named(city, clients, tmp_path, caplog):
    folder, _ = city
    out, plan = tmp_path / "out", tmp_path / "out-plan"
    city_files = [folder / "city.toml", "--inventory", folder / "city.csv"]
    arguments = ["shard", "plan", *city_files, "--shards", "4", "--out", plan]
    subprocess.run([program(), *map(str, arguments)], check=True, capture_output=True)
    rows = plan / "in" / "00002.jsonl"
    kept = rows.read_bytes()
    rows.write_bytes(kept.replace(b"o7", b"p7"))
    assert rows.read_bytes() != kept
    with pytest.raises(fs.SolveError, match="shard 2 failed 3 times: .*00002.jsonl") as caught:
        fsd.assess(folder / "city.toml", folder / "city.csv", out=out, client=clients(2), retries=3)
    assert len(caught.value.problems) == 1 and "same arguments" in caught.value.hint
    said = [record.getMessage().partition(":")[0] for record in caplog.records if record.name == "freestand.dask"]
    assert said == [f"shard 2 failed ({i} of 3)" for i in (1, 2, 3)]
    assert not out.exists()
    # The others are finished, and are not calculated again.
    finished = {path: path.stat().st_mtime_ns for path in (plan / "out").glob("*.json")}
    assert [path.stem for path in sorted(finished)] == ["00000", "00001", "00003"]
    rows.write_bytes(kept)
    merge = fsd._merge

    def merged(plan, target, is_recalled):
        assert all(path.stat().st_mtime_ns == time for path, time in finished.items())
        return merge(plan, target, is_recalled)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(fsd, "_merge", merged)
        assert_same(city, out, fsd.assess(folder / "city.toml", folder / "city.csv", out=out, client=clients(2)))


@contextlib.contextmanager
def another_program(client, path):
    """The workers call another program for a while."""

    def become(path):
        import freestand.dask as module

        if path is None:
            module._program = module.__dict__.pop("_program_of_the_wheel")
        else:
            module._program_of_the_wheel = module._program
            module._program = lambda: path

    client.run(become, str(path))
    try:
        yield
    finally:
        client.run(become, None)


def test_a_worker_without_the_program_is_named(city, clients, tmp_path):
    folder, _ = city
    client = clients(2)
    with another_program(client, sys.executable):
        with pytest.raises(fs.SolveError, match="worker tcp://.*: it has Python .*, not freestand") as caught:
            fsd.assess(folder / "city.toml", folder / "city.csv", out=tmp_path / "out", client=client)
    assert len(caught.value.problems) == 2 and "freestand[dask]" in caught.value.hint
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("wrong", "match"),
    [
        ({"shards": 0}, "^shards must be"),
        ({"shards": 2.5}, "^shards must be"),
        ({"shards": 200_000}, "^shards must be"),
        ({"shards": 10**9}, "^shards must be"),
        ({"retries": 0}, "^retries must be"),
        ({"threads": True}, "^threads must be"),
        ({"seed": -1}, "^seed must be"),
        ({"seed": 2**70}, "^seed must be"),
        ({"client": "tcp://127.0.0.1:8786"}, "^client must be"),
        ({"allow_recalled": 1}, "^allow_recalled must be True or False"),
        ({"out": None}, "^out must be"),
        ({"out": "used"}, "^out: "),
        ({"out": "edited"}, "^out: .*objects.csv was changed"),
        ({"study": 7}, "^study cannot be"),
        ({"study": "nothing.toml"}, "nothing.toml"),
        ({"study": "[building]\nstorey = 8\n"}, "^study:2: unknown key storey"),
        ({"inventory": 7}, "inventory cannot be"),
        ({"inventory": "nothing.csv"}, "nothing.csv"),
    ],
)
def test_a_wrong_argument_is_named_and_nothing_is_written(clients, tmp_path, monkeypatch, wrong, match):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "city.csv").write_text(LIST)
    (tmp_path / "used").mkdir()
    (tmp_path / "used" / "mine.txt").write_text("mine")
    (tmp_path / "edited").mkdir()
    (tmp_path / "edited" / "objects.csv").write_text("id,mine\n")
    (tmp_path / "edited" / "manifest.json").write_text('{"files_sha256": {"objects.csv": "00", "gone.csv": "00"}}')
    arguments = {"study": STUDY, "inventory": "city.csv", "out": "out", "client": clients(2), **wrong}
    with pytest.raises((fs.BadValue, fs.StudyError, fs.ReadError), match=match) as caught:
        fsd.assess(**arguments)
    assert caught.value.hint
    # Only what is in a file is not an error of the call.
    kinds = {"nothing.toml": fs.StudyError, "^study:2: unknown key storey": fs.StudyError, "nothing.csv": fs.ReadError}
    assert type(caught.value) is kinds.get(match, fs.BadValue)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["city.csv", "edited", "used"]


def test_without_dask_the_error_says_what_to_install():
    code = "import sys; sys.modules['distributed'] = None\nimport freestand\nimport freestand.dask"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    expected = 'ImportError: freestand.dask needs Dask: pip install "freestand[dask]"'
    assert done.returncode == 1 and expected in done.stderr


@pytest.mark.skipif(sys.platform != "linux", reason="looks for processes in /proc")
def test_a_shard_that_nobody_waits_for_stops(clients, tmp_path):
    client, noted = clients(1), tmp_path / "pid"
    endless = tmp_path / "freestand"
    endless.write_text(f"#!/bin/sh\necho $$ > {noted}\nexec sleep 300\n")
    endless.chmod(0o755)
    with another_program(client, endless):
        future = client.submit(fsd._shard, str(tmp_path), 0, 1, "endless", key="endless")
        assert waited(lambda: noted.exists() and noted.read_text().strip())
        pid = int(noted.read_text())
        assert is_running(pid)
        future.cancel()
        assert waited(lambda: not is_running(pid))


def test_the_job_script_is_the_one_of_the_page():
    pytest.importorskip("dask_jobqueue", reason="dask-jobqueue is not installed")
    page = (ROOT / "docs" / "dask.md").read_text(encoding="utf-8")
    (code,) = re.findall(r"```python slurm\n(.*?)```", page, re.S)
    (expected,) = re.findall(r"```text slurm\n(.*?)```", page, re.S)
    names, output = {}, io.StringIO()
    with dask_config.set({"distributed.scheduler.dashboard.status": {}}), contextlib.redirect_stdout(output):
        exec(code, names)
    names["cluster"].close()
    script = output.getvalue().splitlines()
    assert [line for line in script if line.startswith("#SBATCH")] == expected.splitlines()
    assert any("--nthreads 8" in line and "--lifetime 230m" in line for line in script)
