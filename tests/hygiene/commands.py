#!/usr/bin/env python3
"""commands.py COMMANDS LIBRARIES GOLDEN  whether each command of the program loads just those foreign libraries that GOLDEN
says: those that its module and the libraries of ours behind it need. Prints what the file would have to say."""
import pathlib
import re
import subprocess
import sys

STANDARD = re.compile(r"(libstdc\+\+|libm|libc|libgcc_s|libpthread|libdl|ld-linux.*)\.so")


def needed(file):
    text = subprocess.run(["readelf", "-d", file], check=True, capture_output=True, text=True).stdout
    return re.findall(r"\(NEEDED\).*\[(.*)\]", text)


def foreign(file, libraries, seen):
    found = set()
    for name in needed(file):
        if name in seen or STANDARD.match(name):
            continue
        seen.add(name)
        ours = libraries / name
        found |= foreign(ours, libraries, seen) if ours.exists() else {re.sub(r"\.so.*", "", name)}
    return found


def main():
    commands, libraries, golden = map(pathlib.Path, sys.argv[1:4])
    told = {}
    for line in golden.read_text().splitlines():
        if line and not line.startswith("#"):
            command, _, names = line.partition(":")
            told[command] = set(names.split())
    found = {}
    for file in sorted(commands.glob("ortung_command_*.so")):
        found[file.stem.removeprefix("ortung_command_")] = foreign(file, libraries, set())
    if not found:
        print(f"{commands}: has no commands")
        return 1
    status = 0
    for command in sorted(told.keys() | found.keys()):
        if command not in told:
            print(f"{golden}: does not name the command {command}")
        elif command not in found:
            print(f"{commands}: has no {command}, which {golden} names")
        elif told[command] != found[command]:
            for name in sorted(found[command] - told[command]):
                print(f"{command} must not load {name}")
            for name in sorted(told[command] - found[command]):
                print(f"{command} does not load {name} any more: take it out of {golden}")
        else:
            continue
        status = 1
    if status:
        print("found:")
        for command, names in found.items():
            print(f"{command}: {' '.join(sorted(names))}".rstrip())
    return status


if __name__ == "__main__":
    sys.exit(main())
