"""./ballpit: finds the command and runs it. What goes wrong ends as one line and an exit code."""

import sys

if sys.version_info < (3, 10):
    sys.exit("error: Python 3.10 or newer is needed, this is " + sys.version.split()[0])

import argparse
import difflib
import importlib
import signal

from workbook import build
from workbook.errors import BAD_INPUT, FAILED, INTERRUPTED, InputError, ToolError

MODULES = ["progress", "checking", "reading", "running", "maps", "chart", "plans", "doctor",
           "proving", "generating", "videos"]

ABOUT = "Build a GPU collision engine, chapter by chapter. Start with chapters/README.md."

ENDING = """Options for all commands:
  --cpu, --cuda   build without or with CUDA (default: with, if nvcc and a GPU are present)
  --no-install    do not install packages; stop if a tool is missing

What `demo`, `test`, `bench` and `run` do not know goes to the program: `./ballpit demo --help`.
Exit codes: 0 done or CORRECT, 1 failed, 2 bad input or something missing, 3 a body stopped being
finite, 10 TODO, 11 DOES NOT BUILD, 12 CUDA ERROR, 13 WRONG, 14 RACY, 130 interrupted.
"""


class Parser(argparse.ArgumentParser):
    """Its errors are one line, as all of ours."""

    def __init__(self, **options):
        super().__init__(allow_abbrev=False, **options)

    def error(self, message):
        raise InputError(f"{message} (see {self.prog} --help)")


def make_parser():
    """The parser, and the commands by name."""
    parser = Parser(prog="./ballpit", description=ABOUT, epilog=ENDING,
                    formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(metavar="COMMAND", title="commands")
    for name in MODULES:
        importlib.import_module(f"workbook.{name}").register(commands)
    help_command = commands.add_parser("help", help="this text")
    help_command.set_defaults(run=lambda args: parser.print_help() or 0)
    return parser, commands.choices


def take_machine(arguments):
    """--cpu, --cuda and --no-install (which `ballpit` has obeyed) may stand anywhere. Returns the
    other arguments."""
    asked = {argument for argument in arguments if argument in ("--cpu", "--cuda")}
    if len(asked) == 2:
        raise InputError("--cpu and --cuda exclude each other")
    if asked:
        build.use_machine(asked.pop()[2:])
    ours = ("--cpu", "--cuda", "--no-install")
    return [argument for argument in arguments if argument not in ours]


def run(arguments):
    arguments = take_machine(arguments) or ["status"]
    parser, known = make_parser()
    command = arguments[0]
    if command not in known and not command.startswith("-"):
        near = difflib.get_close_matches(command, known, 1)
        guess = f"did you mean {near[0]}?" if near else f"known are {', '.join(known)}"
        raise InputError(f"unknown command '{command}': {guess}")
    args, further = parser.parse_known_args(arguments)
    if further and not getattr(args, "passes_on", False):
        raise InputError(f"unknown argument '{further[0]}' (see ./ballpit {command} --help)")
    if "run" not in args:
        raise InputError(f"a command is missing before '{command}' (see ./ballpit help)")
    args.further = further
    return args.run(args)


def main():
    # Children live in sessions of their own, so a closed terminal must be passed on by us, too.
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.default_int_handler)
    try:
        code = run(sys.argv[1:])
        sys.stdout.flush()
        return code
    except InputError as error:
        problem, code = f"error: {error}", BAD_INPUT
    except ToolError as error:
        problem, code = f"error: {error}", FAILED
    except KeyboardInterrupt:
        problem, code = "interrupted", INTERRUPTED
    except BrokenPipeError:
        # The reader (`| head`) has seen enough. Python would complain once more when it closes.
        sys.stdout = None
        return 0
    print(problem, file=sys.stderr)
    return code


if __name__ == "__main__":
    sys.exit(main())
