"""Taichi pixel kernels. Each pixel gathers from the cells around it: no races, the same bits for any thread count.

Lengths are in pixels; points (M, 4) hold x, y, depth and reach (see binning.Bins). Boxes that wrap show their images.
"""

from ..runtime import ti

f32_2d = ti.types.ndarray(dtype=ti.f32, ndim=2)
f32_1d = ti.types.ndarray(dtype=ti.f32, ndim=1)
i32_2d = ti.types.ndarray(dtype=ti.i32, ndim=2)
i32_1d = ti.types.ndarray(dtype=ti.i32, ndim=1)
u8_2d = ti.types.ndarray(dtype=ti.u8, ndim=2)
u8_3d = ti.types.ndarray(dtype=ti.u8, ndim=3)
f32_3d = ti.types.ndarray(dtype=ti.f32, ndim=3)


@ti.func
def image(c, n, wraps):
    """The cell behind number c of an endless row of boxes of n cells, and how many boxes away it lies."""
    turns = 0
    if wraps == 1:
        if c < 0:
            turns = -1
        elif c >= n:
            turns = 1
    return c - turns * n, turns


@ti.func
def together(c, n):
    """How many of the cells c - 1, c, c + 1 of a row lie one behind the other in the list: 3, near its ends 1."""
    return 3 if 0 < c < n - 1 else 1


@ti.func
def middle(pixel, boxes, length):
    """Middle of a pixel as seen from a box some boxes away; f32 whatever the default, twice as fast here."""
    return ti.cast(pixel - boxes * length, ti.f32) + ti.f32(0.5)


@ti.func
def distance2(points: ti.template(), k, x, y):
    """Squared distance of point k from the pixel at (x, y)."""
    dx, dy, dz = x - points[k, 0], y - points[k, 1], points[k, 2]
    return dx * dx + dy * dy + dz * dz


@ti.kernel
def discs(
    out: u8_3d, points: f32_2d, colour: u8_2d, start: i32_1d, grid: i32_2d, cell: f32_2d, origin: f32_1d, wraps: i32_1d
):
    """out (H, W, 3): each pixel takes the disc whose centre is nearest in units of its radius; edges are smoothed."""
    for row, col in ti.ndrange(out.shape[0], out.shape[1]):
        best, chosen = ti.cast(1e9, ti.f32), -1
        for level in range(grid.shape[0]):
            nx, ny = grid[level, 0], grid[level, 1]
            cx = ti.cast(ti.floor((middle(col, 0, 0) - origin[0]) / cell[level, 0]), ti.i32)
            cy = ti.cast(ti.floor((middle(row, 0, 0) - origin[1]) / cell[level, 1]), ti.i32)
            cells = together(cx, nx)
            for oy, ox in ti.ndrange((-1, 2), 4 - cells):
                ix, tx = image(cx - 1 + ox, nx, wraps[0])
                iy, ty = image(cy + oy, ny, wraps[1])
                if 0 <= ix < nx and 0 <= iy < ny:
                    c = grid[level, 2] + iy * nx + ix
                    x, y = middle(col, tx, out.shape[1]), middle(row, ty, out.shape[0])
                    for k in range(start[c], start[c + cells]):
                        radius = points[k, 3] - ti.f32(0.5)
                        q2 = distance2(points, k, x, y) / (radius * radius)
                        if q2 < best:
                            best, chosen = q2, k
        if chosen >= 0:
            radius, q = points[chosen, 3] - 0.5, ti.sqrt(best)
            cover = ti.math.clamp(radius * (1.0 - q) + 0.5, 0.0, 1.0)
            # a darker rim tells touching discs apart; discs of a few pixels have no room for one
            rim = 0.5 * ti.math.clamp((q - 0.72) / 0.28, 0.0, 1.0) * ti.math.clamp((radius - 2.0) / 2.0, 0.0, 1.0)
            for k in ti.static(range(3)):
                ground = ti.cast(out[row, col, k], ti.f32)
                mixed = ground + cover * (colour[chosen, k] * (1.0 - rim) - ground)
                out[row, col, k] = ti.cast(mixed + 0.5, ti.u8)


@ti.kernel
def nearest(
    out: u8_3d, points: f32_2d, colour: u8_2d, start: i32_1d, grid: i32_2d, cell: f32_2d, origin: f32_1d, wraps: i32_1d
):
    """out (H, W, 3): the colour of the nearest particle; rings of cells grow until no nearer one can exist."""
    for row, col in ti.ndrange(out.shape[0], out.shape[1]):
        nx, ny = grid[0, 0], grid[0, 1]
        u, w = (middle(col, 0, 0) - origin[0]) / cell[0, 0], (middle(row, 0, 0) - origin[1]) / cell[0, 1]
        cx, cy = ti.cast(ti.floor(u), ti.i32), ti.cast(ti.floor(w), ti.i32)
        side = ti.min(cell[0, 0], cell[0, 1])
        best, chosen, ring, sure = ti.cast(1e30, ti.f32), 0, 0, False
        while ring <= ti.max(nx, ny) and not sure:
            for oy in range(-ring, ring + 1):
                # the inside of the ring is known: take its two ends only, except in its first and last row
                stride = 1 if ti.abs(oy) == ring else 2 * ring
                for step in range(2 * ring // stride + 1 if ring > 0 else 1):
                    ix, tx = image(cx - ring + step * stride, nx, wraps[0])
                    iy, ty = image(cy + oy, ny, wraps[1])
                    if 0 <= ix < nx and 0 <= iy < ny:
                        c = iy * nx + ix
                        x, y = middle(col, tx, out.shape[1]), middle(row, ty, out.shape[0])
                        for k in range(start[c], start[c + 1]):
                            r2 = distance2(points, k, x, y)
                            if r2 < best:
                                best, chosen = r2, k
            inside = ti.min(u - cx, cx + 1 - u, w - cy, cy + 1 - w) * side
            sure = best <= (ring * side + inside) ** 2
            ring += 1
        for k in ti.static(range(3)):
            out[row, col, k] = colour[chosen, k]


@ti.kernel
def interpolate(
    out: f32_3d, points: f32_2d, terms: f32_2d, start: i32_1d, grid: i32_2d, cell: f32_2d, origin: f32_1d, wraps: i32_1d
):
    """out (H, W, 2): sums over particles of w A f(q) and w f(q); terms (M, 2) hold A and w = (m/rho)/h^d.

    f is the cubic spline M4 with reach = 2 h; its norm cancels in the ratio of both sums.
    """
    for row, col in ti.ndrange(out.shape[0], out.shape[1]):
        above, below = ti.cast(0.0, ti.f32), ti.cast(0.0, ti.f32)
        for level in range(grid.shape[0]):
            nx, ny = grid[level, 0], grid[level, 1]
            cx = ti.cast(ti.floor((middle(col, 0, 0) - origin[0]) / cell[level, 0]), ti.i32)
            cy = ti.cast(ti.floor((middle(row, 0, 0) - origin[1]) / cell[level, 1]), ti.i32)
            cells = together(cx, nx)
            for oy, ox in ti.ndrange((-1, 2), 4 - cells):
                ix, tx = image(cx - 1 + ox, nx, wraps[0])
                iy, ty = image(cy + oy, ny, wraps[1])
                if 0 <= ix < nx and 0 <= iy < ny:
                    c = grid[level, 2] + iy * nx + ix
                    x, y = middle(col, tx, out.shape[1]), middle(row, ty, out.shape[0])
                    for k in range(start[c], start[c + cells]):
                        q = ti.sqrt(distance2(points, k, x, y)) / points[k, 3]  # r / 2h: f = 2 (1-q)^3 - 8 (1/2-q)^3
                        a, b = ti.max(ti.f32(1.0) - q, ti.f32(0.0)), ti.max(ti.f32(1.0) - q - q, ti.f32(0.0))
                        weight = terms[k, 1] * (a * a * a * ti.f32(2.0) - b * b * b)
                        above += weight * terms[k, 0]
                        below += weight
        out[row, col, 0], out[row, col, 1] = above, below
