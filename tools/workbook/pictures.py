"""A lesson's pictures: SVG drawn from the executable's JSON, PNG made by executables."""

import argparse
import functools
import importlib.util
import sys
import tempfile
from pathlib import Path

from workbook import blocks, checking, doctor, mutants, png, proving, reference
from workbook.chapters import ROOT
from workbook.errors import ToolError


def script_of(chapter):
    """tools/figures/figures_NN.py as a module, or None if the chapter has none."""
    path = ROOT / "tools" / "figures" / f"figures_{chapter.label}.py"
    if not path.exists():
        return None
    if str(path.parent) not in sys.path:
        sys.path.insert(0, str(path.parent))  # for figure.py
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        raise ToolError(f"tools/figures/{path.name}: {type(error).__name__}: {error}") from None
    return module


def drawings(chapter):
    """What the chapter's script draws: name -> function."""
    return getattr(script_of(chapter), "FIGURES", {})


def photographs(chapter):
    """What the chapter's executable renders: name -> its arguments."""
    return getattr(script_of(chapter), "PICTURES", {})


def mistakes_are_rendered(chapter):
    """Whether OpenGL draws the pictures of the chapter's mistakes, too: drivers differ a little."""
    return getattr(script_of(chapter), "MISTAKES_ARE_RENDERED", False)


def expected_names(chapter):
    """The files that belong into the chapter's figures folder."""
    return ({f"{name}.svg" for name in drawings(chapter)}
            | {f"{name}.png" for name in photographs(chapter)}
            | {f"bug_{mutant.name}.png" for mutant in blocks.pictured_mutants(chapter)})


def drawn(chapter):
    """Yields (file name, SVG text) for each figure."""
    def run(*arguments):
        return reference.run_as_json(chapter, list(map(str, arguments)))

    for name, draw in drawings(chapter).items():
        try:
            yield f"{name}.svg", draw(run)
        except ToolError:
            raise
        except Exception as error:
            raise ToolError(f"tools/figures/figures_{chapter.label}.py: figure '{name}': "
                            f"{type(error).__name__}: {error}") from None


def rendered(chapter):
    """Yields (file name, PNG bytes) for each picture that OpenGL renders."""
    with tempfile.TemporaryDirectory() as folder:
        for name, arguments in photographs(chapter).items():
            path = Path(folder) / f"{name}.png"
            reference.run(chapter, [*map(str, arguments), "--png", str(path)])
            if not path.exists():
                raise ToolError(f"{chapter.folder}_reference --png made no picture '{name}'")
            yield path.name, path.read_bytes()


def of_mistakes(chapter):
    """Yields (file name, PNG bytes) for each classic mistake with a picture, after its check has
    caught it."""
    with tempfile.TemporaryDirectory() as folder:
        args = argparse.Namespace(chapters=[chapter.label], json=False, keep_pictures=Path(folder),
                                  time_limit=checking.TIME_LIMIT)
        if proving.run_all(args, lambda chapter: picture_jobs(chapter, args)):
            raise ToolError(f"not every picture of chapter {chapter.label}'s mistakes was made")
        for path in sorted(Path(folder).glob("*/*.png")):
            yield path.name, path.read_bytes()


def picture_jobs(chapter, args):
    for mutant in blocks.pictured_mutants(chapter):
        texts = mutants.apply(mutant, chapter)
        yield (f"picture of {mutant.name}",
               functools.partial(proving.hunt, chapter, mutant, texts, args))


def why_skipped(rendering):
    """Why PNGs cannot be made here, or "": no graphics built in, or no OpenGL for `rendering`."""
    if not doctor.works("graphics"):
        return "this build has no graphics"
    return "OpenGL does not work here" if rendering and not doctor.works("OpenGL") else ""


def difference(old, new, exact):
    """Why a stored PNG is stale, in words; empty if it is not."""
    if old == new:
        return ""
    try:
        return png.difference(png.decode(old, "the stored picture"), png.decode(new), exact)
    except ToolError as error:
        return str(error)
