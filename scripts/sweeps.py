"""Evaluations of scripts as sweeps: what varies goes into a file that `ortung sweep` runs, here or on any cluster. What is done stays
done: a script that was stopped goes on where it was, and what was made by another program or from other files is made anew."""
import json
import os
import subprocess
import sys


class Sweeps:
    """The sweeps of one folder: each a file NAME.toml, with its results in the folder NAME."""

    def __init__(self, ortung, out, jobs=1):
        self.ortung, self.jobs = os.path.abspath(ortung), jobs
        self.folder = os.path.join(os.path.abspath(out), "sweeps")
        self.ran = 0  # tasks, of all sweeps
        os.makedirs(self.folder, exist_ok=True)

    def tasks(self, name, command, vary):
        """Runs what is not done of a command with all combinations of values.
        @param command words with {key}, paths absolute @param vary {key: values}, as in the sweep's file
        @returns by task, in their order, "values" {key: name}, "figures" as the command's JSON has them, and for those that failed,
          whose figures are None, what they said as "failed" """
        file = os.path.join(self.folder, name + ".toml")
        with open(file, "w") as out:
            out.write("command = %s\n\n[vary]\n" % toml([str(word) for word in command]))
            out.writelines("%s = %s\n" % (key, toml(values)) for key, values in vary.items())
        results = os.path.join(self.folder, name)
        done = subprocess.run([self.ortung, "sweep", "run", file, "--dir", results, "--jobs", str(self.jobs), "--progress"],
                              stdout=subprocess.PIPE, text=True)
        if done.returncode not in (0, 1):
            sys.exit("%s: `ortung sweep run` ends with %d" % (file, done.returncode))
        json_file = os.path.join(self.folder, name + ".json")
        subprocess.run([self.ortung, "sweep", "table", results, "--json", json_file, "--force"], check=True, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
        with open(json_file) as text:
            tasks = json.load(text)["tasks"]
        os.remove(json_file)
        self.ran += len(tasks)
        return tasks

    def groups(self, name, command, vary):
        """The same by what else than the seed varies: {(names of the other values): figures of all seeds}; trouble ends the script."""
        found = {}
        for task in self.tasks(name, command, vary):
            if task["figures"] is None:
                sys.exit("%s, %s: %s" % (name, task["task"], task.get("failed", "not done")))
            found.setdefault(tuple(v for k, v in task["values"].items() if k != "seed"), []).append(task["figures"])
        return found


def toml(value):
    """A text, number, list or table as TOML has it."""
    if isinstance(value, dict):
        return "{ %s }" % ", ".join("%s = %s" % (key, toml(one)) for key, one in value.items())
    if isinstance(value, (list, tuple)):
        return "[%s]" % ", ".join(toml(one) for one in value)
    return json.dumps(value)


def seeds(count):
    return "1..%d" % count
