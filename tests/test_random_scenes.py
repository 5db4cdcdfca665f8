"""Random scenes of compatible parts: each is refused in one line, or takes steps to finite numbers."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from taichi_spmhd import (
    SSPRK3,
    Adiabatic,
    Boundary,
    Frozen,
    Heun,
    InputError,
    Isothermal,
    LeapfrogKDK,
    LocallyIsothermal,
    Open,
    Periodic,
    Reflecting,
    RunError,
    Scene,
    Simulation,
    SumMass,
    SumVolume,
    Thermal,
    Total,
    cubic,
    jitter,
    line,
    square,
)
from taichi_spmhd import terms as t
from taichi_spmhd.kernels import KERNELS

LATTICE, ALONG = {1: line, 2: square, 3: cubic}, {1: 32, 2: 12, 3: 8}
HYDRO = (  # one of each: nothing, or an effect in one of its forms
    ((), (t.Viscosity(),), (t.CullenDehnen(),), (t.LectureViscosity(),), (t.MorrisMonaghan(),), (t.Balsara(),)),
    ((), (t.Conductivity(),)),
)
FIELD = (
    ((), (t.DivBSource(0.5),), (t.DivBSource(t.PhantomXi()),), (t.StressShift(),), (t.Repulsion(),)),
    ((), (t.Resistivity(),), (t.TriccoPrice2013(),)),
    ((), (t.Cleaning(),), (t.ConstantCleaning(),), (t.TriccoPrice2012(),)),
)
SIDES = (Periodic(), Open(), Reflecting(), (Frozen(0.2), Frozen(0.2)), (Open(), Reflecting()))


@st.composite
def scenes(draw) -> Scene:
    """A scene of smooth random waves on a disturbed lattice; parts that cannot go together may come together."""
    pick = lambda values: draw(st.sampled_from(values))  # noqa: E731
    dim, magnetic = pick((1, 2, 2, 3)), pick((False, True, True))
    box = (1.0,) * dim
    base = (t.Stress(), t.Induction(form=pick(("B/rho", "B")))) if magnetic else (t.Pressure(),)
    extra = [part for group in HYDRO + (FIELD if magnetic else ()) for part in pick(group)]
    eos = pick((Adiabatic(), Adiabatic(1.4), Isothermal(1.0), LocallyIsothermal()))
    sides = [pick(SIDES) if draw(st.integers(0, 3)) == 0 else Periodic() for _ in range(dim)]
    amplitude, seed = draw(st.floats(0, 0.9)), draw(st.integers(0, 99))
    x = LATTICE[dim](box, ALONG[dim])
    return Scene(
        box=box,
        positions=jitter(x, box, draw(st.floats(0, 0.3)), seed),
        start=lambda x: start(x, eos, magnetic, amplitude, seed),
        terms=(*base, *extra),
        eos=eos,
        energy=pick((Thermal(), Total())),
        density=pick((SumMass(), SumVolume())),
        stepper=pick((LeapfrogKDK(), Heun(), SSPRK3())),
        kernel=pick(KERNELS)(),
        boundary=Boundary(*sides),
    )


def start(x, eos, magnetic: bool, amplitude: float, seed: int) -> dict:
    """Waves of one period a box, of random phase."""
    random = np.random.default_rng(seed)

    def wave() -> np.ndarray:
        return amplitude * np.sin(2 * np.pi * (x @ random.integers(-1, 2, x.shape[1]) + random.random()))

    out = {"rho": 1 + wave(), "v": np.stack([wave(), wave(), wave()], axis=1)}
    if isinstance(eos, Adiabatic):
        out["P"] = 1 + wave()
    if isinstance(eos, LocallyIsothermal):
        out["cs"] = 1 + wave()
    return {**out, "B": np.stack([1 + wave(), wave(), wave()], axis=1)} if magnetic else out


def take_steps(scene: Scene) -> str:
    """How it ended."""
    try:
        with Simulation(scene) as sim:
            for _ in range(3):
                sim.step()
            ill = [name for name, values in sim.columns().items() if not np.isfinite(values).all()]
            assert not ill, f"{ill} of {scene.sketch()}"
            assert np.isfinite(sim.summary()["energy_drift"])
            return "ran"
    except (InputError, RunError) as error:
        assert str(error).isprintable(), scene.sketch()
        return type(error).__name__


def most_run(count: int, several: float = 0.5) -> None:
    """Try so many scenes; at least this share of those that can be built must have run."""
    ended = []

    @settings(max_examples=count)
    @given(chance=st.data())
    def tried(chance):
        try:
            scene = chance.draw(scenes())
        except InputError as error:
            assert str(error).isprintable()
        else:
            ended.append(take_steps(scene))

    tried()
    assert ended.count("ran") >= several * len(ended) > 0, ended


def test_random_scenes_run_or_are_refused_in_one_line():
    most_run(5)


@pytest.mark.slow
def test_many_random_scenes_run_or_are_refused_in_one_line():
    most_run(60)
