"""What is made from `itin --help --json`: manual pages, completion, and the reference of the site."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import completions
import man_pages
import pytest
import reference_pages
import verbs


def test_every_group_has_a_name(program: verbs.Program) -> None:
    """Options that a verb only knows in order to refuse them are not listed."""
    assert all(group.name for verb in program.verbs for group in verb.groups)


def test_manual_pages_have_every_option(program: verbs.Program) -> None:
    pages = man_pages.man_pages(program)
    for verb in program.verbs:
        page = pages[f"itin-{verb.name}.1"]
        assert all(man_pages.escaped(name) in page for option in verb.options for name in option.names)
        assert f"itin\\-{verb.name}" in pages["itin.1"]


def test_manual_pages_are_sound(program: verbs.Program) -> None:
    if not shutil.which("groff"):
        pytest.skip("there is no groff")
    for name, page in man_pages.man_pages(program).items():
        done = subprocess.run(
            ["groff", "-man", "-Tutf8", "-ww", "-z"], input=page, capture_output=True, text=True, check=True
        )
        assert done.stderr == "", name


def test_reference_has_an_anchor_for_every_option(program: verbs.Program) -> None:
    pages = reference_pages.reference_pages(program)
    for verb in program.verbs:
        assert all(f'<dt id="{option.name}">' in pages[f"{verb.name}.md"] for option in verb.options)


@pytest.mark.parametrize(
    "words, completed",
    [
        (["view"], ["viewshed"]),
        (["viewshed", "hills.itin", "--obs"], ["--observer", "--observer-name", "--observers", "--observer-height", "--observer-absolute", "--observer-on"]),
        (["viewshed", "--mode", "ce"], ["certified"]),
        (["viewshed", "--mode", "=", "ce"], ["certified"]),
        (["los", "hi"], ["hills.itin"]),
        (["nothing", ""], []),
    ],
)
def test_bash_completes(program: verbs.Program, tmp_path: Path, words: list[str], completed: list[str]) -> None:
    (tmp_path / "hills.itin").touch()
    (tmp_path / "itin.bash").write_text(completions.bash_completion(program))
    listed = " ".join(f"'{word}'" for word in ["itin", *words])
    script = f"""
    . ./itin.bash; COMP_WORDS=({listed}); COMP_CWORD={len(words)}; _itin; printf '%s\\n' "${{COMPREPLY[@]}}"
    """
    done = subprocess.run(["bash", "-c", script], cwd=tmp_path, capture_output=True, text=True, check=True)
    assert done.stderr == ""
    assert done.stdout.split() == completed


def test_zsh_reads_its_completion(program: verbs.Program, tmp_path: Path) -> None:
    if not shutil.which("zsh"):
        pytest.skip("there is no zsh")
    (tmp_path / "_itin").write_text(completions.zsh_completion(program))
    subprocess.run(["zsh", "-n", tmp_path / "_itin"], check=True)


def test_fish_completes(program: verbs.Program, tmp_path: Path) -> None:
    if not shutil.which("fish"):
        pytest.skip("there is no fish")
    (tmp_path / "itin.fish").write_text(completions.fish_completion(program))
    script = f"source {tmp_path}/itin.fish; complete -C 'itin viewshed --mode cert'"
    done = subprocess.run(["fish", "--no-config", "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.startswith("certified")
