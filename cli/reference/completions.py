"""Completion of verbs, options, choices and file names in bash, zsh and fish."""

from __future__ import annotations

from verbs import Option, Program, Verb


def dashed(verb: Verb) -> list[Option]:
    return [option for option in verb.options if option.kind != "argument"]


def bash_completion(program: Program) -> str:
    verbs = " ".join(verb.name for verb in program.verbs)
    return f"""# bash completion of itin, made from `itin --help --json`.
_itin() {{
  local verb=${{COMP_WORDS[1]}} word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} options values
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W "{verbs} --help --version" -- "$word")
    return
  fi
  # Bash takes the = of --option=value for a word.
  if [ "$word" = = ]; then word=; elif [ "$before" = = ]; then before=${{COMP_WORDS[COMP_CWORD - 2]}}; fi
  case "$verb" in
{"".join(bash_options(verb) for verb in program.verbs)}    *) return ;;
  esac
  case "$word" in
    -*) mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word"); return ;;
  esac
  values=
  case "$verb $before" in
{"".join(bash_values(verb) for verb in program.verbs)}  esac
  if [ -n "$values" ]; then
    mapfile -t COMPREPLY < <(compgen -W "$values" -- "$word")
  else
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}}
complete -F _itin itin
"""


def bash_options(verb: Verb) -> str:
    names = " ".join(name for option in dashed(verb) for name in option.names)
    return f'    {verb.name}) options="{names}" ;;\n'


def bash_values(verb: Verb) -> str:
    """Of the options whose values are known: which these are."""
    lines = []
    for option in dashed(verb):
        if option.choices:
            calls = "|".join(f'"{verb.name} {name}"' for name in option.names)
            lines.append(f'    {calls}) values="{" ".join(option.choices)}" ;;\n')
    return "".join(lines)


def zsh_completion(program: Program) -> str:
    verbs = "".join(f"    {zsh_quoted(f'{verb.name}:{verb.summary}')}\n" for verb in program.verbs)
    cases = "".join(f"    {verb.name})\n      _arguments -S \\\n{zsh_arguments(verb)}      ;;\n" for verb in program.verbs)
    return f"""#compdef itin
# zsh completion of itin, made from `itin --help --json`.
_itin() {{
  local -a verbs=(
{verbs}  )
  if (( CURRENT == 2 )); then
    _describe verb verbs
    return
  fi
  shift words
  (( CURRENT-- ))
  case $words[1] in
{cases}  esac
}}
_itin "$@"
"""


def zsh_arguments(verb: Verb) -> str:
    specifications = [zsh_option(option, name) for option in dashed(verb) for name in option.names]
    specifications.append("'*:file:_files'")
    return "".join(
        f"        {specification}{'' if last else ' ' + chr(92)}\n"
        for last, specification in ((s is specifications[-1], s) for s in specifications)
    )


def zsh_option(option: Option, name: str) -> str:
    said = option.help_lines()[0].replace("\\", "\\\\").replace("[", "\\[").replace("]", "\\]").replace(":", "\\:")
    repeated = "*" if option.repeats else ""
    if option.kind == "flag":
        return zsh_quoted(f"{repeated}{name}[{said}]")
    action = f"({' '.join(option.choices)})" if option.choices else "_files" if option.names_files else " "
    value = option.type.replace("[", "").replace("]", "").replace(":", "\\:")
    return zsh_quoted(f"{repeated}{name}[{said}]:{value}:{action}")


def zsh_quoted(text: str) -> str:
    return "'" + text.replace("'", "'\\''") + "'"


def fish_completion(program: Program) -> str:
    lines = ["# fish completion of itin, made from `itin --help --json`.", "complete -c itin -f -n __fish_use_subcommand"]
    for verb in program.verbs:
        said = fish_quoted(verb.summary)
        lines.append(f"complete -c itin -f -n __fish_use_subcommand -a {verb.name} -d {said}")
        lines += [fish_option(verb, option) for option in dashed(verb)]
    return "\n".join(lines) + "\n"


def fish_option(verb: Verb, option: Option) -> str:
    names = " ".join(f"-l {name[2:]}" if name.startswith("--") else f"-s {name[1:]}" for name in option.names)
    value = ""
    if option.kind == "value":
        value = " -r" if option.names_files else " -x"
        if option.choices:
            value += f" -a {fish_quoted(' '.join(option.choices))}"
    condition = fish_quoted(f"__fish_seen_subcommand_from {verb.name}")
    return f"complete -c itin -n {condition} {names}{value} -d {fish_quoted(option.help_lines()[0])}"


def fish_quoted(text: str) -> str:
    return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"
