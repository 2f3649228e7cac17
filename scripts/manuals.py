#!/usr/bin/env python3
"""manuals.py DESCRIPTION VERSION OUT [PROGRAM...]  makes man pages and completion for shells of what `ortung --describe` printed into the
file DESCRIPTION: OUT/man/*.1.gz, OUT/completions/ortung.bash, _ortung (zsh) and ortung.fish; and pages of other programs by their --help."""
import gzip
import json
import pathlib
import re
import subprocess
import sys

HELP = "ortung"
ABOUT = "learn what sensors see, and localize with it"


def roff(text):
    """Text as troff takes it: no line begins with a control character, no blank line splits what belongs together."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^([.'])", r"\\&\1", text, flags=re.M)


def option_head(option):
    if not option["names"]:
        return f"\\fI{roff(option['positional'])}\\fR"
    head = ", ".join(f"\\fB{roff(name)}\\fR" for name in option["names"])
    if option["flag"]:
        return head
    value = "|".join(option.get("choices", [])) or "VALUE"
    return f"{head} \\fI{roff(value)}\\fR"


def page(command, version):
    name = command["name"].replace(" ", "-")
    lines = [f'.TH {name.upper()} 1 "" "Ortung {version}" "Ortung"', ".SH NAME",
             f"{roff(name)} \\- {roff(command['summary'])}", ".SH SYNOPSIS", f".B {roff(command['name'])}"]
    words = []
    for option in command["options"]:
        if option["names"] and not option["required"]:
            continue
        text = option_head(option)
        if option["many"]:
            text += " ..."
        words.append(text if option["required"] else f"[{text}]")
    lines += ["\n".join(words + ["[\\fIoptions\\fR]"]), ".SH OPTIONS"]
    for option in command["options"]:
        help_text = roff(option["help"])
        if option.get("default"):
            help_text += f"; default: {roff(option['default'])}"
        lines += [".TP", option_head(option), help_text or "\\&"]
    lines += [".SH NOTES", ".nf", roff(command["footer"].strip()), ".fi"]
    lines += [".SH SEE ALSO", ".BR ortung (1)"]
    return "\n".join(lines) + "\n"


def page_of_help(name, text, version):
    """A page of a program that tells its help alone, whose first line is a summary."""
    summary, _, rest = text.strip().partition("\n")
    return "\n".join([f'.TH {name.upper()} 1 "" "Ortung {version}" "Ortung"', ".SH NAME", f"{roff(name)} \\- {roff(summary)}",
                      ".SH DESCRIPTION", ".nf", roff(rest.strip()), ".fi", ".SH SEE ALSO", ".BR ortung (1)"]) + "\n"


def main_page(commands, version):
    lines = [f'.TH ORTUNG 1 "" "Ortung {version}" "Ortung"', ".SH NAME", f"ortung \\- {ABOUT}", ".SH SYNOPSIS",
             ".B ortung\n\\fIcommand\\fR [\\fIoptions\\fR]", ".SH DESCRIPTION",
             "Robots that have to know where they are, with whatever sensors they have. Each command has a page of its own.",
             ".SH COMMANDS"]
    for command in commands:
        page_name = command["name"].replace(" ", "-")
        lines += [".TP", f".BR {roff(page_name)} (1)", roff(command["summary"])]
    lines += [".SH ENVIRONMENT",
              ".TP", "\\fBORTUNG_PLUGIN_PATH\\fR", "Folders with further plugins, with colons between them.",
              ".TP", "\\fBORTUNG_MAPS_PATH\\fR", "Folder of worlds and robots in place of those that are installed."]
    return "\n".join(lines) + "\n"


def tree_of(commands):
    """First words, and second words by first word."""
    first, second = [], {}
    for command in commands:
        words = command["name"].split()[1:]
        if words[0] not in first:
            first.append(words[0])
        if len(words) > 1:
            second.setdefault(words[0], []).append(words[1])
    return first, second


def long_names(command):
    return [name for option in command["options"] for name in option["names"] if name.startswith("--")]


def bash(commands):
    first, second = tree_of(commands)
    lines = ["# Completion of ortung for bash.", "_ortung() {",
             '  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]} at=1',
             "  COMPREPLY=()",
             "  if ((COMP_CWORD == 1)); then",
             f"    COMPREPLY=($(compgen -W '{' '.join(first)} --help --version' -- \"$word\"))", "    return", "  fi",
             "  case $command in"]
    for name, words in second.items():
        lines += [f"    {name})", "      if ((COMP_CWORD == 2)); then",
                  f"        COMPREPLY=($(compgen -W '{' '.join(words)} --help' -- \"$word\"))", "        return", "      fi",
                  '      command+=" ${COMP_WORDS[2]}" at=2', "      ;;"]
    lines += ["  esac", '  case "$command $before" in']
    for command in commands:
        short = command["name"].partition(" ")[2]
        for option in command["options"]:
            if option.get("choices"):
                for name in option["names"]:
                    lines.append(f"    '{short} {name}') COMPREPLY=($(compgen -W '{' '.join(option['choices'])}' -- "
                                 '"$word")); return ;;')
    lines += ["  esac", "  if [[ $word == -* ]]; then", "    case $command in"]
    for command in commands:
        short = command["name"].partition(" ")[2]
        lines.append(f"      '{short}') COMPREPLY=($(compgen -W '{' '.join(long_names(command))}' -- \"$word\")) ;;")
    lines += ["    esac", "  else", '    COMPREPLY=($(compgen -f -- "$word"))', "  fi", "}",
              "complete -o filenames -F _ortung ortung"]
    return "\n".join(lines) + "\n"


def quoted(text):
    return "'" + text.replace("'", "'\\''") + "'"


def zsh(commands):
    first, second = tree_of(commands)
    about = {command["name"].partition(" ")[2]: command["summary"] for command in commands}

    def described(words, prefix=""):
        return " ".join(quoted(f"{word}:{about.get((prefix + word), word).replace(':', ',')}") for word in words)

    lines = ["#compdef ortung", "# Completion of ortung for zsh.", "local -a commands",
             "if ((CURRENT == 2)); then", f"  commands=({described(first)})", "  _describe command commands", "  return",
             "fi", "local command=$words[2]", "case $command in"]
    for name, words in second.items():
        lines += [f"  {name})", "    if ((CURRENT == 3)); then", f"      commands=({described(words, name + ' ')})",
                  "      _describe command commands", "      return", "    fi", '    command="$command $words[3]"',
                  "    shift words; ((CURRENT--))", "    ;;"]
    lines += ["esac", "shift words; ((CURRENT--))", "case $command in"]
    for command in commands:
        lines.append(f"  {quoted(command['name'].partition(' ')[2])})")
        specs = []
        for option in command["options"]:
            help_text = re.sub(r"[\[\]:]", " ", option["help"])
            for name in option["names"]:
                if not name.startswith("--"):
                    continue
                action = f"({' '.join(option['choices'])})" if option.get("choices") else "_files"
                value = "" if option["flag"] else f":value:{action}"
                specs.append(quoted(f"*{name}[{help_text}]{value}"))
        specs.append(quoted("*:file:_files"))
        lines += ["    _arguments " + " \\\n      ".join(specs), "    ;;"]
    lines += ["esac"]
    return "\n".join(lines) + "\n"


def fish(commands):
    first, second = tree_of(commands)
    about = {command["name"].partition(" ")[2]: command["summary"] for command in commands}

    def text(words):
        return "'" + words.replace("\\", "\\\\").replace("'", "\\'") + "'"

    lines = ["# Completion of ortung for fish."]
    for name in first:
        lines.append(f"complete -c ortung -f -n __fish_use_subcommand -a {name} -d {text(about.get(name, name))}")
    for group, words in second.items():
        for word in words:
            lines.append(f"complete -c ortung -f -n '__fish_seen_subcommand_from {group}; and not "
                         f"__fish_seen_subcommand_from {' '.join(words)}' -a {word} -d {text(about[group + ' ' + word])}")
    for command in commands:
        words = command["name"].split()[1:]
        condition = "; and ".join(f"__fish_seen_subcommand_from {word}" for word in words)
        for option in command["options"]:
            for name in option["names"]:
                if not name.startswith("--"):
                    continue
                value = "" if option["flag"] else " -r"
                if option.get("choices"):
                    value = f" -x -a {text(' '.join(option['choices']))}"
                lines.append(f"complete -c ortung -n '{condition}' -l {name[2:]}{value} -d {text(option['help'])}")
    return "\n".join(lines) + "\n"


def write_page(file, text):
    """The same bytes for the same text: without a name or a time within."""
    file.write_bytes(gzip.compress(text.encode(), 9, mtime=0))


def main():
    description, version, out, *programs = sys.argv[1:]
    commands = [json.loads(line) for line in pathlib.Path(description).read_text().splitlines() if line]
    if not commands:
        sys.exit(f"manuals: {description} describes no command")
    man = pathlib.Path(out) / "man"
    completions = pathlib.Path(out) / "completions"
    for folder in (man, completions):
        folder.mkdir(parents=True, exist_ok=True)
        for old in folder.iterdir():
            old.unlink()
    for command in commands:
        write_page(man / f"{command['name'].replace(' ', '-')}.1.gz", page(command, version))
    for program in map(pathlib.Path, programs):
        said = subprocess.run([program, "--help"], check=True, capture_output=True, text=True).stdout
        write_page(man / f"{program.name}.1.gz", page_of_help(program.name, said, version))
    write_page(man / "ortung.1.gz", main_page(commands, version))
    (completions / "ortung.bash").write_text(bash(commands))
    (completions / "_ortung").write_text(zsh(commands))
    (completions / "ortung.fish").write_text(fish(commands))


if __name__ == "__main__":
    main()
