"""Imports all that the scripts in some folders import from packages, and prints what fails, one
package a line.

    python imports.py FOLDER ...

Folders below them that have a requirements.txt are left out: they have environments of their own.
"""

import ast
import sys
from pathlib import Path


def scripts_below(folder):
    others = [file.parent for file in folder.rglob("requirements.txt") if file.parent != folder]
    for script in folder.rglob("*.py"):
        if not any(other in script.parents for other in others):
            yield script


scripts = [script for folder in sys.argv[1:] for script in scripts_below(Path(folder))]
# The scripts' modules for each other, and the standard library.
others = {name for s in scripts for name in (s.stem, s.parent.name)} | sys.stdlib_module_names

imports = set()
for script in scripts:
    for node in ast.walk(ast.parse(script.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            imports |= {(a.name.split(".")[0], f"import {a.name}") for a in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            imports.add((node.module.split(".")[0], ast.unparse(node)))

failures = {}
for package, statement in sorted(imports):
    if package not in others and package not in failures:
        try:
            exec(statement, {})
        except Exception as error:
            failures[package] = f"{package} ({type(error).__name__}: {error})"

print("\n".join(failures.values()))
sys.exit(bool(failures))
