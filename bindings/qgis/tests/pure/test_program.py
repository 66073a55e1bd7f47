"""The program is found, run, heard and stopped; whatever goes wrong is told in its own words."""

from __future__ import annotations

import sys
import time
from pathlib import Path

import pytest
from conftest import PROGRAM, SOURCE

from itin_qgis.program.find import NoProgram, find_program, version_of
from itin_qgis.program.progress import Caution, Error, Progress, Remark, read_line
from itin_qgis.program.run import Cancelled, Failed, run


def program_of(folder: Path, text: str) -> str:
    """Writes a program in Python, and returns its path."""
    path = folder / "program"
    path.write_text(f"#!{sys.executable}\nimport os, signal, sys, time\n{text}")
    path.chmod(0o755)
    return str(path)


def never() -> bool:
    return False


def test_setting_comes_before_path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(Path(PROGRAM).parent))
    assert find_program("  ") == PROGRAM
    other = program_of(tmp_path, "")
    assert find_program(f" {other} ") == other


@pytest.mark.parametrize("setting", ["", "/nowhere/itin", "/etc/passwd"])
def test_without_program_the_remedy_is_told(setting: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "/nowhere")
    with pytest.raises(NoProgram, match="Settings > Options > Processing > Providers > itin"):
        find_program(setting)


def test_version_tells_itin_from_others(tmp_path: Path) -> None:
    assert version_of(PROGRAM).count(".") == 2
    for other in ("print('ls 9.1')", "sys.exit(3)", "print('itin')"):
        with pytest.raises(NoProgram, match="is not itin"):
            version_of(program_of(tmp_path, other))


def test_lines_are_told_apart() -> None:
    assert read_line('{"stage":"writing","share":0.5,"seconds_left":null}') == Progress("writing", 0.5, None)
    assert read_line("itin: warning: half") == Caution("half")
    assert read_line("itin: error: no store") == Error("no store")
    assert read_line('{"stage":') == Remark('{"stage":')


def test_pieces_become_lines(tmp_path: Path) -> None:
    program = program_of(
        tmp_path,
        """
for piece in ('{"stage":"wri', 'ting","share":0.25,"sec', 'onds_left":3}\\nitin: warn', 'ing: caf\\u00e9\\n', 'bye'):
    os.write(2, piece.encode())
    time.sleep(0.05)
print("done")
""",
    )
    heard: list[object] = []
    assert run(program, [], heard.append, never) == "done\n"
    assert heard == [Progress("writing", 0.25, 3), Caution("caf\u00e9"), Remark("bye")]


def test_arguments_arrive_as_they_are(tmp_path: Path) -> None:
    program = program_of(tmp_path, "print(sys.argv[1:])")
    words = ["$(touch x)", "a b", "*", "'", '"', ";", "--title=\u00fc"]
    assert run(program, words, print, never) == f"{words}\n"


def test_much_on_both_streams_does_not_stall(tmp_path: Path) -> None:
    program = program_of(tmp_path, "for i in range(20000): print('x' * 50); print('y' * 50, file=sys.stderr)")
    heard: list[object] = []
    assert len(run(program, [], heard.append, never)) == 20000 * 51
    assert len(heard) == 20000


@pytest.mark.parametrize(
    "text, message",
    [
        ("print('itin: error: hill.tif: row 7', file=sys.stderr); sys.exit(2)", "^hill.tif: row 7$"),
        ("print('out of luck', file=sys.stderr); sys.exit(1)", "^out of luck$"),
        ("sys.exit(3)", "without a word, with status 3"),
        ("os.kill(os.getpid(), signal.SIGSEGV)", "without a word, with status -11"),
    ],
)
def test_failures_are_failures(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(Failed, match=message):
        run(program_of(tmp_path, text), [], lambda said: None, never)


def test_program_that_cannot_be_run_is_a_failure() -> None:
    with pytest.raises(Failed, match="/nowhere/itin cannot be run"):
        run("/nowhere/itin", [], print, never)


@pytest.mark.parametrize("deaf", [False, True])
def test_cancel_is_heard_within_two_seconds(tmp_path: Path, deaf: bool) -> None:
    ignored = "signal.signal(signal.SIGTERM, signal.SIG_IGN)\n" if deaf else ""
    program = program_of(tmp_path, ignored + "print('ready', file=sys.stderr, flush=True)\ntime.sleep(60)")
    heard: list[object] = []
    asked = 0.0

    def cancelled() -> bool:
        nonlocal asked
        if heard and not asked:
            asked = time.monotonic()
        return bool(heard)

    with pytest.raises(Cancelled):
        run(program, [], heard.append, cancelled)
    assert time.monotonic() - asked < 2


def test_cancelled_import_leaves_nothing(tmp_path: Path) -> None:
    heard: list[object] = []
    source = SOURCE / "scripts" / "demo-data" / "cardiff.tif"
    words = ["import", str(tmp_path / "new.itin"), str(source), "--progress=lines"]
    with pytest.raises(Cancelled):
        run(PROGRAM, words, heard.append, lambda: len(heard) > 1)
    assert list(tmp_path.iterdir()) == []


def test_the_programs_own_line_is_told() -> None:
    with pytest.raises(Failed, match="^/nowhere/none.itin: there is no such store"):
        run(PROGRAM, ["info", "/nowhere/none.itin", "--progress=lines"], print, never)
