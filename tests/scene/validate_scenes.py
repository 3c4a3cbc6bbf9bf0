"""Usage: validate_scenes.py SCHEMA DOCUMENTS

Checks the JSON Schema in the file SCHEMA against its own dialect, and each document of the list in the file
DOCUMENTS against it. Prints one line for each: "ok", or where it fails and why.
"""
import json
import sys

from jsonschema import Draft7Validator


def verdict(validator, document):
    error = next(validator.iter_errors(document), None)
    if error is None:
        return "ok"
    place = "/".join(["", *map(str, error.absolute_path)])
    return f"{place}: {error.message[:200]}".replace("\n", " ")


with open(sys.argv[1], encoding="utf-8") as file:
    schema = json.load(file)
Draft7Validator.check_schema(schema)
with open(sys.argv[2], encoding="utf-8") as file:
    documents = json.load(file)
for item in documents:
    print(verdict(Draft7Validator(schema), item))
