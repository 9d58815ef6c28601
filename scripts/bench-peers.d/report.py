"""The table, the plot and the printed summary of bench.py's rows."""

import csv
import math
import shutil
import subprocess
import sys

COLUMNS = ("program,volume,style,ranks,size,step_voxels,median_ms,error_max,ratio_to_burin,"
           "error_rms,preintegrated,burin_ms,burin_step,burin_rms_ms,burin_rms_step,"
           "burin_equal_step_ms,smallest_ms,largest_ms,float_max,float_rms,"
           "to_burin_max,to_burin_rms").split(",")
EQUAL_STEP = 1.0  # in smallest spacings, for every program
KEYS = {"error_max": "", "error_rms": "rms_"}


def fastest(rows, row, error):
    """burin's fastest row for the same task whose error is no larger than that of `row`."""
    return min((r for r in rows if r["program"] == "burin" and r[error] <= row[error] and
                all(r[k] == row[k] for k in ("volume", "style", "ranks", "size"))),
               key=lambda r: r["median_ms"], default=None)


def equal_step(rows, row):
    """burin's row without pre-integration at the step that every program draws with."""
    return next((r for r in rows if r["program"] == "burin" and not r["preintegrated"] and
                 r["step_voxels"] == EQUAL_STEP and
                 all(r[k] == row[k] for k in ("volume", "style", "ranks", "size"))), None)


def compare(rows):
    """Adds to each row what burin needs for a picture that is at least as accurate."""
    for row in rows:
        for error, part in KEYS.items():
            best = fastest(rows, row, error)
            row[f"burin_{part}ms"] = best["median_ms"] if best else math.nan
            row[f"burin_{part}step"] = best["step_voxels"] if best else math.nan
        same = equal_step(rows, row)
        row["burin_equal_step_ms"] = same["median_ms"] if same else math.nan
        row["ratio_to_burin"] = row["median_ms"] / row["burin_ms"]


def text(value):
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def write_table(out, rows):
    compare(rows)
    with open(out / "peers.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows([text(row.get(c, math.nan)) for c in COLUMNS] for row in rows)


def mean_and_worst(rows, column):
    """Geometric mean and largest of burin's time / the peer's; "none" where burin has no setting
    that is accurate enough."""
    ratios = [row[column] / row["median_ms"] for row in rows if not math.isnan(row[column])]
    if not ratios:
        return "none"
    mean = math.exp(sum(map(math.log, ratios)) / len(ratios))
    missing = f", {len(rows) - len(ratios)} none" if len(ratios) < len(rows) else ""
    return f"{mean:.2f} (worst {max(ratios):.2f}{missing})"


def print_summary(rows):
    peers = [row for row in rows if row["program"] != "burin"]
    print(f"\n{'':34}{'ms':>8} {'max':>7} {'rms':>7}  burin's ms at no larger max (step), rms, "
          "at equal step")
    for row in peers:
        print(f"{row['program']:9}{row['volume']:12}{row['style']:8}{row['ranks']:2} ranks"
              f"{row['median_ms']:8.0f} {row['error_max']:7.4f} {row['error_rms']:7.4f} "
              f"{row['burin_ms']:8.0f} ({row['burin_step']:g})"
              f"{row['burin_rms_ms']:8.0f} ({row['burin_rms_step']:g})"
              f"{row['burin_equal_step_ms']:8.0f}")
    print("\nburin's time / the peer's, below 1 where burin is faster; geometric mean over volumes")
    print(f"{'':26}{'error_max no larger':30}{'error_rms no larger':30}equal step")
    groups = dict.fromkeys((r["program"], r["ranks"], r["style"]) for r in peers)
    for program, ranks, style in groups:
        group = [r for r in peers if (r["program"], r["ranks"], r["style"]) ==
                 (program, ranks, style)]
        cells = [mean_and_worst(group, c)
                 for c in ("burin_ms", "burin_rms_ms", "burin_equal_step_ms")]
        print(f"{program:9}{ranks:2} ranks {style:8}" + "".join(f"{c:30}" for c in cells))


PLOT = """# gnuplot script; run it in this folder
set datafile separator ','
set datafile columnheaders
set terminal pngcairo size 1300,1000 font ',10'
set output 'peers.png'
set style data histograms
set style histogram clustered gap 1
set style fill solid 0.9
set grid ytics
set yrange [0:*]
set ylabel 'median ms'
set key outside top center horizontal
set multiplot layout 2,1
do for [style in 'plain shaded'] {
  set title sprintf('%s: each peer, and burin with its fastest setting of no larger error', style)
  rows = sprintf("< awk -F, 'NR == 1 || ($1 != \\"burin\\" && $3 == \\"%s\\")' peers.csv", style)
  set xtics rotate by -35
  plot rows using 'median_ms':xtic(sprintf('%s %s, %s', strcol('program'), strcol('ranks'), \
strcol('volume'))) title 'peer', \
    '' using 'burin_ms' title 'burin, error\\_max', \
    '' using 'burin_rms_ms' title 'burin, error\\_rms'
}
unset multiplot
"""


def plot(out):
    (out / "peers.gnuplot").write_text(PLOT, encoding="utf-8")
    if not shutil.which("gnuplot"):
        print("bench-peers: no gnuplot, so no plot (scripts/setup bench)", file=sys.stderr)
        return
    subprocess.run(["gnuplot", "peers.gnuplot"], cwd=out, check=False)
