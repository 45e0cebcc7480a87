"""Only what belongs there stands at the top of the project (part of make text).

Git is asked what is kept, so that a clone's own files, such as build/, do not count. Without git, as
in an unpacked archive, nothing is said. Only Python's standard library is used."""
import subprocess
import sys

AGREED = {"LICENSE", "Makefile", "README.md", "chapters", "figures", "src", "tests", "verify"}

listed = subprocess.run(["git", "ls-files"], capture_output=True, text=True)
found = {name.partition("/")[0] for name in listed.stdout.splitlines()} if listed.returncode == 0 else set()
stray = sorted(name for name in found - AGREED if not name.startswith("."))
sys.exit("\n".join(f"{name}: does not belong at the top of the project" for name in stray) or 0)
