"""Files: PNG frames and MP4 films, each written whole or not at all."""

import os
from collections.abc import Iterable, Iterator
from pathlib import Path

import numpy as np
from PIL import Image

from ..errors import InputError
from ..replacing import replacing


def place(path):
    """A temporary name that becomes `path`, in a folder that is made where it is not there."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    return replacing(path, path.suffix)


def _read(frame) -> np.ndarray:
    """A frame from an array or from the name of a picture file. Raises InputError for a file that is none."""
    if isinstance(frame, str | os.PathLike):
        try:
            with Image.open(frame) as picture:
                return np.asarray(picture.convert("RGB"))
        except (OSError, ValueError, SyntaxError) as error:  # as Pillow says that a file is cut short or ill
            raise InputError(f"frame {frame} cannot be read ({error}); remove it, the film goes without it") from error
    return np.asarray(frame)


def checked(frames: Iterable) -> Iterator[np.ndarray]:
    """Frames (H, W, 3) uint8 of one size; arrays or names of picture files. Raises InputError for anything else."""
    shape = None
    for n, frame in enumerate(frames):
        rgb = _read(frame)
        if rgb.ndim != 3 or rgb.shape[2] != 3 or rgb.dtype != np.uint8:
            raise InputError(f"frame {n} is {rgb.dtype} {rgb.shape}; a frame is uint8 (H, W, 3)")
        if shape not in (None, rgb.shape):
            raise InputError(f"frame {n} is {rgb.shape}, the first is {shape}; all frames of a film have one size")
        shape = rgb.shape
        yield rgb


def write_png(path, rgb: np.ndarray) -> None:
    """Write a picture (H, W, 3) uint8."""
    (rgb,) = checked([rgb])
    with place(path) as temporary:
        Image.fromarray(rgb).save(temporary, format="PNG", compress_level=4)


def _ffmpeg():
    try:
        import imageio_ffmpeg
    except ImportError as error:
        raise InputError("mp4 films need ffmpeg: pip install 'taichi-spmhd[movie]', or write a gif") from error
    return imageio_ffmpeg


def _even(rgb: np.ndarray) -> np.ndarray:
    """The frame without the odd last row or column: yuv420p has one colour for 2 x 2 pixels."""
    high, wide = (n - n % 2 for n in rgb.shape[:2])
    return np.ascontiguousarray(rgb[:high, :wide])


def write_mp4(path, frames: Iterable, fps: float = 10.0) -> int:
    """Write frames (H, W, 3) uint8 as an H.264 film, one at a time; return its size in bytes.

    Raises InputError where imageio-ffmpeg is missing, for no frames and for frames of unequal sizes.
    """
    ffmpeg, writer = _ffmpeg(), None
    with place(path) as temporary:
        try:
            for rgb in map(_even, checked(frames)):
                if writer is None:
                    size = rgb.shape[1], rgb.shape[0]
                    writer = ffmpeg.write_frames(
                        str(temporary), size, fps=fps, codec="libx264", quality=None, macro_block_size=2,
                        pix_fmt_out="yuv420p", output_params=["-crf", "18", "-preset", "veryfast"],
                    )  # fmt: skip
                    writer.send(None)
                writer.send(rgb)
        finally:
            if writer is not None:
                writer.close()
        if writer is None:
            raise InputError("a film needs at least one frame")
        return temporary.stat().st_size
