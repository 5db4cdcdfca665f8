"""table.md: what stands in it is what the summary says, and nothing empty stands in it."""

from taichi_spmhd.outputs.comparison import comparison

HYDRO = {"steps": 12, "seconds": 0.5, "mean_gap": 1.0, "close_pairs": 0.256, "first_peak": 0.0, "energy_drift": -1e-3}


def made(**variants):
    """The summary of a run."""
    head = {"scene": "wave", "parameters": {"nx": 16, "beta": 0.2}, "frames": 5, "t_end": 0.1, "version": "1.2"}
    return {**head, "arch": "x64", "precision": "f64", "threads": 2, "variants": variants}


def cells(text: str) -> list[list[str]]:
    """The cells of the table, its header first."""
    return [line[2:-2].split(" | ") for line in text.splitlines() if line.startswith("| ")]


def test_a_row_a_variant_under_a_head_that_says_what_ran():
    text = comparison(made(a=HYDRO, b={**HYDRO, "steps": 13}), {"a": None, "b": None})
    assert text.startswith("# wave, t = 0.1\n\nParameters: nx=16 beta=0.2; 5 frames.\n\n| variant | steps | ")
    assert "\nMade by taichi_spmhd 1.2 on " in text and text.endswith(".\n")
    header, rule, *rows = cells(text)
    assert set(rule) == {"---"} and len(rule) == len(header) == len(rows[0])
    # zero is a number and stays; negative drifts keep their sign
    assert rows[0] == ["a", "12", "0.5", "1.000", "25.6%", "0.000", "-1.00e-03"] and rows[1][:2] == ["b", "13"]


def test_columns_that_are_empty_for_all_are_left_out_and_others_have_gaps():
    field = {**HYDRO, "div_B": {"mean": 1e-3, "p99": 2e-2, "max": 0.5}}
    header, _, *rows = cells(comparison(made(a=HYDRO, b=field), {"a": None, "b": None}))
    assert header[-3:] == ["div B mean", "div B 99 %", "div B max"]
    assert rows[0][-3:] == ["", "", ""] and rows[1][-3:] == ["1.00e-03", "2.00e-02", "5.00e-01"]
    assert not {"momentum drift", "energy predicted", "went wrong"} & set(header)


def test_errors_are_the_quoted_one_or_all():
    one = {**HYDRO, "errors": {"rho": 0.1, "B_z": 0.2}}
    header, _, row = cells(comparison(made(a=one), {"a": "B_z"}))
    assert header[-1] == "error B_z" and row[-1] == "2.00e-01" and "error rho" not in header
    assert cells(comparison(made(a=one), {"a": None}))[0][-2:] == ["error rho", "error B_z"]
    assert cells(comparison(made(a=one), {"a": "v_x"}))[0][-2:] == ["error rho", "error B_z"], "it is not there"


def test_what_went_wrong_and_odd_labels_keep_the_table_whole():
    text = comparison(made(**{"|B| = 1": {**HYDRO, "error": "not finite\nat t = 1"}, "b": HYDRO}), {})
    header, _, first, second = cells(text.replace("\\|", "/"))
    assert first[0] == "/B/ = 1" and first[-1] == "not finite at t = 1" and second[-1] == ""
    assert header[-1] == "went wrong" and len(first) == len(second) == len(header)
