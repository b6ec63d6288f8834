#!/usr/bin/env python3
"""Run the validation problems and write docs/validation.md, or compare with it.

    tools/validation.py            run all, write the page and its pictures (needs matplotlib)
    tools/validation.py --check    run all; exit 1 if an error is larger than allowed, or the
                                   page's numbers are not those of this run
    tools/validation.py --only STA-01 [--only ...]    run some, print them, write their pictures

The program is $SPAR_PROGRAM or build/spar. Called by `make validation`.
"""
import argparse
import os
import re
import sys
import tempfile

from problems import (buckling, channel, flexures, frequencies, mechanisms, motions, paths, sliders,
                      static, turning)
from problems.kit import ROOT, Bench, short

PAGE = ROOT / "docs" / "validation.md"
PROBLEMS = [*static.PROBLEMS, *flexures.PROBLEMS, *channel.PROBLEMS, *paths.PROBLEMS,
            *buckling.PROBLEMS, *frequencies.PROBLEMS, *motions.PROBLEMS,
            *motions.FROM_VELOCITIES, *mechanisms.PROBLEMS, *sliders.PROBLEMS,
            *turning.PROBLEMS]
SAME = 2e-5  # what the same program may differ by on another machine, with rounding of the page
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")

HEAD = """# Validation

Written by `make validation` from runs of the decks named here; `tools/validation.py --check` runs
them again and fails if an error is larger than allowed, or if a number on this page is not that of
the run (to {same}, or one in the last digit printed; errors are not compared, the numbers are).

An error is relative to the reference, (spar - reference)/reference. References are of these kinds:
- **closed form**, **exact solution**: the beam theory solved without elements;
- **published**: printed by the authors named;
- **other program**: an independent implementation of the same element, or a shell model; its own
  discretization error remains.

Element options are the defaults (SECOND CONSISTENT, MASS CONSISTENT) unless said. JONKER is the
element as the paper prints it: J. B. Jonker, "Implementation of Shear Deformable Thin-Walled Beam
Element for Flexible Multibody Dynamics".

| problem | reference | error nearest its limit | allowed error |
|---|---|---|---|
"""


def write(problems):
    """The page."""
    lines = [HEAD.format(same=short(SAME))]
    for p in problems:
        worst = p.worst()
        anchor = re.sub(r"[^\w -]", "", f"{p.name} {p.title}".lower()).replace(" ", "-")
        lines.append(f"| [{p.name} {p.title}](#{anchor}) | {p.kind} | {short(worst.error)} |"
                     f" {short(worst.allowed)} |\n")
    lines += [section(p) for p in problems]
    return "".join(lines)


def section(problem):
    """One problem as Markdown."""
    return "\n\n".join([f"\n## {problem.name} {problem.title}",
                        f"Source: {problem.source}. Reference: {problem.kind}.",
                        *problem.parts]) + "\n"


def differences(committed, fresh):
    """Lines of two pages that do not say the same; columns of errors are left out."""
    found = []
    old, new = committed.splitlines(), fresh.splitlines()
    if len(old) != len(new):
        found.append(f"the page has {len(old)} lines, this run {len(new)}")
    ignored, cells = set(), 0
    for number, (a, b) in enumerate(zip(old, new), 1):
        a, b = a.split("|"), b.split("|")
        if len(a) != cells:  # another table begins, with its header
            ignored = {k for k, cell in enumerate(b) if len(b) > 1 and "error" in cell}
            cells = len(b)
        same = len(a) == len(b) and all(
            k in ignored or same_text(x, y) for k, (x, y) in enumerate(zip(a, b)))
        if not same:
            found.append(f"line {number}: {'|'.join(a).strip()}\n     now: {'|'.join(b).strip()}")
    return found


def same_text(a, b):
    """Equal words, and numbers equal to SAME or to one in the last digit."""
    if NUMBER.sub("#", a) != NUMBER.sub("#", b):
        return False
    return all(abs(float(x) - float(y)) <= max(SAME * abs(float(x)), 1.01 * last_digit(x))
               for x, y in zip(NUMBER.findall(a), NUMBER.findall(b)) if x != y)


def last_digit(text):
    """The value of one in the last digit of a printed number; 0 of a whole number."""
    mantissa, _, power = text.partition("e")
    decimals = len(mantissa.partition(".")[2])
    return 10.0 ** (int(power or 0) - decimals) if decimals else 0.0


def shrink(path):
    """Fewer colours: a third of the size."""
    from PIL import Image
    with Image.open(path) as image:
        small = image.convert("RGB").quantize(96, dither=Image.Dither.NONE)
    small.save(path, optimize=True)


def draw_all(problems):
    """The pictures of the problems."""
    from problems import pictures
    for problem in problems:
        for name, drawing, data in problem.pictures:
            path = ROOT / "docs" / "images" / name
            getattr(pictures, drawing)(path, *data)
            shrink(path)


def main():
    """Write or check the page; exit status 1 if a number is not as it should be."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--only", action="append", metavar="NAME")
    options = parser.parse_args()
    program = os.environ.get("SPAR_PROGRAM", str(ROOT / "build" / "spar"))
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(program, folder)
        problems = [solve(bench) for solve in PROBLEMS
                    if not options.only or any(n in (solve.__doc__ or "") for n in options.only)]
        failures = [line for p in problems for line in p.failures()]
        if options.check:
            failures += differences(PAGE.read_text(encoding="utf-8"), write(problems))
        else:
            draw_all(problems)
            if options.only:
                print("".join(section(p) for p in problems))
            else:
                PAGE.write_text(write(problems), encoding="utf-8")
    print(*failures, sep="\n", end="\n" if failures else "")
    count = sum(len(p.numbers) for p in problems)
    print(f"validation: {len(problems)} problems, {count} numbers,"
          f" {len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
