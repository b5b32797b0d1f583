"""plan: the least model that answers a scene's question well enough, and why."""

from workbook import build, processes


def register(commands):
    plan = commands.add_parser(
        "plan", help="choose the least model for a scene, and say why",
        description="Reads a scene's facts and chooses broad phase, cells, response, substeps and "
                    "steps a frame: what `gravity_fall --plan auto` follows.")
    plan.add_argument("scene", nargs="?", default="gravity_fall", metavar="SCENE",
                      help="any scene of `./ballpit demo --help` (gravity_fall)")
    plan.add_argument("--count", metavar="N", help="number of balls (the scene's own)")
    plan.add_argument("--tolerance", metavar="X",
                      help="error that may be left, as a share of a radius or of the energy (the "
                           "scene's own, or 0.05)")
    plan.add_argument("--seed", metavar="N", help="seed of the scene (1)")
    plan.add_argument("--explain", action="store_true",
                      help="tell the facts, and for each choice why, and what was left out")
    plan.add_argument("--json", action="store_true", help="print it as JSON")
    plan.set_defaults(run=plan_command)


def plan_command(args):
    build.build(["ballpit_plan"])
    command = [str(build.executable("ballpit_plan")), args.scene]
    for option in ("count", "tolerance", "seed"):
        value = getattr(args, option)
        if value is not None:
            command += [f"--{option}", value]
    command += [f"--{flag}" for flag in ("explain", "json") if getattr(args, flag)]
    return processes.finish(processes.start(command))
