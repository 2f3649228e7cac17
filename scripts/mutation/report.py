"""What a run found, as Markdown: how many were noticed in each room, and each survivor with its reason if there is one."""

import subprocess
from pathlib import Path

from . import tree

BEGIN, END = "<!-- mutants: begin -->", "<!-- mutants: end -->"


def found_again(survivors, found):
    """The places of today's sources that are the survivors of then, and survivors whose place is gone."""
    by_key = {}
    for site in found:
        by_key.setdefault(site.key(), site)
    chosen = [by_key[s.key()] for s in survivors if s.key() in by_key]
    return chosen, [s for s in survivors if s.key() not in by_key]


def reasons(file):
    """key -> why no test can tell it apart; a line `key` is followed by an indented reason."""
    known, key = {}, None
    for line in file.read_text().splitlines() if file.is_file() else []:
        if line.startswith("#") or not line.strip():
            continue
        if line.startswith("    "):
            known[key] = (known.get(key, "") + " " + line.strip()).strip()
        else:
            key = line.rstrip()
    return known


def commit():
    """What was tried, and when it was written: `1234567 (2026-01-31)`."""
    show = ["git", "-C", str(Path(__file__).parent), "show", "-s", "--format=%h (%cs)", "HEAD"]
    return subprocess.run(show, check=True, capture_output=True, text=True).stdout.strip()


def text(chosen, results, reasons_file, options):
    known = reasons(reasons_file)
    rows, survivors, total = [], [], [0, 0, 0]
    for room in sorted({tree.room_of(s.file) for s in chosen if s is not None}):
        here = [(n, s) for n, s in enumerate(chosen) if s is not None and tree.room_of(s.file) == room and n in results]
        noticed = sum(results[n] is not None for n, _ in here)
        alike = [s for n, s in here if results[n] is None and s.key() in known]
        survivors += [s for n, s in here if results[n] is None]
        counts = (len(here), noticed, len(alike))
        total = [a + b for a, b in zip(total, counts)]
        rows.append((room, *counts))
    rows.append(("all", *total))
    lines = ["| room | mutants | noticed by a test | can't be told apart | share of the others |", "| --- | --- | --- | --- | --- |"]
    for room, count, noticed, alike in rows:
        others = count - alike
        share = f"{100 * noticed / others:.0f} %" if others else "-"
        lines.append(f"| {room} | {count} | {noticed} | {alike} | {share} |")
    again = ", those that no test had noticed tried again after tests were added" if options.again else ""
    lines += ["", f"Seed {options.seed}, of commit {commit()}{again}. Not noticed:", ""]
    for site in survivors:
        why = known.get(site.key())
        lines.append(f"- `{site.file}:{site.line}` {site.function}: {site.change} in `{site.original[:90]}`" +
                     (f" - {why}" if why else ""))
    return "\n".join(lines)


def put(file, text):
    whole = file.read_text()
    head, rest = whole.split(BEGIN, 1)
    file.write_text(head + BEGIN + "\n" + text + "\n" + END + rest.split(END, 1)[1])
