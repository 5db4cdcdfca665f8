"""The commands `spmhd list`, `show`, `run`, `bench`, one file each."""

from .main import main

__all__ = ["main"]
