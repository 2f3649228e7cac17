"""The pages of the C++ API: doxygen reads the public headers, breathe puts what it found into a page a library."""
import pathlib
import re
import subprocess
from xml.etree import ElementTree

# Libraries of which programs and plugins include headers, by the folder that has their include/, with what they are for.
LIBRARIES = (
    ("container/core", "ortung::container", "The sensor container", "Readings, what they should be at a pose, and how probable they are there."),
    ("container/base", "ortung::container, basics", "Poses, time, chance, parameters", "What all other headers are made of."),
    ("container/formats", "ortung::container, formats", "Formats of readings", "Scans, landmarks, odometry, poses, pictures as words, and back."),
    ("container/motion", "ortung::container, motion", "Motion models", "How a robot moves, for the filter and the simulator."),
    ("container/tables", "ortung::container, tables", "Tables", "What a sensor should read, for each cell of the floor."),
    ("container/records", "ortung::records", "Records", "Readings in files."),
    ("container/robot", "ortung::robot", "Robot files", "A robot's sensors as its file describes them."),
    ("container/camera", "ortung::camera", "Cameras", "Models of lenses."),
    ("mcl", "ortung::mcl", "Monte Carlo localization", "The filter, on the container's interface alone."),
    ("mcl/run", "ortung::run", "The main job", "Robot file, tables and source in; poses out."),
    ("mcl/study", "ortung::study", "Evaluations", "Errors, faults, cases; learning of motion."),
    ("sim/api", "ortung::sim_api", "Plugins of the simulator", "Sensors, drives, players and referees."),
    ("sim", "ortung::sim", "The simulator", "Worlds, robots and scenes within a program."),
    ("board/client", "ortung::client", "Clients", "A container that a server keeps up to date; C interface."),
    ("realsensors/core", "ortung::devices, drivers", "Drivers of devices", "What a driver of a robot's device implements."),
    ("play/learning", "ortung::learning", "Environments to learn in", "Batches of episodes."),
    ("play/benchmark", "ortung::benchmark", "Benchmark", "Goalkeepers against strikers, teams against teams."),
)

DOXYFILE = """
PROJECT_NAME = ortung
OUTPUT_DIRECTORY = {out}
GENERATE_HTML = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
XML_PROGRAMLISTING = NO
INPUT = {headers}
STRIP_FROM_PATH = {root}
FILE_PATTERNS = *.hpp *.h
EXTRACT_ALL = YES
EXTRACT_PRIVATE = NO
JAVADOC_AUTOBRIEF = YES
MARKDOWN_SUPPORT = YES
MACRO_EXPANSION = YES
EXPAND_ONLY_PREDEF = YES
PREDEFINED = ORTUNG_API= ORTUNG_INLINE=inline ORTUNG_SIMD=
QUIET = YES
WARNINGS = NO
WARN_IF_DOC_ERROR = NO
WARN_IF_INCOMPLETE_DOC = NO
HAVE_DOT = NO
"""


def headers(root, folder):
    return sorted(p for p in (root / folder / "include").rglob("*") if p.suffix in (".hpp", ".h"))


def read(root, out):
    """Runs doxygen. Returns the folder of its XML."""
    out = pathlib.Path(out)
    out.mkdir(parents=True, exist_ok=True)
    files = [str(p) for folder, *_ in LIBRARIES for p in headers(root, folder)]
    (out / "Doxyfile").write_text(DOXYFILE.format(out=out, root=root, headers=" ".join(files)))
    subprocess.run(["doxygen", str(out / "Doxyfile")], check=True)
    for file in (out / "xml").glob("*.xml"):
        file.write_text(for_breathe(file.read_text(encoding="utf-8")), encoding="utf-8")
    return out / "xml"


def for_breathe(xml):
    """Doxygen's XML without what breathe refuses: links to files and to members, of which some are no part of the site,
    several exceptions that have one description, and values that its parser of C++ does not know."""
    xml = re.sub(r'<ref refid="[^"]*" kindref="member">([^<]*)</ref>', r"\1", xml)
    xml = re.sub(r'<ref refid="\w+_8h(?:pp)?[^"]*" kindref="\w+">([^<]*)</ref>', r"\1", xml)
    xml = re.sub(r"<initializer>(?:=?\s*\{\s*\.|[^<]*\bORTUNG_).*?</initializer>", "", xml, flags=re.S)

    def together(match):
        names = re.findall(r"<parametername>(.*?)</parametername>", match[1])
        plain = ", ".join(re.sub(r"<[^>]+>", "", name).strip(",; ") for name in names)
        return f"<parameternamelist><parametername>{plain}</parametername></parameternamelist>"
    return re.sub(r"<parameternamelist>\s*((?:<parametername>.*?</parametername>\s*){2,})</parameternamelist>", together, xml)


class Index:
    """What doxygen found in each header: names and signatures, as breathe's directives want them."""

    KINDS = {"enum": "doxygenenum", "typedef": "doxygentypedef", "variable": "doxygenvariable", "function": "doxygenfunction"}
    HIDDEN = ("std", "ortung::widest")  # specializations; and what loops are compiled from

    def __init__(self, xml):
        self.directives = {}  # by header: {line: directive}
        for file in sorted(xml.glob("*.xml")):
            if file.name.startswith(("class", "struct", "namespace")):
                compound = ElementTree.parse(file).getroot().find("compounddef")
                name = compound.findtext("compoundname")
                if compound.get("kind") == "namespace":
                    self.members(name, compound)
                elif "<" not in name and not self.is_nested(xml, name):
                    self.add(compound.find("location"), f"doxygen{compound.get('kind')}:: {name}\n   :members:")

    @staticmethod
    def is_nested(xml, name):
        """Whether a class is part of another one, whose description has it."""
        outer = name.rpartition("::")[0].replace("_", "__").replace("::", "_1_1")
        return (xml / f"class{outer}.xml").exists() or (xml / f"struct{outer}.xml").exists()

    def members(self, namespace, compound):
        for member in compound.iter("memberdef"):
            if namespace in self.HIDDEN or member.get("kind") not in self.KINDS or not member.findtext("name"):
                continue
            name = f"{namespace}::{member.findtext('name')}"
            if member.get("kind") == "function":
                if member.findtext("name").startswith("operator"):
                    continue
                if any("(*" in "".join(p.itertext()) for p in member.iter("param")):
                    continue  # breathe's parser does not know parameters that are pointers to functions
                types = ["".join(p.find("type").itertext()).strip() for p in member.findall("param")]
                name += f"({', '.join(types)})"
            self.add(member.find("location"), f"{self.KINDS[member.get('kind')]}:: {name}")

    def add(self, location, directive):
        self.directives.setdefault(location.get("file"), {})[int(location.get("line")), directive] = directive

    def of(self, header):
        found = self.directives.get(header, {})
        return [line for at in sorted(found) for line in (".. " + found[at], "")]


def page(root, index, folder, target, title, what):
    lines = [title, "=" * len(title), "", what, "",
             f"Target ``{target.split(',')[0]}`` of ``find_package(ortung)``; in the repository: ``{folder}/include``.", ""]
    for header in headers(root, folder):
        name = str(header.relative_to(root / folder / "include"))
        if directives := index.of(str(header.relative_to(root))):
            lines += [header.name, "-" * len(header.name), "", f"``#include \"{name}\"``", "", *directives]
    return "\n".join(lines)


def write(root, xml, out):
    """Writes reference/cpp/*.rst below out, of what read() has found."""
    index = Index(xml)
    place = pathlib.Path(out) / "reference/cpp"
    place.mkdir(parents=True, exist_ok=True)
    lines = ["C++ API", "=======", "",
             "Public headers, from the comments in them. Most programs need two of them:",
             "``ortung/run/Localization.hpp`` does the whole job, ``ortung/core/SensorContainer.hpp`` holds the readings.", "",
             ".. toctree::", "   :maxdepth: 1", ""]
    for folder, target, title, what in LIBRARIES:
        name = folder.replace("/", "-")
        (place / (name + ".rst")).write_text(page(root, index, folder, target, title, what))
        lines.append(f"   {name}")
    (place / "index.rst").write_text("\n".join(lines) + "\n")
