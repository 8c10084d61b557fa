"""Shipped files fit the schemas that `graspbench help FILE --schema` prints, and spoilt copies do not.

python3 validate_examples.py GRASPBENCH SOURCE
"""
import copy
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import jsonschema
import yaml

program, source = sys.argv[1], pathlib.Path(sys.argv[2])
EXAMPLES = {
    "object.yaml": "objects/catalogue/*/object.yaml",
    "hand.yaml": "core/hand/models/*/hand.yaml",
    "tactile.yaml": "core/hand/models/*/tactile.yaml",
    "arm.yaml": "core/arm/models/*/arm.yaml",
    "session.yaml": "datasets/presets/*.yaml",
    "study.yaml": "human_study/examples/*/study.yaml",
    "benchmark.yaml": "datasets/benchmarks/*.yaml",
    "profile.yaml": "datasets/profiles/*.yaml",
    "policy.yaml": "workbench/python/examples/*.yaml",
    "columns.yaml": "human_study/examples/*/columns.yaml",
    "pipeline.yaml": "datasets/pipelines/*[!n].yaml",  # but for small_session.yaml
}
# PyYAML knows YAML 1.1, in which 1.1e6 is a text.
yaml.SafeLoader.add_implicit_resolver("tag:yaml.org,2002:float",
                                      re.compile(r"^[-+]?[0-9.]+[eE][-+]?[0-9]+$"),
                                      list("-+.0123456789"))
made = tempfile.TemporaryDirectory()
subprocess.check_call([program, "new", "grasp", f"{made.name}/grasp"], stdout=subprocess.DEVNULL)
examples = {name: (source, pattern) for name, pattern in EXAMPLES.items()}
examples["grasp.yaml"] = (pathlib.Path(made.name), "grasp/*.yaml")
failures, num_files = [], 0
for name, (folder, pattern) in examples.items():
    schema = json.loads(subprocess.check_output([program, "help", name, "--schema"]))
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    files = sorted(folder.glob(pattern))
    if not files:
        failures.append(f"{name}: no file {pattern}")
    for file in files:
        content = yaml.safe_load(file.read_text())
        num_files += 1
        for error in validator.iter_errors(content):
            failures.append(f"{file}: {list(error.absolute_path)}: {error.message}")
        spoilt = copy.deepcopy(content)
        spoilt["no_such_key"] = 1
        if validator.is_valid(spoilt):
            failures.append(f"{file}: takes a key that no format has")
    if "required" in schema and validator.is_valid({}):
        failures.append(f"{name}: an empty file is taken")
print(f"{num_files} files, {len(failures)} failures", *failures, sep="\n")
sys.exit(1 if failures or num_files < 40 else 0)
