#!/usr/bin/env python3
"""Measures what docs/performance.md says, and writes its tables.

  scripts/performance.py [--write] [--build build/dev] [--only PROGRAM ...]
  scripts/performance.py --check [ROOT]

Runs the benchmarks of a build folder one after the other and prints the tables that docs/performance/tables.toml describes.
--write keeps the figures, with machine and commit, in docs/performance/figures.json and puts the tables behind their marks in
the page. --check runs nothing, and ends with 1 if the page's tables are not what the figures say.
"""
import argparse
import json
import os
import platform
import re
import subprocess
import sys
import tempfile
import tomllib

import results_page

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
FOLDER = "docs/performance"
PAGE = "docs/performance.md"
FIGURE = re.compile(r"\{([^{}|]+)\|([^{}|]+)(?:\|([^{}|]*))?\}")


class FigureError(Exception):
    """What is wrong with a table: where, what was found, what was expected."""


def machine():
    """Words for this machine: processor, its vectors, cores, compiler."""
    with open("/proc/cpuinfo") as info:
        text = info.read()

    def of(key):
        found = re.search(r"^%s\s*:\s*(.*)$" % key, text, re.M)
        return found[1] if found else ""

    flags = of("flags").split()
    vectors = [name for flag, name in (("avx2", "AVX2"), ("avx512bw", "AVX-512"), ("avx512_vbmi", "VBMI")) if flag in flags]
    compiler = subprocess.run(["c++", "--version"], capture_output=True, text=True).stdout.splitlines()[0]
    clock = "%.1f GHz" % (float(of("cpu MHz")) / 1000) if of("cpu MHz") else "unknown clock"
    return "%d cores of %s at %s (%s), %s" % (os.cpu_count(), of("model name") or platform.machine(), clock,
                                              ", ".join(vectors) or "no wide vectors", compiler)


def benchmarks_of(text):
    """{name: {counter: value}} of the JSON that a benchmark writes; names without what google benchmark appends to them."""
    found = {}
    for one in json.loads(text)["benchmarks"]:
        if one.get("error_occurred") or one.get("run_type") == "aggregate":
            continue
        name = re.sub(r"/(real_time|manual_time|min_time:[^/]*|iterations:[^/]*)", "", one["name"])
        found[name] = {key: value for key, value in one.items() if isinstance(value, (int, float))}
    return found


def run(program, arguments, build):
    """What one program has measured: figures of a benchmark; of a script, the lines of its table. @throws FigureError if it fails"""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "figures.json")
        is_script = program.endswith(".py")
        place = os.path.join(ROOT, "scripts") if is_script else os.path.join(build, "bin")
        # Those of google benchmark take the file as an option, the others from the environment.
        words = [os.path.join(place, program), *(word.replace("OUT", out).replace("BUILD", build) for word in arguments)]
        ran = subprocess.run(words, cwd=ROOT, env={**os.environ, "ORTUNG_FIGURES": out}, stdout=subprocess.PIPE, text=True)
        lines = [line for line in ran.stdout.splitlines() if line.startswith("|")]
        if ran.returncode or not (lines if is_script else os.path.exists(out)):
            raise FigureError("%s ended with %d; it should have measured something" % (" ".join(words), ran.returncode))
        if is_script:
            return {"lines": lines}
        with open(out) as file:
            return benchmarks_of(file.read())


def cell(template, figures, where):
    """A cell's text, with figures in place of {benchmark|counter|format}, and quotients in place of {one by another|counter|format}."""
    def one(name, counter):
        if counter not in figures[name]:
            raise FigureError("%s: '%s' has no '%s', but %s" % (where, name, counter, ", ".join(sorted(figures[name]))))
        return figures[name][counter]

    def value(match):
        names, counter, form = match[1].split(" by "), match[2], match[3] or ".1f"
        if not figures.keys() >= set(names):
            return "-"  # the machine lacks it: an instruction set, a library
        numbers = [one(name, counter) for name in names]
        return format(numbers[0] if len(numbers) == 1 else numbers[0] / numbers[1], form)
    return FIGURE.sub(value, template)


def table(description, figures):
    """The lines of one table."""
    if "lines" in figures:
        return figures["lines"]
    where = "table '%s'" % description["name"]
    known = {name for row in description["rows"] for text in row for match in FIGURE.finditer(text) for name in match[1].split(" by ")}
    if not known & figures.keys():
        raise FigureError("%s: none of its benchmarks was measured: %s" % (where, ", ".join(sorted(known))))
    rows = [[cell(text, figures, where) for text in row] for row in description["rows"]]
    head = description["head"]
    for row in rows:
        if len(row) != len(head):
            raise FigureError("%s: a row of %d cells, expected %d: %s" % (where, len(row), len(head), row[0]))
    return ["| " + " | ".join(line) + " |" for line in (head, ["---"] * len(head), *rows)]


def described(root):
    """Programs and tables. @throws FigureError for a table of a program that is none"""
    with open(os.path.join(root, FOLDER, "tables.toml"), "rb") as file:
        known = tomllib.load(file)
    for one in known["table"]:
        if one["program"] not in known["program"]:
            raise FigureError("table '%s' is of '%s', which is no program" % (one["name"], one["program"]))
    return known


def kept(root):
    file = os.path.join(root, FOLDER, "figures.json")
    if not os.path.exists(file):
        return {}
    with open(file) as text:
        return json.load(text)


def page_with(page, known, measured):
    """The page with all tables whose programs were measured, and marks that it lacks."""
    missing = []
    for one in known["table"]:
        if one["program"] in measured:
            entry = measured[one["program"]]
            page, lacking = results_page.put(page, {one["name"]: table(one, entry["figures"])}, entry["of"])
            missing += lacking
    return page, missing


def check(root):
    """Ends with 1 if the page is not what figures and tables say."""
    with open(os.path.join(root, PAGE)) as file:
        page = file.read()
    known, measured = described(root), kept(root)
    lacking = [program for program in known["program"] if program not in measured]
    expected, missing = page_with(page, known, measured)
    for program in lacking:
        print("%s was never measured" % program)
    for mark in missing:
        print("%s has no line %s" % (PAGE, mark))
    if expected != page:
        print("%s: its tables are not those of %s: run scripts/performance.py --write --only" % (PAGE, FOLDER))
    return 1 if lacking or missing or expected != page else 0


def keep(known, program, entry):
    """Keeps the figures of a program, and puts them into the page."""
    measured = {**kept(ROOT), program: entry}
    with open(os.path.join(ROOT, FOLDER, "figures.json"), "w") as file:
        json.dump(measured, file, indent=1, sort_keys=True)
        file.write("\n")
    results_page.rewrite(os.path.join(ROOT, PAGE), lambda page: page_with(page, known, measured)[0])


def measure(arguments):
    known = described(ROOT)
    chosen = known["program"] if arguments.only is None else arguments.only
    for program in chosen:
        if program not in known["program"]:
            raise FigureError("no program '%s'; there are %s" % (program, ", ".join(known["program"])))
    for program in chosen:
        print("%s ..." % program, file=sys.stderr, flush=True)
        figures = run(program, known["program"][program], os.path.join(ROOT, arguments.build))
        of = results_page.commit()[:-1] + " on " + machine() + ", preset `" + os.path.basename(os.path.normpath(arguments.build)) + "`."
        for one in known["table"]:
            if one["program"] == program:
                print("\n## %s\n" % one["name"], *table(one, figures), sep="\n", flush=True)
        if arguments.write:
            keep(known, program, {"of": of, "figures": figures})
    if arguments.write:  # also where only the tables' descriptions have changed
        results_page.rewrite(os.path.join(ROOT, PAGE), lambda page: page_with(page, known, kept(ROOT))[0])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true", help="keep the figures and write the page")
    parser.add_argument("--build", default="build/dev", help="the build folder, with the target bench")
    parser.add_argument("--only", nargs="*", metavar="PROGRAM", help="measure these alone (none: only write the page)")
    parser.add_argument("--check", nargs="?", const=ROOT, metavar="ROOT", help="only compare page and figures")
    arguments = parser.parse_args()
    try:
        if arguments.check:
            sys.exit(check(arguments.check))
        measure(arguments)
    except FigureError as error:
        sys.exit("performance.py: %s" % error)


if __name__ == "__main__":
    main()
