"""`spmhd bench`: particle updates per second of full steps on this machine, and where a step's time goes.

Taichi has one precision and one number of threads a process, so each pair of them is measured in a child process
(`child`), one after another. `cases` are what is simulated, `clocks` tell where a step's time goes, `measure` makes a
row, `yardstick` is the bare loop that makes the cost of the rates a number without machine, `scale` grows the problem.
"""

from .command import add_options, main

__all__ = ["add_options", "main"]
