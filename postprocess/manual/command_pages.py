"""Write the manual page and the completion for bash of ``ehlwave``, from its parser.

    python postprocess/manual/command_pages.py FOLDER VERSION

Writes FOLDER/ehlwave.1 and FOLDER/ehlwave. Needs the standard library alone.
"""

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

SOURCE = Path(__file__).parents[1] / "src"
STATUS = """\
0   done
2   input that cannot be used, or an output that must not be replaced
3   output that cannot be written"""

COMPLETION = """\
# Completion of ehlwave for bash, made from its parser.
_ehlwave() {{
   local command=${{COMP_WORDS[1]}} before=${{COMP_WORDS[COMP_CWORD-1]}}
   if [ "$COMP_CWORD" = 1 ]; then
      COMPREPLY=($(compgen -W '{commands}' -- "$2"))
      return
   fi
   case $command:$before in
{choices}
   esac
   if [[ $2 != -* ]]; then
      COMPREPLY=($(compgen -f -- "$2"))
      return
   fi
   case $command in
{options}
   esac
}}
complete -o filenames -F _ehlwave ehlwave
"""


def write_pages(folder: Path, version: str) -> tuple[Path, Path]:
    """Write manual page and completion; return their paths."""
    sys.path.insert(0, str(SOURCE))
    from ehlwave.cli import command_parser

    parser = command_parser()
    folder.mkdir(parents=True, exist_ok=True)
    page, completion = folder / "ehlwave.1", folder / "ehlwave"
    page.write_text(man_page(parser, version), encoding="utf-8")
    completion.write_text(completion_of(parser), encoding="utf-8")
    return page, completion


def man_page(parser: argparse.ArgumentParser, version: str) -> str:
    """Return a manual page: the commands, each with its options."""
    first = " ".join((parser.description or "").split()).rstrip(".")
    lines = [
        f'.TH EHLWAVE 1 "" "ehlwave {version}" "User commands"',
        *(".SH NAME", _plain(f"ehlwave - {first[0].lower()}{first[1:]}")),
        *(".SH SYNOPSIS", ".B ehlwave", r"\fICOMMAND\fR [OPTIONS]"),
        ".SH DESCRIPTION",
        "Each command has its own help:",
        ".B ehlwave COMMAND \\-\\-help",
        *_arguments(parser),
    ]
    for name, command in commands(parser).items():
        lines += [f".SH EHLWAVE {_plain(name.upper())}", *_lines(command.description)]
        lines += [".PP", ".nf", *_lines(_usage(command)), ".fi", *_arguments(command)]
        if command.epilog:
            lines += [".PP", ".nf", *_lines(command.epilog), ".fi"]
    status = [".SH EXIT STATUS", ".nf", *_lines(STATUS), ".fi"]
    other = [".SH SEE ALSO", ".BR ehlwave\\-case (1),", ".BR ehlwave\\-sweep (1)"]
    return "\n".join([*lines, *status, *other, ""])


def completion_of(parser: argparse.ArgumentParser) -> str:
    """Return the completion: commands, their options, the choices of options, else files."""
    choices, options = [], []
    for name, command in commands(parser).items():
        words = []
        for action in command._actions:
            words += [word for word in action.option_strings if word.startswith("--")]
            if action.choices and action.option_strings:
                of_option = "|".join(f"{name}:{word}" for word in action.option_strings)
                values = " ".join(map(str, action.choices))
                choices.append(
                    f"      {of_option}) COMPREPLY=($(compgen -W '{values}' -- \"$2\")); return ;;"
                )
        options.append(f"      {name}) COMPREPLY=($(compgen -W '{' '.join(words)}' -- \"$2\")) ;;")
    return COMPLETION.format(
        commands=" ".join([*commands(parser), "--help"]),
        choices="\n".join(choices),
        options="\n".join(options),
    )


def commands(parser: argparse.ArgumentParser) -> dict[str, argparse.ArgumentParser]:
    """Return the parsers of the commands by name."""
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            return dict(action.choices)
    return {}


def _arguments(parser: argparse.ArgumentParser) -> Iterator[str]:
    """Return arguments with their explanations; commands have sections of their own."""
    formatter = argparse.HelpFormatter("")
    for action in parser._actions:
        if action.help == argparse.SUPPRESS or isinstance(action, argparse._SubParsersAction):
            continue
        names = ", ".join(action.option_strings)
        if action.nargs != 0:
            default = action.dest.upper() if names else action.dest
            names = f"{names} {formatter._format_args(action, default)}".strip()
        text = formatter._expand_help(action) if action.help else ""
        yield from (".TP", f".B {_plain(names)}", _plain(text))


def _usage(parser: argparse.ArgumentParser) -> str:
    return parser.format_usage().removeprefix("usage: ")


def _lines(text: str | None) -> list[str]:
    return [_plain(line) for line in (text or "").strip().splitlines()]


def _plain(text: str) -> str:
    """Return text as roff prints it."""
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("\n", " ")
    return f"\\&{text}" if text.startswith((".", "'")) else text


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    write_pages(Path(sys.argv[1]), sys.argv[2])
