"""What can go wrong in a run, and the sentence what to try: by cause, and by the term with the largest rate."""

from numbers import Real

from .guard import ours

NOT_FINITE, NEGATIVE, COLLAPSED = "not finite", "u <= 0", "collapsed step"
LOST, STRAYED, GROWN = "lost neighbours", "strayed particle", "grown support"
MET, PASSED_WALL, DRIFT = "two on one spot", "passed wall", "energy drift"

CAUSES = {
    NOT_FINITE: "a smaller time step (stepper cour), or more particles",
    NEGATIVE: "a smaller time step (stepper cour), or Viscosity() and Conductivity() where flows meet",
    COLLAPSED: "a smoother start, more particles, or Viscosity() where flows meet",
    LOST: "a kernel with more neighbours (larger h_fact), more particles, or a boundary that keeps them together",
    STRAYED: "a boundary that keeps it (Periodic, Reflecting), a smaller time step (stepper cour), or equal masses",
    GROWN: "more particles where the gas thins out, a boundary that keeps it, or Guard(growth=...) if this is meant",
    MET: "Viscosity() to stop flows that meet, or DivBSource() where the field pulls particles together",
    PASSED_WALL: "Viscosity(), or a smaller time step (stepper cour)",
    DRIFT: "a smaller time step (stepper cour) or stepper=SSPRK3(); Guard(drift=inf) if a term of the scene's own "
    "does work that it does not book in leak_E",
}
BY_RATES = (NOT_FINITE, NEGATIVE, COLLAPSED)  # causes for which the term with the largest rate is to blame
FIELD = ("Stress", "DivBSource", "Induction", "InductionOfB", "StressShift")


def cure(cause: str, scene, term: str | None = None, beta: float | None = None) -> str:
    """The sentence. term: the class name of the one with the largest rate; beta = 2P/B^2 at the place."""
    found = [of_term(scene, term, beta), of_energy(scene)] if cause in BY_RATES else []
    return "try " + ", or ".join([*filter(None, found), CAUSES[cause]])


def of_term(scene, term: str | None, beta: float | None) -> str:
    """What helps against this term."""
    part = {type(part).__name__: part for part in scene.parts}.get(term)
    if part is None:
        return ""
    if term in FIELD:
        return of_field(scene, beta)
    if not ours(part):
        return f"another form of {term} (it is the scene's own)"
    numbers = [f"{name} = {getattr(part, name):.3g}" for name in part.live if isinstance(getattr(part, name), float)]
    return f"smaller numbers in {term} ({', '.join(numbers)})" if numbers else ""


def of_field(scene, beta: float | None) -> str:
    """The remedies of the field that are not taken yet."""
    terms = {type(term).__name__: term for term in scene.terms}
    xi = getattr(terms.get("DivBSource"), "xi", 0.0)
    lacking = []
    if beta is not None and beta < 1 and isinstance(xi, Real) and xi < 0.5:  # a rule knows what it does
        lacking.append("DivBSource(xi=0.5)")
    if not any("Cleaning" in name or name.startswith("TriccoPrice2012") for name in terms):
        lacking.append("Cleaning()")
    where = f" (beta = {beta:.2g} there)" if beta is not None else ""
    return " and ".join(lacking) + where if lacking else ""


def of_energy(scene) -> str:
    """Where u is a difference of large numbers."""
    return "energy=Thermal()" if type(scene.energy).__name__ == "Total" else ""
