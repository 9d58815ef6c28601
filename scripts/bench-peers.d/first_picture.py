"""From a program's start to its first picture in a file, burin's and ParaView's in turns; started by
scripts/bench-peers --first-picture, which sets up their environment."""

import argparse
import csv
import json
import pathlib
import shutil
import statistics
import sys
import time

import cases
import numpy
import OpenImageIO as oiio
from bench import Contender, Tools, environment, launcher, run, warn_unless_quiet

HERE = pathlib.Path(__file__).parent
TARGET = 1 / 3  # of ParaView's time
COLUMNS = ("program,volume,ranks,edge,size,median_s,smallest_s,largest_s,ratio_to_paraview,"
           "repeats").split(",")
BURIN, OWN_SCENE, PARAVIEW = "burin", "burin-own-scene", "paraview"


def command(tools, case, contender, picture):
    """What a user types: the file, the scene and where the picture goes."""
    work, name = tools.work, case["name"]
    if contender.program == PARAVIEW:
        return [*launcher(contender.ranks), tools.peers / contender.folder / "usr/bin/pvbatch",
                HERE / "paraview_first.py", work / "case.json", picture]
    what = work / (f"{name}.nhdr" if contender.program == OWN_SCENE else f"{name}-plain.json")
    return [*launcher(contender.ranks), tools.burin, "render", what, "-o", picture, "--quiet",
            "--size", f"{case['size']}x{case['size']}"]


def seconds(tools, case, contender):
    """Of one start; None if it failed. Leaves the picture in PROGRAM.png."""
    picture = tools.work / f"{contender.program}.png"
    picture.unlink(missing_ok=True)
    line = command(tools, case, contender, picture)
    env = environment(contender, tools.peers)
    start = time.perf_counter()
    output = run(line, env, f"{contender.program} on {contender.ranks}")
    taken = time.perf_counter() - start
    return None if output is None or not picture.exists() else taken


def shown(tools, program):
    """Which pixels are not the black background."""
    return oiio.ImageInput.open(str(tools.work / f"{program}.png")).read_image()[:, :, :3].max(2) > 8


def compare_pictures(tools):
    """Do both programs show the same thing?"""
    ours, theirs = shown(tools, BURIN), shown(tools, PARAVIEW)
    same = (ours & theirs).sum() / max(1, (ours | theirs).sum())
    print(f"  paraview's picture overlaps burin's by {same:.3f}, {numpy.mean(ours):.3f} of the frame")
    if same < 0.9 or not ours.any():
        print("bench-peers: WARNING, the two do not show the same", file=sys.stderr)


def measure(tools, case, contenders, repeats):
    """Seconds by contender. The first round only warms up: page cache, shader caches."""
    taken = {contender: [] for contender in contenders}
    for turn in range(repeats + 1):
        for contender in contenders:
            now = seconds(tools, case, contender)
            print(f"  turn {turn} of {repeats}: {contender.program} on {contender.ranks}: "
                  f"{'failed' if now is None else f'{now:.2f} s'}", flush=True)
            if turn > 0 and now is not None:
                taken[contender].append(now)
    return taken


def rows_of(case, taken, edge):
    medians = {c: statistics.median(s) for c, s in taken.items() if s}
    for contender, median in medians.items():
        peer = next((m for c, m in medians.items()
                     if c.program == PARAVIEW and c.ranks == contender.ranks), None)
        all_of = taken[contender]
        yield {"program": contender.program, "volume": case["name"], "ranks": contender.ranks,
               "edge": edge, "size": case["size"], "median_s": f"{median:.3f}",
               "smallest_s": f"{min(all_of):.3f}", "largest_s": f"{max(all_of):.3f}",
               "ratio_to_paraview": f"{median / peer:.4f}" if peer else "",
               "repeats": len(all_of)}


def report(out, rows):
    with open(out / "first_picture.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    for row in rows:
        ratio = row["ratio_to_paraview"]
        compared = ""
        if ratio and row["program"] != PARAVIEW:
            met = "met" if float(ratio) <= TARGET else "missed"
            compared = f"   {ratio} of ParaView's, target {TARGET:.3f} {met}"
        print(f"{row['program']:16}{row['ranks']:2} ranks {float(row['median_s']):8.2f} s{compared}")
    print(f"bench-peers: {out / 'first_picture.csv'}")


def main():
    parser = argparse.ArgumentParser()
    for name in ("--burin", "--peers", "--out"):
        parser.add_argument(name, type=pathlib.Path, required=True)
    parser.add_argument("--data", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--size", type=int, default=512)
    parser.add_argument("--repeats", type=int)
    options = parser.parse_args()
    warn_unless_quiet()
    tools = Tools(options.burin, options.peers, options.out, options.out / "work")
    tools.work.mkdir(parents=True, exist_ok=True)
    edge = 128 if options.quick else 512
    case = cases.write_case(cases.volume("shells", options.data, tools.work, tools.burin, edge),
                            options.size, tools.work)
    (tools.work / "case.json").write_text(json.dumps(case))
    contenders = []
    for ranks in (1, 2):
        contenders += [Contender(BURIN, ranks), Contender(OWN_SCENE, ranks)]
        if (options.peers / "paraview/ready").exists():
            contenders.append(Contender(PARAVIEW, ranks, "paraview"))
    taken = measure(tools, case, contenders, options.repeats or (3 if options.quick else 5))
    if any(c.program == PARAVIEW and s for c, s in taken.items()):
        compare_pictures(tools)
    report(options.out, list(rows_of(case, taken, edge)))
    shutil.rmtree(tools.work)


if __name__ == "__main__":
    main()
