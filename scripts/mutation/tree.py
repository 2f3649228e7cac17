"""A copy of the sources with mutants behind switches, built once."""

import hashlib
import json
import os
import random
import re
import shutil
import subprocess
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from . import sites as finding

# What is none of the program.
ASIDE = ("build", "docs", "examples", "scripts", "tests")


def rooms(root):
    """The top-level folders that hold sources of the program: none of them can be left out."""
    files = subprocess.run(["git", "ls-files", "-z", "*.cpp"], cwd=root, check=True, capture_output=True).stdout.decode()
    return sorted({f.split("/")[0] for f in files.split("\0") if "/" in f} - set(ASIDE))


def room_of(file):
    return file.split("/")[0]


def find(root, build, memory, jobs, say):
    """All sites of all rooms, found in the translation units of a configured build; in the file `memory`, too, for as long as
    nothing in the rooms changes."""
    known = rooms(root)
    units = [(s, a) for s, a in finding.compile_commands(build)
             if room_of(str(Path(s)).removeprefix(str(root) + "/")) in known]
    digest = hashlib.sha256(json.dumps(units).encode())
    for file in subprocess.run(["git", "ls-files", "-z", *known], cwd=root, check=True, capture_output=True).stdout.split(b"\0"):
        path = root / os.fsdecode(file)
        digest.update(file + (path.read_bytes() if path.is_file() else b""))
    if memory.is_file():
        remembered = json.loads(memory.read_text())
        if remembered["digest"] == digest.hexdigest():
            return [finding.Site(**s) for s in remembered["sites"]]
    with ProcessPoolExecutor(jobs) as pool:
        parts = list(pool.map(find_in, [root] * jobs, [units[i::jobs] for i in range(jobs)], [known] * jobs))
    found = {(site.file, site.change, json.dumps(site.edits)): site for part in parts for site in part}  # headers, once
    say(f"{len(units)} sources, {len(found)} places")
    memory.parent.mkdir(parents=True, exist_ok=True)
    memory.write_text(json.dumps({"digest": digest.hexdigest(), "sites": [s.to_json() for s in found.values()]}))
    return list(found.values())


def find_in(root, units, known):
    """What one process of several finds."""
    finder = finding.Finder(root)
    return [site for source, arguments in units for site in finder.sites(source, arguments, lambda file: room_of(file) in known)]


def choose(found, each, seed):
    """`each` sites of each room, drawn at random: first a kind of change, then a place, so that no kind prevails."""
    chosen = []
    for room in sorted({room_of(site.file) for site in found}):
        random_numbers = random.Random(f"{seed} {room}")
        kinds = {}
        for site in found:
            if room_of(site.file) == room:
                kinds.setdefault(site.kind, []).append(site)
        for sites in kinds.values():
            sites.sort(key=lambda s: (s.file, s.line, s.change, s.edits))
            random_numbers.shuffle(sites)
        taken = []
        while len(taken) < each and any(kinds.values()):
            kind = random_numbers.choice(sorted(k for k in kinds if kinds[k]))
            site = kinds[kind].pop()
            if not any(finding.overlapping(site, other) for other in taken):
                taken.append(site)
        chosen += taken
    return chosen


class Tree:
    """folder/source is the mutated copy, folder/build its build, folder/mutants.json what is in it."""

    def __init__(self, root, folder):
        self.root, self.folder = root, folder
        self.source, self.build = folder / "source", folder / "build"
        self.list = folder / "mutants.json"

    def files(self):
        """Names of the files that git knows."""
        names = subprocess.run(["git", "ls-files", "-z"], cwd=self.root, check=True, capture_output=True).stdout
        return {f for f in names.decode().split("\0") if f and (self.root / f).is_file()}

    def write(self, chosen):
        """Copies the files that git knows and writes the mutants into them; number = index in `chosen`."""
        self.folder.mkdir(parents=True, exist_ok=True)
        known = self.files()
        for file in known:
            self.put(file, self.mutated(file, list(enumerate(chosen))))
        if self.source.is_dir():
            for path in self.source.rglob("*"):
                if path.is_file() and str(path.relative_to(self.source)) not in known:
                    path.unlink()
        self.list.write_text(json.dumps([s.to_json() if s else None for s in chosen], indent=1))
        data = self.folder.parent / "shared"  # tests look for the recordings beside the sources' folder
        if (self.root.parent / "shared").is_dir():
            link = self.folder / "shared"
            link.unlink(missing_ok=True)
            link.symlink_to((self.root.parent / "shared").resolve())

    def mutated(self, file, numbered):
        text = (self.root / file).read_bytes()
        return finding.apply(text, [(n, s) for n, s in numbered if s is not None and s.file == file])

    def put(self, file, text):
        """Leaves files alone that are the same, so that only what changed is compiled again."""
        path = self.source / file
        if path.is_file() and path.read_bytes() == text:
            return
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text)
        shutil.copymode(self.root / file, path)

    def compile(self, chosen, jobs, say):
        """Builds; what does not compile with its mutants loses those that the compiler named."""
        header = self.source / "scripts/mutation/mutant.hpp"
        flags = f"-include {header} -w"
        subprocess.run(["cmake", "-S", self.source, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=RelWithDebInfo",
                        "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g0", f"-DCMAKE_CXX_FLAGS={flags}", "-DORTUNG_PYTHON=ON"],
                       check=True, stdout=subprocess.DEVNULL)
        for attempt in range(12):
            run = subprocess.run(["cmake", "--build", self.build, "--", "-k", "0", f"-j{jobs}"], text=True, capture_output=True)
            if run.returncode == 0:
                return chosen
            dropped = self.drop(chosen, run.stdout + run.stderr)
            say(f"attempt {attempt + 1}: {dropped} places don't compile and are left out")
            if dropped == 0:
                raise SystemExit("mutate: the build fails for another reason:\n" + (run.stdout + run.stderr)[-3000:])
            self.write(chosen)
        raise SystemExit("mutate: the build does not come right")

    def drop(self, chosen, output):
        prefix = str(self.source) + "/"
        places = re.findall(re.escape(prefix) + r"([^\s:]+):(\d+)", output)
        places += re.findall(r"(?:^|\s)(?:\.\./source/)([^\s:]+):(\d+)", output)
        errors = {(os.path.normpath(file), int(line)) for file, line in places}
        dropped = 0
        for number, site in enumerate(chosen):
            if site is not None and any((site.file, site.line + d) in errors for d in (-2, -1, 0, 1, 2)):
                chosen[number] = None
                dropped += 1
        return dropped
