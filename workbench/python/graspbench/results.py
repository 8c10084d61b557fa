"""Sessions in Python: run one, its trials as a table of pandas, one trial as arrays of numpy."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile

import numpy as np


def find_program():
    """GRASPBENCH where it is set, else graspbench on the PATH.

    Raises RuntimeError where there is none."""
    program = shutil.which(os.environ.get("GRASPBENCH", "graspbench"))
    if not program:
        raise RuntimeError("the program graspbench was not found; add its folder to PATH, or set GRASPBENCH to its path")
    return program


def run(out, *options):
    """Runs `graspbench run --out OUT OPTIONS..`, or continues it, and gives its folder.

    Raises RuntimeError with the program's message."""
    resume = ["--resume"] if (pathlib.Path(out) / "session.json").exists() else []
    _call(["run", "--out", str(out), *resume, *([] if resume else map(str, options))])
    return pathlib.Path(out)


def load(folder):
    """A row per trial, as the session's export/trials.csv has it. `attrs["columns"]` of the table says unit and
    meaning of each column. Needs pandas. Raises ValueError where the table and its dictionary differ."""
    import pandas

    export = pathlib.Path(folder) / "export"
    schema = json.loads((export / "trials.schema.json").read_text())
    texts = {field["name"]: str for field in schema["fields"] if field["type"] == "string"}
    table = pandas.read_csv(export / "trials.csv", dtype=texts, keep_default_na=False, na_values=[""])
    if list(table.columns) != [field["name"] for field in schema["fields"]]:
        raise ValueError(f"{export / 'trials.csv'} has other columns than trials.schema.json; "
                         f"graspbench export {folder} writes both again")
    table.attrs["columns"] = {field["name"]: field for field in schema["fields"]}
    return table


def trial(folder, trial_id):
    """One trial, run again from its record: a dict with

    states, actions  by column, as "time_s": arrays over time, 60 a second
    contacts         by column, over all contacts of all instants; `instant` says which
    phases           of each instant
    events, attrs    what happened when; ids, outcome and reason

    Needs h5py."""
    import h5py

    with tempfile.TemporaryDirectory() as place:
        path = str(pathlib.Path(place) / "trial.h5")
        _call(["trial", str(folder), trial_id, "--trajectory", path])
        with h5py.File(path) as file:
            demo = file["data/demo_0"]
            result = {name: {str(column): np.array(demo[name][:, i])
                             for i, column in enumerate(demo[name].attrs["columns"])}
                      for name in ("states", "actions", "contacts")}
            result["phases"] = np.array(demo["phases"])
            attributes = dict(demo.attrs)
            result["events"] = json.loads(attributes.pop("events"))
            result["attrs"] = attributes
            return result


def _call(arguments):
    done = subprocess.run([find_program(), *arguments], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"graspbench {arguments[0]} ended with {done.returncode}: {done.stderr.strip()}")
    return done.stdout
