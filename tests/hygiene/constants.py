#!/usr/bin/env python3
"""constants.py ROOT  says which constants of the filter have changed since docs/constants.md was measured, and which stand elsewhere
than in the header of their room."""
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
import constants  # noqa: E402

NUMBER = re.compile(r"^(?:inline )?(?:static )?constexpr (?:double|float|int) (k\w+)\b", re.M)
# Numbers that nothing is tuned by: bounds of what is taken from others, rounding, tolerances of a solution, streams of random
# numbers, shapes of tables.
FIXED = {
    "belief/Confidence.hpp": {"kBeyondTracking", "kBeyondUncertain"},  # what is promised
    "belief/GivenBelief.cpp": {"kFarthest", "kRounding"},
    "belief/Resampling.cpp": {"kLeastWeight"},
    "filter/MclConfig.cpp": {"kMostSamples", "kRounding"},
    "map/MapChanges.cpp": {"kRounding"},
    "map/MapWatch.cpp": {"kFarthest"},
    "readings/NewReadings.cpp": {"kMostNats"},
    "refine/Polish.cpp": {"kSettledMetres", "kSettledRadians", "kSettledShare"},
    "refine/Steps.cpp": {"kMetres", "kRadians"},  # what is promised
    "rivals/Delays.cpp": {"kSmallest"},
    "search/FieldSearch.cpp": {"kMostNats", "kNowhere"},
}
REFERENCE = {"grid"}  # the grid filter is no part of the filter


def strays(root):
    for file in sorted((root / "mcl/src").glob("*/*.[ch]pp")):
        room = file.parent.name
        if room in REFERENCE:
            continue
        for name in NUMBER.findall(file.read_text()):
            if name not in FIXED.get("%s/%s" % (room, file.name), ()):
                yield "%s: %s belongs into %sTuning.hpp, with its unit and where it comes from" % (
                    file.relative_to(root), name, room.capitalize())


def main():
    page = (ROOT / "docs/constants.md").read_text()
    declared = constants.declared(ROOT)
    trouble = list(strays(ROOT)) + constants.differences(declared, page)
    missing = len(constants.unmeasured(declared, page))
    print("constants: %d, of which %d were not measured yet (scripts/sweep.py)" % (len(declared), missing))
    print("\n".join([*trouble, constants.since_the_fit(declared, page)]).strip())
    return 1 if trouble else 0


if __name__ == "__main__":
    sys.exit(main())
