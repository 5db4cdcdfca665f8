"""Run: all variants of a scene, frame by frame, so that it can be watched, interrupted and taken up again."""

import time

from ..errors import RunError
from ..scene_code import code_of
from ..simulation import Simulation
from . import history, states
from .failed import photograph
from .film import Film
from .folder import Folder
from .plan import Plan
from .progress import Silent
from .signals import Interrupted, Stop
from .words import one_line

SAVE_EVERY = 600.0  # seconds between states where frames are further apart


class Run:
    """Order within a frame: step, row of the history, state; once all variants are there, the picture.

    A run that is killed anywhere in it repeats from the states what is missing, to the same bits. `errors` names the
    variants that went wrong; their simulations are put back to their last good state.
    """

    def __init__(self, plan: Plan, folder: Folder, stop: Stop, progress: Silent):
        self.plan, self.folder, self.stop, self.progress = plan, folder, stop, progress
        self.sims: dict[str, Simulation] = {}
        self.reached: dict[str, int] = {}  # the last frame whose row and state are on the disk
        self.errors: dict[str, str] = {}
        self.saved = time.monotonic()

    def begin(self) -> None:
        """Start anew. Files of an earlier run go only when every variant has passed its first evaluation."""
        self.folder.check(self.plan.record())
        for label in self.plan.variants:
            self.stop.check()
            self.sims[label], self.reached[label] = self.made(label), -1
        Film(self.plan, self.folder).check(self.sims)
        self.folder.claim(self.plan.record())
        for label in self.plan.variants:
            history.begin(self.folder.history(label))
        self.film = Film(self.plan, self.folder)

    def made(self, label: str) -> Simulation:
        """A simulation at its start, evaluated once."""
        with code_of(self.plan.path):
            sim = Simulation(self.plan.variants[label])
            sim.begin()
        return sim

    def resume(self) -> None:
        """Go on from the states of an interrupted run; a variant without one starts anew."""
        self.errors = dict(self.folder.record.get("errors", {}))
        for label in self.plan.variants:
            self.stop.check()
            self.sims[label], done = self.taken_up(label)
            self.reached[label] = done - 1
            history.cut(self.folder.history(label), self.sims[label].time if done else -1.0, done)
        self.film = Film(self.plan, self.folder)
        for label in self.errors:
            self.film.stop(label, self.sims[label].time)

    def taken_up(self, label: str) -> tuple[Simulation, int]:
        """A variant as its state says, and how many frames it has behind it."""
        if not states.any_of(self.folder, label):
            return self.made(label), 0
        sim, older = self.last(label)
        if older and label in self.errors:  # it went wrong after the state that is lost: let it do so again
            del self.errors[label]
            self.folder.update(errors=self.errors)
        return sim, sum(t <= sim.time for t in self.plan.times)

    def last(self, label: str) -> tuple[Simulation, bool]:
        """A variant as it was last saved, and whether it is the state before, since the last one is lost."""
        with code_of(self.plan.path):
            return states.load(self.folder, label, self.plan.variants[label], self.progress.note)

    def go(self) -> None:
        """All frames, then the film. Raises Interrupted (all is saved) and InputError (the disk refused)."""
        self.show()
        for k, until in enumerate(self.plan.times):
            for label in self.plan.variants:
                if self.reached[label] < k and label not in self.errors:
                    self.advance(label, k, until)
            if not self.folder.frame(k).exists() and not self.past(until):
                self.film.draw(k, until, self.sims)
            self.stop.check()
        self.film.write()

    def past(self, until: float) -> bool:
        """Whether some variant has left this time behind, so that its frame cannot be drawn any more."""
        return any(sim.time > until for label, sim in self.sims.items() if label not in self.errors)

    def advance(self, label: str, k: int, until: float) -> None:
        """One variant to the next frame."""
        sim = self.sims[label]
        try:
            if k == 0 and until > 0 and sim.time == 0:
                self.save(label)  # the last good state there is, should the first frame not be reached
            sim.run(until, watch=lambda sim: self.watch(label, until))
        except RunError as error:
            self.fail(label, error)
            return
        except Interrupted:
            if sim.time < until:
                self.save(label)
                raise
        self.keep(label, k)
        self.show()
        self.stop.check()

    def watch(self, label: str, until: float) -> None:
        """After every step."""
        self.show()
        if self.sims[label].time < until and time.monotonic() - self.saved > SAVE_EVERY:
            self.save(label)
        self.stop.check()

    def keep(self, label: str, k: int) -> None:
        """Row first: a state without its row would go on without it."""
        from ..diagnostics import history_row

        history.add(self.folder.history(label), history_row(self.sims[label]))
        self.save(label)
        self.reached[label] = k

    def save(self, label: str) -> None:
        self.sims[label].save(self.folder.state(label), self.folder.previous(label))
        self.saved = time.monotonic()

    def fail(self, label: str, error: RunError) -> None:
        """Note what went wrong and put the variant back to its last good state; the others go on."""
        self.errors[label] = one_line(error) + photograph(self.sims[label], error, self.folder.failure(label))
        self.folder.update(errors=self.errors)
        self.sims[label].close()
        self.sims[label], _ = self.last(label)
        self.film.stop(label, self.sims[label].time)
        self.progress.note(f"{label} went wrong; the others go on" if self.going() else f"{label} went wrong")

    def going(self) -> bool:
        """Whether any variant is still on its way."""
        return any(label not in self.errors for label in self.plan.variants)

    def show(self) -> None:
        """Tell the share done, and the speed of all variants together."""
        going = [sim for label, sim in self.sims.items() if label not in self.errors]
        t_end, seconds = self.plan.t_end, sum(sim.seconds for sim in self.sims.values())
        done = sum(min(1.0, sim.time / t_end) if t_end else 1.0 for sim in going) / len(going) if going else 1.0
        updates = sum(len(sim) * sim.timed for sim in self.sims.values())
        self.progress.show(done, updates / seconds if seconds else 0.0)

    def close(self) -> None:
        """Give the device memory back."""
        for sim in self.sims.values():
            sim.close()


def restore(plan: Plan, folder: Folder) -> dict | None:
    """Compare a run to be taken up with what is asked; its record if it has ended, None if it can go on."""
    record = folder.take_up(plan.record())
    return record if record.get("finished") else None
