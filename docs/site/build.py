#!/usr/bin/python3
"""build.py OUT --program ORTUNG --version VERSION  builds the site: OUT/html, from the pages of the repository and what the program,
the Python package and the headers say of themselves. Any warning of Sphinx is an error. Ends with 77 if Sphinx or what it needs is
not here.

  --python FOLDER  where the package is, for this interpreter; without it, its page has signatures alone
  --quick          leaves the C++ API out
"""
import argparse
import hashlib
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys

import commands
import cpp_api
import keys
import python_api
import sources

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
NEEDED = {"sphinx": "python3-sphinx", "furo": "furo", "breathe": "python3-breathe", "myst_parser": "python3-myst-parser",
          "sphinx_copybutton": "python3-sphinx-copybutton"}
NORMALIZE = "/javascript/normalize.css/normalize.css"
SKIPPED = 77


def missing():
    """Debian packages that are not here."""
    packages = [package for module, package in NEEDED.items() if importlib.util.find_spec(module) is None]
    return packages + ([] if shutil.which("doxygen") else ["doxygen"])


def plugins(pages):
    """The page of the plugins' own pages."""
    return ("# Plugins\n\nWhat each sensor, motion model and source reads, gives and takes: its words, units and keys. "
            "`ortung plugins` lists those that are installed.\n\n```{toctree}\n:maxdepth: 1\n\n"
            + "\n".join("../" + page for page in pages) + "\n```\n")


def digest(*told):
    """Of all that the site is made of. @param told what the program said of itself"""
    found = hashlib.sha256("\0".join(told).encode())
    names = [name for pattern in ("*.md", "docs/**/*", "plugins/**/*.md", "mcl/*.md", "examples/*.md", "realsensors/*.md",
                                  "board/web/page/*.md", "python/ortung/*.pyi") for name in ROOT.glob(pattern)]
    names += [header for folder, *_ in cpp_api.LIBRARIES for header in cpp_api.headers(ROOT, folder)]
    for name in sorted(set(names)):
        if name.is_file() and "__pycache__" not in name.parts:
            found.update(str(name.relative_to(ROOT)).encode() + b"\0" + name.read_bytes())
    return found.hexdigest()


def make_pages(out, made, xml):
    """Writes all sources of the site below out.
    @param made pages that are made of what the program and the package say, by their names in reference/
    @param xml the folder of what doxygen has found; None: without the C++ API"""
    pages = sources.write(ROOT, out)
    place = out / "reference"
    (place / "cpp").mkdir(parents=True, exist_ok=True)
    for name, text in made.items():
        (place / name).write_text(text)
    (place / "plugins.md").write_text(plugins([page for page in pages if page.startswith("plugins/")]))
    if xml:
        cpp_api.write(ROOT, xml, out)
    else:
        (place / "cpp/index.rst").write_text("C++ API\n=======\n\nLeft out of this build.\n")


def run_sphinx(pages, html, version, xml):
    environment = dict(os.environ, ORTUNG_SITE_VERSION=version, ORTUNG_SITE_STATIC=str(ROOT / "docs/site/static"),
                       PYTHONDONTWRITEBYTECODE="1")
    if xml:
        environment["ORTUNG_SITE_DOXYGEN"] = str(xml)
    return subprocess.run([sys.executable, "-m", "sphinx", "-q", "-b", "html", "-n", "-W", "--keep-going", "-c",
                           str(ROOT / "docs/site"), "-d", str(html.parent / "doctrees"), str(pages), str(html)],
                          env=environment, check=False).returncode


def bring_normalize(html):
    """Debian's furo takes a style sheet from the root of the server that the site is on; a site is often no more than files."""
    style = html / "_static/styles/furo.css"
    text = style.read_text(encoding="utf-8")
    shutil.copy("/usr/share" + NORMALIZE, style.parent)
    style.write_text(text.replace(NORMALIZE, "normalize.css"), encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out")
    parser.add_argument("--program", required=True)
    parser.add_argument("--version", required=True)
    parser.add_argument("--python")
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    if packages := missing():
        print(f"Skipped\nthe site needs {' '.join(packages)}: scripts/install-deps.sh")
        return SKIPPED
    out = pathlib.Path(options.out).resolve()
    pages, html = out / "pages", out / "html"
    described = subprocess.run([options.program, "--describe"], check=True, capture_output=True, text=True).stdout
    try:
        made = {"commands.md": commands.page(described), "keys.md": keys.page(ROOT, options.program),
                "python.rst": python_api.page(ROOT, options.python)}
    except sources.SiteError as error:
        print(error)
        return 1
    made_of = f"{options.version} {options.quick} {digest(*made.values())}"
    if (out / "made-of").exists() and (out / "made-of").read_text() == made_of:
        print("the site is up to date")
        return 0
    (out / "made-of").unlink(missing_ok=True)
    for folder in (pages, html, out / "doctrees"):
        shutil.rmtree(folder, ignore_errors=True)
    xml = None if options.quick else cpp_api.read(ROOT, out / "doxygen")
    try:
        make_pages(pages, made, xml)
    except sources.SiteError as error:
        print(error)
        return 1
    if code := run_sphinx(pages, html, options.version, xml):
        return code
    bring_normalize(html)
    (html / "index.html").write_text('<!doctype html><meta charset="utf-8"><title>Ortung</title>'
                                     '<meta http-equiv="refresh" content="0; url=docs/index.html">'
                                     '<a href="docs/index.html">Ortung</a>\n')
    (out / "made-of").write_text(made_of)
    return 0


if __name__ == "__main__":
    sys.exit(main())
