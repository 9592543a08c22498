"""An assessment on the workers of a Dask cluster (the extra `dask`).

    from dask.distributed import Client
    from freestand.dask import assess
    result = assess("city.toml", inventory="city.csv", out="/shared/out", client=Client(scheduler_file="…"))

The files are those of `freestand.assess`, byte for byte: docs/dask.md.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import logging
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import uuid
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

try:
    import distributed
except ImportError as error:
    raise ImportError('freestand.dask needs Dask: pip install "freestand[dask]"') from error

from ._convert import PathLike, bad, warn
from ._convert import inventory as as_file
from ._convert import study as study_given
from ._convert import MAX_THREADS, flag, whole
from ._errors import FreestandError, Interrupted, ReadError, SolveError, StudyError
from ._results import AssessResult, version

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["assess"]

#: Shards for each thread of the workers: several, so that none waits long for the last shard.
SHARDS_PER_THREAD = 4
#: Objects below which a shard spends a noticeable part of its time on its start.
OBJECTS_PER_SHARD = 200
#: Most shards of a plan, and the largest seed: those of the command.
MAX_SHARDS = 100_000
MAX_SEED = 2**63 - 1
#: Failed shards that an error lists.
LISTED = 20
#: Seconds between two looks at whether a shard is still wanted.
LOOK_S = 0.5
#: Seconds that a shard has to stop when it is asked to.
PATIENCE_S = 10

_log = logging.getLogger("freestand.dask")


def assess(
    study: PathLike | Mapping[str, Any] | None = None,
    inventory: Any = None,
    *,
    out: PathLike,
    seed: int | None = None,
    shards: int | None = None,
    client: Any = None,
    retries: int = 5,
    threads: int | None = None,
    allow_recalled: bool = False,
) -> AssessResult:
    """Which objects of an inventory must be restrained, calculated by the workers of a Dask cluster.

    `study` and `inventory` are as in `freestand.assess`. The files in `out` are the same as its files, with
    objects.parquet. The folder `out` and `<out>-plan` next to it must be on a file system that this process
    and all workers access under the same path. `client` is a `distributed.Client`: by default the current
    one, or else one with a local worker. Each thread of a worker calculates one shard at a time, in a child
    process with `threads` threads (default 1). `shards`: by default 4 for each thread of the workers that
    are connected now, each of at least 200 objects. A shard that fails is calculated again; after `retries` failures
    it is reported, when the other shards are finished. `allow_recalled` is as in `freestand.assess`. Call the
    function again with the same arguments to continue: finished shards are kept in `<out>-plan`, which is removed
    at the end.
    """
    target = _folder(out)
    plan = target.with_name(target.name + "-plan")
    shards = whole("shards", shards, 1, MAX_SHARDS)
    threads = whole("threads", threads, 1, MAX_THREADS) or 1
    retries = whole("retries", retries, 1) or 1
    seed = whole("seed", seed, 0, MAX_SEED)
    is_recalled = bool(flag("allow_recalled", allow_recalled))
    _check_list(inventory)
    with _client(client) as client:
        with _study_file(study) as study_path, as_file(inventory) as listed:
            shards = _plan(plan, study_path, listed.path, seed, shards, client)
        _check_workers(client, plan)
        _run_all(client, plan, shards, threads, retries)
    result = AssessResult._of(listed.named(_merge(plan, target, is_recalled)))
    result._in(target, None)
    # The results contain all that the shards wrote.
    shutil.rmtree(plan, ignore_errors=True)
    warn(result.warnings)
    return result


def _check_list(inventory: Any) -> None:
    """A missing file is an error of reading, as in `freestand.assess`, not one of the study."""
    if isinstance(inventory, str | os.PathLike) and not os.path.exists(inventory):
        path = os.fspath(inventory)
        raise ReadError([("there is no such file", path, None, "check the path and its permissions")])


def _folder(out: Any) -> Path:
    if not isinstance(out, str | os.PathLike) or not os.fspath(out):
        raise bad(f"out must be the path of a folder, not {out!r}", "name a folder that all workers can access")
    target = Path(os.path.abspath(os.fspath(out)))
    # The merge would refuse it too, but only after all the work.
    is_used = target.exists() and not (target / "manifest.json").is_file()
    if is_used and (not target.is_dir() or any(target.iterdir())):
        raise bad(f"out: {target} is not an empty folder or one that freestand wrote", "name a new folder")
    changed = _changed(target)
    if changed:
        raise bad(f"out: {changed} was changed after freestand wrote it", "move it away, or name another folder")
    return target


def _changed(target: Path) -> Path | None:
    """A file of an earlier assessment that is not as it was written."""
    try:
        listed = json.loads((target / "manifest.json").read_text(encoding="utf-8"))["files_sha256"]
    except (OSError, ValueError, KeyError, TypeError):
        return None
    for name, written in dict(listed).items():
        path: Path = target / str(name)
        found = hashlib.sha256()
        with contextlib.suppress(FileNotFoundError), path.open("rb") as file:
            for part in iter(lambda: file.read(1 << 20), b""):
                found.update(part)
            if found.hexdigest() != written:
                return path
    return None


@contextlib.contextmanager
def _client(client: Any) -> Iterator[Any]:
    """The client that was given, the current one, or one with a local worker for as long as it is needed."""
    if client is None:
        with contextlib.suppress(ValueError):
            client = distributed.default_client()
    if client is None:
        threads = os.cpu_count() or 1
        local = distributed.Client(processes=False, n_workers=1, threads_per_worker=threads, dashboard_address=":0")
        with local:
            yield local
        return
    if not isinstance(client, distributed.Client) or client.asynchronous:
        kind = "an asynchronous client" if isinstance(client, distributed.Client) else f"a {type(client).__name__}"
        raise bad(f"client must be a distributed.Client, not {kind}", "make one: Client(cluster) or Client(address)")
    yield client


@contextlib.contextmanager
def _study_file(study: Any) -> Iterator[str | None]:
    """A study as a file. Paths in a text are relative to the current folder, so its file is written there."""
    source = study_given(study)
    if "study_text" not in source:
        yield source.get("study")
        return
    path = Path.cwd() / f".freestand-study-{uuid.uuid4().hex[:8]}.toml"
    try:
        path.write_text(source["study_text"], encoding="utf-8")
    except OSError as error:
        hint = "change to a folder that you may write, or write the study to a file and give its path"
        raise bad(f"study: the current folder cannot hold its text: {error}", hint) from None
    # Files that begin so are shown as a study that was given as text (freestand-report, assessment/head.rs).
    try:
        yield str(path)
    except StudyError as error:
        shown = [one._replace(message=one.message.replace(str(path), "study")) for one in error.problems]
        raise StudyError(shown) from None
    finally:
        path.unlink(missing_ok=True)


def _plan(
    plan: Path, study: str | None, inventory: str | None, seed: int | None, shards: int | None, client: Any
) -> int:
    """Writes the folder of the plan, and returns its number of shards."""
    arguments = ["shard", "plan", *([] if study is None else [study]), "--out", str(plan)]
    arguments += [] if inventory is None else ["--inventory", inventory]
    arguments += [] if seed is None else ["--seed", str(seed)]

    def planned(count: int) -> dict[str, Any]:
        done = _call([*arguments, "--shards", str(count)])
        found: dict[str, Any] = _document(done, StudyError, (0, 1), "the assessment cannot be planned")
        return found

    if shards is not None:
        return int(planned(shards)["shards"])
    # A cluster may have grown since a plan was made that is to be continued.
    with contextlib.suppress(OSError, ValueError, KeyError):
        earlier = json.loads((plan / "plan.json").read_text(encoding="utf-8"))
        return int(planned(int(earlier["shards"]))["shards"])
    wanted = SHARDS_PER_THREAD * max(1, int(sum(client.nthreads().values())))
    made = planned(wanted)
    most = max(1, int(made["rows"]) // OBJECTS_PER_SHARD)
    if wanted <= most:
        return wanted
    # A short list, which costs little to plan again.
    shutil.rmtree(plan)
    return int(planned(most)["shards"])


def _check_workers(client: Any, plan: Path) -> None:
    """Fails before the work where a worker cannot do it; workers that come later are not asked."""
    found: dict[str, Any] = client.run(_trouble, str(plan), version(), on_error="return")
    wrong = [(address, trouble) for address, trouble in sorted(found.items()) if trouble is not None]
    if wrong:
        hint = 'each worker needs pip install "freestand[dask]" of this version, and the folder under the same path'
        raise SolveError([(f"worker {address}: {trouble}", None, None, hint) for address, trouble in wrong[:LISTED]])


def _trouble(plan: str, expected: str) -> str | None:
    """On a worker: why it cannot calculate shards of this plan; None if it can."""
    try:
        done = _call(["--version"])
    except FreestandError as error:
        return error.problems[0].message
    first = done.stdout.partition("\n")[0].strip()
    if first != f"freestand {expected}":
        return f"it has {first or 'a program that does not run'}, not freestand {expected}"
    return None if Path(plan, "plan.json").is_file() else f"it cannot access {plan}"


def _run_all(client: Any, plan: Path, shards: int, threads: int, retries: int) -> None:
    """Calculates all shards; those that fail are repeated, and named at the end if they fail too often."""
    run = uuid.uuid4().hex[:8]
    failures: dict[int, int] = {}
    failed: dict[int, str] = {}
    shard_of: dict[Any, int] = {}

    def submit(index: int) -> Any:
        key = f"freestand-shard-{index:05}-{run}-{failures.get(index, 0)}"
        future = client.submit(_shard, str(plan), index, threads, key, key=key, pure=False)
        shard_of[future] = index
        return future

    try:
        running = distributed.as_completed([submit(index) for index in range(shards)])
        for future in running:
            index = shard_of.pop(future)
            if future.status == "finished":
                _log.info("shard %d is finished: %s", index, future.result())
                continue
            message = _message(future)
            failures[index] = failures.get(index, 0) + 1
            _log.warning("shard %d failed (%d of %d): %s", index, failures[index], retries, message)
            if failures[index] < retries:
                running.add(submit(index))
            else:
                failed[index] = message
    except KeyboardInterrupt:
        raise Interrupted([("the assessment was interrupted", None, None, _KEPT.format(plan=plan))]) from None
    finally:
        # Nothing is left of them, unless the loop was left early.
        client.cancel(list(shard_of))
    if failed:
        times = "once" if retries == 1 else f"{retries} times"
        listed = sorted(failed.items())[:LISTED]
        problems = [f"shard {index} failed {times}: {message}" for index, message in listed]
        problems += [f"{len(failed) - LISTED} more shards failed"] if len(failed) > LISTED else []
        raise SolveError([(text, None, None, _KEPT.format(plan=plan)) for text in problems])


_KEPT = "finished shards are kept in {plan}: call assess again with the same arguments to continue"


def _message(future: Any) -> str:
    """Why a shard failed, on one line."""
    if future.status == "cancelled":
        return "Dask cancelled it: the scheduler was restarted or lost it"
    error = future.exception()
    if isinstance(error, distributed.KilledWorker):
        return "the workers that calculated it died; look for the limits of memory and time in their logs"
    text = str(error) if isinstance(error, FreestandError) else f"{type(error).__name__}: {error}"
    return " ".join(text.split())


def _shard(plan: str, index: int, threads: int, key: str) -> dict[str, Any]:
    """On a worker: calculates a shard in a child process."""

    def is_wanted() -> bool:
        with contextlib.suppress(ValueError):
            task = distributed.get_worker().state.tasks.get(key)
            return task is not None and task.state != "cancelled"
        return True

    done = _call(["shard", "run", plan, "--shard", str(index), "--threads", str(threads)], is_wanted)
    report = _document(done, SolveError, (0,), f"shard {index} was not calculated")
    return {name: report[name] for name in ("index", "rows", "sha256", "seconds")}


def _merge(plan: Path, out: Path, is_recalled: bool) -> str:
    recalled = ["--allow-recalled"] if is_recalled else []
    done = _call(["shard", "merge", str(plan), "--out", str(out), *recalled])
    document = _document(done, SolveError, (0, 1), "the shards cannot be merged")
    if "missing" in document:
        text = f"the results of shards {document['missing'][:LISTED]} disappeared before the merge"
        raise SolveError([(text, str(plan), None, "call assess again with the same arguments")])
    return done.stdout


def _program() -> str:
    """The command that the wheel puts into the folder of Python."""
    name = "freestand.exe" if sys.platform == "win32" else "freestand"
    for folder in (os.path.dirname(sys.executable), sysconfig.get_path("scripts")):
        if os.access(os.path.join(folder, name), os.X_OK):
            return os.path.join(folder, name)
    found = shutil.which(name)
    if found is None:
        message = f"the program {name} is neither in the folder of {sys.executable} nor on PATH"
        raise SolveError([(message, None, None, 'pip install "freestand[dask]" in the environment of the worker')])
    return found


# Linux then ends a child as soon as its parent has died. Setting this between fork and exec in a process with
# threads is not safe, so that a small process sets it and becomes the program.
_DIES_WITH_PARENT = """\
import ctypes, os, sys
ctypes.CDLL(None).prctl(1, 9)  # PR_SET_PDEATHSIG, SIGKILL
if os.getppid() == int(sys.argv[1]):
    os.execv(sys.argv[2], sys.argv[2:])
"""


def _call(arguments: list[str], is_wanted: Any = None) -> subprocess.CompletedProcess[str]:
    """Runs a command to its end in a child process, which dies with this one on Linux.

    The thread that calls this must live as long as the child, as it does: it waits.
    """
    command = [_program(), *arguments] + ([] if arguments == ["--version"] else ["--json", "--quiet"])
    if sys.platform == "linux":
        command = [sys.executable, "-I", "-S", "-c", _DIES_WITH_PARENT, str(os.getpid()), *command]
    with subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8"
    ) as child:
        looks_since_stop = 0
        while True:
            try:
                stdout, stderr = child.communicate(timeout=LOOK_S)
                return subprocess.CompletedProcess(arguments, child.returncode, stdout, stderr)
            except subprocess.TimeoutExpired:
                if is_wanted is None or (looks_since_stop == 0 and is_wanted()):
                    continue
                # SIGTERM first: the program stops at its next look and removes temporary files.
                if looks_since_stop == 0:
                    child.terminate()
                elif looks_since_stop * LOOK_S >= PATIENCE_S:
                    child.kill()
                looks_since_stop += 1
            except BaseException:
                child.terminate()
                raise


def _document(
    done: subprocess.CompletedProcess[str], kind: type[FreestandError], good: tuple[int, ...], what: str
) -> dict[str, Any]:
    """The document of a command, or its error."""
    if done.returncode in good:
        with contextlib.suppress(ValueError):
            found: dict[str, Any] = json.loads(done.stdout)
            return found
    problems: list[tuple[str, None, None, str | None]] = []
    for line in done.stderr.splitlines():
        if line.startswith("error: "):
            problems.append((_as_argument(line.removeprefix("error: ")), None, None, None))
        elif line.startswith("hint: ") and problems:
            problems[-1] = (problems[-1][0], None, None, _as_argument(line.removeprefix("hint: ")))
    if not problems:
        signal = f"signal {-done.returncode} ended the program" if done.returncode < 0 else ""
        said = done.stderr.strip().splitlines()[-1:] or [f"exit status {done.returncode}"]
        problems = [(f"{what}: {signal or said[0]}", None, None, None)]
    raise kind(problems)


def _as_argument(text: str) -> str:
    """Flags as a user of Python writes them."""
    return re.sub(r"(?<![\w-])--([a-z][a-z-]*)", lambda found: found[1].replace("-", "_"), text)
