"""The rows of the plots: bounded, however long the run."""

MOST = 3000  # rows; then every second one is dropped


class Plots:
    """Rows are numbered for ever; `base` is the number of the first one here."""

    def __init__(self):
        self.rows, self.base = [], 0

    @property
    def next(self) -> int:
        return self.base + len(self.rows)

    def add(self, row: list) -> None:
        self.rows.append(row)
        if len(self.rows) > MOST:
            self.base, self.rows = self.next, self.rows[::2]

    def clear(self) -> None:
        self.base, self.rows = self.next + 1, []

    def since(self, number: int) -> dict:
        """Rows by panel, from `number` on; all of them, and "first" 0, for who knows other rows than these."""
        known = self.base <= number <= self.next
        rows = self.rows[number - self.base :] if known else self.rows
        count = max((len(row) for row in self.rows[-1:]), default=0)
        by_panel = [[row[k] for row in rows if k < len(row)] for k in range(count)]
        return {"first": number if known and number > self.base else 0, "next": self.next, "panels": by_panel}
