"""videos: the clips in videos/, made from videos/recipes.json, and whether they are fresh."""

import functools
import json
import tempfile
from dataclasses import dataclass
from pathlib import Path

from workbook import blocks, build, pictures, png, processes
from workbook.chapters import ROOT
from workbook.errors import FAILED, InputError, ToolError
from workbook.files import relative, write
from workbook.reference import answer
from workbook.terminal import note, plural, print_outcome

FOLDER = ROOT / "videos"
RECIPES = FOLDER / "recipes.json"
OVERVIEW = FOLDER / "README.md"
DEMO = "gravity_fall"  # what `demo` leaves there, not committed

WIDTH, HEIGHT, FRAMES_PER_SECOND, COMPRESSION = 960, 540, 60, 28
SECONDS = 1800  # that a film may take: encoding is slow on a busy machine
MOST_BYTES, MOST_BYTES_IN_ALL = 1_500_000, 12_000_000

# How far a decoded frame may be from a drawn one, both halved in size. The error is measured in
# the picture's own detail, since that is what H.264 blurs: 0.4 to 0.8 for a clip as it should be,
# above 1.05 with another seed, with other colours, or seen from 3 degrees further round.
MOST_BLUR = 0.9
FAR_OFF, FAR_OFF_SHARE = 32, 0.03  # of 255, of all samples


@dataclass(frozen=True)
class Recipe:
    """How a clip is made, and what it shows."""
    name: str
    title: str     # one sentence: what happens
    alt: str       # what the poster shows, for readers who cannot see it
    program: str
    arguments: tuple
    seconds: float
    poster: float  # which moment, s

    @property
    def clip(self):
        return FOLDER / f"{self.name}.mp4"

    @property
    def picture(self):
        return FOLDER / f"{self.name}.png"

    @property
    def frames(self):
        return round(self.seconds * FRAMES_PER_SECOND)

    def run(self, *further):
        """Runs the program for the whole length of the clip."""
        film = ["--width", WIDTH, "--height", HEIGHT, "--frames", self.frames, "--device", "cpu"]
        if "--compression" not in self.arguments:
            film += ["--compression", COMPRESSION]
        # Two films are made at a time, so each gets one thread.
        answer(self.program, [str(word) for word in [*film, *self.arguments, *further]], SECONDS,
               OMP_NUM_THREADS="1")


def register(commands):
    parser = commands.add_parser("videos", help="for authors: make the clips in videos/ afresh")
    parser.add_argument("names", nargs="*", metavar="NAME",
                        help="make these anew (default: whatever is missing or stale)")
    parser.add_argument("--check", action="store_true",
                        help="write nothing; say which clips are stale, and exit with 1")
    parser.add_argument("--sheet", metavar="FOLDER", type=Path,
                        help="write nothing else: FOLDER/NAME.png, twelve frames of each clip")
    parser.set_defaults(run=videos_command)


def videos_command(args):
    if args.check and args.sheet:
        raise InputError("--check and --sheet exclude each other")
    chosen = [recipe_named(name) for name in args.names] or recipes()
    if why := pictures.why_skipped(rendering=not args.sheet):
        if not args.check:
            raise InputError(f"{why}, so there are no videos")
        print(f"skipped: videos: {why}")
        return 0
    build.build(sorted({"ballpit_clip", *(recipe.program for recipe in chosen)}))
    if args.sheet:
        return make_sheets(chosen, args.sheet)
    return check(chosen) if args.check else make_all(chosen, always=bool(args.names))


@functools.cache
def recipes():
    """All recipes, in the order of the file. ToolError if one is incomplete."""
    try:
        table = json.loads(RECIPES.read_text())
        return [recipe_of(name, entry) for name, entry in table.items()]
    except FileNotFoundError:
        raise ToolError(f"{relative(RECIPES)} is missing") from None
    except (ValueError, AttributeError) as error:
        raise ToolError(f"{relative(RECIPES)}: {error}") from None


def recipe_of(name, entry):
    missing = {"title", "alt", "program", "arguments", "seconds", "poster"} ^ set(entry)
    if missing:
        raise ValueError(f"'{name}': missing or unknown: {', '.join(sorted(missing))}")
    if not 0 <= entry["poster"] < entry["seconds"]:
        raise ValueError(f"'{name}': the poster's moment must lie within the clip")
    return Recipe(name=name, **{**entry, "arguments": tuple(entry["arguments"].split())})


def recipe_named(name):
    for recipe in recipes():
        if recipe.name == name:
            return recipe
    raise InputError(f"there is no clip '{name}': known are "
                     + ", ".join(recipe.name for recipe in recipes()))


def facts_of(clip, *options):
    """What the clip is; `options` take pictures out of it."""
    return json.loads(answer("ballpit_clip", [str(clip), *map(str, options)]))


def poster_options(recipe, path):
    return "--poster", path, "--poster-frame", round(recipe.poster * FRAMES_PER_SECOND)


# ---- making --------------------------------------------------------------------------------------

def make_all(chosen, always):
    results = processes.results_of([functools.partial(make, recipe, always) for recipe in chosen])
    made = 0
    for recipe, is_made in zip(chosen, results):
        if is_made:
            print(f"wrote {relative(recipe.clip)}: {recipe.clip.stat().st_size} bytes", flush=True)
        made += is_made
    if OVERVIEW.read_text() != (fresh := overview()):
        write(OVERVIEW, fresh)
        print(f"wrote {relative(OVERVIEW)}")
    print(f"videos: {made} made, {len(chosen) - made} fresh already")
    return 0


def make(recipe, always):
    """Makes a clip and its poster in a folder aside, and moves them when both are complete. False
    if they were fresh."""
    if not always and not problem_of(recipe):
        return False
    note(f"filming {recipe.name}")
    with tempfile.TemporaryDirectory(dir=ROOT / "build") as folder:
        clip, poster = Path(folder) / "clip.mp4", Path(folder) / "poster.png"
        recipe.run("--out", clip)
        facts = facts_of(clip, *poster_options(recipe, poster))
        if problem := shape_problem(recipe, facts, clip.stat().st_size):
            raise ToolError(f"{recipe.name}: {problem}; change its recipe")
        write(recipe.clip, clip.read_bytes())
        write(recipe.picture, poster.read_bytes())
    return True


def make_sheets(chosen, folder):
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"--sheet {folder}: {error.strerror}") from None
    for recipe in chosen:
        sheet = folder.resolve() / f"{recipe.name}.png"
        facts_of(recipe.clip, "--sheet", sheet)
        print(f"wrote {sheet}")
    return 0


# ---- checking ------------------------------------------------------------------------------------

def check(chosen):
    failed = 0
    jobs = [functools.partial(problem_of, recipe) for recipe in chosen]
    for recipe, problem in zip(chosen, processes.results_of(jobs), strict=True):
        print_outcome(recipe.name, problem)
        failed += bool(problem)
    for problem in problems_of_folder():
        print_outcome("videos/", problem)
        failed += 1
    if failed:
        print(f"videos --check: {plural(failed, 'fault')}; `./ballpit videos` mends what is stale")
        return FAILED
    print(f"videos --check: {plural(len(chosen), 'clip')}, all fresh")
    return 0


def problem_of(recipe):
    """Why a clip is not what its recipe makes now; "" if it is."""
    for path in (recipe.clip, recipe.picture):
        if not path.exists():
            return f"{relative(path)} is missing"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        ends = {"first": 0, "last": recipe.frames - 1}
        try:
            takes = [option for end, number in ends.items()
                     for option in ("--frame", number, folder / f"clip_{end}.png")]
            facts = facts_of(recipe.clip, *takes, *poster_options(recipe, folder / "poster.png"))
        except ToolError as error:
            return f"cannot be played: {error}"
        if problem := shape_problem(recipe, facts, recipe.clip.stat().st_size):
            return problem
        poster = (folder / "poster.png").read_bytes()
        if pictures.difference(recipe.picture.read_bytes(), poster, exact=True):
            return "the poster is not of this clip"
        recipe.run("--stills", folder)
        for end in ends:
            if problem := frame_difference(png.load(folder / f"clip_{end}.png"),
                                           png.load(folder / f"{end}.png")):
                return f"the {end} frame is stale: {problem}"
    return ""


def shape_problem(recipe, facts, size):
    wanted = {"codec": "h264", "width": WIDTH, "height": HEIGHT, "frames": recipe.frames,
              "frames_per_second": FRAMES_PER_SECOND}
    for what, value in wanted.items():
        if facts[what] != value:
            return f"{what} {facts[what]}, not {value}"
    return f"{size} bytes: {MOST_BYTES} at most" if size > MOST_BYTES else ""


def halved_rows(picture):
    """A picture's rows at half its size: each sample is the mean of four."""
    stride = 3 * picture.width
    for start in range(0, len(picture.samples) - stride, 2 * stride):
        upper = picture.samples[start:start + stride]
        lower = picture.samples[start + stride:start + 2 * stride]
        sums = [a + b for a, b in zip(upper, lower)]
        yield [(sums[i] + sums[i + 3]) // 4 for x in range(0, stride - 5, 6)
               for i in (x, x + 1, x + 2)]


def frame_difference(decoded, drawn):
    """What tells a decoded frame from the one that should be there; "" if compression does."""
    if (decoded.width, decoded.height) != (drawn.width, drawn.height):
        return f"drawn are {drawn.width}x{drawn.height}"
    error = detail = far_off = count = 0
    for row, wanted in zip(halved_rows(decoded), halved_rows(drawn)):
        offsets = [abs(a - b) for a, b in zip(row, wanted)]
        error += sum(offsets)
        detail += sum(abs(a - b) for a, b in zip(wanted, wanted[3:]))
        far_off += sum(offset > FAR_OFF for offset in offsets)
        count += len(offsets)
    blur, share = error / max(count, detail), far_off / count
    if blur <= MOST_BLUR and share <= FAR_OFF_SHARE:
        return ""
    return (f"error {blur:.2f} of the picture's detail (allowed {MOST_BLUR:g}), {share:.1%} "
            f"far off (allowed {FAR_OFF_SHARE:.1%})")


def problems_of_folder():
    """What concerns no single clip."""
    clips = {recipe.clip for recipe in recipes()} | {recipe.picture for recipe in recipes()}
    for path in sorted([*FOLDER.glob("*.mp4"), *FOLDER.glob("*.png")]):
        if path not in clips and path.stem != DEMO:
            yield f"nothing makes {relative(path)}; delete it"
    size = sum(path.stat().st_size for path in clips if path.exists())
    if size > MOST_BYTES_IN_ALL:
        yield f"all clips together have {size} bytes: {MOST_BYTES_IN_ALL} at most"
    if OVERVIEW.read_text() != overview():
        yield f"{relative(OVERVIEW)} is stale"


# ---- embedding -----------------------------------------------------------------------------------

def embedded(recipe, to_folder):
    """The poster as a link to the clip, and the title: Markdown, seen from another folder."""
    place = f"{to_folder}{recipe.name}"
    return [f"[![{recipe.alt}]({place}.png)]({place}.mp4)", "",
            f"*{recipe.title} ({recipe.seconds:g} s)*"]


def overview():
    """videos/README.md with its block `gen clips` filled."""
    parts = blocks.split(OVERVIEW.read_text(), relative(OVERVIEW))
    for part in parts:
        if isinstance(part, blocks.Block) and part.kind == "clips":
            rows = [(f"[![{recipe.alt}]({recipe.name}.png)]({recipe.name}.mp4)",
                     f"{recipe.title}<br>`{' '.join([recipe.program, *recipe.arguments])}`")
                    for recipe in recipes()]
            part.content = blocks.table(["clip", "what happens, and what makes it"], rows)
    return blocks.joined(parts)
