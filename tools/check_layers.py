#!/usr/bin/env python3
"""Check the architecture of src/: who may use whom, and what must not appear.

    tools/check_layers.py [ROOT]       ROOT/src is checked; default: this project
    tools/check_layers.py --self-test  every rule has to find a small offender

Rules: a module uses only modules of its own or an earlier layer; file name = module name;
LAPACK, ARPACK and MUMPS only in linalg, hdf5 only in output; only src/app/main.f90 stops;
no `save`, said or implied, no variables of modules, no preprocessor.
"""

import re
import sys
import tempfile
from pathlib import Path

LAYERS = ["base", "linalg", "section", "element", "model", "deck", "system", "analysis",
          "output", "app"]
INTRINSIC = {"iso_fortran_env", "iso_c_binding", "ieee_arithmetic", "ieee_exceptions",
             "ieee_features"}
MAIN = "src/app/main.f90"

# Routines of LAPACK and BLAS in double precision, of ARPACK and of MUMPS.
NUMERICAL = re.compile(
    r"(d(sy|ge|po|pp|pb|gb|sb|sp|st|or|op|tr|tp|tb|la|gg|hs|pt|gt|bd)[a-z0-9]{2,5}"
    r"|d(gemm|gemv|symm|symv|syrk|trsm|trsv|axpy|scal|dot|copy|nrm2|ger|syr)"
    r"|[dn](sa|na|se|ne)upd|dmumps\w*)$")
DECLARATION = re.compile(
    r"(integer|real|logical|character|complex|double\s*precision|type\s*\(|class\s*\(|"
    r"procedure\s*\().*?::")
PROCEDURE = re.compile(r"(?:[\w\s()=*,]*\s)?(subroutine|function)\s+(\w+)")


def statements(text):
    """Statements as (line number, lower-case text): no comments, strings emptied, joined."""
    pending, start = "", 0
    for number, line in enumerate(text.splitlines(), 1):
        line = re.sub(r"\"[^\"]*\"|'[^']*'", "''", line)
        line = line.split("!")[0].strip().lower()
        if not line:
            continue
        start = start if pending else number
        pending += line.lstrip("&") if pending else line
        if pending.endswith("&"):
            pending = pending[:-1]
            continue
        for part in pending.split(";"):
            if part.strip():
                yield start, part.strip()
        pending = ""


class File:
    """One source file, checked statement by statement."""

    def __init__(self, path, root, layer_of):
        self.name = path.relative_to(root).as_posix()
        self.layer = path.parent.name
        self.stem = path.stem
        self.text = path.read_text(encoding="utf-8")
        self.layer_of = layer_of
        self.found = []

    def say(self, number, what):
        self.found.append(f"{self.name}:{number}: {what}")

    def check(self, own_procedures):
        if self.layer not in LAYERS or self.name.count("/") != 2:
            self.say(1, f"'{self.layer}' is not a layer")
            return self.found
        for number, line in enumerate(self.text.splitlines(), 1):
            if line.startswith("#"):
                self.say(number, "preprocessor line")
        lines = list(statements(self.text))
        self.check_names(lines)
        self.check_blocks(lines)
        for number, line in lines:
            self.check_use(number, line)
            self.check_words(number, line, own_procedures)
        return self.found

    def check_names(self, lines):
        names = [m[1] for _, line in lines if (m := re.match(r"(?:module|program)\s+(\w+)$", line))]
        expected = [self.stem] if self.name != MAIN else names[:1]
        if names != expected:
            self.say(1, f"holds {', '.join(names) or 'no module'}, not just {self.stem}")

    def check_use(self, number, line):
        match = re.match(r"use\b\s*(,\s*\w+\s*)?(::)?\s*(\w+)\s*(,\s*only\s*:)?", line)
        if not match:
            return
        module = match[3]
        if not match[4]:
            self.say(number, f"use of {module} without only:")
        if module in INTRINSIC or "intrinsic" in (match[1] or "").replace("non_", "x"):
            return
        if module in ("hdf5", "h5lt", "h5ds", "h5tb"):
            if self.layer != "output":
                self.say(number, f"{module} is for src/output")
        elif module not in self.layer_of:
            self.say(number, f"unknown module {module}")
        elif LAYERS.index(self.layer_of[module]) > LAYERS.index(self.layer):
            self.say(number, f"layer {self.layer} uses {module} of the later layer "
                             f"{self.layer_of[module]}")

    def check_words(self, number, line, own_procedures):
        if self.name != MAIN and re.search(r"(^|\)\s*|^\d+\s+)(error\s+)?stop(\s*$|\s+[\w'(])", line):
            self.say(number, "only main stops: return an error")
        if re.match(r"save(\s*$|\s*::|\s+\w+\s*(,|$))", line) or re.search(r",\s*save\b.*::", line):
            self.say(number, "save")
        if self.layer != "linalg":
            called = re.search(r"\bcall\s+(\w+)", line)
            if called and NUMERICAL.match(called[1]) and called[1] not in own_procedures:
                self.say(number, f"{called[1]} is for src/linalg")
            if re.match(r"include\b|external\b", line) or re.search(r",\s*external\b.*::", line):
                self.say(number, "external routines are for src/linalg")

    def check_blocks(self, lines):
        """Walk the nesting: module variables, implied save, interface bodies."""
        nest = []
        for number, line in lines:
            inside = nest[-1] if nest else ""
            if re.match(r"end\s*(module|program|subroutine|function|type|interface|enum)\b", line):
                nest = nest[:-1]
            elif re.match(r"(module|program)\s+(?!procedure)\w+$", line):
                nest.append("module" if line.startswith("module") else "procedure")
            elif re.match(r"type\s*(,|::|\s\w+$)", line) or line.startswith("enum"):
                nest.append("type")
            elif re.match(r"abstract\s+interface", line):
                nest.append("abstract")
            elif re.match(r"interface\b", line):
                nest.append("interface")
            elif not DECLARATION.match(line) and PROCEDURE.match(line):
                nest.append("procedure" if inside in ("", "module", "procedure") else "body")
                if inside == "interface" and "bind" not in line and self.layer != "linalg":
                    self.say(number, "interfaces to external routines are for src/linalg")
            elif DECLARATION.match(line) and "parameter" not in line.split("::")[0]:
                if inside == "module" and not self.only_counts(line, lines):
                    self.say(number, "variable of a module")
                elif inside == "procedure" and re.search(r"=", line.split("::", 1)[1]):
                    self.say(number, "initial value in a procedure implies save")

    @staticmethod
    def only_counts(line, lines):
        """An integer that only constant expressions name: the counter of an implied do."""
        name = re.match(r"integer\s*::\s*(\w+)$", line)
        others = [other for _, other in lines
                  if name and other != line and re.search(rf"\b{name[1]}\b", other)]
        return bool(others) and all(re.match(r"\w.*\bparameter\b.*::", o) for o in others)



def procedures(paths):
    """Names of all procedures the project itself defines in modules outside linalg."""
    names = set()
    for path in paths:
        if path.parent.name != "linalg":
            lines = [line for _, line in statements(path.read_text(encoding="utf-8"))]
            names |= {m[1] for line in lines
                      if (m := re.match(r"end\s+(?:subroutine|function)\s+(\w+)", line))}
    return names


def check(root):
    paths = sorted(p for p in (root / "src").rglob("*") if p.suffix.lower() in (".f90", ".f", ".inc"))
    layer_of = {p.stem: p.parent.name for p in paths if p.parent.name in LAYERS}
    found = [f"{p.name}: extension {p.suffix} is not .f90" for p in paths if p.suffix != ".f90"]
    own = procedures(paths)
    for path in paths:
        found += File(path, root, layer_of).check(own)
    return found, len(paths)


def module(body="", procedure_body="", name="one"):
    return (f"module {name}\nimplicit none\nprivate\n{body}\ncontains\nsubroutine work()\n"
            f"{procedure_body}\nend subroutine work\nend module {name}\n")


# path, source, what the check has to say about it ("" for nothing)
OFFENDERS = [
    ("src/base/one.f90", module(), ""),
    ("src/base/one.f90", module("use late, only: x"), "uses late of the later layer deck"),
    ("src/app/one.f90", module("use late, only: x"), ""),
    ("src/app/one.f90", module("USE :: late"), "without only"),
    ("src/app/one.f90", module("use nowhere, only: x"), "unknown module nowhere"),
    ("src/base/one.f90", module("use, intrinsic :: iso_c_binding, only: c_int"), ""),
    ("src/base/one.f90", module(name="two"), "not just one"),
    ("src/base/one.f90", module() + module(name="two"), "not just one"),
    ("src/basis/one.f90", module(), "not a layer"),
    ("src/deck/one.f90", module("use hdf5, only: hid_t"), "hdf5 is for src/output"),
    ("src/output/one.f90", module("use hdf5, only: hid_t"), ""),
    ("src/system/one.f90", module("", "call dsytrf(a)"), "dsytrf is for src/linalg"),
    ("src/system/one.f90", module("", "if (a) call dmumps(id)"), "dmumps is for src/linalg"),
    ("src/system/one.f90", module("", "call dsaupd(id)"), "dsaupd is for src/linalg"),
    ("src/linalg/one.f90", module("", "call dsytrf(a)"), ""),
    ("src/system/one.f90", module("", "include 'dmumps_struc.h'"), "for src/linalg"),
    ("src/system/one.f90", module("interface\nsubroutine f()\nend subroutine f\nend interface"),
     "interfaces to external routines"),
    ("src/system/one.f90", module("abstract interface\nsubroutine f()\nend subroutine f\n"
                                  "end interface"), ""),
    ("src/system/one.f90", module("interface\nsubroutine f() bind(c, name='exit')\n"
                                  "end subroutine f\nend interface"), ""),
    ("src/base/one.f90", module("", "stop"), "only main stops"),
    ("src/base/one.f90", module("", "if (bad(x)) error stop 'no'"), "only main stops"),
    ("src/base/one.f90", module("", "write (u, *) 'stop'  ! stop"), ""),
    (MAIN, "program spar\nstop 1\nend program spar\n", ""),
    ("src/base/one.f90", module("save"), "save"),
    ("src/base/one.f90", module("", "integer, save :: i"), "save"),
    ("src/base/one.f90", module("", "integer :: i, n = 0"), "implies save"),
    ("src/base/one.f90", module("", "real, &\n  pointer :: p => null()"), "implies save"),
    ("src/base/one.f90", module("", "integer, parameter :: n = 0"), ""),
    ("src/base/one.f90", module("integer :: counter"), "variable of a module"),
    ("src/base/one.f90", module("integer :: i_\nreal, parameter :: a(2) = [(2.0*i_, i_=1, 2)]"), ""),
    ("src/base/one.f90", module("integer :: i_", "i_ = 1"), "variable of a module"),
    ("src/base/one.f90", module("type :: t\ninteger :: n = 0\nend type t"), ""),
    ("src/base/one.f90", "#ifdef X\n" + module(), "preprocessor"),
    ("src/base/one.F90", module(), "is not .f90"),
]


def self_test():
    failures = 0
    for path, source, expected in OFFENDERS:
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for name, text in (("src/deck/late.f90", module(name="late")), (path, source)):
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text, encoding="utf-8")
            found, _ = check(root)
        if (expected == "" and found) or not any(expected in f for f in found or [""]):
            failures += 1
            print(f"check_layers: expected '{expected}', found {found} in {path}:\n{source}")
    if failures == 0:
        print(f"check_layers: self-test, {len(OFFENDERS)} samples judged as expected")
    return failures


def main(arguments):
    if arguments == ["--self-test"]:
        return 1 if self_test() else 0
    root = Path(arguments[0]) if arguments else Path(__file__).resolve().parent.parent
    found, files = check(root)
    print("\n".join(found) if found else f"check_layers: {files} files, nothing found")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
