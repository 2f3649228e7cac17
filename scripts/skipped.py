#!/usr/bin/env python3
"""Says how many tests were skipped and why: skipped.py JUNIT.XML (of ctest --output-junit)."""
import collections
import re
import sys
import xml.etree.ElementTree as xml


def reason(output):
    """What the test said when it skipped itself: the line behind GoogleTest's "FILE:LINE: Skipped"."""
    found = re.search(r"^.*: Skipped\n(.+)$", output, re.MULTILINE)
    found = found or re.search(r"^skipped: (.+)$", output, re.MULTILINE)
    if not found:
        return "(no reason was given)"
    text = found.group(1).strip()
    # Each of these names a recording of its own; what is missing is the folder.
    return "real recordings are not here (../shared/data)" if "shared/data" in text else text


def main():
    tests = xml.parse(sys.argv[1]).getroot().findall("testcase")
    skipped = [t for t in tests if t.find("skipped") is not None]
    if not skipped:
        print(f"skipped: none of {len(tests)} tests")
        return
    print(f"skipped: {len(skipped)} of {len(tests)} tests, which say nothing of what they hold:")
    counts = collections.Counter(reason(t.findtext("system-out") or "") for t in skipped)
    for text, count in counts.most_common():
        print(f"  {count:4} {text}")


if __name__ == "__main__":
    main()
