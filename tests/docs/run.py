#!/usr/bin/env python3
"""Runs the commands of a page, in their order, in a folder of their own.

run.py --list --source ROOT   the pages with something to run
run.py PAGE --source ROOT --programs FOLDER[:FOLDER...] [--shelf FOLDER] [--python FOLDER] [--compiler "COMMAND"] [--link OPTIONS]

Marks in the page (blocks.py) say what a block needs. Ends with 1 if a command fails, or prints something else than the
page says; with 77 if all is well, but recordings of real robots are not here, or all of the page's commands are long.
"""
import argparse
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import urllib.request

import blocks
import isolation
from blocks import PageError

SECONDS = 300  # for one command: so long that only one that hangs takes it
LONG_SECONDS = 7200
SKIPPED = 77
PYTHON = "/usr/bin/python3"  # the one that the Python package is built for


class Missing(Exception):
    """A real recording that the page needs, and that is not here."""


class Session:
    """The folder in which a page's commands run, and what of them still runs."""

    def __init__(self, options):
        self.options = options
        self.root = pathlib.Path(options.source).resolve()
        self.top = pathlib.Path(tempfile.mkdtemp(prefix="ortung-page-"))
        self.folder = self.top / "ortung"   # as a clone, beside ../shared
        self.folder.mkdir()
        for name in ("maps", "examples", "scripts", "python"):
            (self.folder / name).symlink_to(self.root / name)
        for preset in ("dev", "release"):
            (self.folder / "build" / preset).mkdir(parents=True)
            (self.folder / "build" / preset / "bin").symlink_to(pathlib.Path(options.programs.split(":")[0]).resolve())
        if (self.root.parent / "shared").exists():
            (self.top / "shared").symlink_to(self.root.parent / "shared")
        self.environment = dict(os.environ, PATH=options.programs + ":" + os.environ["PATH"],
                                PYTHONPATH=options.python or "", PYTHONDONTWRITEBYTECODE="1",
                                CMAKE_GENERATOR=os.environ.get("CMAKE_GENERATOR", "Ninja"))
        for name in ("DISPLAY", "WAYLAND_DISPLAY"):  # no browser is opened
            self.environment.pop(name, None)
        self.serving = []
        self.count = 0  # of blocks that were run

    def close(self):
        for job in self.serving:
            job.kill()
        shutil.rmtree(self.top, ignore_errors=True)

    def give(self, block):
        for wanted in block.mark("given").words if block.mark("given") else []:
            name, _, item = wanted.partition("=")
            item = item or name
            source = self.root.parent / "shared" / item if item.startswith("data/") else self.shelf(item)
            if item.startswith("data/") and not source.exists():
                raise Missing(source)
            if not source.exists():
                raise PageError(block.page, block.mark("given").line, f"given {item}, but the shelf has no such file: "
                                "expected one that tests/docs/shelf.sh makes")
            place = self.folder / name
            if place.is_symlink():
                place.unlink()
            place.parent.mkdir(parents=True, exist_ok=True)
            if source.is_dir():
                place.symlink_to(source.resolve())
            else:
                shutil.copyfile(source, place)

    def shelf(self, item):
        return pathlib.Path(self.options.shelf or "/nowhere") / item

    def run(self, page, command, seconds):
        """Runs a command and returns what it printed. One that serves goes on running for those behind it, until another
        one serves or the block ends."""
        if serves(command.text):
            self.end_serving(page)
            job = Job(command, self)
            self.serving.append(job)
            job.await_port(page)
            return ""
        begin = time.monotonic()
        process = subprocess.Popen(["bash", "-c", command.text], cwd=self.folder, env=self.environment,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                   errors="replace", start_new_session=True)
        try:
            told, _ = process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            told, _ = process.communicate()
            raise PageError(page, command.line, f"'{command.text}' still runs after {seconds} s, expected its end; it said:\n"
                            + last(told)) from None
        if process.returncode != 0:
            raise PageError(page, command.line, f"'{command.text}' ends with exit code {process.returncode}, expected 0; "
                            f"it said:\n{last(told)}")
        print(f"  {page}:{command.line}: {time.monotonic() - begin:.1f} s  {command.text.splitlines()[0]}", flush=True)
        return told

    def end_serving(self, page):
        jobs, self.serving = self.serving, []
        for job in jobs:
            job.interrupt(page)


class Job:
    """A command that runs until somebody ends it."""

    def __init__(self, command, session):
        self.command = command
        self.text = command.text.rstrip().removesuffix("&").rstrip()
        self.before = isolation.listening_ports()
        self.out = session.top / f"told-{command.line}"  # a pipe that nobody reads would stop it
        with self.out.open("w") as out:
            self.process = subprocess.Popen(["bash", "-c", self.text], cwd=session.folder, env=session.environment,
                                            stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.STDOUT,
                                            start_new_session=True)

    def told(self):
        return self.out.read_text(errors="replace")

    def await_port(self, page):
        end = time.monotonic() + SECONDS
        shows = re.match(r"ortung (demo|view)\b|ortung .*--view\b", self.text, re.DOTALL)
        while not isolation.listening_ports() - self.before or (shows and "http://" not in self.told()):
            if self.process.poll() is not None:
                raise PageError(page, self.command.line, f"'{self.text}' has ended with exit code {self.process.returncode}, "
                                f"expected a server; it said:\n{last(self.told())}")
            if time.monotonic() > end:
                raise PageError(page, self.command.line, f"'{self.text}' does not listen after {SECONDS} s, or does not say where its page is; it said:\n"
                                + last(self.told()))
            time.sleep(0.05)

    def look(self, page):
        """Gets the page that the command says it serves."""
        for url in re.findall(r"http://[\w.:\[\]]+/", self.told())[:1]:
            try:
                with urllib.request.build_opener(urllib.request.ProxyHandler({})).open(url, timeout=SECONDS) as answer:
                    html = answer.read()
            except OSError as error:
                html = str(error).encode()
            if b"<html" not in html:
                raise PageError(page, self.command.line, f"'{self.text}' says that {url} is a page, but there is: {html[:200]}")

    def interrupt(self, page):
        """Control-C, or nothing if it has come to its end by itself. Either way it ends with 0."""
        self.look(page)
        if self.process.poll() is None:
            os.killpg(self.process.pid, signal.SIGINT)
        try:
            code = self.process.wait(timeout=SECONDS)
        except subprocess.TimeoutExpired:
            self.kill()
            raise PageError(page, self.command.line, f"'{self.text}' still runs {SECONDS} s after SIGINT; it said:\n"
                            + last(self.told())) from None
        if code not in (0, 130):
            raise PageError(page, self.command.line, f"'{self.text}' ends with exit code {code} after SIGINT, expected 0 or 130; "
                            f"it said:\n{last(self.told())}")
        print(f"  {page}:{self.command.line}: served, ended with {code}  {self.text.splitlines()[0]}", flush=True)

    def kill(self):
        if self.process.poll() is None:
            os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()


def serves(command):
    """Whether a command runs until somebody ends it."""
    if command.rstrip().endswith("&"):
        return True
    return bool(re.match(r"ortung (demo|view)\b|ortung .*--(view|listen)\b", command, re.DOTALL)) and not re.search(r"--(duration|once)\b", command)


def last(text, lines=30):
    return "\n".join("    " + line for line in text.splitlines()[-lines:])


def pattern(line):
    """What a page shows, with ... for any text."""
    return ".*".join(re.escape(part) for part in line.rstrip().split("..."))


def compare(page, first, expected, told):
    """A page's output with a command's; a line ... stands for any lines. Names the first line that is not there."""
    got = [line.rstrip() for line in told.splitlines()]
    at, anywhere = 0, False
    for number, line in enumerate(expected, first):
        if line.strip() == "...":
            anywhere = True
            continue
        places = range(at, len(got)) if anywhere else [at] if at < len(got) else []
        found = next((i for i in places if re.fullmatch(pattern(line), got[i])), None)
        if found is None:
            seen = repr(got[at]) if at < len(got) else "the end"
            raise PageError(page, number, f"the page shows '{line}', but printed was {seen}, of\n{last(told)}")
        at, anywhere = found + 1, False
    if not anywhere and at < len(got):
        raise PageError(page, first + len(expected) - 1, f"the page's output ends here, but printed was also '{got[at]}', of\n"
                        + last(told))


def is_left_out(block, excuse):
    """Whether something is not run here, and says so."""
    if excuse is None or excuse.word == "long" and os.environ.get("ORTUNG_LONG_DOCS") == "1":
        return False
    print(f"  {block.page}:{excuse.line}: not run here, {' '.join([excuse.word, *excuse.words])}: {excuse.reason}", flush=True)
    return True


def run_block(session, block):
    """Runs a block and returns what its commands printed."""
    seconds = LONG_SECONDS if block.mark("long") else SECONDS
    told = ""
    if block.language == "python":
        place = session.folder / "block.py"
        place.write_text(block.text())
        return session.run(block.page, blocks.Command(f"{PYTHON} block.py", block.line), seconds)
    if block.language == "cpp":
        text = block.text()
        if within := block.mark("within"):
            text = (session.root / "tests/docs/within" / within.words[0]).read_text()
            shown = f'#line {block.line + 1} "{block.page}"\n{block.text()}'
            text = re.sub(blocks.PLACE, lambda place: shown, text, flags=re.MULTILINE)
        (session.folder / "block.cpp").write_text(text)
        compiler = f"{session.options.compiler} -I{session.root}/tests/support"
        if within:
            return session.run(block.page, blocks.Command(f"{compiler} -fsyntax-only block.cpp", block.line), seconds)
        session.run(block.page, blocks.Command(f"{compiler} block.cpp -o block {session.options.link}", block.line), seconds)
        return session.run(block.page, blocks.Command("./block", block.line), seconds)
    if block.language == "toml":
        (session.folder / "block.toml").write_text(block.text())
        return session.run(block.page, blocks.Command("ortung check block.toml", block.line), seconds)
    for number, command in enumerate(block.commands(), 1):
        if is_left_out(block, block.excuse(number)):
            continue
        printed = session.run(block.page, command, seconds)
        if command.expected:
            compare(block.page, command.line + command.text.count("\n") + 1, command.expected, printed)
        told += printed
    session.end_serving(block.page)
    return told


def run_page(session, page):
    """Whether all was run: nothing was missing."""
    told, complete = None, True
    for block in blocks.blocks(session.root, page):
        if kept := block.mark("as"):
            place = session.folder / kept.words[0]
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_text(block.text())
    for block in blocks.blocks(session.root, page):
        if block.mark("prints"):
            if told is not None:
                compare(page, block.line + 1, block.lines, told)
            continue
        told = None
        if block.language not in blocks.COMMANDS | blocks.FILES or block.mark("as"):
            continue
        if is_left_out(block, block.excuse()):
            continue
        try:
            session.give(block)
            session.count += 1
            told = run_block(session, block)
        except Missing as missing:
            print(f"{page}:{block.line}: Skipped\n{missing} is not here", flush=True)
            complete = False
    if complete and session.count == 0:
        print(f"{page}: Skipped\nits commands are long: ORTUNG_LONG_DOCS=1 runs them")
    return complete and session.count > 0


def has_something(root, page):
    try:
        return any(map(runs_something, blocks.blocks(root, page)))
    except PageError:  # its test will say so
        return True


def runs_something(block):
    if block.language not in blocks.COMMANDS | blocks.FILES or block.mark("as"):
        return False
    excuses = [block.excuse(number) for number in range(1, len(block.commands()) + 1)] or [block.excuse()]
    return any(excuse is None or excuse.word == "long" for excuse in excuses)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page", nargs="?")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--source", required=True)
    for name in ("--programs", "--shelf", "--python", "--compiler", "--link"):
        parser.add_argument(name, default="")
    options = parser.parse_args()
    if options.list:
        print("\n".join(page for page in blocks.pages(options.source) if has_something(options.source, page)))
        return 0
    isolation.own_network()  # pages name fixed ports
    session = Session(options)
    try:
        return 0 if run_page(session, options.page) else SKIPPED
    except PageError as error:
        print(error)
        return 1
    finally:
        session.close()


if __name__ == "__main__":
    sys.exit(main())
