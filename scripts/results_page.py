#!/usr/bin/env python3
"""Makes docs/results.md, and the charts in it, of docs/results/figures.toml and of the tables that it names.

  scripts/results_page.py [--check] [ROOT]

--check changes nothing, and ends with 1 if page or charts are not what the tables say. Other scripts put what they print into
pages of tables by `written`; and the tables of the goalkeeper benchmark are made here.
"""
import argparse
import contextlib
import glob
import io
import json
import os
import random
import subprocess
import sys

import results_figures

EPISODES = 2000
BOOTSTRAPS = 1000
MEASURED = "Measured at commit "
STRIKERS = ("yardstick-v1", "shot", "dribble")


class Tee(io.StringIO):
    """Text that is also printed at once."""

    def write(self, text):
        sys.__stdout__.write(text)
        sys.__stdout__.flush()
        return super().write(text)


def tables_of(text):
    """Tables by the headings above them, up to the first comma or colon with a blank: {heading: lines}."""
    found = {}
    heading = ""
    for line in text.splitlines():
        if line.startswith("## "):
            heading = line[3:].split(",")[0].strip()
        elif line.startswith("|"):
            found.setdefault(heading, []).append(line)
    return found


def commit():
    """Words that say which sources a table is of."""
    def git(*words):
        return subprocess.run(["git", "-C", os.path.dirname(__file__), *words], capture_output=True, text=True).stdout.strip()
    changes = ", with changes" if git("diff", "HEAD", "--", ":/*.cpp", ":/*.hpp") else ""
    return MEASURED + git("log", "-1", "--format=`%h` of %cs") + changes + "."


def put(page, tables, of=None):
    """The page with the tables behind their marks, in place of those that are there; and marks that it lacks.
    @param of a line above each table that says which sources it is of"""
    lines = page.split("\n")
    missing = []
    for heading, rows in tables.items():
        mark = "<!-- table: %s -->" % heading
        if mark not in lines:
            missing.append(mark)
            continue
        begin = lines.index(mark) + 1
        while begin < len(lines) and (not lines[begin].strip() or lines[begin].startswith(MEASURED)):
            begin += 1
        end = begin
        while end < len(lines) and lines[end].startswith("|"):
            end += 1
        head = ["", of, "", *rows] if of else ["", *rows]
        lines[lines.index(mark) + 1:end] = head if end > begin else [*head, ""]
    return "\n".join(lines), missing


def rewrite(file, change):
    """Puts change(text) in place of a page's text: whole, or not at all."""
    with open(file) as page:
        text = change(page.read())
    with open(file + ".new", "w") as page:
        page.write(text)
    os.replace(file + ".new", file)


@contextlib.contextmanager
def written(file):
    """Puts the tables that are printed meanwhile into the page, or into those pages of a folder that have their marks."""
    if file is None:
        yield
        return
    tee = Tee()
    with contextlib.redirect_stdout(tee):
        yield
    tables, of = tables_of(tee.getvalue()), commit()
    missing = set(put("", tables)[1])

    def with_tables(page):
        text, lacking = put(page, tables, of)
        missing.intersection_update(lacking)
        return text

    for page in sorted(glob.glob(os.path.join(file, "*.md"))) if os.path.isdir(file) else [file]:
        rewrite(page, with_tables)
    for mark in sorted(missing):
        print("%s has no line %s, so its table is not there" % (file, mark), file=sys.stderr)


def more_goals(goals, truth):
    """Goals of 100 more than against the keeper that sees the truth, in the same situations, with an interval by bootstrap."""
    differences = [a - b for a, b in zip(goals, truth)]
    chance = random.Random(1)
    n = len(differences)
    means = sorted(100.0 * sum(chance.choices(differences, k=n)) / n for _ in range(BOOTSTRAPS))
    return "%+.1f [%+.1f, %+.1f]" % (100.0 * sum(differences) / n, means[int(0.025 * BOOTSTRAPS)], means[int(0.975 * BOOTSTRAPS)])


def keeper_rows(result):
    """A row a keeper and way to see; the last columns are errors against the first striker."""
    cells = {(c["keeper"], c["striker"]): c for c in result["cells"]}
    rows = []
    for keeper in result["keepers"]:
        policy, sees = keeper.split("policy=")[1].split("&sees=")
        row = [policy, "`%s`" % sees]
        for striker in result["strikers"]:
            cell = cells[keeper, striker]
            goals = [outcome == "g" for outcome in cell["outcomes"]]
            truth = [outcome == "g" for outcome in cells[keeper.split("&sees=")[0] + "&sees=truth", striker]["outcomes"]]
            row.append("%.1f [%.1f, %.1f]" % tuple(100.0 * cell["scoring"][k] for k in ("value", "low", "high")))
            row.append("-" if sees == "truth" else more_goals(goals, truth))
        error = cells[keeper, result["strikers"][0]].get("keeper_pose_error")
        row.append("%.3f / %.3f" % (error["mean_m"], error["median_m"]) if error else "0")
        row.append("%.2f / %.2f" % tuple(error[k] * 57.29578 for k in ("mean_heading_rad", "median_heading_rad")) if error else "0")
        rows.append("| " + " | ".join(row) + " |")
    return rows


def goalkeepers(tools, _):
    file = os.path.join(tools.out, "sees.json")
    result = subprocess.run([tools.ortung, "benchmark", "goalkeeper", "--keepers", "blocking,intercepting", "--sees",
                             "truth,features,scan,localized", "--strikers", ",".join(STRIKERS), "--episodes", str(EPISODES),
                             "--threads", str(os.cpu_count()), "--json", file, "--force"], capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(result.stderr)
    with open(file) as text:
        rows = keeper_rows(json.load(text))
    head = ["keeper", "sees"]
    for i, striker in enumerate(STRIKERS):
        head += ["against " + striker if i == 0 else striker, "more than `truth`" if i == 0 else "more"]
    head += ["pose error mean / median [m]", "heading [deg]"]
    print("\n## Goalkeepers\n\n| %s |\n|%s\n%s" % (" | ".join(head), "---|" * len(head), "\n".join(rows)), flush=True)


def stale(root):
    """Files of the page of figures that are not there, or not what the tables say."""
    for name, text in results_figures.files(root).items():
        file = os.path.join(root, name)
        if not os.path.exists(file) or open(file, encoding="utf-8").read() != text:
            yield name, text


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", nargs="?", default=os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    try:
        found = list(stale(options.root))
    except results_figures.FigureError as error:
        sys.exit(str(error))
    for name, text in found:
        if options.check:
            print("%s is not what docs/results/figures.toml and its tables say, expected what scripts/results_page.py makes" % name)
        else:
            with open(os.path.join(options.root, name), "w", encoding="utf-8") as file:
                file.write(text)
            print("made " + name)
    return 1 if options.check and found else 0


if __name__ == "__main__":
    sys.exit(main())
