"""What a validation problem is made of: runs of the program, numbers with references, tables."""
import re
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

from spar_tools import Results

ROOT = Path(__file__).resolve().parents[2]
CRITICAL = re.compile(r"step (\d+): (limit point|bifurcation) at load factor (\S+),"
                      r" unstable modes (\d+) -> (\d+)")


class Bench:
    """Runs decks of this repository with settings, each once, into a scratch folder."""

    def __init__(self, program, folder):
        self.program = str(Path(program).resolve())
        self.folder = Path(folder)
        self.logs = {}

    def run(self, deck, **settings):
        """Results of a deck; `log` is what the program printed, `critical` its critical points."""
        words = [f"{name}={value}" for name, value in settings.items()]
        name = re.sub(r"[^\w.=-]+", "_", "_".join([deck, *words]))
        path = self.folder / f"{name}.h5"
        if path not in self.logs:
            command = [self.program, "run", str(ROOT / deck), "-o", str(path), "--no-progress"]
            done = subprocess.run(command + [part for word in words for part in ("-D", word)],
                                  capture_output=True, text=True, check=False)
            if done.returncode != 0:
                sys.exit(f"{deck} {' '.join(words)}: status {done.returncode}\n{done.stderr}")
            self.logs[path] = done.stdout
        results = Results(path)
        results.log = self.logs[path]
        results.critical = [(kind, float(factor), int(before), int(behind)) for _, kind, factor,
                            before, behind in CRITICAL.findall(results.log)]
        return results


@dataclass
class Number:
    """A computed number; with a reference, how far it may be away in relation to it."""
    computed: float
    reference: float = None
    allowed: float = None
    digits: int = 6
    printed: str = None  # the reference as its source prints it

    @property
    def error(self):
        """Relative, signed; absolute if the reference is zero."""
        if self.reference == 0:
            return self.computed
        return self.computed / self.reference - 1

    def __str__(self):
        return significant(self.computed, self.digits)

    def wanted(self):
        """The reference as text."""
        return self.printed or significant(self.reference, self.digits)


@dataclass
class Problem:
    """One section of the page."""
    name: str
    title: str
    source: str
    kind: str
    parts: list = field(default_factory=list)     # paragraphs and tables, in order
    numbers: list = field(default_factory=list)
    pictures: list = field(default_factory=list)  # (file name, drawing, its data)

    def text(self, *paragraphs):
        """Add paragraphs."""
        self.parts += [" ".join(p.split()) for p in paragraphs]

    def table(self, header, rows):
        """Add a table whose cells are texts or Numbers."""
        self.numbers += [cell for row in rows for cell in row
                         if isinstance(cell, Number) and cell.allowed is not None]
        lines = ["| " + " | ".join(map(str, line)) + " |" for line in [header, *rows]]
        lines.insert(1, "|---" * len(header) + "|")
        self.parts.append("\n".join(lines))

    def compare(self, rows, what="quantity"):
        """Add a table of (text, Number): computed, reference, error, allowed."""
        self.table([what, "spar", "reference", "error", "allowed"], [
            [name, n, n.wanted(), short(n.error), short(n.allowed)]
            for name, n in rows])
        self.numbers += [n for _, n in rows if n not in self.numbers]

    def picture(self, name, caption, drawing, *data):
        """Add a picture that the function `drawing` of pictures.py makes when it is asked for."""
        self.pictures.append((name, drawing, data))
        self.parts.append(f"![{caption}](images/{name})")

    def failures(self):
        """Lines about the numbers beyond what is allowed."""
        return [f"{self.name}: {n} for {n.wanted()},"
                f" error {short(n.error)}, allowed {short(n.allowed)}"
                for n in self.numbers if not abs(n.error) <= n.allowed]

    def worst(self):
        """The number nearest to, or farthest beyond, what is allowed."""
        return max(self.numbers, key=lambda n: abs(n.error) / n.allowed)


def significant(value, digits):
    """A number to so many significant digits, without an exponent where that is readable."""
    text = f"{value:#.{digits}g}"
    if "e" not in text:
        return text.rstrip(".")
    mantissa, _, power = text.partition("e")
    return f"{float(value):.0f}" if 0 < int(power) < 12 else f"{mantissa}e{int(power)}"


def short(error):
    """An error to two digits."""
    if error == 0:
        return "0"
    mantissa, _, power = f"{error:.1e}".partition("e")
    return f"{mantissa.removesuffix('.0')}e{int(power)}"
