"""Pictures: particles into pixels (pixels), pixels into frames (panels), frames into files (movie, gif)."""

from .columns import columns, snapshot
from .gif import write_gif
from .movie import write_mp4, write_png
from .panels import Panels
from .pixels import draw

__all__ = ["Panels", "columns", "draw", "snapshot", "write_gif", "write_mp4", "write_png"]
