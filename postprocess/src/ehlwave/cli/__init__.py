"""The command ``ehlwave``."""

import argparse
import os
import sys
from collections.abc import Sequence

from ehlwave.cli.app import add_app_command
from ehlwave.cli.arguments.cache import add_cache_command
from ehlwave.cli.arguments.deform import add_deform_commands
from ehlwave.cli.arguments.elements import add_element_commands
from ehlwave.cli.arguments.identify import add_identify_command
from ehlwave.cli.arguments.replenish import add_replenish_command
from ehlwave.cli.arguments.results import add_results_commands
from ehlwave.cli.arguments.stress import add_stress_command
from ehlwave.cli.arguments.stribeck import add_stribeck_command
from ehlwave.cli.arguments.traction import add_traction_command
from ehlwave.cli.command_line import Parser, as_options, with_ratio
from ehlwave.cli.named_files import inputs
from ehlwave.cli.terminal import plain_text_only
from ehlwave.errors import ResultsError, printable
from ehlwave.extras import advice, version
from ehlwave.writing import Writer

BAD_INPUT = 2
NOT_WRITTEN = 3
"""Exit statuses, as of the programs."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command.

    Returns
    -------
    int
        0, also when the reader of the output closed it. 2 with a message for unusable input or
        protected files. 3 with a message for output that cannot be written.
    """
    with plain_text_only():
        options = argparse.Namespace()
        try:
            command_parser().parse_args(arguments, options)
            options.writer = Writer(inputs(options), overwrite=getattr(options, "overwrite", False))
            with_ratio(options)
            options.run(options)
            sys.stdout.flush()
        except ResultsError as error:
            return _fail(as_options(str(error), options), BAD_INPUT)
        except ModuleNotFoundError as error:
            if text := advice(error):
                return _fail(text, BAD_INPUT)
            raise
        except MemoryError:
            return _fail("not enough memory for the content of the files", BAD_INPUT)
        except BrokenPipeError:
            # The reader of our output has gone; keep Python from saying so again at exit.
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        except OSError as error:
            return _fail(f"{error.filename or 'output'}: {error.strerror or error}", NOT_WRITTEN)
    return 0


def command_parser() -> argparse.ArgumentParser:
    """Return the parser of all commands; needs the standard library alone."""
    parser = Parser(
        prog="ehlwave",
        description="Films, friction, deformed roughness and stress of lubricated contacts, by "
        "laws or from results of ehlwave-case and ehlwave-sweep",
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="version of this package")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    add_results_commands(commands)
    add_deform_commands(commands)
    add_stress_command(commands)
    add_replenish_command(commands)
    add_identify_command(commands)
    add_traction_command(commands)
    add_stribeck_command(commands)
    add_cache_command(commands)
    add_element_commands(commands)
    add_app_command(commands)
    return parser


def command_names() -> list[str]:
    """Return the names of all commands."""
    choices = (action.choices for action in command_parser()._actions)
    return list(next(found for found in choices if isinstance(found, dict)))


class _Version(argparse.Action):
    """Prints the version, which takes time to find, when it is asked for."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        print(f"ehlwave {version()}")
        parser.exit()


def _fail(text: str, status: int) -> int:
    print(f"ehlwave: error: {printable(text)}", file=sys.stderr)
    return status
