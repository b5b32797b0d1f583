"""Variants: a chapter's program compiled with other pieces, as `prove` and `mutants` need it by the
hundred. So nothing is compiled that a change does not touch, and nothing twice."""

import functools
import json
import re
import shutil

from workbook import processes
from workbook.build import executable, folder
from workbook.errors import ToolError


def compile_variant(target, label, name, texts):
    """Compiles a student's target of the chapter `label` with other pieces: `texts` maps a piece
    ("02_grid_hash/grid_hash.cuh") to its changed text. The normal targets stay as they are. Returns
    (executable or None, log). What an earlier call made of the same is kept.

    Build its reference before: what includes none of these pieces is linked from there."""
    variant = folder() / "variants" / label / name
    program, log, record = variant / target, variant / "build.log", variant / "made_from"
    commands = _commands_for(variant, target, label, texts)
    made_from = json.dumps([commands, texts])
    if _is_newer(record, executable(f"{target}_reference")) and record.read_text() == made_from:
        return program, log
    shutil.rmtree(variant, ignore_errors=True)
    for path, text in texts.items():
        piece = variant / "pieces" / path
        piece.parent.mkdir(parents=True, exist_ok=True)
        piece.write_text(text)
    for command in commands:
        for output in re.findall(r" -o (\S+)", command):
            (folder() / output).parent.mkdir(parents=True, exist_ok=True)
        if not processes.run_logged(["sh", "-c", command], log, cwd=folder()):
            return None, log
    record.write_text(made_from)
    return program, log


def _is_newer(file, other):
    return (file.exists() and other.exists()
            and file.stat().st_mtime_ns > other.stat().st_mtime_ns)


def _commands_for(variant, target, label, texts):
    """The target's commands, changed so that they make the variant."""
    kept = _untouched(target, frozenset(texts))
    commands = []
    for command in _commands(target):
        if set(re.findall(r" -o (\S+)", command)) & set(kept):
            continue
        for own, reference in kept.items():
            command = command.replace(f" {own} ", f" {reference} ")
        command = command.replace(str(folder() / "pieces" / label), str(variant / "pieces"))
        # Compiled once, run once: with -Og that takes the least time. nvcc does not know it.
        command = command.replace(" -O3 ", " -O1 " if "nvcc" in command else " -Og ")
        command = command.replace(f"CMakeFiles/{target}.dir/", f"{variant}/objects/")
        commands.append(command.replace(f" bin/{target} ", f" {variant}/{target} "))
    return commands


@functools.lru_cache(maxsize=None)
def _untouched(target, pieces):
    """The objects of a target that include none of these pieces -> the reference's, which are the
    same."""
    kept = {}
    for reference, files in _included(f"{target}_reference").items():
        if not any(file.endswith(f"solutions/{piece}") for file in files for piece in pieces):
            kept[reference.replace(f"{target}_reference.dir/", f"{target}.dir/")] = reference
    return kept


@functools.lru_cache(maxsize=None)
def _included(target):
    """What each object of a target itself includes, as Ninja recorded it when it was compiled."""
    objects = re.findall(rf" -o (CMakeFiles/{target}\.dir/\S+)", "\n".join(_listed(target)))
    if not objects:
        return {}
    blocks = [block.splitlines() for block in _ninja("deps", *objects).split("\n\n")]
    return {head.split(": #deps")[0]: [line.strip() for line in files]
            for head, *files in filter(None, blocks) if head.endswith("(VALID)")}


@functools.lru_cache(maxsize=None)
def _commands(target):
    """The commands that compile and link a target itself, without those of its libraries."""
    commands = _listed(target)
    if not commands:
        raise ToolError(f"Ninja knows no commands for {target} in {folder()}")
    return commands


def _listed(target):
    return [line for line in _ninja("commands", target).splitlines()
            if f"CMakeFiles/{target}.dir/" in line]


def _ninja(tool, *arguments):
    """What one of Ninja's tools prints; nothing if it fails."""
    return processes.output_of(["ninja", "-C", str(folder()), "-t", tool, *arguments]) or ""
