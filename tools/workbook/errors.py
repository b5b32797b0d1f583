"""How a command ends: one error line and an exit code (docs/authoring.md, "Verdicts")."""

FAILED, BAD_INPUT, INTERRUPTED = 1, 2, 130


class InputError(Exception):
    """The user asked for something that cannot be done, or something is missing: exit code 2."""


class ToolError(Exception):
    """Our own tools failed: exit code 1."""
