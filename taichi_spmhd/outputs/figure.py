"""A white sheet to draw on without a display, and its file: title above, caption below."""

from .words import one_line

PALE = "#555555"


def sheet(width: float, height: float, dpi: int = 110):
    """A white figure and its canvas."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), dpi=dpi, facecolor="white", layout="constrained")
    return figure, FigureCanvasAgg(figure)


def finished(figure, canvas, title: str, caption: str, path) -> None:
    """Title, caption, file."""
    figure.suptitle(title, fontsize=13, fontweight="bold")
    figure.text(0.008, -0.02, one_line(caption), fontsize=7.5, color=PALE, va="top")
    canvas.print_figure(path, format="png", bbox_inches="tight", pad_inches=0.12)
