"""Measures burin and its peers; started by scripts/bench-peers, which sets up their environment."""

import argparse
import dataclasses
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys

import cases
import numpy
import OpenImageIO as oiio
import report

HERE = pathlib.Path(__file__).parent
STYLES = ("plain", "shaded")
# What burin may choose from, besides the equal step without pre-integration.
BURIN_STEPS = (0.5, 0.75, 1.5, 2.0)
BURIN_PREINTEGRATED_STEPS = (0.5, 1.0, 2.0, 3.0)
# Steps at which a picture counts as converged; VTK's fixed-point mapper moves away
# from the integral again below 1/4 (measured on foot and wavelet).
CONVERGED = {"burin": 1 / 16, "vtk-gpu": 1 / 8, "vtk-cpu": 1 / 4, "paraview": 1 / 8}
LONGEST_S = 3600  # that one start of a program may take


@dataclasses.dataclass(frozen=True)
class Contender:
    """A program on a number of ranks."""
    program: str
    ranks: int
    folder: str = ""  # of the unpacked Debian packages
    arguments: tuple = ()


@dataclasses.dataclass(frozen=True)
class Job:
    """A picture to draw with a contender: its style, step in smallest spacings, pre-integration."""
    style: str
    step: float
    preintegrated: bool = False


def launcher(ranks):
    return [] if ranks == 1 else ["mpirun", "-q", "--oversubscribe", "--bind-to", "none", "-n",
                                  str(ranks)]


def environment(contender, peers):
    """Two threads in all, and the libraries of the contender's packages."""
    env = dict(os.environ, LP_NUM_THREADS=str(max(1, 2 // contender.ranks)))
    if contender.folder:
        root = peers / contender.folder
        libraries = next((root / "usr/lib").glob("*-linux-gnu"))
        env["LD_LIBRARY_PATH"] = str(libraries)
        env["PYTHONPATH"] = f"{root / 'usr/lib/python3/dist-packages'}:{HERE}"
    return env


def run(command, env, what):
    """The output of a command; None, and the end of its complaints shown, if it fails."""
    limited = ["timeout", LONGEST_S, *command]
    done = subprocess.run([str(c) for c in limited], env=env, text=True, capture_output=True,
                          check=False)
    if done.returncode == 0:
        return done.stdout
    print(f"bench-peers: {what} failed with exit code {done.returncode}:", file=sys.stderr)
    print("\n".join((done.stderr + done.stdout).splitlines()[-8:]), file=sys.stderr)
    return None


def read_exr(path):
    return oiio.ImageInput.open(str(path)).read_image("float")[:, :, :4]


def read_rgba(path, size):
    """A peer's 8-bit picture, bottom row first, as premultiplied RGBA in [0, 1]."""
    return numpy.fromfile(path, "u1").reshape(size, size, 4)[::-1] / numpy.float32(255)


def draw_burin(tools, case, contender, jobs, frames):
    """Per job: milliseconds of each frame, and the first frame's picture."""
    drawn = {}
    for job in jobs:
        picture, stats = tools.work / "burin.exr", tools.work / "stats.json"
        command = [*launcher(contender.ranks), tools.burin, "render",
                   tools.work / f"{case['name']}-{job.style}.json", "-o", picture, "--quiet",
                   "--stats", stats, "--set", f"quality.step_voxels={job.step}",
                   "--set", f"quality.preintegrated={json.dumps(job.preintegrated)}"]
        if job.step == CONVERGED["burin"]:
            command += ["--set", "quality.termination=0"]
        if frames > 1:
            command += ["--frames", frames, "--orbit", 0.01 * frames]
            picture = tools.work / "burin_0000.exr"
        if run(command, environment(contender, tools.peers), f"burin, {case['name']}") is None:
            continue
        times = [f["frame_ms"] for f in json.loads(stats.read_text())["frames"]]
        drawn[job] = times, read_exr(picture)
    return drawn


def draw_peer(tools, case, contender, jobs, frames):
    orders = [{"style": j.style, "step": j.step * min(case["spacing"]), "frames": frames,
               "picture": str(tools.work / f"peer{i}.rgba")} for i, j in enumerate(jobs)]
    case_file, jobs_file = tools.work / "case.json", tools.work / "jobs.json"
    case_file.write_text(json.dumps(case))
    jobs_file.write_text(json.dumps(orders))
    if contender.program == "paraview":
        program = [*launcher(contender.ranks), tools.peers / contender.folder / "usr/bin/pvbatch",
                   "--sym", HERE / "paraview_peer.py", case_file, jobs_file]
    else:
        program = [sys.executable, HERE / "vtk_peer.py", case_file, *contender.arguments, jobs_file]
    output = run(program, environment(contender, tools.peers),
                 f"{contender.program}, {case['name']}")
    if output is None:
        return {}
    results = [json.loads(line) for line in output.splitlines() if line.startswith("{")]
    tools.versions.update({contender.program: r["version"] for r in results})
    return {job: (result["times"], read_rgba(order["picture"], case["size"]))
            for job, order, result in zip(jobs, orders, results)}


def draw(tools, case, contender, jobs, frames):
    drawer = draw_burin if contender.program == "burin" else draw_peer
    return drawer(tools, case, contender, jobs, frames)


def jobs_of(contender):
    jobs = [Job(style, report.EQUAL_STEP) for style in STYLES]
    if contender.program == "burin":
        # As small as the error of vtk-cpu, which draws on one rank.
        small = (0.25,) if contender.ranks == 1 else ()
        jobs += [Job(style, step) for style in STYLES for step in (*small, *BURIN_STEPS)]
        jobs += [Job(style, step, True) for style in STYLES
                 for step in (*small, *BURIN_PREINTEGRATED_STEPS)]
    return jobs


def converged(tools, case, contender):
    """The pictures that errors are differences to, by style: the same program's on one rank."""
    one = dataclasses.replace(contender, ranks=1)
    step = CONVERGED[contender.program]
    jobs = [Job(style, step, contender.program == "burin") for style in STYLES]
    return {job.style: picture
            for job, (_, picture) in draw(tools, case, one, jobs, 1).items()}


def bytes_of(picture):
    return numpy.round(numpy.clip(picture[:, :, :3], 0, 1) * 255) / 255


def errors(picture, truth):
    """Largest and root mean square difference of premultiplied linear RGB, both in 8 bits, as the
    peers deliver no more; and the same without rounding."""
    rounded = numpy.abs(bytes_of(picture) - bytes_of(truth))
    exact = numpy.abs(picture[:, :, :3] - truth[:, :, :3])
    return {"error_max": float(rounded.max()), "error_rms": float((rounded**2).mean()**0.5),
            "float_max": float(exact.max()), "float_rms": float((exact**2).mean()**0.5)}


def overlap(one, other):
    """Intersection over union of what two pictures show."""
    a, b = one[:, :, 3] > 0.05, other[:, :, 3] > 0.05
    return float((a & b).sum() / max(1, (a | b).sum()))


def to_display(picture):
    x = numpy.clip(picture[:, :, :3], 0, 1)
    srgb = numpy.where(x <= 0.0031308, 12.92 * x, 1.055 * numpy.maximum(x, 1e-6)**(1 / 2.4) - 0.055)
    return numpy.round(srgb * 255).astype("u1")


def write_png(path, picture):
    out = oiio.ImageOutput.create(str(path))
    out.open(str(path), oiio.ImageSpec(picture.shape[1], picture.shape[0], 3, "uint8"))
    out.write_image(numpy.ascontiguousarray(picture))
    out.close()


def compare_pictures(out, name, truths):
    """Do all programs show the same thing? Their converged pictures side by side, and numbers."""
    for style in STYLES:
        shown = {program: t[style] for program, t in truths.items() if style in t}
        if "burin" not in shown:
            continue
        write_png(out / f"{name}-{style}.png",
                  numpy.hstack([to_display(picture) for picture in shown.values()]))
        for program, picture in list(shown.items())[1:]:
            same = overlap(shown["burin"], picture)
            rms = errors(picture, shown["burin"])["float_rms"]
            print(f"  {name} {style}: {program} overlaps burin's picture by {same:.3f}, "
                  f"rms difference {rms:.4f}")
            if same < 0.9:
                print(f"bench-peers: WARNING, {program} does not show what burin shows, see "
                      f"{name}-{style}.png", file=sys.stderr)


def measure(tools, case, contenders, rounds, frames):
    """The rows of the table for one volume. Contenders take turns, so that a disturbance of the
    machine does not hit one alone; each turn's first frame only warms up."""
    truths = {}
    for contender in contenders:
        if contender.program not in truths:
            truths[contender.program] = converged(tools, case, contender)
    compare_pictures(tools.out, case["name"], truths)
    times, pictures = {}, {}
    for turn in range(rounds):
        for contender in contenders:
            print(f"  {case['name']}, turn {turn + 1} of {rounds}: {contender.program} "
                  f"on {contender.ranks}", flush=True)
            for job, (ms, picture) in draw(tools, case, contender, jobs_of(contender),
                                           frames + 1).items():
                times.setdefault((contender, job), []).extend(ms[1:])
                pictures[contender, job] = picture
    rows = []
    for (contender, job), ms in times.items():
        truth = truths[contender.program].get(job.style)
        if truth is None:
            continue
        to_burin = {}
        if job.style in truths["burin"]:
            apart = errors(pictures[contender, job], truths["burin"][job.style])
            to_burin = {"to_burin_max": apart["float_max"], "to_burin_rms": apart["float_rms"]}
        rows.append({"program": contender.program, "volume": case["name"], "style": job.style,
                     "ranks": contender.ranks, "size": case["size"], "step_voxels": job.step,
                     "median_ms": statistics.median(ms), "preintegrated": int(job.preintegrated),
                     "smallest_ms": min(ms), "largest_ms": max(ms),
                     **errors(pictures[contender, job], truth), **to_burin})
    return rows


def contenders_of(peers, ranks):
    """burin, and the peers whose packages are there."""
    found = [Contender("burin", n) for n in ranks]
    vtk = next((f for f in ("vtk", "paraview") if (peers / f / "ready").exists()), None)
    if vtk:
        found += [Contender("vtk-gpu", 1, vtk, ("gpu",)), Contender("vtk-cpu", 1, vtk, ("cpu",))]
    if (peers / "paraview/ready").exists():
        found += [Contender("paraview", n, "paraview") for n in ranks]
    return found


@dataclasses.dataclass
class Tools:
    burin: pathlib.Path
    peers: pathlib.Path
    out: pathlib.Path
    work: pathlib.Path
    versions: dict = dataclasses.field(default_factory=dict)


def warn_unless_quiet():
    if os.getloadavg()[0] > 0.5:
        print(f"bench-peers: WARNING, the machine is not quiet (load {os.getloadavg()[0]:.1f})",
              file=sys.stderr)


def main():
    parser = argparse.ArgumentParser()
    for name in ("--burin", "--peers", "--out"):
        parser.add_argument(name, type=pathlib.Path, required=True)
    parser.add_argument("--data", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--volumes")
    parser.add_argument("--size", type=int)
    parser.add_argument("--repeats", type=int)
    options = parser.parse_args()

    real = options.data and options.data.is_dir()
    known = [name for name, look in cases.LOOKS.items()
             if not look.source or (real and (options.data / look.source).is_file())]
    if options.volumes:
        names = options.volumes.split(",")
    elif options.quick:
        names = ["foot" if "foot" in known else "ct-phantom", "wavelet"]
    else:
        names = [n for n in known if cases.LOOKS[n].source] or ["ct-phantom", "vessels"]
        names += ["wavelet"]
    unknown = sorted(set(names) - set(known))
    if unknown:
        sys.exit(f"bench-peers: no such volume: {', '.join(unknown)}; there are {', '.join(known)}")
    size = options.size or (256 if options.quick else 512)
    repeats = options.repeats or (3 if options.quick else 6)
    rounds = 2 if repeats >= 6 else 1
    frames = -(-repeats // rounds)

    warn_unless_quiet()
    tools = Tools(options.burin, options.peers, options.out, options.out / "work")
    tools.work.mkdir(parents=True, exist_ok=True)
    contenders = contenders_of(options.peers, (1, 2) if options.quick else (1, 2, 4))
    rows = []
    for name in names:
        volume = cases.volume(name, options.data, tools.work, tools.burin,
                              128 if options.quick else 256)
        case = cases.write_case(volume, size, tools.work)
        rows += measure(tools, case, contenders, rounds, frames)
        report.write_table(tools.out, rows)  # after every volume: a long run may be stopped
        (tools.work / f"{name}.raw").unlink()
    for program, version in sorted(tools.versions.items()):
        print(f"{program}: {version}")
    report.print_summary(rows)
    report.plot(tools.out)
    shutil.rmtree(tools.work)
    print(f"bench-peers: {tools.out / 'peers.csv'}")


if __name__ == "__main__":
    main()
