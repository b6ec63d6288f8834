"""Read and draw the result files of spar: see `spar-plot --help`, and Results for Python."""
from .results import Results, ResultError

__all__ = ["Results", "ResultError"]
